// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/clouds/Cloud.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "input/clouds/PcdReader.h"
#include "input/clouds/PlyReader.h"
#include "input/clouds/TextCloud.h"
#include "input/files.h"

namespace akimap::app {

namespace {

constexpr std::size_t kKittiPoint = 4 * sizeof(float);  // x y z intensity

std::size_t kittiPoints(const std::string& file) {
    requireReadable(file);
    const auto size = std::filesystem::file_size(file);
    if (size % kKittiPoint != 0)
        throw std::runtime_error(file + ": not KITTI's x y z intensity floats: its " +
                                 std::to_string(size) + " bytes are no multiple of 16");
    return size / kKittiPoint;
}

Cloud readKitti(const std::string& file) {
    Cloud cloud;
    const std::size_t points = kittiPoints(file);
    std::vector<float> numbers(4 * points);
    std::ifstream in(file, std::ios::binary);
    in.read(reinterpret_cast<char*>(numbers.data()),
            static_cast<std::streamsize>(points * kKittiPoint));
    if (!in) throw std::runtime_error(file + ": can't be read to its end");
    for (std::size_t i = 0; i < points; i++) {
        const float* p = &numbers[4 * i];
        cloud.points.push_back({p[0], p[1], p[2]});
        cloud.intensity.push_back(p[3]);
    }
    return cloud;
}

bool isText(const std::string& extension) {
    return extension == ".txt" || extension == ".csv" || extension == ".xyz";
}

}  // namespace

bool PcdViewpoint::isRotated() const {
    return std::abs(std::abs(rotation[0]) - 1) > 1e-6;
}

const std::vector<std::string>& cloudExtensions() {
    static const std::vector<std::string> extensions{".pcd", ".ply", ".bin",
                                                     ".txt", ".csv", ".xyz"};
    return extensions;
}

std::string cloudExtension(const std::string& file) {
    std::string extension = std::filesystem::path(file).extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto& all = cloudExtensions();
    return std::find(all.begin(), all.end(), extension) == all.end() ? "" : extension;
}

Cloud readCloud(const std::string& file) {
    const std::string extension = cloudExtension(file);
    if (extension == ".pcd") return readPcdCloud(file);
    if (extension == ".ply") return readPlyCloud(file);
    if (extension == ".bin") return readKitti(file);
    if (isText(extension)) return readTextCloud(file);
    throw std::runtime_error(file + ": no file of points");
}

std::optional<PcdViewpoint> peekCloud(const std::string& file) {
    const std::string extension = cloudExtension(file);
    if (extension == ".pcd") return peekPcd(file);
    if (extension == ".ply")
        checkPly(file);
    else if (extension == ".bin")
        (void)kittiPoints(file);
    else
        requireReadable(file);
    return std::nullopt;
}

}  // namespace akimap::app
