#!/usr/bin/env python3
"""Cost of an addition: each addition of tests/house/additions is applied to a copy of the sources

Usage: test_additions.py [--build FOLDER]

Each addition follows the recipe of its name in doc/develop/recipes.md. The test fails when

- a line at which text is to be inserted no longer exists: the recipe is out of date,
- the files that were changed are not those of the numbered steps of the recipe, or are more than the addition allows,
- an existing thing of the same kind is named in a file that the recipe does not know: then the next one has to be named
  there, too.

With --build the copy is built in FOLDER, which is kept, and each addition has to prove there that it works. That takes the
time of a whole build. CONTACT_BUILD_ADDITIONS=FOLDER in the environment does the same.
"""
import argparse
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
TOP = pathlib.Path(os.environ.get("CONTACT_SOURCE", HERE.parents[1]))
#: What the copy needs to be built
COPIED = ("CMakeLists.txt", "LICENSE", "README.md", "doc", "examples", "include", "matlab", "python", "src")
#: Files in which things of a kind are looked for
SOURCES = ("src/**/*.f90", "python/contact/**/*.py", "python/python_intfc/**/*.py", "matlab/**/*.m")


def additions():
    """The modules of the folder additions; their contents are described in the first one"""
    for file in sorted((HERE / "additions").glob("*.py")):
        spec = importlib.util.spec_from_file_location(file.stem, file)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        yield module


def steps_of(recipe, text):
    """Files of the numbered steps of a recipe"""
    section = re.search(rf"^## {re.escape(recipe)}\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
    if not section:
        return None
    return {match[1] for match in re.finditer(r"^\d+\. `([\w/.]+)`", section[1], re.MULTILINE)}


def plant(top, edits):
    """Insert texts before or after the lines that contain their anchors; complaints about anchors that do not occur exactly once"""
    complaints = []
    for file, side, anchor, text in edits:
        path = top / file
        lines = path.read_text(encoding="utf-8").splitlines(keepends=True) if path.exists() else []
        found = [number for number, line in enumerate(lines) if anchor in line]
        if len(found) != 1:
            complaints.append(f"{file} has {len(found)} lines with {anchor!r}, not one")
            continue
        lines.insert(found[0] + {"before": 0, "behind": 1}[side], text.strip("\n") + "\n")
        path.write_text("".join(lines), encoding="utf-8")
    return complaints


def where_named(top, pattern):
    """Files that name an existing thing"""
    expression = re.compile(pattern)
    found = set()
    for glob in SOURCES:
        for path in top.glob(glob):
            text = "\n".join(line for line in path.read_text(encoding="utf-8").splitlines()
                             if not line.lstrip().startswith(("!", "#", "%")))
            if expression.search(text):
                found.add(path.relative_to(top).as_posix())
    return found


def judge(module, top, recipes):
    """Complaints about one addition, which is applied in the process"""
    named = where_named(top, module.SIBLING)
    complaints = plant(top, module.EDITS)
    changed = {file for file, *_ in module.EDITS}
    lines = sum(len(text.strip("\n").splitlines()) for *_, text in module.EDITS)
    print(f"{module.RECIPE}: {len(changed)} files, {len(module.EDITS)} places, {lines} lines")
    if len(changed) > module.MAX_FILES:
        complaints.append(f"{len(changed)} files are changed, {module.MAX_FILES} are allowed")
    if len(module.EDITS) > module.MAX_PLACES:
        complaints.append(f"{len(module.EDITS)} places are changed, {module.MAX_PLACES} are allowed")
    steps = steps_of(module.RECIPE, recipes)
    if steps is None:
        complaints.append("doc/develop/recipes.md has no such recipe")
    elif steps != changed:
        complaints.append(f"the recipe lacks {sorted(changed - steps)} and has superfluous steps for {sorted(steps - changed)}")
    if not named:
        complaints.append(f"no existing item is named anywhere: {module.SIBLING!r}")
    for file in sorted(named - changed - set(module.KNOWING)):
        complaints.append(f"{file} names an existing item, {module.SIBLING!r}, but is missing in the recipe")
    for file in sorted(set(module.KNOWING) - named):
        complaints.append(f"{file} names none any more, leave it out of KNOWING")
    return [f"{module.RECIPE}: {text}" for text in complaints]


def build(top, folder):
    """The program of the copy"""
    made = folder / "build"
    subprocess.run(["cmake", "-S", top, "-B", made, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCONTACT_TESTS=OFF"],
                   check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", made], check=True, stdout=subprocess.DEVNULL)
    return made / "bin/contact"


def judge_itself():
    """Test of this script: steps are read from recipes, missing and superfluous ones are found"""
    text = "# Recipes\n\n## A thing\n\n1. `src/a.f90`: it.\n2. `src/b.f90`, a row.\n\n`src/c.f90` may.\n\n## Another\n\n1. `x`.\n"
    assert steps_of("A thing", text) == {"src/a.f90", "src/b.f90"}
    assert steps_of("No thing", text) is None
    with tempfile.TemporaryDirectory() as folder:
        top = pathlib.Path(folder)
        (top / "src").mkdir()
        for name in "ab":
            (top / f"src/{name}.f90").write_text("one\n! thing\ntwo thing\n")

        class Thing:
            RECIPE, SIBLING, KNOWING, MAX_FILES, MAX_PLACES = "A thing", r"\bthing\b", (), 1, 1
            EDITS = (("src/a.f90", "behind", "one", "new\n"), ("src/a.f90", "before", "three", "new\n"))
        found = judge(Thing, top, text)
        assert len(found) == 4, found
        assert (top / "src/a.f90").read_text() == "one\nnew\n! thing\ntwo thing\n"
        assert where_named(top, "one thing") == set()


def main():
    """Apply all additions, and build them together if requested"""
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", default=os.environ.get("CONTACT_BUILD_ADDITIONS"))
    folder = parser.parse_args().build
    judge_itself()
    recipes = (TOP / "doc/develop/recipes.md").read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as scratch:
        place = pathlib.Path(folder or scratch).resolve()
        top = place / "copy"
        shutil.rmtree(top, ignore_errors=True)
        for name in COPIED:
            copy = shutil.copytree if (TOP / name).is_dir() else shutil.copy2
            top.mkdir(parents=True, exist_ok=True)
            copy(TOP / name, top / name)
        complaints, modules = [], list(additions())
        for module in modules:
            complaints += judge(module, top, recipes)
        if folder and not complaints:
            program = build(top, place)
            for module in modules:
                case = place / module.__name__
                shutil.rmtree(case, ignore_errors=True)
                case.mkdir()
                complaints += [f"{module.RECIPE}: {text}" for text in module.prove(program, case)]
    for text in complaints:
        print("FAILED " + text)
    print(f"{len(modules)} additions, {len(complaints)} failures" + (", built" if folder else ""))
    return 1 if complaints or not modules else 0


if __name__ == "__main__":
    sys.exit(main())
