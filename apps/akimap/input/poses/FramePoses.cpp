// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/poses/FramePoses.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

#include "input/files.h"
#include "input/natural_order.h"
#include "input/numbers.h"
#include "input/poses/pose_file.h"

namespace akimap::app {

namespace {

using Files = std::vector<std::string>;
using Times = std::vector<mrpt::Clock::time_point>;

std::string counted(std::size_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/** The times [s] at the beginnings of a file's lines, one for each of the frames. */
std::vector<double> readTimes(const std::string& file, std::size_t frames) {
    requireReadable(file);
    std::ifstream in(file);
    std::vector<double> times;
    std::vector<std::string_view> words;
    std::string line;
    for (std::size_t number = 1; std::getline(in, line); number++) {
        splitWords(line, words);
        if (words.empty() || words.front().front() == '#') continue;
        double time = 0;
        if (!parseNumber(words.front(), time) || !(time >= 0 && time < 1e11))
            throw std::runtime_error(file + ":" + std::to_string(number) + ": '" +
                                     std::string(words.front()) + "' is not a time in seconds");
        times.push_back(time);
    }
    if (times.size() != frames)
        throw std::runtime_error(file + ": " + counted(times.size(), "time") + " for " +
                                 counted(frames, "scan"));
    return times;
}

/** The times [s] that the files' names are; empty unless all are of the epoch, or have a fraction.
 * Whole numbers of 13, 16 and 19 digits are milli-, micro- and nanoseconds. */
std::vector<double> timesInNames(const Files& files) {
    std::vector<double> times;
    for (const std::string& file : files) {
        const std::string digits = lastNumber(frameName(file));
        double time = 0;
        if (digits.empty() || !parseNumber(std::string_view(digits), time)) return {};
        const bool has_point = digits.find('.') != std::string::npos;
        if (!has_point && digits.size() < 10) return {};
        if (!has_point && digits.size() >= 19)
            time *= 1e-9;
        else if (!has_point && digits.size() >= 16)
            time *= 1e-6;
        else if (!has_point && digits.size() >= 13)
            time *= 1e-3;
        times.push_back(time);
    }
    return times;
}

/** The numbers in the files' names, if each is the time of a pose; else none. */
std::vector<double> numbersThatAreTimes(const Files& files, const PoseList& list) {
    std::vector<double> sorted = list.times, numbers;
    std::sort(sorted.begin(), sorted.end());
    for (const std::string& file : files) {
        double number = 0;
        const std::string digits = lastNumber(frameName(file));
        if (!parseNumber(std::string_view(digits), number)) return {};
        const auto at = std::lower_bound(sorted.begin(), sorted.end(), number - 1e-3);
        if (at == sorted.end() || *at > number + 1e-3) return {};
        numbers.push_back(number);
    }
    return numbers;
}

Times toClock(const std::vector<double>& seconds) {
    Times times;
    for (const double s : seconds) times.push_back(mrpt::Clock::fromDouble(s));
    return times;
}

void placeByTime(FramePoses& frames, const std::string& file) {
    for (const auto time : frames.times) frames.poses.push_back(frames.path->at(time));
    const auto is_there = [](const auto& pose) { return pose.has_value(); };
    if (std::any_of(frames.poses.begin(), frames.poses.end(), is_there)) return;
    const auto text = [](auto time) { return numberText(mrpt::Clock::toDouble(time)); };
    const auto [first, last] = std::minmax_element(frames.times.begin(), frames.times.end());
    throw std::runtime_error(file + ": covers no scan of the inputs: it goes from " +
                             text(frames.path->samples().front().time) + " to " +
                             text(frames.path->samples().back().time) + " s, and the scans from " +
                             text(*first) + " to " + text(*last) + " s (" + frames.how + ")");
}

void placeInOrder(FramePoses& frames, const PoseList& list, const Files& files) {
    if (list.poses.size() != files.size())
        throw std::runtime_error(
            list.file + ": " + counted(list.poses.size(), "pose") + " (" + list.form + ") for " +
            counted(files.size(), "scan") +
            (list.times.empty() ? "; poses without times are taken in the files' order, one each"
                                : ", whose names are no times; --times FILE says when each was "
                                  "taken"));
    frames.poses.assign(list.poses.begin(), list.poses.end());
    frames.how = "in the order of the files";
}

void placeFromFile(FramePoses& frames, const PoseList& list, const Files& files, double max_gap) {
    if (list.times.empty()) return placeInOrder(frames, list, files);
    frames.path = std::make_shared<const RobotPath>(RobotPath::of(list, max_gap));
    if (frames.times.empty()) {
        frames.times = toClock(numbersThatAreTimes(files, list));
        frames.how = "at the times that the files' numbers are";
    }
    if (!frames.times.empty()) return placeByTime(frames, list.file);
    placeInOrder(frames, list, files);
    frames.times = toClock(list.times);
}

/** The files of a folder by the name of their frame. */
std::map<std::string, std::string> poseFilesIn(const std::string& folder, bool by_number) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string file = entry.path().string(), extension = entry.path().extension();
        if (extension != ".txt" && extension != ".pose") continue;
        const std::string frame = frameName(file), number = lastNumber(frame);
        if (by_number && number.empty()) continue;
        const std::string key = by_number ? std::to_string(std::atof(number.c_str())) : frame;
        files.emplace(key, file);
    }
    return files;
}

void placeFromFolder(FramePoses& frames, const std::string& folder, const Files& files) {
    const auto by_name = poseFilesIn(folder, false), by_number = poseFilesIn(folder, true);
    for (const std::string& file : files) {
        const std::string frame = frameName(file);
        auto found = by_name.find(frame);
        if (found == by_name.end()) {
            found = by_number.find(std::to_string(std::atof(lastNumber(frame).c_str())));
            if (found == by_number.end())
                throw std::runtime_error(folder + ": no pose for " + file + ": neither a file " +
                                         frame + ".txt nor one of the same number");
        }
        const PoseList list = readPoses(found->second);
        if (list.poses.size() != 1)
            throw std::runtime_error(found->second + ": " + counted(list.poses.size(), "pose") +
                                     " for one scan, " + file);
        frames.poses.emplace_back(list.poses.front());
    }
    frames.how = "by the names of the files";
}

}  // namespace

FramePoses matchPoses(const Files& files, const std::string& poses, const std::string& times_file,
                      double max_gap) {
    FramePoses frames;
    if (!times_file.empty()) {
        frames.times = toClock(readTimes(times_file, files.size()));
        frames.how = "at the times in " + times_file;
    } else {
        frames.times = toClock(timesInNames(files));
        frames.how = "at the times in the files' names";
    }
    if (poses.empty())
        frames.poses.resize(files.size());
    else if (std::filesystem::is_directory(poses))
        placeFromFolder(frames, poses, files);
    else
        placeFromFile(frames, readPoses(poses), files, max_gap);
    return frames;
}

}  // namespace akimap::app
