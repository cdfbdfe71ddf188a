"""A total: the largest tangential traction"""
import json
import pathlib
import subprocess

RECIPE = "A total"
EDITS = [
    ("src/patch/result.f90", "behind", "real(wp) :: fn = 0.0_wp, pen = 0.0_wp, pmax = 0.0_wp", """
      !> Largest tangential traction [N/mm2]
      real(wp) :: ptmax = 0.0_wp
"""),
    ("src/patch/result.f90", "behind", 'call list%add("pmax"', """
      call list%add("ptmax", "N/mm2", "largest tangential traction", self%ptmax, heading="PTMAX")
"""),
    ("src/patch/derived.f90", "behind", "result%pmax = 0.0_wp", """
      result%ptmax = maxval(hypot(result%px, result%py))
"""),
]
MAX_FILES, MAX_PLACES = 2, 3
SIBLING = r"\bborder_elements\b"
KNOWING = {"src/patch/border.f90": "counts them",
           "src/capi/calculate3.f90": "hands the number to callers as an error code",
           "python/contact/problem.py": "hands it over", "python/contact/wheel_rail.py": "adds it up",
           "python/contact/_signatures.py": "made by make_interface.py"}

EXAMPLE = pathlib.Path(__file__).resolve().parents[3] / "examples/carter2d.inp"


def prove(program, folder):
    """Complaints if an output lacks the total"""
    (folder / "total.inp").write_text(EXAMPLE.read_text(encoding="utf-8"))
    run = subprocess.run([program, "--json", "--hdf5", "2", "total"], cwd=folder, check=False, capture_output=True, text=True)
    if run.returncode:
        yield "a case does not run: " + run.stdout + run.stderr
        return
    record = json.loads((folder / "total.jsonl").read_text().splitlines()[0])
    total = record["patches"][0]["totals"].get("ptmax", {})
    if total.get("unit") != "N/mm2" or not total["value"] > 0:
        yield f"JSON has {total}"
    if b"largest tangential traction" not in (folder / "total.h5").read_bytes():
        yield "the HDF5 file has no column of it"
    lines = (folder / "total.out").read_text().splitlines()
    values = [after.split()[-1] for line, after in zip(lines, lines[1:]) if line.endswith("PTMAX")]
    if not values or abs(float(values[0]) / total["value"] - 1) > 1e-3:
        yield f"the .out file has {values}"
