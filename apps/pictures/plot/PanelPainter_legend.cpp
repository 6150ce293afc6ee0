// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <algorithm>
#include <cmath>

#include "pictures/plot/PanelPainter.h"
#include "pictures/plot/style.h"

namespace akimap::app {

namespace {

constexpr double kLegendRow = 19, kLegendSample = 26, kLegendMargin = 9;

/** Leaves out what does not fit at the front: names end in what tells them apart. */
std::string fitted(std::string words, double width, Canvas& canvas) {
    if (canvas.textWidth(words, kSmall) <= width) return words;
    const auto continues = [&] { return (static_cast<unsigned char>(words[0]) & 0xC0) == 0x80; };
    do {
        words.erase(0, 1);
        while (!words.empty() && continues()) words.erase(0, 1);
    } while (!words.empty() && canvas.textWidth("…" + words, kSmall) > width);
    return "…" + words;
}

}  // namespace

std::vector<PanelPainter::LegendEntry> PanelPainter::legend() const {
    std::vector<LegendEntry> entries;
    for (const Curve& c : panel_.curves)
        if (!c.name.empty())
            entries.push_back({c.name, lineColor(c.color), false, c.dashed, c.markers});
    for (const Bars& b : panel_.bars)
        if (!b.name.empty()) entries.push_back({b.name, lineColor(b.color), true, false, false});
    return entries;
}

double PanelPainter::inside(const Rect& box) const {
    double sum = 0;
    for (const Curve& curve : panel_.curves) {
        const auto line = points(curve);
        for (std::size_t i = 1; i < line.size(); i++) {
            const double dx = line[i].x - line[i - 1].x, dy = line[i].y - line[i - 1].y;
            const double steps = std::ceil(std::hypot(dx, dy) / 2), length = std::hypot(dx, dy);
            for (double t = 0; t < steps; t++) {
                const double x = line[i - 1].x + dx * t / steps;
                const double y = line[i - 1].y + dy * t / steps;
                if (x >= box.left && x <= box.right() && y >= box.top && y <= box.bottom())
                    sum += length / steps;
            }
        }
    }
    for (std::size_t k = 0; k < panel_.bars.size(); k++)
        for (const Rect& bar : rectangles(k)) {
            const double w = std::min(bar.right(), box.right()) - std::max(bar.left, box.left);
            const double h = std::min(bar.bottom(), box.bottom()) - std::max(bar.top, box.top);
            if (w > 0 && h > 0) sum += w * h;
        }
    return sum;
}

Rect PanelPainter::quietestCorner(double width, double height) const {
    constexpr double kOff = 8;
    const double left = area_.left + kOff, right = area_.right() - kOff - width;
    const double top = area_.top + kOff, bottom = area_.bottom() - kOff - height;
    const Rect corners[] = {{right, bottom, width, height},
                            {right, top, width, height},
                            {left, top, width, height},
                            {left, bottom, width, height}};
    return *std::min_element(std::begin(corners), std::end(corners),
                             [&](const Rect& a, const Rect& b) { return inside(a) < inside(b); });
}

void PanelPainter::drawLegend() {
    auto entries = legend();
    if (entries.empty()) return;
    constexpr double kBesideName = kLegendSample + 2 * kLegendMargin + 7;
    double widest = 0;
    for (LegendEntry& e : entries) {
        e.name = fitted(e.name, .9 * area_.width - kBesideName, canvas_);
        widest = std::max(widest, canvas_.textWidth(e.name, kSmall));
    }
    const Rect box =
        quietestCorner(widest + kBesideName, kLegendRow * static_cast<double>(entries.size()) + 8);
    canvas_.fill(box, {1, 1, 1}, .88);
    canvas_.frame(box, {kGrid});
    double y = box.top + 4 + kLegendRow / 2;
    for (const LegendEntry& e : entries) {
        const double x = box.left + kLegendMargin, end = x + kLegendSample;
        if (e.bar)
            canvas_.fill({x + 6, y - 6, kLegendSample - 12, 12}, e.color);
        else
            canvas_.line({{x, y}, {end, y}}, lineStroke(e.color, e.dashed));
        if (e.marker) canvas_.dot({x + kLegendSample / 2, y}, 3.6, e.color);
        canvas_.text({end + 7, y + 4}, e.name, kSmall);
        y += kLegendRow;
    }
}

}  // namespace akimap::app
