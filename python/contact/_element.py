"""What basic contact and wheel/rail contact have in common: a result element with its settings."""
from __future__ import annotations

import os
import tempfile
import threading
import warnings
import weakref
from collections.abc import Sequence
from dataclasses import dataclass
from types import TracebackType
from typing import Any, Callable, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import cntc
from ._library import case_status, last_error
from ._view import View, meaning_of, optional, stress_meaning
from .cntc import CNTC
from .errors import ContactError, ContactWarning, NotConvergedWarning

Field = NDArray[np.floating[Any]]
_Self = TypeVar("_Self", bound="Element")

_UNITS = {"mm": "un_cntc", "si": "un_si", "simpack": "un_spck"}
_SOURCES = {"established": 0, "moving": 1}
_SIDES = ("x low", "x high", "y low", "y high", "inner end of the rail profile", "outer end of the rail profile",
          "inner end of the wheel profile", "outer end of the wheel profile",
          "a part of the profiles that cannot be seen from the plane of the contact")
# Totals of wear that are 0 without their coefficients, or without points below the surface
_CONDITIONAL = ("max_wear", "worn_section", "shakedown_load", "shakedown", "fatigue_index", "max_mises", "max_tresca")
# Codes of calculations that missed a tolerance or a prescribed force, but have a result
_WITH_RESULT = (CNTC["err_norm"], CNTC["err_tang"], CNTC["err_tol"])
_MOTIONS = {"frictionless": 0, "shift": 1, "transient": 2, "steady": 3}

_lock = threading.Lock()
_used: set[int] = set()
_place: tuple[str, str] | None = None
_temporary: tempfile.TemporaryDirectory[str] | None = None


def output_to(folder: str | os.PathLike[str], name: str = "contact") -> None:
    """Set the folder and name of the files of the following problems: ``<name>.out`` with the log, ``.mat`` and ``.subs`` files.

    By default they are written to a temporary folder and removed when Python ends. A new ``.out`` file begins with
    the first problem, and after all problems were closed.

    Raises
    ------
    ContactError
        If problems are open.
    """
    global _place
    with _lock:
        if _used:
            raise ContactError("output_to has to come before the first problem, or after all are closed")
        os.makedirs(folder, exist_ok=True)
        _place = (os.path.abspath(os.fspath(folder)), name)


def _output() -> tuple[str, str]:
    """Folder and name of the log"""
    global _temporary
    if _place is not None:
        return _place
    if _temporary is None:
        _temporary = tempfile.TemporaryDirectory(prefix="contact_")
    return _temporary.name, "contact"


def _take_number(module: int) -> int:
    """An unused result element, from the highest number down; callers of cntc usually start with the lowest"""
    with _lock:
        number = next((number for number in range(999, 0, -1) if number not in _used), None)
        if number is None:
            raise ContactError("There are 999 open problems already; close some")
        if not _used:
            folder, name = _output()
            code = cntc.initlibrary(outdir=folder, expnam=name, idebug=0)[2]
            fail_if(code != 0, code, "The library cannot be started")
            cntc.setglobalflags(CNTC["if_idebug"], 0)
        code = cntc.initialize(number, module, idebug=0)[1]
        fail_if(code != 0, code, "No further problem can be made; close some")
        _used.add(number)
    return number


def _give_back(number: int) -> None:
    """Free a result element"""
    with _lock:
        cntc.finalize(number)
        _used.discard(number)


def fail_if(condition: bool, code: int, what: str, ire: int = 0, icp: int = -1) -> None:
    """Raise ContactError with the text of the library, if it has one, else with the meaning of the code"""
    if condition:
        raise ContactError(f"{what}: {last_error(ire, icp)[1] or cntc.meaning(code)}", code)


@dataclass(frozen=True, eq=False, repr=False)
class Patch(View):
    """Results of one contact patch. Units as chosen for the problem; fields have shape (my, mx).

    ``print`` prints the totals, :meth:`plot` plots a field, :meth:`to_xarray` returns everything as a data set.

    Attributes
    ----------
    x, y
        Centres of the columns (mx,) and rows (my,) of elements [L].
    dx, dy
        Sides of an element [L].
    fn, fx, fy, mz
        Normal force, tangential forces [F], spin moment [F L].
    approach
        Approach of the bodies [L].
    cksi, ceta, cphi
        Creepages [-], [-], [A/L]; shifts [L], [L], [A].
    contact_area, adhesion_area, slip_area
        Areas [L2].
    max_pressure
        Largest pressure [F/L2]; with the second order the maximum between element centres, as PMAX of files.
    state
        0 exterior, 1 adhesion, 2 slip, 3 plastic.
    pn, px, py
        Pressure and tangential tractions [F/L2].
    un, ux, uy
        Displacement differences [L].
    sx, sy
        Micro-slip [-]; shift distance in mm when the motion is a shift.
    distance
        Undeformed distance [L].
    friction
        Friction coefficient [-].
    temperatures
        Surface temperatures of bodies 1 and 2, shape (2, my, mx) [degrees C]; None without
        :meth:`Problem.set_temperatures`.
    max_temperatures
        Highest temperatures of bodies 1 and 2 in contact [degrees C]; None without.
    border
        Where contact is cut off: "x low", "x high", "y low", "y high" for sides of the grid, and ends of profiles.
        Not empty means that pressures and forces are wrong: the grid is too small, or the profile too short.
    units, motion
        As of the problem: ``"mm"``, ``"si"`` or ``"simpack"``; ``"steady"``, ``"transient"``, ``"shift"`` or ``"frictionless"``.
    errors
        Estimated errors of totals by their names in files and in the units of these, ``errors["fx"]``; without prescribed totals
        and totals without an estimate. None without :meth:`Problem.set_errors` or a required accuracy.
    wear
        Totals of wear and fatigue by their names in files, ``wear["t_gamma"]``, see doc/user/studies.md; 0 for totals that do
        not apply to the case. None without :meth:`Problem.set_wear`.
    power, wear_depth
        Density of frictional power in rolling [W/mm2], not negative except for round-off; wear depth in each element of a passage
        of the contact, or of a shift [L]. None if they are not computed, and if there is no wear.
    """

    x: Field
    y: Field
    dx: float
    dy: float
    fn: float
    fx: float
    fy: float
    mz: float
    approach: float
    cksi: float
    ceta: float
    cphi: float
    contact_area: float
    adhesion_area: float
    slip_area: float
    max_pressure: float
    state: NDArray[np.intc]
    pn: Field
    px: Field
    py: Field
    un: Field
    ux: Field
    uy: Field
    sx: Field
    sy: Field
    distance: Field
    friction: Field
    temperatures: Field | None
    max_temperatures: tuple[float, float] | None
    border: tuple[str, ...]
    units: str
    motion: str
    errors: dict[str, float] | None
    wear: dict[str, float] | None
    power: Field | None
    wear_depth: Field | None

    def fields(self) -> dict[str, Any]:
        """Element fields of shape (my, mx) by names in files: ``eldiv`` is the state, ``h`` the distance, ``mu`` the friction."""
        found = {"eldiv": self.state, "h": self.distance, "mu": self.friction, "pn": self.pn, "un": self.un}
        if self.motion != "frictionless":
            found.update(px=self.px, py=self.py, ux=self.ux, uy=self.uy, sx=self.sx, sy=self.sy)
        elif self.ux.any() or self.uy.any():
            # pressures displace the surfaces of dissimilar bodies laterally
            found.update(ux=self.ux, uy=self.uy)
        if self.temperatures is not None:
            found.update(temp1=self.temperatures[0], temp2=self.temperatures[1])
        if self.power is not None:
            found["power"] = self.power
        if self.wear_depth is not None:
            found["wear"] = self.wear_depth
        return found

    def totals(self) -> dict[str, float]:
        """Totals by names in files: ``pen`` is the approach, ``pmax`` the largest pressure; shifts are ``shift_x``, ``shift_y``."""
        found = {"fn": self.fn, "fx": self.fx, "fy": self.fy, "mz": self.mz, "pen": self.approach, "pmax": self.max_pressure}
        motion = {"shift": ("shift_x", "shift_y", "rotation"), "frictionless": ()}.get(self.motion, ("cksi", "ceta", "cphi"))
        found.update(zip(motion, (self.cksi, self.ceta, self.cphi)))
        if self.max_temperatures is not None:
            found.update(zip(("max_temp1", "max_temp2"), self.max_temperatures))
        found["contact_area"] = self.contact_area
        # as in files: without totals that do not apply to the case
        found.update((name, value) for name, value in (self.wear or {}).items() if value != 0.0 or name not in _CONDITIONAL)
        counts = {"ncon": self.state > 0, "nadh": self.state == 1, "nslip": self.state == 2, "nplast": self.state == 3}
        found.update({name: int(np.count_nonzero(where)) for name, where in counts.items() if name != "nplast" or where.any()})
        return found

    def meaning(self, name: str) -> tuple[str, str]:
        """Unit and description of a field or a total by its name in files."""
        return meaning_of(name, self.units, self.motion == "shift")

    @property
    def elements_across(self) -> int:
        """Elements across the contact in its narrower direction, 0 without contact; fewer than 5 give inaccurate results."""
        touching = self.state > 0
        across = [int(touching.sum(axis=axis).max(initial=0)) for axis in (0, 1) if touching.shape[axis] >= 3]
        return min(across, default=0)

    @property
    def max_traction(self) -> float:
        """Largest tangential traction [F/L2]."""
        return float(np.hypot(self.px, self.py).max(initial=0.0))


def read_patch(ire: int, icp: int, units: str = "mm", motion: str = "steady") -> Patch:
    """All results of a patch, copied from the library; units and motion as of the problem"""
    mx, my, x, y, dx, dy = cntc.getpotcontact(ire, icp)
    fn, fx, fy, mz = cntc.getcontactforces(ire, icp)
    areas = cntc.getcontactpatchareas(ire, icp)
    heat, border, wants_wear, *wants_errors = cntc.getflags(ire, icp, [CNTC[name] for name in (
        "ic_heat", "own_border", "own_wear", "own_errors", "own_accuracy")])
    temperatures = highest = None
    if heat:
        temperatures = np.stack([cntc.getfielddata(ire, icp, CNTC[name]) for name in ("fld_temp1", "fld_temp2")])
        first, second = cntc.getmaximumtemperature(ire, icp)
        highest = (float(first), float(second))
    pn, px, py = cntc.gettractions(ire, icp)
    un, ux, uy = cntc.getdisplacements(ire, icp)
    sx, sy = cntc.getmicroslip(ire, icp)
    return Patch(x + dx * np.arange(mx), y + dy * np.arange(my), dx, dy, fn, fx, fy, mz,
                 cntc.getpenetration(ire, icp), *cntc.getcreepages(ire, icp), *areas[:3],
                 float(cntc.getmaximumpressure(ire, icp)), cntc.getelementdivision(ire, icp), pn, px, py, un, ux, uy, sx, sy,
                 cntc.getfielddata(ire, icp, CNTC["fld_h"]), cntc.getfielddata(ire, icp, CNTC["fld_mu"]), temperatures, highest,
                 tuple(name for bit, name in enumerate(_SIDES) if border >> bit & 1), units, motion,
                 _errors(ire, icp, motion) if any(wants_errors) else None, *_wear(ire, icp, motion, bool(wants_wear)))


def _errors(ire: int, icp: int, motion: str) -> dict[str, float]:
    """Estimated errors by the names of the totals; without those that are unknown"""
    moved = ("shift_x", "shift_y", "friction_work") if motion == "shift" else ("cksi", "ceta", "friction_power")
    names = ("fn", "fx", "fy", "mz", "pen", "pmax", "contact_area", *moved, "elastic_energy", "max_temp1")
    return {name: float(error) for name, error in zip(names, cntc.geterrors(ire, icp)) if error >= 0.0}


def _wear(ire: int, icp: int, motion: str, is_requested: bool) -> tuple[dict[str, float] | None, Field | None, Field | None]:
    """Totals of wear and fatigue by their names, density of power, depth"""
    if not is_requested:
        return None, None, None
    names = ("t_gamma", "wear_index", "max_power", "max_wear", "worn_section", "traction", "shakedown_load", "shakedown",
             "fatigue_index", "max_mises", "max_tresca")
    found = {name: float(value) for name, value in zip(names, cntc.getwear(ire, icp))}
    return (found, cntc.getfielddata(ire, icp, CNTC["fld_power"]) if motion in ("steady", "transient") else None,
            cntc.getfielddata(ire, icp, CNTC["fld_wear"]) if found["max_wear"] > 0.0 else None)


def buried_ends(ire: int) -> tuple[str, ...]:
    """Where wheel and rail overlap without a patch, see WheelRailResult.buried: bits after those of the sides"""
    border = int(cntc.getflags(ire, -1, [CNTC["own_border"]])[0])
    return tuple(name for bit, name in enumerate(("inner", "outer", "beside"), len(_SIDES)) if border >> bit & 1)


def warn_of_border(patch: Patch, what: str) -> None:
    """Warn of contact that is cut off, at the line of the caller's caller"""
    if patch.border:
        warnings.warn(f"{what} reaches {', '.join(patch.border)}: it is cut off, and pressures and forces are those of a "
                      "smaller contact area", ContactWarning, stacklevel=3)


def warn_of_few_elements(patch: Patch, what: str) -> None:
    """Warn of contact that is only a few elements wide, at the line of the caller's caller"""
    if 0 < patch.elements_across < 5:
        warnings.warn(f"{what} is only {patch.elements_across} elements wide: its area, forces and pressures are inaccurate; take "
                      "smaller elements", ContactWarning, stacklevel=3)


@dataclass(frozen=True, eq=False, repr=False)
class Stresses:
    """Displacements and stresses in a block of points; arrays have shape (nz, ny, nx).

    Attributes
    ----------
    x, y, z
        Coordinates (nx,), (ny,), (nz,) in the directions of the contact, z the depth [L].
    ux, uy, uz
        Displacements [L].
    hydrostatic, von_mises, tresca
        Invariants of the stress [F/L2].
    principal
        Principal stresses, shape (3, nz, ny, nx) [F/L2].
    tensor
        Stress tensor, shape (3, 3, nz, ny, nx) [F/L2].
    units
        Those of the problem.
    """

    x: Field
    y: Field
    z: Field
    ux: Field
    uy: Field
    uz: Field
    hydrostatic: Field
    von_mises: Field
    tresca: Field
    principal: Field
    tensor: Field
    units: str = "mm"

    def __repr__(self) -> str:
        nz, ny, nx = self.von_mises.shape
        if self.von_mises.size == 0:
            return "<Stresses: no points>"
        k, j, i = np.unravel_index(int(np.nanargmax(self.von_mises)), self.von_mises.shape)
        return (f"<Stresses: {nx} x {ny} x {nz} points, largest von Mises stress {self.von_mises[k, j, i]:.5g} at "
                f"x={self.x[i]:.5g}, y={self.y[j]:.5g}, z={self.z[k]:.5g}>")

    def fields(self) -> dict[str, Field]:
        """All values of shape (nz, ny, nx) by their names in files: ``sigvm`` for von Mises, ``sigxx``, ``sigma1``, ..."""
        found = {"ux": self.ux, "uy": self.uy, "uz": self.uz, "sighyd": self.hydrostatic, "sigvm": self.von_mises,
                 "sigtr": self.tresca, **{f"sigma{k + 1}": self.principal[k] for k in range(3)}}
        found.update({f"sig{first}{second}": self.tensor[i, j] for i, first in enumerate("xyz")
                      for j, second in enumerate("xyz") if i <= j})
        return found

    def to_xarray(self) -> Any:
        """All values over x, y and z as an ``xarray.Dataset`` with units and descriptions. Raises ImportError without xarray."""
        xarray = optional("xarray", "to_xarray")
        length, stress = meaning_of("pen", self.units)[0], meaning_of("pn", self.units)[0]
        values = {name: (("z", "y", "x"), field, {"long_name": stress_meaning(name), "units": length if name[0] == "u" else stress})
                  for name, field in self.fields().items()}
        depth = {"z": "depth", "x": "longitudinal position", "y": "lateral position"}
        return xarray.Dataset(values, {name: (name, getattr(self, name), {"long_name": text, "units": length})
                                       for name, text in depth.items()})

    def plot(self, field: str = "sigvm", y: float | None = None, ax: Any = None, **options: Any) -> Any:
        """Plot a field in the plane of one y, with matplotlib; a block with one x gives a curve over the depth.

        Parameters
        ----------
        field
            Name in files: ``"sigvm"``, ``"sigxx"``, ``"ux"``, ...
        y
            The plane of points nearest to this y [L]; default: that of the largest von Mises stress.
        ax
            Axes to draw into; new ones by default.
        options
            For matplotlib's ``pcolormesh``, or for ``plot``.

        Returns
        -------
        The axes; depth points downwards.

        Raises
        ------
        ImportError
            If matplotlib is not installed.
        ValueError
            If there is no such field, or no points.
        """
        fields = self.fields()
        if field not in fields:
            raise ValueError(f"there is no field {field!r}; there are {', '.join(fields)}")
        if self.von_mises.size == 0:
            raise ValueError("there are no points: no column or no row of the block is in the grid")
        pyplot = optional("matplotlib.pyplot", "plot")
        if ax is None:
            ax = pyplot.subplots()[1]
        row = int(np.abs(self.y - y).argmin()) if y is not None else int(np.nanmax(self.von_mises, axis=(0, 2)).argmax())
        length = meaning_of("pen", self.units)[0]
        unit = length if field[0] == "u" else meaning_of("pn", self.units)[0]
        label = f"{stress_meaning(field)} [{unit}]"
        if len(self.x) == 1 or len(self.z) == 1:
            over_depth = len(self.x) == 1
            ax.plot(self.z if over_depth else self.x, fields[field][:, row, :].reshape(-1), **options)
            ax.set(xlabel=f"{'z' if over_depth else 'x'} [{length}]", ylabel=label)
            return ax
        options.setdefault("shading", "nearest")
        ax.figure.colorbar(ax.pcolormesh(self.x, self.z, fields[field][:, row, :], **options), ax=ax, label=label)
        ax.set(xlabel=f"x [{length}]", ylabel=f"z [{length}]", aspect="equal", title=f"y = {self.y[row]:.4g} {length}")
        if not ax.yaxis_inverted():
            ax.invert_yaxis()
        return ax


def read_stresses(ire: int, icp: int, block: int, units: str = "mm") -> Stresses:
    """Results of a block, copied from the library; units as of the problem"""
    nx, ny, nz = cntc.subs_getblocksize(ire, icp, block)
    fail_if(min(nx, ny, nz) < 0, CNTC["err_other"], f"There are no stresses of block {block}")
    values = cntc.subs_getresults(ire, icp, block, range(1, 22)).reshape(21, nz, ny, nx)
    # The tensor comes by columns: xx, yx, zx, xy, ...
    tensor = values[12:21].reshape(3, 3, nz, ny, nx).swapaxes(0, 1)
    x, y, z, ux, uy, uz, hydrostatic, von_mises, tresca = values[:9]
    axes = x[:1, :1, :].ravel(), y[:1, :, :1].ravel(), z[:, :1, :1].ravel()
    return Stresses(*axes, ux, uy, uz, hydrostatic, von_mises, tresca, values[9:12], tensor, units)


class Element:
    """A result element; base of :class:`Problem` and :class:`WheelRail`.

    It is freed by :meth:`close`, or at the end of a ``with`` block.
    """

    _module: int
    _icp: int

    def __init__(self, motion: str, units: str) -> None:
        if units not in _UNITS:
            raise ValueError(f"units = {units!r} is none of {', '.join(_UNITS)}")
        if motion not in _MOTIONS:
            raise ValueError(f"motion = {motion!r} is none of {', '.join(_MOTIONS)}")
        self._number = _take_number(self._module)
        # Called once: by close, when the object is garbage-collected, or when Python ends
        self._release = weakref.finalize(self, _give_back, self._number)
        self.units = units
        self.motion = motion
        self._has_points = False
        self._stresses_known = False
        self.set_flags(if_units=CNTC[_UNITS[units]], ic_tang=_MOTIONS[motion], ic_pvtime=2, ic_output=0, ic_flow=0,
                       own_heat=_SOURCES["moving"], own_order=2)

    def __enter__(self: _Self) -> _Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()

    def __reduce_ex__(self, protocol: Any) -> Any:
        raise TypeError("a problem cannot be copied or pickled, since it stands for memory of the library; make it anew in each "
                        "process. Its results can be")

    def close(self) -> None:
        """Free the memory of the library; the results that were returned stay valid."""
        self._release()

    @property
    def number(self) -> int:
        """Number of the result element, for use with :mod:`contact.cntc`."""
        if not self._release.alive:
            raise ContactError("This problem is closed")
        return self._number

    def _do(self, routine: Callable[..., None], *arguments: Any) -> None:
        """Call a routine that sets values; a refusal raises an error, a replaced value gives a warning"""
        # the error of an earlier call of cntc belongs to that one
        last_error(self.number, self._icp)
        routine(*arguments)
        code, message = last_error(self.number, self._icp)
        if code != 0:
            raise ContactError(message, code)
        if message:
            warnings.warn(message, ContactWarning, stacklevel=3)

    def set_flags(self, **flags: int) -> None:
        """Flags and control digits by their names in :data:`contact.cntc.CNTC`, for instance ``ic_bound=4``."""
        unknown = [name for name in flags if name not in CNTC]
        if unknown:
            raise ValueError(f"there is no flag {', '.join(unknown)}")
        self._do(cntc.setflags, self.number, self._icp, [CNTC[name] for name in flags], list(flags.values()))
        # names and units of results follow the settings
        self.motion = next((name for name, digit in _MOTIONS.items() if digit == flags.get("ic_tang")), self.motion)
        self.units = next((name for name, flag in _UNITS.items() if CNTC[flag] == flags.get("if_units")), self.units)

    def set_errors(self, wanted: bool = True) -> None:
        """Estimate the errors of the totals in each solution, for 5 to 30 % more time; see ``errors`` of the results."""
        self.set_flags(own_errors=int(wanted))

    def set_wear(self, archard: float = 0.0, hardness: float = 0.0, shear_yield: float = 0.0) -> None:
        """Compute wear and fatigue with each solution, see ``wear``, ``power`` and ``wear_depth`` of the results.

        Parameters
        ----------
        archard
            Archard's wear coefficient for the materials and conditions [-]; 0: no depths.
        hardness
            Hardness of the softer body [F/L2], required with the coefficient.
        shear_yield
            Yield stress in cyclic shear [F/L2]; 0: no shakedown, no fatigue index.
        """
        self._do(cntc.setwear, self.number, self._icp, [archard, hardness, shear_yield])

    def set_material(self, g: float, nu: float, g2: float | None = None, nu2: float | None = None,
                     model: int = 0, parameters: Sequence[float] = ()) -> None:
        """Elastic bodies.

        Parameters
        ----------
        g, nu
            Modulus of rigidity [F/L2] and Poisson ratio [-] of body 1: the upper body, the rail.
        g2, nu2
            The same of body 2; default: equal to body 1.
        model, parameters
            M digit and its parameters besides the elastic constants.
        """
        if hasattr(g, "__len__") or hasattr(nu, "__len__"):
            raise TypeError("g and nu are numbers, those of body 1; body 2 has g2 and nu2")
        values = [nu, nu if nu2 is None else nu2, g, g if g2 is None else g2, *parameters]
        self._do(cntc.setmaterialparameters, self.number, self._icp, model, values)

    def set_friction(self, coefficient: float) -> None:
        """Coulomb friction with one coefficient [-]."""
        self.set_friction_law(0, [coefficient, coefficient])

    def set_friction_law(self, law: int, parameters: Sequence[float]) -> None:
        """Friction law 10 V + L with its parameters, see doc/user/library.md."""
        self._do(cntc.setfrictionmethod, self.number, self._icp, law, parameters)

    def set_temperatures(self, bulk: float, bulk2: float | None = None, *, capacity: float = 450.0,
                         conductivity: float | None = None, density: float | None = None, capacity2: float | None = None,
                         conductivity2: float | None = None, density2: float | None = None, plastic_share: float = 1.0,
                         source: str = "moving") -> None:
        """Surface temperatures in steady rolling at the current velocity; thermal constants default to those of steel.

        Parameters
        ----------
        bulk, bulk2
            Bulk temperatures of bodies 1 and 2 [degrees C]; one value holds for both.
        capacity, conductivity, density
            Heat capacity [J/(kg K)], conductivity [W/(L K)] and density [kg/L3] of body 1, and with a 2 those of
            body 2, default the same.
        plastic_share
            Fraction of plastic work that becomes heat [-].
        source
            ``"moving"``: the solution for fast moving sources. ``"established"``: that of the established program, which
            counts the heat of an element twice at its centre and gives higher temperatures, by 11 % on 60 elements.
        """
        if source not in _SOURCES:
            raise ValueError(f"source = {source!r} is none of {', '.join(_SOURCES)}")
        metre = 1.0 if self.units == "mm" else 1e3
        first = [capacity, 0.05 * metre if conductivity is None else conductivity,
                 7.85e-6 * metre**3 if density is None else density]
        second = [mine if other is None else other for mine, other in zip(first, (capacity2, conductivity2, density2))]
        self.set_flags(own_heat=_SOURCES[source])
        self._do(cntc.settemperaturedata, self.number, self._icp, 3,
                 [bulk, *first, bulk if bulk2 is None else bulk2, *second, plastic_share])

    def set_solver(self, eps: float = 1e-5, maxgs: int = 999, maxin: int = 100, maxnr: int = 30,
                   maxout: int = 10, order: int = 2, accuracy: float = 0.0, allow: str = "nothing") -> None:
        """Tolerance [-] and limits of the iterations of the default solver (G = 0), and order of the discretisation.

        Parameters
        ----------
        eps, maxgs, maxin, maxnr
            Relative tolerance of the equations [-], and limits of iterations.
        maxout
            Limit of the iterations between pressures and tractions of dissimilar bodies, which like bodies do not need; 1: one pass
            (Johnson's method), until the next :meth:`set_material`.
        order
            Order of the discretisation of rolling: 2, with errors proportional to the square of the element size, for the cases
            that it supports (doc/theory/second_order.md), or 1, the established one of ``.inp`` files and ``cntc``.
        accuracy
            Required accuracy instead of a grid: largest relative error of the forces [-], 1e-6 to 0.1. The grid then defines
            its window only; element size, eps and order are chosen (doc/user/running.md). 0: none.
        allow
            ``"approximate"``: simplified methods may replace the full theory if their error is known and below the required
            accuracy. ``"nothing"``: full theory only.
        """
        if allow not in ("nothing", "approximate"):
            raise ValueError(f"allow = {allow!r} is none of nothing, approximate")
        if order not in (1, 2):
            raise ValueError(f"order = {order!r} is none of 1, 2")
        if accuracy != 0.0 and not 1e-6 <= accuracy <= 0.1:
            raise ValueError(f"accuracy = {accuracy!r} is neither 0 nor between 1e-6 and 0.1")
        self.set_flags(own_order=order, own_accuracy=round(1.0 / accuracy) if accuracy else 0,
                       own_approximate=int(allow == "approximate"))
        self._do(cntc.setsolverflags, self.number, self._icp, 0, [maxgs, maxin, maxnr, maxout], [eps])

    def add_block(self, x: ArrayLike | None, y: ArrayLike | None, z: ArrayLike, block: int = 1) -> None:
        """Points below the surface: all combinations of x, y and depths z [L].

        Blocks are numbered by ``block``, from 1; a block replaces that of the same number.

        Tractions are constant on each element. At depths of less than a quarter of dx the stresses are therefore meaningful
        at the centres of elements only: use None for both x and y, which means all centres, or the ``x`` and ``y`` of a
        result. Elsewhere use depths of dx/4 and more; points closer to the surface give a warning.
        """
        if (x is None) != (y is None):
            raise ValueError("x and y have to be given both, or be None both for the centres of all elements")
        self._do(cntc.subs_addblock, self.number, self._icp, block, 5 if x is None else 9, x, y, z)
        self._has_points = True
        self._stresses_known = False

    def _calculate_stresses(self, callers: int = 1) -> None:
        """Stresses of the last solution, computed once; callers is the number of stack levels up to the line of a warning"""
        if self._stresses_known:
            return
        code = cntc.subs_calculate(self.number, self._icp, idebug=0)
        fail_if(code != 0, code, "The stresses were not computed", self.number, self._icp)
        points = int(cntc.getflags(self.number, self._icp, [CNTC["own_stepped"]])[0])
        if points:
            warnings.warn(f"{points} points lie less than dx/4 below the surface and off the centres of elements; stresses "
                          "there are those of tractions that are constant on elements", ContactWarning, stacklevel=2 + callers)
        self._stresses_known = True

    def _calculate(self, initiation: bool) -> int:
        """Solve; returns the number of elements in contact at the border"""
        self._stresses_known = False
        self.set_flags(ic_pvtime=2 if initiation else 0)
        code: Any = cntc.calculate(self.number, self._icp, idebug=0)
        self._status, self._reason = case_status(self.number, self._icp)
        self._code = int(code)
        has_result = code in _WITH_RESULT and self._status == "not converged"
        if (code < 0 and not has_result) or code == 305:
            reason = last_error(self.number, self._icp)[1] or cntc.meaning(code)
            raise ContactError(f"The problem was not solved: {reason}", code, self._status)
        if code < 0:
            # a missed tolerance or force: read the reason now, so that it is not attributed to a later call
            last_error(self.number, self._icp)
        if self._status == "checked":
            return 0
        if self._status != "solved":
            warnings.warn(f"The problem is {self._status}: {self._reason}", NotConvergedWarning, stacklevel=3)
        required, reached = cntc.getflags(self.number, self._icp, [CNTC["own_accuracy"], CNTC["own_reached"]])
        if required and not reached:
            warnings.warn("The required accuracy was not reached; see the estimated errors of the result", ContactWarning,
                          stacklevel=3)
        if self._has_points and cntc.getflags(self.number, self._icp, [CNTC["own_wear"]])[0]:
            # the totals of wear include the largest stresses
            self._calculate_stresses(callers=2)
        return max(0, self._code)
