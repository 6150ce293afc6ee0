// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "StopSignal.h"
#include "input/InputRequest.h"
#include "input/ScanSource.h"

namespace akimap::app {

/** The scans of all inputs, one after the other. Warnings go to stderr. */
class ScanFeed {
 public:
    /** Opens all inputs. While a followed one lasts, ^C ends it.
     * \exception std::runtime_error naming the file */
    explicit ScanFeed(const InputRequest& request);

    /** Gets a scan and its number, counted from 0 over all inputs. */
    using TakeScan = std::function<void(Scan&, uint64_t)>;
    /** Gives the scans, with a progress bar if wanted; no more once a StopSignal is requested.
     * \exception std::runtime_error naming the file, for what `take` throws too */
    void forEachScan(const TakeScan& take, bool show_progress);

    [[nodiscard]] const SkippedScans& skipped() const { return skipped_; }
    [[nodiscard]] const std::vector<std::unique_ptr<ScanSource>>& sources() const {
        return sources_;
    }
    /** Why --only has left nothing; empty if it has not. */
    [[nodiscard]] std::string wrongLabelHint() const;
    /** All scans, more than one, had the same pose, and no warning has told of poses before. */
    [[nodiscard]] bool isFixed() const { return scans_ > 1 && is_fixed_ && !has_warned_; }

 private:
    void notePose(const Scan& scan);

    InputRequest request_;
    std::optional<StopSignal> stop_;
    std::vector<std::unique_ptr<ScanSource>> sources_;
    SkippedScans skipped_;
    uint64_t scans_ = 0;
    mrpt::poses::CPose3D first_pose_;
    bool is_fixed_ = true, has_warned_ = false;
};

/** Prints a warning of one line on stderr. */
void warn(const std::string& line);

/** Inserts a scan as `akimap build` does. \return whether the map changed */
bool insertScan(AkiMap& map, const Scan& scan);

/** A scan as rays, usable or not. \param with_free beams without a return too, where it has them */
[[nodiscard]] std::vector<Ray> raysOf(const Scan& scan, bool with_free);

}  // namespace akimap::app
