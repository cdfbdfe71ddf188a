#!/bin/sh
# Tests of studies in one file, run by pytest
# usage: study.sh FILE
set -eu
python3 -c "import pytest, scipy, pandas, pyarrow, netCDF4, zarr, distributed, xarray" 2> /dev/null || {
  echo "skipped: packages of Python for studies are missing"
  exit 77
}
PYTHONPATH="$CONTACT_SOURCE/python:$CONTACT_SOURCE/tests/study${PYTHONPATH:+:$PYTHONPATH}" PYTHONDONTWRITEBYTECODE=1 \
  exec python3 -m pytest -q -p no:cacheprovider --basetemp="$PWD/pytest" -W error::UserWarning "$1"
