// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

namespace akimap {

/** \exception std::runtime_error with the system's reason */
[[nodiscard]] inline std::ofstream openForWriting(const std::string& path) {
    std::ofstream out(path, std::ios::binary);
    if (!out) throw std::runtime_error(std::strerror(errno));
    return out;
}

/** \exception std::runtime_error with the system's reason */
inline void writeBytes(std::ofstream& out, const std::string& bytes) {
    errno = 0;
    if (!out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush())
        throw std::runtime_error(errno ? std::strerror(errno) : "not all could be written");
}

/** Closes the stream. \exception std::runtime_error with the system's reason if not everything was
 * written; a write that failed before is tried again, so that the reason is the last one's */
inline void closeWritten(std::ofstream& out) {
    errno = 0;
    out.close();
    if (!out) throw std::runtime_error(errno ? std::strerror(errno) : "not all could be written");
}

/** Appends the bytes of a number; all our binary formats are little endian, as is every machine
 * that MRPT's packages are built for. */
template <class T>
void appendBytes(std::string& bytes, T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes.append(raw, sizeof(T));
}

}  // namespace akimap
