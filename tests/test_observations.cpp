// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/AkiMap.h>
#include <akimap/rays.h>
#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/system/CObserver.h>

#include <cstring>
#include <set>

#include "mrpt/mrpt_compat.h"
#include "random_scans.h"
#include "same_map.h"

#if AKIMAP_HAS_ROTATING_SCAN
#include <mrpt/obs/CObservationRotatingScan.h>
#endif

using namespace akimap;
using namespace mrpt::obs;
using mrpt::poses::CPose3D;
using test::cellsFingerprint;

namespace {

const CPose3D kRobot(1.2, -0.7, 0.3, 0.8, 0.1, -0.05), kSensor(0.2, 0.1, 0.6, -0.3, 0.2, 0.1);
const std::string kDatasets = "/usr/share/mrpt/datasets/";

std::vector<mrpt::math::TPoint3Df> pointsInSensor() {
    std::vector<mrpt::math::TPoint3Df> points;
    for (const Ray& r : test::randomScan(4, 400))
        points.emplace_back(static_cast<float>(r.end[0]), static_cast<float>(r.end[1]),
                            static_cast<float>(r.end[2]));
    return points;
}

CObservationPointCloud asPointCloud() {
    CObservationPointCloud o;
    o.sensorPose = kSensor;
    o.pointcloud = mrpt::maps::CSimplePointsMap::Create();
    for (const auto& p : pointsInSensor()) o.pointcloud->insertPointFast(p.x, p.y, p.z);
    return o;
}
CObservation3DRangeScan as3DRangeScan() {
    CObservation3DRangeScan o;
    o.sensorPose = kSensor;
    o.hasPoints3D = true;
    const auto points = pointsInSensor();
    o.resizePoints3DVectors(points.size());
    for (std::size_t i = 0; i < points.size(); i++)
        o.points3D_x[i] = points[i].x, o.points3D_y[i] = points[i].y, o.points3D_z[i] = points[i].z;
    return o;
}
CObservationVelodyneScan asVelodyneCloud() {
    CObservationVelodyneScan o;
    o.sensorPose = kSensor;
    for (const auto& p : pointsInSensor()) {
        o.point_cloud.x.push_back(p.x), o.point_cloud.y.push_back(p.y),
            o.point_cloud.z.push_back(p.z);
        o.point_cloud.intensity.push_back(0);
    }
    return o;
}
#if AKIMAP_HAS_ROTATING_SCAN
/** In two rows, and a column without returns. */
CObservationRotatingScan asRotatingScan() {
    const auto points = pointsInSensor();
    const int columns = static_cast<int>(points.size()) / 2;
    CObservationRotatingScan o;
    o.sensorPose = kSensor;
    o.rowCount = 2, o.columnCount = static_cast<uint16_t>(columns + 1);
    o.rangeImage.setZero(2, columns + 1), o.organizedPoints.resize(2, columns + 1);
    for (int i = 0; i < 2 * columns; i++) {
        o.rangeImage(i / columns, i % columns) = 1;
        o.organizedPoints(i / columns, i % columns) = points[static_cast<std::size_t>(i)];
    }
    o.organizedPoints(0, columns) = o.organizedPoints(1, columns) = {1, 2, 3};
    return o;
}
#endif
/** A tilted plane 2 to 3 m ahead. */
CObservation3DRangeScan asDepthImage(bool range_is_depth) {
    CObservation3DRangeScan o;
    o.sensorPose = kSensor;
    o.cameraParams.ncols = 64, o.cameraParams.nrows = 48;
    o.cameraParams.setIntrinsicParamsFromValues(50, 50, 31.5, 23.5);
    o.range_is_depth = range_is_depth, o.rangeUnits = 0.001f;
    o.hasRangeImage = true;
    o.rangeImage_setSize(48, 64);
    for (int r = 0; r < 48; r++)
        for (int c = 0; c < 64; c++)
            o.rangeImage(r, c) = static_cast<uint16_t>(2000 + 15 * c + 3 * r);
    o.rangeImage(3, 5) = 0;  // no return
    return o;
}
CObservation2DRangeScan as2D() {
    CObservation2DRangeScan o;
    o.sensorPose = kSensor;
    o.aperture = 3.0f;
    o.resizeScan(181);
    for (std::size_t i = 0; i < 181; i++) {
        o.setScanRange(i, 2.0f + 0.01f * static_cast<float>(i));
        o.setScanRangeValidity(i, i % 10 != 0);
    }
    return o;
}

std::string bytesOf(const CObservation& o) {
    mrpt::io::CMemoryStream stream;
    auto archive = mrpt::serialization::archiveFrom(stream);
    archive << o;
    return {static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount()};
}

std::vector<Ray> rays(const CObservation& o, const CPose3D& robot = kRobot) {
    return raysOf(o, [&](mrpt::Clock::time_point) { return std::optional(robot); }).value();
}

CObservation::Ptr firstOf(const std::string& rawlog) {
    mrpt::obs::CRawlog log;
    EXPECT_TRUE(log.loadFromRawLogFile(kDatasets + rawlog));
    for (std::size_t i = 0; i < log.size(); i++) {
        if (log.getType(i) == CRawlog::etObservation) return log.getAsObservation(i);
        if (log.getType(i) == CRawlog::etSensoryFrame)
            return log.getAsObservations(i)->getObservationByIndex(0);
    }
    return {};
}

}  // namespace

TEST(Observations, SamePointsByAnyClassGiveTheSameBits) {
    AkiMap cloud, range, velodyne;
    ASSERT_TRUE(cloud.insertObservation(asPointCloud(), kRobot));
    ASSERT_TRUE(range.insertObservation(as3DRangeScan(), kRobot));
    ASSERT_TRUE(velodyne.insertObservation(asVelodyneCloud(), kRobot));
    EXPECT_EQ(cellsFingerprint(range), cellsFingerprint(cloud));
    EXPECT_EQ(cellsFingerprint(velodyne), cellsFingerprint(cloud));
#if AKIMAP_HAS_ROTATING_SCAN
    AkiMap rotating;
    ASSERT_TRUE(rotating.insertObservation(asRotatingScan(), kRobot));
    EXPECT_EQ(cellsFingerprint(rotating), cellsFingerprint(cloud));
#endif
}

TEST(Observations, RaysAreRobotPlusSensorPlusPoint) {
    const CPose3D sensor_in_map = kRobot + kSensor;
    const auto expectFrom = [&](const CObservation& o, std::size_t i, double x, double y,
                                double z) {
        const Ray r = rays(o).at(i);
        const auto p = sensor_in_map.composePoint(mrpt::math::TPoint3D(x, y, z));
        EXPECT_NEAR(r.end[0], p.x, 1e-5);
        EXPECT_NEAR(r.end[1], p.y, 1e-5);
        EXPECT_NEAR(r.end[2], p.z, 1e-5);
        EXPECT_DOUBLE_EQ(r.origin[0], sensor_in_map.x());
        EXPECT_DOUBLE_EQ(r.origin[2], sensor_in_map.z());
    };
    const auto first = pointsInSensor()[0];
    expectFrom(asPointCloud(), 0, first.x, first.y, first.z);
    // Beam 1 of 181 over 3 rad, from the right: angle -1.5 + 1 / 60.
    expectFrom(as2D(), 0, 2.01 * std::cos(-1.5 + 1.0 / 60), 2.01 * std::sin(-1.5 + 1.0 / 60), 0);
    // Pixel (0, 0): x ahead, y to the left, z up.
    expectFrom(asDepthImage(true), 0, 2.0, 2.0 * 31.5 / 50, 2.0 * 23.5 / 50);
    const double along = 2.0 / std::sqrt(1 + std::pow(31.5 / 50, 2) + std::pow(23.5 / 50, 2));
    expectFrom(asDepthImage(false), 0, along, along * 31.5 / 50, along * 23.5 / 50);
}

TEST(Observations, InvalidReturnsAreLeftOut) {
    EXPECT_EQ(rays(asDepthImage(true)).size(), 48u * 64u - 1);
    EXPECT_EQ(rays(as2D()).size(), 181u - 19u);
    AkiMap map;
    auto cloud = asPointCloud();
    cloud.pointcloud->insertPointFast(0, 0, 0);
    cloud.pointcloud->insertPointFast(NAN, 1, 1);
    map.insertObservation(cloud, kRobot);
    EXPECT_EQ(map.stats().dropped_zero, 1u);
    EXPECT_EQ(map.stats().dropped_nonfinite, 1u);
}

TEST(Observations, RangeImageIsPreferredToShrunkPoints) {
    auto both = asDepthImage(true);
    both.hasPoints3D = true;
    both.resizePoints3DVectors(7);
    EXPECT_EQ(rays(both).size(), 48u * 64u - 1);
}

TEST(Observations, DepthImageAgreesWithMrptsOwnPoints) {
    auto o = asDepthImage(true);
    mrpt::maps::CSimplePointsMap unprojected;
    mrpt::obs::T3DPointsProjectionParams params;
    params.takeIntoAccountSensorPoseOnRobot = true;
    o.unprojectInto(unprojected, params);
    const auto own = rays(o, CPose3D());
    ASSERT_EQ(own.size(), unprojected.size());
    for (std::size_t i = 0; i < own.size(); i += 50) {
        float x = 0, y = 0, z = 0;
        unprojected.getPoint(i, x, y, z);
        EXPECT_NEAR(own[i].end[0], x, 1e-4);
        EXPECT_NEAR(own[i].end[1], y, 1e-4);
        EXPECT_NEAR(own[i].end[2], z, 1e-4);
    }
}

TEST(Observations, NothingIsChangedByBeingInsertedOrScored) {
    AkiMap map;
    const auto check = [&](const CObservation& o) {
        const auto before = bytesOf(o);
        EXPECT_TRUE(map.insertObservation(o, kRobot));
        (void)map.computeObservationLikelihood(o, kRobot);
        EXPECT_TRUE(bytesOf(o) == before) << o.GetRuntimeClass()->className;
    };
    check(asPointCloud());
    check(as3DRangeScan());
    check(asVelodyneCloud());
    check(asDepthImage(true));
    check(as2D());
    if (const auto real = firstOf("test_velodyne_VLP16.rawlog")) check(*real);
}

TEST(Observations, UnusableOnesReturnFalse) {
    AkiMap map;
    EXPECT_FALSE(map.insertObservation(CObservationImage()));
    EXPECT_FALSE(map.insertObservation(CObservationPointCloud()));  // without a cloud
    EXPECT_FALSE(map.insertObservation(CObservation3DRangeScan()));
    EXPECT_FALSE(map.insertObservation(CObservationVelodyneScan()));
    EXPECT_TRUE(map.isEmpty());
    EXPECT_FALSE(map.canComputeObservationLikelihood(CObservationImage()));
    EXPECT_TRUE(map.canComputeObservationLikelihood(as2D()));

    auto mismatched = asDepthImage(true);
    mismatched.cameraParams.ncols = 10;
    EXPECT_THROW(map.insertObservation(mismatched), std::exception);
#if AKIMAP_HAS_ROTATING_SCAN
    EXPECT_FALSE(map.insertObservation(CObservationRotatingScan()));
    auto unranged = asRotatingScan();
    unranged.rangeImage.resize(0, 0);
    EXPECT_THROW(map.insertObservation(unranged), std::exception);
#endif
}

TEST(Observations, VelodynePacketsAgreeWithTheirDecodedCloud) {
    const auto packets =
        std::dynamic_pointer_cast<CObservationVelodyneScan>(firstOf("test_velodyne_VLP16.rawlog"));
    if (!packets) GTEST_SKIP() << "mrpt-common's datasets are not installed";
    ASSERT_TRUE(packets->point_cloud.x.empty());
    auto decoded = *packets;
    decoded.generatePointCloud();
    AkiMap a, b;
    a.insertionOptions.max_range = b.insertionOptions.max_range = 20;
    ASSERT_TRUE(a.insertObservation(*packets, kRobot));
    ASSERT_TRUE(b.insertObservation(decoded, kRobot));
    EXPECT_GT(a.cellCount(), 10000u);
    EXPECT_EQ(cellsFingerprint(a), cellsFingerprint(b));
}

TEST(Observations, EachPacketOfAMovingScanHasItsOwnOrigin) {
    const auto packets = firstOf("test_velodyne_VLP16.rawlog");
    if (!packets) GTEST_SKIP() << "mrpt-common's datasets are not installed";
    const auto start = packets->timestamp;
    const AkiMap::RobotPoseAt moving = [&](mrpt::Clock::time_point t) -> std::optional<CPose3D> {
        return CPose3D(1e4 * std::chrono::duration<double>(t - start).count(), 0, 0, 0, 0, 0);
    };
    std::set<double> origins;
    const auto moved = raysOf(*packets, moving).value();
    const auto still = rays(*packets, CPose3D());
    ASSERT_EQ(moved.size(), still.size());
    for (std::size_t i = 0; i < moved.size(); i++) {
        origins.insert(moved[i].origin[0]);
        // Moved as a whole: the end as far as the origin.
        ASSERT_NEAR(moved[i].end[0] - moved[i].origin[0], still[i].end[0] - still[i].origin[0],
                    1e-6);
    }
    EXPECT_GT(origins.size(), 50u);  // of 75 packets

    EXPECT_NEAR(*origins.begin() - still[0].origin[0], 0,
                1e-6);  // the first packet's is the scan's time

    // A cloud decoded by MRPT has no times: the packets have.
    auto decoded = dynamic_cast<const CObservationVelodyneScan&>(*packets);
    decoded.generatePointCloud();
    const auto again = raysOf(decoded, moving, true).value();
    ASSERT_EQ(again.size(), moved.size());
    EXPECT_EQ(again.back().origin, moved.back().origin);

    const AkiMap::RobotPoseAt unknown = [](mrpt::Clock::time_point) {
        return std::optional<CPose3D>();
    };
    AkiMap map;
    EXPECT_FALSE(map.insertMovingObservation(*packets, unknown));
    EXPECT_EQ(map.stats().dropped_poses, 75u);
    EXPECT_TRUE(map.insertMovingObservation(*packets, moving));
}

TEST(Observations, NearVelodyneReturnsAreLeftToOurRangeRule) {
    const auto scan =
        std::dynamic_pointer_cast<CObservationVelodyneScan>(firstOf("test_velodyne_VLP16.rawlog"));
    if (!scan) GTEST_SKIP() << "mrpt-common's datasets are not installed";
    auto near = *scan;
    near.minRange = 0.1;
    const std::size_t all = rays(near).size();
    for (auto& packet : near.scan_packets)
        for (auto& block : packet.blocks)
            for (auto& r : block.laser_returns) {
                uint16_t distance = 0;  // its first two bytes, little-endian
                std::memcpy(&distance, &r, sizeof distance);
                distance = static_cast<uint16_t>(distance / 4);
                std::memcpy(static_cast<void*>(&r), &distance, sizeof distance);
            }
    EXPECT_GT(rays(near).size(), all * 99 / 100);  // MRPT's default would drop all within 1 m
}

TEST(Observations, EventsAndGenericOptionsAreHonoured) {
    struct Listener : mrpt::system::CObserver {
        int inserted = 0, cleared = 0;
        void OnEvent(const mrpt::system::mrptEvent& e) override {
            inserted += e.isOfType<mrpt::maps::mrptEventMetricMapInsert>();
            cleared += e.isOfType<mrpt::maps::mrptEventMetricMapClear>();
        }
    } listener;
    AkiMap map;
    listener.observeBegin(map);
    map.insertObservation(asPointCloud());
    map.insertMovingObservation(asPointCloud(),
                                [](mrpt::Clock::time_point) { return std::optional(CPose3D()); });
    map.insertObservation(CObservationImage());
    map.clear();
    EXPECT_EQ(listener.inserted, 2);
    EXPECT_EQ(listener.cleared, 1);
    map.genericMapParams.enableObservationInsertion = false;
    EXPECT_FALSE(map.insertObservation(asPointCloud()));
    EXPECT_TRUE(map.isEmpty());
}

TEST(Observations, LikelihoodIsFiniteAndPeaksAtTheTruePose) {
    AkiMap map;
    for (int i = 0; i < 5; i++) map.insertObservation(asDepthImage(true), kRobot);
    const auto score = [&](double dx, double dyaw) {
        return map.computeObservationLikelihood(asDepthImage(true),
                                                kRobot + CPose3D(dx, 0, 0, dyaw, 0, 0));
    };
    const double best = score(0, 0);
    EXPECT_TRUE(std::isfinite(best));
    EXPECT_GT(best, score(0.3, 0));
    EXPECT_GT(best, score(-0.3, 0));
    EXPECT_GT(best, score(0, 0.2));
    EXPECT_TRUE(std::isfinite(score(1e6, 0)));
    EXPECT_TRUE(std::isfinite(AkiMap().computeObservationLikelihood(asPointCloud(), kRobot)));
}
