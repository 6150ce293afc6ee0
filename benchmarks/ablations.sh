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

planes=libs/akimap/src/estimators/surface/hit_planes.cpp
balls=libs/akimap/src/estimators/surface/ball_moments.h
rays=libs/akimap/src/estimators/surface/free_rays.cpp
evidence=libs/akimap/src/estimators/surface/evidence.cpp
options=libs/akimap/src/estimators/surface/options.cpp

# The rows: row NAME [FILE EXPRESSION]..., EXPRESSION for sed -E. `to NAME VALUE` sets a constant.
to() { printf '%s\n' "s/(\\b$1 = )[0-9.]+f?/\\1$2/"; }
rows() {
    row 'as it is'
    row '`free_radius` = 0.25 m' $options 's/p\.free_radius \/ resolution/0.25 \/ resolution/'
    row '`free_radius` = 0.3 m' $options 's/p\.free_radius \/ resolution/0.3 \/ resolution/'
    row '`free_radius` = 0.4 m' $options 's/p\.free_radius \/ resolution/0.4 \/ resolution/'
    row 'hits stay where they are' $planes 's/shift = normal \* .*;/shift.setZero();/'
    row 'β += b, the surface not first' $evidence 's/b \*= one - a;//'
    row 'α += a' $evidence "$(to kSurfaceWeight 1)"
    row 'faint tails count everywhere' $evidence "$(to kLeastSurface 0)"
    row 'balls shrink towards the hit, not its plane' $rays 's/if \(s\.flat\)/if (false)/'
    row '1 instead of 1.5 in ρ' $rays "$(to kClearance 1)"
    row '5 neighbours' $balls "$(to kEnough 5)"
    row '20 neighbours' $balls "$(to kEnough 20)"
    row '0.6 h across the surface' $planes "$(to kThinnest 0.6)"
    row '1.2 h' $planes "$(to kThinnest 1.2)"
    row '2 √v along it' $planes "$(to kWidth 2)"
    row '4 √v' $planes "$(to kWidth 4)"
    row 'flat up to v1 = 0.1 v2' $planes "$(to kFlat 0.1)"
    row 'hits on lines as thick as wide' $planes "$(to kLineThinnest 2)"
    row 'no lines (but then 2D scans carve nothing)' $planes "$(to kLine 0)"
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
# Known AUC / Brier / log-loss / ECE of every fifth corridor scan.
corridor() {
    set --
    for i in $(seq 16); do set -- "$@" "${AKIMAP_DATA:-}/corridor/corridor_$i.pcd"; done
    [ -e "$1" ] || { echo '–'; return; }
    "$scratch/build/bin/akimap" holdout --quiet --json "$scratch/build/holdout.json" "$@"
    awk -F'[:,] *' '/"AkiMap": \{/ { ours = 1 } /"paper": \{/ { ours = set = 0 }
        ours && /"cells_to_0.2_m"/ { set = 1 }
        set && /"known"/ { known = 1 } /}/ { known = 0 }
        known && /"(auc|brier|log_loss|calibration_error)"/ { v[++n] = sprintf("%.4f", $2) }
        END { printf "%s / %s / %s / %s", v[1], v[2], v[3], v[4] }' "$scratch/build/holdout.json"
}

check() { change "$@"; restore "$@"; }
measure() {
    echo "$1" >&2
    change "$@"
    cmake --build "$scratch/build" -j"${JOBS:-2}" --target bench_accuracy akimap_program \
        >"$scratch/build/log" 2>&1 || { cat "$scratch/build/log" >&2; fail "row '$1' does not build"; }
    la3dm=$(accuracy la3dm 1)
    structured=$(accuracy structured "$recordings")
    unstructured=$(accuracy unstructured "$recordings")
    corridor=$(corridor)
    echo "| $1 | $la3dm | $structured | $unstructured | $corridor |"
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
echo '| | LA3DM structured | simulated structured | simulated unstructured | corridor, held out |'
echo '|---|---|---|---|---|'
pass=measure_chosen
rows
