// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "input/depth/DepthImages.h"

namespace akimap::app {

/** The scans that a command line asks for. */
struct InputRequest {
    std::vector<std::string> inputs;
    DepthRequest depth;
    std::string poses;            ///< a file or folder of poses; empty: the inputs' own
    std::string times;            ///< a file of the clouds' or images' times
    std::string extrinsic;        ///< for poseArgument(); empty: none
    std::string frame;            ///< of clouds: map or sensor; empty: not said
    bool no_deskew = false;       ///< leave clouds as they are, whatever times their points have
    double max_gap = 0.5;         ///< [s] largest gap bridged between poses
    std::string only_label;       ///< empty: all sensors
    uint64_t first = 0;           ///< scans to take; 0: all
    bool partial = false;         ///< take what is whole of a cut rawlog
    bool allow_external = false;  ///< clouds and images of logs may be in files anywhere
    bool follow = false;          ///< the last input is a rawlog that is still being written
    double idle = 10;             ///< [s] it is at its end when it has not grown for so long
};

inline constexpr const char* kInputGroup =
    "Input (--poses wins over a log's own poses, and these over its odometry)";

/** Adds INPUT... and the options that say which scans are taken and where they were. */
void addInputOptions(CLI::App& command, InputRequest& request);

/** Adds --follow and --idle. \return --follow */
CLI::Option* addFollowOptions(CLI::App& command, InputRequest& request);

/** \exception std::runtime_error naming the option whose value can't be */
void checkInputOptions(const InputRequest& request);

/** All files that will be read, those in folders too, as far as they can be told. */
[[nodiscard]] std::vector<std::string> filesRead(const InputRequest& request);

/** Opens everything that the request asks for. \param warn gets one line each time
 * \exception std::runtime_error naming the file or the option */
[[nodiscard]] std::vector<std::unique_ptr<ScanSource>> openSources(
    const InputRequest& request, std::function<void(const std::string&)> warn);

}  // namespace akimap::app
