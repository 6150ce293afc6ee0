// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "Results.h"

#include <akimap/AkiMap.h>
#include <mrpt/core/format.h>
#include <mrpt/poses/CPose3DQuat.h>
#include <stdlib.h>

#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "support/stream.h"

namespace akimap::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* kMap = "map.akimap";

void writeTum(const TimedPoses& poses, const std::string& file) {
    std::ofstream out = openForWriting(file);
    out << "# time x y z qx qy qz qw\n";
    for (const auto& [time, pose] : poses) {
        const auto p = mrpt::poses::CPose3DQuat(mrpt::poses::CPose3D(pose)).asTPose();
        out << mrpt::format("%.6f %.6f %.6f %.6f %.9f %.9f %.9f %.9f\n",
                            mrpt::Clock::toDouble(time), p.x, p.y, p.z, p.qx, p.qy, p.qz, p.qr);
    }
    closeWritten(out);
}

void row(const std::string& name, std::size_t value, const std::string& place) {
    std::cout << mrpt::format("%-14s %10zu  ", name.c_str(), value) << place << "\n";
}

}  // namespace

Results::Results(const std::string& folder) : folder_(folder) {
    const std::lock_guard lock(mutex_);
    std::error_code error;
    is_new_ = fs::create_directories(folder, error);
    scratch_ = (fs::path(folder) / ".akimap-XXXXXX").string();
    if (error || !mkdtemp(scratch_.data()))
        throw std::runtime_error(folder + ": can't be made or written to");
}

Results::~Results() {
    discard();
}

void Results::discard() const {
    const std::lock_guard lock(mutex_);
    std::error_code ignored;
    // More than once: threads of MRPT's may be writing into it.
    for (int i = 0; i < 100 && fs::exists(scratch_, ignored); i++)
        fs::remove_all(scratch_, ignored);
    if (is_new_) fs::remove(folder_, ignored);
}

void Results::nameTheMap(const std::string& map_prefix) const {
    for (const auto& entry : fs::recursive_directory_iterator(scratch_)) {
        if (entry.path().extension() != ".akimap" ||
            entry.path().filename().string().rfind(map_prefix, 0) != 0)
            continue;
        fs::rename(entry.path(), fs::path(scratch_) / kMap);
        return;
    }
}

std::size_t Results::moveFiles() const {
    std::size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(scratch_)) {
        const fs::path target = fs::path(folder_) / fs::relative(entry.path(), scratch_);
        if (entry.is_directory()) {
            fs::create_directories(target);
        } else {
            fs::rename(entry.path(), target);
            count++;
        }
    }
    return count;
}

void Results::publish(const std::string& map_prefix, const TimedPoses& poses) {
    const std::string trajectory = (fs::path(scratch_) / "trajectory.tum").string();
    std::size_t files = 0;
    try {
        nameTheMap(map_prefix);
        writeTum(poses, trajectory);
        const bool has_map = fs::exists(fs::path(scratch_) / kMap);
        files = moveFiles();
        row("poses", poses.size(), (fs::path(folder_) / "trajectory.tum").string());
        row("files written", files, folder_);
        if (!has_map) return;
    } catch (const std::exception& e) {
        throw std::runtime_error(folder_ + ": the results can't be written: " + e.what());
    }
    const std::string map = (fs::path(folder_) / kMap).string();
    row("AkiMap cells", AkiMap::loadFromFile(map)->cellCount(), map);
}

}  // namespace akimap::app
