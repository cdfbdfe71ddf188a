"""What goes wrong, as an exception with the code and the text of the library, and what is doubtful, as a warning."""
from __future__ import annotations


class ContactError(RuntimeError):
    """A call of the library failed.

    Attributes
    ----------
    code : int
        Number of the error as the library returns it, for instance -32; 0 when the library was not reached.
    status : str
        How the case ended, ``"not converged"`` or ``"refused"``; empty when the error is not that of a calculation.
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
