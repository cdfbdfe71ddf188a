"""The exception with the code and the text of an error of the library, and the warnings."""
from __future__ import annotations


class ContactError(RuntimeError):
    """A call of the library failed.

    Attributes
    ----------
    code : int
        Error code of the library, for instance -32; 0 if the library was not called.
    status : str
        Status of the case, ``"not converged"`` or ``"refused"``; empty if the error is not that of a calculation.
    """

    def __init__(self, text: str, code: int = 0, status: str = "") -> None:
        super().__init__(text)
        self.code = code
        self.status = status


class ContactWarning(UserWarning):
    """A result that should be used with caution."""


class NotConvergedWarning(ContactWarning):
    """An iteration did not converge or a prescribed force was not reached; the message gives which, and by how much.

    The result is that of the last iteration, with ``status`` ``"not converged"`` and the same ``reason``."""
