#!/bin/sh
# What accuracy costs: sh tests/performance/accuracy.sh
#
# Builds, measures for a few minutes, and writes doc/validation/accuracy.md and accuracy.svg.
# BENCH_BUILD names a build folder that is up to date, to be used instead.
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
mkdir -p "$top/doc/validation"
lines=$(mktemp) || exit 1
trap 'rm -f "$lines"' EXIT
say "Measuring"
"$programs/tests/performance_accuracy" >"$lines" || fail "The measurement failed."
python3 "$top/tests/performance/accuracy.py" "$top/doc/validation" <"$lines" || exit 1
say "Written: doc/validation/accuracy.md, doc/validation/accuracy.svg"
