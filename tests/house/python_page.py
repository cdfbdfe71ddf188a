#!/usr/bin/env python3
"""doc/user/python_reference.md agrees with the docstrings of the package contact

Usage: python_page.py [--write]. Public names are those of __all__ in contact, contact.study and contact.table, and the functions of
contact.wear and contact.cntc. Only the sources are read. Without --write the page is compared with what it should be.
"""
import ast
import inspect
import os
import pathlib
import re
import sys

TOP = pathlib.Path(os.environ.get("CONTACT_SOURCE", pathlib.Path(__file__).resolve().parents[2]))
PACKAGE = TOP / "python/contact"
PAGE = TOP / "doc/user/python_reference.md"
HEAD = """# Python: classes and functions

Reference, generated from the docstrings of the package by `tests/house/python_page.py`; examples are in [Python](python.md). Units
chosen by the caller are written as dimensions: L length, F force, T time, A angle, V velocity
([units](library.md#units-and-signs)). Names of totals and fields are those of [results](results.md).
"""
#: Titles of the parts; the classes and functions of each in the order of their sources
PARTS = {"Problems": ("problem", "wheel_rail", "_element"), "Derivatives": ("_jacobian",), "Results in files": ("_load",),
         "What results have in common": ("_view",), "Experiments in files": ("_experiment",), "Errors and warnings": ("errors",),
         "Wear and fatigue: `contact.wear`": ("wear",), "Studies: `contact.study`": ("study",),
         "Tables of creep forces: `contact.table`": ("table",), "The routines one by one: `contact.cntc`": ("cntc",)}
SECTION = re.compile(r"^(Parameters|Returns|Raises|Attributes|Yields|Notes|Warns|Examples)\n-+$", re.MULTILINE)


def public(path):
    """The names in __all__ of a module, none without it"""
    for node in ast.parse(path.read_text()).body:
        if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") == "__all__":
            return ast.literal_eval(node.value)
    return []


def words(text):
    """Text of a docstring in Markdown: names as code, powers and arrows unchanged"""
    parts = re.sub(r":\w+:`~?([^`]*)`", r"``\1``", text).split("``")
    plain = [part.replace("*", "\\*").replace("<", "&lt;") for part in parts[::2]]
    return "".join(f"{one}`{other}`" for one, other in zip(plain, parts[1::2])) + (plain[-1] if len(parts) % 2 else "")


def entries(text):
    """The entries of a section: names with their descriptions"""
    if not re.search(r"^ ", text, re.MULTILINE):
        return words(text).strip() + "\n"
    lines = ""
    for line in text.strip("\n").split("\n"):
        if line and not line.startswith(" "):
            lines += f"\n- `{line}`:"
        else:
            lines += " " + words(line).strip()
    return lines.strip("\n") + "\n"


def docstring_text(node):
    """The docstring of a class or function in Markdown"""
    parts = SECTION.split(inspect.cleandoc(ast.get_docstring(node, clean=False) or ""))
    text = words(parts[0]).strip() + "\n"
    for title, body in zip(parts[1::2], parts[2::2]):
        shown = f"```python\n{body.strip()}\n```\n" if title == "Examples" else entries(body)
        text += f"\n*{title}*\n\n{shown}"
    return text


def call(node, name, method):
    """Signature of a function"""
    arguments = ast.unparse(node.args)
    if method:
        arguments = re.sub(r"^self(: \w+)?(, )?", "", arguments)
    return f"{name}({arguments})"


def is_property(node):
    return any(ast.unparse(decorator).endswith("property") for decorator in node.decorator_list)


def a_function(node, level, method=False, owner=""):
    title = node.name if is_property(node) else f"{node.name}()"
    kind = "" if is_property(node) else f"```python\n{call(node, owner + node.name, method)}\n```\n\n"
    return f"{'#' * level} {owner}{title}\n\n{kind}{docstring_text(node)}\n"


def a_class(node):
    text = f"### {node.name}\n\n"
    start = next((item for item in node.body if isinstance(item, ast.FunctionDef) and item.name == "__init__"), None)
    if start and not node.name.startswith("_"):
        text += f"```python\n{call(start, node.name, True)}\n```\n\n"
    bases = [ast.unparse(base) for base in node.bases if ast.unparse(base) in BASES]
    text += docstring_text(node) + "\n" + "".join(f"It has what `{base}` has, too.\n\n" for base in bases)
    seen = set()
    for item in node.body:
        shown = isinstance(item, ast.FunctionDef) and not item.name.startswith("_") and ast.get_docstring(item)
        if shown and item.name not in seen:
            seen.add(item.name)
            text += a_function(item, 4, True, f"{node.name}.")
    return text


#: Classes that are no names of the package, but hold what several of those do
BASES = ("Element", "View", "Patch")


def sources(part):
    """The files of a part: a module, or the modules of a package"""
    folder = PACKAGE / part
    return sorted(folder.glob("_[a-z]*.py")) if folder.is_dir() else [PACKAGE / f"{part}.py"]


def required_names(part):
    """The names of a part that are public; of a module of functions all that do not begin with _"""
    if (PACKAGE / part).is_dir():
        return public(PACKAGE / part / "__init__.py")
    return None if part in ("wear", "cntc") else [*public(PACKAGE / "__init__.py"), *BASES]


def page():
    text = HEAD
    for title, parts in PARTS.items():
        text += f"\n## {title}\n\n"
        for part in parts:
            for path in sources(part):
                for node in ast.parse(path.read_text()).body:
                    if not isinstance(node, (ast.ClassDef, ast.FunctionDef)) or node.name.startswith("_"):
                        continue
                    names = required_names(part)
                    if not ast.get_docstring(node) or (names is not None and node.name not in names):
                        continue
                    text += a_class(node) if isinstance(node, ast.ClassDef) else a_function(node, 3)
    return re.sub(r"\n{3,}", "\n\n", text).rstrip("\n") + "\n"


def main():
    current = page()
    if "--write" in sys.argv:
        PAGE.write_text(current)
    elif not PAGE.exists() or PAGE.read_text() != current:
        print("FAILED doc/user/python_reference.md is not current: python3 tests/house/python_page.py --write")
        return 1
    missing = [name for name in public(PACKAGE / "__init__.py")
               if not re.search(rf"^### {name}(\(\))?$", current, re.MULTILINE) and not (PACKAGE / name).with_suffix(".py").exists()
               and not (PACKAGE / name).is_dir()]
    headings = current.count("\n#")
    print("\n".join(f"FAILED {name} has no docstring" for name in missing) or f"{headings} headings, none missing")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
