// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace akimap::bench {

/** Where a map stops the rays of scans that it never got: shares of them. */
struct StopShares {
    double near1, near3, early, phantom, miss;
};

/** The report's first question, asked of one recording. */
struct HeadToHead {
    std::string recording;
    StopShares akimap, octomap;
};

/** What all sections share. */
struct Report {
    std::string pictures;                           ///< folder to write into
    std::string pictures_link;                      ///< the same as seen from the report
    int seeds = 10;                                 ///< runs to average, of what is random
    std::function<void(const std::string&)> doing;  ///< gets what comes next, for people who wait
    /** Where AkiMap is not the best: a scene and a figure. Filled by the sections. */
    std::vector<std::pair<std::string, std::string>> lost;
    std::vector<HeadToHead> real;  ///< of each real recording, in their order
};

}  // namespace akimap::bench
