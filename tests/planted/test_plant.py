#!/usr/bin/env python3
"""The campaign of planted faults on a toy: possible faults, outcomes, counts."""
import collections
import contextlib
import io
import os
import pathlib
import shutil
import subprocess
import sys

import faults
import plant

failed = 0

TOY = """module toy
   implicit none
contains
   !> Length of a vector, 1 where it is short
   function length(x, y, tolerance, error) result(r)
      real, intent(in) :: x, y, tolerance
      logical, intent(out) :: error
      real :: r
      integer, parameter :: n = 2
      integer :: k

      error = .false. ! x - y
      r = sqrt(x**2 + y**2)
      do k = 1, n
         if (r < tolerance) exit
      end do
      if (abs(r) < tolerance) r = 1.0
      call tell("a - b", x, &
         & y)
   contains
      subroutine tell(text, a, b)
         character(len=*), intent(in) :: text
         real, intent(in) :: a, b
         if (a < b) return
         if (len(text) > 100) print *, text
      end subroutine tell
   end function length
end module toy
"""
# Kind, line and its replacement: one possible fault of each kind
WANTED = [("constant", 12, "error = .true. ! x - y"), ("sign", 13, "r = sqrt(x**2 - y**2)"), ("component", 13,
    "r = sqrt(y**2 + y**2)"),
          ("abs dropped", 13, "r = (x**2 + y**2)"), ("constant", 13, "r = sqrt(x**3 + y**2)"), ("off by one", 14,
              "do k = 1, n - 1"),
          ("off by one", 14, "do k = 1 + 1, n"), ("comparison", 15, "if (r > tolerance) exit"), ("early exit", 15, "continue"),
          ("branches", 15, "if (.not. (r < tolerance)) exit"), ("tolerance", 17, "if (abs(r) < 1000*tolerance) r = 1.0"),
          ("abs dropped", 17, "if ((r) < tolerance) r = 1.0"), ("constant", 17, "if (abs(r) < tolerance) r = 2.0*1.0"),
          ("missing update", 12, "continue ! x - y"), ("early exit", 24, "continue")]
MATLAB = "function y = f(x)\n% f(x) - 1\ny = 2*x - 1;\nif (x<0)\n   y(1,2) = 'a-b';\nend\n"
PYTHON = 'def f(a, b):\n    """a - b"""\n    return g(a, b) if a.x else "a - b"\n'


def check(condition, text):
    global failed
    if not condition:
        failed += 1
        print("FAILED " + text)


def room_for_faults():
    found = [(fault.kind, fault.line, fault.new.strip()) for fault in faults.faults_of("src/toy/toy.f90", TOY)]
    for wanted in WANTED:
        check(wanted in found, "%s is not found" % (wanted,))
    lines = {line for _, line, _ in found}
    check(lines <= {12, 13, 14, 15, 17, 18, 19, 24, 25}, "only what is executed: lines %s" % sorted(lines))
    check(not any('"b' in new or "a + b" in new for _, _, new in found), "texts stay")
    text = TOY.split("\n")
    check(all(text[fault.line - 1] == fault.old != fault.new for fault in faults.faults_of("src/toy/toy.f90", TOY)),
          "the lines are those of the file")
    found = {fault.new for fault in faults.faults_of("matlab/f.m", MATLAB)}
    check({"y = 2*x + 1;", "y = 2*x;", "if (x>0)", "   y(2,1) = 'a-b';", "   ;"} <= found, "Matlab: %s" % found)
    check(not any("f(x)" in new for new in found), "comments and headers of Matlab stay")
    found = {fault.new.strip() for fault in faults.faults_of("python/f.py", PYTHON)}
    check('return g(b, a) if a.x else "a - b"' in found and '"""b - a"""' not in found, "Python: %s" % found)


class Toy(plant.Store):
    """The toy and two tests of it, instead of the copy of the sources"""

    def make(self, compiler):
        shutil.rmtree(self.folder, ignore_errors=True)
        source = self.source / "src" / "toy" / "toy.f90"
        for folder in source.parent, self.build, self.folder / "right":
            folder.mkdir(parents=True)
        source.write_text(TOY, encoding="utf-8")
        (self.build / "main.f90").write_text(
            "program main\nuse toy\nlogical :: bad\n"
            "if (.not. abs(length(3.0, 4.0, 0.1, bad) - 5.0) < 1e-5 .or. bad) stop 1\nend program\n",
            encoding="utf-8",
        )
        self.write("commands.json", {"link": {"program": compiler + " main.f90 toy.o -J. -o program"},
                                     "compile": {"src/toy/toy.f90": {"object": "toy.o",
                                                                     "command": "%s -J. -c toy.f90 -o toy.o" % compiler}}})
        self.write("tests.json", {"length": {"command": [str(self.build / "program")], "folder": str(self.build), "environment": {},
                                             "label": "unit"}})
        self.load()
        subprocess.run([compiler, "-c", str(source), "-o", "toy.o"], cwd=self.build, check=True)
        self.link({}, self.libraries())
        shutil.copy2(self.build / "program", self.folder / "right")
        self.outcome = {"length": {"outcome": self.run_test("length", 20)[0], "seconds": 0.1}}
        self.coverage = collections.defaultdict(lambda: {k: {"length"} for k in range(1, 40)})

    def libraries(self):
        return ["program"]


def judged():
    """One fault that the test of the toy catches, and some that it does not"""
    compiler = os.environ.get("FC") or shutil.which("gfortran")
    if not compiler:
        print("no gfortran: faults are not judged")
        return
    toy = Toy("toy_store")
    toy.make(compiler)
    check(toy.outcome["length"]["outcome"] == "passed", "the toy without a fault")
    known = {(fault.line, fault.new.strip()): fault for fault in faults.faults_of("src/toy/toy.f90", TOY)}
    caught = collections.Counter()
    for line, new, outcome in ((13, "r = sqrt(x**2 - y**2)", "caught"), (17, "if (abs(r) < 1000*tolerance) r = 1.0", "caught"),
                            (14, "do k = 1 + 1, n", "survived"), (15, "if (r > tolerance) exit", "survived"),
                            (13, "r = (x**2 + y**2)", "caught"), (17, "if ((r) < tolerance) r = 1.0", "survived")):
        result = toy.judge(known[line, new], "toy", 60, caught)
        check(result["outcome"] == outcome, "%s: %s instead of %s" % (new, result["outcome"], outcome))
        toy.add_line("results.jsonl", dict(result, seed=1, commit="0"*40))
    check(toy.judge(known[13, "r = sqrt(x**2 - y**2)"]._replace(old="gone"), "toy", 60, caught)["outcome"] == "gone",
          "a line that is not there")
    check(toy.judge(known[13, "r = sqrt(x**2 - y**2)"]._replace(file="src/toy/before.f90"), "toy", 60,
                    caught)["outcome"] == "caught", "a line that moved to another file")
    toy.restore()
    check(toy.run_test("length", 20)[0] == "passed", "the toy is restored")
    # the second outcome of a fault counts, the first is stored
    again = dict(toy.read_lines("results.jsonl")[2], outcome="caught", by="length")
    toy.add_line("results.jsonl", again)
    plant.ROOMS["toy"] = 1
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        plant.table(toy)
    check("| toy | 6 | 0 | 3 | 4 | 2 |" in printed.getvalue(), "the table:\n" + printed.getvalue())


def chosen():
    """The same faults for the same seed"""
    store = plant.Store("choice")
    store.source = pathlib.Path(os.environ["CONTACT_SOURCE"])
    orders = [store.choose(seed, ["control", "matlab", "python"]) for seed in (1, 1, 2)]
    check(orders[0] == orders[1] and orders[0] != orders[2], "faults follow from the seed")
    for room, order in orders[0].items():
        check(len(order) >= 2*plant.ROOMS[room], "room %s has %d faults" % (room, len(order)))
        check(len({fault.kind for fault in order[:12]}) >= 6, "kinds take turns in %s" % room)


def main():
    room_for_faults()
    judged()
    chosen()
    print("%d failures" % failed)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
