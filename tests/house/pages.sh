#!/bin/sh
# The pages made by FORD from the sources, without a warning: sh pages.sh. Exit status 77: FORD is not installed
#
# They are in build/pages/index.html.
set -u
cd "$CONTACT_SOURCE/doc/develop" || exit 1
PATH=$CONTACT_SOURCE/build/lint/bin:$PATH
command -v ford >/dev/null 2>&1 || { echo "SKIPPED: there is no ford; sh tests/run.sh installs it"; exit 77; }
python3 -B ford_source.py ../../src ../../build/sources_of_pages || exit 1
said=$(ford ford.md 2>&1) || { printf '%s\n' "$said"; exit 1; }
if printf '%s\n' "$said" | grep -A 3 '^Warning'; then
  exit 1
fi
