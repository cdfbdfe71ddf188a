"""A friction law: a Stribeck curve, mu = FKIN + FEXP1 exp(-(s/SABSH1)**2)"""
import json
import math
import pathlib
import subprocess

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
      integer :: iy

      do iy = 1, size(mu, 2)
         associate (set => self%sets(self%set_of_row(iy)))
            mu(:, iy) = set%fkin + set%coef1*exp(-(cause(:, iy)/set%sabsh1)**2)
         end associate
      end do
   end subroutine stribeck_coefficient
"""),
    ("src/friction/new_law.f90", "behind", "use contact_friction_slip_laws, only", """
   use contact_friction_slip_laws, only : stribeck_law
"""),
    ("src/friction/new_law.f90", "behind", "integer :: coulomb = 0, linear = 2", """
      integer :: stribeck = 7
"""),
    ("src/friction/new_law.f90", "behind", "case (friction_model%temperature); allocate", """
      case (friction_model%stribeck); allocate(stribeck_law :: law)
"""),
    ("src/control/digits.f90", "behind", 'digit_row("L", 6, friction_model%temperature', """
      & digit_row("L", 7, friction_model%stribeck, both, .true., "friction falling with slip velocity, Stribeck", "stribeck"), &
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
MOST_FILES, MOST_PLACES = 4, 7
SIBLING = r"friction_model%rational|\brational_law\b"
KNOWING = {}

EXAMPLE = pathlib.Path(__file__).resolve().parents[3] / "examples/falling_friction.inp"

def prove(program, folder):
    """Complaints when the law does not act as its formula says, or is not told"""
    def answer(*arguments):
        return subprocess.run([program, *arguments], cwd=folder, check=False, capture_output=True, text=True)

    # one case of the example: all of the contact slides at a creepage of one half, at 12.5 m/s
    text = EXAMPLE.read_text(encoding="utf-8").split("\n\n")[0]
    text = text.replace("\n0322020 ", "\n0722020 ").replace("0.15  0.16  400  0.05  3000 ", "0.15  0.21  8000 ")
    text = text.replace("60000  0.001", "60000  0.4").replace("999  200", "100  200")
    (folder / "law.inp").write_text(text + "\n0  MODULE\n")
    run = answer("--json", "2", "law")
    if run.returncode:
        yield "a case does not run: " + run.stdout + run.stderr
        return
    records = [json.loads(line) for line in (folder / "law.jsonl").read_text().splitlines()]
    record = next(record for record in records if "totals" in json.dumps(record))
    found = json.dumps(record)
    expected = 0.15 + 0.21*math.exp(-(0.4*25000/8000)**2)
    (folder / "record.json").write_text(found)
    out = (folder / "law.out").read_text()
    if "friction falling with slip after Stribeck" not in out + run.stdout:
        yield "the report does not name the law"
    if not all(name in out for name in ("FEXP1", "SABSH1")):
        yield "the report does not tell the parameters"
    yield f"expected {expected}: {found}"
    if answer("convert", "law.inp").returncode or 'law = "stribeck"' not in (folder / "law.toml").read_text():
        yield "it is not written to .toml"
