#!/usr/bin/env python3
"""Pages with blocks that run as notebooks, executed: notebooks.py FOLDER PAGE.md ..., called by build.sh

Text becomes cells of text, the blocks below `<!-- run -->` and `<!-- draw -->` cells of code, with what they print and draw; blocks
of what is to be seen are left out, as it stands below the code, and pictures of the repository, as those of the cells are there.
The picture of the n-th cell that draws is kept as PAGE_n.png beside the notebook. Needs nbformat, nbclient, ipykernel,
matplotlib, xarray, h5py, the program and the package of this checkout; blocks for Octave are run where that is installed.
"""
import base64
import os
import pathlib
import re
import shutil
import sys
import tempfile

import nbformat
from nbclient import NotebookClient

TOP = pathlib.Path(__file__).resolve().parents[1]
BLOCK = re.compile(r"<!-- (run|draw|octave|shows|file)(?:: [^\n]*?)? -->\n+```(\w*)\n(.*?)\n```\n?", re.DOTALL)
PICTURE = re.compile(r"^!\[[^\]]*\]\([^)]*\)\n", re.MULTILINE)
LINK = re.compile(r"\[([^\]]*)\]\((?!\w+:)[^)]*\)")
#: How a cell begins for each language
MAGIC = {"python": "", "sh": "%%sh\n", "matlab": f"%%script octave-cli --quiet --norc --path {TOP / 'matlab'}\n"}
#: Seconds for one cell
LONGEST = 300


def words(text):
    """A cell of text; links to other pages become their words"""
    return nbformat.v4.new_markdown_cell(LINK.sub(r"\1", PICTURE.sub("", text)).strip())


def pictures(book):
    """PNG of each cell that draws, None where it has none"""
    for cell in book.cells:
        if "draw" in cell.metadata.get("tags", []):
            drawn = [output.data["image/png"] for output in cell.outputs if "image/png" in output.get("data", {})]
            yield base64.b64decode(drawn[-1]) if drawn else None


def cells(text):
    """Cells of a page"""
    end = 0
    found = []
    for block in BLOCK.finditer(text):
        found.append(words(text[end:block.start()]))
        if block[1] in ("run", "draw", "octave") and (block[1] != "octave" or shutil.which("octave-cli")):
            found.append(nbformat.v4.new_code_cell(MAGIC[block[2]] + block[3], metadata={"tags": [block[1]]}))
        elif block[1] == "file":
            raise SystemExit("a page that writes files is no notebook")
        end = block.end()
    found.append(words(text[end:]))
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
        for number, picture in enumerate(pictures(book), 1):
            if picture:
                (folder / f"{page.stem}_{number}.png").write_bytes(picture)
        nbformat.write(book, folder / f"{page.stem}.ipynb")


if __name__ == "__main__":
    main()
