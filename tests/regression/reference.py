#!/usr/bin/env python3
"""Run the reference inputs that this version can solve and compare with the published outputs.

The reference data are not part of the project. Where they are absent the test is skipped (status 77).
"""
import os
import subprocess
import sys

# inputs of which every case agrees; the others are listed in doc/validation/deviations.md. The comparison stops
# at a case of tractcurv in which energy and power are both 0
INPUTS = ["examples/" + name for name in (
    "cattaneo", "carter2d", "bentall", "catt_to_cart", "spence35", "subsurf", "veldep_fric", "ertz_temperature", "fastsim",
    "plastic_3bl", "visc_cylindr", "mbench_a22_left", "mbench_a22_right")] + \
    ["testbank/examples_plast/" + name for name in ("carter_plast", "catt2d_plast", "catt3d_plast",
                                                      "mbench_a22_left")] + \
    ["testbank/examples_trans/m1_" + name for name in ("catt_shift", "steady_roll", "totforce", "trans_dqrel", "trans_roll")] + \
    ["testbank/examples_conformal/groove_li"] + \
    ["testbank/examples_temp/m3_tempdep"] + ["testbank/examples_s+c/" + name for name in ("cross_locus", "wing_locus")]

reference = os.environ["CONTACT_REFERENCE"]
tool = os.path.join(os.path.dirname(os.path.normpath(reference)), "tools", "check_reference.py")
if not (os.path.isdir(os.path.join(reference, "examples")) and os.path.isfile(tool)):
    print("SKIPPED: no reference data in %s" % reference)
    sys.exit(77)
command = [sys.executable, "-B", tool, os.environ["CONTACT_PROGRAM"]] + INPUTS
# instrumented programs take longer
patience = 300 * float(os.environ.get("CONTACT_SLOWER", "1"))
sys.exit(subprocess.run(command + ["--verbose", "--timeout", str(patience)]).returncode)
