#!/usr/bin/env python3
"""Files of src have at most 500 lines and procedures at most 100, or a reason at their head.

The reason is a line of the comment at the beginning of the file, or above the procedure: `!> Long because ...`.
What is still too long without one is listed in OPEN; the list may only become shorter.
"""
import os
import pathlib
import re
import sys

#: Lines of a file and of a procedure at most
MAX_FILE_LINES, MAX_PROCEDURE_LINES = 500, 100
#: File, procedure ("" for the whole file): to be split, or to be given a reason
OPEN: set[tuple[str, str]] = set()
#: Head of a procedure: attributes, type of the result, name
HEAD = re.compile(r"^\s*(?!end\b)(?:[a-z][^'\"]*\s)?(subroutine|function)\s+(\w+)")
END = re.compile(r"^\s*end (subroutine|function)\b")
REASON = "!> Long because "


def comment_above(lines, number):
    """Does the comment above a line hold a reason?"""
    while number > 0 and lines[number - 1].lstrip().startswith("!>"):
        number -= 1
        if lines[number].strip().startswith(REASON):
            return True
    return False


def too_long(lines):
    """Name and number of lines of everything that is too long without a reason; the name of the whole file is empty"""
    first = next((n for n, line in enumerate(lines) if not line.startswith("!")), 0)
    if len(lines) > MAX_FILE_LINES and not comment_above(lines, first):
        yield "", len(lines)
    opened = []
    for number, line in enumerate(lines):
        head = HEAD.match(line.split("!")[0])
        if END.match(line):
            name, start = opened.pop()
            if number - start + 1 > MAX_PROCEDURE_LINES and not comment_above(lines, start):
                yield name, number - start + 1
        elif head:
            opened.append((head[2], number))
    assert not opened, opened


def judge_itself():
    """Test of this script: exactly the planted offences are found"""
    body = ["   x = 1"]*(MAX_PROCEDURE_LINES - 1)
    long = ["   pure real(wp) function f(x)", *body, "   end function f"]
    assert list(too_long(long)) == [("f", MAX_PROCEDURE_LINES + 1)]
    assert not list(too_long([long[0], *body[1:], long[-1]]))
    assert not list(too_long(["   !> Value", "   " + REASON + "it is a table", *long]))
    assert list(too_long(["!> A file", "module m"] + ["x"]*MAX_FILE_LINES)) == [("", MAX_FILE_LINES + 2)]
    assert not list(too_long(["!> A file", REASON + "it is a table", "module m"] + ["x"]*MAX_FILE_LINES))


def main():
    """All files of src"""
    judge_itself()
    top = pathlib.Path(os.environ["CONTACT_SOURCE"])
    files = sorted(pathlib.Path(top, "src").rglob("*.f90"))
    found = {(file.relative_to(top).as_posix(), name): count for file in files
             for name, count in too_long(file.read_text(encoding="utf-8").splitlines())}
    bad = 0
    for (file, name), count in found.items():
        if (file, name) not in OPEN:
            bad += 1
            limit = f"procedure {name} has {count} lines, more than {MAX_PROCEDURE_LINES}"
            if not name:
                limit = f"{count} lines, more than {MAX_FILE_LINES}"
            print(f"FAILED {file}: {limit}: split it by subject, or give a reason: {REASON}...")
    for file, name in sorted(OPEN - set(found)):
        bad += 1
        print(f"FAILED {file} {name}: no longer too long, remove it from OPEN")
    print(f"{len(files)} files, {len(found)} still too long, {bad} failures")
    return 1 if bad or len(files) < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
