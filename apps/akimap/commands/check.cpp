// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <mrpt/core/format.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "checking/ScanSurvey.h"
#include "cli.h"
#include "commands/commands.h"
#include "help.h"
#include "input/scan_feed.h"
#include "output/outputs.h"
#include "quantile.h"
#include "support/AtomicFile.h"

namespace akimap::app {

namespace {

constexpr const char* kFooter =
    "Agreement: of the cells of 0.2 m that returns of earlier scans ended in and a scan sees, the\n"
    "share that it ends in too and does not look through: with the poses, with all scans at the\n"
    "first pose, and with the poses inverted. Where the sensor moves, the right poses win.";

struct CheckRequest {
    InputRequest input;
    std::string json;
    bool quiet = false;
};

void row(const std::string& name, const std::string& value) {
    std::cout << mrpt::format("%-22s %s\n", name.c_str(), value.c_str());
}

std::string poseText(const mrpt::poses::CPose3D& p) {
    constexpr double kDegrees = 180 / M_PI;
    return mrpt::format("%.3f %.3f %.3f m, yaw %.1f pitch %.1f roll %.1f degrees", p.x(), p.y(),
                        p.z(), p.yaw() * kDegrees, p.pitch() * kDegrees, p.roll() * kDegrees);
}

void printTimes(const std::vector<double>& times) {
    if (times.size() < 2) return row("times", times.empty() ? "none" : "one");
    const auto [first, last] = std::minmax_element(times.begin(), times.end());
    const double seconds = *last - *first;
    row("times", mrpt::format("%.3f to %.3f s, %.2f scans/s", *first, *last,
                              seconds > 0 ? static_cast<double>(times.size() - 1) / seconds : 0));
}

void printSurvey(const ScanFeed& feed, const ScanSurvey& survey) {
    for (const auto& source : feed.sources())
        row("input", source->file() + mrpt::format(": %zu scans", source->scanCount()) +
                         (source->how().empty() ? "" : ", posed " + source->how()));
    row("scans", std::to_string(survey.scans()));
    const auto& points = survey.pointCounts();
    row("points of a scan", mrpt::format("%.0f to %.0f, median %.0f", quantile(points, 0),
                                         quantile(points, 1), quantile(points, 0.5)));
    if (!survey.ranges().empty())
        row("ranges",
            mrpt::format("median %.2f m, 99 %% up to %.2f m", quantile(survey.ranges(), 0.5),
                         quantile(survey.ranges(), 0.99)));
    const auto& low = survey.lowest();
    const auto& high = survey.highest();
    row("extent", mrpt::format("%.2f %.2f %.2f to %.2f %.2f %.2f m", low[0], low[1], low[2],
                               high[0], high[1], high[2]));
    printTimes(survey.times());
    row("first sensor pose", poseText(survey.poses().front()));
    row("last sensor pose", poseText(survey.poses().back()));
    double length = 0, longest = 0;
    for (const auto& step : survey.steps())
        length += step.metres, longest = std::max(longest, step.metres);
    row("way", mrpt::format("%.2f m, longest step %.2f m", length, longest));
    row("up, guessed", survey.upAxis());
    const Agreement a = survey.agreement();
    if (survey.scans() > 1)
        row("agreement", mrpt::format("%.3f; without poses %.3f, with inverted ones %.3f", a.posed,
                                      a.unposed, a.inverted));
}

nlohmann::ordered_json toJson(const ScanSurvey& survey) {
    const Agreement a = survey.agreement();
    nlohmann::ordered_json json{{"scans", survey.scans()},
                                {"points_median", quantile(survey.pointCounts(), 0.5)},
                                {"lowest", survey.lowest()},
                                {"highest", survey.highest()},
                                {"up", survey.upAxis()},
                                {"agreement", a.posed},
                                {"agreement_without_poses", a.unposed},
                                {"agreement_inverted", a.inverted},
                                {"findings", survey.findings()}};
    return json;
}

void survey(const CheckRequest& request) {
    checkInputOptions(request.input);
    checkOutputs({request.json}, filesRead(request.input));
    ScanFeed feed(request.input);
    ScanSurvey survey;
    feed.forEachScan([&](const Scan& scan, uint64_t) { survey.add(scan, raysOf(scan, false)); },
                     !request.quiet);
    if (survey.scans() == 0) throw std::runtime_error("nothing usable in the inputs");
    if (!request.json.empty()) writeWhole(request.json, toJson(survey).dump(2) + "\n");
    if (request.quiet) return;
    printSurvey(feed, survey);
    if (feed.skipped().outside_trajectory)
        row("looks wrong",
            std::to_string(feed.skipped().outside_trajectory) + " scans outside the trajectory");
    const auto findings = survey.findings();
    for (const std::string& line : findings) row("looks wrong", line);
    if (findings.empty() && !feed.skipped().outside_trajectory) row("looks wrong", "nothing");
}

void run(const CheckRequest& request) {
    withErrorsInJson(request.json, filesRead(request.input), [&] { survey(request); });
}

}  // namespace

void addCheck(CLI::App& app) {
    auto* command =
        app.add_subcommand("check", "Tell what is in inputs, and what looks wrong with them");
    command->footer(kFooter);
    const auto request = std::make_shared<CheckRequest>();
    addInputOptions(*command, request->input);
    command->add_option("--json", request->json, "Write the figures to this file too");
    command->add_flag("--quiet", request->quiet, "No progress bar and no table");
    addExamples(*command, "check scans/ --poses poses.txt", "check drive.bag --json drive.json");
    command->callback([request] { run(*request); });
}

}  // namespace akimap::app
