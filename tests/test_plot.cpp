// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
//
// The drawer of line charts: what a user finds in the PNG and in the SVG.
#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>

#include <cmath>

#include "pictures/plot/Scale.h"
#include "pictures/plot/plot.h"
#include "run_program.h"

namespace {

using namespace akimap::app;
using mrpt::img::TColor;

const TColor kBlue(0, 114, 178), kVermillion(213, 94, 0), kGreen(0, 158, 115);

Figure someFigure() {
    Panel lines;
    lines.x = {"false positive rate", 0, 1};
    lines.y = {"true positive rate", 0, 1};
    lines.diagonal = true;
    lines.curves = {{"first & <best>", {0, 0.2, 1}, {0, 0.9, 1}, 0},
                    {"second", {0, 0.5, 1}, {0, 0.3, 1}, 1, true, true}};
    Panel bars;
    bars.x.label = "update time [ms]";
    bars.y.label = "scans";
    bars.bars = {{"bars", {0, 1, 2, 3}, {3, 0, 5}, 2}};
    Figure figure;
    figure.title = "A title";
    figure.panels = {lines, bars};
    figure.width = 320;
    figure.height = 500;
    return figure;
}

/** Pixels within 8 of the colour in each channel. */
int pixelsOf(const TColor& color, const mrpt::img::CImage& image) {
    int count = 0;
    const auto near = [](int a, int b) { return std::abs(a - b) <= 8; };
    for (int y = 0; y < static_cast<int>(image.getHeight()); y++)
        for (int x = 0; x < static_cast<int>(image.getWidth()); x++) {
            const auto* bgr =
                image.ptr<uint8_t>(static_cast<unsigned>(x), static_cast<unsigned>(y));
            count += near(bgr[2], color.R) && near(bgr[1], color.G) && near(bgr[0], color.B);
        }
    return count;
}

class Plot : public ::testing::Test {
 protected:
    [[nodiscard]] mrpt::img::CImage png(const Figure& figure) const {
        writeFigure(figure, folder.file("p.png"));
        mrpt::img::CImage image;
        EXPECT_TRUE(image.loadFromFile(folder.file("p.png")));
        return image;
    }
    TemporaryFolder folder;
};

TEST_F(Plot, APngHasItsSizeAndItsColours) {
    const auto image = png(someFigure());
    EXPECT_EQ(image.getWidth(), 640u);
    EXPECT_EQ(image.getHeight(), 1000u);
    EXPECT_GT(pixelsOf(kBlue, image), 1000);       // a solid line of some 600 x 4 pixels
    EXPECT_GT(pixelsOf(kVermillion, image), 500);  // dashed
    EXPECT_GT(pixelsOf(kGreen, image), 5000);      // bars
    EXPECT_GT(pixelsOf(TColor(255, 255, 255), image), 400000);

    Figure without = someFigure();
    without.panels[0].curves.pop_back();
    EXPECT_EQ(pixelsOf(kVermillion, png(without)), 0);
}

TEST_F(Plot, AnSvgIsXmlAndHoldsTheWords) {
    if (runCommand("xmllint --version").exit != 0)
        GTEST_SKIP() << "xmllint is missing: apt-get install libxml2-utils";
    const std::string file = folder.file("p.svg");
    writeFigure(someFigure(), file);
    const auto run = runCommand("xmllint --noout " + file);
    EXPECT_EQ(run.exit, 0) << run.err;
    const std::string svg = readText(file);
    for (const char* words : {"A title", "first &amp; &lt;best&gt;", "second", "bars", "scans",
                              "true positive rate", "false positive rate", "update time [ms]"})
        EXPECT_NE(svg.find(words), std::string::npos) << words;
}

TEST_F(Plot, NamesThatAreNoUtf8AreDrawnAllTheSame) {
    Figure figure = someFigure();
    figure.panels[0].curves[0].name = "broken \xff\xc3( \n name";
    EXPECT_GT(pixelsOf(kBlue, png(figure)), 1000);
    writeFigure(figure, folder.file("p.svg"));
    EXPECT_EQ(readText(folder.file("p.svg")).find('\xff'), std::string::npos);
}

TEST_F(Plot, LongNamesAreCutToFitBetweenTheAxes) {
    Figure figure = someFigure();
    const auto before = png(figure);
    figure.panels[0].curves[0].name = std::string(300, 'x') + "é end";
    const auto after = png(figure);
    int changed_beside = 0, changed_inside = 0;
    for (unsigned y = 0; y < before.getHeight(); y++)
        for (unsigned x = 0; x < before.getWidth(); x++) {
            const bool beside = x < 80 || x + 45 > before.getWidth();
            (beside ? changed_beside : changed_inside) +=
                *before.ptr<uint8_t>(x, y) != *after.ptr<uint8_t>(x, y);
        }
    EXPECT_EQ(changed_beside, 0);
    EXPECT_GT(changed_inside, 1000);
}

TEST_F(Plot, WhatIsNotFiniteIsLeftOut) {
    Figure figure = someFigure();
    Panel& panel = figure.panels[0];
    panel.x = panel.y = {};
    const double inf = INFINITY;
    panel.curves = {{"", {0, NAN, 0.5, inf, 1}, {0, 1, NAN, 2, 1e-300}, 0}, {"", {}, {}, 1}};
    EXPECT_GT(pixelsOf(kBlue, png(figure)), 1000);
    panel.x.logarithmic = panel.y.logarithmic = true;  // one point is left
    EXPECT_EQ(pixelsOf(kVermillion, png(figure)), 0);
}

TEST_F(Plot, EmptyFiguresAndPanelsAreDrawn) {
    EXPECT_EQ(png({}).getWidth(), 1280u);
    Figure figure;
    figure.panels.resize(2);
    EXPECT_EQ(png(figure).getHeight(), 960u);
}

TEST_F(Plot, OtherExtensionsAndUnwritableFilesAreRefused) {
    for (const char* name : {"p.jpg", "p", "png", "none/p.png"}) {
        EXPECT_THROW(checkPlottable(folder.file(name)), std::runtime_error) << name;
        EXPECT_THROW(writeFigure(someFigure(), folder.file(name)), std::runtime_error) << name;
        EXPECT_FALSE(std::filesystem::exists(folder.file(name)));
    }
    EXPECT_NO_THROW(checkPlottable(folder.file("P.SVG")));
}

std::vector<std::string> labels(const Axis& axis, const std::vector<double>& data) {
    std::vector<std::string> labels;
    const Scale scale(axis, data);
    for (const auto& tick : scale.ticks()) labels.push_back(tick.label);
    return labels;
}

TEST(Scale, TicksAreRoundNumbersAboutTheData) {
    using Labels = std::vector<std::string>;
    EXPECT_EQ(labels({"", 0, 1}, {}), (Labels{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
    EXPECT_EQ(labels({}, {-0.9, 2.7}),
              (Labels{"-1.0", "-0.5", "0.0", "0.5", "1.0", "1.5", "2.0", "2.5", "3.0"}));
    EXPECT_EQ(labels({}, {0, 41}), (Labels{"0", "10", "20", "30", "40", "50"}));
    EXPECT_EQ(labels({"", {}, {}, true}, {-3, 0, 2, 4000}),
              (Labels{"1", "10", "10²", "10³", "10⁴"}));
    for (const double value : {0., 5., -2e-7, 3e12}) {  // no range at all
        const Scale scale({}, {value});
        EXPECT_LT(scale.min(), scale.max());
        EXPECT_LE(scale.min(), value);
        EXPECT_GE(scale.max(), value);
        EXPECT_GE(scale.ticks().size(), 3u);
        EXPECT_LE(scale.ticks().size(), 12u);
    }
}

TEST(Scale, PlacesValuesBetweenItsEnds) {
    const Scale linear({"", 10, 20}, {}), logarithmic({"", 1, 100, true}, {});
    EXPECT_NEAR(linear.place(12.5), 0.25, 1e-12);
    EXPECT_NEAR(logarithmic.place(10), 0.5, 1e-12);
}

TEST(Histogram, CountsEveryFiniteValueOnce) {
    const Bars bars = histogram("times", {1, 1.9, 2, 5, 3.5, NAN, INFINITY}, 4);
    EXPECT_EQ(bars.edges, (std::vector<double>{1, 2, 3, 4, 5}));
    EXPECT_EQ(bars.heights, (std::vector<double>{2, 1, 1, 1}));
    EXPECT_EQ(histogram("same", {7, 7, 7}, 3).heights[0], 3);
    EXPECT_TRUE(histogram("none", {NAN}, 3).heights.empty());
}

}  // namespace
