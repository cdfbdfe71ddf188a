"""Creep forces by interpolation in tables, in about a microsecond; see doc/user/tables.md."""
from typing import TYPE_CHECKING, Any

from ._look_up import Facts, Table

if TYPE_CHECKING:
    from ._build import Plan, build

__all__ = ["Facts", "Plan", "Table", "build"]


def __getattr__(name: str) -> Any:
    """Import on demand: look-ups do not need scipy"""
    if name in ("Plan", "build"):
        from . import _build
        return getattr(_build, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
