#!/bin/sh
# Install into a scratch folder, then build and run a C program against it in three ways:
# CMake package, pkg-config with the shared library, pkg-config with the static one
# usage: consumer.sh BUILD_FOLDER C_COMPILER
set -eu
build=$1
compiler=$2
here=$(cd "$(dirname "$0")" && pwd)
work=$(pwd)
rm -rf prefix cmake_build results
cmake --install "$build" --prefix "$work/prefix" > install.log

echo "-- installed files"
for file in bin/contact include/contact.h share/licenses/contact/LICENSE; do
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
  test -s "results/$1/cattaneo.out" || { echo "no results/$1/cattaneo.out"; exit 1; }
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

echo "-- pkg-config, static library"
mkdir -p static
cp "$library_folder/libcontact.a" static
flags=$(pkg-config --cflags --static --libs contact)
eval "\"\$compiler\" \"\$here/consumer/consumer.c\" -o consumer_static -Lstatic $flags"
run static ./consumer_static
