#!/bin/sh
# Makes the site of the manual in build/site: all pages of doc with a menu and a search, to be read without a network. A warning, such as a
# link to nothing, is an error. The tools of Python come into build/site-tools once. Where the program is built, the tutorials are
# executed as notebooks beside it, and their pictures stand in the pages. Usage: build.sh [FOLDER]
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
# Nothing is fetched by a reader's browser
if grep -rlE '<(script|link|img)[^>]*(src|href)="https?://' "$out" --include='*.html'; then
  echo "The pages above load something from the network" >&2
  exit 1
fi
echo "$out/index.html"
