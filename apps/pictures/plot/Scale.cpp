// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "pictures/plot/Scale.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace akimap::app {

namespace {

/** 1, 2 or 5 times a power of ten, for four to ten ticks in the range. */
double roundStep(double range) {
    const double power = std::pow(10, std::floor(std::log10(range / 4)));
    for (const double factor : {5., 2.})
        if (range / (factor * power) >= 4) return factor * power;
    return power;
}

std::string linearLabel(double value, double step) {
    std::ostringstream text;
    if (std::abs(value) >= 1e7 || step < 1e-5)
        text << value;
    else
        text << std::fixed
             << std::setprecision(
                    std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9))))
             << value;
    return text.str();
}

std::string powerOfTen(int exponent) {
    static const char* const kSuperscripts[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    if (exponent == 0) return "1";
    if (exponent == 1) return "10";
    std::string text = exponent < 0 ? "10⁻" : "10";
    for (const char digit : std::to_string(std::abs(exponent))) text += kSuperscripts[digit - '0'];
    return text;
}

}  // namespace

Scale::Scale(const Axis& axis, const std::vector<double>& data) : logarithmic_(axis.logarithmic) {
    double low = INFINITY, high = -INFINITY;
    for (const double v : data)
        if (std::isfinite(v) && (v > 0 || !logarithmic_)) {
            low = std::min(low, v);
            high = std::max(high, v);
        }
    if (!(low <= high)) low = high = 1;
    logarithmic_ ? chooseLogarithmic(axis, low, high) : chooseLinear(axis, low, high);
}

void Scale::chooseLinear(const Axis& axis, double low, double high) {
    low = axis.min.value_or(low);
    high = axis.max.value_or(high);
    if (!(high - low > 1e-9 * std::max(std::abs(low), std::abs(high)))) {
        const double room = low == 0 ? 1 : std::abs(low) / 2;
        if (!axis.min) low -= room;
        high = std::max(high, low) + room;
    }
    const double step = roundStep(high - low);
    min_ = axis.min.value_or(step * std::floor(low / step + 1e-6));
    max_ = axis.max && *axis.max > min_ ? *axis.max : step * std::ceil(high / step - 1e-6);
    for (double i = std::ceil(min_ / step - 1e-6); i * step <= max_ + 1e-6 * step; i++)
        ticks_.push_back({i * step, linearLabel(i == 0 ? 0 : i * step, step)});
}

void Scale::chooseLogarithmic(const Axis& axis, double low, double high) {
    const auto positive = [](const std::optional<double>& v) { return v && *v > 0; };
    min_ = positive(axis.min) ? *axis.min : std::pow(10, std::floor(std::log10(low)));
    max_ = positive(axis.max) ? *axis.max : std::pow(10, std::ceil(std::log10(high)));
    if (!(max_ > min_)) max_ = 10 * min_;
    const int first = static_cast<int>(std::ceil(std::log10(min_) - 1e-9));
    const int last = static_cast<int>(std::floor(std::log10(max_) + 1e-9));
    const int step = std::max(1, (last - first + 5) / 6);
    for (int i = first; i <= last; i += step) ticks_.push_back({std::pow(10, i), powerOfTen(i)});
}

double Scale::place(double value) const {
    if (!logarithmic_) return (value - min_) / (max_ - min_);
    return std::log(std::max(value, 1e-300) / min_) / std::log(max_ / min_);
}

}  // namespace akimap::app
