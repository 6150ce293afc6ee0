// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <akimap/AkiMap.h>
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/opengl/COctoMapVoxels.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/system/CObserver.h>
#include <tbb/global_control.h>

#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <map>
#include <thread>

#include "grid/BlockGrid.h"
#include "mrpt/option_fields.h"
#include "random_scans.h"
#include "run_program.h"
#include "same_map.h"

using namespace akimap;
using test::fingerprint;

namespace {

AkiMap smallMap(double resolution = 0.1) {
    AkiMap map(resolution);
    for (unsigned seed = 1; seed <= 3; seed++)
        EXPECT_TRUE(map.insertRays(test::randomScan(seed, 300)));
    return map;
}

AkiMap everyOptionChanged() {
    AkiMap map = smallMap(0.2);
    auto& o = map.insertionOptions;
    o.beyond_max_range = BeyondMaxRange::free;
    o.max_evidence = 50;
    o.estimator = Estimator::paper, o.surface_range = 0.3, o.free_radius = 0.3;
    o.min_range = 0.5, o.max_range = 20, o.sampling_distance = 0.7, o.search_range_origin = 0.1;
    o.search_range_max = 0.6, o.search_region = SearchRegion::ball, o.covariance_floor = 2e-3;
    o.covariance_center = CovarianceCenter::mean, o.bandwidth = Bandwidth::covariance;
    o.isotropic_length = 0.4, o.scale_min_length = 0.2, o.scale_max = 1.5, o.prior_alpha = 0.01;
    o.scale_search = ScaleSearch::descent, o.prior_beta = 0.02, o.seed = 77, o.threads = 1;
    map.likelihoodOptions.decimation = 3, map.likelihoodOptions.p_unknown = 0.4;
    map.likelihoodOptions.p_outlier = 0.1, map.likelihoodOptions.sigma_hit = 0.2;
    map.likelihoodOptions.independent_returns = 5;
    map.renderingOptions.threshold = 0.6, map.renderingOptions.show_free = true;
    map.renderingOptions.max_voxels = 10;
    map.genericMapParams.enableSaveAs3DObject = false;
    return map;
}

AkiMap readBack(const std::string& data) {
    mrpt::io::CMemoryStream stream;
    stream.Write(data.data(), data.size());
    stream.Seek(0);
    auto archive = mrpt::serialization::archiveFrom(stream);
    AkiMap map;
    archive >> map;
    return map;
}

}  // namespace

TEST(AkiMap, AnswersEq4AtAPointAndNothingWhereNothingIsKnown) {
    AkiMap map(0.05);
    EXPECT_TRUE(map.isEmpty());
    EXPECT_FALSE(map.occupancy(0, 0, 0));
    ASSERT_TRUE(map.insertRays({Ray{{0.01, 0.01, 0.01}, {2.02, 0.02, 0.02}}}));
    EXPECT_FALSE(map.isEmpty());
    EXPECT_GT(map.occupancy(2.02, 0.02, 0.02).value(), 0.95);
    EXPECT_LT(map.occupancy(0.01, 0.01, 0.01).value(), 0.01);
    EXPECT_FALSE(map.occupancy(2.02, 3, 0));
    EXPECT_FALSE(map.occupancy(1e300, NAN, 0));
    const CellState s = map.cell(2.02, 0.02, 0.02).value();
    EXPECT_NEAR(s.alpha, 1.8, 0.2);  // one surface, which counts twice, and lies in the cell
    EXPECT_LT(s.beta, 0.1);          // or a little before it
    EXPECT_DOUBLE_EQ(s.occupancy(), s.alpha / (s.alpha + s.beta));
}

TEST(AkiMap, VisitsEachCellThatAQueryKnows) {
    const AkiMap map = smallMap();
    std::size_t n = 0, occupied = 0;
    const auto box = map.boundingBox();
    map.forEachCell([&](const akimap::Cell& cell_at) {
        const mrpt::math::TPoint3D p(cell_at.x, cell_at.y, cell_at.z);
        const akimap::CellState& s = cell_at.state;
        n++, occupied += s.occupancy() > 0.5;
        ASSERT_EQ(map.cell(p.x, p.y, p.z).value().alpha, s.alpha);
        EXPECT_TRUE(box.containsPoint(p.cast<float>()));
    });
    EXPECT_EQ(n, map.cellCount());
    EXPECT_GT(occupied, 100u);
    EXPECT_EQ(map.occupiedCells().size(), occupied);
    EXPECT_GT(map.occupiedCells(0.1).size(), map.occupiedCells(0.9).size());
}

TEST(AkiMap, BoundingBoxIsTightAndZeroWhenEmpty) {
    EXPECT_EQ(AkiMap().boundingBox().max, mrpt::math::TPoint3Df(0, 0, 0));
    AkiMap map(0.5);
    map.insertionOptions.estimator = Estimator::paper;  // reaches no other cells here
    map.insertRays({Ray{{0.25, 0.25, 0.25}, {4.25, 0.25, 0.25}}});
    const auto box = map.boundingBox();
    EXPECT_FLOAT_EQ(box.min.x, 0);
    EXPECT_FLOAT_EQ(box.max.x, 4.5);
    EXPECT_FLOAT_EQ(box.max.z, 0.5);
}

TEST(AkiMap, SameBitsForAnyNumberOfThreads) {
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
    std::string expected;
    for (const unsigned threads : {1u, 2u, 3u, 8u}) {
        AkiMap map(0.05);
        map.insertionOptions.estimator = Estimator::paper;
        map.insertionOptions.threads = threads;
        for (unsigned seed = 1; seed <= 3; seed++) map.insertRays(test::randomScan(seed, 800));
        if (threads == 1) expected = test::cellsFingerprint(map);
        EXPECT_EQ(test::cellsFingerprint(map), expected) << threads << " threads";
    }
    AkiMap other(0.05);
    other.insertionOptions.estimator = Estimator::paper;
    other.insertionOptions.seed = 2;
    for (unsigned seed = 1; seed <= 3; seed++) other.insertRays(test::randomScan(seed, 800));
    EXPECT_NE(test::cellsFingerprint(other), expected);
}

TEST(AkiMap, ScansThatHoldNothingUsableChangeNothing) {
    AkiMap map = smallMap();
    const auto before = fingerprint(map);
    EXPECT_FALSE(map.insertRays({}));
    EXPECT_FALSE(map.insertRays({Ray{{0, 0, 0}, {NAN, 0, 0}}}));
    EXPECT_FALSE(map.insertRays({Ray{{0, 0, 0}, {100, 0, 0}}}));
    EXPECT_EQ(fingerprint(map), before);
    EXPECT_EQ(map.stats().dropped_nonfinite, 1u);
}

TEST(AkiMap, ScansOfUsableRaysAreNumbered) {
    // The paper's draws must not depend on what else the map holds: a scan that changes nothing
    // has a number too, unless nothing of it could be used anywhere.
    const auto after = [](const std::vector<std::vector<Ray>>& scans) {
        AkiMap map(0.1);
        map.insertionOptions.estimator = Estimator::paper;
        for (const auto& rays : scans) map.insertRays(rays);
        return test::cellsFingerprint(map);
    };
    const auto scan = test::randomScan(1, 300);
    const std::vector<Ray> too_far{Ray{{0, 0, 0}, {100, 0, 0}}};
    EXPECT_EQ(after({scan}), after({too_far, {}, scan}));

    AkiMap misses(0.1);  // kernels so small that they reach no cell's centre
    misses.insertionOptions.estimator = Estimator::paper;
    misses.insertionOptions.bandwidth = Bandwidth::isotropic;
    misses.insertionOptions.isotropic_length = 1e-3;
    EXPECT_FALSE(misses.insertRays({Ray{{0.01, 0.01, 0.01}, {1.01, 0.01, 0.01}}}));
    AkiMap hits(0.1);
    for (AkiMap* m : {&misses, &hits}) {
        m->insertionOptions = {};
        m->insertionOptions.estimator = Estimator::paper;
        m->insertRays(scan);
    }
    EXPECT_NE(test::cellsFingerprint(misses), test::cellsFingerprint(hits));
}

TEST(AkiMap, BadOptionsThrowNamingTheParameterAndChangeNothing) {
    AkiMap map = smallMap();
    const auto before = test::cellsFingerprint(map);
    const auto expectRefusal = [&](const std::string& name, auto&& set) {
        AkiMap copy = map;
        set(copy.insertionOptions);
        try {
            copy.insertRays(test::randomScan(9, 10));
            ADD_FAILURE() << name << " was taken";
        } catch (const std::invalid_argument& e) {
            EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
        }
        EXPECT_EQ(test::cellsFingerprint(copy), before);
    };
    expectRefusal("max_range", [](auto& o) { o.max_range = 0; });
    expectRefusal("max_range", [](auto& o) { o.max_range = NAN; });
    expectRefusal("min_range", [](auto& o) { o.min_range = -1; });
    expectRefusal("max_range", [](auto& o) { o.min_range = 9; });
    expectRefusal("sampling_distance", [](auto& o) { o.sampling_distance = 0; });
    expectRefusal("search_range_max", [](auto& o) { o.search_range_max = INFINITY; });
    expectRefusal("surface_range", [](auto& o) { o.surface_range = 1e6; });
    expectRefusal("free_radius", [](auto& o) { o.free_radius = -1; });
    expectRefusal("beyond_max_range",
                  [](auto& o) { o.beyond_max_range = static_cast<BeyondMaxRange>(2); });
    expectRefusal("max_evidence", [](auto& o) { o.max_evidence = 0.5; });
    expectRefusal("estimator", [](auto& o) { o.estimator = static_cast<Estimator>(9); });
    map.insertionOptions.estimator = Estimator::paper;
    expectRefusal("sampling_distance", [](auto& o) { o.sampling_distance = 1e-12; });
    expectRefusal("search_range_max", [](auto& o) { o.search_range_max = 1e6; });
    expectRefusal("covariance_floor", [](auto& o) { o.covariance_floor = -1; });
    expectRefusal("isotropic_length", [](auto& o) { o.isotropic_length = 1e9; });
    expectRefusal("scale_max", [](auto& o) { o.scale_max = 1e6, o.search_range_max = 1e-5; });
    expectRefusal("prior_beta", [](auto& o) { o.prior_beta = -1; });
    expectRefusal("bandwidth", [](auto& o) { o.bandwidth = static_cast<Bandwidth>(9); });
    EXPECT_THROW(AkiMap(0), std::invalid_argument);
    EXPECT_THROW(map.setResolution(NAN), std::invalid_argument);
}

template <class Options>
std::map<std::string, std::string> textsOf(const Options& options) {
    std::map<std::string, std::string> texts;
    visitFields(options, [&](const char* name, const auto& v, const char*) {
        texts[name] = std::to_string(static_cast<double>(v));
    });
    return texts;
}

TEST(AkiMap, EveryOptionOfEveryStructSurvivesItsRoundTrips) {
    const AkiMap changed = everyOptionChanged();
    const AkiMap back = readBack(test::bytes(changed));
    const auto expectKept = [&](const auto& options, const auto& streamed) {
        auto fresh = options, from_ini = options;
        fresh = {}, from_ini = {};
        mrpt::config::CConfigFileMemory written;
        options.saveToConfigFile(written, "s");
        from_ini.loadFromConfigFile(mrpt::config::CConfigFileMemory(written.getContent()), "s");
        const auto wanted = textsOf(options), defaults = textsOf(fresh), read = textsOf(streamed),
                   loaded = textsOf(from_ini);
        for (const auto& [name, text] : wanted) {
            EXPECT_NE(text, defaults.at(name)) << name << " is not changed";
            EXPECT_EQ(text, loaded.at(name)) << name;
            if (name != "threads") {  // no part of a map
                EXPECT_EQ(text, read.at(name)) << name;
            }
        }
    };
    expectKept(changed.insertionOptions, back.insertionOptions);
    expectKept(changed.likelihoodOptions, back.likelihoodOptions);
    expectKept(changed.renderingOptions, back.renderingOptions);
}

TEST(AkiMap, SerializationKeepsEverything) {
    for (const AkiMap& map : {AkiMap(), smallMap(), everyOptionChanged()}) {
        EXPECT_EQ(fingerprint(readBack(test::bytes(map))), fingerprint(map));
    }
    const AkiMap back = readBack(test::bytes(everyOptionChanged()));
    EXPECT_EQ(back.insertionOptions.bandwidth, Bandwidth::covariance);
    EXPECT_EQ(back.insertionOptions.seed, 77u);
    EXPECT_EQ(back.likelihoodOptions.decimation, 3u);
    EXPECT_TRUE(back.renderingOptions.show_free);
    EXPECT_FALSE(back.genericMapParams.enableSaveAs3DObject);
}

TEST(AkiMap, CopiesAreNotWatchedByTheOriginalsObservers) {
    struct Listener : mrpt::system::CObserver {
        int events = 0;
        void OnEvent(const mrpt::system::mrptEvent&) override { events++; }
    };
    AkiMap map = smallMap();
    Listener listener;
    listener.observeBegin(map);
    {
        AkiMap copy = map;  // whose end must not wait for an observer that does not know it
        copy.clear();
    }
    EXPECT_EQ(listener.events, 0);
    map = AkiMap(0.2);  // goes on being watched
    map.clear();
    EXPECT_GT(listener.events, 0);
    listener.observeEnd(map);
}

TEST(AkiMap, OptionsThatCouldNotBeReadBackAreNotWritten) {
    const TemporaryFolder folder;
    AkiMap map = smallMap();
    map.saveToFile(folder.file("m.akimap"));
    const auto expectRefusal = [&](const std::string& name, auto&& set) {
        AkiMap copy = map;
        set(copy);
        try {
            copy.saveToFile(folder.file("m.akimap"));
            ADD_FAILURE() << name << " was written";
        } catch (const std::exception& e) {
            EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
        }
        EXPECT_EQ(fingerprint(*AkiMap::loadFromFile(folder.file("m.akimap"))), fingerprint(map));
    };
    expectRefusal("threshold", [](AkiMap& m) { m.renderingOptions.threshold = 1; });
    expectRefusal("decimation", [](AkiMap& m) { m.likelihoodOptions.decimation = 0; });
    expectRefusal("max_range", [](AkiMap& m) { m.insertionOptions.max_range = -1; });
    expectRefusal("estimator",
                  [](AkiMap& m) { m.insertionOptions.estimator = static_cast<Estimator>(7); });
}

TEST(AkiMap, ThreadsAreTheReadersOwn) {
    AkiMap map = smallMap();
    map.insertionOptions.threads = 3;
    mrpt::io::CMemoryStream stream;
    auto archive = mrpt::serialization::archiveFrom(stream);
    archive << map;
    stream.Seek(0);
    AkiMap reader;
    reader.insertionOptions.threads = 1;
    archive >> reader;
    EXPECT_EQ(reader.insertionOptions.threads, 1u);
}

TEST(AkiMap, CopiesGoOnAsTheOriginalWould) {
    AkiMap original = smallMap();
    AkiMap constructed = original, assigned, streamed = readBack(test::bytes(original));
    assigned = original;
    const auto clone = std::dynamic_pointer_cast<AkiMap>(original.duplicateGetSmartPtr());
    ASSERT_TRUE(clone);
    original.insertRays(test::randomScan(9, 200));
    for (AkiMap* copy : {&constructed, &assigned, &streamed, clone.get()}) {
        EXPECT_NE(fingerprint(*copy), fingerprint(original));
        copy->insertRays(test::randomScan(9, 200));  // the same random draws
        EXPECT_EQ(fingerprint(*copy), fingerprint(original));
    }
}

TEST(AkiMap, MultiMetricMapFromAnIniAndItsCopy) {
    mrpt::config::CConfigFileMemory ini(std::string(
        "[MappingApplication]\nakimap_count=1\n[MappingApplication_akimap_00_creationOpts]"
        "\nresolution=0.1\n"
        "[MappingApplication_akimap_00_insertOpts]\nmax_range=7 // metres\nbandwidth=covariance\n"
        "[MappingApplication_akimap_00_insertionOpts]\nseed=5 ; MOLA's name of the section\n"
        "[MappingApplication_akimap_00_renderOpts]\nmax_voxels=5\n"));
    mrpt::maps::TSetOfMetricMapInitializers initializers;
    initializers.loadFromConfigFile(ini, "MappingApplication");
    mrpt::maps::CMultiMetricMap maps(initializers);
    ASSERT_EQ(maps.maps.size(), 1u);
    auto map = maps.mapByClass<AkiMap>();
    EXPECT_EQ(map->resolution(), 0.1);
    EXPECT_EQ(map->insertionOptions.max_range, 7);
    EXPECT_EQ(map->insertionOptions.bandwidth, Bandwidth::covariance);
    EXPECT_EQ(map->insertionOptions.seed, 5u);
    EXPECT_EQ(map->renderingOptions.max_voxels, 5u);
    map->insertRays(test::randomScan(1, 300));

    const mrpt::maps::CMultiMetricMap copy = maps;
    EXPECT_EQ(fingerprint(*copy.mapByClass<AkiMap>()), fingerprint(*map));
}

TEST(AkiMap, IniWithABadValueThrowsAndNamesIt) {
    for (const std::string line :
         {"max_range=abc", "bandwidth=isotropc", "threads=-1", "covariance_floor=-1", "seed=1.5",
          "beyond_max_range=yes", "max_range=0,5"}) {
        mrpt::config::CConfigFileMemory ini("[s]\n" + line + "\n");
        TInsertionOptions o;
        try {
            o.loadFromConfigFile(ini, "s");
            ADD_FAILURE() << line << " was taken";
        } catch (const std::invalid_argument& e) {
            EXPECT_NE(std::string(e.what()).find(line.substr(0, line.find('='))), std::string::npos)
                << e.what();
        }
    }
}

TEST(AkiMap, FilesRoundTripAndDamagedOnesAreRefused) {
    const TemporaryFolder folder;
    const std::string file = folder.file("map.akimap");
    const AkiMap map = smallMap();
    map.saveToFile(file);
    EXPECT_EQ(fingerprint(*AkiMap::loadFromFile(file)), fingerprint(map));

    const std::string whole = readText(file);
    const auto expectRefused = [&](const std::string& content, const char* what) {
        writeText(folder.file("bad.akimap"), content);
        try {
            (void)AkiMap::loadFromFile(folder.file("bad.akimap"));
            ADD_FAILURE() << what << " was taken";
        } catch (const std::runtime_error& e) {
            EXPECT_NE(std::string(e.what()).find("bad.akimap"), std::string::npos) << e.what();
            EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
        }
    };
    expectRefused("", "an empty file");
    expectRefused("not a map at all", "text");
    for (const double part : {0.1, 0.5, 0.9, 0.999})
        expectRefused(
            whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))),
            "a cut file");
    std::string flipped = whole;
    flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 0x55);
    expectRefused(flipped, "a damaged file");
    EXPECT_THROW((void)AkiMap::loadFromFile(folder.file("none")), std::runtime_error);
    EXPECT_THROW(map.saveToFile(folder.file("no/such/folder/map")), std::runtime_error);
}

TEST(AkiMap, AFullDiskLeavesTheOlderFile) {
    const TemporaryFolder folder;
    const std::string file = folder.file("map.akimap");
    const AkiMap map = smallMap();
    map.saveToFile(file);
    const auto size = std::filesystem::file_size(file);
    struct rlimit before {};
    getrlimit(RLIMIT_FSIZE, &before);
    signal(SIGXFSZ, SIG_IGN);
    for (const std::size_t missing : {size_t{1}, size_t{100}, size_t{4000}, size / 2}) {
        const struct rlimit small { size - missing, before.rlim_max };
        setrlimit(RLIMIT_FSIZE, &small);
        EXPECT_THROW(map.saveToFile(file), std::runtime_error) << missing << " bytes short";
        setrlimit(RLIMIT_FSIZE, &before);
        EXPECT_EQ(fingerprint(*AkiMap::loadFromFile(file)), fingerprint(map));
    }
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(AkiMap, ATinyFloorGivesNoNaN) {
    AkiMap map = smallMap();
    map.insertionOptions.estimator = Estimator::paper;
    map.insertionOptions.covariance_floor = 1e-12;
    for (unsigned seed = 1; seed <= 5; seed++) map.insertRays(test::randomScan(seed, 300));
    EXPECT_EQ(fingerprint(readBack(test::bytes(map))), fingerprint(map));  // refuses NaN
}

TEST(AkiMap, KernelsThatReachNoCentreAreNoInsertion) {
    AkiMap map(0.1);
    map.insertionOptions.estimator = Estimator::paper;
    map.insertionOptions.bandwidth = Bandwidth::isotropic;
    map.insertionOptions.isotropic_length = 1e-3;
    EXPECT_FALSE(map.insertRays({Ray{{0.01, 0.01, 0.01}, {1.01, 0.01, 0.01}}}));
    EXPECT_TRUE(map.isEmpty());
    EXPECT_EQ(map.stats().scans, 0u);
}

TEST(AkiMap, EveryCellAnswersUpToTheEdgeOfTheGrid) {
    AkiMap map(0.05);
    const double edge = (BlockGrid::kMaxCell - 1) * 0.05;
    ASSERT_TRUE(map.insertRays({Ray{{edge - 3, -edge, 0}, {edge, -edge, 0}}}));
    map.forEachCell([&](const akimap::Cell& cell_at) {
        const mrpt::math::TPoint3D p(cell_at.x, cell_at.y, cell_at.z);
        EXPECT_TRUE(map.cell(p.x, p.y, p.z));
    });
}

TEST(AkiMap, RepresentationFilesAreWritten) {
    const TemporaryFolder folder;
    smallMap().saveMetricMapRepresentationToFile(folder.file("map"));
    EXPECT_GT(std::filesystem::file_size(folder.file("map_3D.3Dscene")), 1000u);
    EXPECT_EQ(fingerprint(*AkiMap::loadFromFile(folder.file("map.akimap"))),
              fingerprint(smallMap()));
}

TEST(AkiMap, VisualizationDrawsOccupiedCellsAndFallsBackToPoints) {
    AkiMap map = smallMap();
    mrpt::opengl::CSetOfObjects voxels;
    map.getVisualizationInto(voxels);
    const auto drawn = voxels.getByClass<mrpt::opengl::COctoMapVoxels>();
    ASSERT_TRUE(drawn);
    EXPECT_EQ(drawn->getVoxelCount(mrpt::opengl::VOXEL_SET_OCCUPIED), map.occupiedCells().size());

    map.renderingOptions.max_voxels = 10;
    mrpt::opengl::CSetOfObjects points;
    map.getVisualizationInto(points);
    const auto cloud = points.getByClass<mrpt::opengl::CPointCloudColoured>();
    ASSERT_TRUE(cloud);
    EXPECT_EQ(cloud->size(), map.occupiedCells().size());

    map.genericMapParams.enableSaveAs3DObject = false;
    mrpt::opengl::CSetOfObjects none;
    map.getVisualizationInto(none);
    EXPECT_TRUE(none.empty());
}

TEST(AkiMap, ConcurrentReadsAgree) {
    const AkiMap map = smallMap();
    std::vector<std::size_t> counts(4);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < counts.size(); t++)
        threads.emplace_back([&, t] {
            map.forEachCell([&](const akimap::Cell& cell_at) {
                const mrpt::math::TPoint3D p(cell_at.x, cell_at.y, cell_at.z);
                counts[t] += map.cell(p.x, p.y, p.z).has_value();
            });
        });
    for (auto& t : threads) t.join();
    for (const auto n : counts) EXPECT_EQ(n, map.cellCount());
}

TEST(AkiMap, MemoryIsBlocksIndexAndSlack) {
    AkiMap map(0.05);
    for (unsigned seed = 1; seed <= 3; seed++) map.insertRays(test::randomScan(seed, 3000));
    const double per_cell =
        static_cast<double>(map.memoryBytes()) / static_cast<double>(map.cellCount());
    EXPECT_LT(per_cell, 32);
    EXPECT_GE(map.memoryBytes(), map.blockCount() * sizeof(Block));
}

TEST(AkiMap, ClearForgetsEverythingButTheOptions) {
    AkiMap map = smallMap(), fresh(0.1);
    map.clear();
    EXPECT_TRUE(map.isEmpty());
    EXPECT_EQ(fingerprint(map), fingerprint(fresh));
}
