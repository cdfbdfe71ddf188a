"""Adds the library to a wheel if it exists, which then is specific to the platform; all else is in pyproject.toml.

The library is searched, in this order: in the folder of the package; by CONTACT_LIBRARY; in build/release of the checkout.
"""
import os
import shutil
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

HERE = Path(__file__).resolve().parent
ENDINGS = (".so", ".dll", ".dylib")


def ending_of(path):
    """The suffix of a name among ENDINGS, possibly followed by a version; None if it is not a library"""
    return next((ending for ending in ENDINGS if ending in path.suffixes), None)


def library_is_in_package():
    """Is there a library in the folder of the modules?"""
    return any(ending_of(path) for path in (HERE / "contact").iterdir())


def library_to_add():
    """Path of the library to be copied into the wheel; None if it is in the package already, or does not exist"""
    if library_is_in_package():
        return None
    chosen = os.environ.get("CONTACT_LIBRARY")
    if chosen and not (ending_of(Path(chosen)) and Path(chosen).is_file()):
        raise SystemExit(f"CONTACT_LIBRARY = {chosen} is not a library")
    candidates = [Path(chosen)] if chosen else sorted((HERE.parent / "build/release/lib").glob("libcontact.*"))
    return next((path for path in candidates if ending_of(path) and path.is_file()), None)


class PerhapsWithLibrary(Distribution):
    """The package, with the library if there is one"""

    def has_ext_modules(self):
        return library_is_in_package() or library_to_add() is not None


class CopyLibrary(build_py):
    """Copies the package and the library; an editable install finds the library itself"""

    def run(self):
        super().run()
        library = library_to_add()
        if library and not getattr(self, "editable_mode", False):
            shutil.copy(library, Path(self.build_lib) / "contact" / f"libcontact{ending_of(library)}")


setup(distclass=PerhapsWithLibrary, cmdclass={"build_py": CopyLibrary})
