#!/usr/bin/env python3
"""Write the tables of the library's routines and named numbers for Matlab and Octave from src/capi/interface.txt.

    python3 matlab/make_tables.py            writes the files, run it after a change of interface.txt
    python3 matlab/make_tables.py --check    exit status 1 when a file is not what would be written
"""
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(HERE), "src", "capi"))
import make_interface  # noqa: E402

ORIGIN = "% Made by matlab/make_tables.py from src/capi/interface.txt; change those."
LETTERS = {("in", "int"): "i", ("in", "real"): "r", ("in", "text"): "s",
           ("out", "int"): "I", ("inout", "int"): "I", ("out", "real"): "R", ("inout", "real"): "R"}


def magic_numbers(constants):
    lines = ["function [ CNTC ] = cntc_getmagicnumbers( )",
             "% CNTC_GETMAGICNUMBERS  Struct with the numbers that stand for flags, fields, and so on.", "%",
             "%   CNTC = cntc_getmagicnumbers()"]
    for title, items in constants:
        lines += ["%", f"% {title}", "%"]
        lines += [f"%   CNTC.{item.name.removeprefix('CNTC_'):<12} {item.text}" for item in items]
    lines += ["%", ORIGIN, ""]
    for _, items in constants:
        lines += [f"   CNTC.{item.name.removeprefix('CNTC_')} = {item.value};" for item in items]
    return lines + ["", "end % function cntc_getmagicnumbers"]


def signatures(routines):
    lines = ["function [ letters ] = cntc_signature( name )",
             "% CNTC_SIGNATURE  Kinds of the arguments of a routine of the library, one letter each.", "%",
             "%   i, r, s   integers, real numbers, text going in",
             "%   I, R      integers, real numbers coming out", "%", ORIGIN, "",
             "   persistent table;", "   if (isempty(table))"]
    for _, items in routines:
        for routine in items:
            letters = "".join(LETTERS[argument.direction, argument.kind] for argument in routine.arguments)
            lines.append(f"      table.{routine.name} = '{letters}';")
    return lines + ["   end", "   if (~isfield(table, name))",
                    "      error('cntc_signature: the library has no routine %s.', name);", "   end",
                    "   letters = table.(name);", "", "end % function cntc_signature"]


def main():
    constants, routines = make_interface.read_table()[:2]
    files = {"cntc_getmagicnumbers.m": magic_numbers(constants),
             os.path.join("private", "cntc_signature.m"): signatures(routines)}
    status = 0
    for name, lines in files.items():
        path = os.path.join(HERE, name)
        text = "\n".join(lines) + "\n"
        if sys.argv[1:] == ["--check"]:
            with open(path, encoding="utf-8") as file:
                if file.read() != text:
                    print(f"matlab/{name} is not what make_tables.py writes from interface.txt")
                    status = 1
        else:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
    return status


if __name__ == "__main__":
    sys.exit(main())
