#!/bin/sh
# A wheel of the Python package with the library in it, installed and used far from the checkout
# usage: wheel.sh LIBRARY
set -eu
python3 -c "import numpy" 2> /dev/null || { echo "skipped: numpy is not installed"; exit 77; }
python3 -c "import setuptools.command.bdist_wheel" 2> /dev/null || python3 -c "import setuptools, wheel" 2> /dev/null || {
  echo "skipped: setuptools with wheel is not installed"
  exit 77
}
rm -rf source wheels target
cp -R "$CONTACT_SOURCE/python" source
rm -rf source/build source/*.egg-info
cp -L "$1" source/contact/libcontact.so
python3 -m pip wheel --quiet --no-deps --no-index --no-build-isolation --wheel-dir wheels ./source
python3 -m pip install --quiet --no-deps --no-index --target target ./wheels/*.whl
unset CONTACT_LIBRARY
PYTHONPATH=$PWD/target python3 - << 'END'
import contact
import contact._library
with contact.Problem() as ball:
    ball.set_material(g=82000.0, nu=0.28)
    ball.set_friction(0.3)
    ball.set_hertz(15, 15, aa=5.0, bb=5.0)
    ball.set_normal_force(50e3)
    ball.set_creepages(0.1)
    result = ball.solve()
assert abs(result.fx + 0.3 * 50e3) < 1.0, result.fx
assert "target" in contact._library.library()._name, contact._library.library()._name
print("wheel: passed")
END
