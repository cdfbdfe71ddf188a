"""Derivatives of the forces of a wheel on a rail, by the names of their rows and columns."""
from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any

import numpy as np

from ._library import last_error, library
from ._view import optional
from .errors import ContactError

Field = np.ndarray[Any, np.dtype[np.float64]]

#: Rows: force and moment about the rail marker in track directions and about the wheel marker in wheelset directions, and the
#: height of the wheelset
ROWS = ("fx_tr", "fy_tr", "fz_tr", "mx_r_tr", "my_r_tr", "mz_r_tr",
        "fx_ws", "fy_ws", "fz_ws", "mx_w_ws", "my_w_ws", "mz_w_ws", "z_ws")
#: Columns: position and velocities of the wheelset, and the vertical force
COLUMNS = ("y", "z", "roll", "yaw", "vs", "vy", "vroll", "vyaw", "vpitch", "fz")
_STATES = ("exact", "one-sided")


@dataclass(frozen=True, eq=False)
class Jacobian:
    """Derivatives of forces, moments and height of a wheel on a rail with respect to position, velocities and vertical force.

    ``jacobian["fy_tr", "yaw"]`` is one value, ``jacobian["fy_tr"]`` a row, ``jacobian[["fx_ws", "fy_ws"], ["y", "yaw"]]`` a
    submatrix. These are the exact derivatives of the discrete equations with fixed contact area and element division, see
    doc/theory/sensitivities.md.

    Attributes
    ----------
    values
        Shape (13, 10), in the units and with the signs of the problem: [F] and [F L] per [L], [A], [V], [A/T] and [F].
    rows, columns
        Their names, in order: those of totals in files, and ``y, z, roll, yaw, vs, vy, vroll, vyaw, vpitch, fz``.
    state, reason
        ``"exact"``; ``"one-sided"`` where a contact patch, or a part of one, appears or vanishes, so that the derivative holds on
        one side only.
    """

    values: Field
    state: str = "exact"
    reason: str = ""
    rows: tuple[str, ...] = ROWS
    columns: tuple[str, ...] = COLUMNS

    def __getitem__(self, names: Any) -> Any:
        row, column = names if isinstance(names, tuple) else (names, list(self.columns))
        at = [self._places(row, self.rows, "row"), self._places(column, self.columns, "column")]
        if all(isinstance(place, list) for place in at):
            return self.values[np.ix_(*at)]
        found = self.values[at[0], at[1]]
        return float(found) if np.ndim(found) == 0 else found

    @staticmethod
    def _places(names: Any, known: tuple[str, ...], what: str) -> Any:
        """Number of a name, or list of numbers"""
        if not isinstance(names, str):
            return [Jacobian._places(name, known, what) for name in names]
        if names not in known:
            raise KeyError(f"there is no {what} {names!r}; there are {', '.join(known)}")
        return known.index(names)

    def to_xarray(self) -> Any:
        """The derivatives as an ``xarray.DataArray`` with the dimensions ``result`` and ``input``.

        Raises
        ------
        ImportError
            If xarray is not installed.
        """
        xarray = optional("xarray", "to_xarray")
        return xarray.DataArray(self.values, dims=("result", "input"),
                                coords={"result": list(self.rows), "input": list(self.columns)},
                                attrs={"state": self.state, "reason": self.reason})


def read_jacobian(number: int) -> Jacobian:
    """Derivatives at the last calculation of a result element.

    Raises
    ------
    ContactError
        If there are none, with the reason.
    """
    values = np.zeros((len(ROWS), len(COLUMNS)))
    room = ctypes.create_string_buffer(2000)
    function = library().contact_wheel_rail_jacobian
    state = function(ctypes.c_int(number), values.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), ctypes.c_int(values.size),
                     room, ctypes.c_int(len(room)))
    reason = room.value.decode("utf-8", errors="replace")
    if not 0 <= state < len(_STATES):
        last_error(number)
        raise ContactError(f"no derivatives: {reason}", min(0, state))
    return Jacobian(values, _STATES[state], reason)
