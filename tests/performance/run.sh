#!/bin/sh
# The benchmark: sh tests/performance/run.sh [--large] [--quick] [--write] [section ...]
#
#   --large    also 201,000 elements, and the prototype on 320 x 320
#   --quick    smallest sizes only, tables of 100 cases
#   --write    puts the result into doc/validation/performance.md
#   sections   setup normal rolling shift classical line table rail; without any: all of them, the
#              whole program, requests to the heap, and the comparison with the prototype
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

# performance_rail writes the slices of its crossing to the current folder
measure_rail() {
  scratch=$(mktemp -d) || return 1
  (cd "$scratch" && "$programs/tests/performance_rail" "$top")
  status=$?
  rm -rf "$scratch"
  return $status
}

# shellcheck disable=SC2086,SC2016  # marks of Markdown
measure() {
  printf '# Computing times\n\n'
  printf 'Written by `sh tests/performance/run.sh --write`; columns and repetition: [how to measure speed](../develop/performance.md).\n\n'
  printf 'Commit %s, %s, %s processors, %s.\n\n' \
    "$(git -C "$top" rev-parse --short HEAD 2>/dev/null || echo unknown)" "$(date -u +%Y-%m-%d)" \
    "$(getconf _NPROCESSORS_ONLN)" "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo 2>/dev/null | head -1)"
  if [ $rail = no ] || [ -n "$sections" ]; then
    "$bench" $options $sections || return 1
    [ -n "$sections" ] && [ $rail = no ] && return 0
  fi
  printf '\n## Wheel on rail\n\n'
  measure_rail || return 1
  printf '\n## A wheel in a time loop\n\n'
  printf 'Eight wheels, 1 ms per step, S1002 on 60E1, EPS = 1e-5, P = 2; processor time of a call of the library on one thread, ms.\n\n'
  steps=500
  case $options in *--quick*) steps=60 ;; esac
  "$programs/tests/performance_vehicle" "$top/examples/profiles" $steps || return 1
  [ $rail = yes ] && return 0
  printf '\n## The whole program\n\n'
  python3 "$here/whole_program.py" "$programs/bin/contact" "$bench"
  printf '\n## Inputs as users write them\n\n'
  python3 "$here/asked_inputs.py" "$programs/bin/contact" "$top"
  printf '\n## Files for other programs\n\n'
  python3 "$here/exports.py" "$programs/bin/contact"
  printf '\n## Requests to the heap in repeated cases, 11 x 11\n\n'
  "$bench" --allocations | python3 "$here/name_places.py" "$bench"
  printf '\n## Against the numpy prototype\n\n'
  case $options in
    *--quick*) echo "Omitted by --quick." ;;
    *--large*) python3 "$here/prototype.py" --large "$bench" "$prototype" ;;
    *) python3 "$here/prototype.py" "$bench" "$prototype" ;;
  esac
  return 0
}

if [ $write = no ]; then
  measure
  exit $?
fi
mkdir -p "$top/doc/validation"
result=$(mktemp) || exit 1
trap 'rm -f "$result"' EXIT
measure >"$result" || fail "The benchmark failed: $(tail -3 "$result")"
cat "$result"
cp "$result" "$top/doc/validation/performance.md"
