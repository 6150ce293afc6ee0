// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/truth.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "evaluation/octomap_file.h"

namespace akimap::app {

namespace {

/** Reads the nodes of a .bt: two bytes for each inner node, two bits for each of its children
 * (00 unknown, 01 free, 10 occupied, 11 inner), then the inner children, depth first. */
class NodeReader {
 public:
    NodeReader(std::istream& in, std::vector<Truth::Leaf>& leaves) : in_(in), leaves_(leaves) {}

    /** \return whether the data was whole and in order */
    bool readInner(const std::array<int32_t, 3>& first, int32_t size) {
        unsigned char bytes[2];
        if (size < 2 || !in_.read(reinterpret_cast<char*>(bytes), 2)) return false;
        nodes_++;
        const unsigned children = bytes[0] | bytes[1] << 8;
        const int32_t half = size / 2;
        for (int i = 0; i < 8; i++)
            if (const unsigned kind = children >> 2 * i & 3; kind == 1 || kind == 2) {
                leaves_.push_back({corner(first, half, i), half, kind == 2});
                nodes_++;
            }
        for (int i = 0; i < 8; i++)
            if ((children >> 2 * i & 3) == 3 && !readInner(corner(first, half, i), half))
                return false;
        return true;
    }
    [[nodiscard]] uint64_t nodes() const { return nodes_; }

 private:
    static std::array<int32_t, 3> corner(const std::array<int32_t, 3>& first, int32_t half, int i) {
        return {first[0] + half * (i & 1), first[1] + half * (i >> 1 & 1),
                first[2] + half * (i >> 2)};
    }

    std::istream& in_;
    std::vector<Truth::Leaf>& leaves_;
    uint64_t nodes_ = 0;
};

}  // namespace

Box parseBox(const std::string& text) {
    std::vector<double> numbers;
    std::istringstream in(text);
    for (std::string word; std::getline(in, word, ',');) {
        std::istringstream value(word);
        double number = 0;
        if (!(value >> number) || !(value >> std::ws).eof() || !std::isfinite(number)) break;
        numbers.push_back(number);
    }
    const auto commas = std::count(text.begin(), text.end(), ',');
    if (numbers.size() != 6 || commas != 5)
        throw std::runtime_error("--box '" + text +
                                 "' is not six finite numbers x0,y0,z0,x1,y1,z1");
    Box box;
    for (std::size_t i = 0; i < 3; i++) {
        box.min[i] = numbers[i];
        box.max[i] = numbers[i + 3];
        if (!(box.min[i] < box.max[i]))
            throw std::runtime_error("--box '" + text +
                                     "' is empty: each of x0,y0,z0 must be below x1,y1,z1");
    }
    return box;
}

Truth::Range Truth::inside(const Leaf& leaf, const Box& box, std::size_t axis) const {
    const double first = leaf.first[axis], end = first + leaf.size;
    const auto clamp = [&](double v) { return static_cast<int32_t>(std::clamp(v, first, end)); };
    Range range{clamp(std::ceil(box.min[axis] / resolution - 0.5)),
                clamp(std::floor(box.max[axis] / resolution - 0.5) + 1)};
    range.end = std::max(range.begin, range.end);
    return range;
}

double Truth::countCells(const Box& box) const {
    double count = 0;
    for (const Leaf& leaf : leaves) {
        double cells = 1;
        for (std::size_t axis = 0; axis < 3; axis++) {
            const Range range = inside(leaf, box, axis);
            cells *= range.end - range.begin;
        }
        count += cells;
    }
    return count;
}

Truth readTruth(const std::string& file, const std::string& what) {
    const std::string named = what + " '" + file + "'";
    std::ifstream in(file, std::ios::binary);
    if (!in || in.peek() == std::ifstream::traits_type::eof())
        throw std::runtime_error("cannot read " + named + ": missing, empty or not a file");
    const OctoMapHeader header = readOctoMapHeader(in, "# Octomap OcTree binary file");
    if (header.id != "OcTree")
        throw std::runtime_error(named + " is not an OctoMap binary tree (.bt)");
    if (!std::isfinite(header.resolution) || header.resolution <= 0)
        throw std::runtime_error(named + " has no valid resolution");

    Truth truth;
    truth.resolution = header.resolution;
    NodeReader reader(in, truth.leaves);
    if (header.size > 0 &&
        (!reader.readInner({-kOctoMapHalf, -kOctoMapHalf, -kOctoMapHalf}, 2 * kOctoMapHalf) ||
         reader.nodes() != header.size))
        throw std::runtime_error(named + " is damaged or cut short");
    return truth;
}

Truth truthOf(const octomap::OcTree& tree) {
    Truth truth;
    truth.resolution = tree.getResolution();
    truth.leaves.reserve(tree.getNumLeafNodes());
    for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
        const octomap::OcTreeKey first = leaf.getIndexKey();
        truth.leaves.push_back(
            {{first[0] - kOctoMapHalf, first[1] - kOctoMapHalf, first[2] - kOctoMapHalf},
             1 << (kOctoMapDepth - leaf.getDepth()),
             tree.isNodeOccupied(*leaf)});
    }
    return truth;
}

}  // namespace akimap::app
