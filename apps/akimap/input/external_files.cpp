// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/external_files.h"

#include <mrpt/img/CImage.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace fs = std::filesystem;

namespace akimap::app {

namespace {

using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CObservationPointCloud;

/** As they stand in the observation: whole paths, or from the folder that findExternalFiles() told
 * MRPT of. */
std::vector<std::string> externalFilesOf(const mrpt::obs::CObservation& observation) {
    std::vector<std::string> files;
    if (const auto* cloud = dynamic_cast<const CObservationPointCloud*>(&observation)) {
        if (cloud->isExternallyStored()) files.push_back(cloud->getExternalStorageFile());
    } else if (const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&observation)) {
        if (scan->hasPoints3D && scan->points3D_isExternallyStored())
            files.push_back(scan->points3D_getExternalStorageFile());
        if (scan->hasRangeImage && scan->rangeImage_isExternallyStored()) {
            files.push_back(scan->rangeImage_getExternalStorageFile(""));
            for (const auto& layer : scan->rangeImageOtherLayers)
                files.push_back(scan->rangeImage_getExternalStorageFile(layer.first));
        }
    }
    return files;
}

/** Both without links and dots. */
bool isBelow(const fs::path& folder, const fs::path& file) {
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first ==
           folder.end();
}

}  // namespace

void findExternalFiles(const std::string& log_file) {
    std::error_code ignored;
    fs::path log = log_file;
    if (log.extension() == ".gz") log.replace_extension();
    fs::path folder = log.parent_path() / "Images";
    for (const char* suffix : {"_Images", "_images", "_IMAGES"}) {
        const fs::path candidate = log.parent_path() / (log.stem().string() + suffix);
        if (!fs::is_directory(candidate, ignored)) continue;
        folder = candidate;
        break;
    }
    mrpt::img::CImage::setImagesPathBase(folder.string());
}

void checkExternalFiles(const mrpt::obs::CObservation& observation, const std::string& log_file,
                        ExternalFiles allowed) {
    for (const std::string& name : externalFilesOf(observation)) {
        const fs::path file = fs::path(mrpt::img::CImage::getImagesPathBase()) / name;
        const auto refuse = [&](const std::string& why) {
            throw std::runtime_error("its data are in " + file.string() + ", " + why);
        };
        const fs::path folder = fs::canonical(fs::absolute(log_file).parent_path());
        if (allowed == ExternalFiles::beside_log &&
            !isBelow(folder, fs::weakly_canonical(fs::absolute(file))))
            refuse("which is not in the log's folder; --allow-external takes them from anywhere");
        if (fs::exists(file) && !fs::is_regular_file(file)) refuse("which is no regular file");
    }
}

}  // namespace akimap::app
