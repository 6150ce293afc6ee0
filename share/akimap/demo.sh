#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Maps from a real lidar scan, a real RGB-D frame and a simulated drive, each with a picture, and
# the accuracy against the drive's exact truth beside MRPT's COctoMap.
# Usage: demo.sh FOLDER_OF_THE_PROGRAMS OUTPUT_FOLDER
set -euo pipefail
bin=$1 out=$2
datasets=/usr/share/mrpt/datasets
mkdir -p "$out"

build() {  # NAME TITLE ARGUMENTS...
    local name=$1 title=$2
    shift 2
    printf '\n== %s\n' "$title"
    "$bin/akimap" build "$@" -o "$out/$name.akimap" --export "$out/$name.3Dscene" \
        --export "$out/$name.ply" --export "$out/$name.png"
}

# The two real logs hold one scan each, which needs no pose.
build lidar "A Velodyne VLP-16 scan (mrpt-common)" \
    "$datasets/test_velodyne_VLP16.rawlog" --max-range 25 --resolution 0.2
build rgbd "An RGB-D frame (mrpt-common)" \
    "$datasets/tests_rgbd.rawlog" --resolution 0.02

printf '\n== A simulated drive: 12 scans of 3500 points\n'
"$bin/akimap" simulate structured -o "$out/drive"
build drive "The map of the drive" "$out/drive/scene.rawlog" --trajectory "$out/drive/trajectory.tum"

printf '\n== Accuracy against the exact truth, and mapping time, in one run\n'
"$bin/bench_accuracy" structured

printf '\nLook at:'
printf ' %s' "$out"/{lidar,rgbd,drive}.png
printf '\n'
printf 'Open %s/drive.3Dscene with SceneViewer3D (apt install mrpt-apps).\n' "$out"
