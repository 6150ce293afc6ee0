// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "input/ScanSource.h"
#include "input/clouds/Cloud.h"
#include "input/poses/FramePoses.h"

namespace akimap::app {

/** Files of points, one scan each. Where their sensor stood decides what is free: it comes from
 * InputOptions::poses, else from each file's VIEWPOINT, and is never guessed. */
class CloudSource : public ScanSource {
 public:
    /** \param files in order
     * \exception std::runtime_error naming the file: missing, damaged, or where it was taken, or in
     *  which frame, is not said */
    CloudSource(std::vector<std::string> files, const InputOptions& options);

    [[nodiscard]] std::size_t scanCount() const override;
    [[nodiscard]] std::string how() const override { return frames_.how; }
    void forEachScan(const TakeScan& take, SkippedScans& skipped) override;

 private:
    void chooseFrame(const InputOptions& options);
    void checkViewpoints(const InputOptions& options);
    [[nodiscard]] Scan place(const Cloud& cloud, std::size_t i, SkippedScans& skipped) const;

    std::vector<std::string> files_;
    std::vector<std::optional<PcdViewpoint>> viewpoints_;
    FramePoses frames_;
    mrpt::poses::CPose3D extrinsic_;
    CloudFrame frame_ = CloudFrame::map;
    bool has_poses_ = false, deskew_ = true;
};

/** The pose that a VIEWPOINT is. */
[[nodiscard]] mrpt::poses::CPose3D poseOf(const PcdViewpoint& viewpoint);

}  // namespace akimap::app
