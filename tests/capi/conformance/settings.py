#!/usr/bin/env python3
"""Every value that is set has its effect: in each unit convention, in the written input, and in the program.

usage: settings.py contact | pair
"""
import json
import os
import re
import subprocess
import sys

import numpy as np
from checks import check, close, finish, profiles, same

try:
    import h5py
except ImportError:
    print("skipped: h5py is not installed")
    sys.exit(77)
from contact import cntc
from contact._library import last_error
from contact.cntc import CNTC

#: Factor of lengths, sign of values that act on the other body
UNITS = {"un_cntc": (1.0, 1.0), "un_si": (1e-3, 1.0), "un_spck": (1e-3, -1.0)}
FLAT = [0.28, 0.31, 82e3, 75e3]


def steel(big, *more):
    """Elastic constants, and derived ones"""
    return [0.28, 0.31, 82e3 / big**2, 75e3 / big**2, *more]


def with_force(ire, icp):
    """A prescribed normal force"""
    cntc.setflags(ire, icp, CNTC["ic_norm"], 1)
    cntc.setnormalforce(ire, icp, 33000)


# Module 3: settings in addition to a small problem of rolling, and rows of the input written for it [mm, N, rad, s]
CONTACT = {
    "IPOTCN = -1": (lambda ire, icp, big, body: cntc.sethertzcontact(ire, icp, -1, [13, 11, 0.0021 / big, 0.0013 / big, 1.25]),
                    {"MX MY A1 B1 SCALE": [13, 11, 0.0021, 0.0013, 1.25], "IPOTCN": [-1]}),
    "IPOTCN = -2": (lambda ire, icp, big, body: cntc.sethertzcontact(ire, icp, -2, [13, 11, 0.0021 / big, 0.7, 1.25]),
                    {"MX MY A1 AOB SCALE": [13, 11, 0.0021, 0.7, 1.25]}),
    "IPOTCN = -3": (lambda ire, icp, big, body: cntc.sethertzcontact(ire, icp, -3, [13, 11, 4.2 * big, 5.1 * big, 1.25]),
                    {"MX MY AA BB SCALE": [13, 11, 4.2, 5.1, 1.25]}),
    "IPOTCN = -4": (lambda ire, icp, big, body: (
        cntc.sethertzcontact(ire, icp, -4, [13, 1, 0.0021 / big, 5.1 * big, 1.25]), with_force(ire, icp)),
                    {"MX MY A1 BB SCALE": [13, 1, 0.0021, 5.1, 1.25]}),
    "IPOTCN = -5": (lambda ire, icp, big, body: (
        cntc.sethertzcontact(ire, icp, -5, [13, 1, 4.2 * big, 5.1 * big, 1.25]), with_force(ire, icp)),
                    {"MX MY AA BB SCALE": [13, 1, 4.2, 5.1, 1.25], "IPOTCN": [-5]}),
    "IPOTCN = -6": (lambda ire, icp, big, body: (
        cntc.sethertzcontact(ire, icp, -6, [13, 11, 4.2 * big, 3.1 * big, 5.1 * big, 1.25]), with_force(ire, icp),
        cntc.setflags(ire, icp, [CNTC["ic_bound"], CNTC["ic_mater"]], [4, 3]), cntc.setmaterialparameters(ire, icp, 3, steel(big, 1,
            1, 1))),
                    {"MX MY AA BNEG BPOS SCALE": [13, 11, 4.2, 3.1, 5.1, 1.25]}),
    "G = 2": (lambda ire, icp, big, body: cntc.setsolverflags(ire, icp, 2, [901, 41, 31, 10, 1], [3e-6, 0.91, 1.02, 0.53]),
              {"MAXGS MAXIN MAXNR MAXOUT EPS": [901, 41, 31, 10, 3e-6], "OMEGAH OMEGAS INISLP OMGSLP": [0.91, 1.02, 1, 0.53]}),
    "G = 4": (lambda ire, icp, big, body: cntc.setsolverflags(ire, icp, 4, [901, 41, 31, 10, 1], [3e-6, 0.53]),
              {"INISLP OMGSLP": [1, 0.53]}),
    "G = 5": (lambda ire, icp, big, body: cntc.setsolverflags(ire, icp, 5, [901, 41, 31, 10, 2], [3e-6, 1.1, 0.7, 1.5, 0.01, 2.5,
        1.2, 1.3]),
              {"FDECAY BETATH KDOWFB D_IFC D_LIN D_CNS D_SLP POW_S": [1.1, 0.7, 2, 1.5, 0.01, 2.5, 1.2, 1.3]}),
    "M = 1": (lambda ire, icp, big, body: cntc.setmaterialparameters(ire, icp, 1, steel(big, 0.3, 0.4, 1e-4, 2e-4)),
              {"POISS1 POISS2 GG1 GG2": FLAT, "FG1 FG2 TC1 TC2": [0.3, 0.4, 1e-4, 2e-4]}),
    "M = 2": (lambda ire, icp, big, body: cntc.setmaterialparameters(ire, icp, 2, steel(big, 6.1e-5 * big**3, 0.9, 0.8, 1.7)),
              {"FLX K0_MF ALFAMF BETAMF": [6.1e-5, 0.9, 0.8, 1.7]}),
    "M = 3": (lambda ire, icp, big, body: cntc.setmaterialparameters(ire, icp, 3, steel(big, 0.9, 0.8, 1.7)),
              {"K0_MF ALFAMF BETAMF": [0.9, 0.8, 1.7]}),
    "M = 4": (lambda ire, icp, big, body: cntc.setmaterialparameters(ire, icp, 4, steel(big, 4.1e3 / big**2, 0.02 * big,
                                                                                        150 / big**2, 900 / big**3)),
              {"GG3 LAYTHK TAU_C0 K_TAU": [4.1e3, 0.02, 150, 900]}),
    "M = 5": (lambda ire, icp, big, body: cntc.setmaterialparameters(ire, icp, 5, steel(big, 0.9, 0.8, 1.7)),
              {"K0_MF ALFAMF BETAMF": [0.9, 0.8, 1.7]}),
    "damping": (lambda ire, icp, big, body: cntc.setmaterialparameters(ire, icp, 12, [1.1e-3, 1.2e-3, 1.3e9, 1.4e9]),
                {"CDAMPN CDAMPT DFNMAX DFTMAX": [1.1e-3, 1.2e-3, 1.3e9, 1.4e9]}),
    "L = 2": (lambda ire, icp, big, body: cntc.setfrictionmethod(ire, icp, 2, [0.2, 0.11, 101 * big, 0.05, 51 * big, 0.002 * big,
                                                                               11 * big]),
              {"~FKIN FLIN1 SABSH1 FLIN2 SABSH2": [0.2, 0.11, 101, 0.05, 51], "MEMDST MEM_S0": [0.002, 11]}),
    "L = 3": (lambda ire, icp, big, body: cntc.setfrictionmethod(ire, icp, 3, [0.2, 0.11, 101 * big, 0.05, 51 * big, 0.002 * big,
                                                                               11 * big]),
              {"~FKIN FRAT1 SABSH1 FRAT2 SABSH2": [0.2, 0.11, 101, 0.05, 51], "MEMDST MEM_S0": [0.002, 11]}),
    "L = 4": (lambda ire, icp, big, body: cntc.setfrictionmethod(ire, icp, 4, [0.2, 0.11, 101 * big, 0.05, 51 * big, 0.002 * big,
                                                                               11 * big]),
              {"~FKIN FEXP1 SABSH1 FEXP2 SABSH2": [0.2, 0.11, 101, 0.05, 51], "MEMDST MEM_S0": [0.002, 11]}),
    # Polach's law is an exponential one: half-value velocity ln 2/B
    "L = 5": (lambda ire, icp, big, body: cntc.setfrictionmethod(ire, icp, 5, [0.4, 0.55, 0.012 / big]),
              {"~FKIN FEXP1 SABSH1 FEXP2 SABSH2": [0.22, 0.18, np.log(2) / 0.012, 0, 10000], "MEMDST MEM_S0": [0.001, 10]}),
    "L = 6": (lambda ire, icp, big, body: (
        cntc.setfrictionmethod(ire, icp, 6, [0.4, 20.0, -0.21, 110.0, 0.002 * big, 11 * big]),
        cntc.settemperaturedata(ire, icp, 3, [15.0, 450.0, 0.051 / big, 7.8e-6 / big**3, 95.0, 460.0, 0.052 / big, 7.9e-6 / big**3,
                                              0.9])),
        {"~FREF TREF DFHEAT DTHEAT": [0.4, 20.0, -0.21, 110.0], "MEMDST MEM_S0": [0.002, 11], "BKTEMP 1": [15, 450, 0.051, 7.8e-6],
         "BKTEMP 2": [95, 460, 0.052, 7.9e-6]}),
    "F = 1": (lambda ire, icp, big, body: (cntc.setflags(ire, icp, CNTC["ic_force"], 1), cntc.settangentialforces(ire, icp, 0.4,
        0.0)),
              {"FX": 0.4}),
    "F = 2": (lambda ire, icp, big, body: (cntc.setflags(ire, icp, CNTC["ic_force"], 2), cntc.settangentialforces(ire, icp, 0.4,
        -0.3)),
              {"FX": 0.4, "FY": -0.3}),
    "N = 1": (lambda ire, icp, big, body: with_force(ire, icp), {"FN": 33000}),
    "motion": (lambda ire, icp, big, body: (cntc.setflags(ire, icp, CNTC["ic_tang"], 2), cntc.setrollingstepsize(ire, icp, np.pi,
        0.45 * big), cntc.setreferencevelocity(ire, icp, 19000 * big)),
               {"CHI DQ VELOC FACPHI": [np.pi, 0.45, 19000, 1 / 6]}),
}


def gap(mx, my, big):
    """Undeformed distances with no symmetry [mm]: rows one after the other"""
    x, y = np.meshgrid(np.arange(mx) - 0.45 * mx, np.arange(my) - 0.55 * my)
    return ((0.0021 * x**2 + 0.0016 * y**2 + 1e-4 * x * y) * big).reshape(-1)


def with_window(ire, icp, big, ibase, values):
    cntc.setpotcontact(ire, icp, 1, [16, 14, -6.1 * big, -5.2 * big, 0.8 * big, 0.7 * big])
    cntc.setundeformeddistc(ire, icp, ibase, values)


CONTACT.update({
    "IBASE = 1": (lambda ire, icp, big, body: with_window(ire, icp, big, 1, [0.0021 / big, 1e-4 / big, 0.0016 / big, 1e-3, 2e-3,
                                                                             1e-4 * big]),
                  {"B": [0.0021, 1e-4, 0.0016, 1e-3, 2e-3, 1e-4], "IBASE IPLAN": [1, 1]}),
    "IBASE = 2": (lambda ire, icp, big, body: with_window(ire, icp, big, 2, np.array([3, 0.2, 230.0, -6.0, 6.5, 0.03, 0.001,
                                                                                      0.02]) * [1] + 0
                                                          if big == 1 else np.array([3, 2e-4, 0.23, -6e-3, 6.5e-3, 3e-5, 1e-6,
                                                                                     2e-5])),
                  {"NN XM RM Y1 DY1": [3, 0.2, 230, -6, 6.5], "B": [0.03, 0.001, 0.02]}),
    "IBASE = 9": (lambda ire, icp, big, body: with_window(ire, icp, big, 9, gap(16, 14, big)), {}),
    "window by its corners": (lambda ire, icp, big, body: cntc.setpotcontact(ire, icp, 2, np.array([16, 14, -6.1, -5.2, 6.7,
        4.6]) * [1, 1, big, big, big, big]),
                              {"MX MY XL YL DX DY": [16, 14, -6.1, -5.2, 0.8, 0.7]}),
    "window by its first element": (lambda ire, icp, big, body: cntc.setpotcontact(ire, icp, 3, np.array([16, 14, -5.7, -4.85, 0.8,
        0.7]) * [1, 1, big, big, big, big]),
                                    {"MX MY XL YL DX DY": [16, 14, -6.1, -5.2, 0.8, 0.7]}),
    "window by first and last element": (lambda ire, icp, big, body: cntc.setpotcontact(ire, icp, 4, np.array([16, 14, -5.7, -4.85,
        6.3, 4.25]) * [1, 1, big, big, big, big]),
                                         {"MX MY XL YL DX DY": [16, 14, -6.1, -5.2, 0.8, 0.7]}),
})
# Curvatures and lengths of the sum of sines and of a circular body are shown by the window only
NEEDS_WINDOW = ("window",)


def rows_of(path):
    """Names and values of the rows of the last case of an input file"""
    with open(path, encoding="utf-8") as file:
        lines = [line for line in file.read().splitlines() if line.strip()]
    found = {}
    for line in lines[max(k for k, text in enumerate(lines) if "MODULE, RE" in text):]:
        row, _, names = line.partition("%")
        try:
            values = [float(word) for word in row.split()]
        except ValueError:
            continue
        found.setdefault(names.strip(), []).append(values)
    return found


def compare_rows(found, expected, label):
    """The rows exist with these values"""
    for names, values in expected.items():
        label_of_row = f"{label}: {names}"
        if isinstance(values, (float, int)):
            # one of the row of kinematics
            row = next((key for key in found if key.split()[:1] in (["PEN"], ["FN"])), None)
            check(row is not None and names in row.split(), f"{label_of_row}: a row {row}")
            if row is not None and names in row.split():
                close(found[row][0][row.split().index(names)], values, 1e-9 * abs(values), label_of_row)
        elif names in ("BKTEMP 1", "BKTEMP 2"):
            row = [value for key, value in found.items() if key.startswith("BKTEMP")]
            flat = [values_of_row for part in row for values_of_row in part]
            close(flat[int(names[-1]) - 1], values, 1e-9 * np.abs(values), label_of_row)
        elif names == "B":
            close([value for row in found["B"] for value in row], values, 1e-9 * np.abs(values), label_of_row)
        elif names.startswith("~"):
            # the names of friction are in the results only
            check(any(len(row) == len(values) and np.allclose(row, values, rtol=1e-9, atol=1e-300) for part in found.values()
                      for row in part),
                  f"{label_of_row}{values}: {found}")
        else:
            check(names in found, f"{label_of_row}: no such row: {list(found)}")
            if names in found:
                close(found[names][-1], values, 1e-9 * np.abs(values) + 1e-12, label_of_row)


def program_cases(name):
    """Results of the program for an input file: totals of the first patch of each case"""
    os.makedirs("program", exist_ok=True)
    subprocess.run([os.environ["CONTACT_PROGRAM"], "--quiet", "--json", "--hdf5", "--output-dir", "program", "2", name], check=True)
    with open(f"program/{name}.jsonl", encoding="utf-8") as file:
        return [case for case in map(json.loads, file) if case["case"] > 0]


# Values of both bodies in the HDF5 file
OF_BODIES = {"M = 1": {"poiss": [0.28, 0.31], "gg": [82e3, 75e3], "fg": [0.3, 0.4], "tc": [1e-4, 2e-4]},
             "L = 6": {f"{name}{body + 1}": values[body] for body in range(2) for name, values in {
                 "bktemp": [15, 95], "heatcp": [450, 460], "lambda": [0.051, 0.052], "dens": [7.8e-6, 7.9e-6]}.items()}}
reported = set()


def compare_results(name, expected, label):
    """The .out file and the HDF5 file contain the same values under their names"""
    with open(f"program/{name}.out", encoding="utf-8") as file:
        lines = file.read().splitlines()
    printed = {}
    for heading, line in zip(lines, lines[1:]):
        names, words = heading.split(), line.split()
        if len(names) > 1 and re.fullmatch(r"[A-Z][A-Z0-9_() ]*", heading.strip()):
            try:
                for key, value in zip(names, map(float, words)):
                    printed.setdefault(key, []).append(value)
            except ValueError:
                pass
    for k, line in enumerate(lines):
        # one row for each set of friction
        if re.match(r" +(ALPHA|SVF) ", line) and "rows" in expected:
            close([[float(word) for word in row.split()] for row in lines[k + 1:k + 1 + len(expected["rows"])]], expected["rows"],
                  6e-4 * np.abs(expected["rows"]), f"{label}: rows of friction in the .out file")
            reported.add("rows")
    recorded = {}
    with h5py.File(f"program/{name}.h5") as file:
        file.visititems(lambda path, item: recorded.update({path.split("/")[-1]: item[()]})
                        if "/inputs/" in path and isinstance(item, h5py.Dataset) else None)
    check("D_TURN" not in " ".join(lines) or "pair" not in name, f"{label}: D_TURN is printed only where it was chosen")
    for key, values in OF_BODIES.get(label, {}).items():
        close(recorded[key], values, 1e-9 * np.abs(values), f"{label}: {key} of both bodies in the HDF5 file")
    for k, line in enumerate(lines):
        if "BKTEMP" in line and label == "L = 6":
            for row, values in zip(lines[k + 1:k + 3], (expected["BKTEMP 1"], expected["BKTEMP 2"])):
                close([float(word) for word in row.split()], values, 6e-4 * np.abs(values), f"{label}: heat in the .out file")
    for names, values in expected.items():
        if names == "rows":
            check("rows" in reported, f"{label}: a table of friction")
        for key, value in zip(names.lstrip("~").split(), np.atleast_1d(values)):
            if "," in names or names[:-1] == "BKTEMP " or names == "rows":
                continue
            if key in printed:
                reported.add("out " + key)
                # rail and wheel have the same names
                nearest = min(printed[key], key=lambda number: abs(number - value))
                close(nearest, value, 6e-4 * abs(value) + 1e-9, f"{label}: {key} in the .out file")
            key = key.lower()
            # a library writes the window that it has made for itself
            if key in recorded and len(names.split()) > 2 and not label.startswith("window by"):
                reported.add("h5 " + key)
                found = np.atleast_1d(recorded[key])
                close(found[-1] if label.startswith("friction") else found[0], value, 1e-9 * abs(value),
                      f"{label}: {key} in the HDF5 file")


def contact_settings():
    """Module 3: set, solved, written, read again and solved by the program"""
    for number, (label, (setting, expected)) in enumerate(CONTACT.items(), 1):
        forces = {}
        for units, (big, body) in UNITS.items():
            name = f"set{number}_{units}"
            cntc.initlibrary(expnam=name)
            same(cntc.initialize(1, 3)[1], 0, f"{label}, {units}: initialize")
            cntc.setflags(1, 1, [CNTC["if_units"], CNTC["ic_tang"], CNTC["ic_pvtime"], CNTC["if_wrtinp"], CNTC["ic_output"]],
                          [CNTC[units], 3, 2, 1, 2])
            cntc.setsolverflags(1, 1, 0, [999, 50, 30, 10], [1e-6])
            cntc.setmaterialparameters(1, 1, 0, steel(big))
            cntc.setfrictionmethod(1, 1, 0, [0.3, 0.3])
            cntc.setreferencevelocity(1, 1, 20000 * big)
            cntc.setrollingstepsize(1, 1, 0.0, 0.5 * big)
            if label.startswith(NEEDS_WINDOW):
                with_window(1, 1, big, 1, [0.0021 / big, 0, 0.0016 / big, 0, 0, 0])
            else:
                cntc.sethertzcontact(1, 1, -3, [14, 12, 4 * big, 5 * big, 1.2])
            cntc.setpenetration(1, 1, 0.03 * big)
            cntc.setcreepages(1, 1, 0.0011, -0.0007, 0.0003 / big)
            setting(1, 1, big, body)
            code = cntc.calculate(1, 1, idebug=0)
            check(code >= 0 or code == -28, f"{label}, {units}: error code {code} {last_error(1, 1)[1]}")
            fn, fx, fy, mz = cntc.getcontactforces(1, 1)
            forces[units] = np.array([fn, fx * body, fy * body, mz * body / big])
            cntc.finalize(1)
            if not label.startswith("window by") or units == "un_cntc":
                rows = rows_of(name + ".inp")
                expected_rows = expected if not label.startswith("window by") else {}
                compare_rows(rows, {"CPHI": 0.0003, **expected_rows}, f"{label}, {units}")
        scale = np.abs(forces["un_cntc"][0]) * np.array([1.0, 0.3, 0.3, 3.0])
        for units in UNITS:
            close(forces[units], forces["un_cntc"], 2e-4 * scale, f"{label}: forces in {units}")
        totals = program_cases(f"set{number}_un_cntc")[-1]["patches"][0]["totals"]
        compare_results(f"set{number}_un_cntc", expected, label)
        found = [totals[key]["value"] for key in ("fn", "fx", "fy", "mz")]
        if label != "damping":
            close(found, forces["un_cntc"], 2e-4 * scale, f"{label}: forces of the program")


# Module 1: the same, on top of a wheel on a rail
PAIR = {
    "search": (lambda ire, big: (cntc.setpotcontact(ire, -1, -1, [0.41 * big, 0.43 * big, 1.5, 8.1 * big, 4.2 * big]),
                                 cntc.setrollingstepsize(ire, -1, 0.0, 1.1)),
               {"DX DS DQREL A_SEP D_SEP D_COMB": [0.41, 0.43, 1.1, 1.5, 8.1, 4.2]}),
    "track": (lambda ire, big: cntc.settrackdimensions(ire, 1, [14.1 * big, 0.0, 1436 * big, 0.026, 0.0, 2.5e-6 / big]),
              {"GAUGHT GAUGSQ|RAILY0 GAUGWD|RAILZ0 CANT CURV": [14.1, 0, 1436, 0.026, 2.5e-6]}),
    "deviations": (lambda ire, big: cntc.settrackdimensions(ire, 2, [0.51 * big, 0.12 * big, 0.0053, 1.4 * big, 0.6 * big, 0.0017]),
                   {"DYRAIL": [0.51, 0.12, 0.0053, 1.4, 0.6, 0.0017]}),
    "springs": (lambda ire, big: (cntc.setflags(ire, -1, CNTC["ic_force"], 3), cntc.settrackdimensions(
        ire, 33, [5.1e3 / big, 11.0, 8.2e4 / big, 12.0, 0.5 * big])), {"KYRAIL": [5.1e3, 11, 8.2e4, 12]}),
    "wheelset": (lambda ire, big: cntc.setwheelsetdimensions(ire, 3, np.array([1360.1, -70.2, 461.0]) * big),
                 {"FBDIST FBPOS NOMRADW YTAPE": [1360.1, -70.2, 461.0]}),
    "position": (lambda ire, big: cntc.setwheelsetposition(ire, 1, [5.1 * big, 1.9 * big, 0, -1.1e-4, 4.7e-3, 0.21]),
                 {"S_WS Y_WS FZ ROLL YAW PITCH": [5.1, 1.9, 10000, -1.1e-4, 4.7e-3, 0.21]}),
    "position of a roller rig": (lambda ire, big: (
        cntc.setflags(ire, -1, CNTC["ic_config"], 4), cntc.setwheelsetposition(ire, 1, [5.1 * big, 1.9 * big, 0, -1.1e-4, 4.7e-3,
                                                                                        0.21]),
        cntc.settrackdimensions(ire, 1, [14.0 * big, 0.0, 1435.0 * big, 0.0, 505.0 * big]),
        cntc.setwheelsetvelocity(ire, 2, [4.01, 0, 0, 0, 0, -4.35]), cntc.calculate(ire, -1, idebug=0),
        cntc.setflags(ire, -1, CNTC["ic_config"], 1), cntc.settrackdimensions(ire, 1, [14.0 * big, 0.0, 1435.0 * big, 0.0, 0.0]),
        cntc.setwheelsetvelocity(ire, 2, [2000 * big, 0, 0, 0, 0, -4.35])),
        {"S_WS Y_WS FZ ROLL YAW PITCH": [5.1, 1.9, 10000, -1.1e-4, 4.7e-3, 0.21]}),
    "height": (lambda ire, big: (cntc.setflags(ire, -1, CNTC["ic_norm"], 0), cntc.setwheelsetposition(ire, 1, [0, 2.0 * big,
        -0.091 * big, 0, 4.8e-3, 0])),
               {"S_WS Y_WS Z_WS ROLL YAW PITCH": [0, 2.0, -0.091, 0, 4.8e-3, 0]}),
    "velocity": (lambda ire, big: cntc.setwheelsetvelocity(ire, 2, [2010 * big, 0.3 * big, 0.2 * big, 1e-4, 2e-4, -4.351]),
                 {"VS": [2010, 0.3, 0.2, 1e-4, 2e-4, -4.351]}),
    "force": (lambda ire, big: (cntc.setflags(ire, -1, CNTC["ic_force"], 1), cntc.settangentialforces(ire, -1, -710.0, 0.0)),
              {"VS": [2000, 0, 0, 0, 0, -710]}),
    "flexible": (lambda ire, big: cntc.setwheelsetflexibility(ire, 5, [0.11 * big, 0.3 * big, 0.012 * big, 1.1e-3, 1.2e-3, 1.3e-3,
                                                                       2.1 * big, 3.1 * big, 0.4 * big, 0.011, 0.012, 0.013]),
                 {"DXWHL DYWHL DZWHL DROLLW DYAWW DPITCHW": [0.11, 0.3, 0.012, 1.1e-3, 1.2e-3, 1.3e-3],
                  "VXWHL VYWHL VZWHL VROLLW VYAWW VPITCHW": [2.1, 3.1, 0.4, 0.011, 0.012, 0.013]}),
    "friction by angle": (lambda ire, big: cntc.setfrictionmethod(ire, -1, 10, [2, -0.2, 0.1, 0.1, 0.1, 0.4, 0.4]), {"NVF": [2],
        "rows": [[-0.2, 0.1, 0.1], [0.1, 0.4, 0.4]]}),
    "friction by angle and slip": (lambda ire, big: cntc.setfrictionmethod(ire, -1, 12, [
        2, -0.2, 0.2, 0.11, 101 * big, 0.05, 51 * big, 0.002 * big, 11 * big,
        0.2, 0.3, 0.12, 102 * big, 0.06, 52 * big, 0.002 * big, 11 * big]),
        {"": [0.2, 0.3, 0.12, 102, 0.06, 52], "MEMDST MEM_S0": [0.002, 11]}),
    "friction by position": (lambda ire, big: cntc.setfrictionmethod(ire, -1, 20,
                                                                          [2, -100.0 * big, 0.1, 0.1, 100.0 * big, 0.4, 0.4]),
                          {"": [100, 0.4, 0.4], "rows": [[-100, 0.1, 0.1], [100, 0.4, 0.4]]}),
    "damping": (lambda ire, big: cntc.setmaterialparameters(ire, -1, 12, [1.1e-3, 1.2e-3, 1.3e9, 1.4e9]),
                {"CDAMPN CDAMPT DFNMAX DFTMAX": [1.1e-3, 1.2e-3, 1.3e9, 1.4e9]}),
    "roller": (lambda ire, big: (cntc.setflags(ire, -1, CNTC["ic_config"], 4), cntc.settrackdimensions(ire, 1, [14.0 * big, 0.0,
        1435.0 * big, 0.0, 505.0 * big]),
                                 cntc.setwheelsetvelocity(ire, 2, [4.01, 0, 0, 0, 0, -4.35])), {"RPITCH": [4.01, 0, 0, 0, 0, -4.35],
                                     "GAUGHT": [14, 0, 1435, 505]}),
    "options of a profile": (lambda ire, big: cntc.setprofileinputfname(ire, profiles()[0], [0, 0, 0, -1, 1, 2],
                                                                         [1.0, 0.4, 0.45, 2.7, 0.53, 0.11, 1.9 * big]),
                             {"'": [0, 1.0, 0.4, -1], "ISMOOTH": [2, 2.7, 0.53, 0.11, 1.9], "ERRHND": [1, 0.45]}),
    "file name with backslashes": (lambda ire, big: cntc.setprofileinputfname(ire, profiles()[0].replace("/", "\\"), [0], [1.0,
        0.0]),
                                   {"'": [0, 1.0, 0.0]}),
    "options of a wheel": (lambda ire, big: cntc.setprofileinputfname(ire, profiles()[1], [1, 0, 0, -1, 0, 0], [0.999, 0.0]),
                           {"'": [0, 0.999, 0.0, -1]}),
    "profile by values": (lambda ire, big: cntc.setprofileinputvalues(ire, np.array([[y, 40 - np.sqrt(1600 - y * y)]
                                                                                     for y in np.linspace(-30, 30, 241)]) * 1e-3,
                                                                      [0, 0, 0, 0], [1000.0, 0.0]), {"'": [0, 1000.0, 0.0]}),
}


def rows_of_pair(path):
    """Names and numbers of the rows of the last case of module 1"""
    with open(path, encoding="utf-8") as file:
        lines = [line for line in file.read().splitlines() if line.strip()]
    rows = []
    for line in lines[max(k for k, text in enumerate(lines) if "MODULE, RE" in text):]:
        row, _, names = line.partition("%")
        numbers = []
        for word in row.split():
            try:
                numbers.append(float(word))
            except ValueError:
                pass
        rows.append((("'" if "'" in row else "") + names.strip(), numbers))
    return rows


def pair_settings():
    """Module 1: the same in all unit conventions, in the input that is written and in the program"""
    rail, wheel = profiles()
    for number, (label, (setting, expected)) in enumerate(PAIR.items(), 1):
        forces = {}
        for units, (big, body) in UNITS.items():
            name = f"pair{number}_{units}"
            cntc.initlibrary(expnam=name)
            same(cntc.initialize(1, 1)[1], 0, f"{label}, {units}: initialize")
            cntc.setflags(1, -1, [CNTC[word] for word in ("if_units", "ic_config", "ic_tang", "ic_pvtime", "ic_discns", "ic_norm",
                                                          "if_wrtinp", "ic_output")],
                          [CNTC[units], 1, 3, 2, 2, 1, 2, 2])
            cntc.setsolverflags(1, -1, 0, [999, 100, 30, 1], [1e-6])
            cntc.setmaterialparameters(1, -1, 0, [0.28, 0.28, 82e3 / big**2, 82e3 / big**2])
            cntc.setfrictionmethod(1, -1, 0, [0.3, 0.3])
            cntc.setpotcontact(1, -1, -1, [0.5 * big, 0.5 * big, np.pi / 2, 8 * big, 4 * big])
            cntc.setrollingstepsize(1, -1, 0.0, 1.0)
            cntc.settrackdimensions(1, 3, np.array([14.0, 0.0, 1435.0] + 8 * [0.0]) * ([big, 1.0, big] + 8 * [1.0]))
            cntc.setprofileinputfname(1, rail, [0], [1.0, 0.0])
            cntc.setprofileinputfname(1, wheel, [1], [1.0, 0.0])
            cntc.setwheelsetdimensions(1, 3, np.array([1360.0, -70.0, 460.0]) * big)
            cntc.setwheelsetposition(1, 1, [0, 2.0 * big, 0, 0, 0.0048, 0])
            cntc.setwheelsetvelocity(1, 2, [2000 * big, 0, 0, 0, 0, -4.35])
            cntc.setverticalforce(1, 10000.0)
            setting(1, big)
            same(cntc.calculate(1, -1, idebug=0), 0, f"{label}, {units}: error code ({last_error(1, -1)[1]})")
            forces[units] = np.array(cntc.getglobalforces(1, -1)[:3]) * body
            cntc.finalize(1)
            rows = rows_of_pair(name + ".inp")
            for names, values in expected.items():
                if names == "rows":
                    continue
                check(any((row_names.startswith(names) or names == "") and len(row) >= len(values)
                          and np.allclose(row[:len(values)], values, rtol=1e-9, atol=1e-12) for row_names, row in rows),
                      f"{label}, {units}: {names} {values} in {rows}")
        largest = np.abs(forces["un_cntc"]).max()
        for units in UNITS:
            close(forces[units], forces["un_cntc"], 1e-4 * largest, f"{label}: forces in {units}")
        last = program_cases(f"pair{number}_un_cntc")[-1]
        totals, effects = last["totals"], " ".join(patch["effects"] for patch in last["patches"])
        for words, labels in (("by inclination", ("friction by angle", "friction by angle and slip")), ("by position",
            ("friction by position",))):
            same(words in effects, label in labels, f"{label}: {effects}")
        compare_results(f"pair{number}_un_cntc", expected, label)
        if label != "damping":
            close([totals[key]["value"] for key in ("fx_tr", "fy_tr", "fz_tr")], forces["un_cntc"], 1e-4 * largest,
                  f"{label}: forces of the program")


def written_changes():
    """Module 3: what changes after digits that keep everything, or before them, is in the input that is written"""
    def keep_all():
        cntc.setfrictionmethod(1, 1, 1, [])
        cntc.setsolverflags(1, 1, 1)
        cntc.setmaterialparameters(1, 1, 11, [])
        cntc.setflags(1, 1, [CNTC["ic_inflcf"]], [1])

    changes = {
        "friction": lambda: cntc.setfrictionmethod(1, 1, 0, [0.1, 0.1]),
        "falling friction": lambda: cntc.setfrictionmethod(1, 1, 4, [0.2, 0.1, 3000, 0.05, 8000, 1e-3, 10]),
        "velocity": lambda: cntc.setreferencevelocity(1, 1, 5e6),
        "material": lambda: cntc.setmaterialparameters(1, 1, 0, [0.3, 0.3, 60000, 50000]),
        "layer": lambda: cntc.setmaterialparameters(1, 1, 4, [0.28, 0.28, 82e3, 82e3, 1e3, 0.02, 0, 0]),
        "half-spaces": lambda: cntc.setmaterialparameters(1, 1, 0, FLAT),
        "influence": lambda: cntc.setflags(1, 1, [CNTC["ic_inflcf"]], [3]),
        "normal force": lambda: cntc.setnormalforce(1, 1, 2500),
        "direction": lambda: cntc.setrollingstepsize(1, 1, np.pi, 0.4)}
    for kept_last in (False, True):
        name = f"changes{kept_last}"
        cntc.initlibrary(expnam=name)
        same(cntc.initialize(1, 3)[1], 0, f"{name}: initialize")
        cntc.setsolverflags(1, 1, 0, [999, 50, 30, 10], [1e-7])
        cntc.setmaterialparameters(1, 1, 0, FLAT)
        cntc.setreferencevelocity(1, 1, 20000)
        with_window(1, 1, 1.0, 1, [0.003, 0, 0.004, 0, 0, 0])
        cntc.setnormalforce(1, 1, 3000)
        cntc.setcreepages(1, 1, 0.001, 0.0005, 0.0002)
        forces = []
        for what, change in changes.items():
            if not kept_last:
                keep_all()
            change()
            if kept_last:
                keep_all()
            # the first case is not written: later ones must not refer to it
            cntc.setflags(1, 1, [CNTC["if_wrtinp"]], [int(what != "friction")])
            check(cntc.calculate(1, 1, idebug=0) >= 0, f"{name}, {what}: error code ({last_error(1, 1)[1]})")
            forces.append(np.array(cntc.getcontactforces(1, 1)[:3]))
            check(len(forces) < 2 or np.abs(forces[-1] - forces[-2]).max() > 0.1, f"{name}, {what} acts")
        cntc.finalize(1)
        solved = [case["patches"][0]["totals"] for case in program_cases(name) if case["case"]]
        same(len(solved), len(forces) - 1, f"{name}: cases of the program")
        for what, row, force in zip(list(changes)[1:], solved, forces[1:]):
            close([row[key]["value"] for key in ("fn", "fx", "fy")], force, 0.01, f"{name}, {what}: forces of the program")


def main():
    {"contact": contact_settings, "pair": pair_settings}[sys.argv[1]]()
    if sys.argv[1] == "contact":
        written_changes()
    check(len(reported) >= {"contact": 60, "pair": 40}[sys.argv[1]], f"names of values in the results: {sorted(reported)}")
    finish()


if __name__ == "__main__":
    main()
