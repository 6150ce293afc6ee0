// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/depth/DepthImages.h"

#include <mrpt/img/CImage.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "input/depth/depth_observation.h"
#include "input/files.h"
#include "input/natural_order.h"
#include "input/numbers.h"

namespace akimap::app {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> imagesInFolder(const std::string& folder) {
    std::vector<std::string> files, depth;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        std::string extension = entry.path().extension().string();
        for (char& c : extension)
            c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        if (extension != ".png") continue;
        files.push_back(entry.path().string());
        // beside colour images of the same names
        if (name.find("depth") != std::string::npos) depth.push_back(entry.path().string());
    }
    std::vector<std::string>& images = depth.empty() ? files : depth;
    std::sort(images.begin(), images.end(), naturallyBefore);
    return images;
}

/** The images of a list of `time name` lines; names are from the list's own folder. */
std::vector<std::string> imagesInList(const std::string& list) {
    requireReadable(list);
    std::ifstream in(list);
    std::vector<std::string> files;
    std::vector<std::string_view> words;
    std::string line;
    for (std::size_t number = 1; std::getline(in, line); number++) {
        splitWords(line, words);
        if (words.empty() || words.front().front() == '#') continue;
        if (words.size() != 2)
            throw std::runtime_error(list + ":" + std::to_string(number) +
                                     ": expected a time and the name of an image");
        files.push_back((fs::path(list).parent_path() / std::string(words[1])).string());
    }
    return files;
}

mrpt::img::CImage readImage(const std::string& file) {
    requireReadable(file);
    constexpr int kUnchanged = -1;
    mrpt::img::CImage image;
    if (!image.loadFromFile(file, kUnchanged))
        throw std::runtime_error(file + ": no image that can be read");
    if (image.isColor() || image.getPixelDepth() != mrpt::img::PixelDepth::D16U)
        throw std::runtime_error(file + ": not a grey image of 16 bits, as depth images are");
    return image;
}

}  // namespace

DepthImages::DepthImages(const DepthRequest& request, const InputOptions& options)
    : ScanSource(request.images),
      extrinsic_(options.extrinsic),
      metres_per_step_(request.scale < 1 ? request.scale : 1 / request.scale),
      has_poses_(!options.poses.empty()) {
    const bool is_folder = fs::is_directory(request.images);
    files_ = is_folder ? imagesInFolder(request.images) : imagesInList(request.images);
    if (files_.empty()) throw std::runtime_error(request.images + ": no .png image in it");
    for (const std::string& name : files_) requireReadable(name);
    if (request.intrinsics.empty())
        throw std::runtime_error("--depth needs --intrinsics: fx,fy,cx,cy [pixels], or a file");
    camera_ = readIntrinsics(request.intrinsics);
    if (!has_poses_ && files_.size() > 1)
        throw std::runtime_error(request.images + ": " + std::to_string(files_.size()) +
                                 " depth images, and nothing tells where they were taken: --poses "
                                 "FILE or FOLDER does");
    const std::string times = options.times.empty() && !is_folder ? request.images : options.times;
    frames_ = matchPoses(files_, options.poses, times, options.max_gap);
}

std::size_t DepthImages::scanCount() const {
    if (!has_poses_) return files_.size();
    return static_cast<std::size_t>(
        std::count_if(frames_.poses.begin(), frames_.poses.end(),
                      [](const auto& pose) { return pose.has_value(); }));
}

void DepthImages::forEachScan(const TakeScan& take, SkippedScans& skipped) {
    for (std::size_t i = 0; i < files_.size(); i++) {
        if (has_poses_ && !frames_.poses[i]) {
            skipped.outside_trajectory++;
            continue;
        }
        nowReading(files_[i]);
        Scan scan = read(i);
        if (!take(scan)) return;
    }
}

Scan DepthImages::read(std::size_t i) const {
    const mrpt::img::CImage image = readImage(files_[i]);
    const auto width = static_cast<unsigned>(image.getWidth()),
               height = static_cast<unsigned>(image.getHeight());
    // Not at<uint16_t>(): MRPT 2.5.8 steps by bytes in it, whatever the type.
    const auto depth =
        depthObservation(width, height, camera_, metres_per_step_,
                         [&](unsigned x, unsigned y) { return image.ptrLine<uint16_t>(y)[x]; });
    if (!frames_.times.empty()) depth->timestamp = frames_.times[i];
    depth->sensorLabel = "depth";
    depth->sensorPose = extrinsic_ + depth->sensorPose;
    Scan scan;
    scan.observation = depth;
    if (has_poses_) scan.robot_pose = *frames_.poses[i];
    return scan;
}

}  // namespace akimap::app
