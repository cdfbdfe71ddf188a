#!/bin/sh
# The site of the manual: doc/build.sh builds it without a network, without warnings and without broken links.
# Exit status 77: its tools are not installed (doc/build.sh installs them into build/site-tools).
set -eu
top=${CONTACT_SOURCE}
here=$(cd "$(dirname "$0")" && pwd)
python=${CONTACT_SITE_PYTHON:-$top/build/site-tools/bin/python3}
if ! "$python" -c "import sphinx, myst_parser, furo, latex2mathml, nbclient, ipykernel, h5py, matplotlib, xarray, scipy" 2>/dev/null; then
  echo "SKIPPED: the tools for the site are not installed (sh doc/build.sh installs them)"
  exit 77
fi
# a separate network namespace has the loopback interface only, which notebooks need
if unshare -n sh -c "ip link set lo up" 2>/dev/null; then
  unshare -n sh -c "ip link set lo up && exec sh '$top/doc/build.sh' '$PWD/site'"
else
  echo "No network namespace: the network is not disabled"
  sh "$top/doc/build.sh" "$PWD/site"
fi
exec "$python" "$here/site_links.py" "$PWD/site" "$top/doc"
