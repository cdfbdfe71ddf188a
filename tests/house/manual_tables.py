#!/usr/bin/env python3
"""The tables of doc/user that repeat the sources are current

Usage: manual_tables.py [--write]. Made from the description of the groups (src/cases), the table of bounds, the digits and their
words are

    readable.md      the keys of each table of a case, and their presets
    input.md         digits and their values, numbers of the friction laws, bounds of all numbers
    wheel_rail.md    digits and their values

With --write they are put into the pages, without it the pages are compared with them.
"""
import difflib
import math
import os
import pathlib
import re
import sys

TOP = pathlib.Path(os.environ.get("CONTACT_SOURCE", pathlib.Path(__file__).resolve().parents[2]))
START, END = "<!-- keys: made by tests/house/manual_tables.py --write -->", "<!-- end of keys -->"
# lengths are given by the lists themselves
LENGTHS = {"NN", "NP", "NVF", "NX", "NY", "NZ", "PRFOPT", "PROFILE", "CZZ"}
RENAMED = {"Y,ALPHA": "inclinations", "XL,XH,YL,YH": "rectangles"}
FILES = {"rail_profile", "wheel_profile", "influence"}


def source(name):
    """A source file with its continued lines joined"""
    return re.sub(r"&\s*\n\s*&?", "", (TOP / "src" / name).read_text())


def rows(name, what):
    """Constructors of a table: lists of their arguments"""
    found = re.findall(what + r'\(((?:[^()"]|"[^"]*")*)\)', source(name))
    return [[part.strip().removeprefix('"').removesuffix('"').replace('""', '"')
             for part in re.findall(r'"(?:[^"]|"")*"|[^",\s][^",]*', row)] for row in found]


def procedures(name):
    text = source(name)
    return {m.group(1): m.group(2) for m in re.finditer(r"\n   subroutine (\w+)\((.*?)\n   end subroutine \1", text, re.DOTALL)}


def words_of(text):
    """Convert names in capitals and IPOTCN of the sources to keys"""
    text = text.replace("IPOTCN = -4", 'form = "hertz_line_curvature"')
    table = bounds()
    return re.sub(r"\b[A-Z][A-Z0-9_]+\b", lambda m: m.group(0).lower() if row_of(m.group(0), table) else m.group(0), text)


def in_digits(text):
    """Convert named choices of the sources, motion = "none", to the digits of input.md, T = 0"""
    keys = {".".join(part for part in row[2:4] if part): row[0] for row in rows("control/words.f90", "key_row")}
    digits = {(row[0], row[6]): row[1] for row in rows("control/digits.f90", "digit_row") if len(row) > 6}

    def with_digits(match):
        name = keys.get(match[1])
        return f"{name} = " + re.sub(r'"(\w+)"', lambda word: digits[name, word[1]], match[2])
    return re.sub(r'([a-z_.]+) = ("\w+"(?:(?:, | or )"\w+")*)', with_digits, text)


def bounds():
    return {row[0]: (row[1], row[2], len(row) > 7) for row in rows("text/bounds.f90", "number_bounds")}


def presets():
    """Values that numbers have if they are never given, by their names: those of the components that the descriptions visit"""
    types, extended = {}, {}
    for path in sorted((TOP / "src").glob("*/*.f90")):
        text = source(path.relative_to(TOP / "src"))
        for name, body in re.findall(r"\n   type(?:, [^:\n]+)? :: (\w+)\n(.*?)end type", text, re.DOTALL):
            for line in re.findall(r"^\s+(?:real\(wp\)|integer|logical)[^:\n]*:: (.*)", body, re.MULTILINE):
                types.setdefault(name, {}).update(re.findall(r"(\w+)(?:\([\d:]+\))? = ([^,(\n]+)", line))
        extended.update((child, base) for base, child in re.findall(r"type, extends\((\w+)\) :: (\w+)", path.read_text()))
    found = {}
    for file in ("inputs", "grid_inputs", "distance", "rail_inputs", "subsurface_inputs"):
        text = source(f"cases/{file}.f90")
        lists = {name: re.findall(r'"(\w+)"', values) for name, values in re.findall(r":: (\w+)\(\d+\) = (\[.*?\])", text)}
        for several, name, kind, part in re.findall(r'call a%\w+\((trim\()?"?(\w+)"?[^,]*, (\w+)(?:\(\w+\))?%(\w+)', text):
            value = types.get(f"{kind}_spec", {}).get(part) or types.get(extended.get(f"{kind}_spec"), {}).get(part)
            for key in lists.get(name, []) if several else [name]:
                if value:
                    found[key] = number(value, {"pi": math.pi})
    return found


def row_of(name, table):
    """As bounds_of of contact_text_bounds"""
    while name and name not in table and name[-1] in "0123456789NTRW":
        name = name[:-1]
    return table.get(name)


def names_of(body, parts, seen=frozenset(), prefix=""):
    """Names of the numbers that a piece of a description visits; of NAME // "1" the NAME is passed by the caller"""
    out = []
    for match in re.finditer(r'\bname // "(\d)"|(?<!// )"([A-Z][A-Z0-9_,|]*)"|call (visit_\w+)(?:\(a, "([A-Z]+)")?', body):
        if match[1]:
            out.append(prefix + match[1])
        elif match[2]:
            out.append(match[2])
        elif match[3] in parts and match[3] not in seen:
            # several callers may pass different names
            out += names_of(parts[match[3]], parts, seen if match[4] else seen | {match[3]}, match[4] or "")
    return out


def laws():
    """Rows with the numbers of each friction law"""
    choices = dict(re.findall(r"(\w+) = (\d+)", re.search(
        r"type :: friction_model_list(.*?)end type", source("friction/new_law.f90"), re.DOTALL)[1]))
    parts = procedures("cases/inputs.f90")
    pieces = re.split(r"case \(friction_model%(\w+)\)", parts["visit_friction_set"])[1:]
    values = {int(choices[name]): list(dict.fromkeys(names_of(re.sub(r"%(?:refuse|warn|was_given)\(.*", "", body), parts)))
              for name, body in zip(pieces[::2], pieces[1::2])}
    rows_of_laws = [f"| L = {law} | {' '.join(values[law])} |" for law in sorted(values)]
    varying = ", ".join(str(law) for law in sorted(values) if law)
    return [*rows_of_laws, f"| L = {varying} | {' '.join(names_of(parts['visit_friction_memory'], parts))} |"]


def number(text, constants):
    """A number of the sources as real_text writes it: six figures"""
    value = float(eval(re.sub(r"_wp\b", "", text), {}, constants))
    if abs(value) >= 1e6 or (value and abs(value) < 1e-4):
        return f"{value:.5E}"
    return f"{value:.6f}".rstrip("0").rstrip(".")


def bound_rows():
    """Rows of the table of bounds"""
    text = source("text/bounds.f90")
    constants = {name: float(value) for name, value in re.findall(r"(\w+) = ([-\d.e+]+)_wp", text[:text.index("solver_rows")])}
    for name, unit, title, lowest, highest, is_open, reason, *_ in rows("text/bounds.f90", "number_bounds"):
        above = "above " if is_open == ".true." else ""
        yield in_digits(f"| {name} | {title} | {unit} | {above}{number(lowest, constants)} | {number(highest, constants)} "
                        f"| {reason} |")


def digit_rows(modules):
    """Rows of each digit, by its letter"""
    found = {}
    for name, digit, _, module, built, text, *_ in ([row[0], *row[1:]] for row in rows("control/digits.f90", "digit_row")):
        if module in modules:
            found.setdefault(name, []).append(f"| {name} | {digit} | {text}{'' if built == '.true.' else ' (not implemented)'} |")
    return found


def with_rows(page, start, new):
    """A page with consecutive rows that begin with some words replaced by other rows"""
    lines = page.split("\n")
    found = [k for k, line in enumerate(lines) if re.match(start, line)]
    assert found, f"no row {start} in the manual"
    assert found == list(range(found[0], found[-1] + 1)), f"rows {start} of the manual are not consecutive"
    return "\n".join(lines[:found[0]] + list(new) + lines[found[-1] + 1:])


def page_of_digits(page, modules):
    for name, new in digit_rows(modules).items():
        page = with_rows(page, rf"\| {name} \| \d+ \| ", new)
    return page


def groups():
    """Names of the numbers of each group, in the order of the input files"""
    parts = {}
    for file in ("inputs", "grid_inputs", "distance", "rail_inputs", "subsurface_inputs"):
        parts.update(procedures(f"cases/{file}.f90"))

    def names(body, seen):
        return names_of(body, parts, seen)

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
    table, values, lines = bounds(), presets(), []
    keys = rows("control/words.f90", "key_row")
    digits = rows("control/digits.f90", "digit_row")
    forms = rows("control/words.f90", "form_row")
    form_keys = {"IPOTCN": "form", "IBASE": "form", "IPLAN": "planform", "ISUBS": "points"}

    def choice(name, module):
        return [f"| | `\"{row[6]}\"` | {words_of(row[5])}{'' if row[4] == '.true.' else ' (not implemented)'} |"
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
            lines.append(f"| `{key}` | {words_of(title)} | {unit} | {values[name] if preset else ''} |")
        lines.append("")
    return "\n".join(lines)


def readable(page):
    before, rest = page.split(START)
    return before + START + "\n" + tables() + END + rest.split(END)[1]


def input_page(page):
    page = page_of_digits(page, ("both", "module_3"))
    page = with_rows(page, r"\| L = [\d, ]+ \| [A-Z]+ [A-Z_0-9 ]+ \|$", laws())
    return with_rows(page, r"\| [^|]+ \| [^|]+ \| [^|]+ \| [^|]+ \| [-\d.E+]+ \| ", bound_rows())


def wheel_rail_page(page):
    """Its digits are generated; every number of its groups must be in one of its tables, or be named in the list of groups"""
    explained = set(re.findall(r"[A-Z][A-Z0-9_]+", " ".join(re.findall(r"^\|([^|]*)\|", page, re.MULTILINE))))
    of_pair = ("search", "track", "deviations", "springs", "wheel_dimensions", "position", "velocity", "flexibility")
    required = {part for name, names in groups().items() if name in of_pair for whole in names for part in whole.split("|")}
    assert not required - explained, f"doc/user/wheel_rail.md does not explain {required - explained}"
    return page_of_digits(page, ("both", "module_1"))


def main():
    bad = 0
    for name, make in (("readable", readable), ("input", input_page),
                       ("wheel_rail", wheel_rail_page)):
        path = TOP / f"doc/user/{name}.md"
        page = path.read_text()
        current = make(page)
        if "--write" in sys.argv:
            path.write_text(current)
        elif page != current:
            bad += 1
            print(f"FAILED doc/user/{name}.md is not current: python3 tests/house/manual_tables.py --write")
            print("\n".join(list(difflib.unified_diff(page.split("\n"), current.split("\n"), lineterm="", n=0))[2:20]))
    print(f"3 pages, {bad} failures")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
