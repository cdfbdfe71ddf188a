#!/bin/sh
# The functions that the shared library exports are those that the headers declare, with the aliases that have
# an underscore behind the name, and two that are left out of the headers; no more, no less
# usage: symbols.sh LIBRARY C_COMPILER
set -eu
library=$1
compiler=$2

names() { "$compiler" -E -P "$1" | tr '\n' ' ' | grep -oE '[A-Za-z_][A-Za-z0-9_]* *\(' | tr -d ' ('; }
{ names "$CONTACT_SOURCE/include/contact_addon.h"; echo cntc_calculate1; echo cntc_calculate3; } |
  grep -E '^(cntc|subs)_' | sort -u > routines
{ names "$CONTACT_SOURCE/include/contact.h"; cat routines; sed 's/$/_/' routines; } | sort -u > declared
nm -D --defined-only "$library" | awk '{ print $NF }' | sed 's/@.*//' | sort -u > exported
if [ "$(wc -l < routines)" -ne 70 ]; then
  echo "there are $(wc -l < routines) routines in the header and beside it, not 70"
  exit 1
fi
diff declared exported || {
  echo "above: < declared in a header but not exported, > exported but not declared"
  exit 1
}
echo "$(wc -l < declared) functions declared and exported"
