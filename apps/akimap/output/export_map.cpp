// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "output/export_map.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <new>
#include <stdexcept>

#include "output/formats.h"
#include "support/AtomicFile.h"

namespace akimap::app {

namespace {

using Writer = std::function<void(const AkiMap&, const std::string& path, const ExportOptions&)>;

struct Format {
    const char* extension;  // lower case
    Writer write;
    bool draws_unknown;
};

const Format& formatOf(const std::string& file) {
    static const Format kFormats[] = {
        {".csv", [](auto& map, auto& path, auto&) { writeCsv(map, path); }, false},
        {".ply", writePly, false},
        {".pcd", writePcd, false},
        {".bt", writeBt, false},
        {".ot", [](auto& map, auto& path, auto&) { writeOt(map, path); }, false},
        {".3dscene", writeScene, true},
        {".png", writePng, true}};
    std::string extension = std::filesystem::path(file).extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const Format& format : kFormats)
        if (extension == format.extension) return format;
    throw std::runtime_error(
        "cannot export to '" + file +
        "': its extension must be .csv, .ply, .pcd, .bt, .ot, .3Dscene or .png");
}

}  // namespace

void exportMap(const AkiMap& map, const std::string& file, const ExportOptions& options) {
    const Format& format = formatOf(file);
    AtomicFile output(file);
    try {
        format.write(map, output.path(), options);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        throw std::runtime_error("cannot export to '" + file + "': " + e.what());
    }
    output.commit();
}

bool drawsUnknown(const std::string& file) {
    return formatOf(file).draws_unknown;
}

void checkExportable(const std::string& file) {
    (void)formatOf(file);
    AtomicFile::checkWritable(file);
}

}  // namespace akimap::app
