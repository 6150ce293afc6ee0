// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <string>

/** A file of these bytes, in memory. */
class MemoryFile {
 public:
    MemoryFile(const uint8_t* bytes, std::size_t size) : file_(memfd_create("fuzz", MFD_CLOEXEC)) {
        if (file_ < 0 || write(file_, bytes, size) != static_cast<ssize_t>(size)) std::abort();
        path_ = "/proc/self/fd/" + std::to_string(file_);
    }
    ~MemoryFile() { close(file_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }

 private:
    int file_;
    std::string path_;
};

/** Reads a file of these bytes by read(path); a refusal begins with its name, anything else is a
 * finding. \return 0, as libFuzzer wants */
template <class Read>
int fuzz(const uint8_t* bytes, std::size_t size, Read&& read) {
    const MemoryFile file(bytes, size);
    try {
        read(file.path());
    } catch (const std::bad_alloc&) {
        std::abort();  // of so few bytes
    } catch (const std::exception& e) {
        if (std::string(e.what()).rfind(file.path(), 0) != 0) std::abort();
    }
    return 0;
}
