// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// Instead of BagSource.cpp where librosbag-storage-dev was not found.
#include "input/bags/BagSource.h"
#include "input/files.h"

namespace akimap::app {

std::unique_ptr<ScanSource> openBag(const std::string& file, const InputOptions&) {
    requireReadable(file);
    throw std::runtime_error(file +
                             ": this akimap was built without the reader of ROS bags; with "
                             "librosbag-storage-dev and libsensor-msgs-dev installed, build it "
                             "again, or make a rawlog by MRPT's rosbag2rawlog");
}

std::string bagReaderName() {
    return "";
}

}  // namespace akimap::app
