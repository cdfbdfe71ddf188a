"""Read the results of an .out file as the public scripts for this family of files do.

They search for a heading anywhere in a line, skip lines, and split the line there at blanks.
"""

TOTALS = ("FN", "FX", "FY", "MZ", "ENERGY", "POWER")


def read(path):
    """Return {case number: {quantity: value}}; X and Y depend on the heading of the case.

    An extreme of subsurface block 2 is the quantity "2 SIGVM", its place is "2 SIGVM x", ... y and z.
    """
    with open(path) as file:
        lines = file.read().splitlines()
    if len(lines) < 2 or "detailed investigation of 3D" not in lines[1]:
        raise ValueError("%s: the second line is not that of an .out file" % path)
    cases = {}
    values = None
    for k, line in enumerate(lines):
        words = line.split()
        if "Case" in line:
            values = cases.setdefault(int(words[1].rstrip(",")), {})
        elif values is None:
            continue
        elif "FX(TR)      FY(TR)" in line:
            values.update(zip(("FX(TR)", "FY(TR)", "FZ(TR)"), numbers(lines[k + 1])))
        elif "XCP(TR)     YCP(TR)" in line:
            values.update(zip(("XCP", "YCP", "ZCP", "DELTCP"), numbers(lines[k + 1])))
        elif "ELAST.EN.   FRIC" in line:
            values.update(zip(TOTALS, numbers(lines[k + 1])))
            second = numbers(lines[k + 3])
            values.update(zip(("FN/G", "X", "Y", "APPROACH", "PMAX", "TMAX"), second))
            values["X is"] = meaning(lines[k + 2], "X")
            values["Y is"] = meaning(lines[k + 2], "Y")
        elif "SUBSURFACE STRESSES BLOCK" in line:
            block = words[-1].rstrip(":")
        elif " AT (X,Y,Z) = (" in line:
            name = "%s %s" % (block, words[1])
            values[name] = float(words[3])
            place = line[line.rindex("(") + 1:line.rindex(")")].split(",")
            values.update((name + " " + axis, float(word)) for axis, word in zip("xyz", place))
        elif "NPOT   NCON   NADH  NSLIP" in line:
            values.update((name, int(word)) for name, word in zip(words, lines[k + 1].split()))
    return cases


def numbers(line):
    return [float(word) for word in line.split()]


def meaning(heading, axis):
    """What the number for an axis is: creep, shift or force"""
    for word in ("CREEP", "SHIFT"):
        if "%s %s" % (word, axis) in heading:
            return word.lower()
    return "force"
