#!/bin/sh
# Run a command under valgrind: no access outside allocated memory, no branch on an uninitialised value, no memory leak
#
# usage: memcheck.sh PROGRAM ARGUMENTS...
command -v valgrind >/dev/null 2>&1 || { echo "valgrind is not installed"; exit 77; }
exec valgrind --quiet --error-exitcode=9 --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite "$@"
