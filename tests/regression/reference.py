#!/usr/bin/env python3
"""Run the reference inputs that this version can solve and compare with the published outputs.

The reference data are not part of the project. Where they are absent the test is skipped (status 77).
"""
import os
import subprocess
import sys

EXAMPLES = ["cattaneo", "carter2d", "bentall", "catt_to_cart", "spence35", "veldep_fric", "ertz_temperature"]

reference = os.environ["CONTACT_REFERENCE"]
tool = os.path.join(os.path.dirname(os.path.normpath(reference)), "tools", "check_reference.py")
if not (os.path.isdir(os.path.join(reference, "examples")) and os.path.isfile(tool)):
    print("SKIPPED: no reference data in %s" % reference)
    sys.exit(77)
command = [sys.executable, "-B", tool, os.environ["CONTACT_PROGRAM"]] + ["examples/" + name for name in EXAMPLES]
sys.exit(subprocess.run(command + ["--verbose"]).returncode)
