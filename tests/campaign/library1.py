"""Solve a scene of module 1 by the library: prints one JSON list, a dictionary per case.

    library1.py SCENE.json FOLDER

The profiles are files of FOLDER; the input files that the library writes go there, too. CONTACT_LIBRARY and PYTHONPATH tell
where the library and its package are.
"""
import json
import os
import sys

import contact
import numpy as np
import profiles
import scene1
from contact import cntc
from contact.wheel_rail import WheelRail

MOTION = {0: "frictionless", 1: "shift", 2: "transient", 3: "steady"}
MATERIAL = {0: [], 1: [0.5, 0.5, 0.001, 0.001], 2: [1e-4, 0.5, 0.8, 1.0], 3: [0.5, 0.8, 1.0], 4: [10000.0, 0.02, 0.0, 0.0],
            5: [0.5, 0.8, 1.0]}


def settings(pair, scene):
    """Settings that are the same in all cases"""
    digits = scene["digits"]
    pair.set_flags(if_wrtinp=1, ic_bound=digits["B"], ic_discns=digits["D"], ic_inflcf=digits["C"], ic_norm=digits["N"],
                   ic_force=digits["F"])
    # of order 1, as the program solves an .inp file
    pair.set_solver(eps=scene1.EPS, order=1, maxgs=999, maxin=100, maxnr=scene1.TRIALS,
                    maxout=20 if scene1.coupled(scene) else 1)
    nu1, nu2, g1, g2 = scene["materials"]
    pair.set_material(g1, nu1, g2, nu2, digits["M"], MATERIAL[digits["M"]])
    pair.set_friction_law(digits["L"], scene1.law(scene) + ([0.01, 100.0] if digits["L"] >= 2 else []))
    dx, ds, dq, angle, apart, together = scene["grid"]
    pair.set_grid(dx, ds, a_sep=np.deg2rad(angle), d_sep=apart, d_comb=together, step=dq)
    for kind, body in enumerate(("rail", "wheel")):
        line, held = profiles.files(scene["pair"][body], body)
        words = line.split()
        method = scene["pair"][body].get("smooth") or [0, 0.0]
        name = next(name for name in held if name == words[0].strip("'"))
        cntc.setprofileinputfname(pair.number, os.path.abspath(name), [kind, 0, int(words[1]), int(words[4]), 0, method[0]],
                                  [float(words[2]), method[1], 0.5, np.deg2rad(150.0), np.deg2rad(30.0), np.deg2rad(6.0), 2.0])
    pair.set_wheelset(*scene["pair"]["wheelset"])


def track(pair, scene, case):
    sign = -1.0 if scene["side"] == "left" else 1.0
    height, first, second, cant = scene["pair"]["track"]
    if scene["roller"]:
        cant = 0.0  # the input of a roller has none
    deviation = scene1.signed(case["deviation"], "deviation", sign)
    more = {"roller_radius": scene["roller"], "curvature": sign * scene.get("curve", 0.0), "deviation": deviation}
    if height > 0.0:
        pair.set_track(height, second, cant, gauge_sequence=0, **more)
    else:
        pair.set_rail_position(sign * first, second, cant, **more)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        scene = json.load(file)
    folder = sys.argv[2]
    os.chdir(folder)
    contact.output_to(folder, "through")
    digits, sign, answers = scene["digits"], -1.0 if scene["side"] == "left" else 1.0, []
    with WheelRail(scene["side"], roller=bool(scene["roller"]), motion=MOTION[digits["T"]]) as pair:
        settings(pair, scene)
        for case in scene["cases"]:
            track(pair, scene, case)
            if digits["N"]:
                pair.set_vertical_force(case["fz"])
                pair.set_position(case["s"], sign * case["y"], None, sign * case["roll"], sign * case["yaw"], case["pitch"])
            else:
                pair.set_position(case["s"], sign * case["y"], case["z"], sign * case["roll"], sign * case["yaw"], case["pitch"])
            pair.set_velocity(*scene1.signed(case["speed"], "speed", sign))
            if digits["F"] == 1:
                cntc.settangentialforces(pair.number, -1, case["fx"] * scene["friction"][0] * case["fz"], 0.0)
            if case.get("flexible"):
                flexible = scene1.signed(case["flexible"], "flexible", sign)
                pair.set_flexibility(flexible[:6], flexible[6:])
            try:
                result = pair.solve(initiation=case["p"] == 2)
            except contact.ContactError as error:
                answers.append({"error": str(error)})
                break
            if result.reason.startswith("force,"):
                answers.append({"error": result.reason})
                break
            patches = [{"place": list(map(float, patch.location[:4])), "fn": patch.fn, "fx": patch.fx, "pen": patch.approach,
                        "pmax": patch.max_pressure} for patch in result.patches]
            answers.append({"force": list(map(float, result.forces.track.force)), "z_ws": float(result.wheelset_position[2]),
                            "patches": patches})
    print(json.dumps(answers))


if __name__ == "__main__":
    main()
