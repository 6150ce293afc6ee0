// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/obs/CObservation.h>

#include <string>

namespace akimap::app {

/** Where a log may have its scans' clouds and depth images, when they are not in it. */
enum class ExternalFiles {
    beside_log,  ///< in the log's own folder and those below
    anywhere
};

/** Tells MRPT where the images and clouds stored outside a log are: in the folder `<log>_Images`
 * beside it, else in `Images`. (MRPT 2.5's own detectImagesDirectory() forgets a slash.) */
void findExternalFiles(const std::string& log_file);

/** Refuses an observation whose cloud or depth image is in a file where it may not be, or in none
 * that is a regular one: a device or a pipe would be read without end. Files that are not there are
 * for who reads them to tell. \pre findExternalFiles(log_file)
 * \exception std::runtime_error naming the external file */
void checkExternalFiles(const mrpt::obs::CObservation& observation, const std::string& log_file,
                        ExternalFiles allowed);

}  // namespace akimap::app
