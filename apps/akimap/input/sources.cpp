// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <filesystem>

#include "input/FollowSource.h"
#include "input/PcdReader.h"
#include "input/RawlogSource.h"
#include "input/ScanSource.h"
#include "input/SimplemapSource.h"

namespace akimap::app {

namespace {

/** A point cloud file: one scan, of no labelled sensor. */
class PcdSource : public ScanSource {
 public:
    explicit PcdSource(const std::string& file) : ScanSource(file) { checkPcd(file); }

    [[nodiscard]] std::size_t scanCount() const override { return 1; }
    void forEachScan(const TakeScan& take, SkippedScans&) override {
        Scan scan;
        scan.rays = readPcd(file());
        take(scan);
    }
};

std::string kindOf(const std::string& file) {
    std::filesystem::path path = file;
    // MRPT reads its own files packed or not, whatever their name; its data sets have both.
    if (path.extension() == ".gz" && path.stem().extension() != ".pcd") path = path.stem();
    return path.extension().string();
}

}  // namespace

std::unique_ptr<ScanSource> openSource(const std::string& file, const InputOptions& options) {
    const std::string kind = kindOf(file);
    if (kind == ".rawlog") return std::make_unique<RawlogSource>(file, options);
    if (kind == ".simplemap") return std::make_unique<SimplemapSource>(file, options);
    if (kind == ".pcd") return std::make_unique<PcdSource>(file);
    throw std::runtime_error(file + ": not a .rawlog, .simplemap or .pcd file");
}

std::unique_ptr<ScanSource> followSource(const std::string& file, const InputOptions& options,
                                         const FollowOptions& follow) {
    if (kindOf(file) != ".rawlog")
        throw std::runtime_error(file + ": not a .rawlog, which is what --follow can follow");
    return std::make_unique<FollowSource>(file, options, follow);
}

}  // namespace akimap::app
