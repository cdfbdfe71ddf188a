"""Rolling and sliding contact with friction, by the CONTACT library.

:class:`Problem` is the contact of two bodies, :class:`WheelRail` that of a wheel on a rail; :mod:`contact.cntc` gives access to
the individual routines of the library. :func:`read`, :func:`explain` and :func:`convert` process input files, :func:`load` their
results, :class:`Study` computes many cases. The library is loaded when it is first used.
"""
from typing import TYPE_CHECKING, Any

from ._signatures import VERSION as __version__
from .errors import ContactError, ContactWarning, NotConvergedWarning

if TYPE_CHECKING:
    from . import cntc, study, table, wear
    from ._element import Patch, Stresses, output_to
    from ._experiment import convert, explain, read
    from ._jacobian import Jacobian
    from ._load import Case, Experiment, StoredPatch, load
    from .problem import Problem, Result
    from .study import Study
    from .wheel_rail import Forces, WheelRail, WheelRailPatch, WheelRailResult, Wrench

__all__ = ["Case", "ContactError", "ContactWarning", "Experiment", "Forces", "Jacobian", "NotConvergedWarning", "Patch", "Problem",
           "Result", "StoredPatch", "Stresses", "Study", "WheelRail", "WheelRailPatch", "WheelRailResult", "Wrench", "cntc",
           "convert", "explain", "load", "output_to", "read", "study", "table", "wear"]

_HOMES = {"Patch": "_element", "Stresses": "_element", "output_to": "_element", "Problem": "problem",
          "Result": "problem", "WheelRail": "wheel_rail", "WheelRailPatch": "wheel_rail",
          "WheelRailResult": "wheel_rail", "Forces": "wheel_rail", "Jacobian": "_jacobian", "Wrench": "wheel_rail",
          "Study": "study", "convert": "_experiment", "explain": "_experiment", "read": "_experiment",
          "Case": "_load", "Experiment": "_load", "StoredPatch": "_load", "load": "_load"}


def __getattr__(name: str) -> Any:
    """Import on demand, so that other parts of the package work without numpy and without the library"""
    import importlib
    if name in _HOMES:
        return getattr(importlib.import_module(f".{_HOMES[name]}", __name__), name)
    if name in ("cntc", "study", "table", "wear"):
        return importlib.import_module(f".{name}", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
