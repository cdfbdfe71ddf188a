"""Time of this solver against that of the numpy prototype, for the same problems in the same run.

    prototype.py [--large] PROGRAM [FOLDER OF THE PROTOTYPE]

Prints a Markdown table. Processor time of one thread, the shortest of several runs, both programs
alternately. Exit status 77 if numpy, scipy or the prototype is not available.
"""
import contextlib
import io
import os
import subprocess
import sys
import time

os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", MKL_NUM_THREADS="1")
GOAL = 1/3
RUNS = 2


def skip(why):
    print(f"SKIPPED comparison with the prototype: {why}")
    sys.exit(77)


large = "--large" in sys.argv
if large:
    sys.argv.remove("--large")
program = sys.argv[1]
top = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
folder = sys.argv[2] if len(sys.argv) > 2 else os.path.join(top, "..", "shared", "prototype")
if not os.path.exists(os.path.join(folder, "nested_preconditioned.py")):
    skip("its folder is absent")
try:
    import numpy as np  # noqa: F401
    import scipy  # noqa: F401
except ImportError as error:
    skip(str(error))
sys.path.insert(0, folder)
sys.dont_write_bytecode = True

# the program of nested iteration prints its own table when imported: use its definitions only
with open(os.path.join(folder, "nested_preconditioned.py"), encoding="utf-8") as file:
    source = file.read().split("\nfor name,geom,kw in")[0]
nested_program = {}
with contextlib.redirect_stdout(io.StringIO()):
    exec(compile(source, "nested_preconditioned.py", "exec"), nested_program)
    import forces_preconditioned
    import steady_rolling_newton as sn

BASE = (3.0, 5.0, 30000.0)
CREEPAGES = [("base", BASE, dict(ksi=5e-4, phi=3e-4)),
             ("fastsim geometry", (8.0, 4.0, 82000.0), dict(ksi=0, eta=-6.25e-4, phi=6.25e-4)),
             ("86 % saturated", BASE, dict(ksi=3e-3, eta=1e-3, phi=3e-4))]
FORCES = [("F (-0.2, 0)", (-0.2, 0.0)), ("F (-0.573, -0.327)", (-0.573, -0.327)), ("F (-0.9, 0.1)", (-0.9, 0.1)),
          ("F (-0.99, 0)", (-0.99, 0.0)), ("F (-0.999, 0)", (-0.999, 0.0)), ("F (-0.7, 0.7)", (-0.7, 0.7))]


def prototype_creepages(n, geometry, creepages):
    levels = [n >> k for k in range(5) if n >> k >= 20][::-1]
    with contextlib.redirect_stdout(io.StringIO()):
        start = time.process_time()
        nested_program["run"](levels, geometry, creepages, inner=0.2)
        return time.process_time() - start


def prototype_forces(n, force):
    # the set-up of coefficients is included, as in the nested program
    start = time.process_time()
    problem = sn.Prob(n, n, *BASE, ksi=0, phi=3e-4)
    problem.nfft = 0
    forces_preconditioned.solveF(problem, *force)
    return time.process_time() - start


def ours(name, n):
    """Milliseconds with and without set-up, as printed by --case"""
    out = subprocess.run([program, "--case", name, str(n)], capture_output=True, text=True, check=True).stdout.split()
    return float(out[0])/1000, float(out[1])/1000


def main():
    print("| case | grid | prototype s | this solver s | set-up included s | ratio | ratio with set-up | goal |")
    print("|---|---|---|---|---|---|---|---|")
    met = total = 0
    for n in (80, 160, 320) if large else (80, 160):
        for name, run in [(c[0], lambda c=c, n=n: prototype_creepages(n, c[1], c[2])) for c in CREEPAGES] \
                + [(f[0], lambda f=f, n=n: prototype_forces(n, f[1])) for f in FORCES if n < 320]:
            theirs, mine, whole = [], [], []
            for _ in range(RUNS if n < 320 else 1):
                theirs.append(run())
                one, all_ = ours(name, n)
                mine.append(one)
                whole.append(all_)
            a, b, c = min(theirs), min(mine), min(whole)
            good = c <= GOAL*a
            met += good
            total += 1
            print(f"| {name} | {n} x {n} | {a:.3f} | {b:.3f} | {c:.3f} | {b/a:.2f} | {c/a:.2f} | <= 0.33: "
                  f"{'met' if good else 'MISSED'} |", flush=True)
    print(f"\nGoals against the prototype: {met} met, {total - met} missed.")


main()
