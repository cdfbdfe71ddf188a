#!/bin/sh
# The Python package, installed by pip with the library, and used outside the checkout
# usage: wheel.sh LIBRARY
set -eu
python3 -c "import numpy" 2> /dev/null || { echo "skipped: numpy is not installed"; exit 77; }
python3 -c "import pip" 2> /dev/null || { echo "skipped: pip is not installed"; exit 77; }
python3 -c "import setuptools.command.bdist_wheel" 2> /dev/null || python3 -c "import setuptools, wheel" 2> /dev/null || {
  echo "skipped: setuptools with wheel is not installed"
  exit 77
}
rm -rf source wheels target checkout
cp -R "$CONTACT_SOURCE/python" source
rm -rf source/build source/*.egg-info source/contact/*.so
export PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_ROOT_USER_ACTION=ignore

# use FOLDER: solve a case with the package in the folder
use() {
  PYTHONPATH=$PWD/$1 python3 - "$1" << 'END'
import sys
import contact
import contact._library
import python_intfc
with contact.Problem() as ball:
    ball.set_material(g=82000.0, nu=0.28)
    ball.set_friction(0.3)
    ball.set_hertz(15, 15, aa=5.0, bb=5.0)
    ball.set_normal_force(50e3)
    ball.set_creepages(0.1)
    result = ball.solve()
    assert python_intfc.getnumelements(ball.number, 1) == (15, 15)
assert abs(result.fx + 0.3 * 50e3) < 1.0, result.fx
assert f"/{sys.argv[1]}/" in contact._library.library()._name, contact._library.library()._name
END
}

echo "-- pip install uses the library named by CONTACT_LIBRARY"
CONTACT_LIBRARY=$1 python3 -m pip install --quiet --no-deps --no-index --no-build-isolation --target target/own ./source
unset CONTACT_LIBRARY
(use target/own)

echo "-- or the one of build/release of the checkout, by a platform-specific wheel"
mkdir -p checkout/build/release/lib
cp -L "$1" checkout/build/release/lib/libcontact.so
rm -rf checkout/python source/build source/*.egg-info
mv source checkout/python
python3 -m pip wheel --quiet --no-deps --no-index --no-build-isolation --wheel-dir wheels ./checkout/python
case $(ls wheels) in
  *-any.whl) echo "the wheel is not marked as platform-specific"; exit 1 ;;
esac
python3 -m pip install --quiet --no-deps --no-index --target target/wheel ./wheels/*.whl
rm -rf checkout
(use target/wheel)
echo "wheel: passed"
