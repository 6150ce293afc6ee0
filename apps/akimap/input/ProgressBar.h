// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <chrono>
#include <cstddef>
#include <limits>
#include <string>

namespace akimap::app {

/** A line on stderr that shows how far the scans have come, their rate, and the time left. */
class ProgressBar {
 public:
    static constexpr std::size_t kUnknown = std::numeric_limits<std::size_t>::max();

    /** \param scans all that are to come, maybe kUnknown
     * \param enabled and only if stderr is a terminal, anything is shown */
    ProgressBar(std::size_t scans, bool enabled);
    ~ProgressBar();  ///< wipes the line, so that what is printed next starts clean
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void show(std::size_t scans_done);

 private:
    using Clock = std::chrono::steady_clock;

    std::size_t scans_;
    bool enabled_;
    Clock::time_point start_ = Clock::now(), last_shown_;
};

/** A line on stderr, if that is a terminal, that says what takes its time just now. */
class StageLine {
 public:
    explicit StageLine(const std::string& text, bool enabled = true);
    ~StageLine();  ///< wipes the line
    StageLine(const StageLine&) = delete;
    StageLine& operator=(const StageLine&) = delete;

 private:
    bool enabled_;
};

}  // namespace akimap::app
