"""The names under which scripts for the published library import its routines; see contact.cntc."""
from contact.cntc import *  # noqa: F403
