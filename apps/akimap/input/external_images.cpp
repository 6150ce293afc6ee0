// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/external_images.h"

#include <mrpt/img/CImage.h>

#include <filesystem>

namespace akimap::app {

void findExternalImages(const std::string& log_file) {
    namespace fs = std::filesystem;
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

}  // namespace akimap::app
