// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// What threads may do at once, for ThreadSanitizer and for the results.
#include <akimap/AkiMap.h>
#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <thread>

#include "random_scans.h"
#include "run_program.h"
#include "same_map.h"

using namespace akimap;
using mrpt::math::TPoint3Df;
using mrpt::poses::CPose3D;

namespace {

constexpr std::size_t kThreads = 4;

/** Runs work(number) in so many threads at once. */
template <class Work>
void inThreads(Work&& work) {
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < kThreads; t++) threads.emplace_back([&work, t] { work(t); });
    for (auto& t : threads) t.join();
}

AkiMap roomMap() {
    AkiMap map(0.1);
    EXPECT_TRUE(map.insertRays(test::randomScan(1, 300)));
    return map;
}

/** Squared distances to the nearest surface points of a few places. */
std::vector<float> distances(const AkiMap& map) {
    std::vector<float> all;
    for (const Ray& r : test::randomScan(9, 40)) {
        TPoint3Df nearest;
        uint64_t index = 0;
        const TPoint3Df query(static_cast<float>(r.end[0]), static_cast<float>(r.end[1]),
                              static_cast<float>(r.end[2]));
        EXPECT_TRUE(map.nn_single_search(query, nearest, all.emplace_back(), index));
    }
    return all;
}

/** A depth image of a wall, by a camera that no scan has had before if `focal_length` is new. */
mrpt::obs::CObservation3DRangeScan::Ptr depthScan(double focal_length) {
    auto o = mrpt::obs::CObservation3DRangeScan::Create();
    constexpr uint32_t kColumns = 64, kRows = 48;
    o->cameraParams.ncols = kColumns, o->cameraParams.nrows = kRows;
    o->cameraParams.setIntrinsicParamsFromValues(focal_length, focal_length, 32, 24);
    o->hasRangeImage = true, o->range_is_depth = true, o->rangeUnits = 0.001F;
    o->rangeImage_setSize(kRows, kColumns);
    for (uint32_t r = 0; r < kRows; r++)
        for (uint32_t c = 0; c < kColumns; c++)
            o->rangeImage(static_cast<int>(r), static_cast<int>(c)) =
                static_cast<uint16_t>(1500 + 5 * c + r);
    return o;
}

}  // namespace

TEST(Threads, ReadersOfAStaleCacheGetTheNewSurface) {
    AkiMap map = roomMap();
    static_cast<void>(distances(map));
    ASSERT_TRUE(map.insertRays(test::randomScan(2, 300)));
    const AkiMap fresh = map;
    const std::vector<float> expected = distances(fresh);
    inThreads([&](std::size_t) { EXPECT_EQ(distances(map), expected); });
}

TEST(Threads, ReadersOfACacheOfAnotherPriorGetTheirs) {
    AkiMap map = roomMap();
    for (int round = 0; round < 5; round++) {
        static_cast<void>(distances(map));
        map.insertionOptions.prior_alpha *= 10;
        const std::vector<float> expected = distances(AkiMap(map));
        inThreads([&](std::size_t) { EXPECT_EQ(distances(map), expected); });
    }
}

TEST(Threads, CopiesAreWrittenAtOnce) {
    const AkiMap map = roomMap();
    const auto written = [&](std::size_t t) {
        AkiMap copy = map;
        for (unsigned n = 0; n < 3; n++)
            copy.insertRays(test::randomScan(static_cast<unsigned>(10 * t) + n + 2, 200));
        return test::fingerprint(copy);
    };
    std::vector<std::string> prints(kThreads);
    const std::string before = test::fingerprint(map);
    inThreads([&](std::size_t t) { prints[t] = written(t); });
    for (std::size_t t = 0; t < kThreads; t++) EXPECT_EQ(prints[t], written(t));
    EXPECT_EQ(test::fingerprint(map), before);
}

TEST(Threads, MapsOfTheirOwnGetTheFirstImagesOfACamera) {
    for (int round = 0; round < 10; round++) {
        const double focal_length = 60 + 0.1 * round;
        const auto mapped = [&] {
            AkiMap map(0.1);
            map.insertObservation(*depthScan(focal_length));
            return test::cellsFingerprint(map);
        };
        std::vector<std::string> prints(kThreads);
        inThreads([&](std::size_t t) { prints[t] = mapped(); });
        for (const std::string& print : prints) ASSERT_EQ(print, mapped()) << "round " << round;
    }
}

TEST(Threads, LikelihoodsOfACamerasFirstImage) {
    AkiMap map(0.1);
    ASSERT_TRUE(map.insertObservation(*depthScan(59)));
    for (int round = 0; round < 10; round++) {
        const auto scan = depthScan(59 - 0.1 * (round + 1));
        std::vector<double> values(kThreads);
        inThreads([&](std::size_t t) {
            values[t] = map.computeObservationLikelihood(*scan, CPose3D(0.05, 0, 0, 0, 0, 0));
        });
        const double alone = map.computeObservationLikelihood(*scan, CPose3D(0.05, 0, 0, 0, 0, 0));
        ASSERT_LT(alone, 0);
        for (const double v : values) ASSERT_EQ(v, alone) << "round " << round;
    }
}

/** MRPT throws its tables away when it has more than 100. */
TEST(Threads, MapsOfTheirOwnGetImagesOfMoreCamerasThanMrptKeeps) {
    const auto mapped = [](std::size_t camera) {
        AkiMap map(0.1);
        map.insertionOptions.threads = 1;
        map.insertObservation(*depthScan(70 + 0.1 * static_cast<double>(camera)));
        return test::cellsFingerprint(map);
    };
    constexpr std::size_t kCameras = 80;  // of each thread
    std::vector<std::string> prints(kThreads * kCameras);
    inThreads([&](std::size_t t) {
        for (std::size_t i = t; i < prints.size(); i += kThreads) prints[i] = mapped(i);
    });
    for (std::size_t i = 0; i < prints.size(); i++) ASSERT_EQ(prints[i], mapped(i)) << i;
}

TEST(Threads, LikelihoodsOfACloudThatIsStillInItsFile) {
    const TemporaryFolder folder;
    const AkiMap map = roomMap();
    auto points = mrpt::maps::CSimplePointsMap::Create();
    for (const Ray& r : test::randomScan(3, 200))
        points->insertPointFast(static_cast<float>(r.end[0] - 0.3),
                                static_cast<float>(r.end[1] + 0.2),
                                static_cast<float>(r.end[2] - 0.9));
    mrpt::obs::CObservationPointCloud inside;
    inside.pointcloud = points;
    const double expected =
        map.computeObservationLikelihood(inside, CPose3D(0.3, -0.2, 0.9, 0, 0, 0));
    ASSERT_NE(expected, 0);
    for (int round = 0; round < 5; round++) {
        mrpt::obs::CObservationPointCloud outside;
        outside.pointcloud = mrpt::maps::CSimplePointsMap::Create(*points);
        outside.setAsExternalStorage(
            folder.file("cloud.bin"),
            mrpt::obs::CObservationPointCloud::ExternalStorageFormat::MRPT_Serialization);
        outside.unload();
        inThreads([&](std::size_t) {
            EXPECT_EQ(map.computeObservationLikelihood(outside, CPose3D(0.3, -0.2, 0.9, 0, 0, 0)),
                      expected);
        });
    }
}
