"""The command `contact` of the wheel: runs the program inside the package"""
from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parent


def main() -> int:
    """Run the program with the arguments of this process; `contact report` finds this package and this Python"""
    name = "contact.exe" if os.name == "nt" else "contact"
    program = FOLDER / "bin" / name
    if not program.is_file():
        print("ERROR. This Python package does not contain the program; build it, or install a wheel with it", file=sys.stderr)
        return 1
    os.environ.setdefault("CONTACT_PYTHON", str(FOLDER.parent))
    os.environ["PATH"] = os.pathsep.join((str(Path(sys.executable).parent), os.environ.get("PATH", "")))
    if os.name == "nt":
        return subprocess.run([str(program), *sys.argv[1:]]).returncode
    os.execv(program, [sys.argv[0], *sys.argv[1:]])
    return 0
