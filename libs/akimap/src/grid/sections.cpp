// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "grid/sections.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <vector>

#include "support/little_endian.h"

namespace akimap {
namespace {

constexpr std::size_t kHeader = 16;  // [bytes] tag, flags, size
constexpr std::size_t kMostText = 1 << 20;
constexpr std::size_t kAtOnce = 1 << 16;  // [bytes] of a payload of unknown use

using Number = std::array<unsigned char, sizeof(uint64_t)>;

void writeNumber(const WriteBytes& out, uint64_t v) {
    Number bytes;
    storeLittleEndian(bytes.data(), v);
    out(bytes.data(), bytes.size());
}

uint64_t readNumber(const ReadBytes& in) {
    Number bytes;
    in(bytes.data(), bytes.size());
    return loadLittleEndian<uint64_t>(bytes.data());
}

}  // namespace

std::string nameOf(const Tag& tag) {
    std::string name(tag.begin(), tag.end());
    const auto unprintable = [](unsigned char c) { return c < ' ' || c > '~'; };
    std::replace_if(name.begin(), name.end(), unprintable, '?');
    return name;
}

SectionWriter::SectionWriter(const WriteBytes& out, const Tag& tag, Need need, uint64_t size)
    : out_(out), left_(size) {
    std::array<unsigned char, kHeader> header;
    std::memcpy(header.data(), tag.data(), tag.size());
    storeLittleEndian(header.data() + 4, static_cast<uint32_t>(need));
    storeLittleEndian(header.data() + 8, size);
    out_(header.data(), header.size());
    writeNumber(out_, checksumOf(header.data(), header.size()));
}

void SectionWriter::write(const void* bytes, std::size_t size) {
    assert(size <= left_);
    left_ -= size;
    sum_.add(bytes, size);
    out_(bytes, size);
}

void SectionWriter::finish() {
    assert(left_ == 0);
    writeNumber(out_, sum_.value());
}

void writeTextSection(const WriteBytes& out, const Tag& tag, Need need, const std::string& text) {
    SectionWriter section(out, tag, need, text.size());
    section.write(text.data(), text.size());
    section.finish();
}

void writeEnd(const WriteBytes& out) {
    writeTextSection(out, kEndTag, Need::required, "");
}

bool SectionReader::next() {
    std::array<unsigned char, kHeader> header;
    in_(header.data(), header.size());
    if (readNumber(in_) != checksumOf(header.data(), header.size()))
        throw CorruptMap("a section's header is damaged");
    std::memcpy(tag_.data(), header.data(), tag_.size());
    flags_ = loadLittleEndian<uint32_t>(header.data() + 4);
    left_ = loadLittleEndian<uint64_t>(header.data() + 8);
    sum_ = Checksum();
    if (tag_ != kEndTag) return true;
    finish();
    return false;
}

void SectionReader::read(void* bytes, std::size_t size) {
    if (size > left_) throw CorruptMap("section " + name() + " is too short");
    in_(bytes, size);
    sum_.add(bytes, size);
    left_ -= size;
}

std::string SectionReader::readText() {
    if (left_ > kMostText) throw CorruptMap("section " + name() + " is too long");
    std::string text;
    while (left_ > 0) {
        const std::size_t at = text.size(), n = std::min<uint64_t>(left_, kAtOnce);
        text.resize(at + n);
        read(text.data() + at, n);
    }
    finish();
    return text;
}

void SectionReader::finish() {
    if (left_ > 0) throw CorruptMap("section " + name() + " is too long");
    if (readNumber(in_) != sum_.value()) throw CorruptMap("section " + name() + " is damaged");
}

void SectionReader::skip() {
    if (flags_ & static_cast<uint32_t>(Need::required))
        throw CorruptMap("section " + name() + " is not known to this version, and is required");
    std::vector<char> buffer(std::min<uint64_t>(left_, kAtOnce));
    while (left_ > 0) read(buffer.data(), std::min<uint64_t>(left_, buffer.size()));
    finish();
}

}  // namespace akimap
