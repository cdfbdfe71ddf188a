"""Elapsed time of the whole program on large grids with one and two threads: threads.py CONTACT [ROUNDS]

Runs with one and two threads alternate; the best of each counts. Another process on the machine delays both threads, as each
waits for the other.
"""
import os
import subprocess
import sys
import tempfile
import time

#: A ball of 500 mm radius under 30 kN, in contact within a radius of 4.62 mm, on a square 1.1 times as wide
SIDE = 2.2*4.62
FORCE = "fn = 30000.0\n"
CREEPAGES = FORCE + "cksi = 5e-4\nceta = 0.0\ncphi = 3e-4\n"
FORCES = FORCE + "fx = -0.5\nfy = 0.3\ncphi = 3e-4\n"
HEAT = ("[case.heat]\nmodel = \"flash\"\nsource = \"established\"\n" + "".join(
    f"bktemp{body} = 15.0\nheatcp{body} = 450.0\nlambda{body} = 0.05\ndens{body} = 7.85e-6\n" for body in (1, 2)))
LAYER = "gg3 = 800.0\nlaythk = 0.015\ntau_c0 = 180.0\nk_tau = 2500.0\n"


def ball(n, motion="steady_rolling", tangential="creepages", kinematics=CREEPAGES, **more):
    """One case on n x n elements; more: general, iteration and material keys, other tables, moduli of rigidity"""
    size = SIDE/n
    rolling = f"[case.rolling]\ndq = {size:.9g}\nveloc = 20000.0\n" if "rolling" in motion else ""
    return (f"[[case]]\nmodule = \"contact\"\nmotion = \"{motion}\"\nnormal = \"force\"\ntangential = \"{tangential}\"\n"
            f"{more.get('general', '')}[case.iteration]\nmaxgs = 1000\nmaxin = 100\nmaxnr = 30\neps = 1e-6\n"
            f"{more.get('iteration', '')}[case.kinematics]\n{kinematics}[case.friction]\nlaw = \"coulomb\"\n"
            f"variation = \"none\"\nfstat = 0.3\nfkin = 0.3\n{rolling}[case.material]\ninfluence = \"piecewise_constant\"\n"
            f"poiss = [0.28, 0.28]\ngg = {more.get('moduli', '[82000.0, 82000.0]')}\n{more.get('material', '')}"
            f"{more.get('tables', '')}[case.grid]\nform = \"corner_and_sides\"\nmx = {n}\nmy = {n}\nxl = {-SIDE/2:.9g}\n"
            f"yl = {-SIDE/2:.9g}\ndx = {size:.9g}\ndy = {size:.9g}\n[case.geometry]\nform = \"quadratic\"\n"
            "planform = \"unrestricted\"\nb = [0.001, 0.0, 0.001, 0.0, 0.0, 0.0]\n")


def continued(first, steps):
    """A case and some more, each with a smaller force, that continue it"""
    return first + "".join(f"[[case]]\nsequence = \"continue_all\"\n[case.kinematics]\nfn = {30000.0 - 500.0*k}\n"
                           for k in range(1, steps + 1))


def kinds(n):
    """Name and input of each kind of case, on n x n elements"""
    return [
        ("normal problem", ball(n, "none", kinematics=FORCE)),
        ("steady rolling, order 1", ball(n, iteration="order = 1\n")),
        ("steady rolling, order 2", ball(n, iteration="order = 2\n")),
        ("steady rolling, forces", ball(n, tangential="fx_and_fy", kinematics=FORCES)),
        ("shift, forces", ball(n, "shift", "fx_and_fy", FORCES)),
        ("shift, four steps", continued(ball(n, "shift", kinematics=FORCE + "cksi = 2e-3\nceta = 0.0\ncphi = 3e-4\n"), 3)),
        ("transient rolling, four steps", continued(ball(n, "transient_rolling"), 3)),
        ("dissimilar bodies, shift", ball(n, "shift", kinematics=FORCE + "cksi = 2e-3\nceta = 0.0\ncphi = 3e-4\n",
                                          moduli="[82000.0, 100000.0]")),
        ("viscoelastic bodies", ball(n, kinematics=CREEPAGES.replace("30000", "15000"),
                                     general="material_model = \"viscoelastic\"\n",
                                     material="fg = [1.0, 1.0]\ntc = [2e-4, 2e-4]\n")),
        ("layer that yields", ball(n, general="material_model = \"interfacial_layer\"\n", material=LAYER)),
        ("surface temperatures", ball(n, kinematics=FORCE + "cksi = 0.04\n", tables=HEAT)),
        ("steady rolling, .mat file", ball(n, general="mat_file = 1\n")),
        ("steady rolling, table in .out", ball(n, general="output_level = 5\n"))]


def elapsed(contact, folder, threads):
    """Seconds of one run"""
    start = time.perf_counter()
    subprocess.run([contact, "--quiet", "2", "x"], cwd=folder, check=True, env=dict(os.environ, OMP_NUM_THREADS=str(threads)))
    return time.perf_counter() - start


def main():
    contact, rounds = os.path.abspath(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 7
    n = 232
    print(f"| {n*n:,} elements | one thread, ms | two threads, ms | ratio |\n|---|---|---|---|")
    for name, text in kinds(n):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "x.toml"), "w", encoding="utf-8") as file:
                file.write(text)
            times = [(elapsed(contact, folder, 1), elapsed(contact, folder, 2)) for _ in range(rounds)]
        one, two = (1000.0*min(column) for column in zip(*times))
        print(f"| {name} | {one:.0f} | {two:.0f} | {one/two:.2f} |", flush=True)


if __name__ == "__main__":
    main()
