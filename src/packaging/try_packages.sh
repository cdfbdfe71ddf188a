#!/bin/sh
# shellcheck disable=SC2016  # the shell in the root expands
# Install the packages of a folder in a minimal Debian root without compilers and test them: the wheel, the packages for
# Debian, then, with gcc installed, the library from C by pkg-config and CMake. One line for each test; exit status 1 if one failed.
# Usage (root): try_packages.sh [FOLDER [ROOT]]; FOLDER has the packages, default build/packages; ROOT is an existing minimal root, which is copied.
# The root has the release and the package sources of this machine
set -eu
top=$(cd "$(dirname "$0")/../.." && pwd)
packages=$(cd "${1:-$top/build/packages}" && pwd)
work=$(mktemp -d)
root=$work/root
log=$work/log
failures=0
finish() {
  umount "$root/proc" "$root/dev" 2> /dev/null || true
  rm -rf --one-file-system "$work"
}
trap finish EXIT
# shellcheck source=/dev/null
. /etc/os-release

# try WHAT COMMAND: run the command in the root as a user, in a separate folder
try() {
  if chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    sh -euc "cd /root && $2" > "$log" 2>&1; then
    printf 'ok      %s: %s\n' "$1" "$(grep . "$log" | tail -1 | cut -c 1-100)"
  else
    printf 'FAILED  %s\n' "$1"
    tail -20 "$log"
    failures=$((failures + 1))
  fi
}

if [ -n "${2:-}" ]; then
  cp -a "$2" "$root"
else
  mirror=$(sed -n 's/^URIs: *//p; s/^deb \([^[ ]*\) .*/\1/p' /etc/apt/sources.list.d/debian.sources /etc/apt/sources.list 2> /dev/null | head -1)
  debootstrap --variant=minbase "$VERSION_CODENAME" "$root" "$mirror" > "$log" 2>&1 || { tail "$log"; exit 1; }
fi
# borrow FILE: copy a file of this machine to the root
borrow() {
  [ ! -f "$1" ] || { mkdir -p "$root$(dirname "$1")" && cp "$1" "$root$1"; }
}
for file in /etc/apt/sources.list.d/debian.sources /etc/apt/apt.conf.d/99* /etc/resolv.conf /etc/hosts /etc/pip.conf; do
  borrow "$file"
done
[ -f "$root/etc/apt/sources.list.d/debian.sources" ] && rm -f "$root/etc/apt/sources.list"
# Documents are required here, even if the image excludes them
rm -f "$root"/etc/dpkg/dpkg.cfg.d/*
mount --bind /dev "$root/dev"
mount -t proc proc "$root/proc"
mkdir -p "$root/root/packages" "$root/root/run"
cp "$packages"/*.deb "$packages"/*.whl "$root/root/packages"
cp -R "$top/examples" "$root/root/examples"
cp "$top/src/packaging/try_wheel.sh" "$root/root"
mkdir "$root/root/consumer"
cat > "$root/root/consumer/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.22)
project(consumer LANGUAGES C)
find_package(contact REQUIRED)
add_executable(manchester ../examples/library/manchester.c)
target_link_libraries(manchester PRIVATE contact::contact m)
END

echo "== a minimal system: $PRETTY_NAME"
try "there is no compiler" '! command -v cc gcc gfortran g++ && echo none'
try "lists of packages" 'apt-get update && apt-get install -y --no-install-recommends ca-certificates'
borrow /etc/ssl/certs/ca-certificates.crt

echo "== the wheel"
try "Python with venv" 'apt-get install -y --no-install-recommends python3-venv'
try "pip install" 'python3 -m venv clean && clean/bin/pip -q install packages/contact_mechanics-*.whl && clean/bin/pip list | grep -i contact'
try "its command, a wheel on a rail, examples" 'sh try_wheel.sh /root/clean/bin examples'
try "contact 2 experiment" 'cp examples/cattaneo.inp run/wheel.inp && cd run && ../clean/bin/contact 2 wheel && grep -c "FN" wheel.out'
try "its extras" 'clean/bin/pip -q install "$(ls packages/contact_mechanics-*.whl)[all]" && clean/bin/contact --hdf5 --output-dir run 2 examples/cattaneo &&
  clean/bin/contact report run/cattaneo && ls run | grep html'

echo "== packages for Debian"
try "apt install of the program alone" 'apt-get install -y --no-install-recommends ./packages/contact_*.deb && contact --version'
try "contact 2 experiment" 'cp examples/wheel_on_rail.inp run/experiment.inp && cp -R examples/profiles run && cd run && contact 2 experiment'
try "contact 3, explain, convert" 'cd run && contact 3 experiment && contact explain experiment > output.txt &&
  contact convert experiment.inp && contact 3 experiment.toml && test -s output.txt'
try "the report without its package says what is missing" 'cd run && ! contact report experiment 2> output.txt && grep -i "python" output.txt'
try "apt install of all" 'apt-get install -y ./packages/*.deb && dpkg -l | grep -c " contact\| libcontact\|python3-contact"'
try "the Python example" 'python3 examples/library/manchester.py'
try "a report" 'cd run && contact --hdf5 2 experiment && contact report experiment && ls *.html'
try "a study and a table" 'contact study --help > /dev/null && contact table --help | head -1'
try "the man page" 'apt-get install -y --no-install-recommends man-db > /dev/null && man contact | cat > man.txt && grep -c -- "--" man.txt'
try "completion" 'apt-get install -y --no-install-recommends bash-completion > /dev/null &&
  bash -c ". /usr/share/bash-completion/completions/contact; COMP_WORDS=(contact --hd); COMP_CWORD=1; _contact; test \"\${COMPREPLY[*]}\" = --hdf5 && echo \${COMPREPLY[*]}"'
try "the manual" 'test -s /usr/share/doc/contact/user/install.md && ls /usr/share/doc/contact/user | wc -l'
try "there is still no compiler" '! command -v cc gcc gfortran g++ && echo none'

echo "== the library from C, C++ and Fortran"
try "compilers" 'apt-get install -y --no-install-recommends gcc g++ gfortran libc6-dev cmake make pkg-config'
try "pkg-config, C" 'cc examples/library/manchester.c -o by_c $(pkg-config --cflags --libs contact) -lm && ./by_c examples/profiles'
try "pkg-config, Fortran" 'gfortran -c /usr/include/contact_addon.f90 && gfortran examples/library/creep_curve.f90 -o by_f $(pkg-config --cflags --libs contact) && ./by_f'
try "pkg-config, static library" 'apt-get install -y --no-install-recommends libfftw3-dev libhdf5-dev > /dev/null && mkdir -p static &&
  cp /usr/lib/*/libcontact.a static && cc examples/library/creep_curve.c -o by_s -Lstatic $(pkg-config --cflags --static --libs contact) && ./by_s'
try "CMake find_package" 'cmake -S consumer -B by_cmake > /dev/null && cmake --build by_cmake > /dev/null && ./by_cmake/manchester examples/profiles'
try "the same results" './by_c examples/profiles > a.txt && ./by_cmake/manchester examples/profiles > b.txt && cmp a.txt b.txt && echo same'
try "an old program, by the old name" 'cc examples/library/creep_curve.c -o by_name -L/usr/lib/contact -l:contact_addon_linux64.so -lm && LD_LIBRARY_PATH=/usr/lib/contact ./by_name'
try "removal leaves nothing" 'apt-get purge -y contact libcontact0 libcontact-dev python3-contact contact-matlab contact-doc > /dev/null && ! find /usr -path "*contact*" -not -path "*doc*" -name "*contact*" | grep -v "python3/dist-packages$" | grep . && echo clean'

echo "$failures failed"
[ "$failures" = 0 ]
