// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "pictures/plot/PanelPainter.h"

#include <algorithm>
#include <cmath>

#include "pictures/plot/style.h"

namespace akimap::app {

namespace {

std::vector<double> dataOfX(const Panel& panel) {
    std::vector<double> data;
    for (const Curve& c : panel.curves) data.insert(data.end(), c.x.begin(), c.x.end());
    for (const Bars& b : panel.bars) data.insert(data.end(), b.edges.begin(), b.edges.end());
    return data;
}

std::vector<double> dataOfY(const Panel& panel) {
    std::vector<double> data;
    for (const Curve& c : panel.curves) data.insert(data.end(), c.y.begin(), c.y.end());
    for (const Bars& b : panel.bars) {
        data.insert(data.end(), b.heights.begin(), b.heights.end());
        data.push_back(0);  // where bars stand
    }
    return data;
}

}  // namespace

PanelPainter::PanelPainter(Canvas& canvas, const Panel& panel)
    : canvas_(canvas), panel_(panel), x_(panel.x, dataOfX(panel)), y_(panel.y, dataOfY(panel)) {}

double PanelPainter::widestLabel() const {
    double widest = 0;
    for (const Scale::Tick& tick : y_.ticks())
        widest = std::max(widest, canvas_.textWidth(tick.label, kSmall));
    return widest;
}

void PanelPainter::draw(const Rect& area) {
    area_ = area;
    drawAxes();
    canvas_.clip({area.left - 5, area.top - 5, area.width + 10, area.height + 10});
    for (std::size_t i = 0; i < panel_.bars.size(); i++)
        for (const Rect& bar : rectangles(i)) canvas_.fill(bar, lineColor(panel_.bars[i].color));
    if (panel_.diagonal) {
        const double low = std::max(x_.min(), y_.min()), high = std::min(x_.max(), y_.max());
        canvas_.line({at(low, low), at(high, high)}, {kPale, 1.2, {3, 3}});
    }
    for (const Curve& curve : panel_.curves) drawCurve(curve);
    canvas_.unclip();
    drawLabels();
    drawLegend();
}

Canvas::Point PanelPainter::at(double x, double y) const {
    const double far = 10;  // of the panel's size; Cairo's numbers are bounded
    return {area_.left + area_.width * std::clamp(x_.place(x), -far, far),
            area_.bottom() - area_.height * std::clamp(y_.place(y), -far, far)};
}

std::vector<Canvas::Point> PanelPainter::points(const Curve& curve) const {
    const auto drawable = [](double v, const Axis& axis) {
        return std::isfinite(v) && (v > 0 || !axis.logarithmic);
    };
    std::vector<Canvas::Point> points;
    for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); i++)
        if (drawable(curve.x[i], panel_.x) && drawable(curve.y[i], panel_.y))
            points.push_back(at(curve.x[i], curve.y[i]));
    return points;
}

std::vector<Rect> PanelPainter::rectangles(std::size_t which) const {
    const Bars& bars = panel_.bars[which];
    const auto n = static_cast<double>(panel_.bars.size()), k = static_cast<double>(which);
    std::vector<Rect> rectangles;
    for (std::size_t i = 0; i < bars.heights.size() && i + 1 < bars.edges.size(); i++) {
        if (!(bars.heights[i] > 0)) continue;
        const double left = at(bars.edges[i], 0).x, right = at(bars.edges[i + 1], 0).x;
        const double gap = (right - left) * (n > 1 ? .16 : .06), width = (right - left - gap) / n;
        const double top = at(0, bars.heights[i]).y;
        rectangles.push_back(
            {left + gap / 2 + k * width, top, width, std::max(0., area_.bottom() - top)});
    }
    return rectangles;
}

void PanelPainter::drawAxes() {
    for (const Scale::Tick& tick : x_.ticks()) {
        const double x = at(tick.value, 0).x;
        canvas_.line({{x, area_.top}, {x, area_.bottom()}}, {kGrid});
    }
    for (const Scale::Tick& tick : y_.ticks()) {
        const double y = at(0, tick.value).y;
        canvas_.line({{area_.left, y}, {area_.right(), y}}, {kGrid});
    }
    canvas_.line(
        {{area_.left, area_.top}, {area_.left, area_.bottom()}, {area_.right(), area_.bottom()}},
        {kInk, 1.2});
}

void PanelPainter::drawLabels() {
    Canvas::TextStyle centred = kSmall, right = kSmall, label = kNormal;
    centred.anchor = label.anchor = .5;
    right.anchor = 1;
    for (const Scale::Tick& tick : x_.ticks()) {
        const double x = at(tick.value, 0).x;
        canvas_.line({{x, area_.bottom()}, {x, area_.bottom() + 4}}, {kInk, 1.2});
        if (!panel_.x.label.empty()) canvas_.text({x, area_.bottom() + 18}, tick.label, centred);
    }
    for (const Scale::Tick& tick : y_.ticks()) {
        const double y = at(0, tick.value).y;
        canvas_.line({{area_.left - 4, y}, {area_.left, y}}, {kInk, 1.2});
        canvas_.text({area_.left - 8, y + 4}, tick.label, right);
    }
    canvas_.text({area_.left + area_.width / 2, area_.bottom() + 38}, panel_.x.label, label);
    label.upwards = true;
    canvas_.text({16, area_.top + area_.height / 2}, panel_.y.label, label);
}

void PanelPainter::drawCurve(const Curve& curve) {
    const Color color = lineColor(curve.color);
    const auto shown = points(curve);
    canvas_.line(shown, lineStroke(color, curve.dashed));
    if (curve.markers)
        for (const Canvas::Point& p : shown) canvas_.dot(p, 3.6, color);
}

}  // namespace akimap::app
