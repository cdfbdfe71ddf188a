"""Presets of CMakePresets.json can be configured: options that depend on their variables are valid. They build with Make, too:
a target whose sources wait for the modules of a room depends on that room. Ninja does not need this, as it has one list of rules.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(os.environ["CONTACT_SOURCE"])
#: Those with variables that lists of options depend on; "fuzz" has those of "sanitize", but needs the library of a fuzzer
NAMES = ("sanitize", "coverage")
GENERATOR = ["-G", "Unix Makefiles"] if shutil.which("make") else []


def stamps_without_rule(folder):
    """Lines "TARGET: STAMP" for files that a target needs and no target before it makes, in a folder configured for Make"""
    makes, needs, before = {}, {}, {}
    for file in Path(folder).rglob("*.dir/build.make"):
        target = str(file.parent.relative_to(folder))
        text = file.read_text(encoding="utf-8")
        makes[target] = set(re.findall(r"^(modules/\S+\.stamp):", text, re.MULTILINE))
        needs[target] = set(re.findall(r"^\S.*: (modules/\S+\.stamp)$", text, re.MULTILINE))
    rules = (Path(folder)/"CMakeFiles"/"Makefile2").read_text(encoding="utf-8")
    for target, lower in re.findall(r"^(\S+\.dir)/all: (\S+\.dir)/all$", rules, re.MULTILINE):
        before.setdefault(target, set()).add(lower)
    found = []
    for target, stamps in needs.items():
        seen, open_ends = {target}, [target]
        while open_ends:
            lower = before.get(open_ends.pop(), set()) - seen
            seen |= lower
            open_ends += lower
        found += [f"{target}: {stamp}" for stamp in sorted(stamps - set().union(*(makes.get(name, set()) for name in seen)))]
    if not any(needs.values()):
        found.append("no target needs the modules of a room")
    return found


def main():
    """Configure each preset in a folder of its own."""
    failures = 0
    for name in NAMES:
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(["cmake", *GENERATOR, "--preset", name, "-B", folder], cwd=ROOT,
                                  capture_output=True, text=True)
            if done.returncode:
                failures += 1
                print(f"FAILED preset {name}: {done.stderr[-2000:]}")
            elif GENERATOR:
                for line in stamps_without_rule(folder):
                    failures += 1
                    print(f"FAILED preset {name} with Make: no rule for {line}")
    print(f"{len(NAMES)} presets, {failures} failures")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main())
