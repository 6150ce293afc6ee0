// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/ProgressBar.h"

#include <mrpt/core/format.h>
#include <mrpt/system/progress.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <string>

namespace akimap::app {

namespace {

std::string timeText(double seconds) {
    const long s = std::max(0l, static_cast<long>(seconds + 0.5));
    return s < 3600 ? mrpt::format("%ld:%02ld", s / 60, s % 60)
                    : mrpt::format("%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace

ProgressBar::ProgressBar(std::size_t scans, bool enabled)
    : scans_(scans), enabled_(enabled && scans > 0 && isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() {
    if (enabled_) std::cerr << "\r\033[K" << std::flush;
}

void ProgressBar::show(std::size_t scans_done) {
    if (!enabled_) return;
    const auto now = Clock::now();
    if (now - last_shown_ < std::chrono::milliseconds(100) && scans_done < scans_) return;
    last_shown_ = now;
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const double done = static_cast<double>(std::min(scans_done, scans_));
    const double rate = seconds > 0 ? done / seconds : 0;
    std::string line;
    if (scans_ == kUnknown)
        line = mrpt::format("%zu scans  %.1f scans/s  ", scans_done, rate) + timeText(seconds);
    else
        line = mrpt::system::progress(done / static_cast<double>(scans_), 30) +
               mrpt::format(" %zu/%zu scans", scans_done, scans_);
    if (scans_ != kUnknown && rate > 0)
        line += mrpt::format("  %.1f scans/s  ", rate) +
                timeText((static_cast<double>(scans_) - done) / rate) + " left";
    std::cerr << "\r\033[K" << line << std::flush;
}

StageLine::StageLine(const std::string& text, bool enabled)
    : enabled_(enabled && isatty(STDERR_FILENO) != 0) {
    if (enabled_) std::cerr << "\r\033[K" << text << " ..." << std::flush;
}

StageLine::~StageLine() {
    if (enabled_) std::cerr << "\r\033[K" << std::flush;
}

}  // namespace akimap::app
