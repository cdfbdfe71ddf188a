"""Measures a table of creep forces against Fastsim, FaStrip and the full theory, over contacts of a hunting wheelset.

usage: compare_tables.py TABLE; PYTHONPATH and CONTACT_LIBRARY as for tests. Prints the table of doc/validation/tables.md.
"""
import sys
import time

import contact
import numpy as np
from bases import rolling
from contact.table import Table

STEPS, MU, GG, NU = 300, 0.35, 82000.0, 0.28


def history():
    """Normal force, semi-axes, creepages and spin of a wheel at 30 m/s over two waves of hunting with growing amplitude"""
    t = np.linspace(0.0, 1.0, STEPS)
    y = 6.0 * t * np.sin(4.0 * np.pi * t)
    flange = np.clip((np.abs(y) - 3.0) / 3.0, 0.0, 1.0)
    fn = 60e3 + 12e3 * np.sin(11.0 * np.pi * t)
    c = 5.0 * (fn / 60e3)**(1.0 / 3.0)
    ratio = 1.2 + 1.5 * flange
    cksi = 4e-4 * y + 1e-4 * np.sin(20.0 * np.pi * t)
    ceta = -3e-3 * np.cos(4.0 * np.pi * t) * t
    cphi = (0.05 + 0.6 * flange) / 460.0
    return fn, c * np.sqrt(ratio), c / np.sqrt(ratio), cksi, ceta, cphi


def solve(given, elements, order=1, theory="elastic", pressure="full"):
    """Forces, and processor time of a contact [us]"""
    fn, aa, bb, cksi, ceta, cphi = given
    base = rolling(elements)
    base["pressure"] = pressure
    base["iteration"] = {"order": order}
    base["material_model"] = theory
    base["material"].update(gg=[GG, GG], poiss=[NU, NU])
    if theory == "fastsim":
        # no reduction of the slope
        base["material"].update(k0_mf=1.0, alfamf=1.0, betamf=1.0)
    base["friction"] = {"fstat": MU, "fkin": MU}
    base["grid"]["scale"] = 1.05
    varied = {"kinematics.fn": fn, "kinematics.cksi": cksi, "kinematics.ceta": ceta, "kinematics.cphi": cphi, "grid.aa": aa,
              "grid.bb": bb}
    study = contact.Study(base, contact.study.table(varied))
    begun = time.process_time()
    found = study.run(workers=1, progress=False)
    spent = 1e6 * (time.process_time() - begun) / len(fn)
    assert not study.failures(found), study.failures(found)
    return np.column_stack([found.fx, found.fy, found.mz]), spent


def main():
    given = history()
    fn, aa, bb, *creep = given
    true, spent = solve(given, 45, 2)
    limit = MU * fn
    rows = [("full theory, 45 x 45, order 2", true, spent)]
    with Table(sys.argv[1]) as table:
        ratio = table.facts.ratio
        assert (aa / bb).min() > ratio[0] and (aa / bb).max() < ratio[1]
        begun = time.process_time()
        for _ in range(50):
            forces = table.force(fn, MU, GG, aa, bb, *creep)
        rows.append(("table", forces, 1e6 * (time.process_time() - begun) / 50 / STEPS))
    for words, options in (("full theory, 19 x 19, order 2", {"elements": 19, "order": 2}),
                           ("full theory, 19 x 19, order 1", {"elements": 19}),
                           ("FaStrip, 19 x 19", {"elements": 19, "theory": "fastrip_plain", "pressure": "elliptical"}),
                           ("Fastsim, 19 x 19", {"elements": 19, "theory": "fastsim", "pressure": "parabolical"})):
        rows.append((words, *solve(given, **options)))
    print("| | us a contact | largest error of the forces, % of mu Fn | mean | largest error of the moment, % of mu Fn c |")
    print("|---|---|---|---|---|")
    for words, forces, spent in rows:
        error = 100.0 * np.hypot(*(forces - true)[:, :2].T) / limit
        moment = 100.0 * np.abs((forces - true)[:, 2]) / (limit * np.sqrt(aa * bb))
        print(f"| {words} | {spent:.2f} | {error.max():.2f} | {error.mean():.2f} | {moment.max():.2f} |")


if __name__ == "__main__":
    main()
