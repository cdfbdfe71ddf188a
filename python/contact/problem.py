"""Basic contact of two bodies (module 3)."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Callable

import numpy as np
from numpy.typing import ArrayLike

from . import cntc
from ._element import Element, Field, Patch, Stresses, fail_if, read_patch, read_stresses, warn_of_border, warn_of_few_elements
from ._library import last_error, unmasked


def _counts(*counts: int) -> list[int]:
    """Numbers of elements as integers; the library would round them"""
    if any(int(count) != count for count in counts):
        raise ValueError(f"numbers of elements {', '.join(map(str, counts))} must be integers")
    return [int(count) for count in counts]


@dataclass(frozen=True, eq=False, repr=False)
class Result(Patch):
    """Results of a problem of basic contact: those of :class:`Patch` and

    Attributes
    ----------
    border_elements
        Number of elements in contact in the first and last rows and columns. A value above 0 means that the grid may
        be too small.
    status, reason
        ``"solved"``, or ``"not converged"`` and the reason, which a :class:`NotConvergedWarning` reports as well.
        ``"checked"`` after ``set_flags(ic_return=3)``: only the input was checked, and all numbers are those of the
        last solution, 0 without one.
    """

    border_elements: int
    status: str = "solved"
    reason: str = ""

    def _title(self) -> str:
        return f"Result, {self.status}" + (f": {self.reason}" if self.reason else "")

    def totals(self) -> dict[str, float]:
        """Totals by their names in files, with ``border_elements``."""
        return {**super().totals(), "border_elements": self.border_elements}


class Problem(Element):
    """Two bodies in contact, described by their undeformed distance.

    Parameters
    ----------
    motion
        ``"steady"`` rolling, ``"transient"`` rolling, ``"shift"`` or ``"frictionless"``.
    units
        ``"mm"`` (mm, N, forces on body 1), ``"si"`` (m, N, forces on body 1) or ``"simpack"`` (m, N, forces on
        body 2).

    Examples
    --------
    >>> with contact.Problem() as problem:
    ...     problem.set_material(g=82000.0, nu=0.28)
    ...     problem.set_friction(0.3)
    ...     problem.set_hertz(21, 21, aa=5.0, bb=5.0)
    ...     problem.set_normal_force(50e3)
    ...     problem.set_creepages(0.001)
    ...     result = problem.solve()
    >>> result.pn.shape
    (21, 21)
    """

    _module = 3
    _icp = 1

    def __init__(self, motion: str = "steady", units: str = "mm") -> None:
        super().__init__(motion, units)
        self._grid: tuple[Field, Field] | None = None

    def set_hertz(self, mx: int, my: int, *, aa: float | None = None, bb: float | None = None,
                  a1: float | None = None, b1: float | None = None, scale: float = 1.2) -> None:
        """Hertzian contact of bodies of constant curvature; the grid is chosen by the library.

        Parameters
        ----------
        mx, my
            Numbers of elements.
        aa, bb
            Semi-axes of the contact ellipse along x and y [L], or
        a1, b1
            coefficients of the distance a1 x**2 + b1 y**2 [1/L], half the sum of the curvatures of both bodies: a ball of
            radius R on a plane has 1/(2 R), two equal discs have 1/R along x.
        scale
            Size of the grid relative to the ellipse.
        """
        mx, my = _counts(mx, my)
        if aa is not None and bb is not None and a1 is None and b1 is None:
            self._do(cntc.sethertzcontact, self.number, 1, -3, [mx, my, aa, bb, scale])
        elif a1 is not None and b1 is not None and aa is None and bb is None:
            self._do(cntc.sethertzcontact, self.number, 1, -1, [mx, my, a1, b1, scale])
        else:
            raise ValueError("set_hertz needs either aa and bb or a1 and b1")
        self._grid = None

    def set_grid(self, mx: int, my: int, dx: float, dy: float, xl: float | None = None,
                 yl: float | None = None) -> tuple[Field, Field]:
        """Rectangular grid; call :meth:`set_distance` next.

        Parameters
        ----------
        mx, my
            Numbers of elements.
        dx, dy
            Sides of an element [L].
        xl, yl
            Lower corner [L], default such that the origin is in the middle.

        Returns
        -------
        Coordinates x (mx,) and y (my,) of the centres of elements [L].
        """
        mx, my = _counts(mx, my)
        xl = -0.5 * mx * dx if xl is None else xl
        yl = -0.5 * my * dy if yl is None else yl
        self._do(cntc.setpotcontact, self.number, 1, 1, [mx, my, xl, yl, dx, dy])
        self._grid = (xl + dx * (np.arange(mx) + 0.5), yl + dy * (np.arange(my) + 0.5))
        return self._grid

    def set_distance(self, distance: ArrayLike | Callable[[Field, Field], ArrayLike]) -> None:
        """Undeformed distance of the surfaces [L], positive where they are separated.

        Parameters
        ----------
        distance
            Array of shape (my, mx), or one that is broadcast to it, or a function of x (1, mx) and y (my, 1) that returns it.
            It is given at the elements of the grid, so ``set_solver(accuracy=...)`` works with :meth:`set_hertz` only.
        """
        if self._grid is None:
            raise ValueError("set_distance needs set_grid first")
        x, y = self._grid
        values = distance(x[np.newaxis, :], y[:, np.newaxis]) if callable(distance) else distance
        values = np.asarray(unmasked(values), dtype=np.float64)
        shape = y.size, x.size
        try:
            values = np.broadcast_to(values, shape)
        except ValueError:
            raise ValueError(f"the undeformed distance has shape {values.shape}; (my, mx) = {shape} is needed, or a shape "
                             "that is broadcast to it") from None
        self._do(cntc.setundeformeddistc, self.number, 1, 9, values)

    def set_approach(self, pen: float) -> None:
        """Approach of the bodies [L]."""
        self._do(cntc.setpenetration, self.number, 1, pen)

    def set_normal_force(self, fn: float) -> None:
        """Normal force [F]."""
        self._do(cntc.setnormalforce, self.number, 1, fn)

    def set_creepages(self, cksi: float = 0.0, ceta: float = 0.0, cphi: float = 0.0) -> None:
        """Creepages [-], [-], [A/L], or for a shift [L], [L], [A]."""
        self.set_flags(ic_force=0)
        self._do(cntc.setcreepages, self.number, 1, cksi, ceta, cphi)

    def set_tangential_force(self, fx: float, fy: float | None = None, *, ceta: float = 0.0,
                             cphi: float = 0.0) -> None:
        """Tangential forces relative to the friction coefficient times the normal force [-].

        Without fy, the lateral creepage ceta is prescribed instead of the lateral force.
        """
        self.set_flags(ic_force=1 if fy is None else 2)
        self._do(cntc.setcreepages, self.number, 1, 0.0, ceta, cphi)
        self._do(cntc.settangentialforces, self.number, 1, fx, 0.0 if fy is None else fy)

    def set_rolling(self, velocity: float, step: float | None = None, direction: float = 0.0) -> None:
        """Rolling velocity [V], positive, step dq [L] and direction [A]: 0, or pi for rolling backwards.

        In transient rolling give the step, usually dx. The default of the library is 2 mm, which may be longer than
        the contact. Steady rolling always uses steps of one element.

        The default velocity is 1 m/s. Temperatures, frictional power, friction depending on the slip velocity and
        viscoelastic bodies need the actual velocity.
        """
        if velocity <= 0.0:
            raise ValueError(f"velocity = {velocity!r} must be positive; rolling backwards is direction=math.pi, with a step")
        self._do(cntc.setreferencevelocity, self.number, 1, velocity)
        if step is not None:
            self._do(cntc.setrollingstepsize, self.number, 1, direction, step)
        elif direction != 0.0:
            raise ValueError("a direction needs a step")

    def solve(self, initiation: bool = True) -> Result:
        """Solve the problem.

        Parameters
        ----------
        initiation
            True starts a new sequence. False continues from the previous solution, in shifts and transient rolling.

        Raises
        ------
        ContactError
            If there is no solution, with the code and message of the library.
        """
        border = self._calculate(initiation)
        patch = read_patch(self.number, 1, self.units, self.motion)
        if self._status == "checked":
            # the complaint that there are no results does not belong to the next call
            last_error(self.number, 1)
        warn_of_border(patch, "contact")
        warn_of_few_elements(patch, "contact")
        return Result(**patch.__dict__, border_elements=border, status=self._status, reason=self._reason)

    def stresses(self, block: int = 1) -> Stresses:
        """Stresses at the points of :meth:`add_block`, due to the tractions of the last solution."""
        fail_if(block < 1, -99, f"There is no block {block}")
        self._calculate_stresses()
        return read_stresses(self.number, 1, block, self.units)
