#!/bin/sh
# The functions that the shared library exports are those that the headers declare, no more, no less
# usage: symbols.sh LIBRARY C_COMPILER
set -eu
library=$1
compiler=$2

"$compiler" -E -P "$CONTACT_SOURCE/include/contact.h" | tr '\n' ' ' | grep -oE '[A-Za-z_][A-Za-z0-9_]* *\(' | tr -d ' (' | sort -u > declared
nm -D --defined-only "$library" | awk '{ print $NF }' | sed 's/@.*//' | sort -u > exported
if [ ! -s declared ]; then
  echo "no function found in the headers"
  exit 1
fi
diff declared exported || {
  echo "above: < declared in a header but not exported, > exported but not declared"
  exit 1
}
echo "$(wc -l < declared) functions declared and exported"
