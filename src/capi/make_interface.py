#!/usr/bin/env python3
"""Generate the headers, doors.c, the Fortran interfaces, the Python tables, the functions for Matlab and the page of the library.

The source is interface.txt; make_matlab.py generates the files for Matlab.

    python3 src/capi/make_interface.py            write the files; to be run after a change of interface.txt
    python3 src/capi/make_interface.py --check    exit status 1 if a file is not up to date
"""
import os
import re
import sys
import textwrap

import make_matlab

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.dirname(os.path.dirname(HERE))
WIDTH = 100
#: Letters for the problems to which a routine applies; the first two names are also ends of section titles
SCOPES = {"basic contact": "c", "wheel and rail": "w", "any": "a", "patch of wheel and rail": "l",
          "patch or whole of wheel and rail": "g", "one patch": "p", "solved": "v"}
ORIGIN = "Made by src/capi/make_interface.py from src/capi/interface.txt; change those."


class Argument:
    """One argument: direction in, out or inout, kind int, real or text, and whether it is an array

    lengths: names of the arguments that contain its length. size: the length if it is fixed, "grid" for one value per element,
    otherwise None. is_table: it is a result with two lengths, which the routine handles itself.
    """

    def __init__(self, text):
        match = re.fullmatch(r"(in|out|inout) (int|real|text) (\w+)(?:\[([^\]]*)\])?", text.strip())
        if not match:
            raise SystemExit(f"interface.txt: '{text}' is not an argument")
        self.direction, self.kind, self.name, length = match.groups()
        self.is_array = length is not None
        name, _, size = (length or "").partition("=")
        self.lengths, self.size = name.split(), size or None
        self.is_table = self.direction != "in" and len(self.lengths) == 2


class Routine:
    """One routine with its arguments, its summary, lines about arguments, and words for the functions of other languages

    about: pairs of argument names and text; lines of a table have no names.
    """

    def __init__(self, name, arguments):
        self.name = name
        self.arguments = [Argument(text) for text in arguments.split(",") if text.strip()]
        self.text, self.about, self.words = [], [], []

    @property
    def shown(self):
        """Name of a setting or result in messages, "" for routines with a Fortran interface of their own"""
        return next((word for word in self.words if word.lower() == self.name), "")

    def kinds(self, title):
        """Letter for the problems of the routine, see SCOPES, then one letter for each argument.

        e, p: result element, patch; i, r: integer, real number; n: length of an array; I, R, P, T with the position of their
        length: arrays of integers, of real numbers and of pairs, a text; x: a result; X with the position of its length: an array
        with one length.
        """
        names = [item.name for item in self.arguments]
        lengths = {item.lengths[-1] for item in self.arguments if item.lengths and not item.is_table}
        kinds = next((SCOPES[word] for word in (*self.words, title.split(" of ")[-1]) if word in SCOPES), "s")
        for item in self.arguments:
            is_result = item.direction != "in"
            if item.lengths and not item.is_table:
                letter = "X" if is_result else "P" if len(item.lengths) == 2 else {"int": "I", "real": "R", "text": "T"}[item.kind]
                kinds += letter + str(names.index(item.lengths[-1]))
            elif is_result:
                kinds += "x"
            else:
                kinds += {"ire": "e", "icp": "p"}.get(item.name) or ("n" if item.name in lengths else item.kind[0])
        return kinds

    def describe(self, line):
        """Parse an indented line of the table"""
        argument = re.fullmatch(r"- ([\w, ]+): (.+)", line)
        if argument:
            self.about.append(argument.groups())
        elif line.startswith("|"):
            self.about.append(("", line[2:]))
        elif line.startswith("@ "):
            self.words = [word.strip() for word in line[2:].split(",")]
        else:
            self.text.append(line)


class Constant:
    """One named number"""

    def __init__(self, name, value, text):
        self.name, self.value, self.text = name, int(value), text


def element_fields():
    """Constants of the element fields, from their list in the sources"""
    with open(os.path.join(TOP, "src/patch/result.f90"), encoding="utf-8") as file:
        text = file.read()
    fields, letters = {}, {"mm": "L", "N/mm2": "F/L2"}
    for code, name, unit, meaning in re.findall(r'call add\((\d+), "(\w+)", "([^"]*)", "([^"]*)"', text):
        _, texts = fields.setdefault(int(code), (name, []))
        # slip in shifts is in mm in all units
        texts.append(f"{meaning} [{unit if texts else letters.get(unit, unit)}]")
    return [Constant("CNTC_fld_" + name, code, "; ".join(texts)) for code, (name, texts) in sorted(fields.items())]


def quantities():
    """Unit and meaning of element fields, one pair for each kind of motion, and of totals, from their lists in the sources"""
    fields, totals = {}, {}
    for name in ("src/patch/result.f90", "src/wheelrail/result.f90"):
        with open(os.path.join(TOP, name), encoding="utf-8") as file:
            text = re.sub(r"&\s*\n\s*&?", "", file.read())
        for field, unit, meaning in re.findall(r'call add\(\d+, "(\w+)", "([^"]*)", "([^"]*)"', text):
            fields.setdefault(field, []).append((unit, meaning))
        for total, unit, meaning in re.findall(r'call list%add(?:_friction)?\("(\w+)", "([^"]*)", "([^"]*)"', text):
            totals[total] = (unit, meaning)
        for total, meaning in re.findall(r'call list%count\("(\w+)", "([^"]*)"', text):
            totals[total] = ("", meaning)
    return fields, totals


def read_table():
    """Sections of the table as (title, list of constants or routines); undocumented routines separately"""
    constants, routines, undocumented = [], [], []
    items = None
    with open(os.path.join(HERE, "interface.txt"), encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            line = line.rstrip()
            if not line or line.startswith("#"):
                continue
            section = re.fullmatch(r"\[(constants|routines) (.+)\]", line)
            constant = re.fullmatch(r"(CNTC_\w+) = (-?\d+)  (.+)", line)
            routine = re.fullmatch(r"(\w+)\((.*)\)", line)
            if section:
                items = []
                (constants if section.group(1) == "constants" else routines).append((section.group(2), items))
            elif line == "[undocumented]":
                items = undocumented
            elif constant:
                items.append(Constant(*constant.groups()))
            elif line.startswith("CNTC_fld_*"):
                items += element_fields()
            elif routine:
                items.append(Routine(*routine.groups()))
            elif line.startswith("   "):
                items[-1].describe(line.strip())
            else:
                raise SystemExit(f"interface.txt:{number}: '{line}' is not valid")
    return constants, routines, undocumented


def wrapped(words, first, indent, ending=""):
    """The words, separated by blanks, in lines of at most WIDTH characters; all lines but the last end with ending"""
    lines = textwrap.wrap(" ".join(words), WIDTH - len(ending), initial_indent=first, subsequent_indent=indent,
                          break_long_words=False, break_on_hyphens=False)
    return [line + ending for line in lines[:-1]] + lines[-1:]


def description(routine, width):
    """Lines that describe a routine and its arguments"""
    lines = textwrap.wrap(" ".join(routine.text), width)
    for names, text in routine.about:
        if names:
            lines += textwrap.wrap(f"{names}: {text}", width, initial_indent="  ", subsequent_indent="      ",
                                   break_long_words=False, break_on_hyphens=False)
        else:
            lines.append("  " + text)
    return lines


def c_header(routines):
    """Text of contact_addon.h"""
    kinds = {"int": "int", "real": "double", "text": "char"}
    lines = ["/* CONTACT: rolling and sliding contact with friction - routines of the library for C and C++.",
             f" * {ORIGIN}",
             " *",
             " * Each argument is passed by its address, single numbers included. Arrays are preceded by their",
             " * length; texts need no terminating null. No address is kept after a call.",
             " * Units: L length, F force, V velocity, A angle [rad], T time [s]; flag CNTC_if_units selects mm or",
             " * m. The named numbers are in caddon_flags.h; the library is described in doc/user/library.md. */",
             "#ifndef CONTACT_ADDON_H", "#define CONTACT_ADDON_H", "",
             "#ifdef __cplusplus", 'extern "C" {', "#endif"]
    for title, items in routines:
        lines += ["", f"/* ---- {title} ---- */"]
        for routine in items:
            about = description(routine, WIDTH - 6)
            lines += [""] + [("/* " if line is about[0] else " * ") + line + (" */" if line is about[-1] else "") for line in about]
            # no-break spaces keep the words of an argument on one line
            words = [("const " if argument.direction == "in" else "") + kinds[argument.kind] + " *" + argument.name
                     for argument in routine.arguments] or ["void"]
            start = f"void {routine.name}("
            joined = ", ".join(words).replace(" ", "\xa0").replace(",\xa0", ", ") + ");"
            start = start.replace(" ", "\xa0")
            lines += [line.replace("\xa0", " ") for line in
                      textwrap.wrap(start + joined, WIDTH, subsequent_indent=" " * len(start))]
    lines += ["", "#ifdef __cplusplus", "}", "#endif", "", "#endif"]
    return lines


def c_constants(constants):
    """Text of caddon_flags.h"""
    lines = ["/* Named numbers of the CONTACT library, as in caddon_flags.inc for Fortran.",
             f" * {ORIGIN} */",
             "#ifndef CADDON_FLAGS_H", "#define CADDON_FLAGS_H", "", "enum caddon_flags {"]
    all_items = [item for _, items in constants for item in items]
    for title, items in constants:
        lines += [f"  /* {title} */"]
        for item in items:
            comma = "" if item is all_items[-1] else ","
            lines += [f"  {item.name} = {item.value}{comma} /* {item.text} */"]
    return lines + ["};", "", "#endif"]


def fortran_constants(constants):
    """Text of caddon_flags.inc: valid in free and in fixed source form, with and without preprocessing"""
    lines = ["! Named numbers of the CONTACT library, to be included among declarations.", f"! {ORIGIN}"]
    for title, items in constants:
        lines += ["!", f"! {title}"]
        for item in items:
            lines += [f"! {item.text}", f"      integer, parameter :: {item.name} = {item.value}"]
    return lines


def fortran_declaration(argument):
    """Declaration of one dummy argument"""
    kinds = {"int": "integer(c_int)", "real": "real(c_double)", "text": "character(kind=c_char)"}
    intent = "in" if argument.direction == "in" else "inout"
    return f"{kinds[argument.kind]}, intent({intent}) :: {argument.name}" + ("(*)" if argument.is_array else "")


def fortran_interfaces(routines):
    """Text of contact_addon.ifc"""
    kinds = {"int": "c_int", "real": "c_double", "text": "c_char"}
    lines = ["! Interfaces of the routines of the CONTACT library, to be included among declarations.",
             f"! {ORIGIN}",
             "! Results are intent(inout): a call that is refused does not change them.",
             "! Units: L length, F force, V velocity, A angle [rad], T time [s]; see doc/user/library.md.",
             "interface"]
    for title, items in routines:
        lines += ["", f"   ! ---- {title} ----"]
        for routine in items:
            lines += [""] + ["   ! " + line for line in description(routine, WIDTH - 5)]
            names = ", ".join(argument.name for argument in routine.arguments)
            lines += wrapped([f"subroutine {routine.name}({names})", f'bind(c, name="{routine.name}")'],
                             "   ", "      ", " &")
            used = sorted({kinds[argument.kind] for argument in routine.arguments})
            if used:
                lines += [f"      use, intrinsic :: iso_c_binding, only : {', '.join(used)}"]
            lines += ["      " + fortran_declaration(argument) for argument in routine.arguments]
            lines += [f"   end subroutine {routine.name}"]
    return lines + ["", "end interface"]


def version():
    """Version of the project, defined in src/cli/versions.f90"""
    with open(os.path.join(TOP, "src/cli/versions.f90"), encoding="utf-8") as file:
        return re.search(r'contact_version = "([0-9.]+)"', file.read()).group(1)


def python_tables(constants, routines, undocumented):
    """Text of _signatures.py: the declarations for ctypes"""
    codes = {("int", False): "i", ("int", True): "I", ("real", False): "d", ("real", True): "D", ("text", True): "s"}
    lines = ['"""Arguments of the routines of the library, its named numbers, units and meaning of results.', "", ORIGIN, '"""', "",
             f'VERSION = "{version()}"', "",
             "#: Arguments of each routine: name, > for a result, type: i int, I ints, d double, D doubles, s text",
             "SIGNATURES = {"]
    for _, items in routines + [("", undocumented)]:
        for routine in items:
            arguments = [argument.name + (":" if argument.direction == "in" else ":>")
                         + codes[argument.kind, argument.is_array] for argument in routine.arguments]
            lines += wrapped([f'"{routine.name}":', f'"{" ".join(arguments)}",'], "    ", "        ") \
                if len(" ".join(arguments)) < 60 else \
                [f'    "{routine.name}": ('] + [f'        "{part}"' for part in split_text(arguments)] + ["    ),"]
    lines += ["}", "", "#: The named numbers without CNTC_", "MAGIC_NUMBERS = {"]
    for title, items in constants:
        lines += [f"    # {title}"]
        lines += [f'    "{item.name[5:]}": {item.value},  # {item.text}' for item in items]
    fields, totals = quantities()
    lines += ["}", "", "#: Unit and meaning of element fields: in rolling, and in shifts if these differ",
              "FIELDS = {"]
    lines += [f'    "{name}": (' + " ".join(f'("{unit}", "{meaning}"),' for unit, meaning in rows) + "),"
              for name, rows in sorted(fields.items())]
    lines += ["}", "", "#: Unit and meaning of totals", "TOTALS = {"]
    lines += [f'    "{name}": ("{unit}", "{meaning}"),' for name, (unit, meaning) in sorted(totals.items())]
    return lines + ["}"]


def c_doors(routines, undocumented):
    """Text of doors.c: names of routines, numbers of arguments, kinds of arguments"""
    lines = ["/* The routines that the library exports, see door.h: their number of arguments, positions of ire, icp and ierror,",
             f" * and kinds of arguments. {ORIGIN} */", '#include "door.h"', ""]
    for title, routine in [(title, item) for title, items in routines + [("", undocumented)] for item in items]:
        names = [argument.name for argument in routine.arguments]
        places = ", ".join(str(names.index(name) if name in names else -1) for name in ("ire", "icp", "ierror"))
        if routine.shown:
            lines.append(f'ROUTINE({routine.name}, {len(names)}, {places}, "{routine.shown}", "{routine.kinds(title)}")')
        else:
            lines.append(f"DOOR({routine.name}, {len(names)}, {places})")
    return lines


def page(constants, routines):
    """Text of doc/user/routines.md"""
    lines = [
        "# Routines and named numbers of the library", "",
        "All routines of [the library](library.md) with their arguments as in C and Fortran, and the named numbers of flags,",
        "fields and codes. Matlab and Python have functions of the same names without the lengths of arrays. Units: L length,",
        "F force, V velocity, A angle [rad], T time [s]; the flag `CNTC_if_units` selects mm or m. An array has its",
        "length in brackets; fields have one value per element, x running fastest.", "", f"<!-- {ORIGIN} -->"]
    for title, items in routines:
        lines += ["", f"## {title}"]
        for routine in items:
            names = ", ".join(item.name + (f"[{', '.join(item.lengths)}]" if item.lengths else "") for item in routine.arguments)
            results = [f"`{item.name}`" for item in routine.arguments if item.direction != "in"]
            lines += ["", f"### {routine.name}", "", f"`{routine.name}({names})`", "", " ".join(routine.text)]
            if results:
                lines[-1] += f" Results: {', '.join(results)}."
            table = False
            for about, text in routine.about:
                if table and about:
                    lines.append("```")
                if not table and not about:
                    lines += ["", "```text"]
                elif about:
                    lines += [""] if table or not lines[-1].startswith("- ") else []
                    lines.append("- " + ", ".join(f"`{name}`" for name in about.split(", ")) + f": {text}")
                if not about:
                    lines.append(text)
                table = not about
            lines += ["```"] if table else []
    # asterisks after names are not emphasis
    lines = [re.sub(r"(?<!`)\b(CNTC_[a-z]+_\*|CNTC_\w+)", r"`\1`", line) if line[:2] == "- " else line for line in lines]
    lines += ["", "## Named numbers"]
    for title, items in constants:
        lines += ["", f"### {title}", "", "| name | number | meaning |", "|---|---|---|"]
        lines += [f"| `{item.name}` | {item.value} | {item.text} |" for item in items]
    return lines


def split_text(words):
    """The words in lines of at most 80 characters; all but the last end with a blank"""
    pieces = textwrap.wrap(" ".join(words), 80, break_on_hyphens=False)
    return [piece + " " for piece in pieces[:-1]] + pieces[-1:]


def main():
    """Write the files, or compare them with those present"""
    if len(sys.argv) > 2 or sys.argv[1:] not in ([], ["--check"]):
        raise SystemExit(__doc__)
    constants, routines, undocumented = read_table()
    files = {
        "include/contact_addon.h": c_header(routines),
        "include/caddon_flags.h": c_constants(constants),
        "include/caddon_flags.inc": fortran_constants(constants),
        "include/contact_addon.ifc": fortran_interfaces(routines),
        "src/capi/doors.c": c_doors(routines, undocumented),
        "doc/user/routines.md": page(constants, routines),
        "python/contact/_signatures.py": python_tables(constants, routines, undocumented),
    }
    files.update(make_matlab.files(constants, routines, TOP, ORIGIN))
    stale = []
    for name, lines in files.items():
        text = "\n".join(lines) + "\n"
        path = os.path.join(TOP, name)
        if sys.argv[1:]:
            with open(path, encoding="utf-8") as file:
                if file.read() != text:
                    stale.append(name)
        else:
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
    for name in stale:
        print(f"{name} is not up to date: run src/capi/make_interface.py")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
