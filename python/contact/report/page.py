"""Write the results of an experiment as one HTML file that needs no network."""
from __future__ import annotations

import html
import json
import os
from typing import Any

from .read import read_experiment

HERE = os.path.dirname(os.path.abspath(__file__))


def resource(name: str) -> str:
    with open(os.path.join(HERE, name), encoding="utf-8") as file:
        return file.read()


def _embedded(value: Any) -> str:
    """JSON, escaped for a script element"""
    return (json.dumps(value, separators=(",", ":"), allow_nan=False)
            .replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029"))


#: Scripts of the page, in their order
SCRIPTS = ("data.js", "scale.js", "svg.js", "frame.js", "maps.js", "plots.js", "block.js", "scene.js", "tables.js", "export.js",
           "page.js")


def page_of(path: str, other: str | None = None) -> str:
    """The page of an .h5 file, optionally with another one for comparison"""
    page = resource("viewer.html")
    data, blobs = read_experiment(path)
    beside = read_experiment(other) if other else (None, [])
    parts = {"@TITLE@": html.escape(data["experiment"]) + " \u2013 CONTACT", "@DATA@": _embedded(data),
             "@BLOBS@": _embedded(blobs), "@DATA-OTHER@": _embedded(beside[0]), "@BLOBS-OTHER@": _embedded(beside[1]),
             "@SCRIPT@": "\n".join(resource(name) for name in SCRIPTS)}
    pieces = []
    while parts:
        at, mark = min((page.index(mark), mark) for mark in parts)
        pieces += [page[:at], parts.pop(mark)]
        page = page[at + len(mark):]
    return "".join(pieces + [page])


def write_page(path: str, target: str | None = None, other: str | None = None) -> str:
    """Write the page of an .h5 file, optionally with another one for comparison; by default beside the file. Returns its name"""
    target = target or os.path.splitext(path)[0] + ".html"
    text = page_of(path, other)
    temporary = target + ".tmp"
    try:
        with open(temporary, "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(temporary, target)
    except OSError as reason:
        try:
            os.remove(temporary)
        except OSError:
            pass
        raise OSError("%s could not be written: %s" % (target, reason.strerror)) from None
    return target
