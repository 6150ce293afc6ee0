// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// INI files: the shipped one, what is read from one, and all that is refused in one.
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/maps/CMultiMetricMap.h>

#include "mapping/config.h"
#include "run_program.h"

namespace {

using namespace akimap::app;
using akimap::AkiMap;

const std::string kCreation = "[MappingApplication_akimap_00_creationOpts]\n";
const std::string kInsertion = "[MappingApplication_akimap_00_insertOpts]\n";
const std::string kHead = "[MappingApplication]\nakimap_count = 1\n";

class Config : public ::testing::Test {
 protected:
    AkiMap::TMapDefinition load(const std::string& text,
                                const std::string& section = "MappingApplication") const {
        writeText(folder.file("c.ini"), text);
        return loadConfig(folder.file("c.ini"), section);
    }
    /** Expects a refusal that names the file and holds `part`. */
    void expectRefused(const std::string& text, const std::string& part) const {
        try {
            load(text);
            ADD_FAILURE() << "taken, though it should be refused:\n" << text;
        } catch (const std::runtime_error& e) {
            const std::string message = e.what();
            EXPECT_NE(message.find("c.ini: "), std::string::npos) << message;
            EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks " << part;
        }
    }
    TemporaryFolder folder;
};

std::string allOptions(const AkiMap::TMapDefinition& d) {
    std::string text = "resolution = " + std::to_string(d.resolution) + "\n";
    for (const mrpt::config::CLoadableOptions* options :
         {static_cast<const mrpt::config::CLoadableOptions*>(&d.insertionOpts),
          static_cast<const mrpt::config::CLoadableOptions*>(&d.likelihoodOpts),
          static_cast<const mrpt::config::CLoadableOptions*>(&d.renderingOpts)})
        for (const OptionText& o : describe(*options)) text += o.key + " = " + o.value + "\n";
    return text;
}

std::string shippedIni() {
    return readText(std::string(AKIMAP_SOURCE_DIR) + "/share/akimap/akimap.ini");
}

TEST_F(Config, TheShippedFileIsWhatTheProgramPrints) {
    const auto run = runProgram("default-config");
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(run.out, shippedIni());
    EXPECT_EQ(run.err, "");
}

TEST_F(Config, LoadingTheShippedFileChangesNothing) {
    EXPECT_EQ(allOptions(load(shippedIni())), allOptions({}));
    EXPECT_EQ(allOptions(load(kHead)), allOptions({}));
    EXPECT_GT(describe(akimap::TInsertionOptions()).size(), 10u);
}

TEST_F(Config, TheShippedFileMakesAMapInAnyMultiMetricMap) {
    std::string text = shippedIni();
    const std::string before = "max_range = 8", after = "max_range = 9";
    text.replace(text.find(before), before.size(), after);
    const mrpt::config::CConfigFileMemory ini(text);
    mrpt::maps::TSetOfMetricMapInitializers definitions;
    testing::internal::CaptureStderr();
    definitions.loadFromConfigFile(ini, "MappingApplication");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    const mrpt::maps::CMultiMetricMap maps(definitions);
    ASSERT_EQ(maps.maps.size(), 1u);
    const auto map = maps.mapByClass<AkiMap>();
    ASSERT_TRUE(map);
    EXPECT_EQ(map->resolution(), 0.05);
    EXPECT_EQ(map->insertionOptions.max_range, 9);
    EXPECT_TRUE(map->genericMapParams.enableObservationInsertion);
}

TEST_F(Config, AnyMrptProgramWarnsOfUnknownKeys) {
    const mrpt::config::CConfigFileMemory ini(kHead + kCreation + "resolutoin = 0.1\n" +
                                              kInsertion + "MAX_RANGE = 5\nmax_rage = 5\n");
    mrpt::maps::TSetOfMetricMapInitializers definitions;
    testing::internal::CaptureStderr();
    definitions.loadFromConfigFile(ini, "MappingApplication");
    EXPECT_EQ(
        testing::internal::GetCapturedStderr(),
        "akimap: warning: [MappingApplication_akimap_00_creationOpts] unknown key resolutoin; "
        "did you mean resolution?\n"
        "akimap: warning: [MappingApplication_akimap_00_insertOpts] unknown key max_rage; did you "
        "mean max_range?\n");
}

TEST_F(Config, ValuesAreTakenWithCommentsBehindThemAndWhateverTheirCase) {
    const auto d = load(kHead + kCreation +
                        "Resolution = 0.1 ; half\n"
                        "enableSaveAs3DObject = false # dark\n"
                        "enableObservationLikelihood = true ; MRPT alone reads this as false\n" +
                        kInsertion +
                        "max_range = +12.5   // far\n"
                        "bandwidth = isotropic ; as the rivals\n"
                        "seed = 77\n"
                        "[MappingApplication_akimap_00_likelihoodOpts]\ndecimation = 3\n"
                        "[MappingApplication_akimap_00_renderOpts]\nshow_free = true\n");
    EXPECT_EQ(d.resolution, 0.1);
    EXPECT_FALSE(d.genericMapParams.enableSaveAs3DObject);
    EXPECT_TRUE(d.genericMapParams.enableObservationLikelihood);
    EXPECT_EQ(d.insertionOpts.max_range, 12.5);
    EXPECT_EQ(d.insertionOpts.bandwidth, akimap::Bandwidth::isotropic);
    EXPECT_EQ(d.insertionOpts.seed, 77u);
    EXPECT_EQ(d.likelihoodOpts.decimation, 3u);
    EXPECT_TRUE(d.renderingOpts.show_free);
}

TEST_F(Config, BothSpellingsOfASectionAreTakenButNotAtOnce) {
    const std::string other = "[MappingApplication_akimap_00_insertionOpts]\nmax_range = 4\n";
    EXPECT_EQ(load(kHead + other).insertionOpts.max_range, 4);
    EXPECT_TRUE(load(kHead + "[MappingApplication_akimap_00_renderingOpts]\nshow_free = true\n")
                    .renderingOpts.show_free);
    expectRefused(kHead + kInsertion + "min_range = 1\n" + other, "_insertionOpts]");
}

TEST_F(Config, AnotherSectionPrefixAndOtherMapsBesideIt) {
    const auto d = load(
        "[map]\npointsMap_count = 1\nakimap_count = 1 ; one\n"
        "[map_akimap_00_creationOpts]\nresolution = 0.2\n"
        "[map_pointsMap_00_creationOpts]\nanything = goes\n[ICP]\nmaxIterations = none\n",
        "map");
    EXPECT_EQ(d.resolution, 0.2);
}

TEST_F(Config, LinesThatMrptPassesOverAreRefused) {
    expectRefused(kHead + kInsertion + "max_range 5\n", "'max_range 5': not KEY = VALUE");
    expectRefused(kHead + kInsertion + "max_range = 5\nMax_Range = 6 // no\n",
                  "'Max_Range = 6': the second value of this key");
    EXPECT_EQ(load(kHead + kInsertion +
                   "// a note\n; another\n\nmax_range = 5 # m\r\n"
                   "[ICP]\nanything goes\n")
                  .insertionOpts.max_range,
              5);
}

TEST_F(Config, UnknownKeysAndSectionsAreRefusedByName) {
    expectRefused(kHead + kInsertion + "max_rage = 5\n", "unknown key max_rage");
    expectRefused(kHead + kCreation + "max_range = 5\n", "unknown key max_range");
    expectRefused(kHead + "[MappingApplication_akimap_00_insertOps]\nmax_range = 5\n",
                  "[MappingApplication_akimap_00_insertOps]");
    expectRefused(kHead + "[MappingApplication_akimap_01_insertOpts]\nmax_range = 5\n",
                  "[MappingApplication_akimap_01_insertOpts]");
    expectRefused(kHead + "[Mapping_AkiMap_00_insertOpts]\n", "[Mapping_AkiMap_00_insertOpts]");
    expectRefused(kHead + "akimap_cuont = 1\n", "unknown key akimap_cuont");
}

TEST_F(Config, AFileMustAskForJustOneMap) {
    expectRefused("", "no akimap section");
    expectRefused("[MappingApplication]\npointsMap_count = 1\n", "no akimap section");
    expectRefused("[map]\nakimap_count = 1\n", "[MappingApplication]");
    for (const char* count : {"0", "2", "one", "1.5", ""})
        expectRefused("[MappingApplication]\nakimap_count = " + std::string(count) + "\n",
                      "akimap_count = " + std::string(count));
}

TEST_F(Config, WrongValuesAreRefusedWithTheirKey) {
    expectRefused(kHead + kInsertion + "max_range = far\n", "max_range = 'far'");
    expectRefused(kHead + kInsertion + "max_range = 5m\n", "max_range = '5m'");
    expectRefused(kHead + kInsertion + "max_range =\n", "max_range");
    for (const char* wrong : {"0", "-3", "nan", "inf"})
        expectRefused(kHead + kInsertion + "max_range = " + wrong + "\n", "max_range");
    expectRefused(kHead + kInsertion + "bandwidth = adaptiv\n", "bandwidth = 'adaptiv'");
    expectRefused(kHead + kInsertion + "bandwidth = 1\n", "bandwidth = '1'");
    expectRefused(kHead + kInsertion + "threads = -1\n", "threads = '-1'");
    expectRefused(kHead + kInsertion + "seed = 1.5\n", "seed = '1.5'");
    for (const char* wrong : {"0", "-0.1", "nan", "inf", "5cm", "fine", ""})
        expectRefused(kHead + kCreation + "resolution = " + wrong + "\n",
                      "resolution = " + std::string(wrong));
    expectRefused(kHead + kCreation + "enableSaveAs3DObject = on\n", "enableSaveAs3DObject = on");
}

TEST_F(Config, ANewMapHasDoneNothingYetAndSettingsThatDoNotFitAreRefused) {
    AkiMap::TMapDefinition definition;
    const AkiMap map = makeMap(definition);
    const auto& stats = map.stats();
    EXPECT_EQ(stats.seconds_sampling + stats.seconds_bandwidth + stats.seconds_update, 0);
    EXPECT_EQ(map.insertionOptions.threads, definition.insertionOpts.threads);
    definition.resolution = 1e-5;  // kernels of half a metre would span 100000 cells
    EXPECT_THROW((void)makeMap(definition), std::invalid_argument);
}

TEST_F(Config, TheProgramRefusesABadFileOnOneLineAndWritesNothing) {
    writeText(folder.file("bad.ini"), kHead + kInsertion + "max_rage = 5\n");
    const auto run = runProgram("build none.pcd -c " + folder.file("bad.ini") + " -o " +
                                folder.file("m.akimap"));
    EXPECT_EQ(run.exit, 1);
    EXPECT_EQ(run.err, "akimap: " + folder.file("bad.ini") +
                           ": [MappingApplication_akimap_00_insertOpts] unknown key max_rage; did "
                           "you mean max_range?\n");
    EXPECT_FALSE(std::filesystem::exists(folder.file("m.akimap")));
    const auto missing = runProgram("build none.pcd -c none.ini -o " + folder.file("m.akimap"));
    EXPECT_EQ(missing.exit, 1);
    EXPECT_EQ(missing.err, "akimap: none.ini: no such file\n");
}

}  // namespace
