"""Wear of a wheel over a distance, or of a rail by passing wheels, with an evolving profile: contacts at many positions, wear depth
per revolution or passage, new profile.

Profiles are in the coordinates of Simpack files: y to the field side, with the flange and the gauge face at negative y, z
downwards, in mm.
"""
from __future__ import annotations

import copy
import math
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import ContactError

Numbers = NDArray[np.float64]

#: Wear depth of one revolution in each row of elements [mm], from pn, px, py [N/mm2], sx, sy [-], with x along the last axis, and
#: dx [mm]; such as :func:`contact.wear.braghin_depth`
Law = Callable[[Numbers, Numbers, Numbers, Numbers, Numbers, float], Any]

#: Cases of a step of the journey, from the number of the step (0, 1, ...) and the current profile: inputs by name, and the fraction
#: of the distance that each case represents
Journey = Callable[[int, "Profile"], "tuple[Mapping[str, Any], ArrayLike]"]

#: Element fields from which wear is computed
_FIELDS = ("pn", "px", "py", "sx", "sy")


@dataclass(frozen=True)
class Profile:
    """The profile of a wheel or a rail.

    Attributes
    ----------
    y, z
        Points [mm], in their order along the surface, from the field side or from the flange or gauge face.
    is_rail
        Whether it is the profile of a rail.
    """

    y: Numbers
    z: Numbers
    is_rail: bool = False

    @staticmethod
    def read(file: str | os.PathLike[str]) -> Profile:
        """Read a file of Simpack, ``.prw`` or ``.prr``.

        Raises
        ------
        ContactError
            If it is not such a file.
        OSError
            If it cannot be read.
        """
        path = Path(file)
        if path.suffix.lower() not in (".prw", ".prr"):
            raise ContactError(f"{path}: only profiles of Simpack, .prw and .prr, can wear")
        text = path.read_text(encoding="utf-8", errors="replace")
        if "point.begin" not in text or "point.end" not in text:
            raise ContactError(f"{path} has no points between point.begin and point.end")
        rows = text.split("point.begin", 1)[1].split("point.end", 1)[0].splitlines()
        try:
            points = np.array([[float(word) for word in row.split()[:2]] for row in rows if row.strip()])
        except ValueError as reason:
            raise ContactError(f"{path}: a point is no pair of numbers: {reason}") from reason
        if points.ndim != 2 or points.shape[0] < 4 or points.shape[1] != 2:
            raise ContactError(f"{path} has fewer than 4 points")
        return Profile(points[:, 0], points[:, 1], path.suffix.lower() == ".prr")

    def write(self, file: str | os.PathLike[str], comment: str = "worn") -> None:
        """Write a file of Simpack, in mm."""
        rows = "".join(f"    {y:15.9f} {z:15.9f}\n" for y, z in zip(self.y, self.z))
        Path(file).write_text("! Coordinates in mm\nheader.begin\n  version = 1\n"
                              f"  type    = {int(not self.is_rail)}\nheader.end\nspline.begin\n"
                              f"  comment     = '{comment}'\n  units.len.f = 1000.\n  inversion   = 0\n  point.begin\n{rows}"
                              "  point.end\nspline.end\n", encoding="utf-8")

    def lengths(self) -> Numbers:
        """Arc length of each point, increasing to the field side, 0 at the first one [mm]."""
        steps = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(self.y), np.diff(self.z)))])
        return steps if self.y[-1] > self.y[0] else -steps

    def length_at(self, y: ArrayLike) -> Numbers:
        """Arc length at lateral positions on tread and flange face [mm]."""
        face = self._face()
        order = np.argsort(self.y[face])
        return np.asarray(np.interp(np.asarray(y, dtype=float), self.y[face][order], self.lengths()[face][order]))

    def height_at(self, y: ArrayLike) -> Numbers:
        """z at lateral positions on tread and flange face [mm]: radius minus that of the new wheel at the tread datum."""
        face = self._face()
        return np.asarray(np.interp(np.asarray(y, dtype=float), *_sorted(self.y[face], self.z[face])))

    def _face(self) -> NDArray[np.bool_]:
        """Points from the tip of the flange to the field side, all points of a rail: y increases there along the surface"""
        if self.is_rail:
            return np.ones(len(self.y), dtype=bool)
        tip = int(np.argmax(self.z))
        ahead = np.arange(len(self.y)) >= tip
        return ahead if self.y[-1] > self.y[0] else ~ahead | (np.arange(len(self.y)) == tip)

    def worn(self, depth: Numbers) -> Profile:
        """The profile with a depth [mm] removed at each point, normal to the surface."""
        along = np.gradient(np.column_stack([self.y, self.z]), self.lengths(), axis=0)
        along /= np.hypot(along[:, 0], along[:, 1])[:, None]
        # outwards is downwards on the tread of a wheel, upwards on a rail
        inwards = -1.0 if self.is_rail else 1.0
        return Profile(self.y + inwards * along[:, 1] * depth, self.z - inwards * along[:, 0] * depth, self.is_rail)

    def meshed(self, spacing: float) -> Profile:
        """The profile with points at equal distances along its surface, on a cubic spline through the current ones."""
        from scipy.interpolate import CubicSpline
        at = np.abs(self.lengths())
        places = np.linspace(0.0, at[-1], max(4, round(at[-1] / spacing) + 1))
        points = CubicSpline(at, np.column_stack([self.y, self.z]))(places)
        return Profile(points[:, 0], points[:, 1], self.is_rail)

    def flange(self) -> tuple[float, float, float]:
        """Height Sh, thickness Sd and slope qR of the flange [mm], the tread datum at y = 0, the back 70 mm from it (EN 15313)."""
        face = self._face()
        tread = float(self.height_at(0.0))
        tip = float(self.z.max())
        flank = face & (self.y < 0.0)
        lower, upper = (float(np.interp(z, *_sorted(self.z[flank], self.y[flank]))) for z in (tip - 2.0, tread + 10.0))
        return tip - tread, upper + 70.0, upper - lower


def _sorted(x: Numbers, y: Numbers) -> tuple[Numbers, Numbers]:
    """Both coordinates, ordered by the first one"""
    order = np.argsort(x)
    return x[order], y[order]


@dataclass(frozen=True)
class State:
    """A wheel after a distance, or a rail after passages.

    Attributes
    ----------
    distance
        Distance [km]; of a rail the number of wheels in millions.
    profile
        The worn profile.
    depth
        Wear depth since the beginning, at the points of the profile [mm].
    rate
        Current rate of wear at the points of the profile [mm/km], of a rail [mm] per million wheels; in the last state that of
        the previous step.
    area
        Worn area of the section [mm2].
    """

    distance: float
    profile: Profile
    depth: Numbers
    rate: Numbers
    area: float


def smoothed(values: Numbers, spacing: float, width: float) -> Numbers:
    """Values at equal distances, averaged with Gaussian weights, which preserve the sum.

    Parameters
    ----------
    values
        At points `spacing` apart [mm]; continued by zeros.
    spacing
        Distance of the points [mm].
    width
        Standard deviation of the weights [mm]; 0 for none.
    """
    if width <= 0.0:
        return values
    reach = math.ceil(4.0 * width / spacing)
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) * spacing / width)**2)
    weights /= weights.sum()
    whole = np.convolve(values, weights)
    # contributions beyond an end are added to its last point
    kept = whole[reach:len(whole) - reach].copy()
    kept[0] += whole[:reach].sum()
    kept[-1] += whole[len(whole) - reach:].sum()
    return kept


def depth_per_revolution(results: Any, law: Law, profile: Profile, weights: ArrayLike) -> Numbers:
    """Mean wear depth of a revolution of a wheel, or on a rail of the passage of a wheel.

    Parameters
    ----------
    results
        Dataset of a study over one dimension, of a right wheel, with the fields pn, px, py, sx, sy.
    law
        Depth of a patch from its fields.
    profile
        Profile of the wheel or rail in the study.
    weights
        Fraction of the distance that each case represents; their sum is 1.

    Returns
    -------
    Depth at each point of the profile [mm]. The depth of each row of elements is distributed to the points within its
    width, which preserves the total worn area, depth times width.
    """
    places = np.abs(profile.lengths())
    middles = 0.5 * (places[1:] + places[:-1])
    edges = np.concatenate([[places[0]], middles, [places[-1]]])
    direction = 1.0 if profile.y[-1] > profile.y[0] else -1.0
    total = np.zeros_like(places)
    point = results["pn"].dims[0]
    reference = "ycp_r" if profile.is_rail else "ycp_w"
    for case, weight in enumerate(np.asarray(weights, dtype=float)):
        one = results.isel({point: case})
        for patch in range(one.sizes["patch"]):
            found = one.isel(patch=patch)
            if not np.isfinite(float(found["fn"])) or not np.isfinite(found["pn"].values).any():
                continue
            pn, px, py, sx, sy = (np.nan_to_num(found[name].values) for name in _FIELDS)
            depth = np.asarray(law(pn, px, py, sx, sy, float(found["dx"])), dtype=float)
            width = float(found["dy"])
            rows = float(found["y_first"]) + width * np.arange(len(depth))
            centres = direction * (float(profile.length_at(float(found[reference]))) + rows)
            worn = np.concatenate([[0.0], np.cumsum(depth * width)])
            borders = centres[0] + direction * width * (np.arange(len(depth) + 1) - 0.5)
            if direction < 0.0:
                borders, worn = borders[::-1], worn[-1] - worn[::-1]
            total += weight * np.diff(np.interp(edges, borders, worn)) / np.diff(edges)
    return total


def wear_of_wheel(base: Mapping[str, Any], journey: Journey, distance: float, law: Law, *, folder: str | os.PathLike[str],
                  base_folder: str | os.PathLike[str], largest_step: float = 0.05, spacing: float = 0.25, width: float = 2.5,
                  workers: int | None = None, stop: Callable[[], bool] = lambda: False) -> Iterator[State]:
    """Wear of a wheel over a distance, step by step.

    Parameters
    ----------
    base
        A case of wheel and rail, a right wheel, as a dictionary of the readable format.
    journey
        Returns the cases of a step: inputs such as ``"position.y_ws"`` and ``"velocity.vpitch"``, a list for each, and weights.
        Use positions that differ from step to step, so that they leave no traces; the pitch rate of a freely rolling wheel
        increases with wear.
    distance
        Length of the journey [km].
    law
        Depth of a patch from its fields.
    folder
        Folder of worn profiles and computed cases, from which an interrupted journey is resumed.
    base_folder
        Folder of relative file names of the base.
    largest_step
        Increase of the wear depth after which contacts are recomputed [mm].
    spacing
        Distance of points of the profile [mm].
    width
        Standard deviation of the weights with which the depth is averaged [mm]: the real positions of a journey are continuous,
        and hollows between two computed ones would grow.
    workers
        As for :meth:`contact.Study.run`.
    stop
        Called between steps; True ends the journey.

    Yields
    ------
    The wheel at the start and after each step.

    Raises
    ------
    ContactError
        If a contact of the journey has no result, or the law returns a negative depth or NaN.
    """
    radius = float(base["wheel_dimensions"]["nomradw"])
    yield from _wear(base, "wheel_profile", 1e6 / (2.0 * math.pi * radius), "km", journey, distance, law, Path(folder),
                     base_folder, largest_step, spacing, width, workers, stop)


def wear_of_rail(base: Mapping[str, Any], journey: Journey, wheels: float, law: Law, *, folder: str | os.PathLike[str],
                 base_folder: str | os.PathLike[str], largest_step: float = 0.05, spacing: float = 0.25, width: float = 2.5,
                 workers: int | None = None, stop: Callable[[], bool] = lambda: False) -> Iterator[State]:
    """Wear of a rail by passing wheels, step by step.

    Parameters
    ----------
    base
        A case of wheel and rail, a right wheel, as a dictionary of the readable format. If ``gaught`` is positive the rail is
        placed by its gauge point, also when it is worn.
    journey
        Returns the wheels that pass in a step, as for :func:`wear_of_wheel`; the weights are their fractions.
    wheels
        Number of wheels that pass, in millions.
    law
        Wear depth of a passage.
    folder, base_folder, largest_step, spacing, width, workers, stop
        As for :func:`wear_of_wheel`.

    Yields
    ------
    The rail at the start and after each step; its ``distance`` is the number of wheels in millions.

    Raises
    ------
    ContactError
        As :func:`wear_of_wheel`.
    """
    yield from _wear(base, "rail_profile", 1e6, "million wheels", journey, wheels, law, Path(folder), base_folder, largest_step,
                     spacing, width, workers, stop)


def _wear(base: Mapping[str, Any], group: str, factor: float, unit: str, journey: Journey, distance: float, law: Law,
          folder: Path, base_folder: str | os.PathLike[str], largest_step: float, spacing: float, width: float,
          workers: int | None, stop: Callable[[], bool]) -> Iterator[State]:
    """Steps of a wheel or a rail; group names the group with its profile, factor is the number of passages per unit of distance"""
    from .study import Study, table
    home = folder.resolve()
    home.mkdir(parents=True, exist_ok=True)
    case = copy.deepcopy(dict(base))
    profile = Profile.read(Path(base_folder) / case[group]["file"]).meshed(spacing)
    stem, ending = ("rail", "prr") if profile.is_rail else ("wheel", "prw")
    done, area = 0.0, 0.0
    depth = np.zeros_like(profile.y)
    number = 0
    while True:
        name = home / f"{stem}_{number:04d}.{ending}"
        profile.write(name, f"{done:.6g} {unit}")
        case[group] = {**case[group], "file": str(name)}
        cases, weights = journey(number, profile)
        shares = np.asarray(weights, dtype=float)
        shares = shares / shares.sum()
        study = Study(case, table(dict(cases)), fields=list(_FIELDS), folder=home / "cases", base_folder=base_folder)
        results = study.run(workers, progress=False)
        failed = study.failures(results)
        if (results["status"].values == 2).any():
            raise ContactError(f"after {done:.6g} {unit}: {failed}")
        per_km = depth_per_revolution(results, law, profile, shares) * factor
        if not np.isfinite(per_km).all() or (per_km < 0.0).any():
            raise ContactError("the law of wear gives a depth that is negative or no number")
        rate = smoothed(per_km, spacing, width)
        yield State(done, profile, depth, rate, area)
        if done >= distance or stop():
            return
        largest = float(rate.max())
        step = min(distance - done, largest_step / largest if largest > 0.0 else distance)
        done = distance if step >= distance - done else done + step
        widths = np.gradient(np.abs(profile.lengths()))
        area += float((rate * widths).sum() * step)
        worn = profile.worn(rate * step)
        profile = worn.meshed(spacing)
        # depths are moved with the points; both arc lengths differ slightly, because chords are shorter than the curve
        new, old = np.abs(profile.lengths()), np.abs(worn.lengths())
        depth = np.interp(new, old * (new[-1] / old[-1]), depth + rate * step)
        number += 1
