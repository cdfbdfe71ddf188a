"""Read the data of the page from the HDF5 file of an experiment."""
from __future__ import annotations

import base64
import hashlib
import os
import re
import zlib
from typing import Any

# Fields that the page does not show
HIDDEN_FIELDS = ("un", "ux", "uy")
# Subsurface results: shown for all blocks, and shown for blocks of at most MAX_POINTS points only
SHOWN_STRESSES = ("sigvm", "sighyd", "sigtr", "sigma1", "sigma3")
MORE_STRESSES = ("sigma2", "sigxx", "sigyy", "sigzz", "sigxy", "sigxz", "sigyz", "ux", "uy", "uz")
MAX_POINTS = 20000
LAYOUT = 1
# Values that HDF5 returns for a missing chunk of an array: bits of a NaN, and an element state
LOST_NUMBER, LOST_STATE = 0x7FF8636F6E746163, -128


class MissingResults(Exception):
    """There are no results to show; the message says what to do"""


class Blobs:
    """Arrays for the page, deflated and in base64; equal arrays are stored once"""

    def __init__(self) -> None:
        self.items: list[dict[str, str]] = []
        self._known: dict[bytes, int] = {}

    def add(self, array: Any) -> int:
        """Index of the blob with this array; real numbers are stored in 4 bytes, split into four planes of bytes"""
        import numpy as np
        if array.dtype.kind in "iu":
            kind, raw = "u1", array.astype("u1").tobytes()
        else:
            kind = "f4"
            raw = np.ascontiguousarray(array, dtype="<f4").reshape(-1).view("u1").reshape(-1, 4).T.tobytes()
        key = hashlib.sha256(kind.encode() + raw).digest()
        if key not in self._known:
            self._known[key] = len(self.items)
            self.items.append({"kind": kind, "data": base64.b64encode(zlib.compress(raw, 6)).decode("ascii")})
        return self._known[key]


def _plain(value: Any) -> Any:
    """A value of the file as a value for JSON; None for NaN and infinity"""
    if isinstance(value, bytes):
        return value.decode("utf-8", "replace").strip()
    if getattr(value, "shape", ()) != ():
        return [_plain(item) for item in value]
    number = value.item()
    if isinstance(number, bytes):
        return _plain(number)
    return None if isinstance(number, float) and not abs(number) < float("inf") else number


def _unit(item: Any) -> str:
    """The unit of a dataset; a dash for ratios, whose unit in the file is 1"""
    unit = str(_plain(item.attrs.get("units", b"")))
    return "-" if unit == "1" else unit


def _is_lost(values: Any) -> bool:
    """Are there fill values of HDF5 for missing chunks of an array? See src/hdf5/file.f90"""
    if values.dtype == "<f8":
        return bool((values.view("<u8") == LOST_NUMBER).any())
    return bool(values.dtype == "i1" and (values == LOST_STATE).any())


class _Reader:
    def __init__(self, file: Any, size: int) -> None:
        import h5py
        self.h5py = h5py
        self.file = file
        # limit of the size of an array: the highest compression ratio of deflate
        self._max_values = 2000 * size + 1000000
        self.blobs = Blobs()
        self.inputs: list[dict[str, Any]] = []
        self._input_numbers: dict[tuple[Any, ...], int] = {}
        self.titles: dict[str, str] = {}
        self._groups: dict[int, dict[str, Any]] = {}
        self._fields: dict[int, int] = {}
        self._meanings: dict[tuple[Any, ...], tuple[str, str]] = {}
        # arrays of the previous case, by patch and name, with their addresses in the file
        self._last: dict[tuple[int, str], tuple[int, Any]] = {}
        self.ranges: dict[str, list[float]] = {}

    def address(self, item: Any) -> int:
        return int(self.h5py.h5o.get_info(item.id).addr)

    def data(self, item: Any) -> Any:
        """Contents of a dataset; the stated size is checked, as it may be wrong in a damaged file"""
        if item.size * item.dtype.itemsize > self._max_values:
            raise ValueError("%s claims to hold %d values" % (item.name, item.size))
        found = item[()]
        if item.chunks is not None and _is_lost(found):
            raise ValueError("a piece of %s is not found" % item.name)
        return found

    def values(self, group: Any) -> dict[str, Any]:
        """Values of a group; groups shared by several cases are read once"""
        at = self.address(group)
        if at not in self._groups:
            self._groups[at] = {name: _plain(self.data(item)) for name, item in group.items()}
        return self._groups[at]

    def meaning(self, key: tuple[Any, ...], item: Any) -> tuple[str, str]:
        """Unit and description, which are the same for all items with the same key, so that the slow attributes are read once"""
        if key not in self._meanings:
            self._meanings[key] = _unit(item), _plain(item.attrs.get("long_name", b""))
        return self._meanings[key]

    def described(self, kind: str, group: Any) -> dict[str, list[Any]]:
        """Values of a group of inputs with unit and description"""
        at = -self.address(group)
        if at not in self._groups:
            self._groups[at] = {name: [_plain(self.data(item)), *self.meaning((kind, name), item)] for name, item in group.items()}
        return self._groups[at]

    def columns(self, name: str) -> tuple[dict[str, Any], dict[str, dict[str, str]]]:
        """Columns of a table, and their units and descriptions"""
        table, meta = {}, {}
        for column, item in self.file[name].items():
            table[column] = self.data(item)
            meta[column] = {"unit": _unit(item), "title": _plain(item.attrs.get("long_name", b""))}
        if len({values.shape for values in table.values()}) > 1:
            raise ValueError("the columns of /%s have different lengths" % name)
        return table, meta

    def input_of(self, case: Any) -> int:
        """Index of the inputs of a case among all different ones"""
        if "inputs" not in case:
            return -1
        groups = case["inputs"]
        key = tuple((name, self.address(groups[name])) for name in groups)
        if key not in self._input_numbers:
            self._input_numbers[key] = len(self.inputs)
            self.inputs.append({name: self.described(name, groups[name]) for name in groups})
        return self._input_numbers[key]

    def array(self, number: int, name: str, item: Any) -> Any:
        """Values of a field; values shared with the previous case are not read again"""
        at = self.address(item)
        if self._last.get((number, name), (0,))[0] != at:
            self._last[number, name] = at, self.data(item)
        return self._last[number, name][1]

    def widen(self, name: str, values: Any) -> None:
        """Extend the range of the common colour scale of all cases by values"""
        if values.size:
            low, high = float(values.min()), float(values.max())
            if abs(low) < float("inf") and abs(high) < float("inf"):
                before = self.ranges.get(name, [low, high])
                self.ranges[name] = [min(low, before[0]), max(high, before[1])]

    def ranges_of(self, values: dict[str, Any], rolling: bool, veloc: float) -> None:
        """Ranges of the fields of a patch in contact, and of the derived fields of the page (fieldsOf in data.js)"""
        import numpy as np
        inside = values["eldiv"] > 0
        f = {name: array[inside] for name, array in values.items() if name != "eldiv"}
        if "px" in f:
            f["pt"] = np.hypot(f["px"], f["py"])
            if "mu" in f:
                bound = f["mu"] * f["pn"]
                f["use"] = np.minimum(1.5, np.divide(f["pt"], bound, out=np.zeros_like(bound), where=bound > 0.0))
            if "sx" in f:
                f["slip"] = np.hypot(f["sx"], f["sy"])
                if rolling and veloc > 0.0:
                    f["power"] = abs(f["px"] * f["sx"] + f["py"] * f["sy"]) * veloc / 1000.0
        if "uplsx" in f:
            f["upls"] = np.hypot(f["uplsx"], f["uplsy"])
        for name, array in f.items():
            self.widen(name, array)

    def patch(self, group: Any, number: int, totals: dict[str, Any]) -> dict[str, Any]:
        fields: dict[str, int] = {}
        units: dict[str, str] = {}
        rolling = "cksi" in totals
        arrays = group["fields"]
        grid = {name: value for name, value in self.values(group["grid"]).items() if name not in ("x", "y")}
        pen = totals.get("pen") or 0.0
        values: dict[str, Any] = {}
        for name, item in arrays.items():
            if name in HIDDEN_FIELDS:
                continue
            array = self.array(number, name, item)
            units[name], self.titles[name] = self.meaning(("fields", name, rolling), item)
            at = self.address(item)
            if name == "h":
                gap = array - pen
                if abs(gap).max() < 1e6:
                    fields["gap"] = self.blobs.add(gap)
                    values["gap"] = gap
                continue
            if at not in self._fields:
                self._fields[at] = self.blobs.add(array)
            fields[name] = self._fields[at]
            values[name] = array
        self.ranges_of(values, rolling, grid.get("veloc") or 0.0)
        found = {"number": number, "totals": totals, "grid": grid, "fields": fields, "units": units,
                 "solver": self.values(group["solver"]),
                 "effects": self.values(group["effects"])["names"] if "effects" in group else "",
                 "border": self.values(group["border"])["reached"] if "border" in group else "",
                 "coarse": [int(value) for value in self.values(group["coarse"]).values()] if "coarse" in group else []}
        if "subsurface" in group:
            blocks = group["subsurface"]
            found["blocks"] = [self.block(blocks["block_%d" % (k + 1)]) for k in range(len(blocks))]
        if "curve" in group:
            import numpy as np
            curve = group["curve"]
            found["curveBlob"] = self.blobs.add(np.concatenate([self.data(curve[name]) for name in ("y", "z", "angle")]))
        return found

    def block(self, group: Any) -> dict[str, Any]:
        """Points below the surface, x fastest in the arrays"""
        points = {axis: _plain(self.data(group["points"][axis])) for axis in "xyz"}
        count = len(points["x"]) * len(points["y"]) * len(points["z"])
        names = SHOWN_STRESSES + (MORE_STRESSES if count <= MAX_POINTS else ())
        arrays = {name: self.data(group[name]) for name in names if name in group}
        for name, array in arrays.items():
            self.widen("block " + name, array)
        return {**points, "fields": {name: self.blobs.add(array) for name, array in arrays.items()}}


def _problem_of(head: dict[str, Any]) -> str:
    """Result element and contact problem in words, where there are several"""
    names = (("result_element", "element %d", 0), ("contact_problem", "problem %d", 1))
    return ", ".join(text % head[name] for name, text, first in names if head[name] > first)


def _side_of(case: Any, module: int) -> str:
    """Side of the wheel of a wheel/rail case"""
    if module != 1 or "inputs/choices/configuration" not in case:
        return ""
    return "left" if _plain(case["inputs/choices/configuration"][()]).startswith("left") else "right"


def _case_name(head: dict[str, Any]) -> str:
    name = "case_%04d" % head["case"]
    if head["result_element"] > 0:
        name = "re%03d_%s" % (head["result_element"], name)
    return name + ("_cp%d" % head["contact_problem"] if head["contact_problem"] > 1 else "")


def read_experiment(path: str) -> tuple[dict[str, Any], list[dict[str, str]]]:
    """Data of the page from an .h5 file: a description of all cases, and arrays by index"""
    try:
        import h5py
        import numpy  # noqa: F401
    except ImportError as reason:
        raise MissingResults("the Python packages numpy and h5py are needed to read results (%s); "
                             "python3 -m pip install numpy h5py, or apt-get install python3-h5py" % reason) from None
    try:
        with h5py.File(path, "r") as file:
            return _read(file, path)
    except MissingResults:
        raise
    except Exception as reason:  # h5py and NumPy raise many kinds of errors for a damaged file
        what = " ".join(str(reason).split()) or type(reason).__name__
        raise MissingResults("%s cannot be read, it is damaged or not an HDF5 file: %s" % (path, what)) from None


def _run_of(file: Any) -> dict[str, Any] | None:
    """Progress of the run; None in files of earlier versions"""
    if "complete" not in file.attrs:
        return None
    found = {name: _plain(file.attrs[name]) for name in ("complete", "cases_planned", "input_readable", "cases_finished")}
    return {**found, "reason": _plain(file.attrs.get("reason", b""))}


def run_of(path: str) -> dict[str, Any] | None:
    """Progress of the run that wrote an .h5 file; None if the file does not have it or cannot be read"""
    try:
        import h5py
        with h5py.File(path, "r") as file:
            return _run_of(file)
    except Exception:  # the error is reported when the results are opened
        return None


def warning_of_run(path: str) -> str:
    """A sentence about incomplete results; "" for complete ones"""
    import h5py
    with h5py.File(path, "r") as file:
        run = _run_of(file)
    if run is None or run["complete"]:
        return ""
    return "%s is not complete: %d of %s%d cases are finished; %s" % (
        path, run["cases_finished"], "" if run["input_readable"] else "at least ", run["cases_planned"], run["reason"])


def _read(file: Any, path: str) -> tuple[dict[str, Any], list[dict[str, str]]]:
    """As read_experiment, from an open file"""
    import numpy as np
    if int(file.attrs.get("layout", 0)) != LAYOUT:
        raise MissingResults("%s is not a result of contact --hdf5, or is one of another version" % path)
    reader = _Reader(file, os.path.getsize(path))
    case_rows, case_meta = reader.columns("cases")
    patch_rows, patch_meta = reader.columns("patches")
    count = len(next(iter(case_rows.values()))) if case_rows else 0
    rows_of: dict[tuple[int, int, int], list[int]] = {}
    if patch_rows:
        for row, key in enumerate(zip(*(patch_rows[name].astype(int) for name in ("result_element", "contact_problem", "case")))):
            rows_of.setdefault(key, []).append(row)
    cases = []
    for row in range(count):
        head = {name: column[row] for name, column in case_rows.items()}
        ident = {name: int(head[name]) for name in ("case", "result_element", "contact_problem", "module")}
        group = file[_case_name(ident)]
        label = str(ident["case"])
        if ident["result_element"]:
            label = "%d:%s" % (ident["result_element"], label)
        if ident["contact_problem"] > 1:
            label += "/%d" % ident["contact_problem"]
        case = {"label": label, "number": ident["case"], "module": ident["module"], "solved": bool(head["solved"]),
                "side": _side_of(group, ident["module"]), "problem": _problem_of(ident),
                "converged": bool(head["converged"]), "status": "solved", "seconds": _plain(head["seconds"]),
                "inputs": reader.input_of(group), "totals": {name: _plain(head[name]) for name in case_rows if ident["module"] == 1
                                                             and name not in ("case", "line", "solved", "converged", "status_code",
                                                                              "missed", "seconds")}, "patches": []}
        if "status" in group:
            case.update(reader.values(group["status"]))
        elif "failure" in group:  # files of earlier versions
            case.update(status="refused", reason=reader.values(group["failure"])["reason"])
        elif not case["converged"]:
            case.update(status="not converged", reason="look at the residuals before using this case")
        if "markers" in group:
            case["markers"] = reader.values(group["markers"])
            for radius in ("inputs/wheel_dimensions/nomradw", "inputs/wheelset_dimensions/nomradw"):  # the second in earlier files
                if radius in group:
                    case["radius"] = float(group[radius][()])
            case["profiles"] = {body: reader.blobs.add(np.stack([reader.data(item["y"]), reader.data(item["z"])], axis=1))
                                for body, item in group["profiles"].items()}
        for place in rows_of.get((ident["result_element"], ident["contact_problem"], ident["case"]), []):
            totals = {name: _plain(column[place]) for name, column in patch_rows.items()}
            totals = {name: value for name, value in totals.items() if value is not None}
            number = int(totals["patch"])
            case["patches"].append(reader.patch(group["patch_%d" % number], number, totals))
        cases.append(case)
    data = {"experiment": _plain(file.attrs["experiment"]), "program": _plain(file.attrs["program"]),
            "run": _run_of(file), "columns": {**case_meta, **patch_meta}, "inputs": reader.inputs,
            "titles": reader.titles, "ranges": reader.ranges, "cases": cases}
    return data, reader.blobs.items


def find_results(experiment: str) -> str:
    """The .h5 file of an experiment, given with or without folder and suffix"""
    base = re.sub(r"\.(inp|h5|out)$", "", experiment)
    path = base + ".h5"
    if os.path.isfile(path):
        return path
    if os.path.isfile(base + ".inp"):
        raise MissingResults("there is no %s; make it with: contact --hdf5 2 %s" % (path, base))
    raise MissingResults("there is neither %s nor %s.inp" % (path, base))
