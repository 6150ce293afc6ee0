#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs each fuzzer of a build (preset fuzz) for so many seconds: run.sh BUILD SECONDS [FORMAT...].
# Corpora grow in BUILD/corpus; a finding is left in BUILD/findings, and ends this with an error.
set -euo pipefail
build=$(realpath "$1") seconds=$2
shift 2
here=$(dirname "$(realpath "$0")")
root=$here/../..
formats=("$@")
[ $# -gt 0 ] || formats=(map sections pcd tum ini rawlog simplemap)

# The seeds: those kept here, and the golden maps unpacked, as gz hides what is in it.
for format in "${formats[@]}"; do
  mkdir -p "$build/corpus/$format" "$build/findings/$format" "$build/contained"
  [ ! -d "$here/seeds/$format" ] || cp "$here/seeds/$format"/* "$build/corpus/$format/"
done
for map in "$root"/tests/data/*.akimap; do
  [ ! -d "$build/corpus/map" ] || gunzip -c <"$map" >"$build/corpus/map/$(basename "$map")"
done
[ ! -d "$build/corpus/sections" ] ||
  python3 "$here/sections_seed.py" <"$build/corpus/map/version3_options.akimap" \
    >"$build/corpus/sections/version3_options"
[ ! -d "$build/corpus/ini" ] || cp "$root/share/akimap/akimap.ini" "$build/corpus/ini/"

status=0
for format in "${formats[@]}"; do
  log=$build/findings/$format.log
  prefix=$build/findings/$format/
  case $format in rawlog | simplemap) prefix=$build/contained/ ;; esac
  "$build/bin/fuzz_$format" -max_total_time="$seconds" -timeout=10 -malloc_limit_mb=512 \
    -max_len=30000 -print_final_stats=1 -artifact_prefix="$prefix" \
    "$build/corpus/$format" >"$log" 2>&1 || { status=1; echo "fuzz_$format: a finding, see $log"; }
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  coverage=$(grep -o 'cov: [0-9]*' "$log" | tail -n 1)
  echo "fuzz_$format: ${executions:-?} executions, ${coverage:-cov: ?} edges, $seconds s"
done
exit $status
