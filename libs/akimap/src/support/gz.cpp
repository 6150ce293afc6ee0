// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "support/gz.h"

#include <fcntl.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include "support/Descriptor.h"

namespace akimap {
namespace {

constexpr std::size_t kBuffer = 1 << 17;                   // [bytes]
constexpr std::size_t kMostAtOnce = std::size_t{1} << 30;  // zlib counts in int

std::string reasonOf(int zlib_error) {
    return zlib_error == Z_ERRNO ? std::strerror(errno) : "no memory left";
}

}  // namespace

GzWriter::GzWriter(const std::string& path, std::string& failure)
    : failure_(failure), file_(gzopen(path.c_str(), "wbe1")) {
    if (!file_) fail(Z_ERRNO);
    gzbuffer(file_, kBuffer);
}

GzWriter::~GzWriter() {
    if (file_) gzclose(file_);
}

std::size_t GzWriter::Write(const void* bytes, std::size_t size) {
    for (std::size_t at = 0; at < size;) {
        const std::size_t n = std::min(size - at, kMostAtOnce);
        if (gzwrite(file_, static_cast<const char*>(bytes) + at, static_cast<unsigned>(n)) <= 0) {
            int error = Z_OK;
            gzerror(file_, &error);
            fail(error);
        }
        at += n;
    }
    return size;
}

void GzWriter::close() {
    const int error = gzclose(std::exchange(file_, nullptr));
    if (error != Z_OK) fail(error);
}

void GzWriter::fail(int zlib_error) {
    failure_ = reasonOf(zlib_error);
    throw std::runtime_error(failure_);
}

std::size_t GzWriter::Read(void*, std::size_t) {
    throw std::logic_error("this stream is for writing");
}

/** By hand, as zlib's own reader takes some cut files, and what is no gz behind one, for whole. */
class GzReader::Inflater {
 public:
    explicit Inflater(const std::string& path)
        : file_(open(path.c_str(), O_RDONLY | O_CLOEXEC)), buffer_(kBuffer) {
        if (!file_.isOpen()) throw std::runtime_error(std::strerror(errno));
        refill();
        is_plain_ = z_.avail_in < 2 || buffer_[0] != 0x1f || buffer_[1] != 0x8b;
        constexpr int kGzOnly = 16;
        if (inflateInit2(&z_, MAX_WBITS + kGzOnly) != Z_OK) throw std::bad_alloc();
    }
    ~Inflater() { inflateEnd(&z_); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    /** \return 0 at the end only */
    std::size_t read(unsigned char* bytes, std::size_t size) {
        z_.next_out = bytes, z_.avail_out = static_cast<unsigned>(std::min(size, kMostAtOnce));
        const unsigned wanted = z_.avail_out;
        while (z_.avail_out == wanted && (z_.avail_in > 0 || refill()))
            is_plain_ ? copy() : inflateSome();
        return wanted - z_.avail_out;
    }
    /** Whether the input ends within a member. */
    [[nodiscard]] bool isCut() const { return in_member_; }

 private:
    bool refill() {
        ssize_t n = -1;
        do n = ::read(file_.number(), buffer_.data(), buffer_.size());
        while (n < 0 && errno == EINTR);
        if (n < 0) throw std::runtime_error(std::strerror(errno));
        z_.next_in = buffer_.data(), z_.avail_in = static_cast<unsigned>(n);
        return n > 0;
    }
    void copy() {
        const unsigned n = std::min(z_.avail_in, z_.avail_out);
        std::memcpy(z_.next_out, z_.next_in, n);
        z_.next_in += n, z_.avail_in -= n;
        z_.next_out += n, z_.avail_out -= n;
    }
    void inflateSome() {
        in_member_ = true;
        const int state = inflate(&z_, Z_NO_FLUSH);
        if (state == Z_MEM_ERROR) throw std::bad_alloc();
        if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR)
            throw std::runtime_error("the compressed data are damaged");
        if (state == Z_STREAM_END) in_member_ = false, inflateReset(&z_);
    }

    Descriptor file_;
    std::vector<unsigned char> buffer_;
    z_stream z_{};
    bool is_plain_ = false, in_member_ = false;
};

GzReader::GzReader(const std::string& path) : inflater_(std::make_unique<Inflater>(path)) {}
GzReader::~GzReader() = default;

std::size_t GzReader::readSome(void* bytes, std::size_t size) {
    std::size_t at = 0;
    while (at < size) {
        const std::size_t n = inflater_->read(static_cast<unsigned char*>(bytes) + at, size - at);
        if (n == 0) break;
        at += n;
    }
    return at;
}

std::size_t GzReader::Read(void* bytes, std::size_t size) {
    if (readSome(bytes, size) < size) throw std::runtime_error("its end is missing");
    return size;
}

bool GzReader::isCut() const {
    return inflater_->isCut();
}

std::size_t GzReader::Write(const void*, std::size_t) {
    throw std::logic_error("this stream is for reading");
}

}  // namespace akimap
