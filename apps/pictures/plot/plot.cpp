// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "pictures/plot/plot.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <deque>
#include <filesystem>
#include <stdexcept>

#include "pictures/plot/PanelPainter.h"
#include "support/AtomicFile.h"
#include "support/stream.h"

namespace akimap::app {

namespace {

Canvas::Format formatOf(const std::string& file) {
    std::string extension = std::filesystem::path(file).extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (extension == ".png") return Canvas::Format::png;
    if (extension == ".svg") return Canvas::Format::svg;
    throw std::runtime_error("cannot plot to '" + file + "': its extension must be .png or .svg");
}

void draw(const Figure& figure, Canvas& canvas) {
    constexpr double kGap = 20, kBelow = 50, kRight = 26;
    std::deque<PanelPainter> painters;
    double widest = 0, shares = 0, room = figure.height - (figure.title.empty() ? 0 : 26);
    for (const Panel& panel : figure.panels) {
        widest = std::max(widest, painters.emplace_back(canvas, panel).widestLabel());
        shares += panel.share;
        room -= kGap + (panel.x.label.empty() ? 0 : kBelow);
    }
    Canvas::TextStyle title{14};
    title.bold = true;
    title.anchor = .5;
    const double left = 22 + widest + 14, width = figure.width - left - kRight;
    canvas.text({left + width / 2, 28}, figure.title, title);
    double top = figure.title.empty() ? 0 : 26;
    for (std::size_t i = 0; i < painters.size(); i++) {
        const Panel& panel = figure.panels[i];
        const double height = room * panel.share / shares;
        painters[i].draw({left, top + kGap, width, height});
        top += kGap + height + (panel.x.label.empty() ? 0 : kBelow);
    }
}

std::string escaped(const std::string& text) {
    std::string xml;
    for (const char c : displayable(text)) switch (c) {
            case '&':
                xml += "&amp;";
                break;
            case '<':
                xml += "&lt;";
                break;
            case '>':
                xml += "&gt;";
                break;
            default:
                xml += c;
        }
    return xml;
}

/** Cairo turns text into outlines: a reader that sees none gets the words so. */
std::string described(std::string svg, const Figure& figure) {
    std::string words;
    for (const Panel& panel : figure.panels) {
        words += panel.y.label + " against " + panel.x.label + "\n";
        for (const Curve& c : panel.curves) words += c.name + "\n";
        for (const Bars& b : panel.bars) words += b.name + "\n";
    }
    std::string description = "\n<title>" + escaped(figure.title) + "</title>\n<desc>";
    for (std::size_t begin = 0, end; (end = words.find('\n', begin)) != std::string::npos;
         begin = end + 1)
        description += escaped(words.substr(begin, end - begin)) + "\n";
    svg.insert(svg.find('>', svg.find("<svg")) + 1, description + "</desc>");
    return svg;
}

}  // namespace

void checkPlottable(const std::string& file) {
    (void)formatOf(file);
    AtomicFile::checkWritable(file);
}

void writeFigure(const Figure& figure, const std::string& file) {
    const Canvas::Format format = formatOf(file);
    AtomicFile output(file);
    try {
        Canvas canvas(format, figure.width, figure.height);
        draw(figure, canvas);
        std::string bytes = canvas.finish();
        if (format == Canvas::Format::svg) bytes = described(std::move(bytes), figure);
        std::ofstream out = openForWriting(output.path());
        out << bytes;
        closeWritten(out);
    } catch (const std::exception& e) {
        throw std::runtime_error("cannot plot to '" + file + "': " + e.what());
    }
    output.commit();
}

Bars histogram(std::string name, const std::vector<double>& values, std::size_t bins) {
    Bars bars;
    bars.name = std::move(name);
    double low = INFINITY, high = -INFINITY;
    for (const double v : values)
        if (std::isfinite(v)) {
            low = std::min(low, v);
            high = std::max(high, v);
        }
    if (!(low <= high) || bins == 0) return bars;
    if (low == high) high = low + (low == 0 ? 1 : std::abs(low) / 10);
    const double width = (high - low) / static_cast<double>(bins);
    bars.heights.assign(bins, 0);
    for (std::size_t i = 0; i <= bins; i++)
        bars.edges.push_back(low + width * static_cast<double>(i));
    for (const double v : values)
        if (std::isfinite(v))
            bars.heights[std::min(bins - 1, static_cast<std::size_t>((v - low) / width))]++;
    return bars;
}

}  // namespace akimap::app
