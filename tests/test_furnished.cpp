// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// The furnished scene has what it promises, where it promises, and so does its truth; and someone
// who walks is where the walk says.
#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <cmath>

#include "run_program.h"
#include "simulation/Walk.h"
#include "simulation/furniture.h"
#include "simulation/simulate.h"

namespace {

using namespace akimap::app;
using mrpt::math::TPoint3D;

class Furnished : public testing::Test {
 protected:
    /** How far one sees along x, or straight down. [m] */
    [[nodiscard]] double along(double x, double y, double z) const {
        return scene.castRay({x, y + kCellMiddle, z}, {1, 0, 0}).value_or(NAN);
    }
    [[nodiscard]] double heightAt(double x, double y) const {
        constexpr double kFrom = 1.6;
        const double down =
            scene.castRay({x + kCellMiddle, y + kCellMiddle, kFrom}, {0, 0, -1}).value_or(NAN);
        return kFrom - down - kCellMiddle;
    }

    const Scene scene = makeScene(SceneKind::furnished, 1);
};

TEST_F(Furnished, DoorsAreAsWideAsTheyAre) {
    const double wall = 5.0 + kCellMiddle - 4.6;
    EXPECT_NEAR(along(4.6, 0.95, 1), wall, 1e-9);
    EXPECT_GT(along(4.6, 1.01, 1), wall + 1);  // 0.9 m
    EXPECT_GT(along(4.6, 1.89, 1), wall + 0.5);
    EXPECT_NEAR(along(4.6, 1.91, 1), wall, 1e-9);
    EXPECT_NEAR(along(4.6, 4.99, 1), wall, 1e-9);
    EXPECT_GT(along(4.6, 5.01, 1), wall + 1);  // 0.8 m
    EXPECT_GT(along(4.6, 5.79, 1), wall + 1);
    EXPECT_NEAR(along(4.6, 5.81, 1), wall, 1e-9);
    EXPECT_NEAR(along(4.6, 5.4, 1.95), wall, 1e-9);  // the lintel
}

TEST_F(Furnished, TheWindowIsOfGlass) {
    const TPoint3D before(4.6, 3.6, 1.3);
    const auto pane = scene.firstHit(before, {1, 0, 0}, false);
    ASSERT_TRUE(pane);
    EXPECT_EQ(scene.material(pane->shape), Material::glass);
    EXPECT_NEAR(pane->distance, 5.045 + kCellMiddle - 4.6, 1e-9);
    EXPECT_GT(scene.firstHit(before, {1, 0, 0}, true)->distance, 4);
}

TEST_F(Furnished, StairsAndSlopeRise) {
    for (int step = 0; step < 4; step++)
        EXPECT_NEAR(heightAt(8.6 + 0.28 * step + 0.14, 0.5), 0.17 * (step + 1), 1e-9);
    EXPECT_NEAR(heightAt(8.7, 6.5), 0.26, 1e-9);
    for (const double x : {7.0, 7.5, 8.1})
        EXPECT_NEAR(heightAt(x, 6.5), 0.26 - (8.2 - x) * std::tan(10 * M_PI / 180), 1e-9);
    EXPECT_NEAR(heightAt(6.6, 6.5), 0, 1e-9);  // before it: the floor
}

/** Widths of what stands in the way of parallel rays along x, at 1 mm steps of y. */
std::vector<double> widths(const Scene& scene, double x, double z, double y0, double y1,
                           double deep) {
    std::vector<double> found;
    bool inside = false;
    for (double y = y0; y < y1; y += 0.001) {
        const bool hit = scene.castRay({x, y, z}, {1, 0, 0}, deep).has_value();
        if (hit && !inside) found.push_back(0);
        if (hit) found.back() += 0.001;
        inside = hit;
    }
    return found;
}

TEST_F(Furnished, LegsAndPolesAreThin) {
    const auto table =
        widths(scene, 1.38, 0.3, 4.55, 5.5, 1.5);  // and one chair behind its near legs
    ASSERT_GE(table.size(), 2u);
    EXPECT_NEAR(table.front(), 0.04, 0.0015);
    EXPECT_NEAR(table.back(), 0.04, 0.0015);
    const auto chair = widths(scene, 8.6, 0.2, 2.9, 3.5, 0.5);
    ASSERT_EQ(chair.size(), 2u);
    for (const double leg : chair) EXPECT_NEAR(leg, 0.025, 0.0015);
    const auto pole = widths(scene, 6.5, 1.5, 4.5, 4.7, 1);
    ASSERT_EQ(pole.size(), 1u);
    EXPECT_NEAR(pole.front(), 0.04, 0.0015);
}

TEST_F(Furnished, TheTruthKnowsGlassLegsAndDoors) {
    SimulationOptions options;
    options.scene = SceneKind::furnished, options.sensor = SensorKind::os1_128;
    options.max_range = 4;  // so it takes seconds
    const auto truth = simulate(options).truth(0.05);
    const auto isOccupied = [&](double x, double y, double z) -> std::optional<bool> {
        const auto* node = truth->search(x, y, z);
        if (!node) return std::nullopt;
        return truth->isNodeOccupied(node);
    };
    EXPECT_EQ(isOccupied(5.072, 3.6, 1.3), true);    // the pane
    EXPECT_EQ(isOccupied(5.025, 2.5, 1.0), true);    // the wall
    EXPECT_EQ(isOccupied(5.075, 1.45, 1.0), false);  // the door
    EXPECT_EQ(isOccupied(5.075, 5.4, 1.0), false);
    EXPECT_EQ(isOccupied(2.8, 4.63, 0.3), true);   // a leg of the table
    EXPECT_EQ(isOccupied(7.285, 4.6, 1.0), true);  // a pole
    EXPECT_EQ(isOccupied(7.2, 4.6, 1.0), false);
}

TEST(Walk, IsWhereItsPaceTakesIt) {
    const Walk walk{1, 2, 4, 6, 10, 2};  // 5 m at 2 m/s
    EXPECT_DOUBLE_EQ(walk.end(), 12.5);
    EXPECT_TRUE(walk.at(9.99).empty());
    EXPECT_TRUE(walk.at(12.5).empty());
    const double floor = Scene::floorHeight();
    const auto distance = [&](double time, const TPoint3D& p) {
        double nearest = INFINITY;
        for (const ShapePtr& shape : walk.at(time))
            nearest = std::min(nearest, shape->distanceTo(p));
        return nearest;
    };
    for (const double time : {10.0, 11.0, 12.25}) {
        const double way = 2 * (time - 10) / 5;
        const double x = 1 + 3 * way, y = 2 + 4 * way;
        EXPECT_LT(distance(time, {x, y, floor + 1.75}), 1e-9);        // the top of the head
        EXPECT_LT(distance(time, {x + 0.19, y, floor + 1.2}), 1e-9);  // the trunk
        EXPECT_GT(distance(time, {x, y, floor + 1.80}), 0.049);
    }
    // In the middle of a stride one leg is 25 cm ahead of the trunk, the other as much behind.
    const double quarter = 10 + 0.25 * 1.4 / 2, x = 1 + 0.6 * 0.35, y = 2 + 0.8 * 0.35;
    EXPECT_LT(distance(quarter, {x + 0.6 * 0.25 - 0.8 * 0.1 + 0.07, y + 0.8 * 0.25 + 0.6 * 0.1,
                                 floor + 0.4}),
              1e-9);
}

TEST(Walk, MayStopHalfway) {
    const Walk walk{0, 0, 4, 0, 10, 1, 5}, straight{0, 0, 4, 0, 10, 1};
    EXPECT_DOUBLE_EQ(walk.end(), 19);
    const auto headAt = [](const Walk& w, double time) {
        return w.at(time).back()->ball().centre.x;
    };
    EXPECT_NEAR(headAt(walk, 11), headAt(straight, 11), 1e-12);
    EXPECT_NEAR(headAt(walk, 12.5), 2, 1e-12);
    EXPECT_NEAR(headAt(walk, 16.9), 2, 1e-12);
    EXPECT_NEAR(headAt(walk, 18), headAt(straight, 13), 1e-12);
}

TEST(Walk, StandsInTheSceneOnlyWhileItLasts) {
    const Scene room = makeScene(SceneKind::structured, 1);
    const Walk walk{3, 4.4, 3.1, 4.4, 10, 0.1};
    const TPoint3D origin(1.0, 4.4, 1.2);
    const auto seen = [&](double time) {
        return *sceneAt(room, walk, time).castRay(origin, {1, 0, 0});
    };
    const double empty = *room.castRay(origin, {1, 0, 0});
    EXPECT_EQ(seen(9), empty);
    EXPECT_NEAR(seen(10.5), 2.05 - 0.19, 1e-9);
    EXPECT_EQ(seen(11.5), empty);
}

TEST(SimulateOptions, EachOneChangesWhatItSays) {
    const TemporaryFolder folder;
    const auto made = [&](const std::string& options, const std::string& file) {
        const ::Run run = runProgram("simulate furnished --truth-resolution 0.5 " + options +
                                     " -o " + folder.file("drive"));
        EXPECT_EQ(run.exit, 0) << run.err;
        return readText(folder.file("drive/" + file));
    };
    const std::string plain = made("", "scene.rawlog"), poses = made("", "trajectory.tum");
    for (const std::string option :
         {"--noise 0.02", "--noise-growth 0.01", "--disparity-noise 0.001",
          "--disparity-step 0.003", "--range-step 0.1", "--beam 0.02", "--grazing 0.5",
          "--dark-loss 0.5", "--glass-pass 0.9", "--max-range 4"})
        EXPECT_TRUE(made(option, "scene.rawlog") != plain) << option;
    EXPECT_TRUE(made("--beam 0.02 --mixing 0.5", "scene.rawlog") !=
                made("--beam 0.02", "scene.rawlog"));
    for (const std::string option : {"--pose-noise 0.01", "--pose-noise-angle 0.5",
                                     "--pose-drift 0.01", "--pose-drift-angle 0.5"}) {
        EXPECT_TRUE(made(option, "trajectory.tum") != poses) << option;
        EXPECT_TRUE(made(option, "true_trajectory.tum") == poses) << option;
        EXPECT_TRUE(made(option, "scene.rawlog") == plain) << option;
    }
}

TEST(SimulateOptions, AreRefusedByName) {
    const TemporaryFolder folder;
    const std::pair<const char*, const char*> cases[] = {
        {"--sensor os1-128 --moving", "vlp16"}, {"--glass-pass 2", "glass"},
        {"--pose-noise -1", "pose noise"},      {"--max-range 0", "maximum range"},
        {"--max-range 61", "maximum range"},    {"--beam much", "--beam"}};
    for (const auto& [options, word] : cases) {
        const ::Run run = runProgram("simulate furnished " + std::string(options) + " -o " +
                                     folder.file("drive"));
        EXPECT_NE(run.exit, 0) << options;
        EXPECT_NE(run.err.find(word), std::string::npos) << options << ": " << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
    EXPECT_FALSE(std::filesystem::exists(folder.file("drive")));
}

}  // namespace
