// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "input/ScanSource.h"
#include "input/depth/intrinsics.h"
#include "input/poses/FramePoses.h"

namespace akimap::app {

/** What a command line says of its depth images. */
struct DepthRequest {
    std::string images;      ///< a folder of .png, or a list as TUM RGB-D's depth.txt; empty: none
    std::string intrinsics;  ///< a file, or fx,fy,cx,cy [pixels]
    double scale = 1000;     ///< steps of the images for a metre, or, below 1, metres for a step
};

/** Depth images of 16 bits: the distance along the camera's axis, 0 and 65535 where there is none.
 * The camera's frame, which poses and extrinsics are of, has z ahead, x right and y down. */
class DepthImages : public ScanSource {
 public:
    /** \exception std::runtime_error naming the file or the option */
    DepthImages(const DepthRequest& request, const InputOptions& options);

    [[nodiscard]] std::size_t scanCount() const override;
    [[nodiscard]] std::string how() const override { return frames_.how; }
    void forEachScan(const TakeScan& take, SkippedScans& skipped) override;

 private:
    [[nodiscard]] Scan read(std::size_t i) const;

    std::vector<std::string> files_;
    FramePoses frames_;
    Intrinsics camera_;
    mrpt::poses::CPose3D extrinsic_;
    double metres_per_step_ = 1e-3;
    bool has_poses_ = false;
};

}  // namespace akimap::app
