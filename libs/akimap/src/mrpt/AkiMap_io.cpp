// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// doc/format.md says what is in a map's file and stream.
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <set>
#include <stdexcept>

#include "grid/grid_sections.h"
#include "grid/named_values.h"
#include "mrpt/Impl.h"
#include "mrpt/mrpt_compat.h"
#include "support/AtomicFile.h"
#include "support/gz.h"
#include "support/numbers.h"

namespace akimap {
namespace {

using mrpt::serialization::CArchive;

constexpr Tag kHeadTag = tag("HEAD"), kInsertionTag = tag("INSO"), kLikelihoodTag = tag("LIKO"),
              kRenderingTag = tag("RENO");

// MRPT's frame of an object: the length of its class' name with the highest bit set, the name, the
// version, the object, a flag. Read by hand, as MRPT builds whatever class is named before anybody
// can refuse it.
constexpr const char* kClassName = "akimap::AkiMap";
constexpr uint8_t kNameFlag = 0x80, kEndFlag = 0x88;

/** All of the bytes: MRPT's own operators take fewer, and go on. */
ReadBytes readerOf(CArchive& in) {
    return [&in](void* bytes, std::size_t size) {
        if (in.ReadBuffer(bytes, size) != size) throw CorruptMap("its end is missing");
    };
}

/** Little endian, as every machine that MRPT's packages are built for. */
template <class Number>
Number readNumber(const ReadBytes& read) {
    Number v{};
    read(&v, sizeof v);
    return v;
}

/** \return the version */
uint8_t readFrameHead(CArchive& in) {
    const auto length = in.ReadAs<uint8_t>();
    std::string name(length & (kNameFlag - 1), ' ');
    if (length & kNameFlag) readerOf(in)(name.data(), name.size());
    const auto isPrintable = [](unsigned char c) { return std::isgraph(c) != 0; };
    if (name.empty() || !std::all_of(name.begin(), name.end(), isPrintable))
        throw std::runtime_error("no AkiMap");
    if (name != kClassName) throw std::runtime_error("no AkiMap: it holds a " + name);
    return in.ReadAs<uint8_t>();
}

template <class Number>
void readValue(NamedValues& values, const char* name, Number& value) {
    if (const std::string* text = values.take(name); text && !parseNumber(*text, value))
        throw CorruptMap(std::string(name) + " = " + *text);
}
void readValue(NamedValues& values, const char* name, bool& value) {
    uint8_t v = value;
    readValue(values, name, v);
    if (v > 1) throw CorruptMap(std::string(name) + " is neither 0 nor 1");
    value = v;
}

/** MRPT reads any byte into a bool. */
void requireBool(const bool& value) {
    uint8_t byte = 0;
    std::memcpy(&byte, &value, sizeof byte);
    if (byte > 1) throw CorruptMap("a switch is neither 0 nor 1");
}

/** As MRPT's own files are: one object, gz. */
void saveObject(const mrpt::serialization::CSerializable& object, const std::string& file) {
    writeAtomically(file, [&](const std::string& path) {
        writeGz(path, [&](GzWriter& gz) { mrpt::serialization::archiveFrom(gz) << object; });
    });
}

/** What went wrong, without the banners and call stacks that MRPT wraps it in. */
std::string ourReason(const std::string& what) {
    const auto at = what.find("corrupt AkiMap: ");
    if (at != std::string::npos) return what.substr(at, what.find('\n', at) - at);
    return what.find('\n') == std::string::npos ? what : "damaged, or not a map";
}

}  // namespace

uint8_t AkiMap::serializeGetVersion() const {
    return 3;
}

void AkiMap::serializeTo(CArchive& out) const {
    insertionOptions.validate();  // what was set in code: no map is written that can't be read
    likelihoodOptions.validate();
    renderingOptions.validate();
    const WriteBytes write = [&](const void* bytes, std::size_t n) { out.WriteBuffer(bytes, n); };
    const auto flag = [](bool v) { return std::string(v ? "1" : "0"); };
    const auto& g = genericMapParams;
    writeTextSection(
        write, kHeadTag, Need::required,
        lineOf({"resolution", numberText(resolution()), true}) +
            lineOf({"scan_index", numberText(impl_->next_scan)}) +
            lineOf({"enableSaveAs3DObject", flag(g.enableSaveAs3DObject)}) +
            lineOf({"enableObservationLikelihood", flag(g.enableObservationLikelihood)}) +
            lineOf({"enableObservationInsertion", flag(g.enableObservationInsertion)}));
    writeTextSection(write, kInsertionTag, Need::required, insertionOptions.toText());
    writeTextSection(write, kLikelihoodTag, Need::optional, likelihoodOptions.toText());
    writeTextSection(write, kRenderingTag, Need::optional, renderingOptions.toText());
    writeGrid(write, impl_->grid);
    writeEnd(write);
}

void AkiMap::serializeFrom(CArchive& in, uint8_t version) {
    if (version < 1 || version > serializeGetVersion())
        throw std::runtime_error("an AkiMap of format " + std::to_string(version) +
                                 ", which this version does not know");
    AkiMap loaded;
    if (version < 3)
        loaded.readFormat1Or2(in, version);
    else
        loaded.readSections(in);
    loaded.insertionOptions.threads = insertionOptions.threads;  // no part of a map
    *this = std::move(loaded);
}

void AkiMap::readHead(const std::string& text) {
    NamedValues values("HEAD", text);
    double resolution = 0;
    uint64_t scan_index = 0;
    readValue(values, "resolution", resolution);
    readValue(values, "scan_index", scan_index);
    readValue(values, "enableSaveAs3DObject", genericMapParams.enableSaveAs3DObject);
    readValue(values, "enableObservationLikelihood", genericMapParams.enableObservationLikelihood);
    readValue(values, "enableObservationInsertion", genericMapParams.enableObservationInsertion);
    values.requireNoneLeft();
    setResolution(resolution);
    impl_->next_scan = scan_index;
}

void AkiMap::readSections(CArchive& in) {
    const ReadBytes read = readerOf(in);
    SectionReader section(read);
    std::vector<BlockGrid::BlockIndex> blocks;
    std::set<Tag> met;
    while (section.next()) {
        const Tag& tag = section.tag();
        if (met.empty() != (tag == kHeadTag)) throw CorruptMap("its first section is not HEAD");
        if (!met.insert(tag).second) throw CorruptMap("section " + section.name() + " twice");
        if (tag == kHeadTag)
            readHead(section.readText());
        else if (tag == kInsertionTag)
            insertionOptions.fromText(section.name(), section.readText());
        else if (tag == kLikelihoodTag)
            likelihoodOptions.fromText(section.name(), section.readText());
        else if (tag == kRenderingTag)
            renderingOptions.fromText(section.name(), section.readText());
        else if (tag == kBlocksTag)
            blocks = readBlocks(section);
        else if (tag == kCellsTag && met.count(kBlocksTag))
            readCells(section, blocks, impl_->grid);
        else if (tag == kCellsTag)
            throw CorruptMap("section CELL comes before BLKS");
        else if (tag == kSurfacesTag && met.count(kCellsTag))
            readSurfaces(section, blocks, impl_->grid);
        else if (tag == kSurfacesTag)
            throw CorruptMap("section SURF comes before CELL");
        else
            section.skip();
    }
    for (const Tag& tag : {kHeadTag, kInsertionTag, kBlocksTag, kCellsTag})
        if (!met.count(tag)) throw CorruptMap("section " + nameOf(tag) + " is missing");
}

void AkiMap::readFormat1Or2(CArchive& in, uint8_t version) {
    const auto read = readerOf(in);
    setResolution(readNumber<double>(read));
    in >> genericMapParams;
    requireBool(genericMapParams.enableSaveAs3DObject);
    requireBool(genericMapParams.enableObservationLikelihood);
    requireBool(genericMapParams.enableObservationInsertion);
    insertionOptions.readFromStream(in, version);
    likelihoodOptions.readFromStream(in, version);
    renderingOptions.readFromStream(in, version);
    impl_->next_scan = readNumber<uint64_t>(read);
    const auto count = readNumber<uint64_t>(read);
    BlockGrid::BlockIndex previous;
    for (uint64_t i = 0; i < count; i++) {
        BlockGrid::BlockIndex b;
        for (int32_t* v : {&b.x, &b.y, &b.z}) *v = readNumber<int32_t>(read);
        checkPlace(i > 0 ? &previous : nullptr, b);
        impl_->grid.adopt(b, readBlock(read));
        previous = b;
    }
}

void AkiMap::saveToFile(const std::string& file) const {
    saveObject(*this, file);
}

AkiMap::Ptr AkiMap::loadFromFile(const std::string& file) {
    try {
        GzReader gz(file);
        auto in = mrpt::serialization::archiveFrom(gz);
        auto map = AkiMap::Create();
        map->serializeFrom(in, readFrameHead(in));
        if (in.ReadAs<uint8_t>() != kEndFlag) throw CorruptMap("no end flag");
        char more = 0;
        if (gz.readSome(&more, 1) != 0) throw CorruptMap("data behind the map");
        if (gz.isCut()) throw CorruptMap("its end is missing");
        return map;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        throw std::runtime_error(file + ": " + ourReason(e.what()));
    }
}

void AkiMap::saveMetricMapRepresentationToFile(const std::string& prefix) const {
    saveToFile(prefix + ".akimap");
    SceneObject scene;
    auto objects = mrpt::opengl::CSetOfObjects::Create();
    getVisualizationInto(*objects);
    scene.insert(objects);
    saveObject(scene, prefix + "_3D.3Dscene");
}

}  // namespace akimap
