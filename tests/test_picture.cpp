// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// The exported picture: what is in it, and how it is framed.
#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>

#include <cmath>
#include <limits>

#include "grid/BlockGrid.h"
#include "output/export_map.h"
#include "pictures/faces.h"
#include "pictures/voxel_view.h"
#include "random_scans.h"
#include "run_program.h"

namespace {

using namespace akimap::app;
using akimap::AkiMap;
using akimap::CellIndex;
using mrpt::img::CImage;

class Picture : public ::testing::Test {
 protected:
    void SetUp() override { map.insertRays(akimap::test::randomScan(1, 2000)); }
    CImage drawn(const ExportOptions& options = {}) const {
        exportMap(map, folder.file("m.png"), options);
        CImage image;
        EXPECT_TRUE(image.loadFromFile(folder.file("m.png")));
        EXPECT_EQ(image.getWidth(), 1600u);
        EXPECT_EQ(image.getHeight(), 1000u);
        return image;
    }
    TemporaryFolder folder;
    AkiMap map{0.05};
};

/** Blue, green, red of a pixel. */
std::array<int, 3> pixel(const CImage& image, int x, int y) {
    const auto* p = image.ptr<uint8_t>(static_cast<unsigned>(x), static_cast<unsigned>(y));
    return {p[0], p[1], p[2]};
}

/** Pixels of the right two thirds, where the cells are, that are as far from grey as colours are.
 */
int colouredPixels(const CImage& image) {
    int count = 0;
    for (int y = 0; y < 1000; y++)
        for (int x = 540; x < 1600; x++) {
            const auto c = pixel(image, x, y);
            count +=
                *std::max_element(c.begin(), c.end()) - *std::min_element(c.begin(), c.end()) > 60;
        }
    return count;
}

constexpr int kDark = 140;

/** Grey pixels of the slice, at the lower left, from `darkest` to `lightest`. */
int slicePixels(const CImage& image, int darkest, int lightest) {
    int count = 0;
    for (int y = 500; y < 930; y++)
        for (int x = 40; x < 300; x++) {
            const auto [r, g, b] = pixel(image, x, y);
            count += r == g && g == b && r >= darkest && r <= lightest;
        }
    return count;
}

bool same(const CImage& a, const CImage& b) {
    for (int y = 0; y < 1000; y++)
        for (int x = 0; x < 1600; x++)
            if (pixel(a, x, y) != pixel(b, x, y)) return false;
    return true;
}

TEST_F(Picture, ShowsCellsAndTheSlice) {
    const CImage image = drawn();
    EXPECT_GT(colouredPixels(image), 100000);  // of a million
    EXPECT_GT(slicePixels(image, 255, 255), 1000);
    EXPECT_GT(slicePixels(image, 0, kDark), 20);
    EXPECT_TRUE(same(image, drawn())) << "the same map gave two pictures";
}

TEST_F(Picture, NeedsNoDisplay) {
    map.saveToFile(folder.file("m.akimap"));
    const auto run = runCommand("env -u DISPLAY -u WAYLAND_DISPLAY '" AKIMAP_PROGRAM "' export " +
                                folder.file("m.akimap") + " " + folder.file("n.png"));
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(run.out + run.err, "");
    drawn();
    EXPECT_EQ(readText(folder.file("n.png")), readText(folder.file("m.png")));
}

TEST_F(Picture, FollowsThresholdUnknownAndSlice) {
    const CImage image = drawn();
    ExportOptions options;
    options.threshold = 0.99;
    EXPECT_LT(colouredPixels(drawn(options)), colouredPixels(image));
    options = {};
    options.unknown = true;
    EXPECT_FALSE(same(drawn(options), image));
    options = {};
    options.slice = 0.02;  // along the floor
    EXPECT_GT(slicePixels(drawn(options), 0, kDark), 2 * slicePixels(image, 0, kDark));
}

TEST_F(Picture, WithoutOccupiedCellsIsTheSliceAlone) {
    ExportOptions options;
    options.threshold = 0.9999999;
    const CImage image = drawn(options);
    EXPECT_EQ(colouredPixels(image), 0);
    EXPECT_GT(slicePixels(image, 255, 255), 1000);
}

TEST_F(Picture, OfAnEmptyMapOrASliceOutsideIsRefused) {
    EXPECT_THROW(exportMap(AkiMap(0.1), folder.file("e.png")), std::runtime_error);
    ExportOptions options;
    options.slice = 40;
    EXPECT_THROW(exportMap(map, folder.file("e.png"), options), std::runtime_error);
    options = {};
    options.unknown = true;  // within bounds of 1e8 cells and more
    AkiMap wide(0.05);
    wide.insertRays({{{0, 0, 0}, {1, 1, 1}}, {{60, 60, 20}, {61, 61, 21}}});
    EXPECT_THROW(exportMap(wide, folder.file("e.png"), options), std::runtime_error);
    EXPECT_FALSE(std::filesystem::exists(folder.file("e.png")));
    EXPECT_NO_THROW(exportMap(wide, folder.file("e.png")));
}

TEST(Cells, ExposedFacesOfABlockAreItsSurface) {
    CellSet cells;
    for (int x = -2; x < 3; x++)
        for (int y = 6; y < 10; y++)
            for (int z = -9; z < -6; z++) cells.insert({x, y, z});
    EXPECT_EQ(cells.size(), 60u);
    int faces = 0;
    forEachExposedFace(cells, [&](const Face& face) {
        faces++;
        const auto open = openness(cells, face);
        EXPECT_EQ(open, (std::array<int, 4>{3, 3, 3, 3})) << "nothing rises beside a block";
    });
    EXPECT_EQ(faces, 2 * (5 * 4 + 5 * 3 + 4 * 3));
    cells.insert({0, 7, -6});
    EXPECT_LT(openness(cells, faceOf({1, 7, -7}, 2, 1))[0], 3) << "a cell rises beside it";
}

/** A room of 4 x 3 x 2.4 m in cells of 5 cm. */
CellSet room(bool with_ceiling) {
    CellSet cells;
    for (int x = 0; x < 80; x++)
        for (int y = 0; y < 60; y++) {
            cells.insert({x, y, 0});
            if (with_ceiling) cells.insert({x, y, 47 + (x + y) % 2});
            if (x == 0 || y == 0 || x == 79 || y == 59)
                for (int z = 0; z < 48; z++) cells.insert({x, y, z});
        }
    return cells;
}

TEST(Cells, OnlyACeilingIsTakenAway) {
    EXPECT_EQ(below(room(false), ceiling(room(false), 0.05)).size(), room(false).size());
    EXPECT_EQ(ceiling(room(false), 0.05), kNoCeiling);
    const double cut = ceiling(room(true), 0.05);
    const CellSet open = below(room(true), cut);
    EXPECT_NEAR(cut, 47, 1);
    EXPECT_FALSE(open.contains({40, 30, 47}));
    EXPECT_TRUE(open.contains({40, 30, 0}));
    EXPECT_TRUE(open.contains({0, 30, 45}));
}

TEST(Cells, TheCameraKeepsClearOfWhatIsTaken) {
    const CellSet cells = room(false);
    const std::vector<Frame> taken = {{0, 0, 480, 160}, {0, 500, 440, 1000}};
    const Camera camera = chooseCamera(cells, {32, 32, 1568, 968}, taken, {1, 1, 1, 1});
    double left = 1e9, right = 0;
    cells.forEach([&](const CellIndex& c) {
        const auto v = camera.project({c.x + .5, c.y + .5, c.z + .5});
        left = std::min(left, double(v.x)), right = std::max(right, double(v.x));
        EXPECT_TRUE(v.x > 20 && v.x < 1580 && v.y > 20 && v.y < 980) << v.x << " " << v.y;
        for (const Frame& f : taken)
            EXPECT_FALSE(v.x > f.left && v.x < f.right - 10 && v.y > f.top + 10 && v.y < f.bottom);
    });
    EXPECT_GT(right - left, 700) << "the picture is not used";
}

TEST(Cells, TheCameraLooksAtTheSidesThatWereSeen) {
    const CellSet cells = room(false);
    for (std::size_t side = 0; side < 4; side++) {
        std::array<double, 4> facing{};
        facing[side] = 1000;
        const Camera camera = chooseCamera(cells, {32, 32, 1568, 968}, {}, facing);
        const double ahead = camera.eye()[side / 2] - (side < 2 ? 40 : 30);
        EXPECT_EQ(ahead > 0, side % 2 == 1) << "side " << side;
    }
}

}  // namespace
