"""Sources as FORD can read them: python3 ford_source.py SOURCES COPIES writes changed copies of all sources to another folder.

FORD 7.0 does not parse expressions with commas in the length of a character variable, does not find includes of libraries, and
takes "word: text" in a comment for settings of its own. As a preprocessor of FORD this would start once for each file.
"""
import pathlib
import re
import shutil
import sys


def without_length(line):
    """The declaration with (len=*) in place of the expression"""
    start = line.find("character(len=")
    if start < 0:
        return line
    depth = 0
    for k in range(start + 9, len(line)):
        depth += {"(": 1, ")": -1}.get(line[k], 0)
        if depth == 0:
            return line[:start] + "character(len=*)" + line[k + 1:] if "," in line[start + 14:k] else line
    return line


def changed(text):
    """A source as FORD can read it"""
    # a declaration on several lines becomes one
    text = re.sub(r"&[ ]*\n[ ]*&?(?=[^!\n]*::)", "", text)
    text = re.sub(r"(![>!][ ]*[\w-]+):(?= )", r"\1&#58;", text)
    return "".join(line for line in map(without_length, text.splitlines(True)) if not re.match(r"\s*include ", line))


sources, copies = map(pathlib.Path, sys.argv[1:])
shutil.rmtree(copies, ignore_errors=True)
for source in sorted(sources.rglob("*.f90")):
    copy = copies / source.relative_to(sources)
    copy.parent.mkdir(parents=True, exist_ok=True)
    copy.write_text(changed(source.read_text(encoding="utf-8")), encoding="utf-8")
