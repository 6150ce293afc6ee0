// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "sensors/beams.h"

#include <cmath>

namespace akimap {

using namespace mrpt::obs;

std::mutex& observationMutex() {
    static std::mutex mutex;
    return mutex;
}

void loadOnce(const CObservation3DRangeScan& o) {
    const std::lock_guard lock(observationMutex());
    const bool loaded = (o.hasRangeImage && o.rangeImage.size() > 0) || !o.points3D_x.empty();
    if (!loaded) o.load();
}
void loadOnce(const CObservationPointCloud& o) {
    const std::lock_guard lock(observationMutex());
    if (!o.pointcloud || o.pointcloud->empty()) o.load();
}
void loadOnce(const CObservation& o) {
    const std::lock_guard lock(observationMutex());
    o.load();
}

const std::vector<std::pair<double, double>>& directionsOf(const CObservation2DRangeScan& o) {
    struct Table {
        double aperture = 0;
        bool right_to_left = false;
        std::vector<std::pair<double, double>> directions;
    };
    thread_local Table last;
    const std::size_t n = o.getScanSize();
    const auto aperture = static_cast<double>(o.aperture);
    if (last.directions.size() == n && last.aperture == aperture &&
        last.right_to_left == o.rightToLeft)
        return last.directions;
    last.directions.clear();
    last.directions.reserve(n);
    for (std::size_t i = 0; i < n; i++) {
        const double angle = o.getScanAngle(i);
        last.directions.emplace_back(std::cos(angle), std::sin(angle));
    }
    last.aperture = aperture, last.right_to_left = o.rightToLeft;
    return last.directions;
}

const CObservation3DRangeScan::unproject_LUT_t& unprojectionOf(const CObservation3DRangeScan& o,
                                                               std::size_t pixels) {
    const std::lock_guard lock(observationMutex());
    const auto& table = o.get_unproj_lut();
    if (table.Kxs.size() != pixels)
        throw std::runtime_error("CObservation3DRangeScan '" + o.sensorLabel +
                                 "': range image of " + std::to_string(pixels) +
                                 " pixels, camera model of " + std::to_string(table.Kxs.size()));
    return table;
}

}  // namespace akimap
