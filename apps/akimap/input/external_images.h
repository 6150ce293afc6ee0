// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>

namespace akimap::app {

/** Tells MRPT where the images and clouds stored outside a log are: in the folder `<log>_Images`
 * beside it, else in `Images`. (MRPT 2.5's own detectImagesDirectory() forgets a slash.) */
void findExternalImages(const std::string& log_file);

}  // namespace akimap::app
