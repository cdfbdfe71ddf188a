"""Studies: many cases from one description, on one machine or many; see doc/user/studies.md."""
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._dataset import save
    from ._engine import Engine
    from ._space import Axis, log_span, sample, span, table
    from ._study import Plan, Study

__all__ = ["Axis", "Engine", "Plan", "Study", "log_span", "sample", "save", "span", "table"]

_HOMES = {"save": "_dataset", "Engine": "_engine", "Plan": "_study", "Study": "_study"}


def __getattr__(name: str) -> Any:
    """Import on demand, so that workers, which only compute, start without xarray"""
    import importlib
    if name in __all__:
        return getattr(importlib.import_module(f".{_HOMES.get(name, '_space')}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
