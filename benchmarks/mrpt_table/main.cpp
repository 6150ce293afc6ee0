// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// What each of MRPT's 3D maps, and AkiMap, answers when MRPT calls it: every virtual of CMetricMap,
// and MRPT's programs. Prints Markdown tables, or puts them into a document.

#include <akimap/AkiMap.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/system/os.h>
#include <stdlib.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "Row.h"
#include "guard.h"
#include "support/AtomicFile.h"

using namespace akimap;
using namespace akimap::bench;

namespace {

/** A folder for what is written, gone at the end. */
class Folder {
 public:
    Folder() {
        path_ = (std::filesystem::temp_directory_path() / "mrpt_table-XXXXXX").string();
        if (!mkdtemp(path_.data())) throw std::runtime_error("can't make " + path_);
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    [[nodiscard]] const std::string& path() const { return path_; }

 private:
    std::string path_;
};

void print(const Section& section, std::ostream& out) {
    out << "\n### " << section.title << "\n\n" << section.remark << "\n\n| |";
    for (const MapKind& kind : mapKinds()) out << " " << kind.name << " |";
    out << "\n|---|";
    for (std::size_t i = 0; i < mapKinds().size(); i++) out << "---|";
    out << "\n";
    for (const Row& row : section.rows) {
        out << "| " << row.call << " |";
        for (const MapKind& kind : mapKinds()) {
            const auto answer = [&] { return row.answer(kind); };
            out << " " << (section.guarded ? guarded(answer) : answer()) << " |";
        }
        out << "\n" << std::flush;
    }
}

std::string version() {
    const std::string all = mrpt::system::MRPT_getVersion();  // "MRPT 2.5.8"
    return all.substr(all.find_last_of(' ') + 1);
}

const Sample& room(const std::vector<Sample>& all) {
    const auto by_size = [](const Sample& a, const Sample& b) {
        return a.in_sensor.size() < b.in_sensor.size();
    };
    return *std::max_element(all.begin(), all.end(), by_size);
}

std::string table() {
    const Folder folder;
    std::ostringstream out;
    out << "## MRPT " << version() << "\n";
    const auto all = samples(folder.path());
    for (const Section& section : {insertionRows(all), likelihoodRows(all), matchingRows(room(all)),
                                   stateRows(folder.path()), settingsRows()})
        print(section, out);
    print(programRows(folder.path()), out);
    return out.str();
}

/** Replaces this MRPT's part of the document, from its heading to the next part's or the end. */
void writeInto(const std::string& file, const std::string& table) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error(file + ": no such file");
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string heading = table.substr(0, table.find('\n') + 1);
    const auto begin = text.find(heading);
    if (begin == std::string::npos) {
        text += "\n" + table;
    } else {
        const auto end = text.find("\n## ", begin + 1);
        text.replace(begin, end == std::string::npos ? end : end - begin, table);
    }
    writeWhole(file, text);
}

}  // namespace

int main(int argc, char** argv) try {
    registerClasses();
    const std::string option = argc > 1 ? argv[1] : "";
    if (argc == 1)
        std::fputs(table().c_str(), stdout);
    else if (argc == 3 && option == "--write")
        writeInto(argv[2], table());
    else
        throw std::runtime_error("usage: mrpt_table [--write doc/mrpt.md]");
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "mrpt_table: %s\n", e.what());
    return 1;
}
