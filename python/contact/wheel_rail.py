"""Wheel on rail or on roller (module 1)."""
from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import cntc
from ._element import (Element, Field, Patch, Stresses, buried_ends, fail_if, read_patch, read_stresses, warn_of_border,
                       warn_of_few_elements)
from ._jacobian import Jacobian, read_jacobian
from ._view import CONVENTIONS, meaning_of, optional, plot_patches, tree
from .errors import ContactWarning

# Values of the flag own_angle
_ANGLES = {"established": 0, "contact": 1}
_SIDES = {("left", False): 0, ("right", False): 1, ("left", True): 4, ("right", True): 5}


@dataclass(frozen=True)
class Wrench:
    """Force (3,) [F] and moment (3,) [F L] about a marker."""

    force: Field
    moment: Field


@dataclass(frozen=True)
class Forces:
    """Total forces on the rail, or on the wheel with ``units="simpack"``.

    Attributes
    ----------
    track, rail
        About the rail marker, in the directions of the track and of the rail.
    wheelset, wheel
        About the wheel marker, in the directions of the wheelset and of the wheel.
    """

    track: Wrench
    wheelset: Wrench
    rail: Wrench
    wheel: Wrench


@dataclass(frozen=True, eq=False, repr=False)
class WheelRailPatch(Patch):
    """Results of one patch: those of :class:`Patch`, with places x, y from the contact reference point, and

    Attributes
    ----------
    position
        Contact reference point in the track system, shape (3,) [L].
    angle
        Contact angle: inclination about the x axis of the track [A].
    location
        All 38 numbers of ``cntc_getcontactlocation``.
    velocity
        Reference velocity [V].
    """

    position: Field
    angle: float
    location: Field
    velocity: float

    def totals(self) -> dict[str, float]:
        """Totals by their names in files, with the position of the patch in track coordinates."""
        return {**super().totals(), **dict(zip(("xcp_tr", "ycp_tr", "zcp_tr"), self.position.tolist())), "deltcp_tr": self.angle}


@dataclass(frozen=True, eq=False, repr=False)
class WheelRailResult:
    """Results of a wheel on a rail.

    Attributes
    ----------
    patches
        The contact patches; empty when wheel and rail do not touch.
    forces
        Sum over the patches.
    wheelset_position
        s, y, z [L], roll, yaw, pitch [A]; z is computed if the vertical force is prescribed. Shape (6,).
    wheelset_velocity
        vs, vy, vz [V], rates of roll, yaw, pitch [A/T]. Shape (6,).
    status, reason
        ``"solved"``, or ``"not converged"`` and the reason, which a :class:`NotConvergedWarning` reports as well.
        ``"checked"`` after ``set_flags(ic_return=3)``: only the input was checked, and there are no patches.
    buried
        Where wheel and rail overlap without a contact patch: ``"inner"`` or ``"outer"`` for ends of the wheel profile inside
        the rail, ``"beside"`` for another position along the track. Contact there carries no load in this result, and a
        :class:`ContactWarning` reports it.
    border_elements
        Elements in contact in the first and last rows and columns of the grids, of all patches together.
    units
        Those of the problem.
    """

    patches: tuple[WheelRailPatch, ...]
    forces: Forces
    wheelset_position: Field
    wheelset_velocity: Field
    status: str = "solved"
    reason: str = ""
    buried: tuple[str, ...] = ()
    border_elements: int = 0
    units: str = "mm"

    def totals(self) -> dict[str, float]:
        """Total forces and the position of the wheelset by their names in files, see doc/user/results.md."""
        names = [f"f{axis}_tr" for axis in "xyz"] + [f"f{axis}_ws" for axis in "xyz"]
        found = dict(zip(names, [*self.forces.track.force.tolist(), *self.forces.wheelset.force.tolist()]))
        found.update(zip(("s_ws", "y_ws", "z_ws", "roll_ws", "yaw_ws"), self.wheelset_position.tolist()))
        return {**found, "vpitch_ws": float(self.wheelset_velocity[5])}

    def _title(self) -> str:
        count = len(self.patches)
        return (f"WheelRailResult, {self.status}" + (f": {self.reason}" if self.reason else "")
                + f", {count} contact patch{'' if count == 1 else 'es'}")

    def __repr__(self) -> str:
        force = ", ".join(f"f{axis}={value:.5g}" for axis, value in zip("xyz", self.forces.track.force))
        return f"<{self._title()}: {force}, z={self.wheelset_position[2]:.5g}>"

    def __str__(self) -> str:
        lines = [self._title()]
        for name, value in self.totals().items():
            unit, text = meaning_of(name, self.units)
            lines.append(f"  {name:16s}{value:12.5g} {unit:8s} {text}")
        return "\n".join(lines + [f"  {number}: {patch!r}" for number, patch in enumerate(self.patches, 1)])

    def plot(self, field: str = "pn", **options: Any) -> Any:
        """Draw a field of all patches side by side, with matplotlib; see :meth:`Patch.plot`.

        Returns
        -------
        An array of axes, one for each patch.
        """
        return plot_patches(self.patches, field, options)

    def to_xarray(self) -> Any:
        """Total forces and, below them, the patches as an ``xarray.DataTree`` with ``/patch_1``, ...

        Raises
        ------
        ImportError
            If xarray is not installed, or older than 2024.10.
        """
        xarray = optional("xarray", "to_xarray")
        values = {}
        for name, value in self.totals().items():
            unit, text = meaning_of(name, self.units)
            values[name] = ((), value, {"long_name": text, "units": unit})
        return tree(xarray.Dataset(values, attrs={"Conventions": CONVENTIONS, "title": self._title()}),
                    [patch.to_xarray() for patch in self.patches])


class WheelRail(Element):
    """A wheel on a rail, described by profiles, track and wheelset dimensions.

    Parameters
    ----------
    side
        ``"right"`` or ``"left"``.
    roller
        Whether the wheel runs on a roller.
    motion, units
        As for :class:`contact.Problem`.
    contact_angle
        On rails that vary along the track: ``"contact"``, the angle of wheel and rail where they touch, or
        ``"established"``, that of the rail section below the axle, as in the established program.
    """

    _module = 1
    _icp = -1

    def __init__(self, side: str = "right", *, roller: bool = False, motion: str = "steady",
                 units: str = "mm", contact_angle: str = "contact") -> None:
        if (side, roller) not in _SIDES:
            raise ValueError(f"side = {side!r} is neither 'left' nor 'right'")
        if contact_angle not in _ANGLES:
            raise ValueError(f"contact_angle = {contact_angle!r} is none of {', '.join(_ANGLES)}")
        super().__init__(motion, units)
        self.side = side
        self._sides: tuple[float, float] | None = None
        self._has_force = False
        self._lacks_height = False
        self.set_flags(ic_config=_SIDES[side, roller], own_angle=_ANGLES[contact_angle])

    def set_grid(self, dx: float, ds: float, *, a_sep: float = np.pi / 2, d_sep: float | None = None,
                 d_comb: float | None = None, step: float = 1.0) -> None:
        """Element sizes, and distances at which patches are combined or separated.

        Parameters
        ----------
        dx, ds
            Sides of an element along and across the rail [L]. They are doubled until a patch has at most ``ic_npomax`` elements
            (`set_flags`), 20,000 unless set, with a warning.
        a_sep
            Patches whose planes differ by more than this angle are never combined [A].
        d_sep, d_comb
            Patches farther apart than d_sep are separate, closer than d_comb combined [L]; default 8 and 4 mm.
        step
            Rolling step relative to dx [-].
        """
        millimetre = 1.0 if self.units == "mm" else 1e-3
        self._do(cntc.setpotcontact, self.number, -1, -1,
                 [dx, ds, a_sep, 8 * millimetre if d_sep is None else d_sep,
                  4 * millimetre if d_comb is None else d_comb])
        self._do(cntc.setrollingstepsize, self.number, -1, 0.0, step)
        self._sides = dx, ds

    def _warn_of_large_elements(self, patch: Patch, what: str) -> None:
        """Warn of elements that are larger than those of `set_grid`, unless an accuracy chooses them"""
        if self._sides is None or max(patch.dx / self._sides[0], patch.dy / self._sides[1]) < 1.5:
            return
        most, accuracy = cntc.getflags(self.number, -1, [cntc.CNTC["ic_npomax"], cntc.CNTC["own_accuracy"]])
        if accuracy:
            return
        warnings.warn(f"the elements of {what} have sides of {patch.dx:.4g} x {patch.dy:.4g} in place of {self._sides[0]:.4g} x "
                      f"{self._sides[1]:.4g}, because there are at most ic_npomax = {most}", ContactWarning, stacklevel=3)

    def set_rail(self, profile: str | os.PathLike[str] | ArrayLike, scale: float = 1.0, smooth: float = 0.0) -> None:
        """Rail profile: a file, or an array of y, z of shape (n, 2) with z down; scale is the factor to mm."""
        self._set_profile(0, profile, scale, smooth)

    def set_wheel(self, profile: str | os.PathLike[str] | ArrayLike, scale: float = 1.0, smooth: float = 0.0) -> None:
        """Wheel profile: a file, or an array of y, z of shape (n, 2) with z down; scale is the factor to mm."""
        self._set_profile(1, profile, scale, smooth)

    def _set_profile(self, kind: int, profile: str | os.PathLike[str] | ArrayLike, scale: float,
                     smooth: float) -> None:
        what = ("rail", "wheel")[kind]
        if isinstance(profile, (str, os.PathLike)):
            self._do(cntc.setprofileinputfname, self.number, os.path.abspath(profile), [kind], [scale, smooth])
        else:
            self._do(cntc.setprofileinputvalues, self.number, profile, [kind], [scale, smooth])
        state, detail = cntc.getprofilevalues(self.number, -1, [kind, 0])
        fail_if(state != 0, state, f"The profile of the {what} cannot be used (detail {detail})", self.number)

    def set_track(self, gauge_height: float, gauge_width: float, cant: float = 0.0, *, gauge_sequence: int = 0,
                  roller_radius: float = 0.0, curvature: float = 0.0, deviation: Sequence[float] = (0.0,) * 6) -> None:
        """Track dimensions, with the rail placed by its gauge point.

        Parameters
        ----------
        gauge_height
            Depth of the gauge point below the rail top [L], positive.
        gauge_width
            Distance between the gauge points of both rails [L].
        cant
            Inclination of the rail, positive towards the track centre [A].
        gauge_sequence
            Number of the gauge face; read and not used.
        roller_radius
            Nominal radius of a roller [L].
        curvature
            Curvature of the track, positive to the right [1/L]; turns the rail with the rate -vs times curvature.
        deviation
            dy, dz [L], roll [A] of the rail and their rates [V], [V], [A/T].
        """
        if not gauge_height > 0.0:
            raise ValueError("gauge_height has to be positive; set_rail_position places a rail without gauge point")
        self._do(cntc.settrackdimensions, self.number, 3,
                 [gauge_height, gauge_sequence, gauge_width, cant, roller_radius, curvature, *deviation])

    def set_rail_position(self, y: float, z: float, cant: float = 0.0, *, roller_radius: float = 0.0,
                          curvature: float = 0.0, deviation: Sequence[float] = (0.0,) * 6) -> None:
        """Track, with the origin of the rail profile placed at y, z [L] of the track system; otherwise as `set_track`."""
        self._do(cntc.settrackdimensions, self.number, 3, [-1.0, y, z, cant, roller_radius, curvature, *deviation])

    def set_wheelset(self, flange_back: float, flange_back_position: float, radius: float, *, tape: float | None = None) -> None:
        """Distance between the backs of the flanges, lateral coordinate of the back in the profile, radius [L].

        The radius is that at the lateral coordinate `tape` of the profile [L]; without it at the origin.
        """
        # 999 mm or more means the origin
        self._do(cntc.setwheelsetdimensions, self.number, 3,
                 [flange_back, flange_back_position, radius, 1000.0 if tape is None else tape])

    def set_position(self, s: float = 0.0, y: float = 0.0, z: float | None = None, roll: float = 0.0,
                     yaw: float = 0.0, pitch: float = 0.0) -> None:
        """Position of the wheelset [L], [A]. A height z replaces the prescribed vertical force; without it, z is computed."""
        self._do(cntc.setwheelsetposition, self.number, 1, [s, y, 0.0 if z is None else z, roll, yaw, pitch])
        if z is not None or self._has_force:
            self.set_flags(ic_norm=int(z is None))
        self._lacks_height = z is None and not self._has_force

    def set_velocity(self, vs: float, vy: float = 0.0, vz: float = 0.0, roll: float = 0.0, yaw: float = 0.0,
                     pitch: float = 0.0) -> None:
        """Velocity of the wheelset [V] and its rates [A/T]; forward rolling has a negative pitch rate.

        On a roller vs is the rate of the roller [A/T].
        """
        self._do(cntc.setwheelsetvelocity, self.number, 2, [vs, vy, vz, roll, yaw, pitch])

    def set_flexibility(self, position: Sequence[float], velocity: Sequence[float] = (0.0,) * 6) -> None:
        """Deviation of the wheel from the rigid wheelset: dx, dy, dz, roll, yaw, pitch and their rates."""
        self._do(cntc.setwheelsetflexibility, self.number, 5, [*position, *velocity])

    def set_vertical_force(self, fz: float) -> None:
        """Vertical force of the wheel on the rail, positive down [F]; replaces a prescribed height."""
        self._do(cntc.setverticalforce, self.number, fz)
        self._has_force, self._lacks_height = True, False

    def set_longitudinal_force(self, fx: float = 0.0) -> None:
        """Prescribe the longitudinal force on the rail in wheelset axes [F]; the pitch rate is computed.

        0: free rolling; positive: braking; negative: driving. ``wheelset_velocity[5]`` of the result is the rate;
        that of ``set_velocity`` is not used. After ``set_flags(ic_force=0)`` the last computed rate
        is prescribed, until ``set_velocity`` sets another one.
        """
        self.set_flags(ic_force=1)
        self._do(cntc.settangentialforces, self.number, -1, fx, 0.0)

    def solve(self, initiation: bool = True) -> WheelRailResult:
        """Find the contact patches and solve them.

        Parameters
        ----------
        initiation
            False continues from the previous solution.

        Raises
        ------
        ContactError
            If there is no solution, with the code and message of the library.
        ValueError
            If `set_position` was called without a height, and no vertical force was set.
        """
        number = self.number
        if self._lacks_height and cntc.getflags(number, -1, [cntc.CNTC["ic_norm"]])[0] == 0:
            raise ValueError("the height of the wheelset is not known: set_vertical_force, or set_position with z, is needed")
        border = self._calculate(initiation)
        patches = tuple(self._patch(icp) for icp in range(1, cntc.getnumcontactpatches(number) + 1))
        for icp, patch in enumerate(patches, 1):
            warn_of_border(patch, f"contact patch {icp}")
            warn_of_few_elements(patch, f"contact patch {icp}")
            self._warn_of_large_elements(patch, f"contact patch {icp}")
        values = cntc.getglobalforces(number, -1).reshape(4, 2, 3)
        forces = Forces(*(Wrench(force, moment) for force, moment in values))
        buried = buried_ends(number)
        if buried:
            where = " and ".join("another position along the track" if name == "beside" else f"the {name} end of the wheel profile"
                                 for name in buried)
            warnings.warn(f"{where}: wheel and rail overlap where no contact patch is, and carry no load there", ContactWarning,
                          stacklevel=2)
        return WheelRailResult(patches, forces, cntc.getwheelsetposition(number), cntc.getwheelsetvelocity(number),
                               self._status, self._reason, buried, border, self.units)

    def jacobian(self) -> Jacobian:
        """Derivatives of forces, moments and height at the last solution with respect to position, velocities and vertical force.

        The linear systems of the derivatives are solved by this call only.

        Raises
        ------
        ContactError
            If nothing was solved, or if the derivatives do not exist or are not available for the settings.
        """
        return read_jacobian(self.number)

    def _patch(self, icp: int) -> WheelRailPatch:
        """Results of one patch, copied"""
        location = cntc.getcontactlocation(self.number, icp)
        patch = dict(read_patch(self.number, icp, self.units, self.motion).__dict__)
        # the library gives places of elements in steps from another origin
        reference = cntc.getparameters(self.number, icp)
        patch.update(x=patch["x"] - reference["spinxo"], y=patch["y"] - reference["spinyo"])
        return WheelRailPatch(**patch, position=location[:3], angle=location[3],
                              location=location, velocity=cntc.getreferencevelocity(self.number, icp))

    def stresses(self, block: int = 1) -> tuple[Stresses, ...]:
        """Stresses at the points of :meth:`add_block`, one entry per contact patch."""
        self._calculate_stresses()
        count = cntc.getnumcontactpatches(self.number)
        return tuple(read_stresses(self.number, icp, block, self.units) for icp in range(1, count + 1))
