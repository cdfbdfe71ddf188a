#!/usr/bin/env python3
"""What scripts for this family of files rely on, checked line by line: contract.py FILE ...

The scripts find sections by text anywhere in a line and read numbers a fixed number of lines below; they take every line with
the word Case for a new case; .mat and .subs files go through loaders that want the same number of columns on each line.
"""
import glob
import re
import sys

import out_file

# Heading, and count of the numbers on the line below
BELOW = {"FX(TR)      FY(TR)": 6, "MX@R(TR)": 6, "XCP(TR)     YCP(TR)": 6, "XCP(W)": 3}
# Title of a section, and count of the numbers two lines below it
SECTIONS = {"KINEMATIC CONSTANTS": 6, "WHEEL-SET POSITION AND VELOCITY": 6, "FLEXIBLE WHEEL-SET DEVIATIONS": 6,
            "RAIL IRREGULARITY": 6, "MASSLESS RAIL DEFLECTION": 6}
LAYOUT = 2410


def check_out(path):
    """Complaints about an .out file"""
    with open(path, encoding="latin-1") as file:
        lines = file.read().splitlines()
    wrong = []

    def demand(condition, k, text):
        if not condition:
            wrong.append("%s:%d: %s: %s" % (path, k + 1, text, lines[k] if k < len(lines) else ""))

    demand(len(lines) > 1 and "detailed investigation of 3D" in lines[1], 1, "the second line does not have the kind of file")
    announced = patches = 0
    for k, line in enumerate(lines):
        def count(below, k=k):
            try:
                return len(out_file.numbers(lines[k + below]))
            except (ValueError, IndexError):
                return -1

        if "Case" in line:
            demand(re.match(r" Case +\d+", line), k, "the word Case in a line that does not begin a case")
            demand(announced in (0, patches), k, "%d patches announced, %d described before" % (announced, patches))
            announced = patches = 0
        title = re.search(r"WHEEL-(RAIL|ROLLER) CONTACT, (LEFT|RIGHT) WHEEL, +(\d+) CONTACT PATCH", line)
        if title:
            announced = int(title.group(3))
        patch = re.search(r"----- DATA FOR CONTACT PATCH +(\d+) (\(NEW PATCH\) |\(PREV +\d+(, +\d+)*\) )?-----$", line)
        if "DATA FOR CONTACT PATCH" in line:
            patches += 1
            demand(patch and int(patch.group(1)) == patches, k, "number of a patch")
        for heading, n in BELOW.items():
            if heading in line:
                demand(count(1) == n, k + 1, "%d numbers expected" % n)
        for heading, n in SECTIONS.items():
            if heading in line:
                # shifts have the time step instead of direction and step
                n -= lines[k + 1].split()[0] == "DT"
                demand(count(2) == n, k + 2, "%d numbers expected" % n)
        if "WHEEL-SET POSITION AND VELOCITY" in line:
            demand(count(5) in (6, 7), k + 5, "six or seven velocities expected")
        if "ELAST.EN.   FRIC" in line:
            demand(count(1) == 6, k + 1, "six totals expected")
            second = re.sub(r"(CREEP|SHIFT) ([XY])", r"\1_\2", lines[k + 2]).split()
            demand("APPROACH" in second and "PMAX" in second, k + 2, "names of the second line of totals")
            demand(count(3) == len(second), k + 3, "%d totals expected" % len(second))
        if "NPOT   NCON" in line:
            demand(count(1) == (7 if "NPLAST" in line else 6), k + 1, "numbers of elements")
        if " AT (X,Y,Z) = (" in line:
            demand(line[15] == "=" and re.fullmatch(r" *SIG\w+ *", line[7:15].replace("MAX", "   ")), k, "places of name and =")
    return wrong


def check_mat(path):
    """Complaints about a .mat file"""
    with open(path) as file:
        lines = file.read().splitlines()
    wrong = []
    if [line[0] == "%" for line in lines[:13]] != [True, False] * 6 + [True] or any(line[0] == "%" for line in lines[13:]):
        return ["%s: six pairs of names and values and the names of a table are expected" % path]
    if not re.search(r" FMT   STATUS: (solved|not converged \((normal|tangential|outer|force|time)\): .+)$", lines[0]):
        wrong.append("%s: the first line does not end with the status" % path)
    rows = [[float(word) for word in line.split()] for line in lines if line[0] != "%"]
    columns = len(rows[0])
    for k, row in enumerate(rows):
        if len(row) != columns:
            wrong.append("%s: %d numbers in line %d, %d in the first" % (path, len(row), k + 1, columns))
    names = lines[12].replace("%", " ").split()
    material, heat = rows[4], rows[5][1]
    plastic = material[1] == 4 and 1e-10 < material[8] <= 1e10
    expected = 11 + 3 * plastic + 2 * (heat >= 1)
    if not columns == len(names) == expected:
        wrong.append("%s: %d columns, %d names, %d expected" % (path, columns, len(names), expected))
    if rows[0][-1] != LAYOUT:
        wrong.append("%s: layout %g" % (path, rows[0][-1]))
    if names[10] != ("SREL" if material[0] >= 2 else "SHFT"):
        wrong.append("%s: name of slip is %s" % (path, names[10]))
    table = rows[6:]
    numbers = [row[0] for row in table]
    mx, my = rows[3][:2]
    if (numbers != sorted(set(numbers)) or any(not 1 <= i <= mx * my for i in numbers)
        or any(row[1] not in (0, 1, 2, 3) for row in table)):
        wrong.append("%s: numbers or states of elements" % path)
    if any(row[1] == 0 and (row[4] or row[5] or row[6] or row[10]) for row in table):
        wrong.append("%s: tractions or slip out of contact" % path)
    for line in lines[13:]:
        try:
            # two whole numbers share the first 14 columns
            int(line[:7]), int(line[7:12]), [float(line[k:k + 14]) for k in range(14, len(line), 14)]
        except ValueError:
            wrong.append("%s: columns of 14: %s" % (path, line))
    return wrong


def check_subs(path):
    """Complaints about a .subs file"""
    with open(path) as file:
        lines = file.read().splitlines()
    wrong = []
    k = 0
    columns = len(lines[1].split())
    if columns not in (8, 14):
        wrong.append("%s: %d columns" % (path, columns))
    while k < len(lines):
        size = [float(word) for word in lines[k + 1].split()]
        if lines[k][0] != "%" or lines[k + 2][0] != "%" or len(size) != columns or any(size[3:]):
            return wrong + ["%s:%d: head of a block" % (path, k + 1)]
        nx, ny, nz = (int(n) for n in size[:3])
        points = [[float(line[c:c + 12]) for c in range(0, 12 * columns, 12)] for line in lines[k + 3:k + 3 + nx * ny * nz]]
        names = lines[k + 2].replace("%", " ").split()
        if len(names) != columns or len(points) != nx * ny * nz:
            wrong.append("%s:%d: a block of %d x %d x %d points has %d" % (path, k + 1, nx, ny, nz, len(points)))
        for i, point in enumerate(points):
            if (point[0] != points[i % nx][0] or point[1] != points[i % (nx * ny) // nx * nx][1]
                or point[2] != points[i // (nx * ny) * nx * ny][2]):
                wrong.append("%s:%d: order of points" % (path, k + 4 + i))
                break
        k += 3 + nx * ny * nz
    return wrong


def check_files(pattern):
    """Complaints about all files of a pattern, and the number of files"""
    wrong, found = [], 0
    for ending, check in (("out", check_out), ("mat", check_mat), ("subs", check_subs)):
        for path in sorted(glob.glob(pattern)):
            if path.endswith(ending):
                wrong += check(path)
                found += 1
    return wrong, found


if __name__ == "__main__":
    complaints = [text for name in sys.argv[1:] for text in check_files(name)[0]]
    print("\n".join(complaints[:40]))
    sys.exit(1 if complaints else 0)
