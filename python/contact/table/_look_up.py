"""Look-up in a table of creep forces: include/contact.h, contact_table_*."""
from __future__ import annotations

import ctypes
import os
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._handle import Handle
from .._library import library, unmasked
from ..errors import ContactError

Numbers = NDArray[np.float64]

#: Code of contact_table_forces for a contact outside of the table
_OUTSIDE, _WRONG = 1, 2


class _Facts(ctypes.Structure):
    """contact_table_facts"""
    _fields_ = [("has_offset", ctypes.c_int), ("elements", ctypes.c_int), ("order", ctypes.c_int), ("poisson", ctypes.c_double),
                ("ratio", 2 * ctypes.c_double), ("offset", ctypes.c_double), ("spin", ctypes.c_double), ("asked", ctypes.c_double),
                ("error", 2 * ctypes.c_double), ("points", ctypes.c_double), ("grid_error", 2 * ctypes.c_double),
                ("bytes", ctypes.c_double)]


@dataclass(frozen=True)
class Facts:
    """Properties of a table.

    Attributes
    ----------
    has_offset
        Whether the contacts are two half ellipses, not ellipses.
    elements, order
        Elements along each side of the contacts from which it was computed, and the order of their discretisation.
    poisson
        Poisson ratio of the bodies [-].
    ratio
        Smallest and largest a/b [-].
    offset
        Largest ``abs(bpos - bneg) / (bpos + bneg)`` [-].
    spin
        Largest spin, as ``G a b c KP abs(phi) / (mu Fn)`` with ``c = sqrt(a b)`` and KP of about Kalker's C23 [-]; infinite: all.
    asked
        Requested error, relative to mu Fn [-].
    error
        Largest errors at the check points: of the forces relative to mu Fn, of the moment relative to mu Fn sqrt(a b) [-].
    points
        Number of independent random points of the check.
    grid_error
        Largest differences between results with this number of elements and with three times as many along each side, as `error`.
    bytes
        Memory of the table [bytes].
    """

    has_offset: bool
    elements: int
    order: int
    poisson: float
    ratio: tuple[float, float]
    offset: float
    spin: float
    asked: float
    error: tuple[float, float]
    points: int
    grid_error: tuple[float, float]
    bytes: int

    def __str__(self) -> str:
        kind = f"two half ellipses, offset up to {self.offset:.3g}" if self.has_offset else "ellipses"
        spin = "all spins" if np.isinf(self.spin) else f"spins up to {self.spin:.3g} mu Fn/(G a b c KP)"
        return (f"{kind}, a/b from {self.ratio[0]:.3g} to {self.ratio[1]:.3g}, {spin}, Poisson ratio {self.poisson:.3g}\n"
                f"largest error at {self.points} random points: forces {100 * self.error[0]:.3g} % of mu Fn, "
                f"moment {100 * self.error[1]:.3g} % of mu Fn sqrt(a b); required {100 * self.asked:.3g} %\n"
                f"made of results with {self.elements} x {self.elements} elements of order {self.order}; against three times "
                f"as many: {100 * self.grid_error[0]:.3g} and {100 * self.grid_error[1]:.3g} %\n"
                f"{self.bytes / 1e6:.3g} MB of memory")


def _prototypes() -> ctypes.CDLL:
    """The library with declared argument types"""
    loaded = library()
    if not hasattr(loaded, "contact_table_open"):
        raise ContactError("The library is older than tables; rebuild it, or set CONTACT_LIBRARY to a newer one")
    loaded.contact_table_open.argtypes = [ctypes.c_char_p, ctypes.c_char_p, ctypes.c_int]
    loaded.contact_table_open.restype = ctypes.c_void_p
    loaded.contact_table_close.argtypes = [ctypes.c_void_p]
    loaded.contact_table_close.restype = None
    loaded.contact_table_about.argtypes = [ctypes.c_void_p, ctypes.POINTER(_Facts)]
    loaded.contact_table_forces.argtypes = [ctypes.c_void_p, ctypes.c_int, *5 * [ctypes.c_void_p]]
    return loaded


class Table(Handle):
    """A table of creep forces, made by ``contact table`` or :func:`build`. Several threads may use it at the same time.

    Parameters
    ----------
    file
        Its path.

    Raises
    ------
    ContactError
        If it cannot be used; the message gives the reason.

    Examples
    --------
    >>> with contact.table.Table("steel.table") as table:
    ...     force = table.force(fn=70e3, mu=0.3, gg=82e3, aa=6.0, bb=5.0, cksi=0.001)
    """

    _closer = "contact_table_close"

    def __init__(self, file: str | os.PathLike[str]) -> None:
        self._library = _prototypes()
        message = ctypes.create_string_buffer(1000)
        self._handle = self._library.contact_table_open(os.fsencode(file), message, len(message))
        if not self._handle:
            raise ContactError(message.value.decode("utf-8", errors="replace"))

    @property
    def facts(self) -> Facts:
        """Properties of the table."""
        facts = _Facts()
        if self._library.contact_table_about(self._handle, ctypes.byref(facts)) != 0:
            raise ContactError("the table is closed")
        return Facts(bool(facts.has_offset), facts.elements, facts.order, facts.poisson, (facts.ratio[0], facts.ratio[1]),
                     facts.offset, facts.spin, facts.asked, (facts.error[0], facts.error[1]), int(facts.points),
                     (facts.grid_error[0], facts.grid_error[1]), int(facts.bytes))

    def force(self, fn: ArrayLike, mu: ArrayLike, gg: ArrayLike, aa: ArrayLike, bb: ArrayLike, cksi: ArrayLike = 0.0,
              ceta: ArrayLike = 0.0, cphi: ArrayLike = 0.0, offset: ArrayLike = 0.0, *, outside: bool = False) -> Numbers:
        """Creep forces on body 1, with the signs of results of basic contact.

        Parameters
        ----------
        fn, mu, gg
            Normal force [N], coefficient of friction [-], modulus of rigidity [N/mm2].
        aa, bb
            Semi-axes along and across the rolling direction [mm]; bb the mean of both extents of half ellipses.
        cksi, ceta, cphi
            Creepages [-] and spin [rad/mm].
        offset
            Of half ellipses: ``(bpos - bneg) / (bpos + bneg)`` [-].
        outside
            Whether to use values at the border of the table for shapes and spins outside it.

        Returns
        -------
        Fx, Fy [N] and Mz [N mm] in the last dimension; the dimensions before are those of the arguments, which are broadcast.

        Raises
        ------
        ContactError
            If the shape or spin is outside the table, or a value is not a number or not a positive length.
        """
        return self._ask((fn, mu, gg, aa, bb, cksi, ceta, cphi, offset), outside, False)[0]

    def derivatives(self, fn: ArrayLike, mu: ArrayLike, gg: ArrayLike, aa: ArrayLike, bb: ArrayLike, cksi: ArrayLike = 0.0,
                    ceta: ArrayLike = 0.0, cphi: ArrayLike = 0.0, offset: ArrayLike = 0.0, *,
                    outside: bool = False) -> tuple[Numbers, Numbers]:
        """Forces as :meth:`force`, and their derivatives: of Fx, Fy, Mz (last but one dimension) by cksi, ceta, cphi (last)."""
        return self._ask((fn, mu, gg, aa, bb, cksi, ceta, cphi, offset), outside, True)

    def _ask(self, given: tuple[ArrayLike, ...], outside: bool, slopes: bool) -> tuple[Numbers, Numbers]:
        """Look up arrays of values in one call"""
        if not self._handle:
            raise ContactError("the table is closed")
        fn, mu, gg, aa, bb, cksi, ceta, cphi, offset = np.broadcast_arrays(
            *(np.asarray(unmasked(value), dtype=float) for value in given))
        shape = fn.shape
        patches = np.ascontiguousarray(np.stack([fn, mu, gg, aa, bb * (1.0 - offset), bb * (1.0 + offset)], axis=-1))
        creepages = np.ascontiguousarray(np.stack([cksi, ceta, cphi], axis=-1))
        forces = np.empty((*shape, 3))
        derivatives = np.empty((*shape, 3, 3) if slopes else 0)
        answers = np.empty(shape, dtype=np.intc)
        worst = self._library.contact_table_forces(self._handle, fn.size, patches.ctypes.data, creepages.ctypes.data,
                                                   forces.ctypes.data, derivatives.ctypes.data if slopes else None,
                                                   answers.ctypes.data)
        if worst == _WRONG:
            raise ContactError("a value is no number or above 1e40, or a length or the modulus of rigidity is not positive")
        if worst == _OUTSIDE and not outside:
            facts = self.facts
            raise ContactError(f"the table has no such contact: it has a/b from {facts.ratio[0]:.3g} to {facts.ratio[1]:.3g}"
                               + (f" and offsets up to {facts.offset:.3g}" if facts.has_offset else " and no offset")
                               + ("" if np.isinf(facts.spin) else f", and spins up to {facts.spin:.3g} mu Fn/(G a b c KP)"))
        return forces, derivatives
