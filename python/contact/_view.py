"""Common base of results of a patch, solved or loaded: summary, plot, xarray data set."""
from __future__ import annotations

import importlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._signatures import FIELDS, TOTALS, VERSION

Field = NDArray[np.floating[Any]]

#: Element states in the order of their numbers
STATES = ("exterior", "adhesion", "slip", "plastic")
#: Version of the CF conventions for metadata that the data sets follow
CONVENTIONS = "CF-1.11"
# Fields that are meaningful within the contact only
_INSIDE = ("eldiv", "pn", "px", "py", "pt", "sx", "sy", "srel", "shft")
# Names that occur in .mat files only
_MAT_NAMES = {"xcp_r": ("mm", "contact reference, longitudinal, rail profile"), "srel": ("-", "magnitude of relative slip"),
              "shft": ("mm", "magnitude of the slip distance")}
_STRESSES = {"sighyd": "mean stress", "sigvm": "von Mises stress", "sigtr": "Tresca stress", "sigma1": "largest principal stress",
             "sigma2": "middle principal stress", "sigma3": "smallest principal stress", "ux": "longitudinal displacement",
             "uy": "lateral displacement", "uz": "vertical displacement"}


def optional(module: str, what: str) -> Any:
    """Import an optional module.

    Raises
    ------
    ImportError
        If it is not installed; the text says how to install it.
    """
    try:
        return importlib.import_module(module)
    except ImportError as reason:
        package = module.partition(".")[0]
        raise ImportError(f"{what} needs {package}, which is not installed: python3 -m pip install {package}") from reason


def in_units(unit: str, units: str) -> str:
    """The unit of a quantity in mm and N, for a problem in "mm", "si" or "simpack"; densities of power are always in W/mm2"""
    return unit if units == "mm" or unit == "W/mm2" else unit.replace("mm", "m")


def cf_unit(unit: str) -> str:
    """The unit by the CF conventions: 1 for dimensionless numbers"""
    return unit if unit not in ("", "-") else "1"


def meaning_of(name: str, units: str = "mm", is_shift: bool = False) -> tuple[str, str]:
    """Unit and description of a field or total by its name in files; the unit as text, "-" for a ratio"""
    if name in FIELDS:
        unit, text = FIELDS[name][-1 if is_shift else 0]
        # distances of shifts are in mm always
        unit = unit if len(FIELDS[name]) > 1 else in_units(unit, units)
    elif name == "eldiv":
        unit, text = "-", "element state"
    elif name == "pt":
        unit, text = in_units("N/mm2", units), "magnitude of the tangential traction"
    else:
        unit, text = TOTALS.get(name) or _MAT_NAMES.get(name, ("", name))
        unit = in_units(unit, units)
    if units == "simpack":
        text = text.replace("on body 1", "on body 2").replace("force on the rail", "force on the wheel")
    return unit, text


def state_attributes(states: tuple[str, ...] = STATES) -> dict[str, Any]:
    """Attributes with the meaning of element states"""
    return {"flag_values": np.arange(len(states), dtype=np.int8), "flag_meanings": " ".join(states)}


class View:
    """Base of solved and loaded patches: printing, plotting, conversion to xarray."""

    x: Field
    y: Field
    dx: float
    dy: float

    def fields(self) -> dict[str, Any]:
        """Element fields of shape (my, mx) by their names in files, see doc/user/results.md."""
        raise NotImplementedError

    def totals(self) -> dict[str, float]:
        """Totals by their names in files, see doc/user/results.md."""
        raise NotImplementedError

    def meaning(self, name: str) -> tuple[str, str]:
        """Unit and description of a field or a total by its name in files."""
        raise NotImplementedError

    def _title(self) -> str:
        """First line of the summary: what the result is, and its status"""
        return "Contact patch"

    def _has_fields(self) -> bool:
        return bool(self.fields())

    def __repr__(self) -> str:
        totals = self.totals()
        shown = [f"{name}={totals[name]:.5g}" for name in ("fn", "fx", "fy", "mz", "pen", "pmax") if name in totals]
        grid = f"; {len(self.x)} x {len(self.y)} elements" if self._has_fields() else ""
        return f"<{self._title()}: {', '.join(shown)}{grid}>"

    def __str__(self) -> str:
        totals = self.totals()
        lines = [self._title()]
        if self._has_fields():
            lines[0] += f", {len(self.x)} x {len(self.y)} elements of {self.dx:.5g} x {self.dy:.5g} {self.meaning('pen')[0]}"
        for name, value in totals.items():
            unit, text = self.meaning(name)
            lines.append(f"  {name:16s}{value:12.5g} {'' if unit == '-' else unit:8s} {text}")
        return "\n".join(line.rstrip() for line in lines)

    def plot(self, field: str = "pn", ax: Any = None, *, arrows: bool | None = None, **options: Any) -> Any:
        """Plot a field, with matplotlib.

        Parameters
        ----------
        field
            Name of a field in files: ``"pn"``, ``"px"``, ``"sx"``, ``"eldiv"``, ...; ``"pt"`` is the magnitude of the
            tangential traction.
        ax
            Axes to draw into; new ones by default.
        arrows
            Whether to draw tangential tractions as arrows. Default: for ``"pt"``.
        options
            For matplotlib's ``pcolormesh``, ``cmap`` for instance; for ``plot`` if the grid has one row or column.

        Returns
        -------
        The axes. x and y are to the same scale. A grid with one row or column gives a curve.

        Raises
        ------
        ImportError
            If matplotlib is not installed.
        ValueError
            If there is no such field; the message lists the available ones.
        """
        fields = self.fields()
        if "px" in fields:
            fields["pt"] = np.hypot(fields["px"], fields["py"])
        if field not in fields:
            raise ValueError(f"there is no field {field!r}; there are {', '.join(sorted(fields)) or 'none'}")
        pyplot = optional("matplotlib.pyplot", "plot")
        if ax is None:
            ax = pyplot.subplots()[1]
        values = np.asarray(fields[field], dtype=float)
        if field in _INSIDE:
            values = np.ma.masked_where(fields["eldiv"] == 0, values)
        unit, text = self.meaning(field)
        length = self.meaning("pen")[0]
        label = text if unit in ("-", "") else f"{text} [{unit}]"
        if min(values.shape) == 1:
            across = len(self.x) == 1
            ax.plot(self.y if across else self.x, values.reshape(-1), **options)
            ax.set(xlabel=f"{'y' if across else 'x'} [{length}]", ylabel=label)
            return ax
        edges = [np.append(place - side / 2, place[-1] + side / 2) for place, side in ((self.x, self.dx), (self.y, self.dy))]
        if field == "eldiv":
            options.setdefault("cmap", pyplot.get_cmap("viridis", len(STATES) - 1))
            mesh = ax.pcolormesh(*edges, values, vmin=0.5, vmax=len(STATES) - 0.5, **options)
            ax.figure.colorbar(mesh, ax=ax, ticks=range(1, len(STATES))).ax.set_yticklabels(STATES[1:])
        else:
            ax.figure.colorbar(ax.pcolormesh(*edges, values, **options), ax=ax, label=label)
        if arrows or (arrows is None and field == "pt"):
            step = max(1, -(-max(values.shape) // 25))
            inside = np.where(fields["eldiv"] > 0, 1.0, np.nan)
            ax.quiver(self.x[::step], self.y[::step], *((fields[name] * inside)[::step, ::step] for name in ("px", "py")))
        ax.set(xlabel=f"x [{length}]", ylabel=f"y [{length}]", aspect="equal", title=label if field == "eldiv" else "")
        return ax

    def to_xarray(self) -> Any:
        """Fields over x and y and totals as an ``xarray.Dataset`` with units and descriptions.

        Names are those of the files, see doc/user/results.md; element states have ``flag_values`` and
        ``flag_meanings``, ratios the unit 1 of the CF conventions.

        Raises
        ------
        ImportError
            If xarray is not installed.
        """
        xarray = optional("xarray", "to_xarray")
        variables: dict[str, Any] = {}
        for name, values in self.fields().items():
            unit, text = self.meaning(name)
            more = state_attributes() if name == "eldiv" else {"units": cf_unit(unit)}
            values = values.astype(np.int8) if name == "eldiv" else values
            variables[name] = (("y", "x"), values, {"long_name": text, **more})
        for name, value in self.totals().items():
            unit, text = self.meaning(name)
            variables[name] = ((), value, {"long_name": text, "units": cf_unit(unit)})
        length = self.meaning("pen")[0]
        places: dict[str, Any] = {}
        if self._has_fields():
            places = {"x": ("x", self.x, {"long_name": "centres of columns", "units": length}),
                      "y": ("y", self.y, {"long_name": "centres of rows", "units": length})}
        attributes = {"Conventions": CONVENTIONS, "title": self._title(), "source": f"contact {VERSION}"}
        return xarray.Dataset(variables, places, attributes)


def tree(root: Any, children: list[Any]) -> Any:
    """An ``xarray.DataTree`` with the data set of the case and, below it, those of the patches; names as in the HDF5 file"""
    xarray = optional("xarray", "to_xarray")
    if not hasattr(xarray, "DataTree"):
        raise ImportError("to_xarray of several patches needs xarray 2024.10 or later: python3 -m pip install --upgrade xarray")
    return xarray.DataTree.from_dict({"/": root, **{f"/patch_{k}": child for k, child in enumerate(children, 1)}})


def stress_meaning(name: str) -> str:
    """Description of a stress or displacement below the surface, by its name in files"""
    return _STRESSES.get(name) or f"stress {name[3:]}"


def plot_patches(patches: tuple[Any, ...], field: str, options: dict[str, Any]) -> Any:
    """One plot for each patch, side by side; returns an array of axes"""
    if not patches:
        raise ValueError("there is no contact to be drawn")
    axes = optional("matplotlib.pyplot", "plot").subplots(1, len(patches), squeeze=False)[1][0]
    for number, (ax, patch) in enumerate(zip(axes, patches), 1):
        patch.plot(field, ax, **options)
        ax.set_title(f"patch {number}")
    return axes
