// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <zlib.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "input/ByteSource.h"

namespace akimap::app {

/** A plain or gz file that is still being written. A read waits for its bytes, so that whatever is
 * parsed from it is parsed once, however small the pieces in which it comes. (zlib's gzread, and
 * with it MRPT's stream, never recovers from an end of file: here inflate gets what there is.) */
class GrowingFile : public ByteSource {
 public:
    /** \param idle [s] > 0. The file is at its end when it has not grown for so long
     * \param is_stopped asked often; true ends the file at once
     * \exception std::runtime_error naming the file if it can't be read */
    GrowingFile(const std::string& file, double idle, std::function<bool()> is_stopped);
    ~GrowingFile() override;
    GrowingFile(const GrowingFile&) = delete;
    GrowingFile& operator=(const GrowingFile&) = delete;

    size_t read(void* buffer, size_t count) override;

 private:
    enum class Packing { unknown, none, gz };
    using Clock = std::chrono::steady_clock;

    bool fetch();
    bool waitForGrowth();
    void unpack(size_t count);
    [[nodiscard]] uint64_t fileSize() const;
    [[nodiscard]] size_t available() const { return bytes_.size() - begin_; }

    std::chrono::duration<double> idle_;
    std::function<bool()> is_stopped_;
    int descriptor_ = -1;
    uint64_t offset_ = 0;  // bytes fetched from the file
    Clock::time_point last_growth_ = Clock::now();
    Packing packing_ = Packing::unknown;
    z_stream gz_{};
    bool at_member_end_ = false;  // of a gz file of several
    std::vector<unsigned char> fetched_;
    std::vector<unsigned char> bytes_;  // unpacked; those before begin_ have been read
    size_t begin_ = 0;
};

}  // namespace akimap::app
