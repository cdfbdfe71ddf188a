"""The names under which scripts for the published library import its routines; see contact.cntc."""
from typing import Any

import contact.cntc
from contact.cntc import *  # noqa: F403


def __getattr__(name: str) -> Any:
    """The library itself, and names with cntc_"""
    return getattr(contact.cntc, name)
