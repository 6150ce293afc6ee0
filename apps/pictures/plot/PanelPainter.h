// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <string>
#include <vector>

#include "pictures/plot/Canvas.h"
#include "pictures/plot/Scale.h"
#include "pictures/plot/plot.h"

namespace akimap::app {

/** Draws one panel of a figure. */
class PanelPainter {
 public:
    PanelPainter(Canvas& canvas, const Panel& panel);

    [[nodiscard]] double widestLabel() const;  ///< of the ticks of y [points]
    /** \param area between the axes, without the labels */
    void draw(const Rect& area);

 private:
    struct LegendEntry {
        std::string name;
        Color color;
        bool bar, dashed, marker;
    };
    [[nodiscard]] Canvas::Point at(double x, double y) const;
    [[nodiscard]] std::vector<Canvas::Point> points(const Curve& curve) const;
    [[nodiscard]] std::vector<Rect> rectangles(std::size_t bars) const;
    void drawAxes();
    void drawLabels();
    void drawCurve(const Curve& curve);
    [[nodiscard]] std::vector<LegendEntry> legend() const;
    [[nodiscard]] double inside(const Rect& box) const;
    [[nodiscard]] Rect quietestCorner(double width, double height) const;
    void drawLegend();

    Canvas& canvas_;
    const Panel& panel_;
    Scale x_, y_;
    Rect area_{};
};

}  // namespace akimap::app
