// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "StopSignal.h"
#include "input/FollowSource.h"
#include "input/InputRequest.h"
#include "input/RawlogSource.h"
#include "input/SimplemapSource.h"
#include "input/bags/BagSource.h"
#include "input/clouds/CloudSource.h"
#include "input/natural_order.h"
#include "support/similar.h"

namespace akimap::app {

namespace {

namespace fs = std::filesystem;
using Files = std::vector<std::string>;
using Sources = std::vector<std::unique_ptr<ScanSource>>;

std::string kindOf(const std::string& file) {
    fs::path path = file;
    // MRPT reads its own files packed or not, whatever their name; its data sets have both.
    if (path.extension() == ".gz" && path.stem().extension() != ".pcd") path = path.stem();
    return path.extension().string();
}

std::string join(const Files& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

/** What to do with a file that is none of ours. */
std::string adviceOn(const std::string& kind) {
    if (kind == ".las" || kind == ".laz")
        return "; pdal translate IN.las OUT.ply makes a cloud of it";
    if (kind == ".db3" || kind == ".mcap")
        return "; a ROS 2 bag is made a ROS 1 bag by rosbags-convert --src DIR --dst OUT.bag";
    if (kind == ".png") return "; depth images are taken by --depth FOLDER";
    if (kind == ".akimap") return "; a map is read by akimap info, query, export and eval";
    Files kinds = cloudExtensions();
    kinds.insert(kinds.end(), {".rawlog", ".simplemap", ".bag"});
    return didYouMean(kind, kinds);
}

Files cloudsIn(const std::string& folder) {
    Files clouds, texts;
    bool has_images = false;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string file = entry.path().string(), kind = cloudExtension(file);
        has_images |= entry.path().extension() == ".png";
        if (kind.empty() || fs::is_directory(entry.path())) continue;
        const bool is_text = kind == ".txt" || kind == ".csv" || kind == ".xyz";
        (is_text ? texts : clouds).push_back(file);  // texts beside clouds are their poses
    }
    Files& files = clouds.empty() ? texts : clouds;
    if (clouds.empty() && has_images)
        throw std::runtime_error(folder +
                                 ": images, not point clouds; depth images are taken by "
                                 "--depth FOLDER");
    if (files.empty())
        throw std::runtime_error(folder + ": this is a folder without point clouds (" +
                                 join(cloudExtensions()) + ")");
    for (const std::string& file : files)
        if (cloudExtension(file) != cloudExtension(files.front()))
            throw std::runtime_error(folder + ": point clouds of several kinds in it, " +
                                     cloudExtension(files.front()) + " and " +
                                     cloudExtension(file) + "; name the files instead");
    std::sort(files.begin(), files.end(), naturallyBefore);
    return files;
}

/** \exception std::runtime_error if the given poses serve for no scan of any log */
void requireCoverage(const std::string& file, const RobotPath& path, const Sources& sources) {
    bool has_log = false, has_uncovered = false;
    for (const auto& source : sources) {
        const auto uncovered = source->uncoveredCount();
        if (!uncovered) continue;
        if (source->scanCount() > 0) return;
        has_log = true;
        has_uncovered |= *uncovered > 0;
    }
    if (!has_log || !has_uncovered) return;
    const auto text = [](auto time) { return std::to_string(mrpt::Clock::toDouble(time)); };
    throw std::runtime_error(file + ": covers no scan of the inputs: it goes from " +
                             text(path.samples().front().time) + " to " +
                             text(path.samples().back().time) + " s");
}

InputOptions optionsOf(const InputRequest& request) {
    InputOptions options;
    options.max_gap = request.max_gap;
    options.only_label = request.only_label;
    options.partial = request.partial;
    if (request.allow_external) options.external_files = ExternalFiles::anywhere;
    options.poses = request.poses;
    options.times = request.times;
    options.deskew = !request.no_deskew;
    if (!request.extrinsic.empty())
        options.extrinsic = poseArgument("--extrinsic", request.extrinsic);
    if (!request.frame.empty())
        options.frame = request.frame == "map" ? CloudFrame::map : CloudFrame::sensor;
    return options;
}

bool isCloud(const std::string& file) {
    return !cloudExtension(file).empty();
}

/** Options that change nothing would pass unseen. */
void refuseIdleOptions(const InputRequest& request, const std::vector<Files>& groups) {
    bool has_clouds = false, has_logs = false, has_bags = false;
    for (const Files& group : groups) {
        has_clouds |= isCloud(group.front());
        has_bags |= kindOf(group.front()) == ".bag";
        has_logs |= kindOf(group.front()) == ".rawlog";
    }
    const bool has_frames = has_clouds || !request.depth.images.empty();
    const auto refuse = [](const std::string& option, const std::string& why) {
        throw std::runtime_error(option + " changes nothing here: " + why);
    };
    if (!request.poses.empty() && !has_frames && !has_logs && !has_bags)
        refuse("--poses", "a .simplemap has poses of its own");
    if (!request.extrinsic.empty() && !has_frames && !has_bags)
        refuse("--extrinsic", "the observations of a log say where their sensors are");
    if (!request.times.empty() && !has_frames)
        refuse("--times", "the observations of a log have times");
    if (!request.frame.empty() && !has_clouds) refuse("--frame", "no INPUT is a point cloud");
}

/** Files of points in the folders among the inputs in place of the folders, and all files of points
 * together, where the first of them stands. */
std::vector<Files> groupInputs(const InputRequest& request) {
    std::vector<Files> groups;
    Files clouds;
    std::size_t place = 0;
    for (const std::string& input : request.inputs) {
        const Files files = fs::is_directory(input) ? cloudsIn(input) : Files{input};
        if (!isCloud(files.front())) {
            groups.push_back(files);
            continue;
        }
        if (clouds.empty()) place = groups.size();
        clouds.insert(clouds.end(), files.begin(), files.end());
    }
    // A shell lists scan_10 before scan_2, which would get the other's pose.
    if (!request.poses.empty()) std::sort(clouds.begin(), clouds.end(), naturallyBefore);
    if (!clouds.empty()) groups.insert(groups.begin() + static_cast<std::ptrdiff_t>(place), clouds);
    return groups;
}

}  // namespace

Sources openSources(const InputRequest& request, std::function<void(const std::string&)> warn) {
    InputOptions options = optionsOf(request);
    options.warn = std::move(warn);
    const std::vector<Files> groups = groupInputs(request);
    refuseIdleOptions(request, groups);
    const bool has_log = std::any_of(groups.begin(), groups.end(), [](const Files& group) {
        return kindOf(group.front()) == ".rawlog" || kindOf(group.front()) == ".bag";
    });
    if (!request.poses.empty() && has_log)
        options.trajectory = std::make_shared<const RobotPath>(
            RobotPath::of(readPoses(request.poses), request.max_gap));
    Sources sources;
    for (std::size_t i = 0; i < groups.size(); i++) {
        const bool is_followed = request.follow && i + 1 == groups.size();
        const std::string& file = groups[i].front();
        if (is_followed)
            sources.push_back(followSource(file, options, {request.idle, StopSignal::requested}));
        else if (isCloud(file))
            sources.push_back(std::make_unique<CloudSource>(groups[i], options));
        else
            sources.push_back(openSource(file, options));
    }
    if (!request.depth.images.empty())
        sources.push_back(std::make_unique<DepthImages>(request.depth, options));
    if (options.trajectory && !request.follow)
        requireCoverage(request.poses, *options.trajectory, sources);
    return sources;
}

std::unique_ptr<ScanSource> openSource(const std::string& file, const InputOptions& options) {
    const std::string kind = kindOf(file);
    if (kind == ".rawlog") return std::make_unique<RawlogSource>(file, options);
    if (kind == ".simplemap") return std::make_unique<SimplemapSource>(file, options);
    if (kind == ".bag") return openBag(file, options);
    throw std::runtime_error(file + ": not a .rawlog, .simplemap, .bag or point cloud (" +
                             join(cloudExtensions()) + ")" + adviceOn(kind));
}

std::unique_ptr<ScanSource> followSource(const std::string& file, const InputOptions& options,
                                         const FollowOptions& follow) {
    if (kindOf(file) != ".rawlog")
        throw std::runtime_error(file + ": not a .rawlog, which is what --follow can follow");
    return std::make_unique<FollowSource>(file, options, follow);
}

}  // namespace akimap::app
