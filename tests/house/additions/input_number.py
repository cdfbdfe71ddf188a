"""A number of the input: FNOISE after OMGSLP of the slip velocity iteration (G = 4)"""
import pathlib
import subprocess

#: Heading of the recipe that is followed
RECIPE = "A number of the input"
#: File; before or behind the one line with these words; what is put there
EDITS = [
    ("src/cases/spec.f90", "behind", "real(wp) :: omgslp = 0.5_wp", """
      !> Share of noise in the slip velocities [-]
      real(wp) :: fnoise = 0.25_wp
"""),
    ("src/text/bounds.f90", "before", 'number_bounds("OMGSLP"', """
      & number_bounds("FNOISE", "-", "share of noise in the slip velocities", &
      & 0.0_wp, 0.5_wp, .false., "a share; beyond one half nothing can be seen", .true.), &
"""),
    ("src/cases/inputs.f90", "behind", 'call a%real("OMGSLP", iteration%omgslp)', """
         call a%real("FNOISE", iteration%fnoise, default=0.25_wp)
"""),
]
#: Files and places that may be changed
MAX_FILES, MAX_PLACES = 3, 3
#: What exists already of this kind
SIBLING = r'"OMGSLP"|%\s*omgslp\b'
#: Files that name it and need not name the next one, with the reason
KNOWING = {"src/cases/friction_setup.f90": "hands it to the solver"}

EXAMPLE = pathlib.Path(__file__).resolve().parents[3] / "examples/falling_friction.inp"


def prove(program, folder):
    """Complaints if the number is not read, not checked or not written, in either format"""
    def answer(*arguments):
        return subprocess.run([program, *arguments], cwd=folder, check=False, capture_output=True, text=True)

    def given(number):
        text = EXAMPLE.read_text(encoding="utf-8")
        (folder / "noisy.inp").write_text(text.replace("\n1  1.0  ", f"\n1  1.0  {number}  ", 1))

    given("0.125")
    if answer("convert", "noisy.inp").returncode:
        yield "it is not read from .inp"
    else:
        text = (folder / "noisy.toml").read_text()
        if "fnoise = 0.125" not in text:
            yield "it is not written to .toml"
        (folder / "again.toml").write_text(text.replace("0.125", "0.375"))
        if answer("convert", "again.toml").returncode or " 1 1.0 3.75" not in (folder / "again.inp").read_text():
            yield "it is not read from .toml, or not written to .inp"
    given("0.75")
    said = answer("3", "noisy")
    if not said.returncode or "FNOISE = 0.75 is above its upper bound" not in said.stdout + said.stderr:
        yield "a number beyond its bounds is not refused"
