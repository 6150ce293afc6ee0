// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

#include "grid/checksum.h"

// A map file's sections, doc/format.md: a tag, flags, size and their checksum; the payload; its
// checksum. A reader steps over sections that it does not know unless they are required.

namespace akimap {

/** What a stream holds is no map, or a damaged one. */
struct CorruptMap : std::runtime_error {
    explicit CorruptMap(const std::string& what) : std::runtime_error("corrupt AkiMap: " + what) {}
};

/** Takes so many bytes, or throws. */
using WriteBytes = std::function<void(const void* bytes, std::size_t size)>;
/** Gives exactly so many bytes, or throws. */
using ReadBytes = std::function<void(void* bytes, std::size_t size)>;

/** Four characters. */
using Tag = std::array<char, 4>;
constexpr Tag tag(const char (&name)[5]) {
    return {name[0], name[1], name[2], name[3]};
}
constexpr Tag kEndTag = tag("END ");
/** For messages: what can't be printed as '?'. */
[[nodiscard]] std::string nameOf(const Tag& tag);

/** Whether a reader that does not know the section must refuse the map. The highest bit of the
 * flags: formats 1 and 2 have a number > 0 where format 3 has its first section's tag and flags,
 * which are a negative number by it. */
enum class Need : uint32_t { optional = 0, required = 0x80000000u };

/** Writes one section, in pieces that come to the size that was announced. */
class SectionWriter {
 public:
    SectionWriter(const WriteBytes& out, const Tag& tag, Need need, uint64_t size);
    void write(const void* bytes, std::size_t size);
    /** \pre all of it was written */
    void finish();

 private:
    const WriteBytes& out_;
    uint64_t left_;
    Checksum sum_;
};

void writeTextSection(const WriteBytes& out, const Tag& tag, Need need, const std::string& text);
void writeEnd(const WriteBytes& out);

/** Reads sections one after the other. Nothing is allocated for what a header claims, only for
 * what has been read. All throw CorruptMap on damage. */
class SectionReader {
 public:
    explicit SectionReader(const ReadBytes& in) : in_(in) {}

    /** Reads the next header; false at the end of the map. */
    bool next();
    [[nodiscard]] const Tag& tag() const { return tag_; }
    [[nodiscard]] std::string name() const { return nameOf(tag_); }
    [[nodiscard]] uint64_t left() const { return left_; }  ///< [bytes] of the payload

    void read(void* bytes, std::size_t size);
    /** The payload whole, and its end; at most 1 MiB. */
    [[nodiscard]] std::string readText();
    /** Behind the payload, all of which was read. */
    void finish();
    /** Steps over a section that this reader does not know, unless it is required. */
    void skip();

 private:
    const ReadBytes& in_;
    Tag tag_{};
    uint32_t flags_ = 0;
    uint64_t left_ = 0;
    Checksum sum_;
};

}  // namespace akimap
