#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# What each choice of the default estimator is worth: a table of doc/design.md. One thing at a time is
# changed in a copy of the sources (build-ablations), and the accuracy measured; the table goes to
# stdout. Usage: ablations.sh [PATTERN]: only the rows whose names match it (grep -E).
# RECORDINGS of the simulated scenes to average (3), JOBS for the compiler (2).
set -eu
cd "$(dirname "$0")/.."
scratch=build-ablations
original=$scratch/build/original
sources="CMakeLists.txt cmake libs apps benchmarks share"
recordings=${RECORDINGS:-3}

estimator=libs/akimap/src/estimators/surface
fit=$estimator/patch_fit.cpp
balls=$estimator/ball_moments.h
patches=$estimator/patches.h
rays=$estimator/free_rays.cpp
evidence=$estimator/evidence.cpp
cell=$estimator/cell_evidence.h

# The rows: row NAME [FILE EXPRESSION]..., EXPRESSION for sed -E. `to NAME VALUE` sets a constant.
to() { printf '%s\n' "s/(\\b$1 = )[0-9.]+f?/\\1$2/"; }
rows() {
    row 'as it is'
    row '5 neighbours' $balls "$(to kEnough 5)"
    row '20 neighbours' $balls "$(to kEnough 20)"
    row 'flat up to v1 = 0.02 v2' $fit "$(to kFlat 0.02)"
    row 'flat up to v1 = 0.1 v2' $fit "$(to kFlat 0.1)"
    row 'planes through the sensor too' $fit "$(to kLeastCosine 0)"
    row 'ellipses of 1.4 √v' $fit "$(to kWidth 1.4)"
    row 'ellipses of 2.8 √v' $fit "$(to kWidth 2.8)"
    row 'ellipses up to 0.4 m' $fit "$(to kWidest 0.4)"
    row '3 h before the plane' $patches "$(to kPatchFront 3)"
    row 'rays have passed 3 h from the plane' $rays "$(to kClearance 3)"
    row 'occupied from 0.5 h on' $cell "$(to kOccupiedFront 0.5f)"
    row 'occupied from 0.35 h on' $cell "$(to kOccupiedFront 0.35f)"
    row 'occupied to 1.5 h behind' $cell "$(to kOccupiedBehind 1.5f)"
    row 'σ = 0.2 h' $cell "$(to kPlaceError 0.2f)"
    row 'rays count 2' $cell "$(to kThroughWeight 2)"
    row 'rays count 4' $cell "$(to kThroughWeight 4)"
    row 'no surface where rays passed' $evidence "$(to kSeenThrough 0)"
    row 'f between rays never grows' $evidence "$(to kInferredLater 0)"
    row 'no f between rays' $evidence "$(to kInferred 0)" $evidence "$(to kInferredLater 0)"
}

fail() { echo "ablations.sh: $*" >&2; exit 1; }

# Makes the changes of a row in the copy, which is then newer than what was built of it.
change() {
    name=$1; shift
    while [ $# -gt 0 ]; do
        sed -E "$2" "$scratch/$1" >"$scratch/build/changed"
        cmp -s "$scratch/build/changed" "$scratch/$1" && fail "row '$name': '$2' changes nothing in $1"
        cat "$scratch/build/changed" >"$scratch/$1"
        shift 2
    done
}
restore() {
    shift
    while [ $# -gt 0 ]; do cat "$original/$1" >"$scratch/$1"; shift 2; done
}

# Known AUC / MSE / precision / recall of occupied; all AUC / MSE.
accuracy() {  # SCENE SEEDS
    figures=$("$scratch/build/bin/bench_accuracy" "$1" --seeds "$2" --method AkiMap --plain \
        2>"$scratch/build/log") || { cat "$scratch/build/log" >&2; fail "bench_accuracy $1"; }
    [ -n "$figures" ] || { echo '–'; return; }
    echo "$figures" | awk -F'\t' '{ printf "%s / %s / %.3f / %.3f; %s / %s", $2, $3, $4, $5, $8, $9 }'
}
# near1 / early + miss of every fifth scan of a recording of bench_next_scan.
next_scan() {  # RECORDING
    "$scratch/build/bin/bench_next_scan" --folds one "$1" 2>"$scratch/build/log" |
        awk -F'|' '/near1/ { rays = 1 } rays && $2 ~ /^ AkiMap *$/ { gsub(/\*/, "")
            printf "%.3f / %.3f", $3, $5 + $8; exit }' | grep . || echo '–'
}

check() { change "$@"; restore "$@"; }
measure() {
    echo "$1" >&2
    change "$@"
    cmake --build "$scratch/build" -j"${JOBS:-2}" --target bench_accuracy bench_next_scan \
        >"$scratch/build/log" 2>&1 || { cat "$scratch/build/log" >&2; fail "row '$1' does not build"; }
    la3dm=$(accuracy la3dm 1)
    structured=$(accuracy structured "$recordings")
    unstructured=$(accuracy unstructured "$recordings")
    office=$(next_scan 'office, 5 cm')
    lidar=$(next_scan 'lidar, 5 cm')
    echo "| $1 | $office | $lidar | $la3dm | $structured | $unstructured |"
    restore "$@"
}
row() { $pass "$@"; }
measure_chosen() { if echo "$1" | grep -qE "$pattern"; then measure "$@"; fi; }

# Only files that differ are copied, and they become new, so that no object of another row is taken
# for that of the sources as they are.
copy_sources() {
    (cd "$original" && find . -type f) | while read -r file; do
        cmp -s "$original/$file" "$scratch/$file" && continue
        mkdir -p "$scratch/$(dirname "$file")"
        cat "$original/$file" >"$scratch/$file"
    done
    (cd "$scratch" && find $sources -type f) | while read -r file; do
        [ -e "$original/$file" ] || rm "$scratch/$file"
    done
}

pattern=${1:-}
rm -rf "$original"
mkdir -p "$original"
cp -r $sources "$original"  # who goes on editing meanwhile does not mix rows
copy_sources
pass=check
rows  # before minutes are spent on the first ones
cmake -S "$scratch" -B "$scratch/build" -DCMAKE_BUILD_TYPE=Release -DAKIMAP_BUILD_TESTS=OFF \
    -DAKIMAP_BUILD_EXAMPLES=OFF >"$scratch/build/log" 2>&1 || { cat "$scratch/build/log" >&2; fail 'cmake'; }
echo '| | office 5 cm | lidar 5 cm | LA3DM structured | simulated structured | simulated unstructured |'
echo '|---|---|---|---|---|---|'
pass=measure_chosen
rows
