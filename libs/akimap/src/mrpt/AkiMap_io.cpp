// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/serialization/CArchive.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <type_traits>

#include "mrpt/Impl.h"
#include "mrpt/mrpt_compat.h"

namespace akimap {
namespace {

constexpr const char* kCorrupt = "corrupt AkiMap: ";

[[noreturn]] void corrupt(const std::string& what) {
    throw std::runtime_error(kCorrupt + what);
}

/** A block in a stream: words of 32 bits, alpha before beta. */
struct Record {
    BlockGrid::BlockIndex index;
    std::array<float, 2 * Block::kCells> sums;
};
static_assert(sizeof(Record::sums) == sizeof(Block) && std::is_trivially_copyable_v<Block>);
static_assert(sizeof(Record) == sizeof(Record::index) + sizeof(Record::sums));

/** Few large writes: MRPT's memory stream, through which particles are copied, grows at each. */
constexpr std::size_t kRecordsAtOnce = 64;

/** \exception std::runtime_error unless the sums are finite, >= 0 and not all 0 */
void checkSums(const Block& block) {
    constexpr uint32_t kSign = 0x80000000u, kInfinity = 0x7f800000u;  // of an IEEE 754 float
    std::array<uint32_t, 2 * Block::kCells> bits;
    std::memcpy(bits.data(), &block, sizeof(block));
    uint32_t any = 0, overflow = 0;  // on bits and without a way out, so that it runs on whole rows
    for (const uint32_t b : bits) any |= b, overflow |= b + (kSign - kInfinity);
    if ((any | overflow) & kSign) corrupt("a cell is negative or not finite");
    if (any == 0) corrupt("a block without evidence");
}

/** A path beside the wanted file, removed again unless it is renamed to it. */
class FileBeside {
 public:
    explicit FileBeside(std::string file)
        : file_(std::move(file)), beside_(file_ + ".tmp" + std::to_string(getpid())) {}
    ~FileBeside() { std::remove(beside_.c_str()); }
    FileBeside(const FileBeside&) = delete;
    FileBeside& operator=(const FileBeside&) = delete;
    [[nodiscard]] const std::string& path() const { return beside_; }
    void rename() const {
        if (std::rename(beside_.c_str(), file_.c_str()) != 0)
            throw std::runtime_error(file_ + ": can't be written");
    }

 private:
    std::string file_, beside_;
};

/** Whether a gz file of so many bytes was written to its end: it closes with their number, modulo
 * 2^32, little-endian. */
bool isWhole(const std::string& gz_file, uint64_t bytes) {
    std::ifstream in(gz_file, std::ios::binary);
    in.seekg(-4, std::ios::end);
    uint32_t size = 0;
    for (int shift = 0; shift < 32; shift += 8)
        size |= static_cast<uint32_t>(in.get() & 0xff) << shift;
    return in.good() && size == static_cast<uint32_t>(bytes);
}

/** Our own reason within a message: MRPT wraps it in banners and call stacks. */
std::string ourReason(const std::string& what) {
    const auto at = what.find(kCorrupt);
    return at == std::string::npos ? "damaged, or not a map"
                                   : what.substr(at, what.find('\n', at) - at);
}

}  // namespace

uint8_t AkiMap::serializeGetVersion() const {
    return 2;  // 1: without the options of firstVersionOf()
}

void AkiMap::serializeTo(mrpt::serialization::CArchive& out) const {
    out << resolution() << genericMapParams;
    insertionOptions.writeToStream(out);
    likelihoodOptions.writeToStream(out);
    renderingOptions.writeToStream(out);
    out << impl_->next_scan << static_cast<uint64_t>(impl_->grid.blockCount());
    std::vector<Record> records;
    const auto write = [&] {
        out.WriteBufferFixEndianness(reinterpret_cast<const uint32_t*>(records.data()),
                                     records.size() * (sizeof(Record) / sizeof(uint32_t)));
        records.clear();
    };
    records.reserve(std::min(kRecordsAtOnce, impl_->grid.blockCount()));
    for (const auto& [b, block] : impl_->grid.sortedBlocks()) {
        Record& record = records.emplace_back();
        record.index = b;
        std::memcpy(&record.sums, block, sizeof(record.sums));
        if (records.size() == kRecordsAtOnce) write();
    }
    if (!records.empty()) write();
}

void AkiMap::serializeFrom(mrpt::serialization::CArchive& in, uint8_t version) {
    if (version != 1 && version != 2) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
    AkiMap loaded(in.ReadAs<double>());
    in >> loaded.genericMapParams;
    loaded.insertionOptions.readFromStream(in, version);
    loaded.likelihoodOptions.readFromStream(in, version);
    loaded.renderingOptions.readFromStream(in, version);
    in >> loaded.impl_->next_scan;
    auto left = in.ReadAs<uint64_t>();
    loaded.impl_->grid.reserve(std::min<uint64_t>(left, 1 << 16));  // the number may be wrong
    uint64_t previous = 0;
    for (; left > 0; --left) {
        BlockGrid::BlockIndex b;
        in >> b.x >> b.y >> b.z;
        if (!BlockGrid::isAddressable(b)) corrupt("a block lies outside the grid");
        if (!loaded.isEmpty() && packKey(b) <= previous) corrupt("its blocks are out of order");
        previous = packKey(b);
        const std::shared_ptr<Block> block(new Block);  // uninitialized
        in.ReadBufferFixEndianness(reinterpret_cast<float*>(block.get()),
                                   sizeof(Block) / sizeof(float));
        checkSums(*block);
        loaded.impl_->grid.adopt(b, block);
    }
    *this = std::move(loaded);
}

void AkiMap::saveToFile(const std::string& file) const {
    const FileBeside beside(file);
    uint64_t written = 0;
    try {
        mrpt::io::CFileGZOutputStream f;
        if (!f.open(beside.path(), 1)) throw std::runtime_error("can't be opened");
        auto archive = mrpt::serialization::archiveFrom(f);
        archive << *this;
        written = f.getPosition();
        f.close();
    } catch (const std::exception&) {
        throw std::runtime_error(file + ": can't be written");
    }
    // MRPT's stream does not tell whether its last, compressed block found room on the disk.
    if (!isWhole(beside.path(), written))
        throw std::runtime_error(file + ": can't be written whole; is the disk full?");
    beside.rename();
}

AkiMap::Ptr AkiMap::loadFromFile(const std::string& file) {
    if (!std::filesystem::is_regular_file(file)) throw std::runtime_error(file + ": no such file");
    try {
        mrpt::io::CFileGZInputStream f;
        if (!f.open(file)) corrupt("it can't be opened");
        auto archive = mrpt::serialization::archiveFrom(f);
        auto map = std::dynamic_pointer_cast<AkiMap>(archive.ReadObject());
        if (!map) corrupt("it holds something else");
        char more = 0;
        if (f.Read(&more, 1) != 0) corrupt("data behind the map");
        if (!isWhole(file, f.getPosition())) corrupt("its end is missing");
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
    const FileBeside beside(prefix + "_3D.3Dscene");
    if (!scene.saveToFile(beside.path()))
        throw std::runtime_error(prefix + "_3D.3Dscene: can't be written");
    beside.rename();
}

}  // namespace akimap
