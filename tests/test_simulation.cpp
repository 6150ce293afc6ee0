// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// The simulated drives: exact scenes, observations as MRPT decodes them, truth, and the files.
#include <gtest/gtest.h>
#include <mrpt/core/Clock.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/poses/CPose3DInterpolator.h>
#include <mrpt/poses/CPose3DQuat.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#include "quantile.h"
#include "run_program.h"
#include "simulation/simulate.h"
#include "simulation/truth.h"

namespace {

using namespace akimap::app;
using akimap::Ray;
using mrpt::math::TPoint3D;
using mrpt::math::TVector3D;
using mrpt::obs::CObservationVelodyneScan;
using mrpt::poses::CPose3D;
using mrpt::system::TTimeStamp;

constexpr double kNoise = 0.01;  // [m]

TPoint3D point(const std::array<double, 3>& p) {
    return {p[0], p[1], p[2]};
}
TVector3D randomDirection(Random& random) {
    const double z = random.uniform(-1, 1), a = random.uniform(-M_PI, M_PI);
    const double level = std::sqrt(1 - z * z);
    return {level * std::cos(a), level * std::sin(a), z};
}
SimulationOptions drive(SceneKind scene, SensorKind sensor, uint64_t seed = 1) {
    SimulationOptions options;
    options.scene = scene;
    options.sensor = sensor;
    options.seed = seed;
    return options;
}

class Scenes : public testing::TestWithParam<std::pair<SceneKind, uint64_t>> {
 protected:
    const Scene scene = makeScene(GetParam().first, GetParam().second);
};

/** Walks along the ray in steps that cannot cross a surface, up to the first one. */
double walk(const Scene& scene, const TPoint3D& origin, const TVector3D& direction) {
    double distance = 0;
    for (double step = 1; step > 1e-7 && distance < 20; distance += step)
        step = scene.distanceToSurface(origin + direction * distance);
    return distance;
}

TEST_P(Scenes, rayEndsWhereAWalkFirstMeetsASurface) {
    Random random(GetParam().second, 99);
    int hits = 0;
    for (int i = 0; i < 3000; i++) {
        const ScanPlace& place = scene.places()[static_cast<std::size_t>(i) % 4];
        const TPoint3D origin(place.x, place.y, 0.6);
        const TVector3D direction = randomDirection(random);
        const auto range = scene.castRay(origin, direction);
        const double walked = walk(scene, origin, direction);
        ASSERT_EQ(range.has_value(), walked < 20);
        if (!range) continue;
        hits++;
        EXPECT_NEAR(*range, walked, 1e-3);
        EXPECT_FALSE(scene.castRay(origin, direction, *range - 1e-6));
    }
    EXPECT_GT(hits, 1500);
    EXPECT_LT(hits, 2900);  // there is no ceiling
}

TEST_P(Scenes, surfacePointsLieOnTheirShapesAndFaceOutwards) {
    for (const ShapePtr& shape : scene.shapes()) {
        const auto points = shape->surface(0.1);
        ASSERT_GT(points.size(), 20u);
        for (const SurfacePoint& p : points) {
            EXPECT_LT(shape->distanceTo(p.position), 1e-9);
            const auto back = shape->rayDistance(p.position + p.normal * 0.01, p.normal * -1.0);
            EXPECT_NEAR(back, 0.01, 1e-9);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, Scenes,
                         testing::Values(std::pair{SceneKind::structured, 1},
                                         std::pair{SceneKind::unstructured, 1},
                                         std::pair{SceneKind::unstructured, 2},
                                         std::pair{SceneKind::unstructured, 3},
                                         std::pair{SceneKind::furnished, 1}));

/** The observation's points in the sensor's frame, as MRPT decodes them, with their times. */
struct Decoded {
    std::vector<TPoint3D> points;
    std::vector<TTimeStamp> times;
};

struct PacketPoints : CObservationVelodyneScan::PointCloudStorageWrapper {
    Decoded decoded;
    void add_point(float x, float y, float z, uint8_t, const TTimeStamp& time, const float,
                   uint16_t) override {
        decoded.points.emplace_back(x, y, z);
        decoded.times.push_back(time);
    }
};

Decoded decode(const mrpt::obs::CObservation::Ptr& obs) {
    Decoded decoded;
    if (const auto depth = std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(obs)) {
        mrpt::maps::CSimplePointsMap map;
        depth->unprojectInto(map);
        for (std::size_t i = 0; i < map.size(); i++) {
            decoded.points.emplace_back();
            map.getPoint(i, decoded.points.back());
        }
    } else if (const auto velodyne = std::dynamic_pointer_cast<CObservationVelodyneScan>(obs)) {
        PacketPoints packets;
        velodyne->generatePointCloud(packets);
        return packets.decoded;
    } else {
        const auto cloud = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(obs);
        for (std::size_t i = 0; i < cloud->pointcloud->size(); i++) {
            decoded.points.emplace_back();
            cloud->pointcloud->getPoint(i, decoded.points.back());
        }
    }
    decoded.times.resize(decoded.points.size(), obs->timestamp);
    return decoded;
}

class Sensors : public testing::TestWithParam<SensorKind> {};

TEST_P(Sensors, observationsDecodeToTheDrivesOwnRays) {
    for (const bool moving : {false, true}) {
        if (moving && GetParam() != SensorKind::velodyne) continue;
        auto options = drive(SceneKind::structured, GetParam());
        options.moving = moving;
        const SimulatedDrive simulated = simulate(options);
        ASSERT_EQ(simulated.scans.size(), 12u);
        for (const SimulatedScan& scan : simulated.scans) {
            EXPECT_GT(scan.rays.size(), 3200u);
            EXPECT_LT(scan.rays.size(), 3800u);
            CPose3D sensor_on_robot;
            scan.observation->getSensorPose(sensor_on_robot);
            EXPECT_GT(sensor_on_robot.norm(), 0.5);
            const Decoded decoded = decode(scan.observation);
            ASSERT_EQ(decoded.points.size(), scan.rays.size());
            for (std::size_t i = 0; i < scan.rays.size(); i++) {
                const CPose3D robot =
                    simulated.trajectory.at(mrpt::Clock::toDouble(decoded.times[i]));
                const CPose3D sensor = robot + sensor_on_robot;
                const Ray& ray = scan.rays[i];
                ASSERT_LT(sensor.translation().distanceTo(point(ray.origin)), 1e-5);
                // MRPT rounds azimuths to 0.01 degrees and looks them up in a table that is off by
                // as much: 2 mm at 8 m.
                ASSERT_LT(sensor.composePoint(decoded.points[i]).distanceTo(point(ray.end)),
                          2.5e-3);
            }
        }
    }
}

TEST_P(Sensors, rangeNoiseIsGaussianOfOneCentimetre) {
    const SimulatedDrive simulated = simulate(drive(SceneKind::unstructured, GetParam(), 4));
    double n = 0, sum = 0, squares = 0, within_one_sigma = 0;
    for (const SimulatedScan& scan : simulated.scans)
        for (const Ray& ray : scan.rays) {
            const TVector3D sight = point(ray.end) - point(ray.origin);
            const auto exact = simulated.scene.castRay(point(ray.origin), sight.unitarize());
            // Quantization turns rays a little: at an edge that may be another surface.
            if (!exact || std::abs(sight.norm() - *exact) > 0.1) continue;
            const double error = sight.norm() - *exact;
            n++, sum += error, squares += error * error;
            within_one_sigma += std::abs(error) < kNoise;
        }
    EXPECT_GT(n, 40000);
    EXPECT_NEAR(sum / n, 0, 2e-4);
    EXPECT_NEAR(std::sqrt(squares / n), kNoise, 3e-4);
    EXPECT_NEAR(within_one_sigma / n, 0.6827, 0.01);
}

TEST_P(Sensors, sameSeedSameBits) {
    const auto ends = [&](uint64_t seed) {
        std::vector<std::array<double, 3>> all;
        for (const auto& scan : simulatedRays(drive(SceneKind::unstructured, GetParam(), seed)))
            for (const Ray& ray : scan) all.push_back(ray.end);
        return all;
    };
    EXPECT_EQ(ends(5), ends(5));
    EXPECT_NE(ends(5), ends(6));
}

bool isKnown(const octomap::OcTree& truth, const TPoint3D& p) {
    return truth.search(p.x, p.y, p.z) != nullptr;
}
bool isOccupied(const octomap::OcTree& truth, const TPoint3D& p) {
    const auto* node = truth.search(p.x, p.y, p.z);
    return node && truth.isNodeOccupied(node);
}

TEST_P(Sensors, truthAgreesWithTheSurfacesAndTheNoiselessRays) {
    for (const SceneKind scene : {SceneKind::structured, SceneKind::unstructured}) {
        auto options = drive(scene, GetParam(), 2);
        options.errors = RangeErrors();
        const SimulatedDrive simulated = simulate(options);
        constexpr double kCell = 0.1;
        const auto truth = simulated.truth(kCell);
        for (auto leaf = truth->begin_leafs(); leaf != truth->end_leafs(); ++leaf) {
            const TPoint3D centre(leaf.getX(), leaf.getY(), leaf.getZ());
            const double distance = simulated.scene.distanceToSurface(centre);
            if (truth->isNodeOccupied(*leaf))
                EXPECT_LT(distance, std::sqrt(0.75) * kCell + 1e-6);  // reaches into the cell
            else
                EXPECT_GT(distance, 0.5 * kCell - 1e-6);  // stays out of the middle
        }
        Random random(7, 99);
        double rays = 0, hit = 0, passed = 0, blocked = 0;
        for (const SimulatedScan& scan : simulated.scans)
            for (const Ray& ray : scan.rays) {
                const TPoint3D origin = point(ray.origin), end = point(ray.end);
                const TPoint3D between = origin + (end - origin) * random.uniform(0, 0.8);
                rays++;
                hit += isOccupied(*truth, end);
                passed += isKnown(*truth, between);
                blocked += isOccupied(*truth, between);
            }
        EXPECT_GT(hit / rays, 0.998);  // the image's millimetres may cross a cell's face
        EXPECT_GT(passed / rays, 0.998);
        EXPECT_LT(blocked / rays, 0.05);  // cells only partly filled
    }
}

INSTANTIATE_TEST_SUITE_P(All, Sensors,
                         testing::Values(SensorKind::depth, SensorKind::velodyne,
                                         SensorKind::pointcloud));

TEST(Truth, missesNoSurfaceCellThatAnyViewSees) {
    const SimulatedDrive simulated = simulate(drive(SceneKind::structured, SensorKind::depth));
    const auto truth = simulated.truth(0.05);
    Random random(3, 99);
    int seen = 0, missed = 0;
    for (int i = 0; i < 200000; i++) {
        const View& view = simulated.scans[static_cast<std::size_t>(i) % 12].views.front();
        const TVector3D local = randomDirection(random);
        if (!view.field.contains(local)) continue;
        const TPoint3D origin = view.sensor.translation();
        const TVector3D direction = view.sensor.rotateVector(local);
        const auto range = simulated.scene.castRay(origin, direction, view.max_range);
        if (!range || *range < view.min_range) continue;
        seen++;
        missed += !isOccupied(*truth, origin + direction * *range);
    }
    EXPECT_GT(seen, 10000);
    EXPECT_LE(missed, seen / 2000);  // only where a surface cuts off a cell's outermost corner
    // Two of three floor cells are seen, however flat the sight lines meet them.
    int floor = 0;
    for (int x = 0; x < 200; x++)
        for (int y = 0; y < 140; y++)
            floor += isOccupied(*truth, {0.05 * x + 0.025, 0.05 * y + 0.025, 0.025});
    EXPECT_GT(floor, 200 * 140 * 2 / 3);
}

TEST(Simulation, refusesWhatItCannotDo) {
    auto options = drive(SceneKind::structured, SensorKind::depth);
    options.moving = true;
    EXPECT_THROW(simulate(options), std::runtime_error);
    options = {};
    options.errors = RangeErrors();
    options.errors->constant = -1;
    EXPECT_THROW(simulate(options), std::runtime_error);
    options = {};
    options.max_range = 0;
    EXPECT_THROW(simulate(options), std::runtime_error);
    EXPECT_THROW((void)simulate({}).truth(0), std::runtime_error);
}

// The program ------------------------------------------------------------------------------

using PoseAt = std::function<CPose3D(const TTimeStamp&)>;

mrpt::poses::CPose3DInterpolator readTum(const std::string& file) {
    mrpt::poses::CPose3DInterpolator path;
    path.setInterpolationMethod(mrpt::poses::imLinearSlerp);
    std::istringstream in(readText(file));
    for (std::string line; std::getline(in, line);) {
        if (line.empty() || line[0] == '#') continue;
        double t, x, y, z, qx, qy, qz, qw;
        std::istringstream(line) >> t >> x >> y >> z >> qx >> qy >> qz >> qw;
        const mrpt::math::CQuaternionDouble q(qw, qx, qy, qz);
        path.insert(mrpt::Clock::fromDouble(t), CPose3D(mrpt::poses::CPose3DQuat(x, y, z, q)));
    }
    return path;
}

CPose3D interpolate(const mrpt::poses::CPose3DInterpolator& path, const TTimeStamp& time) {
    CPose3D pose;
    bool valid = false;
    path.interpolate(time, pose, valid);
    EXPECT_TRUE(valid);
    return pose;
}

/** Distances from the surface of each decoded point, placed with the robot's pose at its time. */
struct Placed : CObservationVelodyneScan::PointCloudStorageWrapper {
    Placed(const Scene& s, const CPose3D& sensor, PoseAt poses)
        : scene(s), sensor_on_robot(sensor), pose_at(std::move(poses)) {}
    void add_point(float x, float y, float z, uint8_t, const TTimeStamp& time, const float,
                   uint16_t) override {
        const CPose3D sensor = pose_at(time) + sensor_on_robot;
        distances.push_back(
            scene.distanceToSurface(sensor.composePoint(mrpt::math::TPoint3D(x, y, z))));
    }
    const Scene& scene;
    CPose3D sensor_on_robot;
    PoseAt pose_at;
    std::vector<double> distances;
};

TEST(Simulate, packetTimesOfAMovingLidarMatchTheTrajectory) {
    const TemporaryFolder folder;
    const ::Run run = runProgram("simulate structured --sensor velodyne --moving --seed 3 -o " +
                                 folder.file("drive") + " --truth-resolution 0.1");
    ASSERT_EQ(run.exit, 0) << run.err;
    const auto path = readTum(folder.file("drive/trajectory.tum"));
    mrpt::obs::CRawlog log;
    ASSERT_TRUE(log.loadFromRawLogFile(folder.file("drive/scene.rawlog")));
    const Scene scene = makeScene(SceneKind::structured, 3);
    std::vector<double> by_packet, by_middle;
    for (std::size_t i = 0; i < log.size(); i++) {
        const auto obs = std::dynamic_pointer_cast<CObservationVelodyneScan>(log.getAsGeneric(i));
        ASSERT_TRUE(obs);
        Placed sharp(scene, obs->sensorPose,
                     [&](const TTimeStamp& t) { return interpolate(path, t); });
        obs->generatePointCloud(sharp);
        const auto middle = interpolate(path, obs->timestamp + std::chrono::milliseconds(50));
        Placed smeared(scene, obs->sensorPose, [&](const TTimeStamp&) { return middle; });
        obs->generatePointCloud(smeared);
        by_packet.insert(by_packet.end(), sharp.distances.begin(), sharp.distances.end());
        by_middle.insert(by_middle.end(), smeared.distances.begin(), smeared.distances.end());
    }
    ASSERT_GT(by_packet.size(), 40000u);
    EXPECT_LT(quantile(by_packet, 0.68), 1.05 * kNoise);
    EXPECT_LT(quantile(by_packet, 0.9995), 4 * kNoise);
    EXPECT_LT(quantile(by_packet, 1 - 1e-9), 6 * kNoise);
    EXPECT_GT(quantile(by_middle, 0.68), 4 * kNoise);
}

std::string bytesOf(const TemporaryFolder& folder, const std::string& drive) {
    std::string all;
    for (const char* name : {"scene.rawlog", "trajectory.tum", "scene.simplemap", "truth.bt"})
        all += readText(folder.file(drive + "/" + name));
    return all;
}

TEST(Simulate, filesReadBackAndDependOnTheSeedOnly) {
    const TemporaryFolder folder;
    for (const std::string sensor : {"depth", "velodyne", "pointcloud"}) {
        const std::string command =
            "simulate unstructured --truth-resolution 0.2 --sensor " + sensor;
        const ::Run run = runProgram(command + " -o " + folder.file("new/" + sensor));
        ASSERT_EQ(run.exit, 0) << run.err;
        EXPECT_EQ(run.err, "");
        EXPECT_NE(run.out.find("12 scans"), std::string::npos) << run.out;
        const std::string drive = folder.file("new/" + sensor) + "/";

        mrpt::obs::CRawlog log;
        ASSERT_TRUE(log.loadFromRawLogFile(drive + "scene.rawlog"));
        ASSERT_EQ(log.size(), 12u);  // no poses unless asked for
        const auto path = readTum(drive + "trajectory.tum");
        mrpt::maps::CSimpleMap map;
        ASSERT_TRUE(map.loadFromFile(drive + "scene.simplemap"));
        ASSERT_EQ(map.size(), 12u);
        for (std::size_t i = 0; i < 12; i++) {
            const auto obs = log.getAsObservation(i);
            EXPECT_FALSE(obs->sensorLabel.empty());
            const auto& keyframe = *(map.begin() + static_cast<std::ptrdiff_t>(i));
            const CPose3D mean = keyframe.pose->getMeanVal(),
                          at = interpolate(path, obs->timestamp);
            EXPECT_LT(mean.distanceTo(at), 1e-3);
            EXPECT_LT((mean - at).asTPose().norm(), 1e-3);
            EXPECT_EQ(keyframe.sf->getObservationByIndex(0)->timestamp, obs->timestamp);
        }
        octomap::OcTree truth(1);
        ASSERT_TRUE(truth.readBinary(drive + "truth.bt"));
        EXPECT_DOUBLE_EQ(truth.getResolution(), 0.2);
        EXPECT_GT(truth.getNumLeafNodes(), 3000u);

        ASSERT_EQ(runProgram(command + " -o " + folder.file("again")).exit, 0);
        EXPECT_TRUE(bytesOf(folder, "again") == bytesOf(folder, "new/" + sensor));
        ASSERT_EQ(runProgram(command + " --seed 2 -o " + folder.file("again")).exit, 0);
        EXPECT_FALSE(bytesOf(folder, "again") == bytesOf(folder, "new/" + sensor));
    }
}

TEST(Simulate, addsRobotPosesWhenAsked) {
    const TemporaryFolder folder;
    const ::Run run = runProgram("simulate structured --with-poses --truth-resolution 0.2 -o " +
                                 folder.file("drive"));
    ASSERT_EQ(run.exit, 0) << run.err;
    mrpt::obs::CRawlog log;
    ASSERT_TRUE(log.loadFromRawLogFile(folder.file("drive/scene.rawlog")));
    const auto path = readTum(folder.file("drive/trajectory.tum"));
    int scans = 0, scans_with_pose = 0;
    TTimeStamp last_pose, last;
    for (std::size_t i = 0; i < log.size(); i++) {
        const auto obs = log.getAsObservation(i);
        EXPECT_TRUE(i == 0 || obs->timestamp >= last);
        last = obs->timestamp;
        if (const auto pose = std::dynamic_pointer_cast<mrpt::obs::CObservationRobotPose>(obs)) {
            last_pose = pose->timestamp;
            EXPECT_LT(pose->pose.mean.distanceTo(interpolate(path, last_pose)), 1e-5);
        } else {
            scans++;
            scans_with_pose += last_pose == obs->timestamp;
        }
    }
    EXPECT_EQ(scans, 12);
    EXPECT_EQ(scans_with_pose, 12);
}

TEST(Simulate, refusesWithOneLineAndLeavesOldFilesAlone) {
    const TemporaryFolder folder;
    writeText(folder.file("truth.bt"), "old");
    writeText(folder.file("a-file"), "");
    const std::string here = " -o " + folder.path().string();
    const std::vector<std::pair<std::string, std::string>> cases{
        {"simulate structured --moving" + here, "--sensor velodyne"},
        {"simulate structure" + here, "structure"},
        {"simulate structured --sensor radar" + here, "radar"},
        {"simulate structured --noise -1" + here, "noise"},
        {"simulate structured --truth-resolution 0" + here, "resolution"},
        {"simulate structured --truth-resolution nan" + here, "resolution"},
        {"simulate structured", "--output"},
        {"simulate structured -o " + folder.file("a-file/drive"), "a-file/drive"},
    };
    for (const auto& [command, word] : cases) {
        const ::Run run = runProgram(command);
        EXPECT_NE(run.exit, 0) << command;
        EXPECT_LT(run.exit, 128) << command;
        EXPECT_NE(run.err.find(word), std::string::npos) << command << ": " << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
    EXPECT_EQ(readText(folder.file("truth.bt")), "old");
    const auto files = std::filesystem::directory_iterator(folder.path());
    EXPECT_EQ(std::distance(begin(files), end(files)), 2);
}

}  // namespace
