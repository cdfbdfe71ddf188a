#!/bin/sh
# Packages for Debian: program, library, headers, Python, Matlab, manual, by the files in debian/. Usage: deb.sh [FOLDER]; results
# are in FOLDER, default build/packages. Needs debhelper, dh-python and the requirements of a build; DEBMAINTAINER: maintainer
set -eu
top=$(cd "$(dirname "$0")/../.." && pwd)
out=${1:-$top/build/packages}
mkdir -p "$out"
out=$(cd "$out" && pwd)
version=$(sed -n 's/.*contact_version = "\([^"]*\)".*/\1/p' "$top/src/cli/versions.f90")
maintainer=${DEBMAINTAINER:-"CONTACT developers <contact@example.org>"}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
source=$work/contact-$version

# Files under version control only
mkdir "$source"
(cd "$top" && git ls-files -z --cached --others --exclude-standard -- CMakeLists.txt LICENSE README.md src include python matlab doc examples |
  tar -c --null -T -) | tar -x -C "$source"
cp -R "$top/src/packaging/debian" "$source/debian"
sed -i "s/^Maintainer: .*/Maintainer: $maintainer/" "$source/debian/control"
{
  printf 'contact (%s) unstable; urgency=medium\n\n  * See changes.md of the sources.\n\n' "$version"
  printf ' -- %s  %s\n' "$maintainer" "$(cd "$top" && git log -1 --format=%cD)"
} > "$source/debian/changelog"
(cd "$source" && dpkg-buildpackage --build=binary --no-sign) > "$work/log" 2>&1 || { tail -40 "$work/log"; exit 1; }
rm -f "$out"/*.deb "$out"/contact_*.changes "$out"/contact_*.buildinfo
cp "$work"/*.deb "$work"/*.changes "$work"/*.buildinfo "$out"
if command -v lintian > /dev/null; then
  # Packages that are not uploaded to Debian do not close bugs
  lintian --fail-on error,warning --suppress-tags initial-upload-closes-no-bugs --tag-display-limit 0 "$out"/contact_*.changes
fi
ls -l "$out"/*.deb
