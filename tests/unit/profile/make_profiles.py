"""The files in examples/profiles are those that their generator writes: python3 make_profiles.py SOURCES

Words are the same, and numbers within one unit of the last of nine decimals: where the tenth is a five, mathematical libraries
differ in how they round.
"""
import pathlib
import subprocess
import sys
import tempfile

UNIT = 1e-9


def is_same(a, b):
    """Are two words equal, or numbers that differ by one unit?"""
    if a == b:
        return True
    try:
        return abs(float(a) - float(b)) < 1.5*UNIT
    except ValueError:
        return False


def differences(made, kept):
    """Places in which two texts differ, as 'line: made, kept'"""
    lines = made.splitlines(), kept.splitlines()
    if len(lines[0]) != len(lines[1]):
        return [f"{len(lines[0])} lines instead of {len(lines[1])}"]
    return [f"{number}: {a!r} instead of {b!r}" for number, (a, b) in enumerate(zip(*lines), 1)
            if len(a.split()) != len(b.split()) or not all(map(is_same, a.split(), b.split()))]


sources = pathlib.Path(sys.argv[1])/"examples"
profiles = sources/"profiles"
with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.executable, "-B", sources/"make_profiles.py", folder], check=True)
    made = {str(path.relative_to(folder)): path.read_text(encoding="utf-8") for path in pathlib.Path(folder).rglob("*.*")}
kept = {"S1002.prw", "60E1.prr", "flat.slcw", "groove.txt", "roller.txt"}
kept |= {"flat/" + path.name for path in (profiles/"flat").iterdir()}
if set(made) != kept:
    sys.exit(f"files of only one side: {sorted(set(made) ^ kept)}")
wrong = [f"{name}: {text}" for name in sorted(kept)
         for text in differences(made[name], (profiles/name).read_text(encoding="utf-8"))]
if wrong:
    sys.exit("\n".join(wrong))
print(f"{len(made)} files are as their generator writes them")
