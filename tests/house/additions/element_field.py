"""An element field: the density of frictional power"""
import json
import pathlib
import subprocess

RECIPE = "An element field"
EDITS = [
    ("src/patch/result.f90", "behind", "real(wp), allocatable :: wx(:, :), wy(:, :)", """
      !> Density of frictional power [W/mm2], shape (mx, my)
      real(wp), allocatable :: fricpow(:, :)
"""),
    ("src/patch/result.f90", "before", 'call add(11, "taucrt"', """
      call add(24, "fricpow", "W/mm2", "density of frictional power", self%fricpow, label="frictional power", figures=4)
"""),
    ("src/patch/derived.f90", "behind", "call fill_whole(mx*my, element%exterior, result%division)", """
      result%fricpow = 0.0_wp*result%h
"""),
    ("src/patch/derived.f90", "before", "if (.not. allocated(problem%given_pressure)) then", """
      result%fricpow = (result%px*result%sx + result%py*result%sy)/(1000.0_wp*result%dt)
"""),
]
MAX_FILES, MAX_PLACES = 2, 4
SIBLING = r"\btaucrt\b"
WORDS = "has words of its own for it; others appear by their names"
KNOWING = {"matlab/private/field_values.m": WORDS, "matlab/private/read_mat_file.m": WORDS,
           "matlab/private/add_bound.m": "makes the traction bound of it",
           "matlab/diffcase.m": "subtracts the fields that it knows",
           "matlab/cntc_getcpresults.m": "hands over what the published function does",
           "python/contact/cntc.py": "the same in Python",
           "python/contact/_signatures.py": "made by make_interface.py"}

EXAMPLE = pathlib.Path(__file__).resolve().parents[3] / "examples/carter2d.inp"


def prove(program, folder):
    """Complaints if an output lacks the field"""
    text = EXAMPLE.read_text(encoding="utf-8").replace("\n0001541 ", "\n0002551 ")
    (folder / "field.inp").write_text(text)
    run = subprocess.run([program, "--json", "--hdf5", "--vtk", "2", "field"], cwd=folder, check=False, capture_output=True,
                         text=True)
    if run.returncode:
        yield "a case does not run: " + run.stdout + run.stderr
        return
    record = json.loads((folder / "field.jsonl").read_text().splitlines()[0])
    power = record["patches"][0]["totals"]["friction_power"]["value"]
    table = (folder / "field.0001.mat").read_text().splitlines()
    if table[12].split()[-1] != "FRICPOW":
        yield "the .mat file has no column of it"
    else:
        size = [float(word) for word in table[7].split()[:6]]
        found = sum(float(line.split()[-1]) for line in table[13:]) * size[4] * size[5]
        if abs(found / power - 1) > 1e-3:
            yield f"the sum over all elements is {found}, the total {power}"
    if b"density of frictional power" not in (folder / "field.h5").read_bytes():
        yield "the HDF5 file has no field of it"
    if b'Name="frictional power [W/mm2]"' not in (folder / "field.0001.vts").read_bytes():
        yield "the VTK file has no array of it"
    if "FRICPOW" not in (folder / "field.out").read_text():
        yield "the .out file has no column of it"
