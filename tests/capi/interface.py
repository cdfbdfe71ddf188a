#!/usr/bin/env python3
"""The table of the interface, the files made from it, the exports of the library, and its sources agree.

usage: interface.py C_COMPILER LIBRARIES
"""
import glob
import os
import re
import subprocess
import sys

SOURCE = os.environ["CONTACT_SOURCE"]
sys.path.insert(0, os.path.join(SOURCE, "src/capi"))
import make_interface

KINDS = {"integer(c_int)": "int", "real(c_double)": "real", "character(kind=c_char)": "text"}
failures = []


def check(condition, what):
    """Count one check"""
    if not condition:
        failures.append(what)
        print(f"FAILED {what}")


def routines():
    """All routines of the table by name"""
    _, documented, undocumented = make_interface.read_table()
    items = [item for _, group in documented for item in group] + undocumented
    return {item.name: item for item in items}


def declared(compiler, header):
    """Functions that a header declares"""
    text = subprocess.run([compiler, "-E", "-P", os.path.join(SOURCE, "include", header)], check=True,
                          capture_output=True, text=True).stdout
    return set(re.findall(r"([A-Za-z_]\w*)\s*\(", text))


def exported(library):
    """Functions exported by the library"""
    text = subprocess.run(["nm", "-D", "--defined-only", library], check=True, capture_output=True, text=True).stdout
    return {line.split()[-1].split("@")[0] for line in text.splitlines()}


def implemented():
    """Arguments (name, kind, array, result) of each bound routine in the sources"""
    found = {}
    for path in glob.glob(os.path.join(SOURCE, "src/capi/*.f90")):
        with open(path, encoding="utf-8") as file:
            text = re.sub(r"&\s*\n\s*&?", " ", file.read())
        for match in re.finditer(r"^\s*subroutine (\w+)\s*(?:\((.*?)\))?\s*bind\(c.*?\)(.*?)^\s*end subroutine \1", text,
                                 re.MULTILINE | re.DOTALL):
            name, names, body = match.groups()
            kinds = {}
            for line in body.splitlines():
                declaration = re.match(r"\s*(integer\(c_int\)|real\(c_double\)|character\(kind=c_char\))"
                                       r", intent\((in|out|inout)\).*? :: (.*)", line)
                if declaration:
                    kind, intent, items = declaration.groups()
                    for item in items.split(","):
                        item = item.strip()
                        kinds[item.rstrip("(*)")] = (KINDS[kind], item.endswith("(*)"), intent != "in")
            found[name] = [(word, *kinds.get(word, (None, None, None)))
                           for word in (part.strip() for part in (names or "").split(",")) if word]
    return found


def matlab(table):
    """Functions for Matlab: few are written by hand, and each routine has one"""
    constants, documented, _ = make_interface.read_table()
    made = {os.path.basename(name)[:-2] for name in make_interface.make_matlab.files(constants, documented, SOURCE, "")}
    here = {os.path.basename(path)[:-2] for path in glob.glob(os.path.join(SOURCE, "matlab", "*.m"))}
    own = {name for name in here - made if name.startswith("cntc_")}
    check(len(own) <= 20, f"{len(own)} functions cntc_* of matlab/ are written by hand: {sorted(own)}")
    for name, routine in table.items():
        words = set(routine.words)
        check(name in made or not words or name in here or "no function" in words, f"{name} has no function in matlab/")
        check(not ("by hand" in words and name not in here), f"matlab/{name}.m is said to be written by hand and is not there")


def members(file, kind):
    """Names and numbers of a list of codes in the sources"""
    with open(os.path.join(SOURCE, "src", file), encoding="utf-8") as text:
        block = text.read().split(f"type :: {kind}\n")[1].split("end type")[0]
    return {name: int(value) for name, value in re.findall(r"(\w+) = (-?\d+)", re.sub(r"!.*", "", block))}


def numbers():
    """Named numbers of the table are those of the sources"""
    constants, _, _ = make_interface.read_table()
    values = {item.name[5:]: item.value for _, items in constants for item in items}

    def of(*prefixes):
        return {value for name, value in values.items() if name.startswith(prefixes)}

    flags = {re.sub("^i[cf]_", "", name): value for name, value in values.items()
             if name.startswith(("ic_", "if_", "own_")) and name != "if_debug"}
    check(members("control/flags.f90", "flag_list") == flags, "flags of control/flags.f90")
    check(set(members("capi/flags.f90", "metadata_code_list").values()) == of("mt_"), "metadata of capi/flags.f90")
    check(set(members("control/units.f90", "convention_code_list").values()) == of("un_"), "conventions of control/units.f90")
    codes = members("control/library_codes.f90", "library_code_list").values()
    check({code for code in codes if -100 < code < 0} == of("err_"), "errors of control/library_codes.f90")
    kinds = set(members("control/library_codes.f90", "input_type_list").values())
    check(kinds <= of("inp_"), "kinds of input files of control/library_codes.f90")


def main():
    """Compare all"""
    compiler, *libraries = sys.argv[1:]
    check(libraries, "there are libraries to look at")
    table = routines()
    check(len(table) == 73, f"{len(table)} routines in the table")
    documented = {name for name in table if name not in ("cntc_calculate1", "cntc_calculate3")}
    check(declared(compiler, "contact_addon.h") == documented, "contact_addon.h declares what the table lists")
    expected = set(table) | {name + "_" for name in table} | declared(compiler, "contact.h")
    for library in libraries:
        shown = exported(library)
        check(not expected - shown, f"{library} does not export {sorted(expected - shown)}")
        check(not shown - expected, f"{library} exports routines without a header: {sorted(shown - expected)}")
    sources = implemented()
    with open(os.path.join(SOURCE, "src/capi/routines.f90"), encoding="utf-8") as file:
        made = [name for names in re.findall(r'^ *case \(("\w.*?)\)', file.read(), re.MULTILINE)
                for name in re.findall(r'"(\w{2,})"', names)]
    check(sorted(made) == sorted(item.shown for item in table.values() if item.shown), "routines.f90 does those of the table")
    for name, routine in table.items():
        if routine.shown:
            check(name not in sources, f"{name} is in routines.f90 and has a Fortran routine of its own")
            continue
        if name not in sources:
            check(False, f"{name} is nowhere in src/capi")
            continue
        arguments = [(item.name, item.kind, item.is_array, item.direction != "in") for item in routine.arguments]
        check(sources[name] == arguments, f"{name}: table {arguments}, source {sources[name]}")
    matlab(table)
    numbers()
    print(f"{len(table)} routines, {len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
