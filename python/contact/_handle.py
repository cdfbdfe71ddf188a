"""Objects that own memory of the library."""
from __future__ import annotations

from types import TracebackType
from typing import Any, TypeVar

_Self = TypeVar("_Self", bound="Handle")


class Handle:
    """Owner of a handle of the library, which is freed by `close`, at the end of a `with` block, or with the object"""

    #: Name of the routine of the library that frees the handle
    _closer = ""
    _library: Any
    _handle: Any = None

    def close(self) -> None:
        """Free the memory of the library."""
        handle, self._handle = self._handle, None
        if handle:
            getattr(self._library, self._closer)(handle)

    def __reduce_ex__(self, protocol: Any) -> Any:
        # a copy would free the same memory again
        raise TypeError(f"a {type(self).__name__} cannot be copied or pickled, since it stands for memory of the library; make it "
                        "anew in each process")

    def __enter__(self: _Self) -> _Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    def __del__(self) -> None:
        self.close()
