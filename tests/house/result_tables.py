#!/usr/bin/env python3
"""The tables of totals and element fields in doc/user/results.md are those of the sources

Usage: result_tables.py [--write]. The tables are made from the lists in src/patch/result.f90 and src/wheelrail/result.f90; with
--write they are put into the page, without it the page is compared with them.
"""
import os
import pathlib
import re
import sys

TOP = pathlib.Path(os.environ.get("CONTACT_SOURCE", pathlib.Path(__file__).resolve().parents[2]))
PAGE = TOP / "doc/user/results.md"
START, END = "<!-- results: made by tests/house/result_tables.py --write -->", "<!-- end of results -->"
#: What a condition of the sources means to a reader
WHEN = {"is_rolling": "rolling", "motion_choice%shift": "shift", "%damping": "damping", "%temp1": "temperatures",
        "%tau_c": "yield limit", "%shift .or.": "steps (T = 1, 2)", ".not. allocated(self%curve)": "conformal contact",
        "%has_archard": "Archard's coefficient", "%has_yield": "yield stress", "%ncon > 0": "contact"}
SIGNS = {"along": "body", "across": "body and side", "side": "side"}


def procedure(file, name):
    """Statements of a procedure, continued lines joined"""
    text = re.sub(r"&\s*\n\s*&?", "", (TOP / "src" / file).read_text())
    body = re.search(rf"\n   (?:pure )?subroutine {name}\((.*?)\n   end subroutine {name}", text, re.DOTALL).group(1)
    return [line.strip() for line in body.split("\n")]


def in_words(condition):
    return next((word for mark, word in WHEN.items() if mark in condition), "where it is calculated")


def totals(file, name):
    """Rows of a list of totals: name, unit, meaning, sign, when"""
    now = []
    for line in procedure(file, name):
        condition = re.match(r"(?:else )?if \((.*)\) then$", line)
        if line.startswith("else if") or line == "end if":
            now.pop()
        if condition:
            now.append(in_words(condition.group(1)))
        leave = re.match(r"if \((.*)\) return$", line)
        if leave:
            now.append(in_words(leave.group(1)))
        found = re.search(r'(?:if \((.*)\) +)?call list%(add|add_friction|count)\("(\w+)"(?:, "([^"]*)")?, "([^"]*)"', line)
        if not found or "in_files=.false." in line:
            continue
        alone, kind, title, unit, meaning = found.groups()
        sign = re.search(r"orientation%(\w+)", line)
        when = in_words(alone) if alone else now[-1] if now else ""
        yield title, (unit or "") if kind != "count" else "", meaning, SIGNS.get(sign.group(1), "") if sign else "", when


def fields():
    """Rows of the list of element fields: name, unit, meaning, sign, number, name in VTK files"""
    rows = {}
    for line in procedure("patch/result.f90", "fields"):
        found = re.match(r'call add\((\d+), "(\w+)", "([^"]*)", "([^"]*)", self', line)
        if not found:
            continue
        code, name, unit, meaning = found.groups()
        sign, label = re.search(r"orientation%(\w+)", line), re.search(r'label="([^"]*)"', line)
        row = rows.setdefault(name, [[], [], SIGNS.get(sign.group(1), "") if sign else "", code, label.group(1) if label else "",
                                     "library" if "in_files=.false." in line else ""])
        row[0] += [unit] if unit not in row[0] else []
        row[1].append(meaning)
    for name, (units, meanings, sign, code, label, where) in rows.items():
        yield name, ", ".join(units), "; ".join(meanings) + (" (only in the library)" if where else ""), sign, code, label


def tables():
    head = "| name | unit | meaning | changes with | when |\n|---|---|---|---|---|\n"

    def rows(items):
        return "".join("| `" + "` | ".join([row[0], " | ".join(row[1:])]) + " |\n" for row in items)

    return ("Totals of a contact patch:\n\n" + head + rows(totals("patch/result.f90", "totals"))
            + "\nand in module 1\n\n" + head + rows(totals("wheelrail/result.f90", "patch_totals"))
            + "\nand if wear and fatigue are requested, by the table `wear`\n\n" + head
            + rows(totals("patch/result.f90", "add_wear"))
            + "\nand with points below the surface, if wear and fatigue or estimated errors are requested\n\n" + head
            + rows(totals("patch/result.f90", "add_stresses"))
            + "\nTotals of wheel and rail:\n\n" + head + rows(totals("wheelrail/result.f90", "wheel_rail_totals"))
            + "\nElement fields; the number is that of `cntc_getfielddata`, CNTC_fld_NAME:\n\n"
            + "| name | unit | meaning | changes with | number | in VTK files |\n|---|---|---|---|---|---|\n" + rows(fields()))


def main():
    page = PAGE.read_text()
    before, rest = page.split(START)
    after = rest.split(END)[1]
    current = before + START + "\n" + tables() + END + after
    if "--write" in sys.argv:
        PAGE.write_text(current)
    elif page != current:
        sys.exit("doc/user/results.md is not current: python3 tests/house/result_tables.py --write")
    print("doc/user/results.md has the totals and fields of the sources")


if __name__ == "__main__":
    main()
