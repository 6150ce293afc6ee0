#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Drives MRPT's RawLogViewer (with the plugin) and SceneViewer3D on a virtual screen, as a user would:
# load a log, fill in the raw-map form, build, save, preview in 3D, close; open the scene, close.
# Both must exit with 0, and the saved map must be the one that `akimap build` makes of the log.
# Screenshots are left in OUT as .png. Needs xvfb, xdotool and netpbm; without them: exit status 77.
# Usage: viewers.sh BUILD_FOLDER OUT
set -euo pipefail
for tool in RawLogViewer SceneViewer3D Xvfb xdotool xwdtopnm; do
    command -v $tool >/dev/null || { echo "viewers.sh: skipped, there is no $tool"; exit 77; }
done
build=$(realpath "$1") ini=$(dirname "$(realpath "$0")")/../share/akimap/config_files/RawLogViewer-raw-map.ini
log="/usr/share/mrpt/datasets/2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog"
mkdir -p "$2" && out=$(realpath "$2")
rm -f "$out"/saved* "$out/display"

Xvfb -displayfd 1 -screen 0 1280x1000x24 -fbdir "$out" >"$out/display" 2>"$out/xvfb.log" &
screen=$!
trap 'kill $screen' EXIT
until [ -s "$out/display" ]; do sleep 0.1; done
DISPLAY=:$(cat "$out/display") && export DISPLAY LIBGL_ALWAYS_SOFTWARE=1 HOME=$out

fail() { echo "viewers.sh: $*" >&2; exit 1; }
window() {  # TITLE: waits for it, prints its id
    local id
    for _ in $(seq 300); do
        id=$(xdotool search --onlyvisible --name "$1" 2>/dev/null | tail -n 1) || true
        [ -n "$id" ] && sleep 1 && echo "$id" && return
        sleep 0.2
    done
    fail "no window '$1'"
}
file() {  # NAME: waits for it
    for _ in $(seq 300); do [ -s "$1" ] && sleep 1 && return; sleep 0.2; done
    fail "no file $1"
}
click() { xdotool mousemove --window "$1" "$2" "$3" click 1; sleep 1; }
screenshot() { xwdtopnm "$out/Xvfb_screen0" 2>/dev/null | pnmtopng 2>/dev/null >"$out/$1.png"; }
close() {  # WINDOW PID NAME
    xdotool windowfocus "$1" key alt+F4
    wait "$2" || fail "$3 ended with status $?"
    echo "$3: exit status 0"
}

RawLogViewer -l "$build/lib/libakimap.so" "$log" >"$out/RawLogViewer.log" 2>&1 &
app=$!
main=$(window RawlogViewer)
click "$(window 'Tip of the Day')" 328 238
click "$main" 215 62
form=$(window 'raw map & paths')
xdotool windowfocus "$form"
click "$form" 700 150
xdotool key ctrl+a
grep -v '^;' "$ini" | while IFS= read -r line; do
    [ -z "$line" ] || xdotool type --delay 1 -- "$line"
    xdotool key Return
done
click "$form" 133 192  # Map from odometry
sleep 5
click "$form" 100 243  # Save map as text
xdotool windowfocus "$(window 'Save as text')" key ctrl+a
xdotool type --delay 5 "$out/saved"
xdotool key Return
file "$out/saved_akimap__AkiMap_00.akimap"
click "$form" 304 277  # Preview in 3D
xdotool windowmove "$(window '3D preview')" 700 500
sleep 3
screenshot preview
xdotool windowraise "$form"
click "$form" 482 278  # Close
close "$main" $app RawLogViewer

cells() { "$build/bin/akimap" info "$1" --json | tr ',' '\n' | grep -m 1 '"cells"'; }
"$build/bin/akimap" build "$log" -c "$ini" --section map -o "$out/expected.akimap" --quiet 2>/dev/null
[ "$(cells "$out/saved_akimap__AkiMap_00.akimap")" = "$(cells "$out/expected.akimap")" ] ||
    fail "RawLogViewer's map is not akimap's"
echo "RawLogViewer's map has the cells of akimap build's"

SceneViewer3D "$out/saved_akimap__AkiMap_00_3D.3Dscene" >"$out/SceneViewer3D.log" 2>&1 &
app=$!
main=$(window 3Dscene)
xdotool windowsize "$main" 1000 800
sleep 4
screenshot scene
close "$main" $app SceneViewer3D
