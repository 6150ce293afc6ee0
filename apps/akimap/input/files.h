// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace akimap::app {

/** \exception std::runtime_error naming the file unless it is one that can be read */
inline void requireReadable(const std::string& file) {
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) throw std::runtime_error(file + ": no such file");
    if (std::filesystem::is_directory(status))
        throw std::runtime_error(file + ": this is a folder, not a file");
    errno = 0;
    if (!std::ifstream(file))
        throw std::runtime_error(file + ": can't be read: " + std::strerror(errno));
}

}  // namespace akimap::app
