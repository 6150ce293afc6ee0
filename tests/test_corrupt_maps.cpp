// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Map files that were damaged behind the gz layer, whose own checksum would hide all else: each is
// unpacked, changed and packed again.
#include <akimap/AkiMap.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "grid/sections.h"
#include "run_program.h"
#include "same_map.h"
#include "sanitized.h"
#include "support/gz.h"

using namespace akimap;

namespace {

std::atomic<std::size_t> largest_request{0};  ///< [bytes] of operator new

}  // namespace

// The test's own, so that what a file claims can't be allocated unseen. Not inlined: GCC takes a
// new and a free() that it sees beside each other for a mistake.
void* operator new(std::size_t size) {
    largest_request = std::max<std::size_t>(largest_request, size);
    if (void* const memory = std::malloc(size)) return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace {

const std::string kFrame =
    "\x8e"
    "akimap::AkiMap";
const std::string kVersion2 = AKIMAP_SOURCE_DIR "/tests/data/version2_options.akimap";

/** One return in a grid of 0.2 m: a few blocks. */
AkiMap tinyMap() {
    AkiMap map(0.2);
    EXPECT_TRUE(map.insertRays({Ray{{0.01, 0.01, 0.01}, {1.01, 0.01, 0.01}}}));
    return map;
}

std::string unpacked(const std::string& file) {
    GzReader gz(file);
    std::string bytes(1 << 20, '\0');
    bytes.resize(gz.readSome(bytes.data(), bytes.size()));
    return bytes;
}

/** Why a file of these bytes is refused; empty if it is taken. */
std::string refusal(const std::string& bytes) {
    const TemporaryFolder folder;
    const std::string file = folder.file("m.akimap");
    writeGz(file, [&](GzWriter& gz) { gz.Write(bytes.data(), bytes.size()); });
    try {
        (void)AkiMap::loadFromFile(file);
        return "";
    } catch (const std::runtime_error& e) {
        EXPECT_EQ(std::string(e.what()).rfind(file + ": ", 0), 0u) << e.what();
        return std::string(e.what()).substr(file.size() + 2);
    }
}

void expectRefused(const std::string& bytes, const std::string& why) {
    const std::string reason = refusal(bytes);
    EXPECT_NE(reason.find(why), std::string::npos) << "'" << reason << "' is not: " << why;
    EXPECT_EQ(reason.find('\n'), std::string::npos) << reason;
}

void readFrom(const std::string& bytes, AkiMap& map) {
    mrpt::io::CMemoryStream stream;
    stream.Write(bytes.data(), bytes.size());
    stream.Seek(0);
    auto archive = mrpt::serialization::archiveFrom(stream);
    archive >> map;
}

struct Part {
    std::string tag;
    Need need;
    std::string payload;
};
using Parts = std::vector<Part>;

/** The stream of a map of these sections, with right sizes and checksums. */
std::string streamOf(const Parts& parts) {
    std::string bytes = kFrame + '\3';
    const WriteBytes append = [&](const void* from, std::size_t n) {
        bytes.append(static_cast<const char*>(from), n);
    };
    for (const Part& p : parts)
        writeTextSection(append, {p.tag[0], p.tag[1], p.tag[2], p.tag[3]}, p.need, p.payload);
    return bytes + '\x88';
}

/** The sections of the tiny map, by what doc/format.md says of headers. */
Parts partsOfTinyMap() {
    const std::string bytes = test::bytes(tinyMap());
    Parts parts;
    for (std::size_t at = kFrame.size() + 1; at + 1 < bytes.size();) {
        const auto number = [&](std::size_t offset) {
            uint64_t v = 0;
            for (std::size_t i = 8; i-- > 0;)
                v = v << 8 | static_cast<unsigned char>(bytes[at + offset + i]);
            return v;
        };
        const bool required = number(0) >> 63;
        const std::size_t size = number(8);
        parts.push_back({bytes.substr(at, 4), required ? Need::required : Need::optional,
                         bytes.substr(at + 24, size)});
        at += 24 + size + 8;
    }
    return parts;
}

Part& part(Parts& parts, const std::string& tag) {
    for (Part& p : parts)
        if (p.tag == tag) return p;
    throw std::out_of_range(tag);
}

/** Expects that the tiny map is refused after a change of one section's payload. */
template <class Change>
void expectRefusedWith(const std::string& tag, Change&& change, const std::string& why) {
    Parts parts = partsOfTinyMap();
    change(part(parts, tag).payload);
    expectRefused(streamOf(parts), why);
}

void replace(std::string& text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
}

void putWord(std::string& bytes, std::size_t at, uint32_t word) {
    for (std::size_t i = 0; i < 4; i++) bytes.at(at + i) = static_cast<char>(word >> 8 * i);
}

}  // namespace

TEST(CorruptMap, TheTestsPartsMakeTheMapAgain) {
    EXPECT_EQ(streamOf(partsOfTinyMap()), test::bytes(tinyMap()));
    EXPECT_EQ(refusal(streamOf(partsOfTinyMap())), "");
}

TEST(CorruptMap, ObjectsOfOtherClassesAreRefusedByNameAndNeverBuilt) {
    const std::string name = "mrpt::maps::CSimpleMap";
    const std::string head = static_cast<char>(0x80 | name.size()) + name + '\1';
    expectRefused(head + std::string(200, '\0'), "no AkiMap: it holds a " + name);
    expectRefused("\x87nullptr\x88", "no AkiMap: it holds a nullptr");
    expectRefused("not a map at all", "no AkiMap");
    expectRefused(std::string("\x83\1\2\3\1", 5), "no AkiMap");
    expectRefused("", "");
    expectRefused(kFrame + '\4', "format 4");
    expectRefused(kFrame + '\0', "format 0");
}

TEST(CorruptMap, WhatIsMissingOrTooMuchIsNoticed) {
    const std::string whole = test::bytes(tinyMap());
    for (std::size_t n = 1; n < whole.size(); n += n < 2000 ? 7 : 501)
        EXPECT_NE(refusal(whole.substr(0, n)), "") << n;
    expectRefused(whole.substr(0, whole.size() - 1), "its end is missing");
    expectRefused(whole + '\0', "data behind the map");
    expectRefused(whole.substr(0, whole.size() - 1) + '\0', "no end flag");
    for (std::size_t n = 20; n < whole.size(); n += 1009) {
        AkiMap target(0.5);
        EXPECT_THROW(readFrom(whole.substr(0, n), target), std::exception) << n;
        EXPECT_EQ(target.resolution(), 0.5);
    }
}

TEST(CorruptMap, TheGzLayerIsChecked) {
    const TemporaryFolder folder;
    const std::string file = folder.file("m.akimap");
    tinyMap().saveToFile(file);
    const std::string gz = readText(file);
    const auto expectBad = [&](const std::string& bytes, const std::string& why) {
        writeText(file, bytes);
        try {
            (void)AkiMap::loadFromFile(file);
            ADD_FAILURE() << why << " was not noticed";
        } catch (const std::runtime_error& e) {
            EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
        }
    };
    for (std::size_t missing = 1; missing < 40; missing++)
        expectBad(gz.substr(0, gz.size() - missing), "its end is missing");
    for (std::size_t back = 1; back <= 8; back++) {  // checksum and size
        std::string bytes = gz;
        bytes[bytes.size() - back] ^= 1;
        expectBad(bytes, "the compressed data are damaged");
    }
    expectBad(gz + "x", "its end is missing");
    expectBad(gz + "no gz, and so long that it can't be the beginning of one", "are damaged");
    expectBad(gz + gz, "data behind the map");
}

TEST(CorruptMap, SectionsAreWhereAndWhatTheyMustBe) {
    const Parts parts = partsOfTinyMap();
    for (const char* tag : {"INSO", "BLKS", "CELL"}) {
        Parts without = parts;
        without.erase(without.begin() + (&part(without, tag) - without.data()));
        expectRefused(streamOf(without),
                      tag == std::string("BLKS")   ? "section CELL comes before BLKS"
                      : tag == std::string("CELL") ? "section SURF comes before CELL"
                                                   : std::string("section ") + tag + " is missing");
    }
    Parts changed = parts;
    std::swap(changed[0], changed[1]);
    expectRefused(streamOf(changed), "its first section is not HEAD");
    changed = parts;
    std::swap(part(changed, "BLKS"), part(changed, "CELL"));
    expectRefused(streamOf(changed), "section CELL comes before BLKS");
    changed = parts;
    changed.insert(changed.begin() + 1, part(changed, "INSO"));
    expectRefused(streamOf(changed), "section INSO twice");
    expectRefusedWith(
        "END ", [](auto& p) { p = "x"; }, "section END  is too long");
    std::string bytes = streamOf(parts);
    bytes[kFrame.size() + 1 + 24] ^= 1;  // of the first payload
    expectRefused(bytes, "section HEAD is damaged");
    bytes = streamOf(parts);
    bytes[kFrame.size() + 1 + 8] ^= 1;  // of the first size
    expectRefused(bytes, "a section's header is damaged");
}

TEST(CorruptMap, UnknownSectionsAreSkippedUnlessRequired) {
    Parts parts = partsOfTinyMap();
    parts.insert(parts.end() - 1, {"new1", Need::optional, std::string(200000, 'x')});
    EXPECT_EQ(refusal(streamOf(parts)), "");
    parts.insert(parts.end() - 1, {"new2", Need::required, "x"});
    expectRefused(streamOf(parts), "section new2 is not known to this version, and is required");
    for (const char* tag : {"LIKO", "RENO"}) {
        Parts without = partsOfTinyMap();
        without.erase(without.begin() + (&part(without, tag) - without.data()));
        EXPECT_EQ(refusal(streamOf(without)), "") << tag;
    }
}

TEST(CorruptMap, UnknownOptionsAreSkippedUnlessRequired) {
    Parts parts = partsOfTinyMap();
    for (const char* tag : {"HEAD", "INSO", "LIKO", "RENO"})
        part(parts, tag).payload += "of_tomorrow = 5 and more\n";
    EXPECT_EQ(refusal(streamOf(parts)), "");
    for (const char* tag : {"HEAD", "INSO", "LIKO", "RENO"})
        expectRefusedWith(
            tag, [](auto& p) { p += "!of_tomorrow = 5\n"; },
            std::string("option of_tomorrow of section ") + tag +
                " is not known to this version, and is required");
}

TEST(CorruptMap, BadOptionsAreRefusedByName) {
    const auto expectBad = [](const char* tag, const char* from, const char* to,
                              const std::string& why) {
        expectRefusedWith(
            tag, [&](auto& p) { replace(p, from, to); }, why);
    };
    expectBad("HEAD", "resolution = 0.2", "resolution = -1", "resolution = -1");
    expectBad("HEAD", "resolution = 0.2", "resolution = big", "resolution = big");
    expectBad("HEAD", "!resolution = 0.2\n", "", "resolution = 0");
    expectBad("HEAD", "enableSaveAs3DObject = 1", "enableSaveAs3DObject = 2",
              "enableSaveAs3DObject is neither 0 nor 1");
    expectBad("INSO", "max_range = 8", "max_range = nan", "max_range = nan");
    expectBad("INSO", "estimator = surface", "estimator = guess", "estimator = 'guess'");
    expectBad("RENO", "show_free = false", "show_free = 7", "show_free = '7'");
    expectBad("LIKO", "decimation = 1", "decimation = -1", "decimation = '-1'");
    const char* no_line = "section LIKO has a line that is not name = value";
    expectBad("LIKO", "decimation = 1\n", "decimation\n", no_line);
    expectBad("LIKO", "decimation = 1\n", " = 1\n", no_line);
    expectBad("LIKO", "decimation = 1\n", "\n", no_line);
    expectRefusedWith(
        "LIKO", [](auto& p) { p.pop_back(); }, no_line);
    expectRefusedWith(
        "LIKO", [](auto& p) { p += "decimation = 2\n"; }, "section LIKO has decimation twice");
    expectRefusedWith(
        "LIKO", [](auto& p) { p += "x = " + std::string(1 << 20, 'x') + "\n"; },
        "section LIKO is too long");
}

TEST(CorruptMap, BlocksAndCellsAreChecked) {
    const uint32_t nan = 0x7fc00000u, minus_one = 0xbf800000u, minus_zero = 0x80000000u;
    expectRefusedWith(
        "BLKS", [](auto& p) { p += 'x'; }, "section BLKS is too short");
    expectRefusedWith(
        "BLKS", [](auto& p) { putWord(p, 0, 1 << 20); }, "a block lies outside the grid");
    expectRefusedWith(
        "BLKS", [](auto& p) { p.replace(12, 12, p.substr(0, 12)); }, "its blocks are out of order");
    expectRefusedWith(
        "BLKS", [](auto& p) { p += std::string(12, '\1'); }, "a block lies outside");
    expectRefusedWith(
        "CELL", [](auto& p) { p.resize(p.size() - 4096); },
        "its cells are not those of its blocks");
    expectRefusedWith(
        "CELL", [](auto& p) { p += 'x'; }, "its cells are not those of its blocks");
    for (const uint32_t bad : {nan, minus_one, minus_zero})
        expectRefusedWith(
            "CELL", [&](auto& p) { putWord(p, 400, bad); }, "a cell is negative or not finite");
    expectRefusedWith(
        "CELL", [](auto& p) { p.replace(0, 4096, 4096, '\0'); }, "a block without evidence");
    expectRefusedWith(
        "SURF", [](auto& p) { putWord(p, 0, 1 << 20); }, "surfaces of a block that is not there");
    expectRefusedWith(
        "SURF", [](auto& p) { p += p; }, "surfaces of a block that is not there, or out of order");
    expectRefusedWith(
        "SURF", [](auto& p) { p += 'x'; }, "section SURF is too short");
    for (const uint32_t bad : {nan, minus_one})
        expectRefusedWith(
            "SURF", [&](auto& p) { putWord(p, 4 + 400, bad); },
            "a surface is negative or not finite");
}

/** Where things are in a stream of format 2: 16 bytes of frame, 8 of resolution, 34 of name, 1 of
 * version, 3 switches, 1 end flag; then the options one behind the other. */
TEST(CorruptMap, OlderFormatsAreCheckedToo) {
    const std::string whole = unpacked(kVersion2);
    const std::size_t switches = whole.find("TMapGenericParams") + 18, options = switches + 4;
    const std::size_t show_free =
        options + 16 + 1 + 1 + 24 + 24 + 1 + 1 + 8 + 1 + 8 + 1 + 32 + 8 + 4 + 32 + 8;
    const std::size_t count = show_free + 1 + 4 + 8, block = count + 8;
    const auto expectBad = [&](std::size_t at, uint32_t word, std::size_t size,
                               const std::string& why) {
        std::string bytes = whole;
        for (std::size_t i = 0; i < size; i++) bytes[at + i] = static_cast<char>(word >> 8 * i);
        expectRefused(bytes, why);
    };
    EXPECT_EQ(refusal(whole), "");
    expectBad(switches, 7, 1, "a switch is neither 0 nor 1");
    expectBad(options + 16, 9, 1, "beyond_max_range = 9");
    expectBad(options + 17, 9, 1, "estimator = 9");
    expectBad(show_free, 7, 1, "show_free = 7: must be 0 or 1");
    expectBad(block, 1 << 20, 4, "a block lies outside the grid");
    expectBad(block + 12, 0x7fc00000u, 4, "a cell is negative or not finite");
    expectBad(count, 200, 4, "its end is missing");
    std::string twice = whole;
    twice.replace(block + 4108, 12, whole.substr(block, 12));
    expectRefused(twice, "its blocks are out of order");
    std::string empty = whole;
    empty.replace(block + 12, 4096, 4096, '\0');
    expectRefused(empty, "a block without evidence");
    for (std::size_t n = 0; n < whole.size(); n += n < 400 ? 3 : 997)
        EXPECT_NE(refusal(whole.substr(0, n)), "") << n;
}

TEST(CorruptMap, AnyOneBitFlippedIsNoticedAndLeavesTheMapAsItWas) {
    const AkiMap map = tinyMap();
    const std::string whole = test::bytes(map);
    AkiMap target(0.5);
    const std::string before = test::bytes(target);
    std::string bytes = whole;
    std::size_t refused = 0;
    for (std::size_t bit = 0; bit < 8 * whole.size(); bit += bit < 8 * 3000 ? 1 : 11) {
        bytes[bit / 8] = static_cast<char>(whole[bit / 8] ^ 1 << bit % 8);
        try {
            readFrom(bytes, target);
            EXPECT_EQ(test::bytes(target), whole) << "bit " << bit;
            target = AkiMap(0.5);
        } catch (const std::exception&) {
            refused++;
            const bool is_frame = bit / 8 + 1 == whole.size();  // MRPT's end flag comes too late
            if (bit % 5 == 0 && !is_frame) {
                EXPECT_EQ(test::bytes(target), before) << "bit " << bit;
            }
        }
        bytes[bit / 8] = whole[bit / 8];
    }
    EXPECT_GT(refused, 8 * 3000u - 8);
}

TEST(CorruptMap, ClaimsOfHugeSizesAreNeverAllocated) {
    const uint64_t huge = uint64_t{12} << 50;
    const std::string whole = streamOf(partsOfTinyMap());
    const auto upTo = [&](const char* tag) { return whole.substr(0, whole.find(tag)); };
    const auto claim = [&](const char* tag) {
        std::string bytes;
        const WriteBytes append = [&](const void* from, std::size_t n) {
            bytes.append(static_cast<const char*>(from), n);
        };
        SectionWriter(append, {tag[0], tag[1], tag[2], tag[3]}, Need::optional, huge);
        return bytes + std::string(1000, '\0');
    };
    std::vector<std::string> streams;
    for (const char* tag : {"HEAD", "INSO", "BLKS", "CELL"})
        streams.push_back(upTo(tag) + claim(tag));
    streams.push_back(upTo("BLKS") + claim("more"));
    std::string old = unpacked(kVersion2);
    const std::size_t count = old.find("TMapGenericParams") + 22 + 16 + 1 + 1 + 24 + 24 + 1 + 1 +
                              8 + 1 + 8 + 1 + 32 + 8 + 4 + 32 + 8 + 1 + 4 + 8;
    old.replace(count, 8, "\xff\xff\xff\xff\xff\xff\xff\x7f");
    streams.push_back(old);
    for (const std::string& bytes : streams) {
        largest_request = 0;
        EXPECT_NE(refusal(bytes), "");
        EXPECT_LT(largest_request, (1u << 18) + 4 * bytes.size());
    }
}

/** gz can hold a thousand times its size, and cells that are all alike come near that. */
TEST(CorruptMap, MoreCellsThanThereIsMemoryForEndInOneLine) {
    if (sanitized()) GTEST_SKIP() << "sanitizers take the whole address space";
    Parts parts = partsOfTinyMap();
    const std::string block = part(parts, "CELL").payload.substr(0, 4096);
    std::string &places = part(parts, "BLKS").payload, &cells = part(parts, "CELL").payload;
    places.clear(), cells.clear();
    for (uint32_t i = 0; i < 60000; i++) {
        const std::size_t at = places.size();
        places.resize(at + 12);
        putWord(places, at, i);
        cells += block;
    }
    const TemporaryFolder folder;
    const std::string file = folder.file("m.akimap"), bytes = streamOf(parts);
    writeGz(file, [&](GzWriter& gz) { gz.Write(bytes.data(), bytes.size()); });
    EXPECT_LT(std::filesystem::file_size(file), bytes.size() / 50);
    const auto run =
        runCommand("ulimit -v 400000 && '" AKIMAP_PROGRAM "' info '" + file + "'");  // [kB]
    EXPECT_EQ(run.exit, 1);
    EXPECT_EQ(run.err.rfind("akimap: out of memory", 0), 0u) << run.err;
    EXPECT_EQ(run.err.find('\n'), run.err.size() - 1) << run.err;
}
