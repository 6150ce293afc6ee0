// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pictures/plot/plot.h"

namespace akimap::app {

/** Places the numbers of an axis along a stretch of the picture, and chooses its ticks. */
class Scale {
 public:
    struct Tick {
        double value;
        std::string label;
    };

    /** \param data what has to fit, unless the axis says otherwise */
    Scale(const Axis& axis, const std::vector<double>& data);

    /** From 0 at the axis' lower end to 1 at the upper one; outside it, less or more. */
    [[nodiscard]] double place(double value) const;
    [[nodiscard]] double min() const { return min_; }
    [[nodiscard]] double max() const { return max_; }
    [[nodiscard]] const std::vector<Tick>& ticks() const { return ticks_; }

 private:
    void chooseLinear(const Axis& axis, double low, double high);
    void chooseLogarithmic(const Axis& axis, double low, double high);

    bool logarithmic_;
    double min_ = 0, max_ = 1;
    std::vector<Tick> ticks_;
};

}  // namespace akimap::app
