"""The routines of the library one by one, with numpy arrays instead of addresses and lengths.

The functions have the names of the library without ``cntc_``; those for stresses below the surface keep
``subs_``. Names with ``cntc_`` work as well: ``cntc.cntc_setflags`` is ``cntc.setflags``.

In the descriptions ``ire`` is a result element (1 to 999) and ``icp`` a contact problem: -1 for wheel/rail
contact as a whole, 1 to 9 for a patch or a problem of basic contact. None or ``[]`` means the default: 1 for
``ire``; for ``icp`` -1 where a whole wheel/rail problem is meant, else 1. Units: L length, F force, V velocity,
A angle [rad], T time [s], see the flag ``if_units``. Fields have shape (my, mx): one row per y, lowest y first.
"""
from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._library import call, library, text, unmasked
from ._signatures import MAGIC_NUMBERS

Number = Union[int, Sequence[int], None]
Text = Union[str, "os.PathLike[str]", None]
Field = NDArray[np.floating[Any]]

#: The named numbers without CNTC_; ``CNTC["if_units"]`` is 1933
CNTC: dict[str, int] = dict(MAGIC_NUMBERS)

_MEANINGS = {
    -12: "not allowed: too many result elements or calculations at the same time",
    -25: "the contact search failed",
    -26: "the balance of total forces failed",
    -27: "the normal problem did not converge",
    -28: "the tangential problem did not converge",
    -29: "the iteration stopped above its tolerance",
    -31: "this contact patch does not exist",
    -32: "a profile is missing or unusable",
    -33: "the friction data are unusable",
    -34: "the grid does not fit the previous case, or is too large",
    -39: "the input file is unusable",
    -99: "see the .out file",
    -101: "the number of the result element is not 1 to 999",
    -102: "this routine is for basic contact",
    -103: "this routine is for wheel/rail contact",
    -104: "the number of the contact problem is out of range",
    -105: "the number of a contact patch is needed",
    -106: "this routine works on the whole result element",
    305: "another thread is computing this problem",
}


def meaning(code: int) -> str:
    """Meaning of an error code, in words."""
    return _MEANINGS.get(code, f"code {code}")


def _number(value: Number, default: int) -> int:
    """A number, or the default for None and an empty list"""
    if value is None or np.size(value) == 0:
        return default
    return int(np.asarray(value).reshape(-1)[0])


def _element(ire: Number) -> int:
    return _number(ire, 1)


def _problem(icp: Number, default: int = -1) -> int:
    return _number(icp, default)


def _patch(icp: Number) -> int:
    """Number of a patch or problem, default 1; refused when not positive"""
    patch = _number(icp, 1)
    if patch <= 0:
        raise ValueError(f"icp = {patch}: this routine needs a contact problem, 1 to 9")
    return patch


def _reals(values: ArrayLike | None) -> Field:
    return np.zeros(0) if values is None else np.ascontiguousarray(unmasked(values), dtype=np.float64).reshape(-1)


def _ints(values: ArrayLike | None) -> NDArray[np.intc]:
    if values is None:
        return np.zeros(0, np.intc)
    given = np.asarray(unmasked(values))
    if given.size and (given.dtype.kind not in "iubf" or (given.dtype.kind == "f" and (given != np.rint(given)).any())):
        raise ValueError(f"{values!r}: integers are needed")
    return np.ascontiguousarray(given, dtype=np.intc).reshape(-1)


def _tell(routine: str, code: int, idebug: int) -> None:
    """Print the meaning of an error code if messages are enabled"""
    if (code < 0 and idebug >= 1) or (code > 0 and idebug >= 2):
        what = f"{code} elements at the border of the grid" if 0 < code < 300 else meaning(code)
        print(f"{routine}: {what} (code {code})", file=sys.stdout)


# ---- begin and end ----------------------------------------------------------------------------


def initlibrary(wrkdir: Text = " ", outdir: Text = " ", expnam: Text = " ", idebug: int = 1) -> list[Any]:
    """Start a run: folders of input and results, name of the .out file. Returns [CNTC, ifcver, ierror]."""
    texts = [text(value) for value in (wrkdir, outdir, expnam)]
    ifcver, ierror = call("cntc_initializefirst", 0, *(name for name, _ in texts), *(size for _, size in texts))
    _tell("initlibrary", ierror, idebug)
    return [dict(CNTC), ifcver, ierror]


def getmagicnumbers() -> dict[str, int]:
    """The named numbers without CNTC_."""
    return dict(CNTC)


def initialize(ire: Number, imodul: int, outdir: Text = " ", idebug: int = 1) -> list[int]:
    """Create a result element for module 1 (wheel/rail) or 3 (basic contact). Returns [ifcver, ierror]."""
    ifcver, ierror = call("cntc_initialize", _element(ire), imodul, *text(outdir))
    _tell("initialize", ierror, idebug)
    return [ifcver, ierror]


def setfileunits(iunits: ArrayLike) -> None:
    """Fortran units that the library may use; before the first initialisation."""
    numbers = _ints(iunits)
    call("cntc_setfileunits", numbers.size, numbers)


def getmaxnumthreads() -> int:
    """Largest number of calculations at the same time."""
    value: int = call("cntc_getmaxnumthreads")
    return value


def finalize(ire: Number = 1) -> None:
    """Free a result element; after the last one the run ends and files are closed."""
    for stored in (_elastic, _grids):
        for key in [key for key in stored if key[0] == _element(ire)]:
            del stored[key]
    call("cntc_finalize", _element(ire))


def finalizelast() -> None:
    """Free all result elements and end the run."""
    _elastic.clear()
    _grids.clear()
    call("cntc_finalizelast")


def closelibrary() -> None:
    """End the run. The library stays loaded."""
    finalizelast()


# ---- flags ------------------------------------------------------------------------------------


def _flag_lists(params: ArrayLike, values: ArrayLike, dtype: Any) -> tuple[NDArray[np.intc], NDArray[Any]]:
    codes = _ints(params)
    numbers = _ints(values) if dtype is np.intc else _reals(values)
    if codes.size != numbers.size:
        raise ValueError(f"{codes.size} codes, but {numbers.size} values")
    return codes, numbers


def setglobalflags(params: ArrayLike, values: ArrayLike) -> None:
    """Flags of the library as a whole, ``if_idebug`` and ``if_openmp``; numbers or lists of equal length."""
    codes, numbers = _flag_lists(params, values, np.intc)
    call("cntc_setglobalflags", codes.size, codes, numbers)


def setflags(ire: Number, icp: Number, params: ArrayLike, values: ArrayLike) -> None:
    """Flags and control digits of a problem; numbers or lists of equal length."""
    codes, numbers = _flag_lists(params, values, np.intc)
    call("cntc_setflags", _element(ire), _problem(icp), codes.size, codes, numbers)


def getflags(ire: Number, icp: Number, params: ArrayLike) -> NDArray[np.intc]:
    """Current control digits, in the order of params; 0 for codes that cannot be read."""
    codes = _ints(params)
    values = np.zeros(codes.size, np.intc)
    call("cntc_getflags", _element(ire), _problem(icp), codes.size, codes, values)
    return values


def setmetadata(ire: Number, icp: Number, params: ArrayLike, values: ArrayLike) -> None:
    """Numbers that are written to the .mat files, codes ``mt_...``."""
    codes, numbers = _flag_lists(params, values, np.float64)
    call("cntc_setmetadata", _element(ire), _problem(icp, 1), codes.size, codes, numbers)


# ---- settings of both modules -----------------------------------------------------------------


def setsolverflags(ire: Number, icp: Number, imeth: int, iparam: ArrayLike | None = None,
                   rparam: ArrayLike | None = None) -> None:
    """Solution method by the G digit: 0 (maxgs, maxin, maxnr, maxout; eps), 1 keep, 2 to 5 classical, 6
    sensitivities (mxsens; epsens)."""
    ints, reals = (_ints(iparam), _reals(rparam)) if imeth != 1 else (_ints(None), _reals(None))
    call("cntc_setsolverflags", _element(ire), _problem(icp), imeth, ints.size, ints, reals.size, reals)


# Elastic constants that were set last, for setinterfaciallayer
_elastic: dict[tuple[int, int], list[float]] = {}
#: Numbers of elements (my, mx) of the grids that were set, by element and problem
_grids: dict[tuple[int, int], tuple[float, float]] = {}


def setmaterialparameters(ire: Number, icp: Number, m_digit: Number, rparam: ArrayLike) -> None:
    """Material by the M digit (default 0): nu1, nu2 [-], G1, G2 [F/L2] and the parameters of the digit; 10, 11,
    12 for damping."""
    reals = _reals(rparam)
    if _number(m_digit, 0) < 10 and reals.size >= 4:
        _elastic[_element(ire), _problem(icp)] = reals[:4].tolist()
    call("cntc_setmaterialparameters", _element(ire), _problem(icp), _number(m_digit, 0), reals.size, reals)


def setmaterialproperties(ire: Number, icp: Number, g1: float, nu1: float, g2: float, nu2: float) -> None:
    """Elastic bodies: moduli of rigidity [F/L2] and Poisson ratios [-]."""
    setmaterialparameters(ire, icp, 0, [nu1, nu2, g1, g2])


def setinterfaciallayer(ire: Number, icp: Number, imeth: int, params: ArrayLike | None = None,
                        more: ArrayLike | None = None) -> None:
    """Interfacial layer; an older form of setmaterialparameters. The elastic constants are those set before.

    Parameters
    ----------
    imeth
        0 none, 2 and 3 Fastsim with one flexibility and with three, 4 a layer that may yield.
    params
        For 2 flx [L3/F], k0_mf, alfamf, betamf [-]; for 3 the last three of these; for 4 G3 [F/L2], laythk [L], tau_c0
        [F/L2], k_tau [F/L3].
    more
        The values, if the second argument is their number.

    Raises
    ------
    ValueError
        If the number of values is wrong, or the elastic constants were not set.
    """
    reals = _reals(params if more is None else more)
    count = {0: 0, 2: 4, 3: 3, 4: 4}.get(imeth)
    if count is None or reals.size != count:
        raise ValueError(f"an interfacial layer {imeth} with {reals.size} values; accepted: 0 with none, 2 with 4, 3 with 3, "
                         "4 with 4")
    elastic = _elastic.get((_element(ire), _problem(icp)))
    if elastic is None:
        raise ValueError("an interfacial layer needs the elastic constants first, by setmaterialproperties or "
                         "setmaterialparameters")
    setmaterialparameters(ire, icp, imeth, [*elastic, *reals])


def settemperaturedata(ire: Number, icp: Number, imeth: int, params: ArrayLike | None = None) -> None:
    """Temperatures by the H digit: 0 off, 1 keep, 3 new. params for 3: temperature [degrees C], heat capacity
    [J/(kg K)], conductivity [W/(L K)], density [kg/L3] of body 1 and of body 2, fraction of plastic work [-]."""
    reals = _reals(params) if imeth > 1 else _reals(None)
    call("cntc_settemperaturedata", _element(ire), _problem(icp), imeth, reals.size, reals)


def setwear(ire: Number, icp: Number, params: ArrayLike) -> None:
    """Parameters of wear and fatigue, which are computed from then on: Archard's wear coefficient [-], hardness of the softer body,
    yield stress in cyclic shear [F/L2]; 0 for values that are not given."""
    reals = _reals(params)
    call("cntc_setwear", _element(ire), _problem(icp), reals.size, reals)


def settimestep(ire: Number, icp: Number, dt: float) -> None:
    """Accepted for compatibility, without effect: shifts have 1 s, rolling the step over the velocity."""
    call("cntc_settimestep", _element(ire), _problem(icp, 1), dt)


def setrollingstepsize(ire: Number, icp: Number, chi: float | Sequence[float] | None, dq: float) -> None:
    """Rolling direction chi [A] and step dq: [L] in basic contact, ratio to dx in wheel/rail contact, where
    chi is not used."""
    direction = 0.0 if chi is None or np.size(chi) == 0 else float(np.asarray(chi).reshape(-1)[0])
    call("cntc_setrollingstepsize", _element(ire), _problem(icp), direction, dq)


def setfrictionmethod(ire: Number, icp: Number, imeth: int, params: ArrayLike | None = None) -> None:
    """Friction law 10 V + L with its parameters: L = 0 fstat, fkin; 2, 3, 4 falling with slip; 5 Polach; 6
    falling with temperature."""
    reals = _reals(params)
    call("cntc_setfrictionmethod", _element(ire), _problem(icp), imeth, reals.size, reals)


def _note_grid(ire: Number, icp: Number, params: Field) -> None:
    """Remember the numbers of elements of a grid, for the shape of arrays"""
    if params.size > 1:
        _grids[_element(ire), _number(icp, 1)] = float(params[1]), float(params[0])


def _check_shape(ire: Number, icp: Number, values: ArrayLike, name: str) -> None:
    """Refuse an array with two dimensions that are not those of the grid, such as a transposed one"""
    shape = np.shape(values)
    grid = _grids.get((_element(ire), _number(icp, 1)))
    if len(shape) == 2 and grid is not None and 1 not in shape and shape != grid:
        raise ValueError(f"{name} has shape {shape}; (my, mx) = ({grid[0]:g}, {grid[1]:g}) is needed, or one row along x first")


def setpotcontact(ire: Number, icp: Number, ipotcn: int, params: ArrayLike) -> None:
    """Grid. Basic contact: 1 mx, my, xl, yl, dx, dy; 2 corners; 3, 4 centres of first (and last) elements.
    Wheel/rail: 0 or -1 dx, ds [L], a_sep [A], d_sep, d_comb [L]."""
    reals = _reals(params)
    _note_grid(ire, icp, reals)
    call("cntc_setpotcontact", _element(ire), _problem(icp), ipotcn, reals.size, reals)


def settangentialforces(ire: Number, icp: Number, fx: float, fy: float) -> None:
    """Tangential forces relative to fstat Fn [-], or the longitudinal force on the rail [F]."""
    call("cntc_settangentialforces", _element(ire), _problem(icp, 1), fx, fy)


def readinpfile(ire: Number, inp_type: int, fname: Text) -> int:
    """Settings of wheel/rail contact from the first case of an input file; returns ierror."""
    value: int = call("cntc_readinpfile", _element(ire), inp_type, *text(fname))
    return value


# ---- settings of basic contact ----------------------------------------------------------------


def setreferencevelocity(ire: Number, icp: Number, veloc: float) -> None:
    """Rolling velocity [V]."""
    call("cntc_setreferencevelocity", _element(ire), _patch(icp), veloc)


def sethertzcontact(ire: Number, icp: Number, ipotcn: int, params: ArrayLike) -> None:
    """Hertzian geometry: mx, my, then -1 a1, b1 [1/L]; -2 a1 [1/L], aob [-]; -3 aa, bb [L]; -4 a1, bb and -5
    aa, bb for approximately elliptic; -6 aa, bneg, bpos [L]; the last value is the scale of the grid."""
    reals = _reals(params)
    _note_grid(ire, icp, reals)
    call("cntc_sethertzcontact", _element(ire), _patch(icp), ipotcn, reals.size, reals)


def setpenetration(ire: Number, icp: Number, pen: float) -> None:
    """Approach [L]; sets N = 0."""
    call("cntc_setpenetration", _element(ire), _patch(icp), pen)


def setnormalforce(ire: Number, icp: Number, fn: float) -> None:
    """Normal force [F]; sets N = 1."""
    call("cntc_setnormalforce", _element(ire), _patch(icp), fn)


def setundeformeddistc(ire: Number, icp: Number, ibase: int, prmudf: ArrayLike) -> None:
    """Undeformed distance: 1 six coefficients, 2 profile, 3 sines, 9 one value [L] per element as (my, mx)
    or in one row. After setpotcontact."""
    if ibase == 9:
        _check_shape(ire, icp, prmudf, "prmudf")
    reals = _reals(prmudf)
    call("cntc_setundeformeddistc", _element(ire), _patch(icp), ibase, reals.size, reals)


def setcreepages(ire: Number, icp: Number, vx: float, vy: float, phi: float) -> None:
    """Creepages [-], [-], [A/L]; when T = 1, set before, shifts [L], [L], [A]."""
    call("cntc_setcreepages", _element(ire), _patch(icp), vx, vy, phi)


def setextrarigidslip(ire: Number, icp: Number, wx: ArrayLike, wy: ArrayLike) -> None:
    """Extra term of the rigid slip, (my, mx)."""
    _check_shape(ire, icp, wx, "wx")
    _check_shape(ire, icp, wy, "wy")
    first, second = _reals(wx), _reals(wy)
    if first.size != second.size:
        raise ValueError(f"wx has {first.size} values, wy {second.size}")
    call("cntc_setextrarigidslip", _element(ire), _patch(icp), first.size, first, second)


# ---- settings of wheel/rail contact -----------------------------------------------------------


def setverticalforce(ire: Number, fz: float) -> None:
    """Vertical force on the contact [F]; sets N = 1."""
    call("cntc_setverticalforce", _element(ire), fz)


def setprofileinputfname(ire: Number, fname: Text, iparam: ArrayLike | None = None,
                         rparam: ArrayLike | None = None) -> None:
    """Profile from a file. iparam: kind (0 rail, 1 wheel, -1 by extension), unused, mirror y, mirror z,
    errors, smoothing; rparam: factor to mm (-1 by the units), smoothing parameter, ..."""
    ints = _ints([-1] if iparam is None or np.size(iparam) == 0 else iparam)
    reals = _reals([-1, 0] if rparam is None or np.size(rparam) == 0 else rparam)
    call("cntc_setprofileinputfname", _element(ire), *text(fname), ints.size, ints, reals.size, reals)


def setprofileinputvalues(ire: Number, values: ArrayLike, iparam: ArrayLike | None = None,
                          rparam: ArrayLike | None = None) -> None:
    """Profile from a table of y and z, of shape (n, 2), (2, n) or in one row y1, z1, y2, ...; iparam (default
    [0], a rail) and rparam (default [-1, 0]) as for a file."""
    table = np.asarray(unmasked(values), dtype=np.float64)
    if table.ndim == 2 and table.shape[1] != 2 and table.shape[0] == 2:
        table = table.T
    elif table.ndim not in (1, 2) or (table.ndim == 2 and table.shape[1] != 2) or (table.ndim == 1 and table.size % 2):
        raise ValueError(f"a profile has y and z for each point, this is an array of shape {table.shape}")
    ints = _ints([0] if iparam is None or np.size(iparam) == 0 else iparam)
    reals = _reals([-1, 0] if rparam is None or np.size(rparam) == 0 else rparam)
    call("cntc_setprofileinputvalues", _element(ire), table.size // 2, table, ints.size, ints, reals.size, reals)


def settrackdimensions(ire: Number, ztrack: int, params: ArrayLike | None = None) -> None:
    """Track: 0 keep; 1 gaught, gaugsq, gaugwd (or raily0, railz0), cant, nomrad, [curv]; 2 deviations of the
    rail; 3 both; 32, 33 springs."""
    reals = _reals(params if ztrack != 0 else None)
    call("cntc_settrackdimensions", _element(ire), ztrack, reals.size, reals)


def settrackdimensions_new(ire: Number, ztrack: int, params: ArrayLike | None = None) -> None:
    """An older name of settrackdimensions."""
    settrackdimensions(ire, ztrack, params)


def settrackdimensions_old(ire: Number, ztrack: int, params: ArrayLike) -> None:
    """Track, with an older order of values.

    Parameters
    ----------
    ztrack
        1 dimensions, 2 deviations of the rail, 3 both.
    params
        For 1 gaugwd, gaught [L], cant [angle], nomrad [L]; for 2 dyrail, dzrail [L], drollr [angle], vyrail, vzrail [L/T],
        vrollr [angle/T]; for 3 both lists.

    Raises
    ------
    ValueError
        If ztrack or the number of values is not allowed.
    """
    reals = _reals(params)
    if {1: 4, 2: 6, 3: 10}.get(ztrack) != reals.size:
        raise ValueError(f"settrackdimensions_old with ztrack = {ztrack} and {reals.size} values; accepted: 1 with 4, 2 with 6, "
                         "3 with 10")
    if ztrack != 2:
        width, height, cant, radius = reals[:4]
        # measured at a height, no second point; this routine has no curvature of the track
        reals = np.concatenate(([height, 0.0, width, cant, radius], reals[4:]))
    settrackdimensions(ire, ztrack, reals)


def setwheelsetdimensions(ire: Number, ewheel: int, params: ArrayLike | None = None) -> None:
    """fbdist, fbpos, nomrad, [ytape] [L], for ewheel 3 and 5; the others keep them."""
    reals = _reals(params if ewheel in (3, 5) else None)
    call("cntc_setwheelsetdimensions", _element(ire), ewheel, reals.size, reals)


def setwheelsetposition(ire: Number, ewheel: Number, params: ArrayLike) -> None:
    """s, y, z [L], roll, yaw, pitch [A]; ewheel defaults to 1."""
    reals = _reals(params)
    call("cntc_setwheelsetposition", _element(ire), _number(ewheel, 1), reals.size, reals)


def setwheelsetvelocity(ire: Number, ewheel: Number, params: ArrayLike) -> None:
    """vs, vy, vz [V], rates of roll, yaw, pitch [A/T]; ewheel defaults to 2."""
    reals = _reals(params)
    call("cntc_setwheelsetvelocity", _element(ire), _number(ewheel, 2), reals.size, reals)


def setwheelsetflexibility(ire: Number, ewheel: Number, params: ArrayLike | None = None) -> None:
    """Deviations of the wheel from the rigid wheelset, twelve values for ewheel 4 and 5; zero for other values of ewheel."""
    kind = _number(ewheel, 0)
    reals = _reals(params if kind > 3 else None)
    call("cntc_setwheelsetflexibility", _element(ire), kind, reals.size, reals)


# ---- calculation ------------------------------------------------------------------------------


def calculate(ire: Number = 1, icp: Number = -1, idebug: int = 1) -> int:
    """Solve. Returns 0, a negative code ``err_...``, or the number of contact elements on the border."""
    ierror: int = call("cntc_calculate", _element(ire), _problem(icp))
    _tell("calculate", ierror, idebug)
    return ierror


def subs_calculate(ire: Number = 1, icp: Number = -1, idebug: int = 1) -> int:
    """Stresses in all blocks, after calculate. Returns ierror."""
    ierror: int = call("subs_calculate", _element(ire), _problem(icp))
    _tell("subs_calculate", ierror, idebug)
    return ierror


# ---- results ----------------------------------------------------------------------------------

_PARAMETERS = {
    1: "veloc chi dq spinxo spinyo tau_c0",
    2: "gg1 gg2 gg poiss1 poiss2 poiss ak flx1 flx2 flx3 k0_mf alfamf betamf k_eff gg3 laythk tau_c0 k_tau "
       "cdampn cdampt dfnmax dftmax",
    3: "lmeth nvf memdst mem_s0",
    4: "nomradw nomradr",
}


def getparameters(ire: Number, icp: Number, itask: int = 1) -> dict[str, Any]:
    """Parameters by name: 1 kinematics, 2 material, 3 friction (with arrays alpha, fstat, fkin), 4 nominal radii of wheel and
    roller, 0 without them [L]."""
    if itask not in _PARAMETERS:
        raise ValueError(f"itask = {itask} is not 1, 2, 3 or 4")
    names = _PARAMETERS[itask].split()
    values = np.zeros(len(names))
    call("cntc_getparameters", _element(ire), _patch(icp), itask, values.size, values)
    parameters: dict[str, Any] = dict(zip(names, values.tolist()))
    if itask == 3:
        rows = int(values[1])
        values = np.zeros(4 + 3 * rows)
        call("cntc_getparameters", _element(ire), _patch(icp), itask, values.size, values)
        parameters["lmeth"], parameters["nvf"] = int(values[0]), rows
        parameters["alpha"], parameters["fstat"], parameters["fkin"] = values[4:].reshape(rows, 3).T
    return parameters


def _profile_values(ire: Number, itask: int, ints: NDArray[np.intc], reals: Field, size: int,
                    content: float = 0.0) -> Field:
    values = np.full(size, content)
    call("cntc_getprofilevalues", _element(ire), itask, ints.size, ints, reals.size, reals, size, values)
    return values


def getprofilevalues(ire: Number, itask: int, iparam: ArrayLike | None = None,
                     rparam: ArrayLike | None = None) -> Any:
    """Points of a profile as used by the library.

    Parameters
    ----------
    itask
        -1 state (two numbers), 0 number of points, 1 y, z of the profile (n, 2) [mm], 2 y, z in the track
        system (n, 2) [mm], 3 gauge point (6,) [L], 4 arc length (n,) [mm], 5 angle (n,) [A], 6, 8 x, y, z
        along lines on a surface (n, 3) [mm].
    iparam
        Kind (0 rail, 1 wheel) and sampling (-1 as given, 0 spline, 1 uniform, n parts per interval).
    rparam
        Step of the uniform sampling [mm], constant coordinate, first and last position.

    Returns
    -------
    As listed above; the negative code if the profile is missing.
    """
    ints = _ints([0, 0] if iparam is None or np.size(iparam) == 0 else iparam)
    reals = _reals([1.0] if rparam is None or np.size(rparam) == 0 else rparam)
    missing = float(CNTC["err_profil"])
    if itask == -1:
        state = _profile_values(ire, itask, ints, reals, 2)
        return [int(state[0]), int(state[1])]
    if itask == 9:
        _profile_values(ire, itask, ints, reals, 1)
        return None
    if itask == 3:
        values = _profile_values(ire, itask, ints, reals, 6, missing)
        return int(missing) if np.all(values[[0, -1]] == missing) or values[0] == missing else values
    count = int(_profile_values(ire, itask if itask in (6, 7, 8) else 0, ints, reals, 1, missing)[0])
    if itask == 0 or count < 0:
        return count
    columns = {1: 2, 2: 2, 4: 1, 5: 1, 6: 3, 7: 3, 8: 3}.get(itask)
    if columns is None:
        raise ValueError(f"itask = {itask} is not -1 to 9")
    if count == 0:
        return np.zeros((0, columns)) if columns > 1 else np.zeros(0)
    values = _profile_values(ire, itask, ints, reals, columns * count)
    if columns == 1:
        return values
    table = np.ascontiguousarray(values.reshape(columns, count).T)
    if columns == 3:
        # Points outside of the surface are marked by huge numbers
        table[(table[:, 0] > 98e9) | (table[:, 1] > 998.0) | (table[:, 2] > 998.0)] = np.nan
    return table


def _list_of(routine: str, size: int, *numbers: int) -> Field:
    values = np.zeros(size)
    call(routine, *numbers, size, values)
    return values


def getwheelsetposition(ire: Number = 1) -> Field:
    """s, y, z [L], roll, yaw, pitch [A]; z is computed if the vertical force is prescribed. Shape (6,)."""
    return _list_of("cntc_getwheelsetposition", 6, _element(ire))


def getwheelsetvelocity(ire: Number = 1) -> Field:
    """vs, vy, vz [V], rates of roll, yaw, pitch [A/T]. Shape (6,)."""
    return _list_of("cntc_getwheelsetvelocity", 6, _element(ire))


def getnumcontactpatches(ire: Number = 1) -> int:
    """Number of contact patches."""
    value: int = call("cntc_getnumcontactpatches", _element(ire))
    return value


def getcontactlocation(ire: Number = 1, icp: Number = 1) -> Field:
    """Contact reference point and markers in all systems. Shape (38,), see doc/user/library.md."""
    return _list_of("cntc_getcontactlocation", 38, _element(ire), _patch(icp))


def getglobalforces(ire: Number = 1, icp: Number = -1) -> Field:
    """Forces and moments: about the rail marker in track directions, about the wheel marker in wheelset
    directions, the same in the directions of the rail and of the wheel. Shape (24,)."""
    return _list_of("cntc_getglobalforces", 24, _element(ire), _problem(icp))


def getreferencevelocity(ire: Number = 1, icp: Number = 1) -> float:
    """Rolling velocity [V]."""
    value: float = call("cntc_getreferencevelocity", _element(ire), _patch(icp))
    return value


def gethertzcontact(ire: Number = 1, icp: Number = 1) -> Field:
    """a1, b1 [1/L], aa, bb, rho, cp [L], scale [-], bneg, bpos [L], aob [-]. Shape (10,)."""
    return _list_of("cntc_gethertzcontact", 10, _element(ire), _patch(icp))


def getnumelements(ire: Number = 1, icp: Number = 1) -> tuple[int, int]:
    """mx, my of the grid."""
    values: tuple[int, int] = call("cntc_getnumelements", _element(ire), _patch(icp))
    return values


def getgriddiscretization(ire: Number = 1, icp: Number = 1) -> tuple[float, float]:
    """Sides dx, dy of an element [L]; with icp = -1 those prescribed in wheel/rail contact."""
    values: tuple[float, float] = call("cntc_getgriddiscretization", _element(ire), _problem(icp, 1))
    return values


def getpotcontact(ire: Number = 1, icp: Number = 1) -> tuple[int, int, float, float, float, float]:
    """mx, my, centre xc1, yc1 of the first element [L], dx, dy [L]."""
    values = _list_of("cntc_getpotcontact", 6, _element(ire), _patch(icp)).tolist()
    return int(values[0]), int(values[1]), values[2], values[3], values[4], values[5]


def getpenetration(ire: Number = 1, icp: Number = 1) -> float:
    """Approach [L]."""
    value: float = call("cntc_getpenetration", _element(ire), _patch(icp))
    return value


def getcreepages(ire: Number = 1, icp: Number = 1) -> tuple[float, float, float]:
    """Creepages [-], [-], [A/L], or shifts."""
    values: tuple[float, float, float] = call("cntc_getcreepages", _element(ire), _patch(icp))
    return values


def getcontactforces(ire: Number = 1, icp: Number = 1) -> tuple[float, float, float, float]:
    """Normal force, tangential forces [F], spin moment [F L] in the directions of the contact."""
    values: tuple[float, float, float, float] = call("cntc_getcontactforces", _element(ire), _patch(icp))
    return values


def getcontactpatchareas(ire: Number = 1, icp: Number = 1) -> tuple[float, float, float, float]:
    """Areas of contact, adhesion, slip and plasticity [L2]."""
    contact, adhesion, slip = call("cntc_getcontactpatchareas", _element(ire), _patch(icp))
    # Areas are whole numbers of elements: a remainder is round-off
    plastic = contact - adhesion - slip
    return contact, adhesion, slip, plastic if plastic > 1e-9 * contact else 0.0


def getmaximumpressure(ire: Number = 1, icp: Number = 1) -> float:
    """Largest pressure [F/L2]."""
    value: float = call("cntc_getmaximumpressure", _element(ire), _patch(icp))
    return value


def getmaximumtraction(ire: Number = 1, icp: Number = 1) -> float:
    """Largest tangential traction [F/L2]."""
    value: float = call("cntc_getmaximumtraction", _element(ire), _patch(icp))
    return value


def getmaximumtemperature(ire: Number = 1, icp: Number = 1) -> tuple[float, float]:
    """Largest surface temperatures of body 1 and 2 [degrees C]."""
    values: tuple[float, float] = call("cntc_getmaximumtemperature", _element(ire), _patch(icp))
    return values


def geterrors(ire: Number = 1, icp: Number = 1) -> Field:
    """Estimated errors of normal force, tangential forces, spin moment, approach, largest pressure, contact area, both creepages,
    frictional power, elastic energy and the highest temperature of body 1; -1 for none. Shape (12,)."""
    return _list_of("cntc_geterrors", 12, _element(ire), _patch(icp))


def getwear(ire: Number = 1, icp: Number = 1) -> Field:
    """T-gamma, wear index, largest density of frictional power, largest depth and area of the section of a passage, tangential
    over normal force, largest pressure over yield stress and over its shakedown limit, surface fatigue index, largest von Mises
    and Tresca stress; 0 for quantities that do not apply. Shape (11,)."""
    return _list_of("cntc_getwear", 11, _element(ire), _patch(icp))


def _fields(routine: str, count: int, ire: Number, icp: Number, *more: int, dtype: Any = np.float64) -> list[Any]:
    """The fields that the routine returns, each of shape (my, mx)"""
    element, patch = _element(ire), _patch(icp)
    mx, my = getnumelements(element, patch)
    fields = [np.zeros((my, mx), dtype) for _ in range(count)]
    call(routine, element, patch, *more, mx * my, *fields)
    return fields


def getelementdivision(ire: Number = 1, icp: Number = 1) -> NDArray[np.intc]:
    """0 exterior, 1 adhesion, 2 slip, 3 plastic. Shape (my, mx)."""
    field: NDArray[np.intc] = _fields("cntc_getelementdivision", 1, ire, icp, dtype=np.intc)[0]
    return field


def getfielddata(ire: Number = 1, icp: Number = 1, ifld: Number = None) -> Field:
    """One field by its code ``fld_...``, default the pressure. Shape (my, mx)."""
    field: Field = _fields("cntc_getfielddata", 1, ire, icp, _number(ifld, CNTC["fld_pn"]))[0]
    return field


def gettractions(ire: Number = 1, icp: Number = 1) -> tuple[Field, Field, Field]:
    """pn, px, py [F/L2], each of shape (my, mx)."""
    return tuple(_fields("cntc_gettractions", 3, ire, icp))


def getdisplacements(ire: Number = 1, icp: Number = 1) -> tuple[Field, Field, Field]:
    """un, ux, uy [L], each of shape (my, mx)."""
    return tuple(_fields("cntc_getdisplacements", 3, ire, icp))


def getmicroslip(ire: Number = 1, icp: Number = 1) -> tuple[Field, Field]:
    """sx, sy [-], each of shape (my, mx); in shifts distances [mm]."""
    return tuple(_fields("cntc_getmicroslip", 2, ire, icp))


def getsensitivities(ire: Number = 1, icp: Number = 1, lenout: int = 4, lenin: int = 4) -> Field:
    """Derivatives of Fn [F], Fx, Fy [- by fstat Fn], Mz [F L] (rows) by approach and creepages (columns).
    Shape (lenout, lenin); needs the flag ``ic_sens``."""
    values = np.zeros((lenin, lenout))
    call("cntc_getsensitivities", _element(ire), _patch(icp), lenout, lenin, values)
    return np.ascontiguousarray(values.T)


def getcalculationtime(ire: Number = 1, icp: Number = 1) -> tuple[float, float]:
    """Processor and wall time of the calculations since the last reset [s]."""
    values: tuple[float, float] = call("cntc_getcalculationtime", _element(ire), _patch(icp))
    return values


def resetcalculationtime(ire: Number = 1, icp: Number = 1) -> None:
    """Set the times to zero."""
    call("cntc_resetcalculationtime", _element(ire), _patch(icp))


def getcpresults(ire: Number = 1, icp: Number = 1) -> dict[str, Any]:
    """Inputs and results of a patch of wheel/rail contact, with the names of the Matlab function loadcase.

    They are in the units of CONTACT (``un_cntc``: mm, N, tractions on the rail), whatever those of the problem.
    """
    element, patch = _element(ire), _patch(icp)
    units = getflags(element, -1, CNTC["if_units"])
    setflags(element, -1, CNTC["if_units"], CNTC["un_cntc"])
    try:
        return _cpresults(element, patch)
    finally:
        setflags(element, -1, CNTC["if_units"], units)


def _cpresults(element: int, patch: int) -> dict[str, Any]:
    """The same in the current units"""
    config, t_digit, d_digit, m_digit, h_digit = (int(value) for value in getflags(
        element, -1, [CNTC[name] for name in ("ic_config", "ic_tang", "ic_discns", "ic_mater", "ic_heat")]))
    kinematics = getparameters(element, patch, 1)
    tau_c0 = kinematics["tau_c0"]
    wheelset, place = getwheelsetposition(element), getcontactlocation(element, patch)
    mx, my, xc1, yc1, dx, dy = getpotcontact(element, patch)
    solution: dict[str, Any] = {
        "config": config,
        "kincns": {"t_digit": t_digit, "veloc": kinematics["veloc"], "chi": kinematics["chi"], "dq": kinematics["dq"]},
        "d_digit": d_digit,
        "mater": {"m_digit": m_digit, "tau_c0": tau_c0},
        "h_digit": h_digit,
        "meta": {
            "spinxo": kinematics["spinxo"], "spinyo": kinematics["spinyo"],
            # on rollers the first coordinate of the wheelset is not a position along a track
            "s_ws": wheelset[0] if config < 4 else 0.0,
            **dict(zip(("x_w", "y_w", "z_w", "roll_w", "yaw_w"), place[20:25])),
            **dict(zip(("y_r", "z_r", "roll_r"), place[25:28])),
            **dict(zip(("xcp_r", "ycp_r", "zcp_r"), place[4:7])), "deltcp_r": place[8],
            **dict(zip(("xcp_w", "ycp_w", "zcp_w"), place[9:12])), "deltcp_w": place[13],
            **dict(zip(("rnom_whl", "rnom_rol"), getparameters(element, patch, 4).values())),
            "npatch": getnumcontactpatches(element), "ipatch": patch,
        },
        "mx": mx, "my": my, "xl": xc1 - dx / 2, "yl": yc1 - dy / 2, "dx": dx, "dy": dy,
        "x": xc1 + dx * np.arange(mx), "y": yc1 + dy * np.arange(my),
    }
    for name, kind in (("prr", 0), ("prw", 1)):
        points = getprofilevalues(element, 1, [kind, 0])
        if not isinstance(points, int):
            solution[name] = {"ProfileY": points[:, 0], "ProfileZ": points[:, 1],
                              "ProfileS": getprofilevalues(element, 4, [kind, 0])}
    solution["eldiv"] = getelementdivision(element, patch)
    names = ["h", "mu", "pn", "px", "py", "un", "ux", "uy", "sx", "sy"]
    plastic = m_digit == 4 and 1e-10 < tau_c0 < 1e10
    names += ["taucrt", "uplsx", "uplsy"] if plastic else []
    names += ["temp1", "temp2"] if h_digit > 0 else []
    for name in names:
        solution[name] = getfielddata(element, patch, CNTC["fld_" + name])
    solution["srel"] = np.hypot(solution.pop("sx"), solution.pop("sy"))
    solution["shft"] = solution["srel"] * (kinematics["dq"] if t_digit >= 2 else 1.0)
    bound = solution["mu"] * solution["pn"]
    solution["trcbnd"] = np.minimum(bound, solution["taucrt"]) if plastic else bound
    return solution


# ---- stresses below the surface ---------------------------------------------------------------


def subs_addblock(ire: Number, icp: Number, iblk: Number, isubs: int, xparam: ArrayLike | None,
                  yparam: ArrayLike | None, zparam: ArrayLike | None) -> None:
    """Block of points by ISUBS: 1 all elements, 2 ranges, 3 lists of elements, with depths nz, zl, dz [L]; 5,
    6, 7 the same with explicit depths; 9 explicit x, y, z [L]. iblk (default 1) and later blocks are replaced."""
    empty = isubs in (1, 5)
    x, y, z = _reals([0] if empty else xparam), _reals([0] if empty else yparam), _reals(zparam)
    call("subs_addblock", _element(ire), _problem(icp), _number(iblk, 1), isubs, x.size, y.size, z.size, x, y, z)


def subs_getblocksize(ire: Number = 1, icp: Number = 1, iblk: Number = 1) -> tuple[int, int, int]:
    """nx, ny, nz of a block; -1 each when there is none."""
    values: tuple[int, int, int] = call("subs_getblocksize", _element(ire), _patch(icp), _number(iblk, 1))
    return values


def subs_getresults(ire: Number, icp: Number, iblk: Number, icol: ArrayLike) -> Field:
    """Columns 1-3 position [L], 4-6 displacement [L], 7-9 hydrostatic, von Mises, Tresca, 10-12 principal
    stresses, 13-21 tensor [F/L2]. Shape (number of columns, number of points), x running fastest."""
    columns = _ints(icol)
    nx, ny, nz = subs_getblocksize(ire, icp, iblk)
    points = nx * ny * nz if min(nx, ny, nz) > 0 else 0
    values = np.zeros((columns.size, points))
    call("subs_getresults", _element(ire), _patch(icp), _number(iblk, 1), points, columns.size, columns, values)
    return values


def __getattr__(name: str) -> Any:
    """Names with cntc_ as in the library; cntc_dll is the library as a ctypes object"""
    if name == "cntc_dll":
        return library()
    if name.startswith("cntc_") and name[5:] in globals():
        return globals()[name[5:]]
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


__all__ = ["CNTC"] + [name for name, value in list(globals().items())
                      if getattr(value, "__module__", None) == __name__ and not name.startswith("_")]
