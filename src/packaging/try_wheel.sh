#!/bin/sh
# Test an installed wheel: the program, a wheel on a rail, and an example of the library
# Usage: try_wheel.sh BIN EXAMPLES; BIN is the folder of its python, EXAMPLES that of the examples
set -eu
bin=$1
examples=$(cd "$2" && pwd)
unset CONTACT_LIBRARY PYTHONPATH CONTACT_PYTHON
cd "$(mktemp -d)"
"$bin/contact" --version
# linking must be permitted for proprietary programs
"$bin/contact" --version | grep -q "transforms by pocketfft"
"$bin/contact" --quiet --output-dir . 2 "$examples/wheel_on_rail"
grep -q "10 cases: 10 solved" wheel_on_rail.out || grep -q "TOTAL FORCES ON RAIL" wheel_on_rail.out
"$bin/python" "$examples/library/manchester.py" > manchester.txt
tail -3 manchester.txt
"$bin/python" - <<'PY'
import contact
with contact.Problem() as problem:
    problem.set_material(g=82000.0, nu=0.28)
    problem.set_friction(0.3)
    problem.set_hertz(25, 25, aa=6.0, bb=6.0)
    problem.set_normal_force(80e3)
    problem.set_creepages(0.001)
    result = problem.solve()
# result of refinement to 100 x 100 elements
assert abs(result.fx + 10592.0) < 20.0, result.fx
print("library inside the wheel: FX", round(result.fx))
PY
