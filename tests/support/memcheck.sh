#!/bin/sh
# A command under valgrind: no access beyond what was allocated, no decision by a value that was never set, no memory lost
#
# usage: memcheck.sh PROGRAM ARGUMENTS...
command -v valgrind >/dev/null 2>&1 || { echo "valgrind is not installed"; exit 77; }
exec valgrind --quiet --error-exitcode=9 --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite "$@"
