#!/bin/sh
# A page of studies: its blocks, and as a notebook from its first to its last cell
# usage: notebook.sh PAGE.md
set -eu
has() {
  python3 -c "import $1" 2> /dev/null || {
    echo "skipped: packages of Python are missing, one of $1"
    exit 77
  }
}
has "scipy, xarray"
python3 "$CONTACT_SOURCE/doc/run_blocks.py" "$1"
has "nbclient, nbformat, ipykernel, matplotlib"
exec python3 "$CONTACT_SOURCE/doc/notebooks.py" "$PWD/notebooks" "$1"
