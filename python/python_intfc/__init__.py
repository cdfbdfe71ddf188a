"""Routines of the library under the module name of the published library; see contact.cntc."""
from typing import Any

import contact.cntc
from contact.cntc import *  # noqa: F403


def __getattr__(name: str) -> Any:
    """The ctypes library, and names with cntc_"""
    return getattr(contact.cntc, name)
