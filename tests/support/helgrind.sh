#!/bin/sh
# Run a command under helgrind, without data races between threads
#
# usage: helgrind.sh LIBRARY_OF_LOCKS PROGRAM ARGUMENTS...
command -v valgrind >/dev/null 2>&1 || { echo "valgrind is not installed"; exit 77; }
locks=$1
shift
exec env LD_PRELOAD="$locks" valgrind --tool=helgrind --quiet --error-exitcode=9 \
  --suppressions="$(dirname "$0")/helgrind.supp" "$@"
