// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// The contest of several maps over the folds of one recording.
#include "evaluation/contest/contest.h"

#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "evaluation/contest/ScanProjection.h"
#include "evaluation/contest/contest_report.h"
#include "evaluation/contest/depth_picture.h"
#include "input/clouds/PcdReader.h"
#include "run_program.h"

using namespace akimap;
using namespace akimap::app;

namespace {

constexpr double kCell = 0.1;  // [m]

/** A wall at x = 2 m, straight ahead of each ray; scan i has y = i for its mark. */
std::vector<Ray> wallScan(int i) {
    std::vector<Ray> rays;
    for (int k = 0; k < 8; k++)
        rays.push_back({{0.05, i + 0.05, k + 0.05}, {2.05, i + 0.05, k + 0.05}});
    return rays;
}
/** All rays from one place. */
std::vector<Ray> fanScan() {
    std::vector<Ray> rays;
    for (int k = 0; k < 8; k++) rays.push_back({{0.05, 0.05, 0.05}, {2.05, 0.05, 0.1 * k + 0.05}});
    return rays;
}
std::vector<std::vector<Ray>> wallScans(int count) {
    std::vector<std::vector<Ray>> scans;
    for (int i = 0; i < count; i++) scans.push_back(wallScan(i));
    return scans;
}

/** A map that occupies the cell `shift` cells behind each return of the scans it gets, and notes
 * which they were. */
class Fake : public Contestant {
 public:
    Fake(int shift, std::vector<int>& got) : shift_(shift), got_(got), cells_(noCells(kCell)) {}
    void insert(const ContestScan& scan) override {
        got_.push_back(static_cast<int>(std::floor(scan.all.front().origin[1])));
        for (const Ray& ray : scan.returns) {
            CellIndex c = cells_.cellAt(ray.end);
            c.x += shift_;
            cells_[c] = 0.9f;
        }
    }
    OccupancyCells cells() override { return std::move(cells_); }

 private:
    int shift_;
    std::vector<int>& got_;
    OccupancyCells cells_;
};

Entrant fake(const std::string& name, int shift, std::vector<int>& got, bool sees_held_out) {
    return {name, "", [shift, &got] { return std::make_unique<Fake>(shift, got); }, sees_held_out};
}

ContestRules rulesFor(std::size_t every, bool all_folds) {
    ContestRules rules;
    rules.resolution = kCell;
    rules.every = every, rules.all_folds = all_folds;
    return rules;
}

/** Asks a tree or a map at the centre of each of the cells, and at their neighbours. */
template <class Lookup>
void expectSame(const OccupancyCells& cells, Lookup&& lookup) {
    std::size_t known = 0;
    OccupancyCells::Reader reader(cells);
    cells.forEach([&](const CellIndex& c, float) {
        const double h = cells.resolution();
        const std::optional<double> expected =
            lookup((c.x + 0.5) * h, (c.y + 0.5) * h, (c.z + 0.5) * h);
        ASSERT_EQ(isKnown(reader[c]), expected.has_value());
        if (!expected) return;
        EXPECT_NEAR(reader[c], *expected, 1e-6);
        known++;
    });
    EXPECT_GT(known, 50u);
}

}  // namespace

// What the maps get --------------------------------------------------------------------------

TEST(Contest, HoldsOutEveryNthScanAndFoldsComeInTurn) {
    const auto scans = wallScans(7);
    std::vector<int> kept, all;
    const std::vector<Entrant> entrants = {fake("A", 0, kept, false), fake("B", 0, all, true)};
    const auto one = holdContest(recordingOf(scans), entrants, rulesFor(3, false));
    EXPECT_EQ(one.scans, 7u);
    EXPECT_EQ(one.held_out, 2u);  // scans 3 and 6
    EXPECT_EQ(kept, (std::vector<int>{0, 1, 3, 4, 6}));
    EXPECT_EQ(all, (std::vector<int>{0, 1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(one.maps[0].rays.rays(), 16u);
    EXPECT_EQ(one.maps[0].rays.shares().miss, 1) << "it never saw those places";
    EXPECT_EQ(one.maps[1].rays.shares().near1, 1);

    kept.clear();
    const auto folds = holdContest(recordingOf(scans), entrants, rulesFor(3, true));
    EXPECT_EQ(folds.folds, 3u);
    EXPECT_EQ(folds.held_out, 7u);
    EXPECT_EQ(kept, (std::vector<int>{0, 1, 3, 4, 6, 0, 2, 3, 5, 6, 1, 2, 4, 5}));
    std::vector<std::size_t> judged;
    for (const ScanShares& s : folds.maps[0].by_scan) judged.push_back(s.scan);
    std::sort(judged.begin(), judged.end());
    EXPECT_EQ(judged, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6})) << "each once";
}

TEST(Contest, ReturnsOutOfRangeAndEmptyBeamsAreNotJudged) {
    std::vector<std::vector<Ray>> scans = wallScans(2);
    const double nan = std::nan("");
    for (auto& scan : scans) {
        scan.push_back({{0, 0, 0}, {9, 0, 0}});
        scan.push_back({{0, 0, 0}, {nan, 0, 0}});
        scan.push_back({{0, 0, 0}, {1e9, 0, 0}});
        scan.push_back({{0, 0, 0}, {0.15, 0, 0}});  // nearer than two cells
        scan.push_back({{0, 0, 0}, {3, 0, 0}, false});
    }
    std::vector<int> got;
    const auto result =
        holdContest(recordingOf(scans), {fake("A", 0, got, false)}, rulesFor(2, false));
    EXPECT_EQ(result.maps[0].rays.rays(), 8u);
}

TEST(Contest, AtMostTwentyThousandReturnsOfAScanEvenly) {
    std::vector<std::vector<Ray>> scans(2);
    for (auto& scan : scans)
        for (std::size_t i = 0; i < 3 * kMostReturns; i++) {
            const double y = static_cast<double>(i) * 1e-4;
            scan.push_back({{0, y, 0.05}, {2, y, 0.05}});
        }
    std::vector<int> got;
    const auto result =
        holdContest(recordingOf(scans), {fake("A", 0, got, true)}, rulesFor(2, false));
    EXPECT_EQ(result.maps[0].rays.rays(), kMostReturns);
    EXPECT_NEAR(result.view->rays[1].origin[1], 3e-4, 1e-12);
    EXPECT_EQ(result.maps[0].rays.shares().near1, 1);
}

TEST(Contest, Refusals) {
    std::vector<int> got;
    const std::vector<Entrant> entrants = {fake("A", 0, got, false)};
    const auto refused = [&](const std::vector<std::vector<Ray>>& scans, const std::string& part) {
        try {
            (void)holdContest(recordingOf(scans), entrants, rulesFor(2, false));
            ADD_FAILURE() << part;
        } catch (const std::runtime_error& e) {
            EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
        }
    };
    const std::vector<Ray> far = {{{0, 0, 0}, {90, 0, 0}}};
    refused(wallScans(1), "none is held out");
    refused({far, wallScan(0)}, "nothing usable");
    refused({wallScan(0), far}, "no point within range");
}

// The figures --------------------------------------------------------------------------------

/** All scans see the same wall, so that a map shifted by n cells errs by n cells in each. */
TEST(Contest, FiguresAndDifferencesOfShiftedMaps) {
    const std::vector<std::vector<Ray>> scans(4, wallScan(0));
    std::vector<int> got;
    const auto result = holdContest(recordingOf(scans),
                                    {fake("OctoMap", 0, got, false), fake("shifted", 2, got, false),
                                     fake("blocked", -6, got, false)},
                                    rulesFor(2, true));
    EXPECT_EQ(result.maps[1].rays.shares().near1, 0);
    EXPECT_EQ(result.maps[1].rays.shares().near3, 1);
    EXPECT_EQ(result.maps[2].rays.shares().phantom, 1);
    EXPECT_EQ(result.maps[0].faithfulness.cells, 0u) << "two returns a cell are too few to count";
    const auto d = pairedDifference(result.maps[1], result.maps[0], &RayShares::near1);
    EXPECT_EQ(d.mean, -1);
    EXPECT_EQ(d.lowest, -1);
    EXPECT_EQ(d.highest, -1);
    const auto json = toJson(result);
    EXPECT_EQ(json["maps"]["blocked"]["difference_from_OctoMap"]["early"]["mean"], 1);
    EXPECT_EQ(json["maps"]["OctoMap"]["scans"].size(), 4u);
    EXPECT_FALSE(json["maps"]["OctoMap"].contains("difference_from_OctoMap"));
}

TEST(Contest, ThePairedDifferenceHasAMeanAndARange) {
    MapResult a, b;
    for (const double x : {0.5, 0.7, 0.3}) {
        a.by_scan.push_back({0, {}}), b.by_scan.push_back({0, {}});
        a.by_scan.back().shares.early = x, b.by_scan.back().shares.early = 0.4;
    }
    a.by_scan.back().shares.depth_error_median = std::nan("");
    const auto d = pairedDifference(a, b, &RayShares::early);
    EXPECT_NEAR(d.mean, 0.1, 1e-12);
    EXPECT_NEAR(d.lowest, -0.1, 1e-12);
    EXPECT_NEAR(d.highest, 0.3, 1e-12);
    EXPECT_EQ(pairedDifference(a, b, &RayShares::depth_error_median).mean, 0) << "of two scans";
    EXPECT_TRUE(std::isnan(pairedDifference({}, {}, &RayShares::early).mean));
}

TEST(Answers, CommonKnownAndAll) {
    const float none = std::nanf("");
    Answers answers;
    answers.occupied = {1, 0, 1, 0};
    answers.of_map = {{0.8f, 0.2f, none, 0.4f}, {none, 0.1f, 0.9f, 0.6f}};
    const auto scores = scoresOf(answers);
    EXPECT_EQ(scores[0].common.cells, 2u);  // the second and the last
    EXPECT_NEAR(scores[0].common.mse, (0.04 + 0.16) / 2, 1e-6);
    EXPECT_NEAR(scores[1].common.mse, (0.01 + 0.36) / 2, 1e-6);
    EXPECT_EQ(scores[0].known.cells, 3u);
    EXPECT_NEAR(scores[0].known.mse, (0.04 + 0.04 + 0.16) / 3, 1e-6);
    EXPECT_EQ(scores[0].all.cells, 4u);
    EXPECT_NEAR(scores[0].all.mse, (0.04 + 0.04 + 0.25 + 0.16) / 4, 1e-6);
    EXPECT_EQ(scores[0].coverage, 0.75);
}

// The entrants -------------------------------------------------------------------------------

TEST(Entrants, TheCellsOfAMapAreWhatItSays) {
    AkiMap map(kCell);
    map.insertRays(fanScan());
    expectSame(cellsOf(map), [&](double x, double y, double z) { return map.occupancy(x, y, z); });
}

TEST(Entrants, OctoMapIsItsLibrarys) {
    octomap::OcTree tree(kCell);
    octomap::Pointcloud cloud;
    const auto rays = fanScan();
    for (const Ray& r : rays)
        cloud.push_back(static_cast<float>(r.end[0]), static_cast<float>(r.end[1]),
                        static_cast<float>(r.end[2]));
    tree.insertPointCloud(cloud, {0.05f, 0.05f, 0.05f}, -1, false, true);
    const auto contestant = octomapEntrant(kCell).make();
    contestant->insert({rays, rays});
    expectSame(contestant->cells(), [&](double x, double y, double z) -> std::optional<double> {
        const auto* node = tree.search(x, y, z);
        return node ? std::optional(node->getOccupancy()) : std::nullopt;
    });
    // Twenty times the same: leaves are pruned in the one tree and not in the other.
    octomap::OcTree pruned(kCell);
    for (int i = 0; i < 20; i++) pruned.insertPointCloud(cloud, {0.05f, 0.05f, 0.05f});
    octomap::OcTree copy = pruned;
    expectSame(cellsOf(pruned), [&](double x, double y, double z) -> std::optional<double> {
        const auto* node = copy.search(x, y, z);
        return node ? std::optional(node->getOccupancy()) : std::nullopt;
    });
}

TEST(Entrants, EachRayOfAMovingSensorBeginsAtItsOwnOrigin) {
    const std::vector<Ray> rays = {
        {{0, 0, 1}, {2, 0, 1}}, {{0, 0, 1}, {2, 1, 1}}, {{0, 3, 1}, {2, 3, 1}}};
    const auto octomap = octomapEntrant(kCell).make();
    octomap->insert({rays, rays});
    const OccupancyCells cells = octomap->cells();
    OccupancyCells::Reader reader(cells);
    const auto at = [&](double x, double y, double z) { return reader[cells.cellAt({x, y, z})]; };
    EXPECT_GT(at(2.05, 0.05, 1.05), 0.5f);
    EXPECT_GT(at(2.05, 3.05, 1.05), 0.5f);
    EXPECT_LT(at(1.05, 3.05, 1.05), 0.5f) << "on the way from its own origin";
    EXPECT_FALSE(isKnown(at(1.05, 1.55, 1.05))) << "on the way from the first ray's";
}

TEST(Entrants, BeyondOctoMapsGridItIsSilent) {
    const auto octomap = octomapEntrant(kCell).make();
    const std::vector<Ray> rays = {
        {{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {4000, 0, 0}}, {{4000, 0, 0}, {4001, 0, 0}}};
    testing::internal::CaptureStderr();
    octomap->insert({rays, rays});
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    std::size_t known = 0;
    octomap->cells().forEach([&](const CellIndex&, float p) { known += isKnown(p); });
    EXPECT_EQ(known, 11u);
}

TEST(Entrants, TheStandardOnes) {
    AkiMap map(kCell);
    std::string names;
    for (const Entrant& e : standardEntrants(map)) {
        names += e.name + (e.sees_held_out ? "! " : " ");
        const auto contestant = e.make();
        const auto rays = fanScan();
        contestant->insert({rays, rays});
        const OccupancyCells cells = contestant->cells();
        EXPECT_EQ(cells.resolution(), kCell);
        EXPECT_TRUE(isOccupied(OccupancyCells::Reader(cells)[{20, 0, 0}])) << e.name;
    }
    EXPECT_EQ(names, "AkiMap paper isotropic OctoMap TSDF OctoMap+! ");
}

/** The figures of evaluations made by other programs: LA3DM's long-term scans at 5 cm, up to 8 m,
 * the sensor raised to where it stood. They hold the judge still. */
TEST(Contest, La3dmsLongTermScans) {
    const char* data = std::getenv("AKIMAP_DATA");
    const std::string folder = (data ? data : "") + std::string("/la3dm/sim_structured_long_term");
    if (!data || !std::filesystem::exists(folder))
        GTEST_SKIP() << "no la3dm/sim_structured_long_term/ in AKIMAP_DATA";
    std::vector<std::vector<Ray>> scans;
    for (int i = 1; i <= 60; i++) {
        const std::string file = folder + "/sim_structured_long_term_" + std::to_string(i) + ".pcd";
        scans.push_back(readPcd(file));
        for (Ray& ray : scans.back()) ray.origin[2] += 0.3;
    }
    const auto result = holdContest(recordingOf(scans), {octomapEntrant(0.05), tsdfEntrant(0.05)},
                                    rulesFor(AkiMap(0.05)));
    EXPECT_EQ(result.maps[0].rays.rays(), 39624u);
    const auto expect = [](const RayShares& s, double near1, double near3, double early,
                           double late, double miss) {
        EXPECT_NEAR(s.near1, near1, 5e-4);
        EXPECT_NEAR(s.near3, near3, 5e-4);
        EXPECT_NEAR(s.early, early, 5e-4);
        EXPECT_NEAR(s.late, late, 5e-4);
        EXPECT_NEAR(s.miss, miss, 5e-4);
        EXPECT_NEAR(s.phantom, 0, 5e-4);
    };
    expect(result.maps[0].rays.shares(), 0.7120, 0.9285, 0.0715, 0, 0);
    expect(result.maps[1].rays.shares(), 0.9098, 0.9843, 0, 0.0058, 0.0100);
}

// The picture --------------------------------------------------------------------------------

TEST(ScanProjection, OfACamera) {
    const auto ray = [](double x, double y, double z) {
        return Ray{{1, 2, 3}, {1 + x, 2 + y, 3 + z}};
    };
    const std::vector<Ray> rays = {ray(1, 0.5, 0.25), ray(1, -0.5, 0.25), ray(1, 0.5, -0.25),
                                   ray(1, -0.5, -0.25)};
    const ScanProjection project(rays);
    EXPECT_FALSE(project.isPanorama());
    EXPECT_NEAR(project.aspect(), 2, 1e-9);
    EXPECT_NEAR(project(rays[0]).x, 0, 1e-9) << "y is to the left of one who looks along x";
    EXPECT_NEAR(project(rays[0]).y, 0, 1e-9) << "high is up";
    EXPECT_NEAR(project(rays[3]).x, 1, 1e-9);
    EXPECT_NEAR(project(rays[3]).y, 1, 1e-9);
    EXPECT_NEAR(project(ray(3, 0, 0)).x, 0.5, 1e-9);
}

TEST(ScanProjection, OfASpinningSensorAndOfACameraThatLooksAlongZ) {
    std::vector<Ray> round, ahead;
    for (int i = 0; i < 360; i++) {
        const double a = i * M_PI / 180;
        round.push_back({{0, 0, 0}, {std::cos(a), std::sin(a), i % 2 ? 0.1 : -0.1}});
        ahead.push_back({{0, 0, 0}, {0.4 * std::cos(a), 0.3 * std::sin(a), 1}});
    }
    EXPECT_TRUE(ScanProjection(round).isPanorama());
    EXPECT_NEAR(ScanProjection(round)({{0, 0, 0}, {1, 0, 0}}).x, 0.5, 0.01);
    const ScanProjection project(ahead);
    EXPECT_FALSE(project.isPanorama());
    EXPECT_NEAR(project.aspect(), 4. / 3, 0.01);
    EXPECT_GT(project({{0, 0, 0}, {0, 0.3, 1}}).y, 0.9) << "y is down";
}

TEST(DepthPicture, ShowsWhatIsBlockedInRedAndMissesInBlue) {
    std::vector<Ray> scan;
    for (int y = -30; y <= 30; y++)
        for (int z = -20; z <= 20; z++) scan.push_back({{0, 0, 0}, {2.05, 0.05 * y, 0.05 * z}});
    std::vector<std::vector<Ray>> scans(2, scan);
    std::vector<int> got;
    const auto result = holdContest(recordingOf(scans),
                                    {fake("right", 0, got, false), fake("blocked", -8, got, false)},
                                    rulesFor(2, false));
    const TemporaryFolder folder;
    const std::string file = folder.file("scan.png");
    writeDepthPicture(result, file);
    mrpt::img::CImage picture;
    ASSERT_TRUE(picture.loadFromFile(file));
    const auto pixelsOf = [&](int r, int g, int b) {
        int count = 0;
        for (unsigned y = 0; y < picture.getHeight(); y++)
            for (unsigned x = 0; x < picture.getWidth(); x++) {
                const uint8_t* bgr = picture(static_cast<int>(x), static_cast<int>(y));
                count += std::abs(bgr[2] - r) < 3 && std::abs(bgr[1] - g) < 3 &&
                         std::abs(bgr[0] - b) < 3;
            }
        return count;
    };
    constexpr int kPanel = 600 * 400;  // pixels
    EXPECT_NEAR(pixelsOf(204, 13, 20), kPanel, kPanel / 50) << "a phantom wall";
    EXPECT_NEAR(pixelsOf(219, 219, 214), kPanel, kPanel / 50) << "the right one";
    EXPECT_LT(pixelsOf(33, 94, 204), kPanel / 50) << "no more than the legend's";

    const auto colourful = [&] {
        int count = 0;
        for (unsigned y = 0; y < picture.getHeight(); y++)
            for (unsigned x = 0; x < picture.getWidth(); x++) {
                const uint8_t* bgr = picture(static_cast<int>(x), static_cast<int>(y));
                const auto [low, high] = std::minmax({bgr[0], bgr[1], bgr[2]});
                count += high - low > 30;
            }
        return count;
    };
    // The scan's depth, both maps', and the phantoms; then only what is of the map that was not
    // told the scan.
    EXPECT_NEAR(colourful(), 4 * kPanel, kPanel / 5);
    auto secret = result;
    secret.maps[0].sees_held_out = true;
    writeDepthPicture(secret, file, DepthSource::maps_alone);
    ASSERT_TRUE(picture.loadFromFile(file));
    EXPECT_NEAR(colourful(), 2 * kPanel, kPanel / 5);
    EXPECT_NEAR(pixelsOf(204, 13, 20), kPanel, kPanel / 50);

    auto not_kept = result;
    not_kept.view.reset();
    EXPECT_THROW(writeDepthPicture(not_kept, file), std::runtime_error);
}
