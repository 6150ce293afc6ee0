// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "sensors/beams.h"

#include <array>
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

namespace {

struct Camera {
    mrpt::img::TCamera model;
    bool range_is_depth = false;
    std::shared_ptr<const PixelDirections> directions;
};

std::shared_ptr<const PixelDirections> copyOfMrptsTable(const CObservation3DRangeScan& o) {
    const auto& table = o.get_unproj_lut();
    auto copy = std::make_shared<PixelDirections>();
    copy->x.assign(table.Kxs.begin(), table.Kxs.end());
    copy->y.assign(table.Kys.begin(), table.Kys.end());
    copy->z.assign(table.Kzs.begin(), table.Kzs.end());
    return copy;
}

void requireCamerasSize(const CObservation3DRangeScan& o) {
    const auto text = [](auto columns, auto rows) {
        return std::to_string(columns) + " x " + std::to_string(rows) + " pixels";
    };
    const auto columns = o.rangeImage.cols(), rows = o.rangeImage.rows();
    const auto& camera = o.cameraParams;
    if (columns != static_cast<int>(camera.ncols) || rows != static_cast<int>(camera.nrows))
        throw std::runtime_error("CObservation3DRangeScan '" + o.sensorLabel +
                                 "': range image of " + text(columns, rows) + ", camera model of " +
                                 text(camera.ncols, camera.nrows));
}

}  // namespace

std::shared_ptr<const PixelDirections> pixelDirectionsOf(const CObservation3DRangeScan& o) {
    requireCamerasSize(o);
    static std::array<Camera, 8> known;  // more than a robot has
    static std::size_t oldest = 0;
    const std::lock_guard lock(observationMutex());
    for (const Camera& camera : known)
        if (camera.directions && camera.range_is_depth == o.range_is_depth &&
            camera.model == o.cameraParams)
            return camera.directions;
    Camera& camera = known[oldest];
    camera.directions = copyOfMrptsTable(o);
    camera.model = o.cameraParams;
    camera.range_is_depth = o.range_is_depth;
    oldest = (oldest + 1) % known.size();
    return camera.directions;
}

}  // namespace akimap
