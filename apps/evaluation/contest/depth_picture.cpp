// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/contest/depth_picture.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "evaluation/contest/ScanProjection.h"
#include "evaluation/contest/beam.h"
#include "pictures/plot/Canvas.h"
#include "support/AtomicFile.h"

namespace akimap::app {

namespace {

constexpr double kMargin = 24, kGap = 18, kHeader = 64, kCaption = 36;  // [points]
constexpr double kPanelWidth = 300, kPanoramaWidth = 480;
constexpr double kWide = 1.8;      // a panel of this aspect or more is given more room
constexpr double kFlattest = 3.2;  // panoramas are stretched to this aspect
constexpr double kOverlap = 1.3;   // of the squares that stand for rays, so that no gap is left
constexpr Color kGround{.95f, .95f, .95f}, kPaleInk{.40f, .40f, .40f};

struct Kind {
    RayEnd end;
    Color color;
    const char* label;
};
const Kind kKinds[] = {{RayEnd::near1, {.86f, .86f, .84f}, "within 1.5 cells of the return"},
                       {RayEnd::near3, {.70f, .70f, .68f}, "within 3.5 cells"},
                       {RayEnd::grazed, {.96f, .55f, .45f}, "early: a surface grazed"},
                       {RayEnd::phantom, {.80f, .05f, .08f}, "early: nothing was seen there"},
                       {RayEnd::late, {.93f, .72f, .20f}, "late: behind the return"},
                       {RayEnd::missed, {.13f, .37f, .80f}, "missed: not stopped"},
                       {RayEnd::unknown, {.55f, .75f, .95f}, "missed: nothing known there"}};

const Color& colorOf(RayEnd end) {
    return std::find_if(std::begin(kKinds), std::end(kKinds),
                        [&](const Kind& k) { return k.end == end; })
        ->color;
}

struct DepthRange {
    double low, high;  ///< [m]
    [[nodiscard]] Color color(double depth) const {
        return heightColor((depth - low) / (high - low));
    }
};

DepthRange depthRange(const std::vector<Ray>& rays) {
    std::vector<double> depths;
    for (const Ray& ray : rays) depths.push_back(Beam(ray).length);
    std::sort(depths.begin(), depths.end());
    const auto at = [&](double q) {
        return depths[static_cast<std::size_t>(q * static_cast<double>(depths.size() - 1))];
    };
    return {at(0.02), std::max(at(0.98), at(0.02) + 0.1)};
}

/** Lays out and draws one scan. */
class DepthPicture {
 public:
    DepthPicture(const ContestResult& result, const ScanView& view, DepthSource source)
        : result_(result),
          view_(view),
          with_scan_(source == DepthSource::scan_and_maps),
          project_(view.rays),
          depths_(depthRange(view.rays)) {
        for (std::size_t i = 0; i < result.maps.size(); i++)
            if (with_scan_ || !result.maps[i].sees_held_out) shown_.push_back(i);
        const double aspect = std::min(project_.aspect(), kFlattest);
        width_ = aspect < kWide ? kPanelWidth : kPanoramaWidth;
        height_ = std::min(width_ / aspect, 1.2 * width_);
        columns_ = aspect < kWide ? 4 : 3;
        const int maps = static_cast<int>(shown_.size());
        columns_ = std::min(columns_, maps + 1);
        rows_ = (maps + columns_) / columns_;  // one card for the scan
        splat_ = kOverlap * std::sqrt(width_ * height_ / static_cast<double>(view.rays.size()));
    }

    [[nodiscard]] std::string draw() {
        Canvas canvas(Canvas::Format::png, 2 * kMargin + columns_ * (width_ + kGap) - kGap,
                      kHeader + rows_ * cardHeight() + kMargin);
        drawHeader(canvas);
        drawMeasured(canvas, cardAt(0));
        for (std::size_t i = 0; i < shown_.size(); i++)
            drawMap(canvas, cardAt(static_cast<int>(i) + 1), shown_[i]);
        return canvas.finish();
    }

 private:
    [[nodiscard]] double cardHeight() const { return kCaption + 2 * height_ + kGap + 4; }
    [[nodiscard]] Canvas::Point cardAt(int place) const {
        return {kMargin + place % columns_ * (width_ + kGap),
                kHeader + place / columns_ * cardHeight()};
    }
    [[nodiscard]] Rect upper(Canvas::Point card) const {
        return {card.x, card.y + kCaption, width_, height_};
    }
    [[nodiscard]] Rect lower(Canvas::Point card) const {
        return {card.x, card.y + kCaption + height_ + 4, width_, height_};
    }

    void drawHeader(Canvas& canvas) const {
        canvas.text(
            {kMargin, 30},
            mrpt::format("What the maps predict of scan %zu, which they never got", view_.scan + 1),
            {18, {.13f, .13f, .13f}, 0, true});
        canvas.text({kMargin, 50},
                    mrpt::format("%zu rays, cells of %g m. Above: depth; below: where a map "
                                 "differs from the scan",
                                 view_.rays.size(), result_.rules.resolution),
                    {12, kPaleInk});
    }

    void caption(Canvas& canvas, Canvas::Point card, const std::string& title,
                 const std::string& words) const {
        canvas.text({card.x, card.y + 14}, title, {14, {.13f, .13f, .13f}, 0, true});
        canvas.text({card.x, card.y + 29}, words, {11, kPaleInk});
    }

    /** A square for each ray. \param color of ray i; its red < 0: none */
    template <class ColorOf>
    void drawRays(Canvas& canvas, const Rect& panel, ColorOf&& color) const {
        canvas.fill(panel, kGround);
        canvas.clip(panel);
        for (std::size_t i = 0; i < view_.rays.size(); i++) {
            const Color c = color(i);
            if (c.r < 0) continue;
            const auto place = project_(view_.rays[i]);
            canvas.fill({panel.left + place.x * panel.width - splat_ / 2,
                         panel.top + place.y * panel.height - splat_ / 2, splat_, splat_},
                        c);
        }
        canvas.unclip();
    }

    void drawMeasured(Canvas& canvas, Canvas::Point card) const {
        if (with_scan_) {
            caption(canvas, card, "The scan",
                    project_.isPanorama() ? "measured depth, all round" : "measured depth");
            drawRays(canvas, upper(card),
                     [&](std::size_t i) { return depths_.color(Beam(view_.rays[i]).length); });
        }
        drawLegend(canvas, lower(card));
    }

    /** Two columns where there is room for them. */
    void drawLegend(Canvas& canvas, const Rect& area) const {
        constexpr double kLine = 19, kSide = 12;
        constexpr int kSteps = 100;
        const double bar = std::min(area.width, 260.0);
        for (int i = 0; i < kSteps; i++)
            canvas.fill({area.left + bar * i / kSteps, area.top + 8, bar / kSteps + 0.5, 10},
                        heightColor((i + 0.5) / kSteps));
        canvas.text({area.left, area.top + 32}, mrpt::format("%.1f m", depths_.low), {11});
        canvas.text({area.left + bar, area.top + 32}, mrpt::format("%.1f m", depths_.high),
                    {11, {.13f, .13f, .13f}, 1});
        const bool is_wide = area.width > 400;
        double x = area.left, y = area.top + 46;
        for (const Kind& k : kKinds) {
            canvas.fill({x, y, kSide, kSide}, k.color);
            canvas.text({x + kSide + 6, y + 10}, k.label, {11});
            y += kLine;
            if (is_wide && y + kSide > area.bottom()) x += 230, y = area.top + 46;
        }
    }

    void drawMap(Canvas& canvas, Canvas::Point card, std::size_t map) const {
        const auto& outcomes = view_.outcomes[map];
        RayTally tally;
        tally.add(view_.rays, outcomes);
        const RayShares s = tally.shares();
        caption(canvas, card, result_.maps[map].name,
                mrpt::format("near1 %.3f   near3 %.3f   early %.3f   miss %.3f", s.near1, s.near3,
                             s.early, s.miss));
        drawRays(canvas, upper(card), [&](std::size_t i) {
            const auto depth = static_cast<double>(outcomes[i].depth);
            return std::isnan(depth) ? Color{-1, 0, 0} : depths_.color(depth);
        });
        drawRays(canvas, lower(card), [&](std::size_t i) { return colorOf(outcomes[i].end); });
    }

    const ContestResult& result_;
    const ScanView& view_;
    bool with_scan_;
    std::vector<std::size_t> shown_;  // of result_.maps
    ScanProjection project_;
    DepthRange depths_;
    double width_, height_, splat_;  // [points] of a panel; of a ray in it
    int columns_, rows_;
};

}  // namespace

void writeDepthPicture(const ContestResult& result, const std::string& file, DepthSource source) {
    if (!result.view)
        throw std::runtime_error("'" + file + "': the scan to draw is not one of those held out");
    if (result.view->rays.empty())
        throw std::runtime_error("'" + file + "': the scan to draw has no point within range");
    writeWhole(file, DepthPicture(result, *result.view, source).draw());
}

}  // namespace akimap::app
