#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Instructions of each room on a fixed workload, one thread, counted by callgrind: repeatable, so
# that a regression shows as a number. Usage: instructions.sh BIN_FOLDER
set -eu
command -v valgrind >/dev/null || { echo "instructions.sh: needs valgrind" >&2; exit 1; }
out=$(mktemp -d)
trap 'rm -r "$out"' EXIT
for room in takeSamples bandwidths scatter; do
    valgrind --tool=callgrind --callgrind-out-file="$out/profile" \
        --toggle-collect="akimap::$room(*" "$1/bench_instructions" >"$out/log" 2>&1 ||
        { cat "$out/log" >&2; exit 1; }
    samples=$(sed -n 's/^samples //p' "$out/log")
    total=$(sed -n 's/^totals: *//p' "$out/profile")
    echo "$room $total instructions, $((total / samples)) a sample"
done
