# Set-up shared by examples/run.sh and tests/run.sh; sourced by them with $top set to the checkout.
#
#   install_missing    installs the compiler, tools and libraries that are missing
#   install_octave     the same for GNU Octave, for tests of matlab/; continues without it
#   install_python_packages   the same for numpy, chromium and others, for tests only; continues without them
#   install_axe        the same for axe-core, for accessibility checks of the pages; continues without it
#   install_valgrind   the same for valgrind, for tests of uninitialised values; continues without it
#   install_locales    the same for the package locales, for tests of hosts in other languages; continues without it
#   install_linters    the same for fortitude, ruff, shellcheck and ford, for linting and module documentation
#   install_fuzzer     the same for libFuzzer, used by tests/fuzz/run.sh only
#   install_packagers  the same for the tools that make packages, used by src/packaging only
#   build PRESET [-DX] configures and builds into build/PRESET; all targets, or those of the build preset $build_targets
# shellcheck shell=sh disable=SC2154

say() { printf '%s\n' "== $*"; }
fail() { printf '%s\n' "$*" >&2; exit 1; }

# Use the first gfortran that is new enough, unless the caller set a compiler in FC. On some
# systems the plain name is an older version, and newer ones have the version in their names.
choose_compiler() {
  [ -n "${FC:-}" ] && return 0
  for candidate in gfortran gfortran-16 gfortran-15 gfortran-14 gfortran-13 gfortran-12; do
    major=$("$candidate" -dumpversion 2>/dev/null | cut -d. -f1)
    if [ "${major:-0}" -ge 12 ]; then
      FC=$candidate
      export FC
      return 0
    fi
  done
  return 1
}

# Can a Fortran program be compiled and linked with all dependencies of the build? Tested
# with the tools of the build, because package names do not show whether it works.
everything_there() {
  command -v cmake >/dev/null 2>&1 || return 1
  choose_compiler || return 1
  command -v cc >/dev/null 2>&1 || command -v gcc >/dev/null 2>&1 || return 1
  command -v ninja >/dev/null 2>&1 || command -v make >/dev/null 2>&1 || return 1
  command -v pkg-config >/dev/null 2>&1 || return 1
  command -v python3 >/dev/null 2>&1 || return 1
  probe=$(mktemp -d) || return 1
  cat >"$probe/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.22)
project(probe LANGUAGES Fortran C)
list(APPEND CMAKE_MODULE_PATH "$top/src/cmake")
include(dependencies)
END
  cmake -S "$probe" -B "$probe/build" >"$probe/log" 2>&1
  answer=$?
  rm -rf "$probe"
  return $answer
}

# Run a command as root: directly, or by sudo
as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo >/dev/null 2>&1; then
    sudo "$@"
  else
    fail "Packages are missing, and this user has neither root nor sudo rights. Please have these installed:
  $packages"
  fi
}

# $packages is deliberately a list of words
# shellcheck disable=SC2086
install_missing() {
  if everything_there; then
    return 0
  fi
  say "Installing what is missing"
  if command -v apt-get >/dev/null 2>&1; then
    packages="gfortran gcc libc6-dev make cmake ninja-build pkg-config python3
      libfftw3-dev libhdf5-dev"
    apt="env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends"
    # The package lists of a new machine are empty, those of an old one out of date
    as_root apt-get update ||
      say "apt-get update failed; trying with the package lists that are there"
    as_root $apt $packages && { choose_compiler || as_root $apt gfortran-12; }
  elif command -v dnf >/dev/null 2>&1; then
    packages="gcc-gfortran gcc make cmake ninja-build pkgconf-pkg-config python3
      fftw-devel hdf5-devel"
    as_root dnf install -y $packages
  elif command -v zypper >/dev/null 2>&1; then
    packages="gcc-fortran gcc make cmake ninja pkg-config python3
      fftw3-devel hdf5-devel"
    as_root zypper --non-interactive install $packages
  elif command -v pacman >/dev/null 2>&1; then
    packages="gcc-fortran gcc make cmake ninja pkgconf python fftw hdf5"
    as_root pacman -Sy --needed --noconfirm $packages
  elif command -v apk >/dev/null 2>&1; then
    packages="gfortran gcc musl-dev make cmake samurai pkgconf python3
      fftw-dev hdf5-dev"
    as_root apk add $packages
  elif command -v brew >/dev/null 2>&1; then
    brew install gcc cmake ninja pkg-config python3 fftw hdf5
  else
    fail "No package manager found (apt-get, dnf, zypper, pacman, apk, brew). Please install:
gfortran >= 12, a C compiler, cmake >= 3.22, ninja or make, pkg-config, python3 and the
development files of FFTW 3 and HDF5 with its Fortran interface."
  fi || fail "The package manager could not install what is missing; see its messages above."
  everything_there || fail "Packages were installed, but a build cannot be configured yet. To see
why: cmake --preset release (in $top)"
}

# Octave with graphics, and a virtual X server. Tests of matlab/ are skipped without them.
octave_there() {
  command -v octave-cli >/dev/null 2>&1 && command -v mkoctfile >/dev/null 2>&1 && command -v Xvfb >/dev/null 2>&1
}

# shellcheck disable=SC2086
install_octave() {
  octave_there && return 0
  # never prompts for a password
  if [ "$(id -u)" != 0 ] && ! sudo -n true 2>/dev/null; then
    say "GNU Octave or Xvfb is missing; tests of matlab/ are skipped"
    return 0
  fi
  say "Installing GNU Octave for the tests of matlab/"
  if command -v apt-get >/dev/null 2>&1; then
    packages="octave octave-dev xvfb libgl1-mesa-dri fonts-freefont-otf"
    as_root apt-get update ||
      say "apt-get update failed; trying with the package lists that are there"
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $packages
  elif command -v dnf >/dev/null 2>&1; then
    packages="octave octave-devel xorg-x11-server-Xvfb mesa-dri-drivers"
    as_root dnf install -y $packages
  elif command -v zypper >/dev/null 2>&1; then
    packages="octave octave-devel xorg-x11-server-Xvfb Mesa-dri"
    as_root zypper --non-interactive install $packages
  elif command -v pacman >/dev/null 2>&1; then
    packages="octave xorg-server-xvfb mesa"
    as_root pacman -S --needed --noconfirm $packages
  elif command -v apk >/dev/null 2>&1; then
    packages="octave octave-dev xvfb mesa-dri-gallium ttf-freefont"
    as_root apk add $packages
  fi
  octave_there || say "GNU Octave could not be installed; tests of matlab/ are skipped"
}

# Packages for the tests of Python: numpy and h5py to run, pip, setuptools and wheel to install the package, mypy for its types,
# playwright for the browser, matplotlib, xarray, h5netcdf and jsonschema for results, pytest and the rest for studies. setuptools
# is imported first: it must precede the distutils that it replaces
python_modules="setuptools, numpy, h5py, pip, wheel, mypy, playwright, matplotlib, xarray, h5netcdf, jsonschema"
study_modules="pytest, scipy, pandas, pyarrow, netCDF4, zarr, distributed, nbclient, ipykernel"
has_python_packages() { python3 -c "import $python_modules, $study_modules" >/dev/null 2>&1; }

# Packages in the folder below build have priority
use_python_packages() {
  [ -x "$top/build/python/bin/python3" ] && PATH=$top/build/python/bin:$PATH
  export PATH
}

# Installed from packages of the system, or in a folder below build
install_python_packages() {
  # Installed by an earlier run
  use_python_packages
  if has_python_packages; then
    return 0
  fi
  say "Installing packages of Python for the tests"
  if command -v apt-get >/dev/null 2>&1 && { [ "$(id -u)" = 0 ] || sudo -n true 2>/dev/null; }; then
    packages="python3-numpy python3-h5py python3-pip python3-setuptools python3-wheel python3-venv python3-mypy python3-matplotlib python3-xarray python3-h5netcdf chromium"
    # shellcheck disable=SC2086
    { as_root apt-get update
      as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $packages
    } || say "apt-get could not install $packages"
  fi
  if has_python_packages; then
    return 0
  fi
  { [ -x "$top/build/python/bin/python3" ] || python3 -m venv "$top/build/python"; } &&
    "$top/build/python/bin/python3" -m pip install --quiet numpy h5py setuptools wheel mypy playwright matplotlib xarray h5netcdf jsonschema \
      pytest scipy pandas pyarrow netCDF4 zarr distributed nbclient ipykernel
  use_python_packages
  has_python_packages || say "Packages of Python are missing; tests that need them will be skipped"
}

# Install a Debian package without a password prompt
quiet_apt() {
  command -v apt-get >/dev/null 2>&1 && { [ "$(id -u)" = 0 ] || sudo -n true 2>/dev/null; } || return 1
  packages=$1
  as_root apt-get update || say "apt-get update failed; trying with the package lists that are there"
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$packages"
}

# The version used to check the pages
axe=4.14.1
install_axe() {
  grep -q "\"version\": \"$axe\"" "$top/build/axe/node_modules/axe-core/package.json" 2>/dev/null && return 0
  say "Installing axe-core for the tests"
  if ! command -v npm >/dev/null 2>&1; then
    quiet_apt npm || say "npm could not be installed"
  fi
  npm install --prefix "$top/build/axe" --ignore-scripts --no-audit --no-fund --silent "axe-core@$axe" ||
    say "axe-core could not be installed; tests of the pages run without it"
}

install_valgrind() {
  command -v valgrind >/dev/null 2>&1 && return 0
  say "Installing valgrind for the tests"
  quiet_apt valgrind || say "valgrind could not be installed; tests that need it are skipped"
}

install_locales() {
  [ -e /usr/share/i18n/locales/de_DE ] && return 0
  say "Installing descriptions of languages for the tests"
  quiet_apt locales || say "locales could not be installed; tests in other languages are skipped"
}

# The versions used to check the sources; they are in a separate folder, so that python3 is not changed
linters="fortitude-lint==0.10.0 ruff==0.17.6 ford==7.0.13"
install_linters() {
  if ! command -v shellcheck >/dev/null 2>&1; then
    say "Installing shellcheck for the tests"
    quiet_apt shellcheck || say "shellcheck could not be installed; its test is skipped"
  fi
  bin=$top/build/lint/bin
  [ "$(cat "$top/build/lint/versions" 2>/dev/null)" = "$linters" ] && [ -x "$bin/ruff" ] && [ -x "$bin/fortitude" ] && [ -x "$bin/ford" ] && return 0
  say "Installing fortitude, ruff and ford for the tests"
  [ -x "$bin/python3" ] || python3 -m venv "$top/build/lint"
  # shellcheck disable=SC2086
  if "$bin/python3" -m pip install --quiet $linters; then
    printf '%s\n' "$linters" >"$top/build/lint/versions"
  else
    say "fortitude, ruff and ford could not be installed; their tests are skipped"
  fi
}

install_fuzzer() {
  ls /usr/lib/llvm-*/lib/libFuzzer.a >/dev/null 2>&1 && return 0
  say "Installing libFuzzer"
  quiet_apt libfuzzer-14-dev || fail "libFuzzer is missing; install the package libfuzzer-14-dev or a later version"
}

# A wheel needs a C++ compiler and environments of Python, a Debian package the tools of its control file
install_packagers() {
  command -v apt-get >/dev/null 2>&1 || return 0
  packages="g++ python3-venv"
  command -v dpkg-buildpackage >/dev/null 2>&1 && packages="$packages debhelper dh-python"
  # shellcheck disable=SC2086
  dpkg -s $packages >/dev/null 2>&1 && return 0
  say "Installing the tools of packages"
  as_root apt-get update || say "apt-get update failed; trying with the package lists that are there"
  # shellcheck disable=SC2086
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $packages ||
    fail "The tools of packages could not be installed: $packages"
}

# build PRESET [options of cmake]
# A folder that has been configured keeps its generator.
build_targets=
build() {
  preset=$1
  shift
  generator=
  if [ ! -f "$top/build/$preset/CMakeCache.txt" ] && command -v ninja >/dev/null 2>&1; then
    generator="-G Ninja"
  fi
  say "Building ($preset)"
  # shellcheck disable=SC2086
  (cd "$top" && cmake --preset "$preset" $generator "$@" && cmake --build --preset "${build_targets:-$preset}" -j "$jobs") ||
    fail "The build failed; see its messages above."
}

jobs=${CONTACT_JOBS:-2}
