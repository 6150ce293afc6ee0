// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/poses/CPose3D.h>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "input/ScanSource.h"

namespace akimap::app {

/** How well scans agree with those before them: of the cells of 0.2 m that earlier returns ended in
 * and a scan sees, the share that it ends in too and does not look through; the mean over scans. */
struct Agreement {
    double posed = 1;     ///< placed by their poses
    double unposed = 1;   ///< all placed by the first pose
    double inverted = 1;  ///< placed by the inverses of their poses
};

/** The cells that returns ended in so far. */
class SeenCells {
 public:
    using Cells = std::unordered_set<uint64_t>;

    void add(const std::vector<Ray>& rays);
    /** The mean agreement of the scans added so far; 1 if none saw what another had seen. */
    [[nodiscard]] double agreement() const;
    /** Cells that the mean is made of. */
    [[nodiscard]] std::size_t compared() const { return compared_; }
    [[nodiscard]] const Cells& cells() const { return cells_; }

 private:
    Cells cells_;
    double sum_ = 0;
    std::size_t scans_ = 0, compared_ = 0;
};

/** Looks at scans one by one, and keeps what `akimap check` tells of them. */
class ScanSurvey {
 public:
    /** \param rays of each scan that are compared, at most */
    explicit ScanSurvey(std::size_t rays = 5000) : rays_(rays) {}

    void add(const Scan& scan, const std::vector<Ray>& rays);

    struct Step {
        std::size_t scan = 0;  ///< from that one to the next, counted from 1
        double metres = 0;
    };

    [[nodiscard]] std::size_t scans() const { return poses_.size(); }
    [[nodiscard]] const std::vector<double>& pointCounts() const { return points_; }
    [[nodiscard]] const std::vector<mrpt::poses::CPose3D>& poses() const { return poses_; }
    [[nodiscard]] const std::vector<double>& times() const { return times_; }  ///< [s], if known
    [[nodiscard]] const std::array<double, 3>& lowest() const { return lowest_; }
    [[nodiscard]] const std::array<double, 3>& highest() const { return highest_; }
    [[nodiscard]] const std::vector<double>& ranges() const { return ranges_; }  ///< [m], some
    [[nodiscard]] std::vector<Step> steps() const;
    [[nodiscard]] std::size_t timesOutOfOrder() const;
    [[nodiscard]] Agreement agreement() const;
    /** "+z" and the like: where the flat thing that most returns lie on, the floor, is low. */
    [[nodiscard]] std::string upAxis() const;
    /** Cells that the agreement is made of: few tell little. */
    [[nodiscard]] std::size_t compared() const { return posed_.compared(); }
    /** How the poses do not match the scans, a line each. */
    [[nodiscard]] std::vector<std::string> mismatches() const;
    /** What looks wrong, a line each; mismatches too. */
    [[nodiscard]] std::vector<std::string> findings() const;

 private:
    void compare(const mrpt::poses::CPose3D& sensor, const std::vector<Ray>& rays);

    std::size_t rays_;
    std::vector<mrpt::poses::CPose3D> poses_;  // of the sensors, in the map
    std::vector<double> points_, times_, ranges_;
    std::array<double, 3> lowest_, highest_;
    SeenCells posed_, unposed_, inverted_;
};

}  // namespace akimap::app
