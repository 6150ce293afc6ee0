// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/ObjectReader.h"

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <vector>

#include "errors.h"
#include "input/files.h"

namespace akimap::app {

using mrpt::serialization::CSerializable;

namespace {

/** A file that is there, plain or gz. */
class WholeFile : public ByteSource {
 public:
    explicit WholeFile(const std::string& file) {
        requireReadable(file);
        if (!gz_.open(file)) throw std::runtime_error(file + ": can't be read");
    }
    size_t read(void* buffer, size_t count) override {
        const size_t n = gz_.Read(buffer, count);
        // zlib's -1 for a wrong checksum or code arrives as a huge unsigned number.
        if (n > count) throw std::runtime_error("the compressed data are damaged");
        return n;
    }

 private:
    mrpt::io::CFileGZInputStream gz_;
};

}  // namespace

/** What CArchive needs of a stream. Unlike MRPT's streams it refuses a read that gets fewer bytes
 * than asked for, where CArchive would go on with half-filled numbers and vectors. */
class ObjectReader::Stream {
 public:
    explicit Stream(std::unique_ptr<ByteSource> source) : source_(std::move(source)) {}

    size_t Read(void* buffer, size_t count) {
        const size_t n = readSome(buffer, count);
        position += n;
        if (n < count) {
            at_end = true;
            throw std::runtime_error("the file ends here");
        }
        return n;
    }
    size_t Write(const void*, size_t) { throw std::logic_error("this stream is for reading"); }
    std::string getStreamDescription() const { return "the file"; }

    uint64_t position = 0;  ///< [bytes] unpacked
    bool at_end = false;
    std::string failure;                  ///< of the source; MRPT may wrap what it throws
    std::vector<uint32_t> object_starts;  ///< low 32 bits of the positions between objects

 private:
    size_t readSome(void* buffer, size_t count) {
        try {
            return source_->read(buffer, count);
        } catch (const std::exception& e) {
            failure = e.what();
            throw;
        }
    }

    std::unique_ptr<ByteSource> source_;
};

namespace {

std::string whyUnreadable(const std::string& what) {
    const std::string reason = reasonOf(what);  // MRPT's guesses about it follow in parentheses
    return "no MRPT data, or damaged: " + reason.substr(0, reason.find(" ("));
}

}  // namespace

ObjectReader::ObjectReader(const std::string& file)
    : file_(file),
      stream_(std::make_unique<Stream>(std::make_unique<WholeFile>(file))),
      checks_gz_end_(true) {}

ObjectReader::ObjectReader(const std::string& file, std::unique_ptr<ByteSource> source)
    : file_(file), stream_(std::make_unique<Stream>(std::move(source))), checks_gz_end_(false) {}

ObjectReader::~ObjectReader() = default;

void ObjectReader::refuse(const std::string& what) const {
    throw std::runtime_error(file_ + ": object " + std::to_string(objects_ + 1) + ", byte " +
                             std::to_string(stream_->position) + ": " + what);
}

CSerializable::Ptr ObjectReader::next() {
    const uint64_t start = stream_->position;
    stream_->object_starts.push_back(static_cast<uint32_t>(start));
    try {
        auto archive = mrpt::serialization::archiveFrom(*stream_);
        for (;;) {
            CSerializable::Ptr object = archive.ReadObject();
            objects_++;
            if (object) return object;  // MRPT can store null pointers too
        }
    } catch (const std::bad_alloc&) {
        refuse("it claims an impossible size");
    } catch (const std::exception& e) {
        if (!stream_->failure.empty()) refuse(stream_->failure);
        if (!stream_->at_end) refuse(whyUnreadable(e.what()));
        if (stream_->position != start)
            throw CutFile(file_ + ": the file ends inside object " + std::to_string(objects_ + 1) +
                          ", at byte " + std::to_string(stream_->position));
    }
    if (checks_gz_end_) checkGzEnd();
    return nullptr;
}

/** zlib reads a cut gz file silently up to where it is cut, and MRPT doesn't ask it. A whole one
 * ends with the checksum and the unpacked size, mod 2^32, of its last member: that of the file,
 * or of what was appended behind an object, maybe nothing. */
void ObjectReader::checkGzEnd() const {
    std::ifstream in(file_, std::ios::binary);
    std::array<char, 2> magic{};
    in.read(magic.data(), 2);
    if (!in || magic != std::array<char, 2>{'\x1f', '\x8b'}) return;
    std::array<unsigned char, 8> last{};
    in.seekg(-8, std::ios::end);
    in.read(reinterpret_cast<char*>(last.data()), 8);
    const auto number = [&](std::size_t i) {
        return uint32_t{last[i]} | uint32_t{last[i + 1]} << 8 | uint32_t{last[i + 2]} << 16 |
               uint32_t{last[i + 3]} << 24;
    };
    const uint32_t checksum = number(0), size = number(4);
    const auto& starts = stream_->object_starts;
    const auto start = static_cast<uint32_t>(stream_->position) - size;
    const bool is_whole = in && std::find(starts.begin(), starts.end(), start) != starts.end() &&
                          (size > 0 || checksum == 0);
    if (!is_whole)
        throw CutFile(file_ + ": the gz stream ends early, behind object " +
                      std::to_string(objects_) + ", at unpacked byte " +
                      std::to_string(stream_->position));
}

}  // namespace akimap::app
