"""Presets of CMakePresets.json can be configured: options that depend on their variables are valid."""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(os.environ["CONTACT_SOURCE"])
#: Those with variables that lists of options depend on; "fuzz" has those of "sanitize", but needs the library of a fuzzer
NAMES = ("sanitize", "coverage")


def main():
    """Configure each preset in a folder of its own."""
    failures = 0
    for name in NAMES:
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(["cmake", "--preset", name, "-B", folder], cwd=ROOT, capture_output=True, text=True)
            if done.returncode:
                failures += 1
                print(f"FAILED preset {name}: {done.stderr[-2000:]}")
    print(f"{len(NAMES)} presets, {failures} failures")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main())
