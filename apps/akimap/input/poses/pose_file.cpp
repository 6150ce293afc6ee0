// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "input/poses/pose_file.h"

#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>

#include "input/files.h"
#include "input/numbers.h"
#include "input/poses/matrix.h"

namespace akimap::app {

namespace {

using mrpt::poses::CPose3D;

/** A line of numbers, but for a first word that may be a name. */
struct Row {
    std::size_t line = 0;
    std::string name;
    std::vector<double> v;
};

[[noreturn]] void refuse(const std::string& file, std::size_t line, const std::string& what) {
    throw std::runtime_error(file + ":" + std::to_string(line) + ": " + what);
}

Row parseRow(const std::string& file, std::size_t line,
             const std::vector<std::string_view>& words) {
    Row row;
    row.line = line;
    for (const auto word : words) {
        double value = 0;
        if (parseNumber(word, value) && std::isfinite(value))
            row.v.push_back(value);
        else if (row.v.empty() && row.name.empty() &&
                 std::isalpha(static_cast<unsigned char>(word.front())) &&
                 !parseNumber(word, value))
            row.name = std::string(word);
        else
            refuse(file, line, "'" + std::string(word) + "' is not a finite number");
    }
    return row;
}

std::vector<Row> readRows(const std::string& file) {
    requireReadable(file);
    std::ifstream in(file);
    std::vector<Row> rows;
    std::vector<std::string_view> words;
    std::string line;
    for (std::size_t number = 1; std::getline(in, line); number++) {
        splitWords(line, words);
        if (words.empty() || words.front().front() == '#') continue;
        // g2o's edges and parameters, which may hold anything
        if (words.front().substr(0, 5) == "EDGE_" || words.front() == "FIX" ||
            words.front().substr(0, 7) == "PARAMS_")
            continue;
        rows.push_back(parseRow(file, number, words));
    }
    if (in.bad()) throw std::runtime_error(file + ": can't read the poses");
    if (rows.empty()) throw std::runtime_error(file + ": it holds no poses");
    return rows;
}

/** Reads rows of one form. One for each: each takes a pose's rows from `i` on. */
class PoseRows {
 public:
    PoseRows(const std::string& file, const std::vector<Row>& rows) : rows_(rows) {
        list_.file = file;
    }

    PoseList read() {
        const Row& first = rows_.front();
        if (first.name.rfind("VERTEX_", 0) == 0) return readVertices();
        switch (first.v.size()) {
            case 8:
                return readTum();
            case 12:
                return readMatrices("KITTI poses", 0, 1, 12);
            case 16:
                return readMatrices("4 x 4 matrices", 0, 1, 16);
            case 4:
                return readMatrices("4 x 4 matrices", 0, 4, 4);
            case 3:
                return readMatrices("Open3D's log", 1, 4, 4);
            default:
                break;
        }
        refuse(list_.file, first.line,
               "expected 8 numbers (TUM: time x y z qx qy qz qw), 12 (KITTI) or 16, rows of 4, "
               "Open3D's log or g2o's vertices, and found " +
                   std::to_string(first.v.size()) + " numbers");
    }

 private:
    void check(const Row& row, std::size_t count, const char* what = "") const {
        if (!row.name.empty()) refuse(list_.file, row.line, "'" + row.name + "' is not a number");
        if (row.v.size() != count)
            refuse(list_.file, row.line,
                   "expected " + std::to_string(count) + " numbers" + what + ", and found " +
                       std::to_string(row.v.size()));
    }

    /** Calls make() with the line before what it throws. */
    template <class Make>
    CPose3D at(const Row& row, Make&& make) const {
        try {
            return make();
        } catch (const std::runtime_error& e) {
            refuse(list_.file, row.line, e.what());
        }
    }

    PoseList readTum() {
        list_.form = "TUM trajectory";
        for (const Row& row : rows_) {
            check(row, 8, ", time x y z qx qy qz qw");
            const auto& v = row.v;
            if (v[0] < 0 || v[0] > 1e11)
                refuse(list_.file, row.line, "'" + numberText(v[0]) + "' is not a time in seconds");
            list_.times.push_back(v[0]);
            list_.poses.push_back(at(row, [&] {
                return poseOfQuaternion({v[1], v[2], v[3]}, v[4], v[5], v[6], v[7]);
            }));
        }
        return list_;
    }

    /** \param head lines before each matrix \param lines of it, each of `width` numbers */
    PoseList readMatrices(const char* form, std::size_t head, std::size_t lines,
                          std::size_t width) {
        list_.form = form;
        for (std::size_t i = 0; i < rows_.size(); i += head + lines) {
            if (head) check(rows_[i], 3);
            std::vector<double> m;
            for (std::size_t k = head; k < head + lines; k++) {
                if (i + k >= rows_.size())
                    refuse(list_.file, rows_.back().line, "the last pose ends here, incomplete");
                check(rows_[i + k], width);
                m.insert(m.end(), rows_[i + k].v.begin(), rows_[i + k].v.end());
            }
            list_.poses.push_back(
                at(rows_[i + head], [&] { return poseOfMatrix(m.data(), m.size() / 4); }));
        }
        return list_;
    }

    PoseList readVertices() {
        list_.form = "g2o vertices";
        std::map<double, CPose3D> by_number;
        for (const Row& row : rows_) {
            const auto& v = row.v;
            const bool is_flat = row.name == "VERTEX_SE2";
            if (!is_flat && row.name != "VERTEX_SE3:QUAT") continue;  // a landmark
            if (v.size() != (is_flat ? 4u : 8u))
                refuse(list_.file, row.line, "not as g2o has " + row.name);
            const CPose3D pose = at(row, [&] {
                return is_flat ? CPose3D(v[1], v[2], 0, v[3], 0, 0)
                               : poseOfQuaternion({v[1], v[2], v[3]}, v[4], v[5], v[6], v[7]);
            });
            if (!by_number.emplace(v[0], pose).second)
                refuse(list_.file, row.line, "a second vertex " + numberText(v[0]));
        }
        for (const auto& [number, pose] : by_number) list_.poses.push_back(pose);
        return list_;
    }

    const std::vector<Row>& rows_;
    PoseList list_;
};

}  // namespace

PoseList readPoses(const std::string& file) {
    const std::vector<Row> rows = readRows(file);
    return PoseRows(file, rows).read();
}

}  // namespace akimap::app
