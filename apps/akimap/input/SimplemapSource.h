// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include "input/CheckedLog.h"
#include "input/ScanSource.h"

namespace akimap::app {

/** The scans of a CSimpleMap, each placed by the mean pose of its keyframe. */
class SimplemapSource : public ScanSource {
 public:
    /** \exception std::runtime_error naming the file: missing, damaged, or no simplemap */
    SimplemapSource(const std::string& file, const InputOptions& options);

    [[nodiscard]] std::size_t scanCount() const override { return scan_count_; }
    [[nodiscard]] std::set<std::string> labels() const override { return labels_; }
    void forEachScan(const TakeScan& take, SkippedScans& skipped) override;

 private:
    CheckedLog log_;
    std::string only_label_;
    std::size_t scan_count_ = 0;
    std::set<std::string> labels_;
};

}  // namespace akimap::app
