// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <stdexcept>
#include <string>

namespace akimap::app {

/** What went wrong, on one line: MRPT's what() wraps it in a banner, a place in its sources and a
 * call stack, several times over. Other texts are only joined to one line. */
[[nodiscard]] std::string reasonOf(std::string what);

/** A signal ended the work early, and what was to be done then is done. */
struct Interrupted : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Exit statuses of the program.
inline constexpr int kFailed = 1;       ///< one line on stderr says why
inline constexpr int kUsage = 2;        ///< the command line is wrong
inline constexpr int kInterrupted = 3;  ///< the map of the scans so far is written, or as asked not

}  // namespace akimap::app
