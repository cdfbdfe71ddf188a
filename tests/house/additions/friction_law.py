"""A friction law: a Stribeck curve, mu = FKIN + FEXP1 exp(-(s/SABSH1)**2)"""
import json
import math
import os
import pathlib
import subprocess
import sys

RECIPE = "A friction law"
EDITS = [
    ("src/friction/slip_laws.f90", "behind", "end type exponential_law", """

   !> Stribeck: c1 exp(-(s/s_h1)**2)
   type, extends(slip_law), public :: stribeck_law
   contains
      procedure :: coefficient => stribeck_coefficient
      procedure, nopass :: title => stribeck_title
   end type stribeck_law
"""),
    ("src/friction/slip_laws.f90", "before", "end module contact_friction_slip_laws", """
   pure function stribeck_title() result(title)
      character(len=title_length) :: title
      title = "friction falling with slip after Stribeck"
   end function stribeck_title

   pure subroutine stribeck_coefficient(self, cause, mu)
      class(stribeck_law), intent(in) :: self
      real(wp), contiguous, intent(in) :: cause(:, :)
      real(wp), contiguous, intent(inout) :: mu(:, :)
      type(friction_set) :: set
      integer :: iy

      do iy = 1, size(mu, 2)
         set = self%set_of_row(iy)
         mu(:, iy) = set%fkin + set%coef1*exp(-(cause(:, iy)/set%sabsh1)**2)
      end do
   end subroutine stribeck_coefficient
"""),
    ("src/friction/new_law.f90", "behind", "use contact_friction_slip_laws, only", """
   use contact_friction_slip_laws, only : stribeck_law
"""),
    ("src/friction/new_law.f90", "behind", "integer :: coulomb = 0, linear = 2", """
      integer :: stribeck = 9
"""),
    ("src/friction/new_law.f90", "behind", "case (friction_model%temperature); call take", """
      case (friction_model%stribeck); call take(stribeck_law())
"""),
    ("src/control/digits.f90", "behind", 'digit_row("L", 6, friction_model%temperature', """
      & digit_row("L", 9, friction_model%stribeck, both, .true., "friction falling with slip velocity, Stribeck", "stribeck"), &
"""),
    ("src/cases/inputs.f90", "before", "case (friction_model%temperature)", """
      case (friction_model%stribeck)
         call a%real("FKIN", set%fkin)
         call a%real("FEXP1", set%coef1)
         call a%real("SABSH1", set%sabsh1)
         call a%end_line()
         if (a%is_reading) set%fstat = set%fkin + set%coef1
"""),
]
MAX_FILES, MAX_PLACES = 4, 7
SIBLING = r"friction_model%rational|\brational_law\b"
KNOWING = {}

TOP = pathlib.Path(__file__).resolve().parents[3]



def prove(program, folder):
    """Complaints if the law does not follow its formula, or is unknown to an interface"""
    def answer(*arguments):
        return subprocess.run([program, *arguments], cwd=folder, check=False, capture_output=True, text=True)

    # one case of the example, without memory: all of the contact slides with 10 m/s
    text = (TOP / "examples/falling_friction.inp").read_text(encoding="utf-8").split("\n\n")[0]
    for old, new in (("\n0322020 ", "\n0922020 "), ("0.15  0.16  400  0.05  3000 ", "0.15  0.21  8000 "), ("\n0.02  5 ", "\n0  5 "),
                     ("60000  0.001", "60000  0.4")):
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    (folder / "law.inp").write_text(text + "\n0  MODULE\n")
    run = answer("--json", "2", "law")
    if run.returncode:
        yield "a case does not run: " + run.stdout + run.stderr
        return
    patch = json.loads((folder / "law.jsonl").read_text().splitlines()[0])["patches"][0]
    found = -patch["totals"]["fx"]["value"]/patch["totals"]["fn"]["value"]
    expected = 0.15 + 0.21*math.exp(-(0.4*25000/8000)**2)
    if abs(found - expected) > 0.01*expected:
        yield f"the coefficient is {found}, not {expected}"
    if "friction falling with slip after Stribeck" not in patch["effects"]:
        yield "the report does not name the law"
    for name in ("law.out", "law.0001.mat"):
        if (folder / name).exists() and not all(word in (folder / name).read_text() for word in ("FEXP1", "SABSH1")):
            yield f"{name} does not have the parameters"
    if answer("convert", "law.inp").returncode or 'law = "stribeck"' not in (folder / "law.toml").read_text():
        yield "it is not written to .toml"
    else:
        (folder / "again.toml").write_text((folder / "law.toml").read_text())
        answer("--json", "2", "again.toml")
        again = json.loads((folder / "again.jsonl").read_text().splitlines()[0])["patches"][0]
        if again["totals"] != patch["totals"]:
            yield "read from .toml it gives something else"
    yield from prove_library(program, folder)


def prove_library(program, folder):
    """The routine of the library accepts the values of the description, and reports their number"""
    library = program.parents[1] / "lib/libcontact.so"
    script = ("from contact import _library, cntc\ncntc.initialize(1, 3)\n"
              "cntc.setfrictionmethod(1, 1, 9, [0.15, 0.21, 8000, 0, 5])\nprint(next(iter(cntc.getparameters(1, 1, 3).values())))\n"
              "cntc.setfrictionmethod(1, 1, 9, [0.15])\nprint(_library.last_error(1, 1)[1])\n")
    run = subprocess.run([sys.executable, "-c", script], cwd=folder, check=False, capture_output=True, text=True,
                         env=os.environ | {"CONTACT_LIBRARY": str(library), "PYTHONPATH": str(TOP / "python")})
    (folder / "library.txt").write_text(run.stdout + run.stderr)
    if "9" not in run.stdout.split("\n")[0]:
        yield "the library does not take it: " + run.stdout + run.stderr
    if "needs 5 values" not in run.stdout + run.stderr:
        yield "the library does not count its values: " + run.stdout + run.stderr
