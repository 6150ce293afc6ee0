// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "grid/checksum.h"

using namespace akimap;

namespace {

/** As doc/format.md says it, a byte and a lane at a time. */
uint64_t slowChecksum(const std::string& bytes) {
    uint32_t lanes[32];
    for (uint32_t i = 0; i < 32; i++) lanes[i] = (i + 1) * 0x9e3779b1u;
    for (std::size_t at = 0; at < bytes.size(); at += 4) {
        uint32_t word = 0;
        for (std::size_t i = 0; i < 4 && at + i < bytes.size(); i++)
            word |= uint32_t{static_cast<unsigned char>(bytes[at + i])} << 8 * i;
        uint32_t& lane = lanes[at / 4 % 32];
        lane = (lane ^ word) * 2049;
        lane ^= lane >> 15;
    }
    for (std::size_t at = (bytes.size() + 3) / 4; at % 32 != 0; at++) {  // padding is taken as well
        lanes[at % 32] *= 2049;
        lanes[at % 32] ^= lanes[at % 32] >> 15;
    }
    uint64_t sum = bytes.size();
    for (const uint32_t lane : lanes) {
        sum = (sum ^ lane) * 0x9e3779b97f4a7c15u;
        sum ^= sum >> 32;
    }
    return sum;
}

std::string randomBytes(std::size_t size, unsigned seed) {
    std::mt19937 random(seed);
    std::string bytes(size, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    return bytes;
}

uint64_t sumOf(const std::string& bytes) {
    return checksumOf(bytes.data(), bytes.size());
}

}  // namespace

TEST(Checksum, IsTheOneThatIsDocumented) {
    for (std::size_t size = 0; size < 600; size++) {
        const std::string bytes = randomBytes(size, 1);
        ASSERT_EQ(sumOf(bytes), slowChecksum(bytes)) << size;
    }
    const std::string large = randomBytes(100000, 2);
    EXPECT_EQ(sumOf(large), slowChecksum(large));
    EXPECT_EQ(sumOf("akimap"), 0x1680c59af4ced7b5u);  // by tests/data/list_map.py
}

TEST(Checksum, PiecesDoNotMatter) {
    std::mt19937 random(3);
    const std::string bytes = randomBytes(5000, 4);
    for (int round = 0; round < 200; round++) {
        Checksum sum;
        for (std::size_t at = 0; at < bytes.size();) {
            const std::size_t n = std::min<std::size_t>(random() % 400, bytes.size() - at);
            sum.add(bytes.data() + at, n);
            at += n;
        }
        ASSERT_EQ(sum.value(), sumOf(bytes));
    }
}

TEST(Checksum, AnyOneBitAndAnyTwoSignBitsShow) {
    const std::string bytes(1024, '\0');
    const uint64_t sum = sumOf(bytes);
    for (std::size_t bit = 0; bit < 8 * bytes.size(); bit++) {
        std::string other = bytes;
        other[bit / 8] = static_cast<char>(1 << bit % 8);
        ASSERT_NE(sumOf(other), sum) << bit;
    }
    for (std::size_t a = 3; a < bytes.size(); a += 4)
        for (std::size_t b = a + 4; b < bytes.size(); b += 4) {
            std::string other = bytes;
            other[a] = other[b] = '\x80';
            ASSERT_NE(sumOf(other), sum) << a << " " << b;
        }
}

TEST(Checksum, OrderAndLengthShow) {
    std::string bytes = randomBytes(512, 5);
    const uint64_t sum = sumOf(bytes);
    EXPECT_NE(sumOf(bytes + '\0'), sum);
    EXPECT_NE(sumOf(bytes.substr(0, 511)), sum);
    std::swap_ranges(bytes.begin(), bytes.begin() + 4, bytes.begin() + 4);  // two lanes
    EXPECT_NE(sumOf(bytes), sum);
    bytes = randomBytes(512, 5);
    std::swap_ranges(bytes.begin(), bytes.begin() + 128, bytes.begin() + 128);  // two strides
    EXPECT_NE(sumOf(bytes), sum);
}
