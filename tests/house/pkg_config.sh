#!/bin/sh
# contact.pc where the folder of libraries is an absolute path, as some distributions give it, and has blanks: the folders that
# pkg-config returns are those of the installation, also after it was moved. Only configured, not built
# usage: pkg_config.sh SOURCE FORTRAN_COMPILER C_COMPILER
set -eu
work=$(pwd)
rm -rf build "a prefix" moved
prefix="$work/a prefix"
cmake -S "$1" -B "$work/build" -DCMAKE_Fortran_COMPILER="$2" -DCMAKE_C_COMPILER="$3" -DCONTACT_TESTS=OFF -DCONTACT_FFT=fftw \
  "-DCMAKE_INSTALL_PREFIX=$prefix" "-DCMAKE_INSTALL_LIBDIR=$prefix/lib/some cpu" "-DCMAKE_INSTALL_INCLUDEDIR=$prefix/include/deeper" > cmake.log
command -v pkg-config > /dev/null 2>&1 || { echo "SKIPPED: pkg-config is not installed"; exit 77; }
for place in "$prefix" "$work/moved"; do
  mkdir -p "$place/lib/some cpu/pkgconfig" "$place/include/deeper"
  cp build/contact.pc "$place/lib/some cpu/pkgconfig"
  PKG_CONFIG_PATH="$place/lib/some cpu/pkgconfig"
  export PKG_CONFIG_PATH
  for variable in "prefix:$place" "libdir:$place/lib/some cpu" "includedir:$place/include/deeper"; do
    # a list of words for the shell, which has escaped blanks
    found=$(eval "printf '%s' $(pkg-config "--variable=${variable%%:*}" contact | sed 's/\([^\\]\) /\1\\ /g')")
    found=$(cd "$found" && pwd)
    [ "$found" = "${variable#*:}" ] || { echo "${variable%%:*} is $found, not ${variable#*:}"; exit 1; }
  done
  # files of libraries that static linking needs
  eval "set -- $(pkg-config --static --libs contact)"
  for word in "$@"; do
    case $word in
      /*) [ -e "$word" ] || { echo "there is no $word"; exit 1; } ;;
    esac
  done
done
echo "contact.pc: passed"
