#!/bin/sh
# A page on studies: its code blocks, and the whole page as a notebook
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
