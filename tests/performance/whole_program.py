"""Time of the whole program for a creep-force table of 3,000 cases, the best of three runs: whole_program.py CONTACT BENCH"""
import os
import resource
import subprocess
import sys
import tempfile

CASES, ROUNDS = 3000, 3
GOALS = {11: 0.25, 19: 1.0, 25: 2.0, 35: 5.0}

contact, bench = (os.path.abspath(name) for name in sys.argv[1:3])
if not os.path.exists(contact):
    print("SKIPPED the whole program: there is no bin/contact")
    sys.exit(77)
print("| whole program, 3,000 cases, O=1 | ms per case | goal |\n|---|---|---|")
with tempfile.TemporaryDirectory() as folder:
    for grid, goal in GOALS.items():
        subprocess.run([bench, "--input", str(grid), "table.inp"], cwd=folder, check=True)
        seconds = []
        for _ in range(ROUNDS):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            done = subprocess.run([contact, "2", "table"], cwd=folder, capture_output=True, text=True)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            if done.returncode:
                break
            seconds.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
        if done.returncode:
            print(f"| {grid} x {grid} | failed: {(done.stderr or done.stdout).strip().splitlines()[-1:]} | |")
            continue
        ms = 1000*min(seconds)/CASES
        print(f"| {grid} x {grid} | {ms:.2f} | <= {goal} ms: {'met' if ms <= goal else 'MISSED'} |", flush=True)
