#!/bin/sh
# A text that takes more processor time than allowed is kept and reported: slow.sh TARGET TEXT
set -u
rm -f slow-*
# no time at all is allowed
"$1" 0 14 0 "$2" && { echo "FAILED: a slow text is no finding"; exit 1; }
cmp slow-* "$2" || exit 1
"$1" 0 14 20 "$2" || { echo "FAILED: a quick text is a finding"; exit 1; }
