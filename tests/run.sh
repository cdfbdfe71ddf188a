#!/bin/sh
# Install what is missing, build, run all tests: sh tests/run.sh [--long] [--debug] [--werror], or --sanitize alone
#
#   --long     include the long studies (label long)
#   --debug    with all run-time checks (preset debug) instead of optimised
#   --werror   compiler warnings are errors, as in CI
#   --sanitize all suitable tests under the address, undefined-behaviour and thread sanitizers and valgrind; takes an hour
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

install_for_tests() {
  install_octave
  install_python_packages
  install_axe
  install_valgrind
  install_locales
  install_linters
}

# Wait for the installation, and use the Python that it has found or created
finish_installation() {
  wait "$installation"
  trap - EXIT INT TERM
  cat "$messages"
  use_python_packages
}

install_missing
# Packages that only tests use are installed during the build; their messages are shown afterwards
mkdir -p "$top/build"
messages=$top/build/installation.txt
install_for_tests >"$messages" 2>&1 </dev/null &
installation=$!
trap 'kill "$installation" 2>/dev/null' EXIT
trap 'exit 1' INT TERM
if [ -n "$sanitize" ]; then
  finish_installation
  . "$top/tests/support/sanitize.sh"
fi
build "$preset" -DCONTACT_TESTS=ON -DCONTACT_WERROR=$werror
finish_installation
say "Testing"
cd "$top/build/$preset" || exit 1
# One test more than there are processors, because some wait for a browser, a worker or a server
# shellcheck disable=SC2086
exec ctest --output-on-failure -j$(($(nproc) + 1)) $exclude
