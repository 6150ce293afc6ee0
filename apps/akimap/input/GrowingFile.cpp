// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/GrowingFile.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "input/files.h"

namespace akimap::app {

namespace {

constexpr size_t kPiece = 1 << 16;  // [bytes]
constexpr auto kPoll = std::chrono::milliseconds(20);

}  // namespace

GrowingFile::GrowingFile(const std::string& file, double idle, std::function<bool()> is_stopped)
    : idle_(idle), is_stopped_(std::move(is_stopped)), fetched_(kPiece) {
    requireReadable(file);
    if (inflateInit2(&gz_, 15 + 16) != Z_OK) throw std::bad_alloc();
    descriptor_ = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0) {
        const std::string reason = std::strerror(errno);
        inflateEnd(&gz_);
        throw std::runtime_error(file + ": can't be read: " + reason);
    }
}

GrowingFile::~GrowingFile() {
    close(descriptor_);
    inflateEnd(&gz_);
}

size_t GrowingFile::read(void* buffer, size_t count) {
    if (begin_ > bytes_.size() / 2) {  // each byte is moved at most once, on average
        bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(begin_));
        begin_ = 0;
    }
    while (available() < count && fetch()) {
    }
    const size_t n = std::min(count, available());
    if (n > 0) std::memcpy(buffer, bytes_.data() + begin_, n);
    begin_ += n;
    return n;
}

/** Takes what the file has got, or waits a little. False at the end. */
bool GrowingFile::fetch() {
    if (is_stopped_()) return false;
    if (packing_ == Packing::unknown && fileSize() < 2) return waitForGrowth();
    const ssize_t n = ::read(descriptor_, fetched_.data(), fetched_.size());
    if (n < 0 && errno == EINTR) return true;
    if (n < 0) throw std::runtime_error(std::string("can't be read: ") + std::strerror(errno));
    if (n == 0) return waitForGrowth();
    if (packing_ == Packing::unknown)
        packing_ = fetched_[0] == 0x1f && fetched_[1] == 0x8b ? Packing::gz : Packing::none;
    last_growth_ = Clock::now();
    offset_ += static_cast<uint64_t>(n);
    if (packing_ == Packing::gz)
        unpack(static_cast<size_t>(n));
    else
        bytes_.insert(bytes_.end(), fetched_.begin(), fetched_.begin() + n);
    return true;
}

bool GrowingFile::waitForGrowth() {
    if (fileSize() < offset_) throw std::runtime_error("it shrank while it was followed");
    if (Clock::now() - last_growth_ >= idle_) return false;
    std::this_thread::sleep_for(kPoll);
    return true;
}

void GrowingFile::unpack(size_t count) {
    gz_.next_in = fetched_.data();
    gz_.avail_in = static_cast<uInt>(count);
    do {
        if (at_member_end_) inflateReset(&gz_);
        const size_t old_size = bytes_.size();
        bytes_.resize(old_size + kPiece);
        gz_.next_out = bytes_.data() + old_size;
        gz_.avail_out = kPiece;
        const int result = inflate(&gz_, Z_SYNC_FLUSH);
        bytes_.resize(old_size + kPiece - gz_.avail_out);
        at_member_end_ = result == Z_STREAM_END;
        if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR)
            throw std::runtime_error("the compressed data are damaged");
    } while (gz_.avail_in > 0 || gz_.avail_out == 0);
}

uint64_t GrowingFile::fileSize() const {
    struct stat status {};
    if (fstat(descriptor_, &status) != 0)
        throw std::runtime_error(std::string("can't be read: ") + std::strerror(errno));
    return static_cast<uint64_t>(status.st_size);
}

}  // namespace akimap::app
