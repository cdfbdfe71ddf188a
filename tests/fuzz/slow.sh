#!/bin/sh
# A text that exceeds the limit of processor time is kept and reported: slow.sh TARGET TEXT
set -u
rm -f slow-*
# a limit of zero
"$1" 0 14 0 "$2" && { echo "FAILED: a slow text is not reported"; exit 1; }
cmp slow-* "$2" || exit 1
"$1" 0 14 20 "$2" || { echo "FAILED: a fast text is reported"; exit 1; }
