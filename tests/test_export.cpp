// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// Every export read back and held against the map, cell by cell; and what happens when one fails.
#include <akimap/queries.h>
#include <gtest/gtest.h>
#include <mrpt/maps/COctoMap.h>
#include <mrpt/opengl/COctoMapVoxels.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSetOfTriangles.h>
#include <octomap/OcTree.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <map>
#include <sstream>

#include "input/clouds/PcdReader.h"
#include "output/export_map.h"
#include "random_scans.h"
#include "run_program.h"

// MRPT's headers declare getOctomap() but not what it looks into, so that it does not compile
// without this, a copy of that declaration in MRPT's sources.
template <class Tree, class Node>
struct mrpt::maps::COctoMapBase<Tree, Node>::Impl {
    Tree m_octomap;
};

namespace {

using namespace akimap::app;
using akimap::AkiMap;
using akimap::CellState;
using mrpt::math::TPoint3D;

class Export : public ::testing::Test {
 protected:
    void SetUp() override { map.insertRays(akimap::test::randomScan(1, 800)); }
    [[nodiscard]] std::string file(const std::string& name) const { return folder.file(name); }
    [[nodiscard]] std::string exported(const std::string& name,
                                       const ExportOptions& options = {}) const {
        exportMap(map, file(name), options);
        return file(name);
    }
    [[nodiscard]] std::size_t filesInFolder() const {
        std::size_t n = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
            n += entry.exists();
        return n;
    }
    /** Expects the export to fail, naming the file, and an older file to be left as it was. */
    void expectRefused(const AkiMap& bad, const std::string& name, const ExportOptions& options,
                       const std::string& part) const {
        writeText(file(name), "older");
        try {
            exportMap(bad, file(name), options);
            ADD_FAILURE() << name << " was written";
        } catch (const std::runtime_error& e) {
            EXPECT_NE(std::string(e.what()).find(file(name)), std::string::npos) << e.what();
            EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
        }
        EXPECT_EQ(readText(file(name)), "older");
        EXPECT_EQ(filesInFolder(), 1u);
        std::filesystem::remove(file(name));
    }
    TemporaryFolder folder;
    AkiMap map{0.1};
};

TEST_F(Export, CsvHasEveryCellInNineDigits) {
    std::ifstream in(exported("m.csv"));
    std::string line;
    std::getline(in, line);
    EXPECT_EQ(line, "x,y,z,occupancy,alpha,beta");
    std::size_t rows = 0;
    map.forEachCell([&](const akimap::Cell& cell_at) {
        const mrpt::math::TPoint3D p(cell_at.x, cell_at.y, cell_at.z);
        const akimap::CellState& cell = cell_at.state;
        ASSERT_TRUE(std::getline(in, line));
        rows++;
        std::istringstream fields(line);
        for (const double expected : {p.x, p.y, p.z, cell.occupancy(), cell.alpha, cell.beta}) {
            std::string field;
            std::getline(fields, field, ',');
            EXPECT_NEAR(std::stod(field), expected, 5.1e-9 * std::abs(expected)) << line;
        }
    });
    EXPECT_EQ(rows, map.cellCount());
    EXPECT_FALSE(std::getline(in, line));
}

TEST_F(Export, PcdHoldsTheOccupiedCells) {
    for (const double threshold : {0.5, 0.8}) {
        ExportOptions options;
        options.threshold = threshold;
        const auto rays = readPcd(exported("m.pcd", options));
        const auto cells = map.occupiedCells(threshold);
        ASSERT_EQ(rays.size(), cells.size());
        for (std::size_t i = 0; i < cells.size(); i++) {
            EXPECT_EQ(rays[i].end[0], cells[i].x);
            EXPECT_EQ(rays[i].end[1], cells[i].y);
            EXPECT_EQ(rays[i].end[2], cells[i].z);
        }
        const std::string text = readText(file("m.pcd"));
        float intensity = 0;
        std::memcpy(&intensity, text.data() + text.size() - 4, 4);
        EXPECT_NEAR(intensity, *map.occupancy(cells.back().x, cells.back().y, cells.back().z),
                    1e-6);
    }
    EXPECT_GT(map.occupiedCells(0.5).size(), map.occupiedCells(0.8).size());
}

TEST_F(Export, PlyHoldsTheOccupiedCellsColouredByHeight) {
    const std::string text = readText(exported("m.ply"));
    const auto cells = map.occupiedCells();
    EXPECT_EQ(text.rfind("ply\nformat binary_little_endian 1.0\n", 0), 0u);
    EXPECT_NE(text.find("element vertex " + std::to_string(cells.size()) + "\n"),
              std::string::npos);
    const std::size_t begin = text.find("end_header\n") + 11, size = 8 * 4 + 3;
    ASSERT_EQ(text.size(), begin + size * cells.size());
    std::map<float, std::string> color_of_height;
    int normals = 0;
    for (std::size_t i = 0; i < cells.size(); i++) {
        float v[8];
        std::memcpy(v, text.data() + begin + i * size, sizeof(v));
        EXPECT_EQ(v[0], cells[i].x);
        EXPECT_EQ(v[1], cells[i].y);
        EXPECT_EQ(v[2], cells[i].z);
        EXPECT_NEAR(v[3], *map.occupancy(v[0], v[1], v[2]), 1e-6);
        const auto normal = akimap::surfaceNormal(map, v[0], v[1], v[2]);
        EXPECT_NEAR(v[4], normal ? normal->direction.x : 0, 1e-6);
        EXPECT_NEAR(v[6], normal ? normal->direction.z : 0, 1e-6);
        EXPECT_NEAR(v[7], normal ? normal->confidence : 0, 1e-6);
        normals += normal.has_value();
        const std::string color = text.substr(begin + i * size + 32, 3);
        EXPECT_EQ(color_of_height.emplace(v[2], color).first->second, color);
    }
    EXPECT_NE(color_of_height.begin()->second, color_of_height.rbegin()->second);
    EXPECT_GT(normals, 0);
}

/** Leaves of single cells: OctoMap trees hold pruned ones. */
std::size_t cellsOf(octomap::OcTree tree) {
    tree.expand();
    return tree.getNumLeafNodes();
}

TEST_F(Export, BtIsReadByOctoMapCellByCell) {
    for (const double threshold : {0.5, 0.8}) {
        ExportOptions options;
        options.threshold = threshold;
        octomap::OcTree tree(exported("m.bt", options));
        EXPECT_EQ(tree.getResolution(), 0.1);
        EXPECT_EQ(cellsOf(tree), map.cellCount());
        map.forEachCell([&](const akimap::Cell& cell_at) {
            const mrpt::math::TPoint3D p(cell_at.x, cell_at.y, cell_at.z);
            const akimap::CellState& cell = cell_at.state;
            const auto* node = tree.search(p.x, p.y, p.z);
            ASSERT_TRUE(node);
            EXPECT_EQ(tree.isNodeOccupied(node), cell.occupancy() > threshold);
        });
    }
}

TEST_F(Export, OtIsReadByOctoMapCellByCell) {
    const std::unique_ptr<octomap::AbstractOcTree> read(
        octomap::AbstractOcTree::read(exported("m.ot")));
    auto* tree = dynamic_cast<octomap::OcTree*>(read.get());
    ASSERT_TRUE(tree);
    EXPECT_EQ(cellsOf(*tree), map.cellCount());
    double extreme = 0;
    map.forEachCell([&](const akimap::Cell& cell_at) {
        const mrpt::math::TPoint3D p(cell_at.x, cell_at.y, cell_at.z);
        const akimap::CellState& cell = cell_at.state;
        const auto* node = tree->search(p.x, p.y, p.z);
        ASSERT_TRUE(node);
        EXPECT_NEAR(node->getOccupancy(), std::clamp(cell.occupancy(), 1e-4, 1 - 1e-4), 1e-6);
        extreme = std::max(extreme, std::abs(static_cast<double>(node->getLogOdds())));
    });
    EXPECT_LT(extreme, 9.3);  // clamped, as none of the bare evidence is
}

TEST_F(Export, OctoMapFilesGoIntoMrptsOctoMap) {
    const std::unique_ptr<octomap::AbstractOcTree> full(
        octomap::AbstractOcTree::read(exported("m.ot")));
    mrpt::maps::COctoMap from_bt(0.1), from_ot(0.1);
    ASSERT_TRUE(from_bt.getOctomap<octomap::OcTree>().readBinary(exported("m.bt")));
    from_ot.getOctomap<octomap::OcTree>().swapContent(dynamic_cast<octomap::OcTree&>(*full));
    map.forEachCell([&](const akimap::Cell& cell_at) {
        const mrpt::math::TPoint3D p(cell_at.x, cell_at.y, cell_at.z);
        const akimap::CellState& cell = cell_at.state;
        const auto q = p.cast<float>();
        double occupancy = -1;
        ASSERT_TRUE(from_bt.getPointOccupancy(q.x, q.y, q.z, occupancy));
        EXPECT_EQ(occupancy > 0.5, cell.occupancy() > 0.5);
        ASSERT_TRUE(from_ot.getPointOccupancy(q.x, q.y, q.z, occupancy));
        EXPECT_NEAR(occupancy, cell.occupancy(), 1.1e-4);
    });
}

TEST_F(Export, OctoMapFilesAreWrittenInSilence) {
    map.saveToFile(file("m.akimap"));
    for (const char* name : {"m.bt", "m.ot"}) {
        const auto run = runProgram("export " + file("m.akimap") + " " + file(name));
        EXPECT_EQ(run.exit, 0);
        EXPECT_EQ(run.out + run.err, "") << name;
    }
}

TEST_F(Export, AMapBeyondOctoMapsKeysIsRefusedAsOctoMap) {
    AkiMap far(0.1);
    far.insertRays({{{3276.75 + 1, 0.05, 0.05}, {3276.75 + 3, 0.05, 0.05}}});
    ASSERT_FALSE(far.isEmpty());
    for (const char* name : {"far.bt", "far.ot"}) expectRefused(far, name, {}, "3276.8");
    EXPECT_NO_THROW(exportMap(far, file("far.csv")));
}

TEST_F(Export, TheSceneOpensAndShowsTheUnknownOnRequest) {
    using mrpt::opengl::COctoMapVoxels, mrpt::opengl::CSetOfObjects, mrpt::opengl::CSetOfTriangles;
    ExportOptions unknown;
    unknown.unknown = true;
    for (const bool with : {false, true}) {
        mrpt::opengl::COpenGLScene scene;
        ASSERT_TRUE(scene.loadFromFile(exported("m.3Dscene", with ? unknown : ExportOptions())));
        const auto own = std::dynamic_pointer_cast<CSetOfObjects>(scene.getByName("akimap"));
        ASSERT_TRUE(own);
        const auto voxels = own->getByClass<COctoMapVoxels>();
        ASSERT_TRUE(voxels);
        EXPECT_EQ(voxels->getVoxelCount(mrpt::opengl::VOXEL_SET_OCCUPIED),
                  map.occupiedCells().size());
        const auto surface = std::dynamic_pointer_cast<CSetOfTriangles>(scene.getByName("unknown"));
        ASSERT_EQ(surface != nullptr, with);
        if (!surface) continue;
        EXPECT_GT(surface->getTrianglesCount(), 1000u);
        const auto box = map.boundingBox(), drawn = surface->getBoundingBoxLocalf();
        for (int i = 0; i < 3; i++) {
            EXPECT_GT(drawn.min[i], box.min[i] - 1e-3);
            EXPECT_LT(drawn.max[i], box.max[i] + 1e-3);
        }
    }
}

TEST_F(Export, ExtensionsAreOfAnyCase) {
    for (const char* name : {"a.CSV", "b.3dscene", "c.Bt"})
        EXPECT_NO_THROW(exportMap(map, file(name)));
}

TEST_F(Export, AnUnknownExtensionIsRefusedBeforeAnyWork) {
    for (const char* name : {"m.xyz", "m", "m.png.txt"}) {
        EXPECT_THROW(checkExportable(file(name)), std::runtime_error);
        expectRefused(map, name, {}, ".csv");
    }
}

TEST_F(Export, AnUnwritablePlaceIsRefusedAndLeavesNothing) {
    std::filesystem::create_directory(file("folder.csv"));
    for (const std::string& name : {std::string("folder.csv"), std::string("none/m.csv")}) {
        EXPECT_THROW(checkExportable(file(name)), std::runtime_error) << name;
        EXPECT_THROW(exportMap(map, file(name)), std::runtime_error) << name;
    }
    checkExportable(file("m.csv"));
    EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(Export, AFullDiskIsNoticed) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    for (const char* name :
         {"full.csv", "full.ply", "full.pcd", "full.bt", "full.ot", "full.3Dscene", "full.png"}) {
        std::filesystem::create_symlink("/dev/full", file(name));
        EXPECT_THROW(exportMap(map, file(name)), std::runtime_error) << name;
    }
}

/** A limit of the files' size is as a disk with so much room. */
TEST_F(Export, WhereverADiskIsFullTheOlderFileStays) {
    const auto usual = std::signal(SIGXFSZ, SIG_IGN);
    const auto limitFiles = [](rlim_t bytes) {
        struct rlimit limit {};
        getrlimit(RLIMIT_FSIZE, &limit);
        limit.rlim_cur = std::min(bytes, limit.rlim_max);
        setrlimit(RLIMIT_FSIZE, &limit);
    };
    for (const char* name : {"m.csv", "m.ply", "m.pcd", "m.bt", "m.ot", "m.3Dscene", "m.png"}) {
        const std::string whole = readText(exported(name));
        const std::size_t step = (whole.size() / 8 / 4096 + 1) * 4096;
        for (std::size_t room = 0; room < whole.size(); room += step) {
            writeText(file(name), "older");
            limitFiles(room);
            EXPECT_THROW(exportMap(map, file(name)), std::runtime_error) << name << ", " << room;
            limitFiles(RLIM_INFINITY);
            EXPECT_EQ(readText(file(name)), "older") << name << ", " << room;
        }
        limitFiles(whole.size());
        EXPECT_NO_THROW(exportMap(map, file(name))) << name;
        limitFiles(RLIM_INFINITY);
        EXPECT_EQ(readText(file(name)), whole) << name;
        std::filesystem::remove(file(name));
        EXPECT_EQ(filesInFolder(), 0u) << name;
    }
    std::signal(SIGXFSZ, usual);
}

TEST_F(Export, TheProgramRefusesBadInputInOneLine) {
    map.saveToFile(file("m.akimap"));
    const std::string good = "export " + file("m.akimap") + " ";
    writeText(file("older.bt"), "older");
    for (const std::string& arguments :
         {"export " + file("none.akimap") + " " + file("older.bt"), good + file("m.xyz"),
          good + file("none/m.csv"), good + file("m.bt") + " --threshold 1.5",
          good + file("m.bt") + " --threshold nan", good + file("m.png") + " --slice 99",
          good + file("m.png") + " --slice inf", good + file("m.png") + " --slise 1", good}) {
        const auto run = runProgram(arguments);
        EXPECT_NE(run.exit, 0) << arguments;
        EXPECT_LT(run.exit, 128) << arguments;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
    EXPECT_EQ(readText(file("older.bt")), "older");
    EXPECT_EQ(filesInFolder(), 2u);
}

}  // namespace
