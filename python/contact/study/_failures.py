"""Cases that were not solved, by their kinds."""
from __future__ import annotations

import re

import numpy as np
import xarray


def kind_of(reason: str) -> str:
    """A reason without its numbers, so that the same failure of other cases reads alike."""
    return re.sub(r"[-+]?\d+(\.\d*)?([eE][-+]?\d+)?", "#", reason)


def table(results: xarray.Dataset) -> str:
    """Kinds of cases that were not solved: how many, how they ended, why, and the first of them."""
    status = results["status"].values.ravel()
    reasons = results["reason"].values.ravel()
    sentences = [str(text) for text in results["reasons"].values]
    found: dict[tuple[int, str], list[int]] = {}
    for place in np.flatnonzero((status == 1) | (status == 2)):
        found.setdefault((int(status[place]), kind_of(sentences[reasons[place]])), []).append(int(place))
    if not found:
        return ""
    words = {1: "not converged", 2: "refused"}
    lines = [f"{'cases':>9}  {'ended':13}  why"]
    for (state, kind), places in sorted(found.items(), key=lambda item: -len(item[1])):
        lines.append(f"{len(places):9d}  {words[state]:13}  {kind}")
        index = np.unravel_index(places[0], results["status"].shape)
        where = ", ".join(f"{name} {place}" for name, place in zip(results["status"].dims, index))
        lines.append(f"{'':9}  {'':13}  first at {where}: {sentences[reasons[places[0]]]}")
    return "\n".join(lines)
