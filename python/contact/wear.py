"""Wear and rolling contact fatigue from results: published quantities as functions of arrays.

Arguments are numbers or arrays that can be broadcast, or xarray variables. Units are those of results: mm, N, N/mm2; creepages
are dimensionless, spin is in rad/mm.
"""
from __future__ import annotations

from typing import Any

import numpy as np

#: Coefficients of f**0 ... f**4 in the largest subsurface shear stress on planes parallel to the surface, relative to the largest
#: pressure, of a sliding line contact with traction f; fitted to the stresses of Hertzian pressures and tractions within 2e-7 up
#: to f = 0.3675
_SHEAR_BELOW = (0.25, 0.29904477, 0.07165843, -0.05709596, 0.03172995)
#: Traction above which the largest shear stress is that at the surface, the traction itself [-] (Johnson 1985, section 9.2)
_SURFACE_TRACTION = 0.36723


def t_gamma(fx: Any, fy: Any, cksi: Any, ceta: Any, mz: Any = 0.0, cphi: Any = 0.0) -> Any:
    """Dissipation per distance rolled [N = J/m].

    Parameters
    ----------
    fx, fy, mz
        Forces [N] and moment [N mm].
    cksi, ceta, cphi
        Creepages [-] and spin [rad/mm]; without mz and cphi the spin term is omitted.

    Returns
    -------
    ``abs(fx cksi) + abs(fy ceta) + abs(mz cphi)``, not negative. Source: Pearce and Sherratt, Prediction of wheel profile wear,
    Wear 144 (1991), who include the term of spin.
    """
    return abs(fx * cksi) + abs(fy * ceta) + abs(mz * cphi)


def wear_index(dissipation: Any, contact_area: Any) -> Any:
    """T-gamma over the contact area [N/mm2], which distinguishes wear regimes.

    Parameters
    ----------
    dissipation
        From :func:`t_gamma` [N].
    contact_area
        In mm2; where it is 0 the result is 0.

    Returns
    -------
    Not negative. Source: Lewis and Dwyer-Joyce, Wear mechanisms and transitions in railway wheel steels, Proc. IMechE J 218 (2004).
    """
    area = np.asarray(contact_area, dtype=float) if np.isscalar(contact_area) else contact_area
    return dissipation * (area > 0) / (area + (area <= 0))


def friction_power_density(px: Any, py: Any, sx: Any, sy: Any, veloc: Any) -> Any:
    """Frictional power per area [W/mm2], not negative.

    Parameters
    ----------
    px, py
        Tractions on body 1 [N/mm2].
    sx, sy
        Relative slip [-], whose sign is opposite to that of the tractions.
    veloc
        Velocity [mm/s].

    Returns
    -------
    Product of tractions and sliding velocity; summed over elements times their area it is minus the total ``friction_power``.
    """
    return -1e-3 * veloc * (px * sx + py * sy)


def archard_depth(pn: Any, sx: Any, sy: Any, dx: float, coefficient: float, hardness: float, axis: int = -1) -> Any:
    """Wear depth of one passage of the contact [mm].

    Parameters
    ----------
    pn
        Pressures [N/mm2], x along `axis`.
    sx, sy
        Relative slip [-].
    dx
        Side of an element along x [mm].
    coefficient
        Archard's wear coefficient for the materials and conditions [-].
    hardness
        Hardness of the softer body [N/mm2].

    Returns
    -------
    For each row: ``coefficient / hardness`` times the integral of pressure times slip along x. The sliding distance
    of a point in each element is slip times dx. Source: Archard, Contact and rubbing of flat surfaces, J. Appl. Phys. 24
    (1953); along the strips of a contact as in Jendel, Prediction of wheel profile wear, Wear 253 (2002).

    Raises
    ------
    ValueError
        If the hardness is not positive or the coefficient negative.
    """
    if not hardness > 0.0 or not coefficient >= 0.0:
        raise ValueError("the hardness has to be positive, and the coefficient not negative")
    slip = np.hypot(sx, sy)
    return coefficient / hardness * np.nansum(pn * slip, axis=axis) * dx


def braghin_rate(index: Any) -> Any:
    """Worn mass per area and distance [microgram/(m mm2)], for wheel steel R8T on rail steel UIC60 900A.

    Parameters
    ----------
    index
        Frictional energy per distance and area, T-gamma over the area, or traction times slip of an element [N/mm2].

    Returns
    -------
    5.3 times the index up to 10.4 N/mm2, mild wear; 55.12 up to 77.2, severe; beyond 55.12 + 61.9 (index - 77.2), catastrophic.
    Source: Braghin, Lewis, Dwyer-Joyce and Bruni, A mathematical model to predict railway wheel profile evolution due to wear, Wear
    261 (2006), with the branches joined as by Ignesti, Malvezzi, Marini, Meli and Rindi, Wear 284-285 (2012).
    """
    mild, severe, catastrophic, first, last = 5.3, 55.12, 61.9, 10.4, 77.2
    value = np.asarray(index, dtype=float)
    return np.where(value < first, mild * value, severe + catastrophic * np.maximum(0.0, value - last))


def braghin_depth(px: Any, py: Any, sx: Any, sy: Any, dx: float, density: float = 7800.0, axis: int = -1) -> Any:
    """Wear depth of one passage of the contact [mm], by :func:`braghin_rate` of each element.

    Parameters
    ----------
    px, py
        Tractions [N/mm2], x along `axis`.
    sx, sy
        Relative slip [-].
    dx
        Side of an element along x [mm].
    density
        Density of the material [microgram/mm3 = kg/m3].

    Returns
    -------
    For each row: the integral of the rate along x, over the density. Source: as :func:`braghin_rate`.
    """
    index = np.abs(px * sx + py * sy)
    return np.nansum(braghin_rate(index), axis=axis) * 1e-3 * dx / density


def surface_fatigue_index(fx: Any, fy: Any, fn: Any, aa: Any, bb: Any, shear_yield: float) -> Any:
    """Distance of a contact from the shakedown limit of its surface [-]; above 0 fatigue of the surface is expected.

    Parameters
    ----------
    fx, fy, fn
        Tangential and normal forces [N].
    aa, bb
        Semi-axes of the contact [mm].
    shear_yield
        Yield stress in cyclic shear [N/mm2].

    Returns
    -------
    ``f - 2 pi a b k / (3 Fn)`` with f the tangential over the normal force. Source: Ekberg, Kabo and Andersson, An engineering
    model for prediction of rolling contact fatigue of railway wheels, Fatigue Fract. Eng. Mater. Struct. 25 (2002).
    """
    return np.hypot(fx, fy) / fn - 2.0 * np.pi * aa * bb * shear_yield / (3.0 * fn)


def shakedown_limit(traction: Any) -> Any:
    """Largest pressure over yield stress in shear, p0/k [-], below which a contact reaches elastic shakedown.

    Parameters
    ----------
    traction
        Tangential over normal force of full sliding, not negative [-].

    Returns
    -------
    Reciprocal of the largest shear stress on planes parallel to the surface, relative to the largest pressure: 4 without traction,
    determined below the surface up to a traction of 0.367, at the surface beyond, ``1 / traction``; line contact, perfect
    plasticity. Source: Johnson, Contact mechanics, Cambridge 1985, section 9.2.
    """
    ratio = np.asarray(traction, dtype=float)
    below = np.polynomial.polynomial.polyval(np.minimum(ratio, _SURFACE_TRACTION), _SHEAR_BELOW)
    return 1.0 / np.where(ratio < _SURFACE_TRACTION, below, ratio)


def shakedown_state(pmax: Any, traction: Any, shear_yield: float) -> Any:
    """Position on the shakedown map: pressure over its limit [-]; above 1 plastic strain accumulates with every passage.

    Parameters
    ----------
    pmax
        Largest pressure [N/mm2].
    traction
        Tangential over normal force [-].
    shear_yield
        Yield stress in cyclic shear [N/mm2].

    Returns
    -------
    ``pmax / (shear_yield * shakedown_limit(traction))``.
    """
    return np.asarray(pmax) / (shear_yield * shakedown_limit(traction))
