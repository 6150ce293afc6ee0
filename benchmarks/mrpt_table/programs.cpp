// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <sys/wait.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "Row.h"
#include "errors.h"
#include "simulation/files.h"

namespace akimap::bench {
namespace {

namespace fs = std::filesystem;
using Changes = std::vector<std::pair<std::string, std::string>>;

const std::string kDatasets = "/usr/share/mrpt/datasets/";
const std::string kLoop = kDatasets + "2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog";
constexpr int kSeconds = 60;

std::string readText(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error(file.string() + ": can't be read");
    return {std::istreambuf_iterator<char>(in), {}};
}

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
}

/** Gives the keys, wherever they stand, other values; the key and its blanks must be in the INI. */
void change(std::string& ini, const Changes& changes) {
    for (const auto& [key, value] : changes) {
        const auto at = ini.find("\n" + key);
        if (at == std::string::npos) throw std::runtime_error("the INI has no " + key);
        const auto begin = ini.find('=', at) + 1;
        ini.replace(begin, ini.find('\n', begin) - begin, " " + value);
    }
}

/** One of the INIs that come with AkiMap, for a map of that kind instead. */
std::string iniFor(const MapKind& kind, const std::string& name, const Changes& changes) {
    const fs::path shipped = fs::path(AKIMAP_SOURCE_DIR) / "share/akimap/config_files" / name;
    std::string ini = readText(shipped);
    change(ini, changes);
    replaceAll(ini, "\nakimap_count", "\n" + kind.ini + "_count");
    replaceAll(ini, "_akimap_00_", "_" + kind.ini + "_00_");
    replaceAll(ini, "\nmax_range", "\n" + kind.max_range_key);
    return ini;
}

int run(const fs::path& folder, const std::string& command) {
    const std::string all = "cd '" + folder.string() + "' && LD_PRELOAD='" + AKIMAP_LIBRARY +
                            "' timeout " + std::to_string(kSeconds) + " " + command +
                            " >out.log 2>&1 </dev/null";
    const int status = std::system(all.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/** What it said of its end, on one line; empty if nothing. */
std::string complaint(const fs::path& folder) {
    const std::string text = readText(folder / "out.log");
    const auto at = text.rfind("MRPT exception");
    return at == std::string::npos ? "" : ": " + app::reasonOf(text.substr(at));
}

/** Endings of the files that it wrote of its map, e.g. ".akimap". */
std::string filesOf(const MapKind& kind, const fs::path& folder) {
    std::set<std::string> endings;
    const std::string mark = kind.name + "_0";
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        const auto at = name.find(mark);
        if (at != std::string::npos) endings.insert("`" + name.substr(at + mark.size() + 1) + "`");
    }
    std::string all;
    for (const auto& e : endings) all += (all.empty() ? "" : ", ") + e;
    return all;
}

std::string outcome(const MapKind& kind, const fs::path& folder, int exit) {
    if (exit == 124) return "hangs";
    if (exit == 128 + SIGABRT) return "aborts" + complaint(folder);
    if (exit > 128 && exit < 255) return "crashes: signal " + std::to_string(exit - 128);
    if (exit != 0) return "fails" + complaint(folder);
    const std::string files = filesOf(kind, folder);
    return files.empty() ? "runs, but writes no map" : "runs, writes " + files;
}

/** A program's run with an INI for each kind. */
struct Trial {
    std::string call, program, ini;
    Changes changes;
    std::string arguments;
};

std::string attempt(const MapKind& kind, const fs::path& top, const Trial& trial) {
    std::string name = trial.call + "-" + kind.name;
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '-';
    const fs::path folder = top / name;
    fs::create_directories(folder);
    std::ofstream(folder / "c.ini") << iniFor(kind, trial.ini, trial.changes);
    return outcome(kind, folder, run(folder, trial.program + " c.ini " + trial.arguments));
}

/** The first 80 entries of the 2D log. */
std::string cutLog(const fs::path& folder) {
    if (run(folder, "rawlog-edit -q --cut --to-index 79 -i '" + kLoop + "' -o cut.rawlog") != 0)
        throw std::runtime_error("rawlog-edit fails" + complaint(folder));
    return (folder / "cut.rawlog").string();
}

std::string drive(const fs::path& folder) {
    const auto files = app::prepareFolder((folder / "drive").string());
    const auto simulated = app::simulate({});
    app::writeDrive(simulated, *simulated.truth(0.2), files, false);
    return files.simplemap;
}

Row viewer(const char* name) {
    return {std::string("`") + name + "`", [](const MapKind& kind) {
                return std::string(kind.name == "AkiMap" ? "see `tests/viewers.sh`" : "not tried");
            }};
}

}  // namespace

Section programRows(const std::string& folder) {
    const std::string log = cutLog(folder), loop = "'" + kLoop + "'";
    const Changes alone_slam{{"PF_algorithm ", "0"},
                             {"pointsMap_count ", "0"},
                             {"sampleSize ", "3"},
                             {"enableObservationLikelihood ", "true"}};
    const Changes few{{"particles_count ", "2000"}, {"init_PDF_mode ", "1"},
                      {"init_PDF_min_x ", "-1"},    {"init_PDF_max_x ", "1"},
                      {"init_PDF_min_y ", "-11"},   {"init_PDF_max_y ", "-9"},
                      {"3DSceneFrequency ", "-1"},  {"enableObservationLikelihood ", "true"}};
    Changes alone_localization = few;
    alone_localization.push_back({"occupancyGrid_count ", "0"});
    const std::vector<Trial> trials{
        {"`observations2map`, 3D scans",
         "observations2map",
         "observations2map.ini",
         {},
         drive(folder) + " out"},
        {"`icp-slam` beside a points map", "icp-slam", "icp-slam.ini", {}, loop},
        {"`icp-slam` alone", "icp-slam", "icp-slam.ini", {{"pointsMap_count ", "0"}}, loop},
        {"`rbpf-slam` beside a points map",
         "rbpf-slam",
         "rbpf-slam.ini",
         {{"sampleSize ", "3"}},
         log},
        {"`rbpf-slam` alone, weighing the particles", "rbpf-slam", "rbpf-slam.ini", alone_slam,
         log},
        {"`pf-localization` beside a grid, both weighing", "pf-localization", "pf-localization.ini",
         few, ""},
        {"`pf-localization` alone", "pf-localization", "pf-localization.ini", alone_localization,
         ""},
    };
    Section section{"Programs",
                    "The installed programs with the INIs of `share/akimap/config_files`, changed "
                    "only to ask for the column's map.",
                    {},
                    false};
    for (const Trial& t : trials)
        section.rows.push_back(
            {t.call, [folder, t](const MapKind& kind) { return attempt(kind, folder, t); }});
    section.rows.push_back(viewer("RawLogViewer"));
    section.rows.push_back(viewer("SceneViewer3D"));
    return section;
}

}  // namespace akimap::bench
