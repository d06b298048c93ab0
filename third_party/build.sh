#!/usr/bin/env bash
# build.sh PRESET TARGET [cmake options]: configures when it was never done or options are given, then builds.
# Quiet unless there is something to build or to complain about.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
preset=$1
target=$2
shift 2
folder=$root/build/$preset
log=$folder/build.log
mkdir -p "$folder"
cd "$root"
# ./run beside ./test waits for it: both may configure anew, each for its own targets.
exec 9>"$folder/.lock"
flock 9
if [ ! -f "$folder/build.ninja" ] || [ $# -gt 0 ]; then
  cmake --preset "$preset" "$@" >"$log" 2>&1 || { cat "$log" >&2; exit 4; }
fi
if [ -n "$(ninja -C "$folder" -n "$target" 2>/dev/null | grep -m1 '^\[')" ]; then
  echo "raylab: building ($preset); the first time takes some minutes" >&2
fi
ninja -C "$folder" "$target" >"$log" 2>&1 || { grep -vE '^\[[0-9]+/[0-9]+\] ' "$log" >&2; exit 4; }
