"""Readers of results in text files: .mat and .out."""
from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .errors import ContactError

# First and last supported layout of .mat files
_LAYOUTS = (2320, 2410)
# Fields that are zero outside of the contact if a file has the elements in contact only; all others are unknown there
_ZERO_OUTSIDE = ("eldiv", "pn", "px", "py")
# Names of totals in HDF5 by the headings of the .out file, which are converted to lower case with _ for other characters
_TOTALS = {"fn": "fn", "fx": "fx", "fy": "fy", "fs": "fy", "mz": "mz", "mz_elem": "mz_elem", "bar_fn": "bar_fn",
           "bar_fx": "bar_fx", "bar_fs": "bar_fs", "bar_mn": "bar_mn", "elast_en": "elastic_energy",
           "fric_power": "friction_power", "fric_work": "friction_work", "fx_fstat_fn": "fx_rel", "fy_fstat_fn": "fy_rel",
           "fs_fstat_fn": "fy_rel", "fx_fn": "fx_rel", "fy_fn": "fy_rel", "fs_fn": "fy_rel", "approach": "pen", "pmax": "pmax",
           "max_t1_t2": "max_temp", "cksi": "cksi", "ceta": "ceta", "cphi": "cphi", "creep_x": "cksi", "creep_y": "ceta",
           "shift_x": "shift_x", "shift_y": "shift_y", "rotation": "rotation", "ncon": "ncon", "nadh": "nadh", "nslip": "nslip",
           "nplast": "nplast", "xcp_tr": "xcp_tr", "ycp_tr": "ycp_tr", "zcp_tr": "zcp_tr", "deltcp_tr": "deltcp_tr",
           "ycp_r": "ycp_r", "zcp_r": "zcp_r", "xcp_w": "xcp_w", "ycp_w": "ycp_w", "zcp_w": "zcp_w"}
_OF_CASE = ("fx_tr", "fy_tr", "fz_tr", "fx_ws", "fy_ws", "fz_ws", "s_ws", "y_ws", "z_ws", "roll_ws", "yaw_ws", "vpitch_ws",
            "dy_defl", "dz_defl")
_MOMENTS = ("mx_r_tr", "my_r_tr", "mz_r_tr", "mx_w_ws", "my_w_ws", "mz_w_ws")
# First words of the headings of the totals
_HEADINGS = re.compile(r"^\s+(FN|BAR_FN|FN/G|CHI|SPINXO|DT|NPOT|XCP|FX\(TR\)|MX@R|S_WS|X_WS|VS_WS|VX_WS|DY_DEFL)\b|^\s+(XCP|FX)\(")


@dataclass
class MatFile:
    """Contents of a .mat file"""

    fields: dict[str, Any]
    totals: dict[str, float]
    grid: dict[str, Any]
    patch: int
    status: str
    reason: str


@dataclass
class OutCase:
    """One case of an .out file"""

    number: int
    result_element: int = 0
    status: str = "solved"
    reason: str = ""
    totals: dict[str, float] = field(default_factory=dict)
    patches: dict[int, dict[str, float]] = field(default_factory=dict)
    # Name of the moment MN of each patch whose kinematic constants are printed
    moments: dict[int, str] = field(default_factory=dict)
    # Relative forces of each patch that are prescribed, printed with the input only
    prescribed: dict[int, dict[str, float]] = field(default_factory=dict)


@dataclass
class OutFile:
    """Contents of an .out file"""

    cases: list[OutCase]
    complete: bool | None


def _number(word: str) -> float | None:
    try:
        return float(word)
    except ValueError:
        return None


def read_mat(path: str) -> MatFile:
    """Fields and grid of a .mat file; totals without a line in the file are computed from the fields if it has all of them.

    Raises ContactError if it is damaged or of another layout.
    """
    with open(path, encoding="utf-8", errors="replace") as file:
        lines = [line.rstrip("\n") for line in file if line.strip()]
    names = [line for line in lines if line.lstrip().startswith("%")]
    rows = [[_number(word) for word in line.split()] for line in lines if not line.lstrip().startswith("%")]
    if len(names) < 7 or len(rows) < 6 or any(len(row) != len(rows[0]) or None in row for row in rows) or len(rows[0]) < 11:
        raise ContactError(f"{path} is no .mat file of CONTACT, or it is damaged")
    table = np.array(rows, dtype=float)
    layout = int(table[0, -1])
    if not _LAYOUTS[0] <= layout <= _LAYOUTS[1]:
        raise ContactError(f"{path} has layout {layout}; {_LAYOUTS[0]} to {_LAYOUTS[1]} are understood")
    mx, my = int(table[3, 0]), int(table[3, 1])
    xl, yl, dx, dy, chi, dq = table[3, 2:8].tolist()
    t_digit, veloc = int(table[4, 0]), float(table[5, 2])
    elements = table[6:]
    numbers = elements[:, 0].astype(int) - 1
    has_grid = mx >= 1 and my >= 1 and dx > 0.0 and dy > 0.0 and bool(np.isfinite(table).all())
    if not has_grid or np.unique(numbers).size != numbers.size or ((numbers < 0) | (numbers >= mx * my)).any():
        raise ContactError(f"{path} is damaged: its elements do not fit its grid of {mx} x {my}")
    headings = ["eldiv" if word == "IGS" else word.lower() for word in names[-1].lstrip(" %").split()][1:]
    fields: dict[str, Any] = {}
    for column, name in enumerate(headings, 1):
        values = np.full(mx * my, 0.0 if name in _ZERO_OUTSIDE else np.nan)
        values[numbers] = elements[:, column]
        fields[name] = values.reshape(my, mx)
    fields["eldiv"] = fields["eldiv"].astype(np.int8)
    found = re.search(r"STATUS: ([a-z ]*[a-z])(?: \((\w+)\): (.*))?$", names[0])
    totals = {"fn": float(fields["pn"].sum() * dx * dy), "pmax": float(fields["pn"].max(initial=0.0)),
              "ncon": int(np.count_nonzero(fields["eldiv"]))}
    for name, total in (("px", "fx"), ("py", "fy")):
        if t_digit > 0:
            totals[total] = float(fields[name].sum() * dx * dy)
    patch = int(table[2, 8])
    if patch:
        # in steps places refer to the origin of the elements there, in HDF5 to the contact reference
        xl, yl = xl - float(table[2, 9]), yl - float(table[2, 10])
        totals.update(zip(("xcp_r", "ycp_r", "zcp_r", "deltcp_r", "xcp_w", "ycp_w", "zcp_w"), table[2, :7].tolist()))
    grid = {"mx": mx, "my": my, "xl": xl, "yl": yl, "dx": dx, "dy": dy, "chi": chi, "dq": dq, "veloc": veloc, "t_digit": t_digit,
            "x": xl + dx * (np.arange(mx) + 0.5), "y": yl + dy * (np.arange(my) + 0.5)}
    status, reason = (found.group(1), found.group(3) or "") if found else ("", "")
    return MatFile(fields, totals, grid, patch, status, reason)


def _below(heading: str, values: str) -> dict[str, float]:
    """Numbers below a heading, by lower-case names"""
    names = re.sub(r"(CREEP|SHIFT) ([XY])", r"\1_\2", heading).split()
    found = {}
    for name, word in zip(names, values.split()):
        number = _number(word)
        if number is None:
            break
        found[re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_")] = number
    if "dt" in found:  # shifts
        found.update({new: found.pop(old) for old, new in (("cksi", "shift_x"), ("ceta", "shift_y"), ("cphi", "rotation"))
                      if old in found})
    return found


def _take(case: OutCase, patch: int, values: dict[str, float], in_module1: bool) -> None:
    """Store the values below one heading"""
    if patch == 0:
        case.totals.update({name: values[name] for name in _OF_CASE if name in values})
        case.totals.update({name: values[name] for name in _MOMENTS if name in values})
        if in_module1:
            return
    totals = case.patches.setdefault(max(1, patch), {})
    # MN is about the contact reference; in steps about the origin of the elements, which has a line of its own then. Without
    # kinematic constants, in compact output, its origin is not known
    if "cksi" in values or "shift_x" in values:
        case.moments[patch] = "mz"
    elif "spinxo" in values:
        case.moments[patch] = "mz_elem"
    moment = values.pop("mn", None)
    if moment is not None and "bar_fn" in values:
        values["bar_mn"] = moment
    elif moment is not None and patch in case.moments:
        values[case.moments[patch]] = moment
    found = {total: values[name] for name, total in _TOTALS.items() if name in values}
    if "chi" in values or "dt" in values:
        case.prescribed[max(1, patch)] = {name: found.pop(name) for name in ("fx_rel", "fy_rel") if name in found}
    totals.update(found)


def read_out(path: str) -> OutFile:
    """Totals of all cases of an .out file, as they are printed.

    Raises ContactError if it is not an .out file.
    """
    with open(path, encoding="utf-8", errors="replace") as file:
        lines = [line.rstrip("\n") for line in file]
    if len(lines) < 2 or "detailed investigation of 3D" not in lines[1]:
        raise ContactError(f"{path} is no .out file of CONTACT")
    cases: list[OutCase] = []
    patch, in_module1 = 0, False
    for line, following in zip(lines, lines[1:] + [""]):
        start = re.match(r" Case +(\d+)(?:, result element +(\d+))?", line)
        where = re.match(r" ----- DATA FOR CONTACT PATCH +(\d+)", line)
        if start:
            cases.append(OutCase(int(start.group(1)), int(start.group(2) or 0)))
            patch, in_module1 = 0, False
        elif not cases:
            continue
        elif where:
            patch = int(where.group(1))
            cases[-1].patches.setdefault(patch, {})
        elif re.match(r" (WHEEL-RAIL|WHEEL-ROLLER) CONTACT|     FX\(TR\) ", line):
            in_module1 = True
        if "NOT CONVERGED: " in line:
            cases[-1].status, cases[-1].reason = "not converged", line.partition("NOT CONVERGED: ")[2].strip()
        elif line.startswith(" ERROR. "):
            cases[-1].status, cases[-1].reason = "refused", line[8:].strip()
        elif line.startswith(" Input: ERROR. ") and cases[-1].status != "refused":
            cases[-1].status, cases[-1].reason = "refused", "its input cannot be used: " + line[15:].strip()
        if _HEADINGS.match(line):
            _take(cases[-1], patch, _below(line, following), in_module1)
    for case in cases:
        if case.status == "solved":  # prescribed forces are reached, but without contact
            for number, values in case.prescribed.items():
                if case.patches[number].get("fn") != 0:
                    case.patches[number] = {**values, **case.patches[number]}
    ours = any("open source" in line for line in lines[:6])
    ended = any(line.startswith(" CONTACT ended") for line in lines)
    short = any(line.startswith(" Not complete: ") for line in lines)
    if cases and ours and not ended and cases[-1].status == "solved":
        cases[-1].status, cases[-1].reason = "", "the file ends in the case"
    return OutFile(cases, not short and ended if ours else None)
