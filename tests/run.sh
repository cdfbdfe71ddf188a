#!/bin/sh
# Install what is missing, build, run all tests: sh tests/run.sh [--long] [--debug] [--werror], or --sanitize alone
#
#   --long     also the long studies (label long)
#   --debug    with all run-time checks (preset debug) instead of optimised
#   --werror   compiler warnings are errors, as in CI
#   --sanitize all suites that can, under the address, undefined-behaviour and thread sanitizers and valgrind; takes an hour
# The exit status is that of ctest.
set -u
top=$(cd "$(dirname "$0")/.." && pwd) || exit 1
. "$top/tests/support/setup.sh"

preset=release
werror=OFF
[ -n "${CI:-}" ] && werror=ON
exclude="-LE ^long$"
sanitize=
for argument; do
  case $argument in
    --long) exclude= ;;
    --debug) preset=debug ;;
    --werror) werror=ON ;;
    --sanitize) sanitize=yes ;;
    *) fail "usage: sh tests/run.sh [--long] [--debug] [--werror] [--sanitize]" ;;
  esac
done

install_missing
install_octave
install_python_packages
install_axe
install_valgrind
install_linters
if [ -n "$sanitize" ]; then
  . "$top/tests/support/sanitize.sh"
fi
build "$preset" -DCONTACT_TESTS=ON -DCONTACT_WERROR=$werror
say "Testing"
cd "$top/build/$preset" || exit 1
# shellcheck disable=SC2086
exec ctest --output-on-failure -j2 $exclude
