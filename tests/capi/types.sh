#!/bin/sh
# Type hints of the Python package by mypy --strict
set -eu
python3 -m mypy --version > /dev/null 2>&1 || { echo "skipped: mypy is not installed"; exit 77; }
work=$(pwd)
cd "$CONTACT_SOURCE/python"
exec python3 -m mypy --cache-dir "$work/cache" contact python_intfc
