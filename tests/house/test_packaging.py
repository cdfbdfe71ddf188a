#!/usr/bin/env python3
"""Packages describe the program correctly: options in the man page and in the completion, and the version in all recipes"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

TOP = pathlib.Path(os.environ["CONTACT_SOURCE"])
FOLDER = TOP / "src/packaging"


def complaints(options):
    """Options missing in the completion of bash"""
    bash = shutil.which("bash")
    if not bash:
        return []
    folder = os.path.dirname(os.environ["CONTACT_PROGRAM"])
    script = (f'PATH="{folder}:$PATH"; . {FOLDER}/contact.bash; '
              'COMP_WORDS=(contact --); COMP_CWORD=1; _contact; echo ${COMPREPLY[@]}')
    offered = subprocess.run([bash, "-c", script], capture_output=True, text=True).stdout.split()
    return [f"the completion lacks {option}" for option in sorted(options - set(offered))]


def different_extras():
    """The optional packages of the wheel are those of a checkout"""
    tables = [re.search(r"^\[project.optional-dependencies\]\n(.*?)\n\n", file.read_text(), re.MULTILINE | re.DOTALL)[1]
              for file in (FOLDER / "pyproject.toml", TOP / "python/pyproject.toml")]
    return [] if tables[0] == tables[1] else ["the optional packages of the wheel differ from those of a checkout"]


def main():
    """Compares words of the help with those of the files"""
    help_text = subprocess.run([os.environ["CONTACT_PROGRAM"], "--help"], capture_output=True, text=True, check=True).stdout
    version = subprocess.run([os.environ["CONTACT_PROGRAM"], "--version"], capture_output=True, text=True, check=True).stdout
    options = set(re.findall(r"--[a-z][a-z0-9-]+", help_text))
    assert len(options) > 10, "options of the help"
    bad = []
    page = subprocess.run([sys.executable, str(FOLDER / "man.py"), os.environ["CONTACT_PROGRAM"]], capture_output=True, text=True,
                          check=True).stdout.replace("\\-", "-")
    headed = re.findall(r"^\.B (--.*)$", page, re.MULTILINE)
    bad += [f"the man page lacks {option}" for option in sorted(options - set(re.findall(r"--[a-z][a-z0-9-]+", page)))]
    bad += [] if len(headed) > 10 else ["the man page has no options of their own"]
    bad += complaints(options)
    source = (TOP / "src/cli/versions.f90").read_text()
    pattern = re.search(r"^regex = '(.*)'$", (FOLDER / "pyproject.toml").read_text(), re.MULTILINE)[1]
    recipe = re.search(r"^  version: ([\d.]+)$", (FOLDER / "recipe.yaml").read_text(), re.MULTILINE)[1]
    numbers = {re.search(pattern, source)["value"], version.split()[1], recipe}
    if len(numbers) > 1:
        bad.append(f"versions differ: {sorted(numbers)}")
    bad += different_extras()
    for script in FOLDER.glob("*.sh"):
        if subprocess.run(["sh", "-n", str(script)]).returncode:
            bad.append(f"{script.name} is no script of sh")
    print("\n".join([f"FAILED {fault}" for fault in bad] + [f"{len(options)} options, {len(bad)} failures"]))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
