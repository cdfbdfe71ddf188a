#!/usr/bin/env python3
"""Runs the blocks of pages that claim to run, and compares what they show

Usage: run_blocks.py PAGE.md|FOLDER ... ; a folder stands for those of its pages that have such blocks, without those that compile
programs by pkg-config. Each page has a scratch folder of its own, with the profiles of the examples in it. A comment above a block
says what it is:

    <!-- file: NAME -->     the block is put into a file
    <!-- run -->            a block of sh or python is run; blocks of python of one page share their variables
    <!-- draw -->           the same of python where matplotlib, xarray and h5netcdf are there
    <!-- octave -->         a block for Octave is run where that is there, with the folder matlab on its path
    <!-- shows -->          lines of the block stand in this order in what the last run printed
    <!-- shows: NAME -->    or in a file that it wrote

Words have to be the same, `...` is any word, and numbers are the same to two units of their last figure. The program is that of
the environment variable CONTACT_PROGRAM where there is one, the Python package that of this checkout. A page that says pkg-config
finds the library installed from the build folder of that program.
"""
import contextlib
import importlib.util
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[1]
BLOCK = re.compile(r"<!-- (file|run|draw|octave|shows)(?:: ([^\n]*?))? -->\n+```(\w*)\n(.*?)\n```", re.DOTALL)
NUMBER = re.compile(r"[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?")
#: Seconds for one block
LONGEST = 120
#: A number is that of the page within so many units of its last figure
UNITS = 2.0


def same_number(shown, found):
    """Is a number what the page shows, as far as its figures go?"""
    mantissa = re.split("[eE]", shown)
    decimals = len(mantissa[0].partition(".")[2])
    power = int(mantissa[1]) if len(mantissa) > 1 else 0
    return abs(float(shown) - float(found)) <= UNITS*10.0**(power - decimals)


def same_line(shown, found):
    """Have two lines the same words and numbers? `...` stands for any word"""
    words = shown.split(), found.split()
    if len(words[0]) == len(words[1]):
        found = " ".join(word if word == "..." else other for word, other in zip(*words))
    words = NUMBER.split(shown), NUMBER.split(found)
    if [word.split() for word in words[0]] != [word.split() for word in words[1]]:
        return False
    return all(same_number(*pair) for pair in zip(NUMBER.findall(shown), NUMBER.findall(found)))


def has(*modules):
    """Are optional modules there?"""
    return all(importlib.util.find_spec(module) for module in modules)


def missing(shown, text):
    """First line of a block that does not stand in the text in its turn; None when all are there"""
    lines = iter(text.split("\n"))
    for line in shown.split("\n"):
        if line.strip() and not any(same_line(line, other) for other in lines):
            return line
    return None


class Page:
    """A page that is being followed"""

    def __init__(self, path, folder):
        self.path, self.folder, self.variables, self.printed, self.count = path, folder, {}, "", 0

    def fail(self, text):
        sys.exit(f"FAILED {self.path}: {text}")

    def octave(self, code):
        """A block for Octave; False where there is none"""
        if not shutil.which("octave-cli"):
            return False
        command = ["octave-cli", "--quiet", "--norc", "--path", str(TOP / "matlab"), "--eval", code]
        done = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST)
        self.printed = done.stdout
        if done.returncode:
            self.fail(f"status {done.returncode} of\n{code}\n{done.stdout}{done.stderr}")
        return True

    def run(self, language, code):
        if language == "sh":
            done = subprocess.run(["sh", "-eu", "-c", code], capture_output=True, text=True, timeout=LONGEST)
            self.printed = done.stdout
            if done.returncode:
                self.fail(f"status {done.returncode} of\n{code}\n{done.stdout}{done.stderr}")
        elif language == "python":
            printed = io.StringIO()
            try:
                with contextlib.redirect_stdout(printed):
                    exec(compile(code, str(self.path), "exec"), self.variables)
            except Exception as error:
                self.fail(f"{type(error).__name__} {error} in\n{code}")
            self.printed = printed.getvalue()
        else:
            self.fail(f"no way to run a block of \"{language}\"")

    def follow(self):
        """All blocks in their order"""
        left_out = False
        for kind, name, language, text in BLOCK.findall(self.path.read_text()):
            self.count += 1
            if kind == "file":
                pathlib.Path(name).write_text(text + "\n")
            elif kind != "shows":
                drawn = kind != "draw" or has("matplotlib", "xarray", "h5netcdf")
                left_out = not drawn or (kind == "octave" and not self.octave(text))
                if kind != "octave" and not left_out:
                    self.run(language, text)
            elif not left_out:
                line = missing(text, pathlib.Path(name).read_text() if name else self.printed)
                if line:
                    self.fail(f"not shown any more: {line}\n" + ("" if name else f"but:\n{self.printed}"))


def installed(folder):
    """The library, installed as a page tells its readers"""
    program = os.environ.get("CONTACT_PROGRAM")
    if not program or not shutil.which("pkg-config"):
        print("skipped: no built program, or no pkg-config")
        sys.exit(77)
    prefix = folder / "installed"
    build = pathlib.Path(program).parents[1]
    subprocess.run(["cmake", "--install", str(build), "--prefix", str(prefix)], check=True, stdout=subprocess.DEVNULL)
    package = next(prefix.rglob("contact.pc"))
    os.environ["PKG_CONFIG_PATH"] = str(package.parent)
    os.environ["LD_LIBRARY_PATH"] = str(package.parents[1])


def compiles(page):
    """Does a block of a page need the installed library?"""
    return any("pkg-config" in block[3] for block in BLOCK.findall(page.read_text()))


def pages_of(name):
    """A page, or the pages of a folder that have blocks to run"""
    path = (TOP / name).resolve()
    if not path.is_dir():
        return [path]
    return [page for page in sorted(path.glob("*.md")) if BLOCK.search(page.read_text()) and not compiles(page)]


def main():
    """All pages that are named; how many blocks each has"""
    program = os.environ.get("CONTACT_PROGRAM")
    if program:
        os.environ["PATH"] = os.pathsep.join((os.path.dirname(program), os.environ["PATH"]))
        os.environ.setdefault("CONTACT_LIBRARY", str(pathlib.Path(program).parents[1] / "lib/libcontact.so"))
    sys.path.insert(0, str(TOP / "python"))
    os.environ.setdefault("MPLBACKEND", "agg")
    if not has("numpy", "h5py"):
        print("skipped: Python has no numpy or no h5py")
        sys.exit(77)
    for path in (page for name in sys.argv[1:] for page in pages_of(name)):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(TOP / "examples/profiles", pathlib.Path(folder) / "profiles")
            (pathlib.Path(folder) / "examples").symlink_to(TOP / "examples")
            os.chdir(folder)
            if compiles(path):
                installed(pathlib.Path(folder))
            page = Page(path, folder)
            page.follow()
            os.chdir(TOP)
        print(f"{path.relative_to(TOP)}: {page.count} blocks")
        if not page.count:
            page.fail("nothing to run")


if __name__ == "__main__":
    main()
