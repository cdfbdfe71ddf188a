#!/bin/sh
# The benchmark: sh tests/performance/run.sh [--large] [--quick] [--write] [section ...]
#
#   --large    also 201,000 elements, and the prototype on 320 x 320
#   --quick    smallest sizes only, tables of 100 cases
#   --write    write the tables of cases, and of wheel on rail, to their blocks of doc/validation/performance.md; requires all
#              sections, or rail alone
#   sections   setup normal rolling shift classical line table rail; default: all of them, the
#              whole program, heap allocations, and the comparison with the prototype
# BENCH_BUILD names an up-to-date build folder to be used instead of building.
set -u
top=$(cd "$(dirname "$0")/../.." && pwd) || exit 1
. "$top/tests/support/setup.sh"
here=$top/tests/performance
prototype=${BENCH_PROTOTYPE:-$top/../shared/prototype}
options=
sections=
write=no
rail=no
for argument; do
  case $argument in
    --large | --quick) options="$options $argument" ;;
    --write) write=yes ;;
    setup | normal | rolling | shift | classical | line | table) sections="$sections $argument" ;;
    rail) rail=yes ;;
    *) fail "usage: sh tests/performance/run.sh [--large] [--quick] [--write] [section ...]" ;;
  esac
done
# a table must not be replaced by a part of it
if [ $write = yes ]; then
  case $options$sections in
    "" | " --large") ;;
    *) fail "--write needs all sections, or rail alone, without --quick" ;;
  esac
fi
programs=${BENCH_BUILD:-}
if [ -z "$programs" ]; then
  install_missing
  build release -DCONTACT_TESTS=ON
  programs=$top/build/release
fi
bench=$programs/tests/performance_bench
OMP_NUM_THREADS=1
OPENBLAS_NUM_THREADS=1
export OMP_NUM_THREADS OPENBLAS_NUM_THREADS

# Run a program that writes files to the current folder in a folder of its own
in_scratch() {
  scratch=$(mktemp -d) || return 1
  (cd "$scratch" && "$@")
  status=$?
  rm -rf "$scratch"
  return $status
}

measure_rail() { in_scratch "$programs/tests/performance_rail" "$top"; }

# Title of a part in Markdown
title() { printf '\n## %s\n\n' "$1"; }

# shellcheck disable=SC2086  # options are words
measure_cases() {
  printf 'Commit %s, %s, %s processors, %s.\n\n' \
    "$(git -C "$top" rev-parse --short HEAD 2>/dev/null || echo unknown)" "$(date -u +%Y-%m-%d)" \
    "$(getconf _NPROCESSORS_ONLN)" "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo 2>/dev/null | head -1)"
  "$bench" $options $sections
}

measure_vehicle() {
  printf 'Eight wheels, 1 ms per step, S1002 on 60E1, EPS = 1e-5, P = 2; processor time of a call of the library on one thread, ms.\n\n'
  steps=500
  case $options in *--quick*) steps=60 ;; esac
  in_scratch "$programs/tests/performance_vehicle" "$top/examples/profiles" $steps
}

# Lines of the document that are written by hand
measure_others() {
  title "The whole program"
  python3 "$here/whole_program.py" "$programs/bin/contact" "$bench"
  title "Inputs as users write them"
  python3 "$here/asked_inputs.py" "$programs/bin/contact" "$top"
  title "Threads"
  python3 "$here/threads.py" "$programs/bin/contact"
  title "Files for other programs"
  python3 "$here/exports.py" "$programs/bin/contact"
  title "Requests to the heap in repeated cases, 11 x 11"
  "$bench" --allocations | python3 "$here/name_places.py" "$bench"
  title "Against the numpy prototype"
  case $options in
    *--quick*) echo "Omitted by --quick." ;;
    *--large*) python3 "$here/prototype.py" --large "$bench" "$prototype" ;;
    *) python3 "$here/prototype.py" "$bench" "$prototype" ;;
  esac
  return 0
}

# Print the output of a command, and put it into its block of the document on request: block NAME COMMAND
block() {
  "$2" >"$result" || fail "The benchmark failed: $(tail -3 "$result")"
  cat "$result"
  [ $write = no ] || sh "$here/put_block.sh" "$1" "$result" "$top/doc/validation/performance.md" || exit 1
}

result=$(mktemp) || exit 1
trap 'rm -f "$result"' EXIT
if [ $rail = no ] || [ -n "$sections" ]; then
  block cases measure_cases
  [ -n "$sections" ] && [ $rail = no ] && exit 0
fi
title "Wheel on rail"
block rail measure_rail
title "A wheel in a time loop"
measure_vehicle || exit 1
[ $rail = yes ] && exit 0
measure_others
