"""Time of the whole program on typical user inputs, beside goals, the best of three runs: asked_inputs.py CONTACT SOURCE

With --instructions smaller inputs of the same kinds run under valgrind, whose counts do not depend on other processes: each
must stay below its known count, with a margin for other compilers and libraries.
"""
import math
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile

ROUNDS = 3
#: A ball of 500 mm radius under 30 kN, in contact within a radius of 4.62 mm
RADIUS, FORCE, CONTACT = 500.0, 30000.0, 4.62
GD_STEADY = "1.0 0.05 1 2.0 -1.0 1.0 2.6 1.0\n"
RELAXED = "0.9 1.0 0 0.5\n"


def ball(n, motion=0, solver=0, numbers="", creepages="0 0 0"):
    """One case on n x n elements; the contact takes nine tenths of the width"""
    side = 2.2*CONTACT
    rolling = f"0 {side/n:.9g} 30000\n" if motion == 3 else ""
    return (f"3\n20{motion}100\n022020\n0{solver}00101\n999 100 30 1 1e-7\n{numbers}{FORCE} {creepages}\n0.3 0.3\n{rolling}"
            f"0.28 0.28 82000 82000\n1\n{n} {n} {-side/2} {-side/2} {side/n:.9g} {side/n:.9g}\n1 1\n"
            f"{1/(2*RADIUS)} 0 {1/(2*RADIUS)} 0 0 0\n0\n")


def remembering(sizes):
    """The ball, of a material that relaxes over 4 mm, rolling on n x n elements for each n"""
    def one(n):
        side = 2.2*CONTACT
        return (f"3\n203100\n022120\n0000101\n999 100 30 1 1e-5\n{FORCE/2} 5e-4 0 3e-4\n0.3 0.3\n0 {side/n:.9g} 2000\n"
                f"0.28 0.28 82000 82000\n1 1 0.002 0.002\n1\n{n} {n} {-side/2} {-side/2} {side/n:.9g} {side/n:.9g}\n1 1\n"
                f"{1/(2*RADIUS)} 0 {1/(2*RADIUS)} 0 0 0\n")
    return "".join(one(n) for n in sizes) + "0\n"


def wheel(digits, size, places):
    """S1002 on 60E1 under 50 kN, from the middle of the track to one side"""
    head = (f"1\n{digits}\n0022033\n0000101\n999 100 30 1 1e-5\n0.3 0.3\n0.28 0.28 82000 82000\n"
            f"{size} {size} 1.0 90d 8.0 4.0\n14 0 1435 0.025\n'60E1.prr' 0 1.0 0.0\n"
            "0 0 0 0 0 0\n1360 -70 460\n'S1002.prw' 0 1.0 0.0\n0 {y:.6g} 50000 0 {yaw:.6g} 0\n20000 0 0 0 0 -43.5\n")
    kept = f"1\n{digits}\n0111002\n0100101\n" + "0 {y:.6g} 50000 0 {yaw:.6g} 0\n20000 0 0 0 0 -43.5\n"
    shares = [k/(places - 1) for k in range(places)]
    return "".join((kept if k else head).format(y=6.0*share, yaw=0.014*share) for k, share in enumerate(shares)) + "0\n"


def flat(places):
    """A wheel that rolls over its flat, 125 kN"""
    head = ("1\n1250100\n0022033\n0000101\n999 100 30 1 1e-5\n0.3 0.3\n0.28 0.28 82000 82000\n0.4 0.4 1.0 90d 8.0 4.0\n"
            "14 0 1435 0.025\n'60E1.prr' 0 1.0 0.0\n0 0 0 0 0 0\n1360 -70 460\n'flat.slcw' 0 1.0 0.0\n"
            "0 0 125000 0 0 {pitch:.4f}d\n2000 0 0 0 0 -4.35\n")
    kept = "1\n1250100\n0111002\n0100101\n0 0 125000 0 0 {pitch:.4f}d\n2000 0 0 0 0 -4.35\n"
    return "".join((kept if k else head).format(pitch=-12.0 + 24.0*k/(places - 1)) for k in range(places)) + "0\n"


#: Name, cases, unit of the goal in seconds, goal in this unit
ROWS = [("normal problem, 3,000 elements", ball(68), 1, "ms", 8.0),
        ("normal problem, 201,000 elements", ball(557), 1, "s", 0.7),
        ("steady rolling with G = 5, 13,000 elements", ball(142, 3, 5, GD_STEADY, "5e-4 0 3e-4"), 1, "s", 0.3),
        ("steady rolling with G = 5, 51,000 elements", ball(281, 3, 5, GD_STEADY, "5e-4 0 3e-4"), 1, "s", 1.3),
        ("steady rolling with G = 3, 13,000 elements", ball(142, 3, 3, RELAXED, "5e-4 0 3e-4"), 1, "s", 0.3),
        ("shift with G = 3, 13,000 elements", ball(142, 1, 3, RELAXED, "5e-3 0 1e-3"), 1, "s", 0.3),
        ("wheel on rail, KPEC, 0.2 mm, per case", wheel("1250100", 0.2, 201), 201, "ms", 2.0),
        ("wheel on rail, ANALYN, 0.2 mm, per case", wheel("1260100", 0.2, 201), 201, "ms", 2.0),
        ("wheel flat, KPEC, 0.4 mm, 196 positions", flat(196), 1, "s", 2.0)]


#: Name, and known millions of instructions without the start of the program
COUNTED = [("normal problem, 3,000 elements", ball(68), 22),
           ("steady rolling with G = 5, 3,000 elements", ball(68, 3, 5, GD_STEADY, "5e-4 0 3e-4"), 93),
           ("wheel on rail, KPEC, 0.2 mm, 5 positions", wheel("1250100", 0.2, 5), 82),
           ("wheel on rail, ANALYN, 0.2 mm, 5 positions", wheel("1260100", 0.2, 5), 73),
           ("wheel on rail, KPEC, 1.0 mm, 41 positions", wheel("1250100", 1.0, 41), 75),
           ("wheel flat, KPEC, 0.4 mm, 5 positions", flat(5), 313),
           ("rolling of a material that relaxes, two grids, three times each", remembering((50, 58)*3), 489)]
#: The start alone, with HDF5 linked statically: its shared library may load many others. It is that of --help, as --version and
#: runs with --hdf5 initialise HDF5, which takes 1.9 million in HDF5 1.10, 2.9 in HDF5 2.2
START = 1.8
#: Fraction by which a count may exceed the known one
MARGIN = 0.15


def instructions(contact, folder, text=None):
    """Millions of instructions of a run, or of the start alone, or None"""
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", contact]
    if text is None:
        command += ["--help"]
    else:
        command += ["--strict", "2", "x"]
        with open(os.path.join(folder, "x.inp"), "w", encoding="utf-8") as file:
            file.write(text)
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, env=dict(os.environ, OMP_NUM_THREADS="1"))
    told = re.search(r"refs: +([0-9,]+)", done.stderr)
    return int(told.group(1).replace(",", ""))/1e6 if told and not done.returncode else None


def judge_instructions(contact, folder):
    """Print counts beside their limits; the exit status"""
    if shutil.which("valgrind") is None:
        print("SKIPPED: valgrind is not installed")
        return 77
    start, status = instructions(contact, folder), 0
    if start is None:
        print("FAILED: the program does not start under valgrind")
        return 1
    print("| one thread | million instructions | when it was measured |\n|---|---|---|")
    counts = [(name, instructions(contact, folder, text), start, known) for name, text, known in COUNTED]
    if "libhdf5" not in subprocess.run(["ldd", contact], capture_output=True, text=True, check=False).stdout:
        counts.append(("start of the program", start, 0.0, START))
    for name, count, before, known in counts:
        good = count is not None and count - before <= (1 + MARGIN)*known
        print(f"| {name} | {count and round(count - before, 1)} | {known}{'' if good else ': TOO MANY'} |", flush=True)
        status = status or int(not good)
    return status


def seconds(contact, folder, text):
    """Processor time of the best run, or the error message"""
    with open(os.path.join(folder, "x.inp"), "w", encoding="utf-8") as file:
        file.write(text)
    best = math.inf
    for _ in range(ROUNDS):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([contact, "--strict", "2", "x"], cwd=folder, capture_output=True, text=True,
                              env=dict(os.environ, OMP_NUM_THREADS="1"))
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode:
            return None, (done.stderr or done.stdout).strip().splitlines()[-1:]
        best = min(best, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
        if best > 10.0:
            break
    return best, []


def main():
    contact, source = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    if not os.path.exists(contact):
        print("SKIPPED the whole program: there is no bin/contact")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(os.path.join(source, "examples", "profiles"), folder, dirs_exist_ok=True)
        if sys.argv[3:] == ["--instructions"]:
            return judge_instructions(contact, folder)
        print("| whole program, one thread | time | goal |\n|---|---|---|")
        for name, text, cases, unit, goal in ROWS:
            best, complaint = seconds(contact, folder, text)
            if best is None:
                print(f"| {name} | failed: {complaint} | |")
                continue
            time = best/cases*(1000 if unit == "ms" else 1)
            print(f"| {name} | {time:.2f} {unit} | <= {goal} {unit}: {'met' if time <= goal else 'MISSED'} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
