#!/usr/bin/env python3
"""Links of the documents lead somewhere: to files that are there, and to headings by their names in the repository"""
import functools
import os
import pathlib
import re
import sys

TOP = pathlib.Path(os.environ.get("CONTACT_SOURCE", pathlib.Path(__file__).resolve().parents[2]))
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")


@functools.cache
def anchors(path):
    """Names of the headings of a page, as GitHub makes them"""
    text = re.sub(r"^```.*?^```", "", path.read_text(), flags=re.MULTILINE | re.DOTALL)
    names = []
    for heading in re.findall(r"^#+ (.*)$", text, re.MULTILINE):
        name = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
        name = re.sub(r"[^\w\- ]", "", name).replace(" ", "-")
        names.append(name if name not in names else f"{name}-{names.count(name)}")
    return frozenset(names)


def faults(page):
    """Links of a page that lead nowhere"""
    text = re.sub(r"^```.*?^```|`[^`\n]*`", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
    for target in LINK.findall(text):
        if re.match(r"\w+:", target):
            continue
        name, _, anchor = target.partition("#")
        path = (page.parent / name).resolve() if name else page
        if not path.exists():
            yield f"{page.relative_to(TOP)}: there is no {target}"
        elif anchor and path.suffix == ".md" and anchor not in anchors(path):
            yield f"{page.relative_to(TOP)}: {name or 'the page'} has no heading #{anchor}"


def main():
    """All pages of the repository"""
    folders = sorted((TOP / "doc").rglob("*.md")) + sorted((TOP / "examples").glob("*.md"))
    pages = [TOP / "README.md", TOP / "python/README.md", *folders]
    found = [fault for page in pages for fault in faults(page)]
    print("\n".join([f"FAILED {fault}" for fault in found] + [f"{len(pages)} pages, {len(found)} failures"]))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
