"""Results of experiments in files: HDF5, .mat and .out, as objects that can be printed, plotted and converted."""
from __future__ import annotations

import glob
import os
import re
from collections.abc import Iterator, Sequence
from typing import Any, overload

import numpy as np

from ._read_text import read_mat, read_out
from ._view import CONVENTIONS, Field, View, cf_unit, meaning_of, optional, plot_patches, tree
from .errors import ContactError

_ALIASES = {"state": "eldiv", "distance": "h", "friction": "mu", "approach": "pen", "max_pressure": "pmax"}
# bits of the NaN that HDF5 returns for a missing chunk of an array, see src/hdf5/values.f90
_LOST = 0x7FF8636F6E746163


class StoredPatch(View):
    """A patch loaded from a file: totals and fields by their names, as attributes.

    ``patch.pn`` and ``patch.fx`` are a field of shape (my, mx) and a total; the names of :class:`Patch` work as well
    (``state`` is ``eldiv``). Data that are not in the file raise ``AttributeError``. Units are mm, N and rad.

    Attributes
    ----------
    x, y, dx, dy
        Centres of columns and rows and sides of the elements [mm]; empty and NaN from an ``.out`` file.
    number
        Of the patch, from 1.
    blocks
        Blocks of points below the surface, each a dictionary of ``x``, ``y``, ``z`` and of arrays of shape (nz, ny, nx).
    """

    def __init__(self, number: int, totals: dict[str, float], fields: dict[str, Any], grid: dict[str, Any],
                 blocks: tuple[dict[str, Any], ...] = ()) -> None:
        self.number = number
        self._totals = totals
        self._fields = fields
        self.x = np.asarray(grid.get("x", ()), dtype=float)
        self.y = np.asarray(grid.get("y", ()), dtype=float)
        self.dx = float(grid.get("dx", np.nan))
        self.dy = float(grid.get("dy", np.nan))
        self.grid = grid
        self.blocks = blocks

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("_"):
            name = _ALIASES.get(name, name)
            for values in (self._fields, self._totals):
                if name in values:
                    return values[name]
        raise AttributeError(f"this patch has no {name!r}; it has {', '.join([*self._totals, *self._fields])}"
                             if not name.startswith("_") else name)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._fields, *self._totals]

    def fields(self) -> dict[str, Any]:
        """Element fields of shape (my, mx) by their names in files; empty from an ``.out`` file."""
        return dict(self._fields)

    def totals(self) -> dict[str, float]:
        """Totals by their names in files."""
        return dict(self._totals)

    def meaning(self, name: str) -> tuple[str, str]:
        """Unit and description of a field or a total."""
        return meaning_of(name, is_shift="shift_x" in self._totals or self.grid.get("t_digit") == 1)

    def _title(self) -> str:
        return f"Patch {self.number}"


class Case:
    """One case of an experiment.

    Attributes
    ----------
    number
        Of the case, from 1.
    status, reason
        ``"solved"``, ``"not converged"`` or ``"refused"``, and the reason; ``""`` if the file does not have it.
    totals
        Total forces and position of the wheelset by their names in HDF5, in module 1.
    patches
        The patches, one in module 3, none in cases without contact.
    inputs
        The input, by group and name; from HDF5 files only.
    result_element, contact_problem
        Numbers on the module line of the case; 0 and 1 without. ``.out`` files have the first only, ``.mat`` files none.
    """

    def __init__(self, number: int, status: str, reason: str, totals: dict[str, float], patches: tuple[StoredPatch, ...],
                 inputs: dict[str, dict[str, Any]] | None = None, result_element: int = 0, contact_problem: int = 1) -> None:
        self.number = number
        self.result_element = result_element
        self.contact_problem = contact_problem
        self.status = status
        self.reason = reason
        self.totals = totals
        self.patches = patches
        self.inputs = inputs or {}

    @property
    def patch(self) -> StoredPatch:
        """The only patch. Raises ValueError when there are several or none."""
        if len(self.patches) != 1:
            raise ValueError(f"case {self.number} has {len(self.patches)} patches; choose one of patches")
        return self.patches[0]

    def __repr__(self) -> str:
        count = len(self.patches)
        return f"<{self._title()}, {self.status or 'loaded'}: {count} patch{'' if count == 1 else 'es'}>"

    def _title(self) -> str:
        return (f"Case {self.number}" + (f", result element {self.result_element}" if self.result_element else "")
                + (f", contact problem {self.contact_problem}" if self.contact_problem > 1 else ""))

    def __str__(self) -> str:
        lines = [self._title() + (f", {self.status}" if self.status else "") + (f": {self.reason}" if self.reason else "")]
        lines += [f"  {name:16s}{value:12.5g} {meaning_of(name)[0]}".rstrip() for name, value in self.totals.items()]
        return "\n".join(lines + [f"  {patch!r}" for patch in self.patches])

    def plot(self, field: str = "pn", **options: Any) -> Any:
        """Draw a field of all patches side by side, with matplotlib; see :meth:`Patch.plot`. Returns an array of axes."""
        return plot_patches(self.patches, field, options)

    def to_xarray(self) -> Any:
        """The patch as an ``xarray.Dataset``; of several, or in module 1, an ``xarray.DataTree`` with ``/patch_1``, ...

        Raises
        ------
        ImportError
            If xarray is not installed.
        """
        if len(self.patches) == 1 and not self.totals:
            return self.patches[0].to_xarray()
        values = {name: ((), value, {"long_name": meaning_of(name)[1], "units": cf_unit(meaning_of(name)[0])})
                  for name, value in self.totals.items()}
        root = optional("xarray", "to_xarray").Dataset(values, attrs={"Conventions": CONVENTIONS, "title": f"case {self.number}"})
        return tree(root, [patch.to_xarray() for patch in self.patches])


class Experiment(Sequence[Case]):
    """The cases of an experiment, in their order.

    Attributes
    ----------
    path
        The file that was loaded.
    complete
        Whether all cases are present; None if the file does not have this information.
    """

    def __init__(self, path: str, cases: list[Case], complete: bool | None) -> None:
        self.path = path
        self.complete = complete
        self._cases = cases

    def __len__(self) -> int:
        return len(self._cases)

    @overload
    def __getitem__(self, index: int) -> Case: ...

    @overload
    def __getitem__(self, index: slice) -> list[Case]: ...

    def __getitem__(self, index: int | slice) -> Case | list[Case]:
        return self._cases[index]

    def __iter__(self) -> Iterator[Case]:
        return iter(self._cases)

    def case(self, number: int, result_element: int | None = None, contact_problem: int | None = None) -> Case:
        """The case with a number of the input, and of the result element and contact problem if there are several.

        Raises KeyError if there is none, or if several cases have this number.
        """
        found = [case for case in self._cases if case.number == number and result_element in (None, case.result_element)
                 and contact_problem in (None, case.contact_problem)]
        if not found:
            raise KeyError(f"{self.path} has no case {number}")
        if len(found) > 1:
            raise KeyError(f"{self.path} has several cases {number}: {', '.join(case._title() for case in found)}")
        return found[0]

    def __repr__(self) -> str:
        ended = [case.status for case in self._cases]
        counts = [f"{ended.count(word)} {word}" for word in ("solved", "not converged", "refused") if word in ended]
        state = "" if self.complete is not False else ", not complete"
        numbers = "".join(f", {count}" for count in counts)
        return f"<Experiment {os.path.basename(self.path)}: {len(self)} case{'s' if len(self) != 1 else ''}{numbers}{state}>"

    def table(self) -> dict[str, Any]:
        """Totals of all patches in columns, one row per patch: for curves, and for ``pandas.DataFrame(...)``.

        Returns
        -------
        One array for each name: ``case``, ``patch``, totals of the patch, and those of wheel and rail of its case; with several
        of them also ``result_element`` and ``contact_problem``. Missing values are NaN.
        """
        marks = [name for name in ("result_element", "contact_problem") if len({getattr(case, name) for case in self._cases}) > 1]
        rows = [{"case": case.number, **{name: getattr(case, name) for name in marks}, "patch": patch.number, **patch.totals(),
                 **case.totals} for case in self._cases for patch in case.patches]
        names = list(dict.fromkeys(name for row in rows for name in row))
        return {name: np.array([row.get(name, np.nan) for row in rows]) for name in names}

    def to_xarray(self) -> Any:
        """The columns of :meth:`table` as an ``xarray.Dataset`` over ``row``, with units and descriptions.

        Raises
        ------
        ImportError
            If xarray is not installed.
        """
        xarray = optional("xarray", "to_xarray")
        return xarray.Dataset({name: ("row", values, {"long_name": meaning_of(name)[1], "units": cf_unit(meaning_of(name)[0])})
                               for name, values in self.table().items()},
                              attrs={"Conventions": CONVENTIONS, "title": os.path.basename(self.path)})


def load(path: str | os.PathLike[str]) -> Experiment:
    """Load the results of an experiment.

    Parameters
    ----------
    path
        ``.h5``: everything of all cases (``contact --hdf5``); needs h5py. ``.mat``: fields of one case and patch, as
        ``name.0002a.mat``, or of all existing ones, as ``name.mat``. ``.out``: totals of all cases, with the printed
        digits.

    Returns
    -------
    The cases, in their order. Names of fields and totals are the same in all three; values are in mm, N and rad.

    Raises
    ------
    ContactError
        If the file cannot be read; the message gives the reason.
    FileNotFoundError
        If it does not exist.
    ImportError
        If h5py is needed and not installed.

    Examples
    --------
    >>> results = contact.load("carter2d.h5")
    >>> results[0].patch.pn.shape
    (1, 41)
    >>> table = results.table()
    >>> table["cksi"], table["fx"]
    """
    place = os.fspath(path)
    ending = os.path.splitext(place)[1].lower()
    if ending not in (".h5", ".mat", ".out"):
        raise ContactError(f"{place}: the ending is none of .h5, .mat and .out")
    if ending == ".mat":
        return _load_mat(place)
    if not os.path.isfile(place):
        raise FileNotFoundError(f"{place} is not there")
    return _load_hdf5(place) if ending == ".h5" else _load_out(place)


def _plain(value: Any) -> Any:
    """A value of an HDF5 file as a Python value; arrays are returned unchanged"""
    if isinstance(value, (bytes, np.bytes_)):
        return value.decode("utf-8", "replace").rstrip()
    if isinstance(value, np.ndarray) and value.ndim:
        if value.dtype == "<f8" and (value.view("<u8") == _LOST).any():
            raise ContactError("a piece of an array is not found: the file is damaged")
        return value
    return _plain(value.item()) if hasattr(value, "item") else value


def _values(group: Any) -> dict[str, Any]:
    return {name: _plain(item[()]) for name, item in group.items() if hasattr(item, "dtype")}


def _stored_patch(number: int, group: Any) -> StoredPatch:
    blocks = []
    below = group.get("subsurface", {})
    for k in range(1, len(below) + 1):
        block = below[f"block_{k}"]
        blocks.append({**_values(block["points"]), **_values(block)})
    totals = {name: value for name, value in _values(group["totals"]).items() if isinstance(value, (int, float))}
    return StoredPatch(number, totals, _values(group["fields"]), _values(group["grid"]), tuple(blocks))


def _load_hdf5(path: str) -> Experiment:
    h5py = optional("h5py", "load of an .h5 file")
    try:
        with h5py.File(path, "r") as file:
            if int(file.attrs.get("layout", 0)) != 1:
                raise ContactError("it is not a result of contact --hdf5, or is one of another version")
            columns = _values(file["cases"])
            cases = []
            for row, number in enumerate(columns.get("case", ())):
                element, problem = int(columns["result_element"][row]), int(columns["contact_problem"][row])
                name = f"re{element:03d}_" if element else ""
                group = file[name + f"case_{int(number):04d}" + (f"_cp{problem}" if problem > 1 else "")]
                outcome = _values(group["status"]) if "status" in group else {}
                solved = bool(columns["solved"][row])
                status = outcome.get("status") or (
                    "solved" if columns["converged"][row] else "not converged" if solved else "refused")
                names = sorted((name for name in group if name.startswith("patch_")), key=lambda name: int(name[6:]))
                inputs = {name: _values(values) for name, values in group["inputs"].items()} if "inputs" in group else {}
                cases.append(Case(int(number), str(status), str(outcome.get("reason", "")),
                                  _values(group["totals"]) if "totals" in group else {},
                                  tuple(_stored_patch(int(name[6:]), group[name]) for name in names), inputs, element, problem))
            return Experiment(path, cases, bool(file.attrs["complete"]) if "complete" in file.attrs else None)
    except ContactError as reason:
        raise ContactError(f"{path}: {reason}") from None
    except Exception as reason:  # h5py raises many kinds of errors for a damaged file
        what = " ".join(str(reason).split()) or type(reason).__name__
        raise ContactError(f"{path} cannot be read, it is damaged or not an HDF5 file: {what}") from None


def _load_mat(path: str) -> Experiment:
    base = path[:-4]
    paths = [path]
    if not os.path.isfile(path):
        paths = sorted(name for name in glob.glob(glob.escape(base) + ".*.mat") if re.search(r"\.\d{4,}[a-z]?\.mat$", name))
        if not paths:
            raise FileNotFoundError(f"{path} is not there, nor is {base}.0001.mat or another case")
    cases: dict[int, Case] = {}
    for name in paths:
        number = int((re.search(r"\.(\d{4,})[a-z]?\.mat$", name) or [0, 1])[1])
        contents = read_mat(name)
        patch = StoredPatch(max(1, contents.patch), contents.totals, contents.fields, contents.grid)
        before = cases.get(number)
        cases[number] = Case(number, contents.status, contents.reason, {}, (*(before.patches if before else ()), patch))
    return Experiment(path, [cases[number] for number in sorted(cases)], None)


def _load_out(path: str) -> Experiment:
    contents = read_out(path)
    cases = [Case(case.number, case.status, case.reason, case.totals,
                  tuple(StoredPatch(number, totals, {}, {}) for number, totals in sorted(case.patches.items())),
                  result_element=case.result_element)
             for case in contents.cases]
    return Experiment(path, cases, contents.complete)


__all__ = ["Case", "Experiment", "Field", "StoredPatch", "load"]
