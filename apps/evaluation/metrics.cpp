// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace akimap::app {

namespace {

double ratio(double part, double whole) {
    return whole > 0 ? part / whole : std::numeric_limits<double>::quiet_NaN();
}

void sortByOccupancy(std::vector<ScoredCell>& cells) {
    std::sort(cells.begin(), cells.end(),
              [](const ScoredCell& a, const ScoredCell& b) { return a.occupancy < b.occupancy; });
}

/** Calls visit(occupied, free) with the counts of each run of equal occupancies. They are whole,
 * which doubles are up to 2^53. */
template <class Iterator, class Visitor>
void forEachTie(Iterator begin, Iterator end, Visitor&& visit) {
    while (begin != end) {
        double occupied = 0, free = 0;
        const double occupancy = begin->occupancy;
        for (; begin != end && begin->occupancy == occupancy; ++begin)
            (begin->occupied ? occupied : free)++;
        visit(occupied, free);
    }
}

/** Mann and Whitney's U over the number of pairs. */
double areaUnderRoc(const std::vector<ScoredCell>& sorted) {
    double free_below = 0, occupied = 0, won = 0;
    forEachTie(sorted.begin(), sorted.end(), [&](double tied_occupied, double tied_free) {
        won += tied_occupied * (free_below + tied_free / 2);
        free_below += tied_free;
        occupied += tied_occupied;
    });
    return ratio(won, occupied * free_below);
}

double logLoss(const ScoredCell& c) {
    const double p = std::clamp(c.occupancy, 0.01, 0.99);
    return -std::log(c.occupied ? p : 1 - p);
}

/** Leaves out a point where the two beside it are within 0.004 of each other, both rates together.
 * A kept point and the next but one are then farther apart, of 2 in all: at most 1001 are left. */
std::vector<RocPoint> thinned(const std::vector<RocPoint>& curve) {
    const auto distance = [](const RocPoint& a, const RocPoint& b) {
        return b.false_positive_rate - a.false_positive_rate + b.true_positive_rate -
               a.true_positive_rate;
    };
    std::vector<RocPoint> kept = {curve.front()};
    for (std::size_t i = 1; i + 1 < curve.size(); i++)
        if (distance(kept.back(), curve[i + 1]) > 0.004) kept.push_back(curve[i]);
    kept.push_back(curve.back());
    return kept;
}

ClassScores classScores(double right, double wrongly_claimed, double missed) {
    return {ratio(right, right + wrongly_claimed), ratio(right, right + missed),
            ratio(2 * right, 2 * right + wrongly_claimed + missed)};
}

}  // namespace

Scores score(std::vector<ScoredCell> cells) {
    double squares = 0, losses = 0, counts[2][2] = {};  // counts[said occupied][is occupied]
    for (const ScoredCell& c : cells) {
        const double error = c.occupancy - (c.occupied ? 1 : 0);
        squares += error * error;
        losses += logLoss(c);
        counts[c.occupancy > 0.5][c.occupied]++;
    }
    sortByOccupancy(cells);
    const auto n = static_cast<double>(cells.size());
    return {cells.size(),
            areaUnderRoc(cells),
            ratio(squares, n),
            classScores(counts[1][1], counts[1][0], counts[0][1]),
            classScores(counts[0][0], counts[0][1], counts[1][0]),
            ratio(losses, n),
            calibrationError(reliability(cells))};
}

std::vector<RocPoint> roc(std::vector<ScoredCell> cells) {
    sortByOccupancy(cells);
    double occupied = 0, free = 0;
    std::vector<RocPoint> curve = {{0, 0}};
    forEachTie(cells.rbegin(), cells.rend(), [&](double tied_occupied, double tied_free) {
        occupied += tied_occupied;
        free += tied_free;
        curve.push_back({free, occupied});
    });
    if (occupied == 0 || free == 0) return {};
    for (RocPoint& p : curve) {
        p.false_positive_rate /= free;
        p.true_positive_rate /= occupied;
    }
    return curve.size() > 1000 ? thinned(curve) : curve;
}

Reliability reliability(const std::vector<ScoredCell>& cells) {
    Reliability bins;
    for (const ScoredCell& c : cells) {
        ReliabilityBin& bin =
            bins[std::min<std::size_t>(9, static_cast<std::size_t>(10 * c.occupancy))];
        bin.cells++;
        bin.mean_occupancy += c.occupancy;
        bin.occupied_fraction += c.occupied;
    }
    for (ReliabilityBin& bin : bins) {
        const auto n = static_cast<double>(bin.cells);
        bin.mean_occupancy = ratio(bin.mean_occupancy, n);
        bin.occupied_fraction = ratio(bin.occupied_fraction, n);
    }
    return bins;
}

double calibrationError(const Reliability& bins) {
    double sum = 0, cells = 0;
    for (const ReliabilityBin& bin : bins)
        if (bin.cells > 0) {
            const auto n = static_cast<double>(bin.cells);
            sum += n * std::abs(bin.mean_occupancy - bin.occupied_fraction);
            cells += n;
        }
    return ratio(sum, cells);
}

}  // namespace akimap::app
