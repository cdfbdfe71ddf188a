#!/bin/sh
# Install into a scratch folder, then build and run a C program against it in three ways:
# CMake package, pkg-config with the shared library, pkg-config with the static one
# usage: consumer.sh BUILD_FOLDER C_COMPILER FORTRAN_COMPILER
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
  echo "module files are installed, but the contract is the C interface"
  exit 1
fi
library_folder=$(dirname "$(find "$work/prefix" -name libcontact.a)")
prefix/bin/contact --version

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

if ! command -v pkg-config > /dev/null 2>&1; then
  echo "-- no pkg-config here, its two ways are not tried"
  exit 0
fi
PKG_CONFIG_PATH=$library_folder/pkgconfig
export PKG_CONFIG_PATH

# pkg-config escapes blanks in paths for the shell, so its answer is read by eval
echo "-- pkg-config, shared library"
flags=$(pkg-config --cflags --libs contact)
eval "\"\$compiler\" -Wall -Wextra -Werror \"\$here/consumer/consumer.c\" -o consumer_shared $flags" \
  '"-Wl,-rpath,$library_folder"'
run shared ./consumer_shared

# caller NAME COMPILER FILES: the library's routines, which need no module file of ours
caller() {
  name=$1
  with=$2
  shift 2
  eval "\"\$with\" \"\$@\" -o \"caller_\$name\" $flags" '"-Wl,-rpath,$library_folder"'
  "./caller_$name" > "caller_$name.txt"
}
examples=$CONTACT_SOURCE/examples/library
echo "-- pkg-config, routines from C, Fortran with the module, old Fortran"
caller c "$compiler" "$examples/creep_curve.c"
caller module "$fortran" "$work/prefix/include/contact_addon.f90" "$examples/creep_curve.f90"
cmp caller_c.txt caller_module.txt
caller fixed "$fortran" "$here/consumer/fixed.F"
if command -v c++ > /dev/null 2>&1; then
  caller plus c++ "$here/consumer/plus.cpp"
else
  echo "-- no C++ compiler here, its headers are not tried"
fi

echo "-- pkg-config, static library"
mkdir -p static
cp "$library_folder/libcontact.a" static
flags=$(pkg-config --cflags --static --libs contact)
eval "\"\$compiler\" \"\$here/consumer/consumer.c\" -o consumer_static -Lstatic $flags"
run static ./consumer_static
