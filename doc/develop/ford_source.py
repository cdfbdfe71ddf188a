"""A source as FORD can read it: the preprocessor of doc/develop/ford.md.

FORD 7.0 does not parse expressions with commas in the length of a character variable, does not find includes of libraries, and
takes "word: text" in a comment for settings of its own.
"""
import re
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


with open(sys.argv[-1], encoding="utf-8") as file:
    text = file.read()
# a declaration on several lines becomes one
text = re.sub(r"&[ ]*\n[ ]*&?(?=[^!\n]*::)", "", text)
text = re.sub(r"(![>!][ ]*[\w-]+):(?= )", r"\1&#58;", text)
sys.stdout.write("".join(line for line in map(without_length, text.splitlines(True)) if not re.match(r"\s*include ", line)))
