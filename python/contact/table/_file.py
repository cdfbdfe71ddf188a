"""The file of a table of creep forces; its layout is in doc/theory/tables.md, its reader src/tables/table_file.f90."""
from __future__ import annotations

import hashlib
import struct
from pathlib import Path
from typing import Any

import numpy as np

from ._look_up import Facts, Numbers

#: First bytes of a file, and bytes before the knots
_MAGIC, _HEAD = b"CONTACT table 2\n", 128
#: Signs of Fx, Fy, Mz under reflection of x, and of y, z and all signs; the offset changes its sign with both
_X_SIGNS, _Z_SIGNS = np.array([-1.0, 1.0, 1.0]), np.array([1.0, -1.0, -1.0])


def write(path: Path, nodes: list[Numbers], values: Numbers, facts: Facts) -> None:
    """Write a table.

    Parameters
    ----------
    path
        Its path.
    nodes
        Along log(a/b), offset, x, y, z; x and z from 0 on, offset and y symmetric. One offset: ellipses.
    values
        Forces and moment at the nodes, relative to mu Fn and mu Fn sqrt(a b), shape (shape, offset, x, y, z, 3).
    facts
        Properties of the table.
    """
    # nodes that are their own mirror images must have exactly symmetric values
    values = values.copy()
    values[:, :, 0] = 0.5 * (values[:, :, 0] + _X_SIGNS * values[:, ::-1, 0])
    values[..., 0, :] = 0.5 * (values[..., 0, :] + _Z_SIGNS * values[:, ::-1, :, ::-1, 0, :])
    whole = np.concatenate([(values * _X_SIGNS)[:, ::-1, :0:-1], values], axis=2)
    whole = np.concatenate([(whole * _Z_SIGNS)[:, ::-1, :, ::-1, :0:-1], whole], axis=4)
    axes = [nodes[0], nodes[1], np.concatenate([-nodes[2][:0:-1], nodes[2]]), nodes[3],
            np.concatenate([-nodes[4][:0:-1], nodes[4]])]
    knots: list[Numbers] = []
    for number, places in enumerate(axes):
        if len(places) == 1:
            knots.append(np.zeros(0))
            continue
        made, whole = _spline(places, whole, number)
        if number in (2, 4):
            # only one half is stored; the other is its mirror image
            first = int(np.argmin(np.abs(made))) - 3
            made = made[first:]
            whole = np.take(whole, range(first, whole.shape[number]), axis=number)
        knots.append(made)
    body = b"".join(part.astype("<f8").tobytes() for part in knots) + whole.astype("<f4").tobytes()
    size = _HEAD + len(body) + 64
    head = _MAGIC + struct.pack("<8i", 2 if facts.has_offset else 1, *whole.shape[:5], facts.elements, facts.order)
    # forces near the bound are blended into it within the tolerance
    head += struct.pack("<q9d", size, facts.poisson, facts.asked, *facts.error, facts.points, min(0.5, facts.asked),
                        *facts.grid_error, 0.0)
    content = head + body
    path.write_bytes(content + hashlib.sha256(content).hexdigest().encode())


def _through(places: Numbers, values: Numbers, axis: int) -> Any:
    """The cubic spline through values along an axis"""
    from scipy.interpolate import make_interp_spline
    return make_interp_spline(places, values, k=3, axis=axis)


def _spline(places: Numbers, values: Numbers, axis: int) -> tuple[Numbers, Numbers]:
    """Knots and coefficients of the cubic spline through values along an axis"""
    made = _through(places, values, axis)
    return np.asarray(made.t), np.moveaxis(made.c, 0, axis)


def interpolated(places: Numbers, values: Numbers, axis: int, new: Numbers) -> Numbers:
    """The cubic spline through values along an axis at other abscissas"""
    return np.asarray(_through(places, values, axis)(new))


def bend(places: Numbers, values: Numbers, axis: int, new: Numbers) -> Numbers:
    """Third differences of values along an axis near new abscissas, for the intervals that these divide.

    At a bend of the forces they are about the change of the slope times the interval, and the error of a spline is up to a third of
    that; where forces are smooth it is much smaller.
    """
    divided = np.moveaxis(values, axis, 0)
    for k in (1, 2, 3):
        divided = np.diff(divided, axis=0) / (places[k:] - places[:-k]).reshape(-1, *[1] * (values.ndim - 1))
    interval = np.searchsorted(places[1:-1], new, side="right")
    size = np.max([np.abs(divided[np.clip(interval + shift, 0, len(divided) - 1)]) for shift in (-2, -1, 0)], axis=0)
    widths = np.diff(places)[interval].reshape(-1, *[1] * (values.ndim - 1))
    return np.asarray(np.moveaxis(6.0 * widths**3 * size, 0, axis))
