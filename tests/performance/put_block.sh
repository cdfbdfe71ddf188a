#!/bin/sh
# Replace a generated block of a document: sh put_block.sh NAME TEXT DOCUMENT
#
# The block is between the lines <!-- run.sh: NAME --> and <!-- end of run.sh: NAME -->, each of which must occur once, in this
# order. TEXT is a file with the new lines; all other lines are unchanged.
set -u
name=$1
text=$2
document=$3
begin="<!-- run.sh: $name -->"
end="<!-- end of run.sh: $name -->"
if ! awk -v begin="$begin" -v end="$end" '
    $0 == begin { begins++; first = NR }
    $0 == end { ends++; last = NR }
    END { exit !(begins == 1 && ends == 1 && first < last) }' "$document"; then
  echo "$document has no block between $begin and $end" >&2
  exit 1
fi
[ -s "$text" ] || { echo "$text is empty" >&2; exit 1; }
result=$(mktemp) || exit 1
trap 'rm -f "$result"' EXIT
awk -v begin="$begin" -v end="$end" -v text="$text" '
    $0 == end { inside = 0 }
    !inside { print }
    $0 == begin {
      inside = 1
      while ((getline line < text) > 0) print line
    }' "$document" >"$result" || exit 1
cat "$result" >"$document"
