// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Each allocation fails in its turn: what was begun is done wholly or not at all, and works the
// next time.
#include <akimap/AkiMap.h>
#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/serialization/CArchive.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "random_scans.h"
#include "run_program.h"
#include "same_map.h"
#include "sanitized.h"

using namespace akimap;

namespace {

std::atomic<long> left{-1};  ///< allocations until one fails; negative: none does

void* allocate(std::size_t size, std::size_t alignment) {
    if (left >= 0 && left-- == 0) throw std::bad_alloc();
    void* memory = nullptr;
    if (posix_memalign(&memory, alignment, size) != 0) throw std::bad_alloc();
    return memory;
}

}  // namespace

void* operator new(std::size_t size) {
    return allocate(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocate(size, static_cast<std::size_t>(alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}

namespace {

enum class End { done, failed, never_failed };

/** Does the work with the n-th of its allocations failing. */
template <class Work>
End withFailure(long n, Work&& work) {
    End end = End::done;
    left = n;
    try {
        work();
    } catch (const std::exception&) {
        end = End::failed;
    }
    if (left >= 0) end = End::never_failed;
    left = -1;
    return end;
}

/** Does attempt(n, fails) for n = 0, 1, ... until the work needs no more allocations than n.
 * \return how many it needs */
template <class Attempt>
long atEachAllocation(Attempt&& attempt) {
    const long step = sanitized() ? 7 : 1;
    long n = 0;
    while (attempt(n) != End::never_failed && !testing::Test::HasFailure()) n += step;
    return n;
}

AkiMap mapOf(Estimator estimator, int scans) {
    AkiMap map(0.1);
    map.insertionOptions.threads = 1;
    map.insertionOptions.estimator = estimator;
    for (int i = 0; i < scans; i++)
        EXPECT_TRUE(map.insertRays(test::randomScan(static_cast<unsigned>(i) + 1, 200)));
    return map;
}

class OutOfMemory : public testing::TestWithParam<Estimator> {};

}  // namespace

TEST_P(OutOfMemory, AScanIsInsertedOrLeavesTheMapAsItWas) {
    const AkiMap before = mapOf(GetParam(), 2), after = mapOf(GetParam(), 3);
    const std::string old = test::fingerprint(before), expected = test::fingerprint(after);
    const auto scan = test::randomScan(3, 200);
    const long needed = atEachAllocation([&](long n) {
        AkiMap map = before;
        const End end = withFailure(n, [&] { map.insertRays(scan); });
        EXPECT_EQ(test::fingerprint(map), end == End::failed ? old : expected)
            << "allocation " << n;
        return end;
    });
    EXPECT_GT(needed, 10);
}

TEST_P(OutOfMemory, TheMapTakesScansAfterIt) {
    const AkiMap before = mapOf(GetParam(), 1);
    AkiMap plain = before;
    const auto small = test::randomScan(5, 20), large = test::randomScan(6, 400);
    for (const auto* scan : {&small, &large}) plain.insertRays(*scan);
    const std::string expected = test::fingerprint(plain);
    atEachAllocation([&](long n) {
        AkiMap map = before;
        map.insertRays(small);  // a workspace of its own, which the next scan outgrows
        const End end = withFailure(n, [&] { map.insertRays(large); });
        if (end == End::failed) map.insertRays(large);
        EXPECT_EQ(test::fingerprint(map), expected) << "allocation " << n;
        return end;
    });
}

INSTANTIATE_TEST_SUITE_P(Estimators, OutOfMemory,
                         testing::Values(Estimator::surface, Estimator::paper));

TEST(OutOfMemory, AssignmentsAreDoneOrNot) {
    AkiMap other = mapOf(Estimator::paper, 2);
    other.likelihoodOptions.sigma_hit = 0.3;
    other.renderingOptions.show_free = true;
    const AkiMap before = mapOf(Estimator::surface, 1);
    const std::string old = test::fingerprint(before), expected = test::fingerprint(other);
    const long needed = atEachAllocation([&](long n) {
        AkiMap map = before;
        const End end = withFailure(n, [&] { map = other; });
        EXPECT_EQ(test::fingerprint(map), end == End::failed ? old : expected)
            << "allocation " << n;
        return end;
    });
    EXPECT_GT(needed, 1);
}

TEST(OutOfMemory, ReadingAStreamIsDoneOrNot) {
    const AkiMap before = mapOf(Estimator::surface, 1), read = mapOf(Estimator::paper, 1);
    const std::string old = test::fingerprint(before), expected = test::fingerprint(read),
                      bytes = test::bytes(read);
    const long needed = atEachAllocation([&](long n) {
        AkiMap map = before;
        mrpt::io::CMemoryStream stream;
        stream.Write(bytes.data(), bytes.size());
        stream.Seek(0);
        auto archive = mrpt::serialization::archiveFrom(stream);
        const End end = withFailure(n, [&] { archive >> map; });
        EXPECT_EQ(test::fingerprint(map), end == End::failed ? old : expected)
            << "allocation " << n;
        return end;
    });
    EXPECT_GT(needed, 20);
}

TEST(OutOfMemory, AFileIsLoadedOrNot) {
    const TemporaryFolder folder;
    const AkiMap map = mapOf(Estimator::surface, 1);
    map.saveToFile(folder.file("m.akimap"));
    const std::string expected = test::fingerprint(map);
    atEachAllocation([&](long n) {
        AkiMap::Ptr loaded;
        const End end =
            withFailure(n, [&] { loaded = AkiMap::loadFromFile(folder.file("m.akimap")); });
        EXPECT_EQ(loaded == nullptr, end == End::failed) << "allocation " << n;
        if (loaded) {
            EXPECT_EQ(test::fingerprint(*loaded), expected);
        }
        return end;
    });
}

TEST(OutOfMemory, AFileIsSavedOrTheOlderOneStays) {
    const TemporaryFolder folder;
    const std::string file = folder.file("m.akimap");
    const AkiMap older = mapOf(Estimator::surface, 1), newer = mapOf(Estimator::surface, 2);
    atEachAllocation([&](long n) {
        older.saveToFile(file);
        const End end = withFailure(n, [&] { newer.saveToFile(file); });
        EXPECT_EQ(test::fingerprint(*AkiMap::loadFromFile(file)),
                  test::fingerprint(end == End::failed ? older : newer))
            << "allocation " << n;
        EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
        return end;
    });
}

TEST(OutOfMemory, QuestionsAreAnsweredTheNextTime) {
    const AkiMap map = mapOf(Estimator::surface, 2);
    const auto answer = [](const AkiMap& m) {
        mrpt::math::TPoint3Df nearest;
        float distance = 0;
        uint64_t index = 0;
        (void)m.nn_single_search({0.1f, 0.2f, 0.3f}, nearest, distance, index);
        return std::make_pair(distance, m.squareDistanceToClosestCorrespondence(0.5f, 0.5f));
    };
    const auto expected = answer(map);
    atEachAllocation([&](long n) {
        const AkiMap asked = map;  // without the search tree, which is no part of a copy
        std::pair<float, float> got;
        const End end = withFailure(n, [&] { got = answer(asked); });
        EXPECT_EQ(end == End::failed ? answer(asked) : got, expected) << "allocation " << n;
        return end;
    });
}
