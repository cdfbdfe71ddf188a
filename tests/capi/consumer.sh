#!/bin/sh
# Install into a temporary folder, then build and run third-party programs with it: by the CMake package, by pkg-config
# with the shared and the static library, and by the file names of the published library
# usage: consumer.sh BUILD_FOLDER C_COMPILER FORTRAN_COMPILER
# shellcheck disable=SC2086  # options are lists of words
set -eu
build=$1
compiler=$2
fortran=$3
here=$(cd "$(dirname "$0")" && pwd)
work=$(pwd)
rm -rf prefix cmake_build results
cmake --install "$build" --prefix "$work/prefix" > install.log

echo "-- installed files"
for file in bin/contact include/contact.h include/contact_addon.h include/caddon_flags.h include/caddon_flags.inc \
  include/contact_addon.ifc include/contact_addon.f90 share/licenses/contact/LICENSE; do
  test -f "prefix/$file" || { echo "not installed: $file"; exit 1; }
done
if [ -n "$(find prefix -name '*.mod')" ]; then
  echo "module files are installed, but only the C interface is public"
  exit 1
fi
library_folder=$(dirname "$(find "$work/prefix" -name libcontact.a)")
prefix/bin/contact --version

echo "-- licence notices of included libraries"
ldd prefix/bin/contact | grep -q libhdf5 || grep -qi "hdf *group" prefix/share/licenses/contact/HDF5
case $(prefix/bin/contact --version) in
  *pocketfft*) grep -q "Max-Planck" prefix/share/licenses/contact/pocketfft ;;
esac

# run NAME PROGRAM
run() {
  mkdir -p "results/$1"
  "$2" "$CONTACT_SOURCE/examples/cattaneo" "results/$1"
  for suffix in out jsonl h5 pvd; do
    test -s "results/$1/cattaneo.$suffix" || { echo "no results/$1/cattaneo.$suffix"; exit 1; }
  done
}

echo "-- CMake package"
cmake -S "$here/consumer" -B cmake_build -DCMAKE_PREFIX_PATH="$work/prefix" \
  -DCMAKE_C_COMPILER="$compiler" > cmake.log
cmake --build cmake_build >> cmake.log
run cmake cmake_build/consumer

include=$work/prefix/include
strict="-Wall -Wextra -Wpedantic -Werror"
# same NAME PROGRAM: its output is that of the first program
same() {
  "$2" > "$1.txt"
  cmp stranger.txt "$1.txt"
}
echo "-- file names of the published library, linked by name, by path, and as libcontact"
"$compiler" -std=c90 $strict -I"$include" "$here/consumer/stranger.c" -o stranger_name -L"$work/prefix/bin" \
  -l:contact_addon_linux64.so -lm
# no other folder is searched
mkdir -p swapped
cp "$work/prefix/bin/contact_addon_linux64.so" swapped
LD_LIBRARY_PATH=$work/swapped ./stranger_name > stranger.txt
"$compiler" -std=c99 $strict -I"$include" "$here/consumer/stranger.c" -o stranger_path \
  "$work/prefix/bin/contact_addon_linux64.so" -lm
same stranger_path ./stranger_path
"$compiler" -I"$include" "$here/consumer/stranger.c" -o stranger_lib -L"$library_folder" "-Wl,-rpath,$library_folder" -lcontact -lm
same stranger_lib ./stranger_lib
if command -v c++ > /dev/null 2>&1; then
  c++ -x c++ $strict -I"$include" "$here/consumer/stranger.c" -x none -o stranger_plus "$work/prefix/bin/contact_addon_linux64.so"
  same stranger_plus ./stranger_plus
else
  echo "-- no C++ compiler: the headers are not tested with C++"
fi
"$fortran" -cpp -fopenmp -I"$include" "$here/consumer/stranger.F90" -o stranger_fortran -L"$work/prefix/bin" \
  -l:contact_addon_linux64.so "-Wl,-rpath,$work/prefix/bin"
same stranger_fortran ./stranger_fortran

echo "-- loaded and unloaded by its file name"
"$compiler" -std=c99 -D_POSIX_C_SOURCE=200112L $strict "$here/consumer/loader.c" -o loader -ldl
for _ in 1 2 3 4 5 6 7 8; do
  OMP_NUM_THREADS=4 ./loader "$work/prefix/bin/contact_addon_linux64.so"
done

echo "-- Python from the installation"
if python3 -c "import numpy" 2> /dev/null; then
  (unset CONTACT_LIBRARY
  PYTHONPATH=$work/prefix/share/contact/python python3 -c "
import python_intfc as cntc
CNTC, ifcver, ierror = cntc.initlibrary(expnam='installed')
assert ifcver >= 2500 and ierror == 0 and CNTC['if_units'] == 1933
import contact._library
assert '$work/prefix/bin/' in contact._library.library()._name
cntc.closelibrary()")
else
  echo "-- numpy is not installed: the Python package is not tested"
fi

if ! command -v pkg-config > /dev/null 2>&1; then
  echo "-- pkg-config is not installed: shared and static linking by pkg-config are not tested"
  exit 0
fi
PKG_CONFIG_PATH=$library_folder/pkgconfig
export PKG_CONFIG_PATH

# pkg-config escapes blanks in paths for the shell, so its output is read by eval
echo "-- pkg-config, shared library"
flags=$(pkg-config --cflags --libs contact)
eval "\"\$compiler\" -Wall -Wextra -Werror \"\$here/consumer/consumer.c\" -o consumer_shared $flags" \
  '"-Wl,-rpath,$library_folder"'
run shared ./consumer_shared

# build_caller NAME COMPILER FILES: calls of routines of the library, without module files of the library
build_caller() {
  name=$1
  # shellcheck disable=SC2034  # eval reads it
  with=$2
  shift 2
  eval "\"\$with\" \"\$@\" -o \"caller_\$name\" $flags" '"-Wl,-rpath,$library_folder"'
  "./caller_$name" > "caller_$name.txt"
}
examples=$CONTACT_SOURCE/examples/library
echo "-- pkg-config, routines from C, Fortran with the module, old Fortran"
build_caller c "$compiler" "$examples/creep_curve.c"
build_caller module "$fortran" "$work/prefix/include/contact_addon.f90" "$examples/creep_curve.f90"
cmp caller_c.txt caller_module.txt
build_caller fixed "$fortran" "$here/consumer/fixed.F"
if command -v c++ > /dev/null 2>&1; then
  # shellcheck disable=SC2086
  eval "c++ \$strict \"\$here/consumer/plus.cpp\" -o caller_plus $flags" '"-Wl,-rpath,$library_folder"'
  ./caller_plus
fi

echo "-- pkg-config, static library"
mkdir -p static
cp "$library_folder/libcontact.a" static
flags=$(pkg-config --cflags --static --libs contact)
eval "\"\$compiler\" \"\$here/consumer/consumer.c\" -o consumer_static -Lstatic $flags"
run static ./consumer_static
