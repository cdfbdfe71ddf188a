#!/bin/sh
# Generate pages from the sources by FORD, without warnings: sh pages.sh. Exit status 77: FORD is not installed
#
# The result is build/pages/index.html.
set -u
cd "$CONTACT_SOURCE/doc/develop" || exit 1
PATH=$CONTACT_SOURCE/build/lint/bin:$PATH
command -v ford >/dev/null 2>&1 || { echo "SKIPPED: ford is not installed; sh tests/run.sh installs it"; exit 77; }
python3 -B ford_source.py ../../src ../../build/sources_of_pages || exit 1
# by the interpreter of its program
python=$(sed -n '1s/^#!//p' "$(command -v ford)")
output=$("$python" -B "$CONTACT_SOURCE/tests/house/quick_ford.py" ford.md 2>&1) || { printf '%s\n' "$output"; exit 1; }
if printf '%s\n' "$output" | grep -A 3 '^Warning'; then
  exit 1
fi
