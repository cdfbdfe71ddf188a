"""Solve a scene of module 3 by the library, with one set of calls per case. usage: library3.py SCENE.json ANSWER.json

The answer has per case the code of cntc_calculate, forces, approach, creepages and tractions. Environment:
CONTACT_LIBRARY; the library writes what it solved as library.inp.
"""
import json
import os
import sys

from contact import cntc
from contact._library import last_error
from contact.cntc import CNTC

IRE, ICP = 1, 1


def flags(**values):
    cntc.setflags(IRE, ICP, [CNTC[name] for name in values], list(values.values()))


def set_solver(scene):
    g, limits, eps = scene["digits"]["G"], [999, scene["maxin"], 60, scene["maxout"]], scene["eps"]
    o = scene["omega"]
    if g in (2, 3):
        cntc.setsolverflags(IRE, ICP, g, limits + [int(o[2])], [eps, o[0], o[1], o[3]])
    elif g == 4:
        cntc.setsolverflags(IRE, ICP, g, limits + [int(o[0])], [eps, o[1]])
    elif g == 5:
        cntc.setsolverflags(IRE, ICP, g, limits + [int(o[2])], [eps, o[0], o[1]] + o[3:])
    else:
        cntc.setsolverflags(IRE, ICP, 0, limits, [eps])


def set_problem(scene):
    """Settings that are the same in all cases"""
    d, grid = scene["digits"], scene["grid"]
    flags(if_units=CNTC["un_cntc"], ic_tang=d["T"], ic_bound=d["B"], ic_inflcf=d["C"], ic_output=2, ic_matfil=0)
    cntc.setmaterialparameters(IRE, ICP, d["M"], scene["nu"] + scene["g"] + scene.get("material", []))
    cntc.setfrictionmethod(IRE, ICP, d["L"], scene["friction"][0] + scene.get("memory", []))
    if d["T"] >= 2:
        chi, dq, veloc = scene["rolling"]
        cntc.setreferencevelocity(IRE, ICP, veloc)
        cntc.setrollingstepsize(IRE, ICP, chi, dq)
    if d["H"]:
        cntc.settemperaturedata(IRE, ICP, 3, scene["heat"][0] + scene["heat"][1] + [0.5])
    size = [grid["mx"], grid["my"]]
    if grid["ipotcn"] < 0:
        cntc.sethertzcontact(IRE, ICP, grid["ipotcn"], size + grid["values"])
    else:
        cntc.setpotcontact(IRE, ICP, 1, size + [grid["xl"], grid["yl"], grid["dx"], grid["dy"]])
        cntc.setundeformeddistc(IRE, ICP, grid["ibase"], grid["gap"])
    set_solver(scene)


def solve(scene, k):
    """Solve case k; returns its results"""
    case = scene["cases"][k]
    # cntc_sethertzcontact has set B = 2 for line contacts; cntc_setextrarigidslip sets E = 9
    flags(ic_bound=scene["digits"]["B"], ic_pvtime=case["P"], ic_iestim=case["I"], ic_norm=case["N"], ic_force=case["F"])
    if scene["digits"]["E"] in (2, 3):
        flags(ic_exrhs=scene["digits"]["E"])
    if case["N"]:
        cntc.setnormalforce(IRE, ICP, case["load"])
    else:
        cntc.setpenetration(IRE, ICP, case["load"])
    cntc.setcreepages(IRE, ICP, case["x"] if case["F"] < 1 else 0.0, case["y"] if case["F"] < 2 else 0.0, case["phi"])
    if case["F"]:
        cntc.settangentialforces(IRE, ICP, case["x"], case["y"] if case["F"] == 2 else 0.0)
    if "extra" in case:
        cntc.setextrarigidslip(IRE, ICP, [pair[0] for pair in case["extra"]], [pair[1] for pair in case["extra"]])
    code = cntc.calculate(IRE, ICP, idebug=0)
    message = last_error(IRE, ICP)[1]
    fn, fx, fy, mz = cntc.getcontactforces(IRE, ICP)
    pn, px, py = cntc.gettractions(IRE, ICP)
    return {"code": int(code), "message": message, "fn": fn, "fx": fx, "fy": fy, "mz": mz, "pen": cntc.getpenetration(IRE, ICP),
            "creepages": list(cntc.getcreepages(IRE, ICP)), "pn": pn.tolist(), "px": px.tolist(), "py": py.tolist(),
            "eldiv": cntc.getelementdivision(IRE, ICP).tolist()}


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        scene = json.load(file)
    cntc.initlibrary(outdir=os.getcwd(), expnam="library", idebug=0)
    cntc.setglobalflags([CNTC["if_idebug"], CNTC["if_openmp"]], [0, 1])
    cntc.initialize(IRE, 3, idebug=0)
    flags(if_wrtinp=1)
    set_problem(scene)
    code, message = last_error(IRE, ICP)
    if code:
        sys.exit(f"a setting was refused: {code} {message}")
    answer = [solve(scene, k) for k in range(len(scene["cases"]))]
    cntc.finalizelast()
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        json.dump(answer, file)


if __name__ == "__main__":
    main()
