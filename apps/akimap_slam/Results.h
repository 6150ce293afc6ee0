// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/core/Clock.h>
#include <mrpt/math/TPose3D.h>

#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "StopSignal.h"

namespace akimap::app {

using TimedPoses = std::vector<std::pair<mrpt::Clock::time_point, mrpt::math::TPose3D>>;

/** The files that one of MRPT's applications writes. They go to a scratch folder within the output
 * folder first: MRPT deletes all that is in the folder that it is given. While it lives, the first
 * stop signal only ends the log (see LogFeed). */
class Results {
 public:
    /** Makes the folders. \exception std::runtime_error naming the folder */
    explicit Results(const std::string& folder);
    ~Results();  ///< discards
    Results(const Results&) = delete;
    Results& operator=(const Results&) = delete;

    [[nodiscard]] const std::string& scratch() const { return scratch_; }

    /** Moves the files to the output folder, over older ones of the same name, the final AkiMap as
     * `map.akimap`; writes the poses beside them as `trajectory.tum`; prints the table.
     * \param map_prefix how the name of the final map's file begins
     * \exception std::runtime_error naming the file */
    void publish(const std::string& map_prefix, const TimedPoses& poses);

    /** Removes the scratch folder with what is still in it, and the output folder if it was made
     * and nothing is in it. From any thread, where the program ends without destructors. */
    void discard() const;

 private:
    void nameTheMap(const std::string& map_prefix) const;
    std::size_t moveFiles() const;

    std::string folder_, scratch_;
    bool is_new_ = false;  // the folder
    mutable std::mutex mutex_;
    StopSignal stop_{[this] { discard(); }};
};

}  // namespace akimap::app
