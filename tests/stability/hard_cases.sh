#!/bin/sh
# Writes doc/validation/hard_cases.md from the tables of the last run of the tests:
#   ctest --test-dir build/release -L stability && sh tests/stability/hard_cases.sh build/release
set -eu
build=${1:-build/release}
top=$(cd "$(dirname "$0")/../.." && pwd)
out=$top/doc/validation/hard_cases.md
names="friction shapes grids coupling rough sequences solvers numbers"
for name in $names; do
  if [ ! -f "$build/tests/scratch/hard_$name/table.md" ]; then
    echo "hard_cases.sh: $build/tests/scratch/hard_$name/table.md is missing; run ctest -L stability first" >&2
    exit 1
  fi
done
mkdir -p "$(dirname "$out")"
{
  cat <<'TEXT'
# Hard cases

Written by the test run; the commands are

    ctest --test-dir build/release -L stability
    sh tests/stability/hard_cases.sh build/release

Every case must have a right answer or end with a clear statement (an error, or a report that is not
"converged" and a message). Answers are checked by the contact conditions, evaluated from the fields of
the result by direct sums over influence coefficients, without FFT and without anything a solver left
behind: no tension, gap zero in contact and not negative outside, tractions within their bounds, zero slip
in adhesion, slip opposite to traction, prescribed forces met. See `tests/stability/hard_case.f90`.

Columns: elements in contact and in adhesion; the normal problem (iterations of NormCG, products, relative
violation); the tangential method, its iterations (Newton steps, sweeps, conjugate gradients), products with
the compliance on the finest grid over all outer passes, reported residual, and the largest violation that
the direct sums find (normal gap or friction law; "A, then B": A gave up and B took over).
Without another remark EPS is 1e-6 and the bodies are steel, mu 0.3.

In "All solvers" the sweeps and gradients stop when the tractions no longer change by EPS (1e-5 there): their
true residual may be larger by some factor, which the column shows. In "Dissimilar bodies" the column includes what
the outer iteration (stop: change of tractions below 5 EPS) leaves; with MAXOUT 1 (Johnson) nothing is iterated.

TEXT
  cat <<TEXT
| group | cases | refused | handed to a fall-back | not converged, and said so | products: mean | largest |
|---|---|---|---|---|---|---|
TEXT
  for name in $names; do
    awk -F'|' -v name="$name" 'NR > 4 && NF > 5 {
        n++
        if (/refused/) { refused++; next }
        if ($6 ~ /then/) handed++
        if ($11 !~ /converged/) failed++
        sum += $8; if ($8 + 0 > most) most = $8 + 0
      } END { printf "| %s | %d | %d | %d | %d | %.0f | %d |\n", name, n, refused, handed, failed, sum/(n - refused), most }' \
      "$build/tests/scratch/hard_$name/table.md"
  done
  echo
  for name in $names; do
    cat "$build/tests/scratch/hard_$name/table.md"
  done
} > "$out.new"
mv "$out.new" "$out"
