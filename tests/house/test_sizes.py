#!/usr/bin/env python3
"""Files of src have at most 500 lines and procedures at most 100, or a reason at their head.

The reason is a line of the comment that opens the file, or stands above the procedure: `!> Long because ...`.
What is still too long without one is listed in OPEN; the list may only become shorter.
"""
import os
import pathlib
import re
import sys

#: Lines of a file and of a procedure at most
MOST_OF_FILE, MOST_OF_PROCEDURE = 500, 100
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
    """Name and number of lines of what is too long without a reason; the name of the whole file is empty"""
    first = next((n for n, line in enumerate(lines) if not line.startswith("!")), 0)
    if len(lines) > MOST_OF_FILE and not comment_above(lines, first):
        yield "", len(lines)
    opened = []
    for number, line in enumerate(lines):
        head = HEAD.match(line.split("!")[0])
        if END.match(line):
            name, start = opened.pop()
            if number - start + 1 > MOST_OF_PROCEDURE and not comment_above(lines, start):
                yield name, number - start + 1
        elif head:
            opened.append((head[2], number))
    assert not opened, opened


def judge_itself():
    """What is planted is found, and nothing else"""
    body = ["   x = 1"]*(MOST_OF_PROCEDURE - 1)
    long = ["   pure real(wp) function f(x)", *body, "   end function f"]
    assert list(too_long(long)) == [("f", MOST_OF_PROCEDURE + 1)]
    assert not list(too_long([long[0], *body[1:], long[-1]]))
    assert not list(too_long(["   !> Value", "   " + REASON + "it is a table", *long]))
    assert list(too_long(["!> A file", "module m"] + ["x"]*MOST_OF_FILE)) == [("", MOST_OF_FILE + 2)]
    assert not list(too_long(["!> A file", REASON + "it is a table", "module m"] + ["x"]*MOST_OF_FILE))


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
            limit = f"procedure {name} has {count} lines, more than {MOST_OF_PROCEDURE}"
            if not name:
                limit = f"{count} lines, more than {MOST_OF_FILE}"
            print(f"FAILED {file}: {limit}: split it by matter, or say why not: {REASON}...")
    for file, name in sorted(OPEN - set(found)):
        bad += 1
        print(f"FAILED {file} {name}: no longer too long, leave it out of OPEN")
    print(f"{len(files)} files, {len(found)} still too long, {bad} failures")
    return 1 if bad or len(files) < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
