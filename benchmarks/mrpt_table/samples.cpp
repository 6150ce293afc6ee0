// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/obs/CRawlog.h>

#include <cmath>

#include "Sample.h"
#include "mrpt/mrpt_compat.h"
#include "simulation/simulate.h"

#if AKIMAP_HAS_ROTATING_SCAN
#include <mrpt/obs/CObservationRotatingScan.h>
#endif

namespace akimap::bench {

using namespace mrpt::obs;
using mrpt::math::TPoint3D;
using mrpt::poses::CPose3D;

namespace {

constexpr float kWall = 1.85f;  // [m] ahead of the sensor; mid-cell in the map
constexpr int kColumns = 64, kRows = 48;
const CPose3D kRobot(1, 0, 0, 0, 0, 0), kSensor(0.3, 0, 0.55, 0, 0, 0);

template <class Observation>
typename Observation::Ptr observed() {
    auto o = Observation::Create();
    o->sensorLabel = "SENSOR";
    o->timestamp = mrpt::Clock::fromDouble(1.7e9);
    return o;
}

/** As a pinhole camera of 100 pixels focal length sees the wall. */
std::vector<TPoint3D> wall() {
    std::vector<TPoint3D> points;
    for (int r = 0; r < kRows; r++)
        for (int c = 0; c < kColumns; c++)
            points.emplace_back(kWall, (31.5f - static_cast<float>(c)) * kWall / 100,
                                (23.5f - static_cast<float>(r)) * kWall / 100);
    return points;
}

CObservation3DRangeScan::Ptr depthImage(const CPose3D& sensor = kSensor) {
    auto o = observed<CObservation3DRangeScan>();
    o->sensorPose = sensor;
    o->cameraParams.ncols = kColumns, o->cameraParams.nrows = kRows;
    o->cameraParams.setIntrinsicParamsFromValues(100, 100, 31.5, 23.5);
    o->range_is_depth = true, o->rangeUnits = 0.001f, o->maxRange = 10;
    o->hasRangeImage = true;
    o->rangeImage_setSize(kRows, kColumns);
    o->rangeImage.fill(static_cast<uint16_t>(std::lround(1000 * kWall)));
    return o;
}

/** Its image in a file, as rawlog-grabber leaves it. */
CObservation3DRangeScan::Ptr externalImage(const std::string& folder) {
    auto o = depthImage();
    o->rangeImage_convertToExternalStorage("range.bin", folder + "/");
    mrpt::img::CImage::setImagesPathBase(folder);
    return o;
}

CObservation3DRangeScan::Ptr onlyPoints() {
    auto o = observed<CObservation3DRangeScan>();
    o->sensorPose = kSensor, o->maxRange = 10;
    setPoints(*o, wall());
    return o;
}

CObservationVelodyneScan::Ptr velodyneCloud() {
    auto o = observed<CObservationVelodyneScan>();
    o->sensorPose = kSensor, o->minRange = 0.1, o->maxRange = 10;
    for (const TPoint3D& p : wall()) {
        o->point_cloud.x.push_back(static_cast<float>(p.x));
        o->point_cloud.y.push_back(static_cast<float>(p.y));
        o->point_cloud.z.push_back(static_cast<float>(p.z));
        o->point_cloud.intensity.push_back(0);
    }
    return o;
}

Sample velodynePackets() {
    app::SimulationOptions options;
    options.sensor = app::SensorKind::velodyne;
    const auto scan = app::simulate(options).scans.at(0);
    Sample s{"`CObservationVelodyneScan`, packets", scan.observation, scan.robot_pose, {}};
    const CPose3D sensor = s.sensor();
    for (const Ray& r : scan.rays)
        s.in_sensor.push_back(sensor.inverseComposePoint({r.end[0], r.end[1], r.end[2]}));
    return s;
}

Sample laserScan() {
    auto o = observed<CObservation2DRangeScan>();
    o->sensorPose = kSensor, o->maxRange = 10, o->aperture = 0.6f;
    o->resizeScan(61);
    Sample s{"`CObservation2DRangeScan`", o, kRobot, {}};
    for (std::size_t i = 0; i < 61; i++) {
        const double a = o->getScanAngle(i), range = kWall / std::cos(a);
        o->setScanRange(i, static_cast<float>(range)), o->setScanRangeValidity(i, true);
        s.in_sensor.emplace_back(kWall, range * std::sin(a), 0);
    }
    return s;
}

CObservationPointCloud::Ptr cloud(bool with_nan) {
    auto o = observed<CObservationPointCloud>();
    o->sensorPose = kSensor;
    o->pointcloud = mrpt::maps::CSimplePointsMap::Create();
    for (const TPoint3D& p : wall())
        o->pointcloud->insertPointFast(static_cast<float>(p.x), static_cast<float>(p.y),
                                       static_cast<float>(p.z));
    if (with_nan) o->pointcloud->insertPointFast(NAN, NAN, NAN);
    return o;
}

CObservationRange::Ptr sonar() {
    auto o = observed<CObservationRange>();
    o->maxSensorDistance = 10;
    o->sensedData.resize(1);
    o->sensedData[0].sensorPose = kSensor.asTPose();
    o->sensedData[0].sensedDistance = kWall;
    return o;
}

#if AKIMAP_HAS_ROTATING_SCAN
CObservationRotatingScan::Ptr rotatingScan() {
    auto o = observed<CObservationRotatingScan>();
    o->sensorPose = kSensor, o->rowCount = kRows, o->columnCount = kColumns;
    o->rangeResolution = 0.001, o->startAzimuth = -0.3, o->azimuthSpan = 0.6;
    o->rangeImage.resize(kRows, kColumns), o->organizedPoints.resize(kRows, kColumns);
    const auto points = wall();
    for (int r = 0; r < kRows; r++)
        for (int c = 0; c < kColumns; c++) {
            const auto& p = points[static_cast<std::size_t>(r * kColumns + c)];
            o->rangeImage(r, c) = static_cast<uint16_t>(std::lround(1000 * p.norm()));
            o->organizedPoints(r, c) = p.cast<float>();
        }
    return o;
}
#endif

}  // namespace

void setPoints(CObservation3DRangeScan& scan, const std::vector<TPoint3D>& points) {
    scan.hasPoints3D = true;
    scan.resizePoints3DVectors(points.size());
    for (std::size_t i = 0; i < points.size(); i++) {
        scan.points3D_x[i] = static_cast<float>(points[i].x);
        scan.points3D_y[i] = static_cast<float>(points[i].y);
        scan.points3D_z[i] = static_cast<float>(points[i].z);
    }
}

Sample plainSample() {
    const auto scan = depthImage(CPose3D());
    setPoints(*scan, wall());
    return {"", scan, kRobot + kSensor, wall()};
}

std::vector<Sample> samples(const std::string& folder) {
    auto no_cloud = observed<CObservationPointCloud>();
    no_cloud->sensorPose = kSensor;
    return {
        {"`CObservation3DRangeScan`, range image", depthImage(), kRobot, wall()},
            {"`CObservation3DRangeScan`, image in a file", externalImage(folder), kRobot, wall()},
            {"`CObservation3DRangeScan`, points", onlyPoints(), kRobot, wall()},
            {"`CObservationVelodyneScan`, point cloud", velodyneCloud(), kRobot, wall()},
            velodynePackets(),
#if AKIMAP_HAS_ROTATING_SCAN
            {"`CObservationRotatingScan`", rotatingScan(), kRobot, wall()},
#endif
            laserScan(), {"`CObservationPointCloud`", cloud(false), kRobot, wall()},
            {"`CObservationPointCloud`, a point is NaN", cloud(true), kRobot, wall()},
            {"`CObservationPointCloud` without a cloud", no_cloud, kRobot, {}},
            {"`CObservationRange` (sonar)", sonar(), kRobot, {}},
            {"`CObservationIMU`", observed<CObservationIMU>(), kRobot, {}},
    };
}

}  // namespace akimap::bench
