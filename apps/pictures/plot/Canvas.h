// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <cairo.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "pictures/colors.h"

namespace akimap::app {

/** A rectangle of the picture [points], y downwards. */
struct Rect {
    double left, top, width, height;
    [[nodiscard]] double right() const { return left + width; }
    [[nodiscard]] double bottom() const { return top + height; }
};

/** A white sheet of Cairo's, for a PNG or an SVG: what is drawn is the same. */
class Canvas {
 public:
    enum class Format { png, svg };
    struct Point {
        double x, y;
    };
    struct Stroke {
        Color color;
        double width = 1;
        std::vector<double> dashes = {};
    };
    struct TextStyle {
        double size = 12;
        Color color{.13f, .13f, .13f};
        double anchor = 0;  ///< 0: the text starts at the place, 0.5: is centred there, 1: ends
        bool bold = false, upwards = false;
    };

    /** \param width, height [points] */
    Canvas(Format format, double width, double height);
    ~Canvas();
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    void line(const std::vector<Point>& points, const Stroke& stroke);
    void fill(const Rect& rect, const Color& color, double opacity = 1);
    void frame(const Rect& rect, const Stroke& stroke);
    void dot(Point center, double radius, const Color& color);
    /** `at` is on the text's baseline. */
    void text(Point at, const std::string& words, const TextStyle& style);
    [[nodiscard]] double textWidth(const std::string& words, const TextStyle& style);
    /** Draws only inside, until unclip(). */
    void clip(const Rect& rect);
    void unclip();

    /** The file's bytes; nothing can be drawn any more.
     * \exception std::runtime_error with Cairo's reason */
    [[nodiscard]] std::string finish();

 private:
    void select(const TextStyle& style);
    void stroke(const Stroke& stroke);

    Format format_;
    std::string bytes_;
    cairo_surface_t* surface_;
    cairo_t* cairo_;
};

/** Fit to be drawn and for XML: bytes that are no UTF-8 and control characters are replaced. */
[[nodiscard]] std::string displayable(const std::string& text);

}  // namespace akimap::app
