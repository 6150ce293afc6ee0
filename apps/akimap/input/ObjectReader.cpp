// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/ObjectReader.h"

#include <mrpt/serialization/CArchive.h>

#include "errors.h"
#include "input/files.h"
#include "support/gz.h"

namespace akimap::app {

using mrpt::serialization::CSerializable;

namespace {

/** A file that is there, plain or gz. */
class WholeFile : public ByteSource {
 public:
    explicit WholeFile(const std::string& file) : gz_((requireReadable(file), file)) {}
    size_t read(void* buffer, size_t count) override { return gz_.readSome(buffer, count); }
    [[nodiscard]] bool isCut() const override { return gz_.isCut(); }

 private:
    GzReader gz_;
};

}  // namespace

std::unique_ptr<ByteSource> wholeFile(const std::string& file) {
    return std::make_unique<WholeFile>(file);
}

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
    [[nodiscard]] bool isCut() const { return source_->isCut(); }

    uint64_t position = 0;  ///< [bytes] unpacked
    bool at_end = false;
    std::string failure;  ///< of the source; MRPT may wrap what it throws

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

ObjectReader::ObjectReader(const CheckedLog& log)
    : ObjectReader(log.file(), wholeFile(log.file())) {}

ObjectReader::ObjectReader(const std::string& file, std::unique_ptr<ByteSource> source)
    : file_(file), stream_(std::make_unique<Stream>(std::move(source))) {}

ObjectReader::~ObjectReader() = default;

void ObjectReader::refuse(const std::string& what) const {
    throw std::runtime_error(file_ + ": object " + std::to_string(objects_ + 1) + ", byte " +
                             std::to_string(stream_->position) + ": " + what);
}

CSerializable::Ptr ObjectReader::next() {
    const uint64_t start = stream_->position;
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
    if (stream_->isCut())
        throw CutFile(file_ + ": the gz stream ends early, behind object " +
                      std::to_string(objects_) + ", at unpacked byte " +
                      std::to_string(stream_->position));
    return nullptr;
}

}  // namespace akimap::app
