// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace akimap::app {

/** A line through the points (x[i], y[i]); points that are not finite are left out. */
struct Curve {
    std::string name;  ///< in the legend; empty: not there
    std::vector<double> x, y;
    std::size_t color = 0;  ///< one of eight, which colour-blind readers can tell apart
    bool dashed = false;
    bool markers = false;  ///< a dot at each point
};

/** Bar i stands from edges[i] to edges[i + 1] and is heights[i] high. Where a panel has several
 * Bars they share the room side by side. */
struct Bars {
    std::string name;           ///< in the legend; empty: not there
    std::vector<double> edges;  ///< ascending, one more than heights
    std::vector<double> heights;
    std::size_t color = 0;
};

struct Axis {
    std::string label;               ///< with its unit
    std::optional<double> min, max;  ///< by default, round numbers about the data
    bool logarithmic = false;        ///< leaves out what is not positive
};

/** One set of axes. The legend goes to the corner with the least in it. */
struct Panel {
    Axis x, y;
    std::vector<Curve> curves;
    std::vector<Bars> bars;
    bool diagonal = false;  ///< a pale dashed line along y = x
    double share = 1;       ///< of the figure's height, relative to the other panels
};

/** Panels one above the other. */
struct Figure {
    std::string title;
    std::vector<Panel> panels;
    double width = 640, height = 480;  ///< [points]; a PNG has two pixels to a point
};

/** For asking before long work.
 * \exception std::runtime_error unless the file's name ends in .png or .svg and it can be written
 */
void checkPlottable(const std::string& file);

/** Writes a PNG or an SVG by the file's extension; the file appears whole or not at all. Needs no
 * display. An SVG's text is drawn as outlines; its <title> and <desc> hold the words.
 * \exception std::runtime_error naming the file */
void writeFigure(const Figure& figure, const std::string& file);

/** How many of the values lie in each of `bins` equal bins from the lowest to the highest; what is
 * not finite is left out. Without values there are no bars. */
[[nodiscard]] Bars histogram(std::string name, const std::vector<double>& values, std::size_t bins);

}  // namespace akimap::app
