#!/usr/bin/env python3
"""The keys of the readable format in doc/user/readable.md are those of the sources

Usage: readable_keys.py [--write]. The tables are made from the description of the groups (src/cases), the table of bounds, the
digits and their words; with --write they are put into the page, without it the page is compared with them.
"""
import os
import pathlib
import re
import sys

TOP = pathlib.Path(os.environ.get("CONTACT_SOURCE", pathlib.Path(__file__).resolve().parents[2]))
PAGE = TOP / "doc/user/readable.md"
START, END = "<!-- keys: made by tests/house/readable_keys.py --write -->", "<!-- end of keys -->"
# told by the lists themselves
LENGTHS = {"NN", "NP", "NVF", "NX", "NY", "NZ", "PRFOPT", "PROFILE", "CZZ"}
RENAMED = {"Y,ALPHA": "inclinations", "XL,XH,YL,YH": "rectangles"}
FILES = {"rail_profile", "wheel_profile", "influence"}


def source(name):
    """A source file with its continued lines joined"""
    return re.sub(r"&\s*\n\s*&?", "", (TOP / "src" / name).read_text())


def rows(name, what):
    """Constructors of a table: lists of their arguments"""
    found = re.findall(what + r'\(((?:[^()"]|"[^"]*")*)\)', source(name))
    return [[part.strip().strip('"') for part in re.findall(r'"[^"]*"|[^",\s][^",]*', row)] for row in found]


def procedures(name):
    text = source(name)
    return {m.group(1): m.group(2) for m in re.finditer(r"\n   subroutine (\w+)\((.*?)\n   end subroutine \1", text, re.DOTALL)}


def words_of(text):
    """Messages of the sources speak of digits; here the words count"""
    letters = {"N": "normal", "F": "tangential", "T": "motion", "IPOTCN": "form"}
    digits = {(row[0], row[1], row[3]): row[6] for row in rows("control/digits.f90", "digit_row") if len(row) > 6}
    text = text.replace("with F = 1, 2", "with F = 1 or 2").replace("IPOTCN = -4", 'form = "hertz_line_curvature"')
    for name in "NFT":
        def word(match, name=name):
            found = digits.get((name, match.group(1), "both")) or digits.get((name, match.group(1), "module_3"), "")
            other = digits.get((name, match.group(2), "module_3"), "") if match.group(2) else ""
            return f'{letters[name]} = "{found}"' + (f' or "{other}"' if other else "")
        text = re.sub(rf"\b{name} = (\d)(?: or (\d))?", word, text)
    table = bounds()
    return re.sub(r"\b[A-Z][A-Z0-9_]+\b", lambda m: m.group(0).lower() if row_of(m.group(0), table) else m.group(0), text)


def bounds():
    return {row[0]: (row[1], row[2], len(row) > 7) for row in rows("text/bounds.f90", "number_bounds")}


def row_of(name, table):
    """As bounds_of of contact_text_bounds"""
    while name and name not in table and name[-1] in "0123456789NTRW":
        name = name[:-1]
    return table.get(name)


def groups():
    """Names of the numbers of each group, in the order of the input files"""
    parts = {}
    for file in ("cases/inputs.f90", "cases/grid_inputs.f90", "cases/rail_inputs.f90", "cases/subsurface_inputs.f90"):
        parts.update(procedures(file))

    def names(body, seen):
        out = []
        for match in re.finditer(r'(?<!// )"([A-Z][A-Z0-9_,|]*)"|call (visit_\w+)', body):
            if match.group(1):
                out.append(match.group(1))
            elif match.group(2) in parts and match.group(2) not in seen:
                out += names(parts[match.group(2)], seen | {match.group(2)})
        return out

    found = {}
    for body in procedures("cases/whole_case.f90").values():
        for match in re.finditer(r'open_group\("(\w+)"\)(.*?)close_group', body, re.DOTALL):
            found.setdefault(match.group(1), [])
            for name in names(match.group(2), frozenset()):
                if name == "IX":
                    found[match.group(1)] += ["IXL", "IXINC", "IXH", "IYL", "IYINC", "IYH"]
                if name not in found[match.group(1)]:
                    found[match.group(1)].append(name)
    return found


def tables():
    table, lines = bounds(), []
    keys = rows("control/words.f90", "key_row")
    digits = rows("control/digits.f90", "digit_row")
    forms = rows("control/words.f90", "form_row")
    form_keys = {"IPOTCN": "form", "IBASE": "form", "IPLAN": "planform", "ISUBS": "points"}

    def choice(name, module):
        return [f"| | `\"{row[6]}\"` | {words_of(row[5])}{'' if row[4] == '.true.' else ' (not built)'} |"
                for row in digits if row[0] == name and len(row) > 6 and row[3] in ("both", module)]

    def choices(group):
        out = []
        for name, module, place, key, title in keys:
            if place != group:
                continue
            for which in ("module_3", "module_1") if module == "both" else (module,):
                values = choice(name, which)
                if which == "module_1" and module == "both" and values == choice(name, "module_3"):
                    continue
                only = "" if module == "both" and which == "module_3" else ", wheel and rail" if which == "module_1" else ""
                out.append(f"| `{key}` | | {title}{only} |")
                out += values or [f"| | {row[1]} | {row[5]} |" for row in digits if row[0] == name]
        return out

    lines += ["### The case itself", "", "| key | value | meaning |", "|---|---|---|"] + choices("") + [""]
    for group, names in groups().items():
        lines += [f"### {group}", ""]
        if choices(group):
            lines += ["| key | value | meaning |", "|---|---|---|"] + choices(group) + [""]
        lines += ["| key | meaning | unit | preset |", "|---|---|---|---|"]
        if group in FILES:
            lines.append("| `file` | name of the file, relative to the folder of the input | | |")
        done = set()
        for name in (part for whole in names for part in whole.split("|")):
            if name in form_keys:
                lines.append(f"| `{form_keys[name]}` | " + "; ".join(
                    f'`"{row[2]}"`: {row[3]}' for row in forms if row[0] == name) + " | | |")
                continue
            found = row_of(name, table)
            key = RENAMED.get(name, name.lower())
            if not found or name in LENGTHS or key in done:
                continue
            if name not in table and key[-1] in "12" and (key[:-1] + "1") in done:
                continue
            done.add(key)
            unit, title, preset = found
            unit = "" if unit in ("-", "integer") else unit
            lines.append(f"| `{key}` | {words_of(title)} | {unit} | {'yes' if preset else ''} |")
        lines.append("")
    return "\n".join(lines)


def main():
    page = PAGE.read_text()
    before, rest = page.split(START)
    after = rest.split(END)[1]
    current = before + START + "\n" + tables() + END + after
    if "--write" in sys.argv:
        PAGE.write_text(current)
    elif page != current:
        sys.exit("doc/user/readable.md is not current: python3 tests/house/readable_keys.py --write")
    print("doc/user/readable.md has the keys of the sources")


if __name__ == "__main__":
    main()
