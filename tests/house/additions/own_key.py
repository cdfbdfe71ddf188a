"""A key of the readable format: restart, a flag of the group iteration"""
import pathlib
import subprocess

#: Heading of the recipe that is followed
RECIPE = "A key of the readable format"
#: File; before or behind the one line with these words; what is put there
EDITS = [
    ("src/cases/spec.f90", "behind", "logical :: allows_approximate = .false.", """
      !> Are iterations restarted if they stagnate?
      logical :: restarts = .false.
"""),
    ("src/cases/own_keys.f90", "behind", 'call visit_flag(a, "allow"', """
      call visit_flag(a, "restart", "do iterations begin anew when they stagnate?", [character(len=5) :: "true", "false"], &
         & iteration%restarts)
"""),
]
#: Files and places that may be changed
MAX_FILES, MAX_PLACES = 2, 2
#: What exists already of this kind
SIBLING = r'own_choice\(.*"order"'
#: Files that name it and need not name the next one, with the reason
KNOWING = {}

EXAMPLE = pathlib.Path(__file__).resolve().parents[3] / "examples/cattaneo.toml"


def prove(program, folder):
    """Complaints if the key is not read, not checked, or not suggested for a misspelt key"""
    def check_input(line):
        text = EXAMPLE.read_text(encoding="utf-8").replace("[case.iteration]\n", f"[case.iteration]\n{line}\n", 1)
        (folder / "anew.toml").write_text(text)
        answer = subprocess.run([program, "3", "anew"], cwd=folder, check=False, capture_output=True, text=True)
        return answer.returncode, answer.stdout + answer.stderr

    if check_input("restart = true")[0]:
        yield "it is not read from .toml"
    if "restart must be true or false" not in check_input("restart = 3")[1]:
        yield "a value that is none of its words is not refused"
    if 'did you mean "restart"?' not in check_input("restat = true")[1]:
        yield "it is not the nearest right name"
