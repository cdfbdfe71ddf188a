"""Settings of Sphinx for the site, see build.sh"""
import os
import pathlib
import re

from latex2mathml.converter import convert
from sphinx.util import logging

HERE = pathlib.Path(__file__).resolve().parent
project = "CONTACT"
version = release = re.search(r'contact_version = "([^"]+)"', (HERE.parent / "src/cli/versions.f90").read_text())[1]
extensions = ["myst_parser"]
root_doc = "index"
exclude_patterns = ["develop/ford.md"]
html_theme = "furo"
html_title = f"CONTACT {release}"
html_copy_source = False
# The names of headings are those of the pages in the repository
myst_heading_anchors = 4
suppress_warnings = ["myst.header", "misc.highlighting_failure"]

#: Pages in the order of the menu; those that are missing here come last
MENU = {
    "Start": ["user/install", "user/first_wheel", "user/first_call", "user/tutorials",
              *(f"user/{page}" for page in re.findall(r"\((tutorials/\w+)\.md\)", (HERE / "user/tutorials.md").read_text())),
              "user/choosing", "user/how_exact", "user/running", "user/studies", "user/plots"],
    "Reference": ["user/signs", "user/wheel_rail", "user/wheel_rail_results", "user/input", "user/output", "user/profiles",
                  "user/readable", "user/results", "user/python", "user/python_reference", "user/matlab", "user/library",
                  "user/routines", "user/vehicle", "user/tables"],
    "Differences": ["user/differences", "user/guide_sections", "changes"],
    "Theory": ["theory/index"] + [f"theory/{page}" for page in re.findall(r"^\| \[[^\]]*\]\((\w+)\.md\)",
                                                                         (HERE / "theory/index.md").read_text(), re.MULTILINE)],
    "Validation": ["validation/*"],
    "Development": ["develop/*"],
}
#: Folder `notebooks` with the executed tutorials and their pictures, which build.sh has made, or nothing
NOTEBOOKS = os.environ.get("CONTACT_NOTEBOOKS")
if NOTEBOOKS:
    html_extra_path = [str(pathlib.Path(NOTEBOOKS).parent)]
DRAWING = re.compile(r"<!-- draw -->\n+```python\n.*?\n```\n", re.DOTALL)
LINK = re.compile(r"(?<!!)\[([^\]]*)\]\(([^)#\s]+)(#[^)\s]*)?\)")


def plain_links(page, text):
    """Links to what is in the repository and no page of the site become its name; a link to nothing is a warning"""
    folder = (HERE / page).parent

    def told(match):
        words, target = match[1], match[2]
        if "://" in target or target.startswith("mailto:"):
            return match[0]
        path = (folder / target).resolve()
        if not path.exists():
            logging.getLogger(__name__).warning(f"{page}: there is no {target}")
        if HERE in path.parents and path.suffix == ".md":
            return match[0]
        return words if words.startswith("`") else f"{words} (`{path.relative_to(HERE.parent)}`)"
    return LINK.sub(told, text)


def plain_formulae(text):
    """Formulae as MathML, which browsers show by themselves; code is left alone"""
    def told(match):
        if match[1]:
            return match[0]
        block, inline = match[2], match[3]
        return convert(" ".join((block or inline).split()), display="block" if block else "inline")
    return re.sub(r"(^```.*?^```|`[^`\n]*`)|\$\$(.+?)\$\$|\$([^$]+?)\$", told, text, flags=re.MULTILINE | re.DOTALL)


def with_notebook(name, text):
    """A tutorial with a link to its notebook, and below each block that draws its picture"""
    link = f'<a href="../../notebooks/{name}.ipynb" download>The same as an executed notebook</a>'
    text = text.replace("\n\n", f"\n\n{link}\n\n", 1)
    number = 0

    def drawn(block):
        nonlocal number
        number += 1
        file = f"{name}_{number}.png"
        if not (pathlib.Path(NOTEBOOKS) / file).exists():
            return block[0]
        return f'{block[0]}\n<img src="../../notebooks/{file}" alt="What this block draws">\n'
    return DRAWING.sub(drawn, text)


def read(app, page, source):
    """Each page as Sphinx shall see it"""
    text = plain_links(page, source[0])
    if "$$" in text:
        text = plain_formulae(text)
    if NOTEBOOKS and page.startswith("user/tutorials/"):
        text = with_notebook(pathlib.PurePath(page).name, text)
    if page == root_doc:
        placed, menu = set(), ""
        for title, names in MENU.items():
            found = [other for name in names for other in sorted(app.env.found_docs)
                     if (other == name or pathlib.PurePath(other).match(name)) and other not in placed]
            placed.update(found)
            menu += f"\n```{{toctree}}\n:hidden:\n:caption: {title}\n\n" + "\n".join(found) + "\n```\n"
        rest = sorted(set(app.env.found_docs) - placed - {root_doc})
        text += menu + ("\n```{toctree}\n:hidden:\n:caption: More\n\n" + "\n".join(rest) + "\n```\n" if rest else "")
    source[0] = text


def setup(app):
    """Called by Sphinx"""
    app.connect("source-read", read)
