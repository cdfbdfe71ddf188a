"""What goes wrong, as an exception with the code and the text of the library, and what is doubtful, as a warning."""
from __future__ import annotations


class ContactError(RuntimeError):
    """A call of the library failed.

    Attributes
    ----------
    code : int
        Number of the error as the library returns it, for instance -32; 0 when the library was not reached.
    """

    def __init__(self, text: str, code: int = 0) -> None:
        super().__init__(text)
        self.code = code


class ContactWarning(UserWarning):
    """A result that is there and that should be doubted."""
