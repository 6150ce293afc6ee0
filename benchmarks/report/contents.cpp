// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "report/contents.h"

#include <algorithm>
#include <sstream>

#include "report/accuracy.h"
#include "report/localizing.h"
#include "report/moving.h"
#include "report/noisy.h"
#include "report/on_the_fly.h"

namespace akimap::bench {
namespace {

constexpr double kCell = 0.05;  // [m]

std::string heading(const std::string& text) {
    return "\n## " + text + "\n\n";
}

std::string real(Report& report, const std::vector<Trial>& trials) {
    std::string text = heading("What the next scan sees: recorded data") + predictionLegend();
    for (const Trial& trial : trials) text += predictionSection(report, trial);
    return text;
}

std::string noisy(Report& report, const std::vector<NoisyPlace>& places) {
    std::string text =
        heading("Simulated scenes with the sensors' errors and wrong poses") +
        "Two rooms with doors, a window, thin legs, poles, stairs and a slope, 12 scans; ranges "
        "with the errors of each sensor's datasheet (doc/design.md), poses off by 1 cm and 0.3 "
        "degrees on each axis; 5 cm cells. The truth is exact. `known`: the cells that the map has "
        "evidence for, to which precision and recall belong too; `all`: every cell of known truth, "
        "p = 0.5 without evidence.\n";
    for (const NoisyPlace& place : places) {
        report.doing(place.name + ": scans and truth");
        text += "\n### " + place.name + "\n\n" + noisySection(report, place.take());
    }
    return text;
}

std::string moving(Report& report, const std::vector<std::function<WatchedWalk()>>& walks) {
    std::string text =
        heading("Things that move") +
        "Someone crosses a simulated room before a standing robot and stops halfway; 5 scans a "
        "second. Cells held for occupied where they are and, meanwhile and later, where they were; "
        "and of the cells that were occupied when they were left, the scans until they are free.\n";
    for (const auto& take : walks) {
        const WatchedWalk walk = take();
        text += "\n### " + walk.name + ", " + std::to_string(walk.scans.size()) + " scans\n\n" +
                movingSection(report, walk);
    }
    return text;
}

std::string localization(Report& report, const std::vector<LocalizationCase>& cases,
                         const LocalizationRules& rules) {
    std::string text = heading("Localization in recorded data") + localizationLegend(rules);
    for (const LocalizationCase& c : cases)
        text += "\n### " + c.name + "\n\n" + localizationSection(report, c, rules);
    return text;
}

std::string onTheFly(Report& report, const std::vector<LidarModel>& lidars) {
    constexpr std::size_t kScans = 100;
    std::ostringstream out;
    out << heading("On the fly")
        << "Simulated lidars in a room, 10 Hz, 5 cm cells, 10 m range. A scan is lost if it comes "
           "during an update, by a virtual clock.\n";
    for (const LidarModel& model : lidars) {
        report.doing(model.name + ": scans");
        const LidarDrive drive = simulatedLidar(kScans, model);
        std::string file = model.name.substr(model.name.find(' ') + 1);  // without "simulated"
        std::replace(file.begin(), file.end(), ' ', '_');
        out << "\n### " << model.name << ": " << model.beams << " beams, "
            << drive.scans.front().size() << " returns a scan\n\n"
            << onTheFlySection(report, drive, file);
    }
    return out.str();
}

std::string clean(Report& report, const std::vector<Place>& places) {
    std::ostringstream out;
    out << heading("Simulated scenes with clean ranges and true poses") << "5 cm cells, returns "
        << "within " << kMaxRange
        << " m unless said otherwise, one thread. The default's constants were chosen on rooms "
           "like these. σ: the largest standard deviation of a row's figures over its runs; a run "
           "is a recording or, where there is only one, a seed of the method, of slow methods only "
           "three. Time is insertion only, median. Pictures are of the first run; close-ups show "
           "a piece of a wall and of the floor from one viewpoint, each cell's colour telling what "
           "the map says of it beside the truth.\n";
    for (const Place& place : places)
        out << "\n### " << place.name << "\n\n"
            << place.what << "\n\n"
            << accuracySection(report, place);
    out << "\nThe rows:\n\n";
    for (const auto& methods : {akimapMethods(), otherMethods()})
        for (const Method& m : methods) out << "- " << m.name << ": " << m.what << "\n";
    return out.str();
}

std::string asShipped(Report& report, const std::vector<Place>& places) {
    std::string text = heading("LA3DM as shipped: the paper's table");
    for (const Place& place : places)
        text += place.what + "\n\n" + paperTable() + "\nHere:\n\n" + accuracySection(report, place);
    return text;
}

std::vector<NoisyPlace> noisyPlaces() {
    constexpr uint64_t kRecordings = 3;
    std::vector<NoisyPlace> places;
    for (const NoisySensor& sensor : noisySensors()) {
        // The OS1's 1.3 million returns a recording are taken and mapped but once.
        const uint64_t recordings = sensor.kind == app::SensorKind::os1_128 ? 1 : kRecordings;
        places.push_back({sensor.name, [=] {
                              std::vector<Scene> scenes;
                              for (uint64_t seed = 1; seed <= recordings; seed++)
                                  scenes.push_back(noisyScene(sensor, seed, kCell));
                              return scenes;
                          }});
    }
    return places;
}

}  // namespace

Contents standardContents(int seeds) {
    Contents c;
    c.real = realTrials();
    c.noisy = noisyPlaces();
    c.walks = {[] { return simulatedWalk(app::SensorKind::kinect, "Kinect", 1, kCell); },
               [] { return simulatedWalk(app::SensorKind::vlp16, "VLP-16", 1, kCell); }};
    c.localization = [] { return localizationCases(); };
    c.lidars = {sixteenBeams(), denseLidar()};
    c.clean = simulatedPlaces(seeds);
    c.as_shipped = la3dmAsShipped();
    return c;
}

std::string bodyOf(Report& report, const Contents& c) {
    std::string text;
    if (!c.real.empty()) text += real(report, c.real);
    if (!c.noisy.empty()) text += noisy(report, c.noisy);
    if (!c.walks.empty()) text += moving(report, c.walks);
    if (c.localization) text += localization(report, c.localization(), c.localization_rules);
    if (!c.lidars.empty()) text += onTheFly(report, c.lidars);
    if (!c.clean.empty()) text += clean(report, c.clean);
    if (!c.as_shipped.empty()) text += asShipped(report, c.as_shipped);
    return text;
}

}  // namespace akimap::bench
