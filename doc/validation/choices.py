#!/usr/bin/env python3
"""The figures of doc/user/choosing.md: what choices of wheel on rail cost and change

S1002 on 60E1, 60 kN, 20 m/s with the pitch rate of the nominal radius, 19 lateral positions from -3 to 6 mm with a yaw of 1 mrad
per mm: tread, throat, flange. Error: median and largest difference of the vector (FX, FY) in track axes, relative to FZ, from the
same positions with half the smallest elements. CONTACT_PROGRAM is the program.
"""
import json
import os
import pathlib
import resource
import statistics
import subprocess
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("CONTACT_PROGRAM", str(TOP / "build/release/bin/contact"))
POSITIONS = [-3.0 + 0.5*k for k in range(19)]
RUNS = 1
MODULE = "1  MODULE\n"


def text(b=0, m=0, d=2, dx=0.2, eps=1e-5, c=2):
    """Input with one case for each position"""
    flexibility = {2: " 2e-6 1 1 1\n", 3: " 1 1 1\n", 5: " 1 1 1\n"}.get(m, "")
    conformal = " 0 4\n" if c == 4 else ""
    lines = MODULE
    for k, y in enumerate(POSITIONS):
        first = k == 0
        lines += f" 12{b}3100\n" + (f" 00{d}{c}{m}33\n 0000101\n" if first else f" 0101{m}02\n 0100101\n")
        if first:
            lines += f" 999 100 30 10 {eps} 200000\n 0.3 0.3\n{conformal} 0.28 0.28 82000. 82000.\n{flexibility}"
            lines += f" {dx} {dx} 1.0 90d 8.0 4.0\n 14.0 0 1435.0 0.025\n"
            lines += f" '{TOP}/examples/profiles/60E1.prr' 0 1.0 0.0\n 0 0 0 0 0 0\n 1360.0 -70.0 460.0\n"
            lines += f" '{TOP}/examples/profiles/S1002.prw' 0 1.0 0.0\n"
        lines += f" 0.0 {y} 60000. 0.0 {1e-3*y:.6f} 0.0\n 20000. 0 0 0 0 {-20000.0/460.0:.8f}\n"
        lines += MODULE if k < len(POSITIONS) - 1 else "0 END\n"
    return lines


def forces(**choices):
    """Seconds of processor for one position, and FX, FY, PMAX of all"""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "choice.inp"
        path.write_text(text(**choices))
        times = []
        for _ in range(RUNS):
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            done = subprocess.run([PROGRAM, "--json=-", "2", "choice"], cwd=folder, capture_output=True, text=True)
            times.append(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before)
        if done.returncode:
            raise SystemExit(done.stdout + done.stderr)
        cases = [case for case in map(json.loads, done.stdout.splitlines()) if case.get("patches")]
        found = [(case["totals"]["fx_tr"]["value"], case["totals"]["fy_tr"]["value"],
                  max(patch["totals"]["pmax"]["value"] for patch in case["patches"])) for case in cases]
        return statistics.median(times)/len(POSITIONS), found


def main():
    """One line for each choice, as the page has them"""
    _, fine = forces(dx=0.1)
    rows = [dict(dx=1.0), dict(dx=0.5), dict(), dict(d=3), dict(d=4), dict(d=5), dict(d=7), dict(d=4, c=4), dict(b=5), dict(b=6),
            dict(m=3), dict(m=5), dict(dx=0.5, b=5, m=3), dict(dx=0.5, eps=1e-3), dict(dx=0.5, eps=1e-7)]
    for choices in rows:
        seconds, found = forces(**choices)
        errors = [((x - u)**2 + (y - v)**2)**0.5/60e3 for (x, y, _), (u, v, _) in zip(found, fine)]
        peaks = [abs(p/q - 1.0) for (_, _, p), (_, _, q) in zip(found, fine)]
        name = ", ".join(f"{key.upper()} = {value:g}" for key, value in choices.items()) or "B = 0, M = 0, D = 2, DX = 0.2"
        middle, largest, peak = (100*value for value in (statistics.median(errors), max(errors), statistics.median(peaks)))
        print(f"| {name} | {1e3*seconds:.2g} | {middle:.2g} | {largest:.2g} | {peak:.2g} |")


if __name__ == "__main__":
    main()
