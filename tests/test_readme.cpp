// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// What README.md tells to type works, in its order, in a fresh folder; what it tells of one's own
// data works on such data.
#include <mrpt/img/CImage.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "build_fixture.h"

namespace {

using namespace build_tests;

std::string readme() {
    return readText(std::string(AKIMAP_SOURCE_DIR) + "/README.md");
}

/** The contents of the blocks that begin with ```sh. */
std::vector<std::string> shellBlocks() {
    std::vector<std::string> blocks;
    std::istringstream lines(readme());
    bool in_block = false;
    for (std::string line; std::getline(lines, line);) {
        if (line == "```sh")
            blocks.emplace_back(), in_block = true;
        else if (line == "```")
            in_block = false;
        else if (in_block)
            blocks.back() += line + "\n";
    }
    return blocks;
}

/** The commands of the table "I have". */
std::vector<std::string> tableCommands() {
    std::vector<std::string> commands;
    const std::string text = readme();
    const std::regex row("\\n\\|[^|\\n]*\\| `(akimap [^`]*)` \\|");
    for (std::sregex_iterator i(text.begin(), text.end(), row), end; i != end; ++i)
        commands.push_back((*i)[1]);
    return commands;
}

class Readme : public Build {
 protected:
    void SetUp() override {
        const auto build = std::filesystem::path(AKIMAP_PROGRAM).parent_path().parent_path();
        std::filesystem::create_directory_symlink(build, file("build"));
        std::filesystem::create_directory_symlink(std::string(AKIMAP_SOURCE_DIR) + "/share",
                                                  file("share"));
    }
    /** Runs a script in the folder, as it stands in a clone that is built. */
    ::Run runScript(const std::string& script) const {
        write("script.sh", "set -e\ncd '" + folder.path().string() + "'\n" + script);
        return runCommand("bash '" + file("script.sh") + "'");
    }
    /** What the table's rows are about: a flat wall seen from five places, in all forms. */
    void makeData() const {
        for (const char* name : {"scans", "mapped", "velodyne", "office", "depth"})
            std::filesystem::create_directory(file(name));
        const std::string header =
            "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 289\nHEIGHT 1\nVIEWPOINT ";
        std::string kitti, tum, log;
        for (int i = 0; i < kScans; i++) {
            const std::string number = std::to_string(i), x = std::to_string(0.5 * i);
            std::string here, there, bytes;
            const auto seen = wall(i);
            for (std::size_t k = 0; k < seen->pointcloud->size(); k++) {
                float p[4] = {0, 0, 0, 1};
                seen->pointcloud->getPoint(k, p[0], p[1], p[2]);
                const auto yz = " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
                here += std::to_string(p[0]) + yz;
                there += std::to_string(p[0] + 0.5 * i) + yz;
                bytes.append(reinterpret_cast<const char*>(p), sizeof p);
            }
            write("scans/" + number + ".pcd", header + "0 0 0 1 0 0 0\nDATA ascii\n" + here);
            write("mapped/" + number + ".pcd", header + x + " 0 0 1 0 0 0\nDATA ascii\n" + there);
            write("velodyne/" + number + ".bin", bytes);
            const std::string rows = "1 0 0 " + x + " 0 1 0 0 0 0 1 0";
            kitti += rows + "\n";
            tum += std::to_string(1000000000 + i) + " " + x + " 0 0 0 0 0 1\n";
            log += number + " 0 1\n1 0 0 " + x + "\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
            write("office/" + number + ".pose.txt", rows + " 0 0 0 1\n");
            writeDepth(file("office/" + number + ".depth.png"));
            writeDepth(file("depth/" + std::to_string(1000000000 + i) + ".png"));
        }
        write("poses.txt", kitti);
        write("calib.txt", "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n");
        write("office/camera-intrinsics.txt", "525 0 320 0 525 240 0 0 1\n");
        write("groundtruth.txt", tum);
        write("trajectory.log", log);
        write("camera.json", "{\"intrinsic_matrix\": [525,0,0, 0,525,0, 320,240,1]}");
        std::string list;
        for (int i = 0; i < kScans; i++)
            list += std::to_string(1000000000 + i) + " depth/" + std::to_string(1000000000 + i) +
                    ".png\n";
        write("depth.txt", list);
        Objects log_with_poses = walls();
        for (int i = 0; i < kScans; i++) log_with_poses.push_back(robotPose(i, poseOf(i)));
        plain("drive.rawlog", log_with_poses);
        std::filesystem::copy_file(trajectory(), file("trajectory.tum"));
    }
    static void writeDepth(const std::string& name) {
        mrpt::img::CImage image(640, 480, mrpt::img::CH_GRAY);
        image.resize(640, 480, mrpt::img::CH_GRAY, mrpt::img::PixelDepth::D16U);
        for (unsigned y = 0; y < 480; y++)
            std::fill_n(image.ptrLine<uint16_t>(y), 640, uint16_t{2000});
        ASSERT_TRUE(image.saveToFile(name));
    }
};

TEST_F(Readme, ItsBlocksRunInOrder) {
    const auto blocks = shellBlocks();
    ASSERT_GE(blocks.size(), 4u);
    std::string script;
    const std::regex make("(^|\\n)make ?([a-z]*)[^\\n]*");
    const std::string makefile = readText(std::string(AKIMAP_SOURCE_DIR) + "/Makefile");
    for (std::size_t i = 0; i < blocks.size(); i++) {
        // What the tests are part of is not run once more, but its target is there.
        for (std::sregex_iterator m(blocks[i].begin(), blocks[i].end(), make), end; m != end; ++m)
            EXPECT_TRUE((*m)[2] == "" || holds(makefile, "\n" + (*m)[2].str())) << m->str();
        script += std::regex_replace(blocks[i], make, "$1") + "\necho BLOCK " + std::to_string(i) +
                  " done\n";
    }
    const auto run = runScript(script);
    EXPECT_EQ(run.exit, 0) << run.out << run.err;
    EXPECT_TRUE(holds(run.out, "BLOCK " + std::to_string(blocks.size() - 1) + " done"));
    EXPECT_FALSE(holds(run.err, "warning")) << run.err;
    // The map of the first block is still that of the first block.
    for (const char* made :
         {"drive.akimap", "drive.png", "drive.ply", "roc.png", "next.png", "akimap.ini"})
        EXPECT_GT(std::filesystem::file_size(file(made)), 1000u) << made;
}

TEST_F(Readme, ItsTableOfDataIsTrue) {
    makeData();
    const auto commands = tableCommands();
    ASSERT_GE(commands.size(), 11u);
    for (const std::string& command : commands) {
        const auto run = runScript("PATH=\"$PWD/build/bin:$PATH\"\n" + command);
        if (holds(command, ".bag")) {
            EXPECT_EQ(run.exit, 1);  // there is none here, and one sentence says so
            EXPECT_TRUE(holds(run.err, "drive.bag: no such file")) << run.err;
            continue;
        }
        EXPECT_EQ(run.exit, 0) << command << "\n" << run.err;
        EXPECT_EQ(run.err, "") << command;
    }
}

TEST_F(Readme, HelpFitsAndHasExamples) {
    for (const char* command : {"build", "holdout", "convert", "check", "simulate", "export",
                                "info", "query", "eval", "slam", "localize", "default-config"}) {
        const auto help = runProgram(std::string(command) + " --help");
        ASSERT_EQ(help.exit, 0) << command << help.err;
        std::istringstream lines(help.out);
        int examples = 0;
        for (std::string line; std::getline(lines, line);) {
            EXPECT_LE(line.size(), 100u) << command << ": " << line;
            examples += line.rfind(std::string("  akimap ") + command, 0) == 0;
        }
        EXPECT_GE(examples, 2) << command;
    }
}

}  // namespace
