#!/usr/bin/env python3
"""Pages with blocks that run as notebooks, executed: notebooks.py FOLDER PAGE.md ..., called by build.sh

Text becomes cells of text, the blocks below `<!-- run -->` cells of code, with what they print and draw; blocks of what is to be
seen are left out, as it stands below the code. Needs nbformat, nbclient, ipykernel, the program and the package of this checkout.
"""
import os
import pathlib
import re
import sys
import tempfile

import nbformat
from nbclient import NotebookClient

TOP = pathlib.Path(__file__).resolve().parents[1]
BLOCK = re.compile(r"<!-- (run|shows|file)(?:: [^\n]*?)? -->\n+```(\w*)\n(.*?)\n```\n?", re.DOTALL)
LINK = re.compile(r"\[([^\]]*)\]\((?!\w+:)[^)]*\)")
#: Seconds for one cell
LONGEST = 300


def cells(text):
    """Cells of a page; links to other pages become their words"""
    end = 0
    found = []
    for block in BLOCK.finditer(text):
        found.append(nbformat.v4.new_markdown_cell(LINK.sub(r"\1", text[end:block.start()]).strip()))
        if block[1] == "run":
            found.append(nbformat.v4.new_code_cell(block[3] if block[2] == "python" else f"%%{block[2]}\n{block[3]}"))
        elif block[1] == "file":
            raise SystemExit("a page that writes files is no notebook")
        end = block.end()
    found.append(nbformat.v4.new_markdown_cell(LINK.sub(r"\1", text[end:]).strip()))
    return [cell for cell in found if cell.source]


def main():
    """All pages that are named, into a folder"""
    folder = pathlib.Path(sys.argv[1])
    program = pathlib.Path(os.environ.get("CONTACT_PROGRAM", TOP / "build/release/bin/contact"))
    os.environ["PATH"] = os.pathsep.join((str(program.parent), os.environ["PATH"]))
    os.environ["PYTHONPATH"] = str(TOP / "python")
    os.environ.setdefault("CONTACT_LIBRARY", str(program.parents[1] / "lib/libcontact.so"))
    folder.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[2:]:
        page = TOP / name
        book = nbformat.v4.new_notebook(cells=cells(page.read_text()))
        with tempfile.TemporaryDirectory() as scratch:
            (pathlib.Path(scratch) / "examples").symlink_to(TOP / "examples")
            NotebookClient(book, timeout=LONGEST, kernel_name="python3", resources={"metadata": {"path": scratch}},
                           extra_arguments=["--log-level=40"]).execute()
        nbformat.write(book, folder / f"{page.stem}.ipynb")


if __name__ == "__main__":
    main()
