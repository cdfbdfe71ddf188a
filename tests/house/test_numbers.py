#!/usr/bin/env python3
"""Numbers that tune a method have a name, with a comment that gives their origin.

In the rooms of the physics no executable line holds a real number of its own: whole numbers up to 100 and simple fractions
are coefficients of formulas, 180 and 1000 units. A parameter with such a value has a comment above or beside it.
"""
import os
import pathlib
import re
import sys

#: The rooms that are looked at
ROOMS = ("fft", "numeric", "grid", "elastic", "normal", "friction", "temperature", "subsurface", "tangential", "simplified",
         "tables", "profile", "patch", "wheelrail")
NUMBER = re.compile(r"(?<![\w.])(\d+\.\d*(?:[eE][-+]?\d+)?|\d+[eE][-+]?\d+)_wp")
#: What formulas and units have
ALLOWED = {0.125, 0.25, 0.5, 0.75, 1.5, 180.0, 1000.0}


def is_tuning(number):
    """Is this number more than a coefficient of a formula?"""
    value = float(number)
    return "e" in number.lower() or not (value in ALLOWED or (value == int(value) and value <= 100))


def offences(lines):
    """Number and text of each executable line with an unnamed number"""
    declares = continued = False
    for count, line in enumerate(lines, 1):
        code = re.sub(r'"[^"]*"', '""', line).split("!")[0]
        if not continued:
            declares = "::" in code and not code.lstrip().startswith("allocate")
        continued = code.rstrip().endswith("&")
        if not declares and any(map(is_tuning, NUMBER.findall(code))):
            yield count, line.strip()


def judge_itself():
    """Test of this script: exactly the planted offences are found"""
    planted = ["   real(wp), parameter :: few = 0.3_wp, &", "      & many = 1.0e5_wp", "   x = 0.5_wp*y + 2.0_wp ! 0.3_wp",
               "   x = 0.3_wp*y", "   if (x > 1.0e-3_wp &", "      & .and. y < 7.25_wp) return",
               '   text = "0.3_wp"', "   allocate(x(3), source=0.7_wp)"]
    assert [number for number, _ in offences(planted)] == [4, 5, 6, 8]


def main():
    """All files of the rooms"""
    judge_itself()
    top = pathlib.Path(os.environ["CONTACT_SOURCE"])
    files = [file for room in ROOMS for file in sorted(pathlib.Path(top, "src", room).glob("*.f90"))]
    bad = 0
    for file in files:
        for number, line in offences(file.read_text(encoding="utf-8").splitlines()):
            bad += 1
            print(f"FAILED {file.relative_to(top)}:{number}: {line}\n  give the number a name and a comment with its origin")
    print(f"{len(files)} files, {bad} numbers without a name")
    return 1 if bad or len(files) < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
