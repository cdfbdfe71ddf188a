"""Writes doc/validation/hard_cases.md from the tables of the last run of the tests:

    ctest --test-dir build/release -L stability && python3 tests/stability/hard_cases.py build/release
"""
import os
import sys

GROUPS = ["friction", "shapes", "grids", "coupling", "rough", "sequences", "solvers", "numbers"]
#: Cases of a group that are listed by products, and by what the direct sums find
LISTED = 3

TEXT = """# Hard cases

    ctest --test-dir build/release -L stability
    python3 tests/stability/hard_cases.py build/release

The first command runs the tests, which write one line per case into `build/release/tests/scratch/hard_*/table.md`; the
second one writes this file from them: numbers per group, and the worst cases.

Every case must have a right answer or end with a clear statement (an error, or a report that is not
"converged" and a message). Answers are checked by the contact conditions, evaluated from the fields of
the result by direct sums over influence coefficients, without FFT and without anything a solver left
behind: no tension, gap zero in contact and not negative outside, tractions within their bounds, zero slip
in adhesion, slip opposite to traction, prescribed forces met. See `tests/stability/hard_case.f90`.

EPS is 1e-6, and the bodies are steel with mu 0.3, unless the name of a case states otherwise. Products are those with the
compliance on the finest grid, over all outer passes. "Recomputed" is the largest violation that the direct sums find
(normal gap or friction law). Sweeps and gradients stop when the tractions no longer change by EPS (1e-5 in the group
"solvers"): their true residual may be larger by some factor. In "coupling" it includes what the outer
iteration leaves; with MAXOUT 1 (Johnson) nothing is iterated.
"""


def read(name, build):
    """Title of a group and its cases"""
    path = os.path.join(build, "tests", "scratch", "hard_" + name, "table.md")
    try:
        with open(path, encoding="utf-8") as file:
            lines = file.read().splitlines()
    except OSError:
        sys.exit(f"hard_cases.py: {path} is missing; run ctest -L stability first")
    cases = []
    for line in lines[4:]:
        cell = [word.strip() for word in line.split("|")]
        if len(cell) < 12:
            continue
        refused = cell[10].startswith("refused")
        cases.append(dict(name=cell[1], contact=cell[2], method=cell[5], iterations=cell[6], residual=cell[8], ended=cell[10],
                          refused=refused, products=0 if refused else int(cell[7]),
                          recomputed=0.0 if refused else float(cell[9])))
    return lines[0].lstrip("# "), cases


def handed_over(case):
    return ", then " in case["method"]


def failed(case):
    return not case["refused"] and case["ended"] != "converged"


def listed(cases):
    """Cases that did not converge or were handed over, and the worst of the others"""
    solved = [case for case in cases if not case["refused"]]
    chosen = [case for case in solved if failed(case) or handed_over(case)]
    for measure in "products", "recomputed":
        chosen += sorted((case for case in solved if not failed(case)), key=lambda case: -case[measure])[:LISTED]
    return [case for case in solved if any(case is other for other in chosen)]


def report(build):
    groups = [(name, *read(name, build)) for name in GROUPS]
    out = [TEXT, ("| group | cases | refused | solved by a fall-back | not converged, as reported | products: mean | largest | "
           "recomputed: largest of the converged |"), "|---|---|---|---|---|---|---|---|"]
    for name, _, cases in groups:
        solved = [case for case in cases if not case["refused"]]
        products = [case["products"] for case in solved]
        out.append(f"| {name} | {len(cases)} | {len(cases) - len(solved)} | {sum(map(handed_over, solved))} | "
                   f"{sum(map(failed, solved))} | {sum(products)/len(products):.0f} | {max(products)} | "
                   f"{max(case['recomputed'] for case in solved if not failed(case)):.1e} |")
    for name, title, cases in groups:
        out += ["", f"## {title} ({name})", "",
                "| case | contact | method | iterations | products | residual | recomputed | ended |",
                "|---|---|---|---|---|---|---|---|"]
        for case in listed(cases):
            out.append(f"| {case['name']} | {case['contact']} | {case['method']} | {case['iterations']} | {case['products']} | "
                       f"{case['residual']} | {case['recomputed']:.1e} | {case['ended']} |")
        refused = {}
        for case in cases:
            if case["refused"]:
                refused.setdefault(case["ended"], []).append(case["name"])
        out += [f"\nRefused ({len(names)}), for instance \"{names[0]}\": {why.split(': ', 1)[1]}."
                for why, names in refused.items()]
    return "\n".join(out) + "\n"


def main():
    build = sys.argv[1] if len(sys.argv) > 1 else "build/release"
    text = report(build)
    top = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    with open(os.path.join(top, "doc", "validation", "hard_cases.md"), "w", encoding="utf-8") as file:
        file.write(text)


main()
