// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "recordings.h"

#include <mrpt/img/CImage.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "input/clouds/PcdReader.h"

namespace akimap::bench {
namespace {

using mrpt::poses::CPose3D;
constexpr int kPixelStep = 4;
constexpr double kNearest = 0.3;         // [m] the camera sees nothing nearer
constexpr uint16_t kNoDepth = 65535;     // besides 0
constexpr double kMetresPerStep = 1e-3;  // of the images

/** All files that begin and end so, in the order of their names. */
std::vector<std::string> filesOf(const std::string& folder, const std::string& begin,
                                 const std::string& end) {
    std::vector<std::string> files;
    if (!std::filesystem::is_directory(folder)) return files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        const bool is_long_enough = name.size() >= begin.size() + end.size();
        if (is_long_enough && name.compare(0, begin.size(), begin) == 0 &&
            name.compare(name.size() - end.size(), end.size(), end) == 0)
            files.push_back(entry.path().string());
    }
    std::sort(files.begin(), files.end());
    return files;
}

/** All numbers of a text file, in rows of so many. */
std::vector<double> numbersIn(const std::string& file, std::size_t row) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error(file + ": can't be read");
    std::vector<double> numbers;
    for (double v = 0; in >> v;) numbers.push_back(v);
    const std::string count = std::to_string(numbers.size());
    if (!in.eof()) throw std::runtime_error(file + ": not a number after the " + count + "th");
    if (numbers.empty() || numbers.size() % row != 0)
        throw std::runtime_error(file + ": no rows of " + std::to_string(row) + " numbers, but " +
                                 count + " numbers");
    return numbers;
}

/** \param m three rows of four */
CPose3D poseOf(const double* m) {
    mrpt::math::CMatrixDouble44 matrix = mrpt::math::CMatrixDouble44::Identity();
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++) matrix(row, column) = m[4 * row + column];
    return CPose3D(matrix);
}

Ray rayFrom(const CPose3D& sensor, double x, double y, double z) {
    const auto origin = sensor.translation();
    Ray ray{{origin.x, origin.y, origin.z}, {}};
    sensor.composePoint(x, y, z, ray.end[0], ray.end[1], ray.end[2]);
    return ray;
}

mrpt::img::CImage depthImage(const std::string& file) {
    constexpr int kUnchanged = -1;
    mrpt::img::CImage image;
    if (!image.loadFromFile(file, kUnchanged)) throw std::runtime_error(file + ": can't be read");
    if (image.getPixelDepth() != mrpt::img::PixelDepth::D16U || image.isColor())
        throw std::runtime_error(file + ": no grey image of 16 bits");
    return image;
}

/** \param k the camera's matrix, 3 x 3 */
PosedScan depthFrame(const std::string& image_file, const std::vector<double>& k) {
    const std::string stem = image_file.substr(0, image_file.size() - std::size_t{10});
    const mrpt::img::CImage image = depthImage(image_file);
    PosedScan scan{poseOf(numbersIn(stem + ".pose.txt", 16).data()), {}};
    const auto width = static_cast<int>(image.getWidth()),
               height = static_cast<int>(image.getHeight());
    for (int v = 0; v < height; v += kPixelStep) {
        // Not at<uint16_t>(): MRPT 2.5.8 steps by bytes in it, whatever the type.
        const auto* row = image.ptrLine<uint16_t>(static_cast<unsigned>(v));
        for (int u = 0; u < width; u += kPixelStep) {
            const uint16_t steps = row[u];
            const double z = kMetresPerStep * steps;
            if (steps == kNoDepth || z <= kNearest) continue;
            scan.rays.push_back(
                rayFrom(scan.sensor, (u - k[2]) * z / k[0], (v - k[5]) * z / k[4], z));
        }
    }
    return scan;
}

}  // namespace

std::vector<PosedScan> depthFrames(const std::string& folder) {
    std::vector<PosedScan> scans;
    const auto files = filesOf(folder, "frame-", ".depth.png");
    if (files.empty()) return scans;
    const auto camera = numbersIn(folder + "/camera-intrinsics.txt", 9);
    for (const std::string& file : files) scans.push_back(depthFrame(file, camera));
    return scans;
}

std::vector<PosedScan> posedClouds(const std::string& folder) {
    std::vector<PosedScan> scans;
    const auto files = filesOf(folder, "scan_", ".pcd");
    if (files.empty()) return scans;
    const std::string pose_file = folder + "/poses_kitti.txt";
    const auto poses = numbersIn(pose_file, 12);
    if (poses.size() != 12 * files.size())
        throw std::runtime_error(pose_file + ": " + std::to_string(poses.size() / 12) +
                                 " poses for " + std::to_string(files.size()) + " scans");
    for (std::size_t i = 0; i < files.size(); i++) {
        PosedScan scan{poseOf(&poses[12 * i]), {}};
        for (const Ray& ray : app::readPcd(files[i]))
            scan.rays.push_back(rayFrom(scan.sensor, ray.end[0], ray.end[1], ray.end[2]));
        scans.push_back(std::move(scan));
    }
    return scans;
}

std::vector<std::vector<Ray>> raised(std::vector<std::vector<Ray>> scans, double metres) {
    for (std::vector<Ray>& scan : scans)
        for (Ray& ray : scan) ray.origin[2] += metres;
    return scans;
}

std::vector<std::vector<Ray>> raysOf(const std::vector<PosedScan>& scans) {
    std::vector<std::vector<Ray>> rays;
    for (const PosedScan& scan : scans) rays.push_back(scan.rays);
    return rays;
}

std::string dataFolder(const std::string& name) {
    const char* data = std::getenv("AKIMAP_DATA");
    return std::string(data ? data : "") + "/" + name;
}

}  // namespace akimap::bench
