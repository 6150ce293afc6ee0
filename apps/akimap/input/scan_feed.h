// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <akimap/AkiMap.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "StopSignal.h"
#include "input/ScanSource.h"

namespace akimap::app {

/** The scans that a command line asks for. */
struct InputRequest {
    std::vector<std::string> inputs;
    std::string trajectory;  ///< a TUM file for the rawlogs; empty: their own poses
    double max_gap = 0.5;    ///< [s] largest gap bridged between robot poses
    std::string only_label;  ///< empty: all sensors
    uint64_t first = 0;      ///< scans to take; 0: all
    bool partial = false;    ///< take what is whole of a cut rawlog
    bool follow = false;     ///< the last input is a rawlog that is still being written
    double idle = 10;        ///< [s] it is at its end when it has not grown for so long
};

inline constexpr const char* kInputGroup = "Input";

/** Adds INPUT... and the options that say which scans are taken and where they were. */
void addInputOptions(CLI::App& command, InputRequest& request);

/** Adds --follow and --idle. \return --follow */
CLI::Option* addFollowOptions(CLI::App& command, InputRequest& request);

/** \exception std::runtime_error naming the option whose value can't be */
void checkInputOptions(const InputRequest& request);

/** The scans of all inputs, one after the other. Warnings go to stderr. */
class ScanFeed {
 public:
    /** Opens all inputs. While a followed one lasts, ^C ends it.
     * \exception std::runtime_error naming the file */
    explicit ScanFeed(const InputRequest& request);

    /** Gets a scan and its number, counted from 0 over all inputs. */
    using TakeScan = std::function<void(Scan&, uint64_t)>;
    /** Gives the scans, with a progress bar if wanted.
     * \exception std::runtime_error naming the file, for what `take` throws too */
    void forEachScan(const TakeScan& take, bool show_progress);

    [[nodiscard]] const SkippedScans& skipped() const { return skipped_; }
    /** Why --only has left nothing; empty if it has not. */
    [[nodiscard]] std::string wrongLabelHint() const;

 private:
    InputRequest request_;
    std::optional<StopSignal> stop_;
    std::vector<std::unique_ptr<ScanSource>> sources_;
    SkippedScans skipped_;
};

/** Inserts a scan as `akimap build` does. \return whether the map changed */
bool insertScan(AkiMap& map, const Scan& scan);

/** A scan as rays, usable or not. \param with_free beams without a return too, where it has them */
[[nodiscard]] std::vector<Ray> raysOf(const Scan& scan, bool with_free);

}  // namespace akimap::app
