#!/usr/bin/env python3
"""What must not come back into src, and into the top folder: one rule a line, each with its reason."""
import os
import pathlib
import re
import sys

# All that may stand in the top folder, beside names with a dot; build is made
TOP = {"CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "build", "doc", "examples", "include", "matlab", "python",
       "src", "tests"}
# A format in quotes: after the unit of write or read, or given to a variable
FORMAT = re.compile(r"""(?:\b(?:write|read)\s*\(\s*[\w%*]+\s*,\s*|\bform\w*(?:\([^)]*\))?\s*=\s*\[?)(['"])(\(.*?)\1""")


# Rooms that know control digits; all others know named choices
DOORS = {"control", "input", "output", "capi"}
DIGIT = re.compile(r"\bcase_digits\b|\bdigits\s*%|\bcontact_control_(?:digits|translation)\b")
# A choice means what is done, never "what the previous case did"
KEEP = re.compile(r"::.*\bkeep\s*=\s*\d")


def offences(lines, room="base"):
    """Number, line and reason of each line that breaks a rule"""
    for number, line in enumerate(lines, 1):
        if room not in DOORS and DIGIT.search(line):
            yield number, line.strip(), "digits end at the reader; a case has choices and parts"
        if room == "base" and KEEP.search(line):
            yield number, line.strip(), "what a case keeps is the source of its parts, not a choice"
        for match in FORMAT.finditer(line):
            descriptors = re.sub(r"""(['"]).*?\1""", "", match[2])
            if re.search("[a-z]", descriptors):
                yield (number, line.strip(), ("an edit descriptor in small letters: the run-time library makes capitals of them "
                       "by the host's locale, and a Turkish i has none"))


def main():
    """All files of src"""
    planted = list(offences(["   write(text, '(a, i0)') what", "   if (bad) write(unit, '(es12.4)', iostat=status) x",
                             "   write(text, '(A, I0)') 'a', 1", "   read(number, form, iostat=status) value",
                             """   write(name, '("case_", i0)') k""", """   write(name, '("case_", I0)') k"""]))
    assert [line[0] for line in planted] == [1, 2, 5], planted
    digits = ["   if (spec%digits%c >= 2) return", "      integer :: none = 0, keep = 1", "   keep = 1"]
    assert [line[0] for line in offences(digits, "base")] == [1, 2], "digits and kept values in choices"
    assert [line[0] for line in offences(digits, "input")] == [], "digits of the reader"
    top = pathlib.Path(os.environ["CONTACT_SOURCE"])
    files = sorted(pathlib.Path(top, "src").rglob("*.f90"))
    strangers = sorted(name for name in os.listdir(top) if name not in TOP and not name.startswith("."))
    bad = len(strangers)
    if strangers:
        print(f"FAILED {top} holds {strangers[:10]}: left by a test that ran there, or in the wrong place")
    for file in files:
        for number, line, reason in offences(file.read_text(encoding="utf-8").splitlines(), file.parent.name):
            bad += 1
            print(f"FAILED {file}:{number}: {line}\n  {reason}")
    print(f"{len(files)} files, {bad} offences")
    return 1 if bad or len(files) < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
