#!/bin/sh
# Lint one language: sh lint.sh fortran|python|shell. Exit status 0: no finding; 77: the tool is not installed
#
# The rules, with reasons of those that are disabled, are in .fortitude.toml, .ruff.toml and .shellcheckrc.
set -u
cd "$CONTACT_SOURCE" || exit 1
# installed there by tests/support/setup.sh
PATH=$CONTACT_SOURCE/build/lint/bin:$PATH
skip() { echo "SKIPPED: $1 is not installed; sh tests/run.sh installs it"; exit 77; }

case ${1:-} in
  fortran)
    command -v fortitude >/dev/null 2>&1 || skip fortitude
    exec fortitude check --output-format concise src examples tests
    ;;
  python)
    command -v ruff >/dev/null 2>&1 || skip ruff
    exec ruff check --no-cache --output-format concise .
    ;;
  shell)
    command -v shellcheck >/dev/null 2>&1 || skip shellcheck
    find examples tests src .ci -name '*.sh' -o -path '.ci/*' -type f | sort | xargs shellcheck --format gcc
    ;;
  *)
    echo "usage: lint.sh fortran|python|shell"
    exit 1
    ;;
esac
