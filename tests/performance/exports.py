"""Cost of files for other programs, also in runs without them: exports.py CONTACT [BEFORE]

A table of creep forces of 11 x 13 elements, and one of normal forces, in which every field changes: processor time per
case (the best of three runs), size of the files, and system calls of one more case. BEFORE is another program, for example
one without such files, with which a run without options is compared.
"""
import os
import resource
import shutil
import subprocess
import sys
import tempfile

CASES, ROUNDS = 3000, 3
WAYS = ((), ("--json",), ("--hdf5",))
FIRST = ("3\n203100\n022020\n0000001\n999 100 30 1 1e-5\n{fn} {creep} 0 0\n0.3 0.3\n0 0.2 1000\n0.28 0.28 82000 82000\n"
         "1\n13 11 -1.3 -1.1 0.2 0.2\n1 1\n0.01 0 0.01 0 0 0\n")
NEXT = "3\n203100\n100000\n0110001\n{fn} {creep} 0 0\n"

programs = [os.path.abspath(name) for name in sys.argv[1:]]
if not programs or not os.path.exists(programs[0]):
    print("SKIPPED files for other programs: there is no bin/contact")
    sys.exit(77)


def write_table(path, cases, kind):
    with open(path, "w") as file:
        for k in range(cases):
            fn, creep = (2000, -1e-6 * k) if kind == "creepages" else (2000 + 0.05 * k, -1e-3)
            file.write((NEXT if k else FIRST).format(fn=fn, creep="%.9f" % creep))
        file.write("0\n")


def seconds(command, folder):
    """Processor time of a run"""
    start = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL)
    end = resource.getrusage(resource.RUSAGE_CHILDREN)
    return end.ru_utime + end.ru_stime - start.ru_utime - start.ru_stime


def calls(program, way, folder):
    """System calls of one more case; None without strace"""
    if not shutil.which("strace"):
        return None
    found = []
    for cases in (100, 200):
        write_table(os.path.join(folder, "short.inp"), cases, "creepages")
        done = subprocess.run(["strace", "-f", "-qq", program, "--quiet", *way, "2", "short"], cwd=folder, capture_output=True,
                              text=True, errors="replace", check=True)
        found.append(len(done.stderr.splitlines()))
    return (found[1] - found[0]) / 100


print("| 11 x 13 elements, %d cases | option | ms per case | kB per case | system calls per case |\n|---|---|---|---|---|" % CASES)
for kind in ("creepages", "forces"):
    rows = [(programs[0], way) for way in WAYS] + [(program, ()) for program in programs[1:]]
    best = [float("inf")] * len(rows)
    sizes = [0] * len(rows)
    with tempfile.TemporaryDirectory() as folder:
        write_table(os.path.join(folder, "table.inp"), CASES, kind)
        # alternately, so that the conditions of the machine are the same
        for _ in range(ROUNDS):
            for k, (program, way) in enumerate(rows):
                best[k] = min(best[k], seconds([program, "--quiet", *way, "2", "table"], folder))
                files = [os.path.join(folder, name) for name in os.listdir(folder) if name.startswith("table.")
                         and not name.endswith(".inp")]
                sizes[k] = sum(os.path.getsize(name) for name in files)
                for name in files:
                    os.remove(name)
        for k, (program, way) in enumerate(rows):
            count = calls(program, way, folder)
            print("| %s | %s | %.2f | %.1f | %s |" % (kind, " ".join(way)
                                                      or ("none" if program == programs[0] else "none, " + sys.argv[2]),
                                                      1e3 * best[k] / CASES, sizes[k] / CASES / 1e3, "-" if count is None
                                                      else "%.1f" % count), flush=True)
