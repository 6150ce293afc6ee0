// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include "evaluation/contest/contest.h"

#include <mrpt/system/CTicTac.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "evaluation/contest/beam.h"
#include "evaluation/holdout.h"

namespace akimap::app {

namespace {

struct HeldOutScan {
    std::size_t scan;
    std::vector<Ray> rays;
};

/** What one pass over the recording leaves behind. */
struct Fold {
    explicit Fold(double resolution) : own_returns(resolution), held_out_returns(resolution) {}
    std::vector<std::unique_ptr<Contestant>> maps;
    std::vector<HeldOutScan> held_out;
    ReturnCounts own_returns, held_out_returns;
    std::size_t scans = 0, inserted = 0;
};

class Judge {
 public:
    Judge(const std::vector<Entrant>& entrants, const ContestRules& rules)
        : entrants_(entrants), rules_(rules) {
        result_.rules = rules;
        for (const Entrant& e : entrants) {
            result_.maps.emplace_back();
            result_.maps.back().name = e.name, result_.maps.back().what = e.what;
            result_.maps.back().sees_held_out = e.sees_held_out;
        }
        result_.answers.of_map.resize(entrants.size());
        close_answers_.of_map.resize(entrants.size());
    }

    void judgeFold(const Recording& recording, std::size_t number) {
        Fold fold = build(recording, number);
        check(fold);
        result_.folds++;
        result_.scans = fold.scans;
        result_.held_out += fold.held_out.size();
        const bool is_viewed = chooseView(fold);
        addQueries(fold);
        for (std::size_t i = 0; i < entrants_.size(); i++) {
            const OccupancyCells cells = fold.maps[i]->cells();
            fold.maps[i].reset();  // the largest thing here
            judgeMap(cells, fold, i, is_viewed);
        }
    }

    [[nodiscard]] ContestResult finish() {
        if (result_.answers.occupied.empty())
            throw std::runtime_error("the held-out scans have no point within range");
        const auto far = scoresOf(result_.answers), close = scoresOf(close_answers_);
        for (std::size_t i = 0; i < entrants_.size(); i++) {
            result_.maps[i].to_fixed_clearance = far[i];
            result_.maps[i].to_cell_clearance = close[i];
        }
        return std::move(result_);
    }

 private:
    Fold build(const Recording& recording, std::size_t number) {
        Fold fold(rules_.resolution);
        for (const Entrant& e : entrants_) fold.maps.push_back(e.make());
        recording([&](const std::vector<Ray>& scan) {
            const bool held_out = isHeldOut(fold.scans + number, rules_.every);
            take(fold, scan, held_out);
            fold.scans++;
        });
        return fold;
    }

    void take(Fold& fold, const std::vector<Ray>& scan, bool held_out) {
        const std::vector<Ray> returns = usable(scan);
        if (held_out) {
            fold.held_out.push_back({fold.scans, judged(scan)});
            countReturns(coveredReturns(scan), fold.held_out_returns);
        } else {
            countReturns(returns, fold.own_returns);
            fold.inserted += returns.empty() ? 0 : 1;
        }
        for (std::size_t i = 0; i < entrants_.size(); i++) {
            if (held_out && !entrants_[i].sees_held_out) continue;
            mrpt::system::CTicTac clock;
            fold.maps[i]->insert({scan, returns});
            result_.maps[i].seconds += clock.Tac();
            result_.maps[i].scans_inserted++;
        }
    }

    /** In the grid, at whatever range. */
    [[nodiscard]] std::vector<Ray> coveredReturns(const std::vector<Ray>& scan) const {
        const BlockGrid grid(rules_.resolution);
        const auto covers = [&](const std::array<double, 3>& p) {
            return grid.covers(p[0], p[1], p[2]);
        };
        std::vector<Ray> kept;
        std::copy_if(scan.begin(), scan.end(), std::back_inserter(kept),
                     [&](const Ray& r) { return r.hit && covers(r.origin) && covers(r.end); });
        return kept;
    }

    [[nodiscard]] std::vector<Ray> usable(const std::vector<Ray>& scan) const {
        return raysInRange(coveredReturns(scan), rules_.ranges);
    }

    /** The returns that are cast; a wall nearer than two cells leaves a ray no room. */
    [[nodiscard]] std::vector<Ray> judged(const std::vector<Ray>& scan) const {
        const std::size_t step =
            std::max<std::size_t>(1, (scan.size() + kMostReturns - 1) / kMostReturns);
        std::vector<Ray> even;
        for (std::size_t i = 0; i < scan.size(); i += step) even.push_back(scan[i]);
        std::vector<Ray> kept;
        for (const Ray& ray : usable(even))
            if (Beam(ray).length >= 2 * rules_.resolution) kept.push_back(ray);
        return kept;
    }

    void check(const Fold& fold) const {
        if (fold.scans < rules_.every)
            throw std::runtime_error(std::to_string(fold.scans) + " scans in the inputs: with " +
                                     "--every " + std::to_string(rules_.every) +
                                     " none is held out");
        if (fold.inserted == 0)
            throw std::runtime_error("nothing usable in the scans that are not held out");
    }

    /** \return whether this fold has the scan to keep; its rays are kept then */
    bool chooseView(const Fold& fold) {
        if (result_.view || fold.held_out.empty()) return false;
        const std::size_t wanted =
            rules_.view.value_or(fold.held_out[fold.held_out.size() / 2].scan);
        for (const HeldOutScan& h : fold.held_out)
            if (h.scan == wanted)
                result_.view =
                    ScanView{h.scan, h.rays, {entrants_.size(), std::vector<RayOutcome>()}};
        return result_.view.has_value();
    }

    void addQueries(const Fold& fold) {
        far_.clear(), close_.clear();
        for (const HeldOutScan& h : fold.held_out)
            for (const Ray& ray : h.rays) {
                for (const Query& q : queriesOf(ray)) far_.push_back(q);
                for (const Query& q : closeQueriesOf(ray, rules_.resolution)) close_.push_back(q);
            }
        for (const Query& q : far_) result_.answers.occupied.push_back(q.occupied);
        for (const Query& q : close_) close_answers_.occupied.push_back(q.occupied);
        const double queries = static_cast<double>(close_answers_.occupied.size());
        if (queries <= kMaxScoredCells) return;
        std::ostringstream text;
        text << queries << " queries are more than " << kMaxScoredCells << ": hold out fewer scans";
        throw std::runtime_error(text.str());
    }

    void judgeMap(const OccupancyCells& cells, const Fold& fold, std::size_t i, bool is_viewed) {
        MapResult& map = result_.maps[i];
        for (const HeldOutScan& h : fold.held_out) {
            auto outcomes = castRays(cells, fold.held_out_returns, h.rays);
            RayTally of_scan;
            of_scan.add(h.rays, outcomes);
            map.rays.add(h.rays, outcomes);
            if (!h.rays.empty()) map.by_scan.push_back({h.scan, of_scan.shares()});
            if (is_viewed && h.scan == result_.view->scan)
                result_.view->outcomes[i] = std::move(outcomes);
        }
        map.faithfulness += faithfulness(cells, fold.own_returns);
        ask(cells, far_, result_.answers.of_map[i]);
        ask(cells, close_, close_answers_.of_map[i]);
    }

    const std::vector<Entrant>& entrants_;
    const ContestRules& rules_;
    ContestResult result_;
    Answers close_answers_;
    std::vector<Query> far_, close_;  // of the present fold
};

}  // namespace

Recording recordingOf(const std::vector<std::vector<Ray>>& scans) {
    return [&scans](const auto& take) {
        for (const std::vector<Ray>& scan : scans) take(scan);
    };
}

ContestRules rulesFor(const AkiMap& configured) {
    ContestRules rules;
    rules.resolution = configured.resolution();
    rules.ranges = configured.insertionOptions;
    return rules;
}

ContestResult holdContest(const Recording& recording, const std::vector<Entrant>& entrants,
                          const ContestRules& rules) {
    Judge judge(entrants, rules);
    for (std::size_t fold = 0; fold < (rules.all_folds ? rules.every : 1); fold++)
        judge.judgeFold(recording, fold);
    return judge.finish();
}

const MapResult* referenceOf(const ContestResult& result) {
    const auto found = std::find_if(result.maps.begin(), result.maps.end(),
                                    [](const MapResult& m) { return m.name == kReferenceEntrant; });
    return found == result.maps.end() ? nullptr : &*found;
}

PairedDifference pairedDifference(const MapResult& map, const MapResult& reference,
                                  double RayShares::*figure) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    PairedDifference d{0, kNone, kNone};
    std::size_t count = 0;
    for (std::size_t i = 0; i < map.by_scan.size(); i++) {
        const double difference =
            map.by_scan[i].shares.*figure - reference.by_scan[i].shares.*figure;
        if (std::isnan(difference)) continue;  // no ray was stopped: no error of depth
        d.mean += difference, count++;
        d.lowest = std::fmin(d.lowest, difference), d.highest = std::fmax(d.highest, difference);
    }
    d.mean = count ? d.mean / static_cast<double>(count) : kNone;
    return d;
}

}  // namespace akimap::app
