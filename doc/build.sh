#!/bin/sh
# Build the site of the manual in build/site: all pages of doc with a menu and a search, readable offline. Warnings, such as broken
# links, are errors. Python tools are installed into build/site-tools once. If the program has been built, the tutorials are
# executed as notebooks and their plots are included in the pages. Usage: build.sh [FOLDER]
set -eu
top=$(cd "$(dirname "$0")/.." && pwd)
out=${1:-$top/build/site}
tools=$top/build/site-tools
python=${CONTACT_SITE_PYTHON:-$tools/bin/python3}
if ! "$python" -c "import sphinx, myst_parser, furo, latex2mathml, nbformat, nbclient, ipykernel, numpy, h5py, matplotlib, xarray, scipy" 2> /dev/null; then
  python3 -m venv "$tools"
  "$tools/bin/pip" -q install "sphinx>=7" "myst-parser>=3" furo latex2mathml nbformat nbclient ipykernel numpy h5py matplotlib xarray scipy
  python=$tools/bin/python3
fi
rm -rf "$out"
if [ -x "${CONTACT_PROGRAM:-$top/build/release/bin/contact}" ]; then
  made=$(mktemp -d)
  trap 'rm -rf "$made"' EXIT
  export CONTACT_NOTEBOOKS="$made/site/notebooks"
  (cd "$top" && "$python" doc/notebooks.py "$CONTACT_NOTEBOOKS" doc/user/tutorials/*.md)
else
  echo "No notebooks: build/release has no program" >&2
fi
"$python" -m sphinx -q -W --keep-going -b html -d "$(mktemp -d)" "$top/doc" "$out"
# A reader's browser must not load anything from the network
if grep -rlE '<(script|link|img)[^>]*(src|href)="https?://' "$out" --include='*.html'; then
  echo "The pages above load something from the network" >&2
  exit 1
fi
echo "$out/index.html"
