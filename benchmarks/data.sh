#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The recordings of BENCHMARK.md, laid out as AKIMAP_DATA wants them:
#
#   benchmarks/data.sh DIR [CLONES]
#   make benchmark AKIMAP_DATA=DIR
#
# CLONES holds la3dm, BALM and tsdf-fusion-python (or is where to clone what is missing; DIR/clones
# if not given; some 300 MB). Their licences are copied along. The corridor is not made: its
# scans come out of a ROS bag of github.com/PinocchioYS/akimap; the benchmark does without.
set -eu

fail() { echo "data.sh: $*" >&2; exit 1; }
[ $# -ge 1 ] && [ $# -le 2 ] || { sed -n '3,10s/^# \{0,1\}//p' "$0"; exit 2; }
dir=$1
clones=${2:-$dir/clones}

# Prints the folder of a repository, cloned if it is not there.
clone_of() {
    name=${1##*/}
    if [ ! -d "$clones/$name" ]; then
        echo "cloning https://github.com/$1 into $clones/$name" >&2
        git clone --quiet --depth 1 "https://github.com/$1" "$clones/$name" >&2 ||
            fail "https://github.com/$1 can't be cloned: give a folder with a clone as CLONES"
    fi
    echo "$clones/$name"
}

# take FROM TO: copies one file.
take() {
    [ -f "$1" ] || fail "$1 is missing"
    cp "$1" "$2"
}

# Scans in the map frame; the benchmark corrects the sensor's height.
la3dm() {
    from=$1/data
    for scene in sim_structured:12 sim_structured_long_term:60; do
        name=${scene%:*}
        mkdir -p "$dir/la3dm/$name"
        for n in $(seq "${scene#*:}"); do
            take "$from/$name/${name}_$n.pcd" "$dir/la3dm/$name/"
        done
    done
    take "$1/LICENSE" "$dir/la3dm/"
}

# Every fourth of the first 57 scans. Its poses are matrices of four rows with the time at the end.
lidar_dense() {
    from=$1/datas/benchmark_realworld
    mkdir -p "$dir/lidar_dense"
    for n in $(seq 1 15); do
        take "$from/full$((4 * n - 4)).pcd" "$dir/lidar_dense/scan_$(printf %02d "$n").pcd"
    done
    [ -f "$from/alidarPose.csv" ] || fail "$from/alidarPose.csv is missing"
    awk -F, '{ row = (NR - 1) % 4; scan = (NR - 1 - row) / 4 }
             scan > 56 { exit }
             scan % 4 == 0 && row < 3 { printf "%s %s %s %s%s", $1, $2, $3, $4, row < 2 ? " " : "\n" }' \
        "$from/alidarPose.csv" >"$dir/lidar_dense/poses_kitti.txt"
    take "$1/LICENSE" "$dir/lidar_dense/"
}

# Every tenth of the first 500 frames.
rgbd_office() {
    from=$1/data
    mkdir -p "$dir/rgbd_office"
    take "$from/camera-intrinsics.txt" "$dir/rgbd_office/"
    for n in $(seq 0 10 490); do
        frame=frame-$(printf %06d "$n")
        take "$from/$frame.depth.png" "$dir/rgbd_office/"
        take "$from/$frame.pose.txt" "$dir/rgbd_office/"
    done
    take "$1/LICENSE" "$dir/rgbd_office/"
}

mkdir -p "$dir" "$clones"
repository=$(clone_of RobustFieldAutonomyLab/la3dm)
la3dm "$repository"
repository=$(clone_of hku-mars/BALM)
lidar_dense "$repository"
repository=$(clone_of andyzeng/tsdf-fusion-python)
rgbd_office "$repository"
echo "$dir is ready: make benchmark AKIMAP_DATA=$dir"
