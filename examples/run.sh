#!/bin/sh
# Install what is missing, build program and library, run one example and show its result: sh examples/run.sh NAME
set -u
top=$(cd "$(dirname "$0")/.." && pwd) || exit 1
. "$top/tests/support/setup.sh"

examples() {
  for file in "$top"/examples/*.inp; do
    [ -f "$file" ] && basename "$file" .inp
  done
}

[ $# = 1 ] || fail "usage: sh examples/run.sh NAME, where NAME is one of
$(examples)"
name=$(basename "$1" .inp)
[ -f "$top/examples/$name.inp" ] || fail "There is no example '$name'; the examples are
$(examples)"

install_missing
# shellcheck disable=SC2034
build_targets=products
build release
results=$top/build/examples/$name
mkdir -p "$results" || exit 1
say "Running $name"
"$top/build/release/bin/contact" --output-dir "$results" 2 "$top/examples/$name" ||
  fail "The program ended with an error; see its messages above."

# From the heading of the last results to the table of elements, or to the end of the run
say "Results of the last case, from $results/$name.out"
awk '
  /^ *Case +[0-9]/ { title = $0 }
  /TOTAL FORCES/ { block = title "\n\n"; inside = 1 }
  /QUANTITIES DISTRIBUTED|^Performance timers|CONTACT program ended/ { inside = 0 }
  inside { block = block $0 "\n" }
  END { if (block == "") exit 1; printf "%s", block }
' "$results/$name.out" || tail -n 30 "$results/$name.out"
