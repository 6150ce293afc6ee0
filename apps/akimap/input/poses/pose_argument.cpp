// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "input/files.h"
#include "input/numbers.h"
#include "input/poses/matrix.h"
#include "input/poses/pose_file.h"

namespace akimap::app {

namespace {

using mrpt::poses::CPose3D;

/** The text of a file; of KITTI's calib.txt, what stands behind "Tr:". */
std::string poseTextOf(const std::string& file) {
    requireReadable(file);
    std::ifstream in(file);
    std::string all;
    for (std::string line; std::getline(in, line);) {
        for (const char* name : {"Tr:", "Tr_velo_to_cam:", "Tr_velo_cam:"})
            if (line.rfind(name, 0) == 0) return line.substr(std::string(name).size());
        if (line.empty() || line[0] != '#') all += line + " ";
    }
    return all;
}

CPose3D poseOfNumbers(const std::vector<double>& v) {
    constexpr double kDegree = M_PI / 180;
    if (v.size() == 6)
        return CPose3D(v[0], v[1], v[2], v[3] * kDegree, v[4] * kDegree, v[5] * kDegree);
    if (v.size() == 12 || v.size() == 16) return poseOfMatrix(v.data(), v.size() / 4);
    throw std::runtime_error(
        "expected x,y,z,yaw,pitch,roll [m, degrees], or 12 or 16 numbers of a matrix, and found " +
        std::to_string(v.size()));
}

}  // namespace

CPose3D poseArgument(const std::string& option, const std::string& text) {
    std::error_code ignored;
    const bool is_file = std::filesystem::is_regular_file(text, ignored);
    const bool looks_like_file = text.find_first_not_of("0123456789+-.eE, ") != std::string::npos;
    try {
        return poseOfNumbers(finiteNumbersOf(is_file || looks_like_file ? poseTextOf(text) : text));
    } catch (const std::runtime_error& e) {
        const std::string what = e.what();
        const bool is_named = is_file && what.find(text) == 0;
        throw std::runtime_error(option + ": " + (is_file && !is_named ? text + ": " : "") + what);
    }
}

}  // namespace akimap::app
