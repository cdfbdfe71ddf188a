#!/bin/sh
# A package for Debian: program, library, headers, scripts, manual. Usage: deb.sh [FOLDER]; the result is in FOLDER, default
# build/packages. Needs dpkg-dev and what a build needs; DEBMAINTAINER is who answers for it. Libraries that it depends on are found
# by dpkg-shlibdeps. Program and library in one package: lintian would like two (link-to-shared-library-in-wrong-package)
set -eu
top=$(cd "$(dirname "$0")/../.." && pwd)
out=${1:-$top/build/packages}
mkdir -p "$out"
out=$(cd "$out" && pwd)
version=$(sed -n 's/.*contact_version = "\([^"]*\)".*/\1/p' "$top/src/cli/versions.f90")
maintainer=${DEBMAINTAINER:-"CONTACT developers <contact@example.org>"}
system=$(dpkg --print-architecture)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
build=$top/build/deb
root=$work/debian/contact

cmake -S "$top" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_SKIP_INSTALL_RPATH=ON \
  -DCONTACT_TESTS=OFF -DCMAKE_INSTALL_LIBDIR="lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)" > "$work/log" || { cat "$work/log"; exit 1; }
ninja -C "$build" > "$work/log" || { tail -30 "$work/log"; exit 1; }
DESTDIR=$root ninja -C "$build" install > /dev/null
# The name that older callers load belongs beside libraries, not among commands
mkdir -p "$root/usr/lib/contact"
mv "$root"/usr/bin/contact_addon_linux64.so "$root/usr/lib/contact/"
find "$root/usr" -type f \( -name '*.so*' -o -path '*/bin/*' \) -exec strip --strip-unneeded {} +
find "$root/usr" -name '*.a' -exec strip --strip-debug {} +
rm -rf "$root/usr/share/licenses"
# Python and its tools find the packages where Debian has its own
mkdir -p "$root/usr/lib/python3/dist-packages"
for package in contact python_intfc; do
  ln -s "../../../share/contact/python/$package" "$root/usr/lib/python3/dist-packages/$package"
done

doc=$root/usr/share/doc/contact
mkdir -p "$doc" "$root/usr/share/man/man1" "$root/usr/share/bash-completion/completions" "$root/DEBIAN"
cp -R "$top/doc/user" "$top/doc/theory" "$top/doc/validation" "$top/doc/index.md" "$top/doc/changes.md" "$doc"
cp -R "$top/examples" "$doc/examples"
find "$doc" -name '*.py' \( -path '*/figures/*' -o -path '*/validation/*' \) -exec rm {} +
find "$doc" -type f -exec chmod 644 {} +
python3 "$top/src/packaging/man.py" "$build/bin/contact" | gzip -9n > "$root/usr/share/man/man1/contact.1.gz"
cp "$top/src/packaging/contact.bash" "$root/usr/share/bash-completion/completions/contact"
chmod 644 "$root/usr/share/bash-completion/completions/contact"
{
  printf 'contact (%s) unstable; urgency=medium\n\n  * See changes.md of the sources.\n\n' "$version"
  printf ' -- %s  %s\n' "$maintainer" "$(date -R -u)"
} | gzip -9n > "$doc/changelog.gz"
{
  cat "$top/src/packaging/copyright"
} > "$doc/copyright"

cd "$work"
printf 'Source: contact\n\nPackage: contact\nArchitecture: any\n' > debian/control
depends=$(dpkg-shlibdeps -O --ignore-missing-info "$root/usr/bin/contact" "$root"/usr/lib/*/libcontact.so.* 2> /dev/null |
  sed -n 's/^shlibs:Depends=//p')
size=$(du -sk "$root/usr" | cut -f 1)
cat > "$root/DEBIAN/control" <<END
Package: contact
Version: $version
Section: science
Priority: optional
Architecture: $system
Depends: $depends
Suggests: python3-numpy, python3-h5py, octave
Installed-Size: $size
Maintainer: $maintainer
Description: rolling and sliding contact with friction
 Computes where two elastic bodies touch, the pressures and shear stresses they
 exchange, which parts stick and which slip, and the total forces, for instance
 between wheel and rail. Program, C and Fortran library, and scripts for Python,
 Matlab and Octave.
END
printf 'libcontact %s contact (>= %s)\n' "${version%%.*}" "$version" > "$root/DEBIAN/shlibs"
printf 'activate-noawait ldconfig\n' > "$root/DEBIAN/triggers"
(cd "$root" && find usr -type f -exec md5sum {} + > DEBIAN/md5sums)
chmod -R u+rwX,go+rX,go-w "$root"
dpkg-deb --root-owner-group --build "$root" "$out/contact_${version}_$system.deb"
if command -v lintian > /dev/null; then
  lintian --tag-display-limit 0 "$out/contact_${version}_$system.deb" || true
fi
