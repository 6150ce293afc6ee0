// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "checking/ScanSurvey.h"

#include <mrpt/core/Clock.h>
#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "quantile.h"

namespace akimap::app {

namespace {

using mrpt::poses::CPose3D;
using Place = std::array<double, 3>;

constexpr double kCell = 0.2;   // [m]
constexpr int kHalf = 1 << 20;  // cells each way: 200 km

int cellOf(double metres) {
    return static_cast<int>(std::floor(std::clamp(metres / kCell, -1. * kHalf, kHalf - 1.)));
}

uint64_t keyOf(const Place& p) {
    uint64_t key = 0;
    for (const double v : p) key = key << 21 | static_cast<uint64_t>(cellOf(v) + kHalf);
    return key;
}

int coordinateOf(uint64_t key, int axis) {
    return static_cast<int>(key >> (21 * (2 - axis)) & (2 * kHalf - 1)) - kHalf;
}

bool isFinite(const Ray& ray) {
    return std::isfinite(ray.end[0] + ray.end[1] + ray.end[2]) && lengthOf(ray) > 0;
}

}  // namespace

void SeenCells::add(const std::vector<Ray>& rays) {
    constexpr double kBehind = 2 * kCell;  // [m] so near its end a ray grazes what it hits
    Cells ends, passed;
    for (const Ray& ray : rays) ends.insert(keyOf(ray.end));
    for (const Ray& ray : rays) {
        const double length = lengthOf(ray);
        for (double d = kCell; d < length - kBehind; d += kCell) {
            const uint64_t cell = keyOf(placeAlong(ray, d / length));
            if (cells_.count(cell) && !ends.count(cell)) passed.insert(cell);
        }
    }
    const auto both =
        std::count_if(ends.begin(), ends.end(), [&](uint64_t cell) { return cells_.count(cell); });
    if (both + static_cast<std::ptrdiff_t>(passed.size()) > 0) {
        sum_ += static_cast<double>(both) / static_cast<double>(both + passed.size());
        scans_++;
        compared_ += static_cast<std::size_t>(both) + passed.size();
    }
    cells_.insert(ends.begin(), ends.end());
}

double SeenCells::agreement() const {
    return scans_ == 0 ? 1 : sum_ / static_cast<double>(scans_);
}

void ScanSurvey::add(const Scan& scan, const std::vector<Ray>& rays) {
    CPose3D sensor = scan.robot_pose + (scan.observation ? CPose3D() : scan.sensor_pose);
    if (scan.observation) {
        CPose3D on_robot;
        scan.observation->getSensorPose(on_robot);
        sensor = scan.robot_pose + on_robot;
    }
    if (poses_.empty()) {
        lowest_.fill(std::numeric_limits<double>::infinity());
        highest_.fill(-std::numeric_limits<double>::infinity());
    }
    if (const auto time = timeOf(scan)) times_.push_back(mrpt::Clock::toDouble(*time));
    std::size_t finite = 0;
    for (const Ray& ray : rays) {
        if (!isFinite(ray)) continue;
        if (finite++ % 50 == 0) ranges_.push_back(lengthOf(ray));
        for (std::size_t axis = 0; axis < 3; axis++) {
            lowest_[axis] = std::min(lowest_[axis], ray.end[axis]);
            highest_[axis] = std::max(highest_[axis], ray.end[axis]);
        }
    }
    points_.push_back(static_cast<double>(finite));
    poses_.push_back(sensor);
    compare(sensor, rays);
}

void ScanSurvey::compare(const CPose3D& sensor, const std::vector<Ray>& rays) {
    const std::size_t step = rays.size() / rays_ + 1;
    const CPose3D inverse = -sensor;
    std::vector<Ray> posed, unposed, inverted;
    const auto moved = [&](const CPose3D& to, const Ray& ray) {
        Ray out{};
        const auto move = [&](const Place& from, Place& place) {
            Place p{};
            sensor.inverseComposePoint(from[0], from[1], from[2], p[0], p[1], p[2]);
            to.composePoint(p[0], p[1], p[2], place[0], place[1], place[2]);
        };
        move(ray.origin, out.origin), move(ray.end, out.end);
        return out;
    };
    for (std::size_t i = 0; i < rays.size(); i += step) {
        if (!isFinite(rays[i])) continue;
        posed.push_back(rays[i]);
        unposed.push_back(moved(poses_.front(), rays[i]));
        inverted.push_back(moved(inverse, rays[i]));
    }
    posed_.add(posed), unposed_.add(unposed), inverted_.add(inverted);
}

std::vector<ScanSurvey::Step> ScanSurvey::steps() const {
    std::vector<Step> steps;
    for (std::size_t i = 1; i < poses_.size(); i++)
        steps.push_back({i, poses_[i - 1].distanceTo(poses_[i])});
    return steps;
}

std::size_t ScanSurvey::timesOutOfOrder() const {
    std::size_t count = 0;
    for (std::size_t i = 1; i < times_.size(); i++) count += times_[i] < times_[i - 1];
    return count;
}

Agreement ScanSurvey::agreement() const {
    return {posed_.agreement(), unposed_.agreement(), inverted_.agreement()};
}

std::string ScanSurvey::upAxis() const {
    if (posed_.cells().empty()) return "unknown";
    std::string best;
    double best_share = 0;
    for (int axis = 0; axis < 3; axis++) {
        std::map<int, std::size_t> layers;
        for (const uint64_t cell : posed_.cells()) layers[coordinateOf(cell, axis)]++;
        std::size_t below = 0, largest = 0, below_largest = 0;
        for (const auto& [height, count] : layers) {
            if (count > largest) largest = count, below_largest = below + count / 2;
            below += count;
        }
        const double share =
            static_cast<double>(largest) / static_cast<double>(posed_.cells().size());
        if (share <= best_share) continue;
        best_share = share;
        best = std::string(2 * below_largest <= posed_.cells().size() ? "+" : "-") + "xyz"[axis];
    }
    return best;
}

std::vector<std::string> ScanSurvey::findings() const {
    std::vector<std::string> lines;
    const auto all_steps = steps();
    std::vector<double> metres;
    for (const Step& s : all_steps) metres.push_back(s.metres);
    const double usual = metres.empty() ? 0 : quantile(metres, 0.5);
    for (const Step& s : all_steps)
        if (s.metres > 1 && s.metres > 10 * usual)
            lines.push_back(
                mrpt::format("a jump of %.2f m from scan %zu to the next, where %.2f m "
                             "is usual",
                             s.metres, s.scan, usual));
    if (const auto late = timesOutOfOrder())
        lines.push_back(mrpt::format("%zu times are earlier than the scan's before", late));
    if (scans() > 1 && std::all_of(metres.begin(), metres.end(), [](double m) { return m == 0; }))
        lines.emplace_back("all scans have one and the same pose");
    const auto more = mismatches();
    lines.insert(lines.end(), more.begin(), more.end());
    return lines;
}

std::vector<std::string> ScanSurvey::mismatches() const {
    std::vector<std::string> lines;
    const Agreement a = agreement();
    constexpr double kClear = 0.1;
    if (a.unposed > a.posed + kClear)
        lines.push_back(
            mrpt::format("the poses do not match the scans: these agree more (%.2f) "
                         "without them than with them (%.2f)",
                         a.unposed, a.posed));
    if (a.inverted > a.posed + kClear && a.inverted > a.unposed + kClear)
        lines.push_back(
            mrpt::format("the inverses of the poses match better (%.2f): are they of "
                         "the map in the sensor?",
                         a.inverted));
    return lines;
}

}  // namespace akimap::app
