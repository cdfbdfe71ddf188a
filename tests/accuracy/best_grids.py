"""Cost of --accuracy beside the fastest fixed grid of each contact: python3 best_grids.py [--count N] [--wheels N] [--seed S]

The contacts of asked.py with the same seed. Each is solved with --accuracy, and on fixed grids from coarse to fine, with second
order where it applies, without estimates and with the same tolerance of the solvers, until the true error is below the request;
for a series in each of its cases. Times are user and system time of a process with one contact, the smallest of several runs,
without that of a process that solves nothing; they include influence coefficients and plans of transforms. With --further they are
those of one more contact in the same file, which reuses plans, and on a fixed grid also coefficients. --instructions replaces
times by counts of valgrind, which do not depend on other processes. The output is the ratio of the sums by accuracy and kind.
CONTACT_PROGRAM names the program.
"""
import math
import os
import random
import re
import resource
import subprocess
import tempfile
from pathlib import Path

from asked import FIXED, FIXED_WHEELS, error_of, exact_totals, parser_of, value_of, wheel_error, wheel_of
from cost import processor_time
from error_cases import PROFILES, contact, some_wheels, text_of, wheel_text
from errors import patch_of, run

#: Number of further copies of a contact, and of repeated runs
COPIES, RUNS = 4, 3
#: Time of a process that solves nothing [s], whether further contacts are measured, and whether instructions are counted
START = {"seconds": 0.0, "further": False, "instructions": False}
#: Instructions counted as one second
PER_SECOND = 1e9
#: Finer grids than those of asked.py, for kinds of first order
FINEST = (190, 226, 270, 320)


def cpu_of(*what):
    """Records of a run and its processor time [s]."""
    def used():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    before = used()
    records = run(*what)
    return records, used() - before


def counted(program, folder, name, options=()):
    """Instructions of a run of an existing file, as seconds."""
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", program, *options, "--quiet", "--json", "2", name]
    done = subprocess.run(command, cwd=folder, env=dict(os.environ, OMP_NUM_THREADS="1"), capture_output=True, text=True)
    return int(re.search(r"refs: +([0-9,]+)", done.stderr).group(1).replace(",", "")) / PER_SECOND


def seconds_of(program, folder, text, options):
    """Records of one contact, and its time or that of one more of them [s]."""
    if START["instructions"]:
        records = run(program, folder, "one", [text], False, options)
        one = counted(program, folder, "one", options)
        if not START["further"]:
            return records, one - START["seconds"]
        run(program, folder, "more", [text] * (1 + COPIES), False, options)
        return records, (counted(program, folder, "more", options) - one) / COPIES
    if not START["further"]:
        runs = [cpu_of(program, folder, "one", [text], False, options) for _ in range(RUNS)]
        return runs[0][0], max(0.0, min(seconds for _, seconds in runs) - START["seconds"])
    records, one = cpu_of(program, folder, "one", [text], False, options)
    _, more = cpu_of(program, folder, "more", [text] * (1 + COPIES), False, options)
    return records, max(0.0, more - one) / COPIES


def compare(text_at, sizes, error, program, folder, tolerance):
    """Seconds, true error and report with --accuracy; seconds and size of the fastest fixed grid, infinite for none."""
    records, seconds = seconds_of(program, folder, text_at(sizes[len(sizes) // 2], 1e-5), ("--accuracy", str(tolerance)))
    true, told = error(records)
    for size in sizes:
        text = text_at(size, 0.1 * tolerance)
        if error(run(program, folder, "fixed", [text], False, ("--order", "2")))[0] <= tolerance:
            return seconds, true, told, seconds_of(program, folder, text, ("--order", "2"))[1], size
    return seconds, true, told, math.inf, 0


def contacts_compared(program, asked, folder):
    """Rows (kind, tolerance, result of `compare`) of random contacts."""
    source = random.Random(asked.seed)
    for c in [contact(source, asked.kinds[k % len(asked.kinds)]) for k in range(asked.count)]:
        references = [run(program, folder, "reference", [text_of(c, n, (source.random(), source.random()), 1e-7)], False,
                          ("--order", "2")) for n in (asked.reference, 2 * asked.reference)]
        exact = [exact_totals(c, [records.get(case, {}) for records in references]) for case in range(1, c["steps"] + 1)]
        if None in exact:
            continue
        offset = (source.random(), source.random())

        def error(records, c=c, exact=exact):
            told = records.get(c["steps"], {}).get("patches", [{}])[0].get("accuracy", {})
            patches = [patch_of(records, case) for case in range(1, c["steps"] + 1)]
            return max(math.inf if p is None else error_of(c, p["totals"], e[0]) for p, e in zip(patches, exact)), told

        for tolerance in asked.asked:
            yield c["kind"], tolerance, *compare(lambda n, eps, c=c, o=offset: text_of(c, n, o, eps), FIXED + FINEST, error,
                                                 program, folder, tolerance)


def wheels_compared(program, asked, folder):
    """The same for wheels on rails."""
    source = random.Random(asked.seed)
    for c in some_wheels(source, asked.wheels):
        size = asked.reference / 20.0
        texts = [wheel_text(c, f * (1.0 + 0.04 * source.random()), PROFILES) for f in (size, 2.0 * size)]
        middle, fine = (wheel_of(run(program, folder, "reference", [text], False, ("--order", "2")), 1) for text in texts)
        if None in (middle, fine) or middle["patches"] != fine["patches"]:
            continue
        exact = fine | {name: fine[name] + (fine[name] - middle[name]) / 3.0 for name in ("fx_tr", "fy_tr", "z_ws")}

        def error(records, c=c, exact=exact):
            totals = wheel_of(records, 1)
            return math.inf if totals is None else wheel_error(c, totals, exact), records.get(1, {}).get("accuracy", {})

        for tolerance in asked.asked:
            yield "wheel", tolerance, *compare(
                lambda f, eps, c=c: wheel_text(c, f, PROFILES).replace("eps = 1e-6", f"eps = {eps!r}"), FIXED_WHEELS, error,
                program, folder, tolerance)


def main():
    """Measure and print."""
    parser = parser_of(__doc__)
    parser.add_argument("--list", action="store_true", help="a line for each contact")
    parser.add_argument("--further", action="store_true", help="times of one more contact in the same file")
    parser.add_argument("--instructions", action="store_true", help="instructions [1e6] instead of times [ms]")
    asked = parser.parse_args()
    asked.kinds = asked.kinds.split(",")
    asked.asked = [float(word) for word in asked.asked.split(",")]
    program = os.environ["CONTACT_PROGRAM"]
    rows = []
    START.update(further=asked.further, instructions=asked.instructions)
    with tempfile.TemporaryDirectory() as name:
        (Path(name) / "empty.inp").write_text(" 0 MODULE\n")
        if asked.instructions:
            START["seconds"] = counted(program, name, "empty")
        else:
            START["seconds"] = min(processor_time([program, "--json", "2", "empty"], name)[0] for _ in range(3 * RUNS))
        for compared in (contacts_compared, wheels_compared):
            for row in compared(program, asked, Path(name)):
                rows.append(row)
                kind, tolerance, seconds, true, told, best, size = row
                if asked.list:
                    print(f"{kind} at {tolerance:g}: {1e3 * seconds:.1f} ms, error {true:.1e}, best {size} {1e3 * best:.1f} ms, "
                          + ", ".join(f"{key} {value_of(told, key)}" for key in told), flush=True)
    print("| requested | kind | contacts | error below [%] | no fixed grid | ms of all | best fixed grids: ms of all | ratio |\n"
          "|---|---|---|---|---|---|---|---|")
    for tolerance in asked.asked:
        for kind in ("all", *dict.fromkeys(row[0] for row in rows)):
            part = [row for row in rows if row[1] == tolerance and kind in ("all", row[0])]
            true = 100 * sum(row[3] <= tolerance for row in part) / max(1, len(part))
            found = [row for row in part if math.isfinite(row[5])]
            taken, best = (1e3 * sum(row[k] for row in found) for k in (2, 5))
            print(f"| {tolerance:g} | {kind} | {len(part)} | {true:.1f} | {len(part) - len(found)} | {taken:.1f} | {best:.1f} | "
                  f"{taken / max(best, 1e-9):.2f} |")


if __name__ == "__main__":
    main()
