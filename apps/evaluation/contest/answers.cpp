// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/contest/answers.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>

namespace akimap::app {

namespace {

using IsTaken = std::function<bool(std::size_t query)>;

std::vector<ScoredCell> select(const Answers& answers, std::size_t map, const IsTaken& is_taken) {
    std::vector<ScoredCell> cells;
    for (std::size_t i = 0; i < answers.occupied.size(); i++) {
        if (!is_taken(i)) continue;
        const float p = answers.of_map[map][i];
        cells.push_back({isKnown(p) ? static_cast<double>(p) : 0.5, answers.occupied[i] != 0});
    }
    return cells;
}

IsTaken knownTo(const Answers& answers, std::size_t map) {
    return [&answers, map](std::size_t i) { return isKnown(answers.of_map[map][i]); };
}

bool isKnownToAll(const Answers& answers, std::size_t query) {
    return std::all_of(answers.of_map.begin(), answers.of_map.end(),
                       [&](const std::vector<float>& map) { return isKnown(map[query]); });
}

bool isTaken(std::size_t) {
    return true;
}

}  // namespace

void ask(const OccupancyCells& map, const std::vector<Query>& queries,
         std::vector<float>& answers) {
    constexpr std::size_t kGrain = 1024;
    const std::size_t first = answers.size();
    answers.resize(first + queries.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, queries.size(), kGrain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          OccupancyCells::Reader reader(map);
                          for (std::size_t i = range.begin(); i < range.end(); i++)
                              answers[first + i] = reader[map.cellAt(queries[i].place)];
                      });
}

std::vector<CellScores> scoresOf(const Answers& answers) {
    const std::size_t maps = answers.of_map.size();
    std::vector<CellScores> scores(maps);
    // Three tasks for each map: sorting is what takes time.
    tbb::parallel_for(std::size_t{0}, 3 * maps, [&](std::size_t task) {
        const std::size_t map = task / 3;
        CellScores& s = scores[map];
        if (task % 3 == 0)
            s.common = score(
                select(answers, map, [&](std::size_t i) { return isKnownToAll(answers, i); }));
        else if (task % 3 == 1)
            s.known = score(select(answers, map, knownTo(answers, map)));
        else
            s.all = score(select(answers, map, isTaken));
    });
    for (CellScores& s : scores)
        s.coverage = static_cast<double>(s.known.cells) / static_cast<double>(s.all.cells);
    return scores;
}

ScoredCells scoredCells(const Answers& answers, std::size_t map) {
    return {select(answers, map, knownTo(answers, map)), select(answers, map, isTaken)};
}

}  // namespace akimap::app
