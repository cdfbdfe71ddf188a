"""A geometry: waves along x, B1 x**2 + B2 y**2 + B3 cos(2 pi x/B4)"""
import json
import pathlib
import subprocess

RECIPE = "A geometry"
EDITS = [
    ("src/cases/distance.f90", "behind", "integer :: quadratic = 1, profile = 2", """
      integer :: wavy = 4
"""),
    ("src/cases/distance.f90", "behind", "all_forms(*) = [", """
      & distance_form%wavy, &
"""),
    ("src/cases/distance.f90", "behind", "if (a%is_reading .and. a%is_good) geometry%b = list", """
      case (distance_form%wavy)
         list = geometry%b(:4)
         call a%list("B", list, 4, units=[character(len=4) :: "1/mm", "1/mm", "mm", "mm"])
         if (a%is_reading .and. a%is_good) geometry%b(:4) = list
"""),
    ("src/cases/distance.f90", "behind", "call fill_sines(spec, grid, h, error)", """
      case (distance_form%wavy)
         call fill_waves(spec, grid, h, error)
"""),
    ("src/cases/distance.f90", "before", "end module contact_cases_distance", """
   !> IBASE = 4: waves along x on an elliptic paraboloid
   subroutine fill_waves(spec, grid, h, error)
      type(geometry_spec), intent(in) :: spec
      type(potential_contact), intent(in) :: grid
      real(wp), intent(inout) :: h(:, :)
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
      integer :: ix, iy

      call require_nonzero("wave length B4", spec%b(4), error)
      if (allocated(error)) return
      do iy = 1, grid%my
         do ix = 1, grid%mx
            h(ix, iy) = spec%b(1)*grid%x(ix)**2 + spec%b(2)*grid%y(iy)**2 + spec%b(3)*cos(turn*grid%x(ix)/spec%b(4))
         end do
      end do
   end subroutine fill_waves
"""),
    ("src/control/words.f90", "before", 'form_row("IBASE", distance_form%elementwise', """
      & form_row("IBASE", distance_form%wavy, "wavy", "a paraboloid with waves along x"), &
"""),
]
MAX_FILES, MAX_PLACES = 2, 6
SIBLING = r"distance_form%quadratic_and_sines|\bfill_sines\b"
KNOWING = {}

TOP = pathlib.Path(__file__).resolve().parents[3]


def prove(program, folder):
    """Complaints if the geometry is not read, does not follow its formula, or is unknown to a format"""
    def approach(name, form, numbers):
        """The approach [mm] of a roller, IBASE and its numbers"""
        text = (TOP / "examples/bentall.inp").read_text(encoding="utf-8").split("\n\n")[1]
        text = "\n".join(line for line in text.split("\n") if not line.startswith("%"))
        old = "1  1                                    IBASE IPLAN\n0.02  0  0  0  0  0 "
        assert text.count(old) == 1
        (folder / f"{name}.inp").write_text(text.replace(old, f"{form}  1   IBASE IPLAN\n{numbers} ") + "\n0  MODULE\n")
        return compute(name)

    def compute(name):
        run = subprocess.run([program, "--json", "2", name], cwd=folder, check=False, capture_output=True, text=True)
        if run.returncode:
            raise RuntimeError(run.stdout + run.stderr)
        return json.loads((folder / f"{name}.jsonl").read_text().splitlines()[0])["patches"][0]["totals"]["pen"]["value"]

    try:
        smooth, flat, lifted = (approach("smooth", 1, "0.02 0 0 0 0 0"), approach("flat", 4, "0.02 0 0 1"),
                                approach("lifted", 4, "0.02 0 0.01 1e6"))
        rough = approach("rough", 4, "0.02 0 0.0001 0.02")
        subprocess.run([program, "convert", "rough.inp"], cwd=folder, check=True, capture_output=True)
        text = (folder / "rough.toml").read_text()
        (folder / "again.toml").write_text(text)
        again = compute("again")
    except (RuntimeError, subprocess.CalledProcessError) as error:
        yield f"a case does not run: {error}"
        return
    # gaps of both formulas differ by round-off, and so do the solutions
    if abs(flat - smooth) > 1e-12 * smooth:
        yield f"without waves the approach is {flat}, not {smooth}"
    if abs(lifted - smooth - 0.01) > 1e-6:
        yield f"lifted by 0.01 mm the approach is {lifted}, not 0.01 more than {smooth}"
    if abs(rough - smooth) < 1e-6:
        yield "waves have no influence"
    if 'form = "wavy"' not in text or again != rough:
        yield f"written to .toml and read again the approach is {again}, not {rough}"
