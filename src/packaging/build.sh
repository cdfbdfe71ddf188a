#!/bin/sh
# All packages that can be built here: a wheel for Python with its source distribution, and one for Debian; installs what is missing.
# Usage: build.sh [FOLDER]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
top=$(cd "$here/../.." && pwd)
. "$top/tests/support/setup.sh"
install_missing
install_packagers
sh "$here/wheel.sh" "$@"
if command -v dpkg-buildpackage > /dev/null; then
  sh "$here/deb.sh" "$@"
fi
