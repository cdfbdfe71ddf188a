#!/bin/sh
# Error against time: sh tests/performance/accuracy.sh [--goals]
#
# Builds, measures for some minutes, and writes doc/validation/accuracy.md and accuracy.svg; --goals writes only the last section of
# accuracy.md, random contacts compared with the goals.
# BENCH_BUILD names an up-to-date build folder to be used instead of building.
set -u
top=$(cd "$(dirname "$0")/../.." && pwd) || exit 1
. "$top/tests/support/setup.sh"
programs=${BENCH_BUILD:-}
if [ -z "$programs" ]; then
  install_missing
  build release -DCONTACT_TESTS=ON
  programs=$top/build/release
fi
OMP_NUM_THREADS=1
export OMP_NUM_THREADS
folder=$top/doc/validation
mkdir -p "$folder"
lines=$(mktemp) || exit 1
trap 'rm -f "$lines"' EXIT
say "Measuring"
case ${1:-} in
  '')
    "$programs/tests/performance_accuracy" >"$lines" || fail "The measurement failed."
    python3 "$top/tests/performance/accuracy.py" "$folder" <"$lines" || exit 1
    ;;
  --goals) ;;
  *) fail "usage: sh tests/performance/accuracy.sh [--goals]" ;;
esac
sed '/^## Goals$/,$d' "$folder/accuracy.md" >"$lines"
python3 "$top/tests/performance/goals.py" "$programs/tests/performance_goals" >>"$lines" || fail "The measurement of goals failed."
cp "$lines" "$folder/accuracy.md"
say "Written: doc/validation/accuracy.md"
