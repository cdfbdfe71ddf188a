#!/bin/sh
# Test of put_block.sh: sh put_block_test.sh DOCUMENT; the document is copied, not changed
set -eu
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $*"; exit 1; }

printf 'by hand\n<!-- run.sh: a -->\nold\nolder\n<!-- end of run.sh: a -->\nbetween\n<!-- run.sh: b -->\n<!-- end of run.sh: b -->\nlast\n' \
  >"$scratch/document"
printf 'new & \\1\n' >"$scratch/text"
sh "$here/put_block.sh" a "$scratch/text" "$scratch/document"
sh "$here/put_block.sh" b "$scratch/text" "$scratch/document"
printf 'by hand\n<!-- run.sh: a -->\nnew & \\1\n<!-- end of run.sh: a -->\nbetween\n<!-- run.sh: b -->\nnew & \\1\n<!-- end of run.sh: b -->\nlast\n' \
  >"$scratch/expected"
cmp "$scratch/document" "$scratch/expected" || fail "a block was not replaced, or other lines were changed"
if sh "$here/put_block.sh" c "$scratch/text" "$scratch/document" 2>"$scratch/message"; then fail "a missing block was accepted"; fi
if sh "$here/put_block.sh" a /dev/null "$scratch/document" 2>"$scratch/message"; then fail "an empty text was accepted"; fi
cmp "$scratch/document" "$scratch/expected" || fail "a refused replacement changed the document"

# the document of the benchmark has its blocks
for block in cases rail; do
  cp "$1" "$scratch/copy"
  sh "$here/put_block.sh" "$block" "$scratch/text" "$scratch/copy" || fail "$1 has no block $block"
  grep -v '^<!--' "$scratch/copy" | grep -qx '## A wheel in a time loop' || fail "hand-written text of $1 was lost"
done
