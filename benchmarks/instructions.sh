#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Instructions of each estimator's steps on a fixed workload, one thread, counted by callgrind:
# repeatable, so that a regression shows as a number. The surface estimator's samples are its hits.
# Usage: instructions.sh BIN_FOLDER
set -eu
command -v valgrind >/dev/null || { echo "instructions.sh: needs valgrind" >&2; exit 1; }
out=$(mktemp -d)
trap 'rm -r "$out"' EXIT

bin=$1
count() {  # ESTIMATOR FUNCTION...
    estimator=$1
    shift
    for step; do
        valgrind --tool=callgrind --callgrind-out-file="$out/profile" \
            --toggle-collect="akimap::$step(*" "$bin/bench_instructions" "$estimator" \
            >"$out/log" 2>&1 || { cat "$out/log" >&2; exit 1; }
        samples=$(sed -n 's/^samples //p' "$out/log")
        total=$(sed -n 's/^totals: *//p' "$out/profile")
        [ "$total" -gt 0 ] || { echo "instructions.sh: no function $step" >&2; exit 1; }
        echo "$estimator: $step $total instructions, $((total / samples)) a sample"
    done
}
count surface takeHits fitPatches binPatches markHitRays FreeBalls::transform addEvidence
count paper takeSamples bandwidths scatter
