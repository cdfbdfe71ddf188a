#!/usr/bin/env python3
"""Writable data of all modules that all threads share: only those listed here, with their owner.

usage: statics.py NM FILE_WITH_NAMES_OF_OBJECTS
"""
import os
import re
import shutil
import subprocess
import sys

SKIPPED = 77
KNOWN = {
    "__contact_capi_library_MOD_library": "the problems of the callers; every access is inside `contact_registry` or atomic",
    "__contact_text_bounds_MOD_i": "counts in constants, evaluated by the compiler; not used at run time",
    "__contact_control_digits_MOD_i": "the same",
    "caught": "of the program only: the signal that ends the run",
    "child": "set once, in a forked process that has one thread",
    "floats_of_host": "one per thread",
    "floats_are_held": "one per thread",
    "problem_of_call": "one per thread",
    "turns": "guarded by its lock",
    "stage_of_call": "one per thread",
    "guarded_thread": "one per thread",
    "owners": "counted atomically",
    "__contact_profile_store_MOD_last_number": "counted atomically",
    "whole_process": "set once, before the libraries of the program are initialised",
    "watched": "set once, when the code is loaded",
    "real": "addresses of functions, set once when the code is loaded",
    "reserve": "memory for requests that were refused, guarded by reserve_lock",
    "reserve_lock": "its lock",
    "reserve_place": "guarded by reserve_lock",
    "reserve_pieces": "counted atomically",
    "reserve_uses": "counted atomically",
    "table": "blocks of memory and their owners; atomic",
    "area_at": "addresses of the areas of kept blocks; atomic",
    "lock_of_areas": "lock of what other threads change in an area",
    "__contact_fft_kept_plans_MOD_kept": "plans of all windows of a size; every access is inside `contact_fft_planner`",
    "__contact_fft_kept_plans_MOD_n_kept": "their number, the same",
    ".gomp_critical_user_contact_registry": "lock of the registry",
    ".gomp_critical_user_contact_printing": "lock of the .out file of the library",
    "__contact_cases_machine_pace_MOD_found": "speed of the machine; every access is inside `contact_machine_pace`",
    ".gomp_critical_user_contact_machine_pace": "lock of its measurement",
    ".gomp_critical_user_contact_fft_planner": "lock of FFTW's planner",
}
# Tables of types, which are read only; in C++, addresses that are set when the code is loaded
CONSTANT = re.compile(r"_MOD___(vtab|def_init)_|^DW\.ref\.")
# Sections that are writable while the program runs; .data.rel.ro is not
WRITABLE = re.compile(r"\.(t?data|t?bss)(?!\.rel\.ro)(\.|$)|\*COM\*$")


def statics(nm, files):
    """Writable variables of object files: name, file"""
    text = subprocess.run([nm, "--format=sysv", "--defined-only", *files], check=True, capture_output=True, text=True).stdout
    file = ""
    for line in text.splitlines():
        if line.startswith("Symbols from "):
            file = os.path.basename(line.rstrip(":"))
        parts = [part.strip() for part in line.split("|")]
        if len(parts) == 7 and parts[3] in ("OBJECT", "TLS") and WRITABLE.match(parts[6]) and not CONSTANT.search(parts[0]):
            yield parts[0], file


def main():
    """Compare the data found with the list"""
    nm, names = sys.argv[1:]
    if not shutil.which(nm):
        print("skipped: there is no nm to examine object files")
        return SKIPPED
    with open(names, encoding="utf-8") as file:
        files = file.read().splitlines()
    found = {}
    for name, source in statics(nm, files):
        found.setdefault(name, set()).add(source)
    strange = sorted(set(found) - set(KNOWN))
    for name in strange:
        print(f"FAILED {name} in {', '.join(sorted(found[name]))} is shared by all threads"
              + ("; see the traps of gfortran in doc/develop/house.md" if name.startswith("slen") else ""))
    missing = sorted(set(KNOWN) - set(found))
    for name in missing:
        print(f"FAILED {name}, {KNOWN[name]}, does not exist; remove it from the list")
    print(f"{len(files)} object files, {len(found)} variables that threads share, {len(strange)} of them unknown")
    return 1 if strange or missing or len(files) < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
