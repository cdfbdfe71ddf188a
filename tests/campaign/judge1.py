"""Judges of module 1: by sums, by points on both surfaces, by motions, and by relations between cases.

Nothing here knows how the program finds contact; geometry1.py samples the surfaces.
"""
import copy
import json
import math
import os
import re
import sys

import geometry1
import judge
import numpy as np
import profiles
import scene1

SAME = 1e-7  # the same case by another interface, relative: inputs are written with 12 digits

# Known, open disagreements: judge, property of the scene or the finding, reason
OPEN = (
    ("scale", lambda scene, item: scene["digits"]["B"] == 6,
     "B = 6: the least curvature of ANALYN is 1e-4 per mm for all sizes"),
    ("force", lambda scene, item: item.get("size", 1.0) <= 1e-4,
     "grids follow the contact in whole elements: the force has steps, and a miss of up to 1e-4 counts as met"),
)

# ---- Results ---------------------------------------------------------------------------------------------

ODD_TOTALS = {"fy_tr", "fy_ws", "mx_r_tr", "mz_r_tr", "mx_w_ws", "mz_w_ws", "y_ws", "roll_ws", "yaw_ws", "dy_defl"}
ODD_PATCH = {"fy", "bar_fs", "bar_mn", "mz", "fy_rel", "ceta", "cphi", "shift_y", "rotation", "ycp_tr", "deltcp_tr", "ycp_r",
             "deltcp_r", "ycp_w"}


def plain(record, odd, sign):
    """Values of a record, converted to the right side of the track"""
    result = {}
    for name, value in record.items():
        value = value["value"] if isinstance(value, dict) else value
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            result[name] = sign * value if name in odd else value
    return result


def results(run, side):
    """Cases of a run, converted to the right side of the track: (record, totals, totals of patches)"""
    sign = -1.0 if side == "left" else 1.0
    return [(record, plain(record.get("totals", {}), ODD_TOTALS, sign),
             [plain(patch["totals"], ODD_PATCH, sign) for patch in record.get("patches", [])]) for record in run.cases]


def settled(record):
    return bool(record.get("solved")) and bool(record.get("converged"))


# ---- Judges ------------------------------------------------------------------------------------------------


def check(scene, tools):
    """Findings of all judges on a scene; those that are known get the status open and the reason"""
    findings = judged(scene, tools)
    for item in findings:
        for name, applies, reason in OPEN:
            if item["status"] == "disagreement" and item["judge"] == name and applies(scene, item):
                item.update(status="open", what=reason)
    return findings


def judged(scene, tools):
    """All judges on one scene"""
    findings = []
    run = scene1.solve(scene, tools)
    good = judge.how_it_ended(run, len(scene["cases"]), findings)
    cases = results(run, scene["side"])
    curves = None
    for number in good:
        record, totals, patches = cases[number - 1]
        case = scene["cases"][number - 1]
        state_of(scene, case, run, record, totals, patches, findings)
        if not any(patch["fn"] > 0.0 for patch in patches):
            continue
        sums(scene, case, run, number, totals, patches, findings)
        try:
            if curves is None and scene1.sampled(scene):
                curves = geometry1.curves_of(scene["pair"])
        except (ValueError, np.linalg.LinAlgError):
            curves = None
        if curves:
            placed = geometry1.Placed(scene, case, totals["z_ws"], (totals.get("dy_defl", 0.0), totals.get("dz_defl", 0.0)), curves)
            places(scene, case, placed, record, totals, patches, findings)
            motion(scene, case, placed, totals, patches, findings)
            distance(scene, run, number, placed, patches, findings)
    trials(scene, run, findings)
    if good and scene["relation"] != "none":
        RELATED[scene["relation"]](scene, tools, run, cases, findings)
    return findings


def state_of(scene, case, run, record, totals, patches, findings):
    """Check that the status of the case is correct"""
    if not settled(record):
        reason = "%s: %s" % (record.get("iteration", "?"), judge.without_numbers(str(record.get("reason", "no reason"))))
        findings.append(judge.finding("state", reason, status="not converged" if record.get("solved") else "refused"))
        return
    if scene["digits"]["N"] and patches:
        judge.exceeds(findings, "force", "FZ(TR) is not the prescribed force",
                      abs(totals["fz_tr"] - case["fz"]) / case["fz"], 1.01 * scene1.EPS)
    if scene["digits"]["N"] and not patches:
        findings.append(judge.finding("force", "no contact: " + judge.without_numbers(_warning(run)),
                                      status="refused" if _warning(run) else "disagreement"))


def _warning(run):
    match = re.search(r"Warning: .*", run.text(".out"))
    return match.group() if match else ""


def trials(scene, run, findings):
    """The search for the height takes no more trials than allowed"""
    if scene["digits"]["N"] and scene["digits"]["F"] == 0:
        most, count = 0, 0
        for line in run.text(".out").splitlines():
            count = 0 if re.match(r" ?Case +\d+", line) else count + (", NR," in line)
            most = max(most, count)
        judge.exceeds(findings, "trials", "trials for the vertical force", most, scene1.TRIALS)


def sums(scene, case, run, number, totals, patches, findings):
    """Totals are the sums of the tractions and of the patches; moments are about the documented points"""
    sign = -1.0 if scene["side"] == "left" else 1.0
    whole, conformal = np.zeros(3), scene["digits"]["D"] == 4
    moment = np.zeros(3)
    placed = geometry1.Placed(scene, case, totals["z_ws"], (totals.get("dy_defl", 0.0), totals.get("dz_defl", 0.0))) \
        if scene1.sampled(scene) else None
    for k, patch in enumerate(patches):
        size = abs(patch["fn"]) + 1e-12
        axes = geometry1.turn(0, patch["deltcp_tr"])
        # rows of a curved patch have different axes; their resultants have other names
        force = axes @ np.array([patch[name] for name in (("bar_fx", "bar_fs", "bar_fn") if conformal else ("fx", "fy", "fn"))])
        whole += force
        if conformal:
            continue
        field = run.fields(number, k + 1) if judge.h5py is not None else run.printed_fields(number, chr(97 + k))
        area = field["dx"] * field["dy"]
        limit = judge.ROUND_OFF + 4 * field["error"]
        if "px" not in field:  # no tangential problem
            field["px"] = field["py"] = np.zeros_like(field["pn"])
            field["mu"] = field.get("mu", field["px"])
        for name, total in (("pn", patch["fn"]), ("px", patch["fx"]), ("py", sign * patch["fy"])):
            judge.exceeds(findings, "sums", "%s of a patch is not the sum of its tractions" % name,
                          abs(field[name].sum() * area - total) / size, limit)
        if (field["pn"] < -1e-6 * field["pn"].max()).any():
            findings.append(judge.finding("sums", "a pressure is negative"))
        excess = np.hypot(field["px"], field["py"]) - field["mu"] * field["pn"]
        judge.exceeds(findings, "sums", "tractions are beyond the friction bound", excess.max() / max(field["pn"].max(), 1e-30),
                      1e-6 + 2 * field["error"])
        x = field["xl"] + (np.arange(field["mx"]) + 0.5) * field["dx"]
        s = field["yl"] + (np.arange(field["my"]) + 0.5) * field["dy"]
        if scene["digits"]["T"] in (0, 3):
            arm = np.hypot(x, 0).max() + np.abs(s).max()
            turning = area * (x[None, :] * field["py"] - s[:, None] * field["px"]).sum()
            judge.exceeds(findings, "sums", "MN of a patch is not the moment of its tractions",
                          abs(sign * turning - patch["mz"]) / (size * arm), limit)
            own = np.array([sign * area * (s[:, None] * field["pn"]).sum(), -area * (x[None, :] * field["pn"]).sum(),
                            sign * turning])
            if placed is not None:
                where = np.array([patch["xcp_tr"], patch["ycp_tr"], patch["zcp_tr"]])
                moment += np.cross(where - placed.rail_origin, force) + axes @ own
    size = sum(abs(patch["fn"]) for patch in patches)
    for name, value in zip(("fx_tr", "fy_tr", "fz_tr"), whole):
        judge.exceeds(findings, "sums", "%s is not the sum of the patches" % name.upper(), abs(value - totals[name]) / size, 1e-9)
    in_set = (geometry1.turn(0, case["roll"]) @ geometry1.turn(2, case["yaw"])).T @ whole
    for name, value in zip(("fx_ws", "fy_ws", "fz_ws"), in_set):
        judge.exceeds(findings, "sums", "%s is not the force in wheelset axes" % name.upper(),
                      abs(value - totals[name]) / size, 1e-9)
    if placed is not None and not conformal and scene["digits"]["T"] in (0, 3):
        arm = max(100.0, float(np.abs(placed.rail_origin).max()))
        for name, value in zip(("mx_r_tr", "my_r_tr", "mz_r_tr"), moment):
            judge.exceeds(findings, "sums", "%s is not the moment about the rail marker" % name.upper(),
                          abs(abs(value) - abs(totals[name])) / (size * arm), 1e-6)


def places(scene, case, placed, record, totals, patches, findings):
    """The smallest gap, places and angles of the patches, by points on both surfaces"""
    ds, digits = scene["grid"][1], scene["digits"]
    touch = placed.smallest()
    if touch is None:
        findings.append(judge.finding("gap", "a patch where the bodies are beside each other"))
        return
    depth = -touch[0]
    if depth <= 0.0:
        findings.append(judge.finding("gap", "a patch, but the bodies do not overlap", touch[0], 0.0))
        return
    if not 1e-6 < touch[1] < placed.wheel.length - 1e-6:
        # an edge touches without a common tangent plane; the program has no patch there, or a truncated one, with a warning
        if not ("buried" in record or any("wheel profile" in patch.get("border", {}).get("reached", "")
                                          for patch in record["patches"])):
            findings.append(judge.finding("gap", "an end of the wheel profile is inside the rail, without a warning", depth,
                                          0.0))
        return
    steep = max(abs(math.tan(patch["deltcp_tr"])) for patch in patches)
    slack = 2e-5 * (1.0 + min(steep, 20.0))  # of the sampled curves, vertically [mm]
    if placed.rail.slices or placed.wheel.slices:
        slack += geometry1.SLICED * (1.0 + min(steep, 20.0))
    by_rows = digits["D"] not in (5, 6) and not placed.wheel.slices
    every = placed.regions(depth, by_rows)
    regions = [region for region in every if region["depth"] > 1e-3 * depth]
    if not regions:
        return
    deepest = max(regions, key=lambda region: region["depth"])
    # the program tabulates the gap with steps of 0.3 DS and takes a parabola through three of them
    width = deepest["bounds"][1] - deepest["bounds"][0]
    coarse = (0.3 * ds / width)**2 if width > 0.0 else 1.0
    if "smallest_gap" in totals and not deepest["edge"]:
        judge.exceeds(findings, "gap", "the smallest gap", abs(totals["smallest_gap"] + depth), (0.05 + coarse) * depth + slack)
    apart = [b["bounds"][0] - a["bounds"][1] for a, b in zip(regions, regions[1:])]
    d_sep, d_comb = scene["grid"][4], scene["grid"][5]
    if len(regions) == len(patches) == 1 and not deepest["edge"]:
        region, patch = deepest, patches[0]
        if width < 1.2 * ds:  # too few points of the table for a mean
            return
        if (placed.rail.slices or placed.wheel.slices) and depth < 1e-4:  # see SLICED
            return
        across = (0.05 * ds + 0.01 * width if width > 4 * ds else 0.3 * ds) + slack + geometry1.SAMPLE
        if placed.rail.slices or placed.wheel.slices:
            across += geometry1.SLICED_PLACE
        share = 2.0 * min(1.0, across / width)
        # the mean over as many rows of the table as the overlap is wide: with four of them to 2 % of its length
        rows = max(0.01, min(0.05, 0.5 * coarse))
        along_x = rows * (region["x_bounds"][1] - region["x_bounds"][0]) + share * region["lean"] + 2e-3 * ds
        judge.exceeds(findings, "places", "YCP", abs(region["y"] - patch["ycp_tr"]), across)
        judge.exceeds(findings, "places", "XCP", abs(region["x"] - patch["xcp_tr"]), along_x)
        judge.exceeds(findings, "places", "DELTCP", abs(region["angle"] - patch["deltcp_tr"]), share * region["bend"] + 2e-4)
        judge.exceeds(findings, "places", "approach beyond the overlap", patch["pen"] - depth * math.cos(patch["deltcp_tr"]),
                      (0.05 + 0.5 * region["bend"]) * depth + slack)
    elif not placed.wheel.slices and all(distance > 1.5 * max(2 * d_sep - d_comb, d_sep) for distance in apart) \
            and all(region["depth"] > 0.05 * depth for region in every):
        judge.exceeds(findings, "places", "number of patches", abs(len(patches) - len(regions)), 0)


def distance(scene, run, number, placed, patches, findings):
    """The undeformed distance of the elements in contact, along the normal of the patch, from both surfaces"""
    varying = placed.roller or placed.rail.slices or placed.wheel.slices
    if scene["digits"]["D"] == 4 or scene["digits"]["T"] in (1, 2) or varying:
        return
    for k, patch in enumerate(patches):
        field = run.fields(number, k + 1) if judge.h5py is not None else run.printed_fields(number, chr(97 + k))
        if not patch["fn"] > 0.0:
            continue
        x = field["xl"] + (np.arange(field["mx"]) + 0.5) * field["dx"]
        s = field["yl"] + (np.arange(field["my"]) + 0.5) * field["dy"]
        if scene["side"] == "left":
            s = -s
        where = np.array([patch["xcp_tr"], patch["ycp_tr"], patch["zcp_tr"]])
        found = placed.distances(where, patch["deltcp_tr"], x, np.sort(s))
        if scene["side"] == "left":
            found = found[::-1]
        touching = field["pn"] > 0.0
        mine = found[touching] + patch["pen"]  # the program gives the distance relative to its minimum
        slack = 1e-4 * scene["pair"]["wheelset"][2] / profiles.RADIUS
        judge.exceeds(findings, "distance", "undeformed distance where the bodies touch", np.abs(mine - field["h"][touching]).max(),
                      2e-3 * patch["pen"] + 0.04 * slack)
        beyond = ~touching & np.isfinite(found)
        inside = found[beyond] < -1.002 * patch["pen"] - 0.04 * slack
        if inside.any():
            findings.append(judge.finding("distance", "bodies overlap by more than the approach", -found[beyond].min(),
                                          patch["pen"]))


def motion(scene, case, placed, totals, patches, findings):
    """Creepages, by finite differences of the positions of material points in time"""
    if scene["digits"]["D"] not in (2, 5, 6, 7) or scene["digits"]["T"] == 0:
        return
    moved = copy.deepcopy(case)
    if scene["digits"]["F"] == 1:
        moved["speed"][5] = totals["vpitch_ws"]
    for patch in patches:
        axes = geometry1.turn(0, patch["deltcp_tr"])
        at_rail = np.array([patch["xcp_tr"], patch["ycp_tr"], patch["zcp_tr"]])
        at_wheel = at_rail + patch["pen"] * axes[:, 2]
        v_rail, v_wheel, turn_rail, turn_wheel = placed.velocities(moved, at_rail, at_wheel, scene.get("curve", 0.0))
        v_rail, v_wheel = axes.T @ v_rail, axes.T @ v_wheel
        spin = (axes.T @ (turn_rail - turn_wheel))[2]
        if scene["digits"]["T"] == 1:
            names, reference = ("shift_x", "shift_y", "rotation"), 1.0
        else:
            names = ("cksi", "ceta", "cphi")
            around = np.cross(placed.set_axes @ np.array([0.0, moved["speed"][5], 0.0]), at_wheel - placed.set_origin)[0]
            if scene["roller"]:
                # relative to the contact, which is on the line between both axles
                axle = v_rail[0] - moved["speed"][0] * (at_rail[2] - scene["roller"])
                radii = [scene["roller"] - at_rail[2], np.linalg.norm((at_wheel - placed.set_origin)[[0, 2]])]
                contact = axle + (v_wheel[0] - around - axle) * radii[0] / sum(radii)
                reference = abs(0.5 * (v_rail[0] + v_wheel[0]) - contact)
            else:
                reference = 0.5 * (abs(v_wheel[0] - v_rail[0] - around) + abs(around))
        if reference < 1e-6:
            continue
        found = [(v_rail[0] - v_wheel[0]) / reference, (v_rail[1] - v_wheel[1]) / reference, spin / reference]
        scale = max(1e-3, abs(found[0]), abs(found[1])) if scene["digits"]["T"] != 1 else max(1e-6, abs(found[0]), abs(found[1]))
        for name, value, unit in zip(names, found, (1.0, 1.0, 1.0 / placed.radius)):
            if name in patch:
                judge.exceeds(findings, "motion", name.upper(), abs(patch[name] - value) / (scale * unit), 1e-4)


# ---- Relations ---------------------------------------------------------------------------------------------


def compared(findings, what, one, two, tolerance, lengths=1.0, forces=1.0, position=None, patches=True, height=0.0, elements=0):
    """Compare cases of two runs; the second one is larger by the factors of lengths and forces

    height     by how much the surfaces may be displaced [mm]: forces grow with the power 1.5 of the approach
    elements   patches with fewer elements in contact are not compared: forces jump with the place of the grid
    """
    least = tolerance
    for (record, totals, mine), (other, theirs, yours) in zip(one, two):
        if not (settled(record) and settled(other)):
            if settled(record) != settled(other) and tolerance < 1e-6:
                findings.append(judge.finding(what, "one of both does not converge"))
            return
        if len(mine) != len(yours):
            if patches:
                findings.append(judge.finding(what, "number of patches: %d and %d" % (len(mine), len(yours))))
            return
        size = sum(abs(patch["fn"]) for patch in mine)
        if not size > 0.0 or min(patch["ncon"] for patch in mine) < elements:
            continue
        tolerance = least + 1.5 * height / min(patch["pen"] for patch in mine)
        if least > 1e-4:  # a vertical force that is the small difference of large forces
            tolerance *= max(1.0, 0.2 * size / max(abs(totals["fz_tr"]), 1e-9))
        for name in ("fx_tr", "fy_tr", "fz_tr"):
            judge.exceeds(findings, what, name.upper(), abs(theirs[name] / forces - totals[name]) / size, tolerance)
        judge.exceeds(findings, what, "Z_WS", abs(theirs["z_ws"] / lengths - totals["z_ws"]) / max(mine[0]["pen"], 1e-12),
                      10 * tolerance)
        for a, b in zip(mine, yours):
            for name, scale in (("pmax", 1.0), ("pen", lengths), ("fn", forces)):
                # where curvatures of the profile jump, pressures are more sensitive to the curve than forces
                judge.exceeds(findings, what, name.upper(), abs(b[name] / scale - a[name]) / max(abs(a[name]), 1e-12),
                              (5 if name == "pmax" and height > 0.0 else 3) * tolerance)
            if position is not None:
                judge.exceeds(findings, what, "YCP(TR)", abs(b["ycp_tr"] / lengths - a["ycp_tr"]), position)


def mirror(scene, tools, run, cases, findings):
    """The other side of the track, mirrored"""
    other = "left" if scene["side"] == "right" else "right"
    again = scene1.solve(scene, tools, "mirror", other)
    compared(findings, "mirror", cases, results(again, other), 1e-12, position=1e-12)


def translate(scene, tools, run, cases, findings):
    """The same scene at another position along the track"""
    moved, step = copy.deepcopy(scene), 4096.0 * scene["grid"][0]
    if scene["roller"] or scene["digits"]["V"] == 2:
        return
    for case in moved["cases"]:
        case["s"] += step
    if moved["pair"]["rail"].get("slices"):
        for part in moved["pair"]["rail"]["slices"]:
            part[0] += step
    tolerance = 1e-9 if scene["digits"]["T"] in (0, 3) and not moved["pair"]["rail"].get("slices") else 2e-5
    compared(findings, "translate", cases, results(scene1.solve(moved, tools, "moved"), scene["side"]), tolerance)


def scale(scene, tools, run, cases, findings):
    """All lengths doubled, forces four times as large"""
    pair = scene["pair"]
    if scene["digits"]["M"] or scene["digits"]["V"] == 2 or pair["rail"].get("slices") or pair["wheel"].get("slices"):
        return
    for recipe in (pair["rail"], pair["wheel"]):
        if recipe.get("smooth") or recipe.get("noise") or profiles.arc_length(profiles.points(recipe))[-1] > 240.0:
            return
    large = copy.deepcopy(scene)
    for recipe in (large["pair"]["rail"], large["pair"]["wheel"]):
        recipe["scale"] = 2.0 * recipe.get("scale", 1.0)
    track = large["pair"]["track"]
    track[:3] = [2.0 * track[0], 2.0 * track[1], 2.0 * track[2]]
    large["pair"]["wheelset"] = [2.0 * value for value in pair["wheelset"]]
    large["roller"] = 2.0 * scene["roller"]
    if "curve" in large:
        large["curve"] *= 0.5
    large["grid"] = [2.0 * value if k in (0, 1, 4, 5) else value for k, value in enumerate(scene["grid"])]
    if "springs" in large:  # forces grow by four, deflections by two
        large["springs"] = [2.0 * value for value in large["springs"]]
    for case in large["cases"]:
        for name in ("s", "y", "z"):
            case[name] *= 2.0
        case["fz"] *= 4.0
        lengths = (1, 2) if scene["roller"] else (0, 1, 2)
        case["speed"] = [2.0 * value if k in lengths else value for k, value in enumerate(case["speed"])]
        case["deviation"] = [2.0 * value if k in (0, 1, 3, 4) else value for k, value in enumerate(case["deviation"])]
        if case.get("flexible"):
            case["flexible"] = [2.0 * value if k in (0, 1, 2, 6, 7, 8) else value for k, value in enumerate(case["flexible"])]
    if scene["digits"]["L"]:
        return
    compared(findings, "scale", cases, results(scene1.solve(large, tools, "large"), scene["side"]), 2e-4, lengths=2.0, forces=4.0,
             position=0.02 * scene["grid"][1])


def file(scene, tools, run, cases, findings):
    """The same profiles in another order, unit and format"""
    other = copy.deepcopy(scene)
    for recipe in (other["pair"]["rail"], other["pair"]["wheel"]):
        recipe["mirror"] = 0 if recipe.get("mirror") else 1
        recipe["reverse"] = 0 if recipe.get("reverse") else 1
        recipe["format"] = {"simpack": "miniprof", "miniprof": "table", "table": "simpack"}[recipe.get("format", "simpack")]
    compared(findings, "file", cases, results(scene1.solve(other, tools, "other"), scene["side"]), 2e-6, position=1e-6)


def refined_profile(scene, tools, run, cases, findings):
    """Profiles with twice the number of points on the same curve"""
    finer = copy.deepcopy(scene)
    for recipe in (finer["pair"]["rail"], finer["pair"]["wheel"]):
        if recipe.get("noise") or recipe.get("smooth") or recipe.get("spacing") or recipe.get("slices"):
            return
        recipe["refine"] = 2
    compared(findings, "refined_profile", cases, results(scene1.solve(finer, tools, "finer"), scene["side"]), 2e-2,
             patches=False, elements=30)


def cut(scene, tools, run, cases, findings):
    """The part of the rail that is in contact, placed without a gauge point"""
    rail = scene["pair"]["rail"]
    if scene["roller"] or rail.get("slices") or rail.get("smooth") or not scene1.sampled(scene):
        return
    part = copy.deepcopy(scene)
    for _k, (record, _totals, patches) in enumerate(cases):
        if not patches or not settled(record):
            return
    case = part["cases"][0]
    del part["cases"][1:]
    patches = cases[0][2]
    margin = 10.0 + 3.0 * max(math.sqrt(2.0 * 460.0 * max(patch["pen"], 0.0)) for patch in patches)
    low, high = min(p["ycp_r"] for p in patches) - margin, max(p["ycp_r"] for p in patches) + margin
    placed = geometry1.Placed(part, case, 0.0)
    whole = profiles.points(rail)
    if (low <= whole[0, 0] and high >= whole[-1, 0]) or min(patch["deltcp_r"] for patch in patches) < -1.2:
        return
    factor = rail.get("scale", 1.0)
    part["pair"]["rail"]["cut"] = [low / factor, high / factor]
    if rail.get("spacing"):
        return
    origin = placed.rail_origin - np.array([0.0, case["deviation"][0], case["deviation"][1]])
    part["pair"]["track"] = [-1.0, float(origin[1]), float(origin[2]), part["pair"]["track"][3]]
    found = []
    compared(found, "cut", cases[:1], results(scene1.solve(part, tools, "part"), scene["side"]), 5e-3, height=2e-6, elements=30)
    if found and max(patch["ncon"] for patch in patches) < 500:
        # the table of gaps begins at the end of the rail: elements have other positions in the contact. The effect vanishes
        # with elements of a quarter of the size
        found, fine = [], []
        for one in (scene, part):
            one = copy.deepcopy(one)
            del one["cases"][1:]
            one["grid"][:2] = [0.25 * value for value in one["grid"][:2]]
            fine.append(results(scene1.solve(one, tools, "fine"), scene["side"]))
        compared(found, "cut", *fine, 5e-3, height=2e-6, elements=30)
    findings += found


def slices(scene, tools, run, cases, findings):
    """A rail that does not vary, written as slices"""
    rail = scene["pair"]["rail"]
    if rail.get("slices") or scene["pair"]["wheel"].get("slices") or not scene1.sampled(scene):
        return
    if rail.get("spacing") or rail.get("noise") or rail.get("scale", 1.0) < 0.8:  # slices are sampled with steps of 0.5 mm
        return
    if scene["roller"] or scene["digits"]["D"] == 4 or any(not settled(record) for record, _, _ in cases):
        return
    same = copy.deepcopy(scene)
    del same["cases"][1:]
    case = same["cases"][0]
    placed = geometry1.Placed(same, case, 0.0)
    origin = placed.rail_origin - np.array([0.0, case["deviation"][0], case["deviation"][1]])
    same["pair"]["track"] = [-1.0, float(origin[1]), float(origin[2]), same["pair"]["track"][3]]
    same["pair"]["rail"]["slices"] = [[case["s"] + 100.0 * (k - 3), 0.0, 0.0] for k in range(7)]
    compared(findings, "slices", cases[:1], results(scene1.solve(same, tools, "same"), scene["side"]), 2e-2,
             position=0.3 * scene["grid"][1] + geometry1.SLICED_PLACE, patches=False, height=geometry1.SLICED, elements=30)


def refined_grid(scene, tools, run, cases, findings):
    """Elements of half the size"""
    finer = copy.deepcopy(scene)
    finer["grid"][:2] = [0.5 * value for value in scene["grid"][:2]]
    if scene["digits"]["T"] in (1, 2) or scene["digits"]["B"]:
        return
    if any(scene["pair"][body].get("spacing") and not scene["pair"][body].get("smooth") for body in ("rail", "wheel")):
        return  # corners between straight pieces: pressures grow with every finer grid
    if any(not 60 <= patch["ncon"] <= 4000 for _, _, patches in cases for patch in patches):
        return
    least = min([patch["ncon"] for _, _, patches in cases for patch in patches] or [1])
    compared(findings, "refined_grid", cases, results(scene1.solve(finer, tools, "finer"), scene["side"]),
             max(4e-2, (1.0 if scene["digits"]["M"] in (2, 3, 5) else 0.5) / math.sqrt(least)), patches=False)


def library(scene, tools, run, cases, findings):
    """The same case by the library, and by the input file that the library writes"""
    digits = scene["digits"]
    if digits["F"] == 3 or digits["V"] or digits["C"] == 4 or any(scene["pair"][body].get("metres") for body in ("rail", "wheel")):
        return
    place = os.path.join(tools.folder, "scene.json")
    with open(place, "w", encoding="utf-8") as held:
        json.dump(scene, held)
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "library1.py")
    code, output, errors, _ = tools.command([sys.executable, "-B", script, place, tools.folder])
    if code != 0:
        findings.append(judge.finding("library", "exit code %s: %s" % (code, errors.strip()[-300:])))
        return
    # with a prescribed force the last trial may be another one, for the last digits of the input
    same = scene1.EPS if digits["N"] else SAME
    answers = json.loads(output.strip().splitlines()[-1])
    sign = -1.0 if scene["side"] == "left" else 1.0
    for (record, totals, patches), answer in zip(cases, answers):
        if "error" in answer:
            if settled(record):
                findings.append(judge.finding("library", judge.without_numbers(answer["error"])))
            return
        if not settled(record):
            continue
        if len(answer["patches"]) != len(patches):
            findings.append(judge.finding("library", "number of patches: %d and %d" % (len(patches), len(answer["patches"]))))
            return
        if not any(patch["fn"] > 0.0 for patch in patches):
            continue
        size = sum(abs(patch["fn"]) for patch in patches)
        for name, value, odd in zip(("fx_tr", "fy_tr", "fz_tr"), answer["force"], (1.0, sign, 1.0)):
            judge.exceeds(findings, "library", name.upper(), abs(odd * value - totals[name]) / size, same)
        judge.exceeds(findings, "library", "Z_WS", abs(answer["z_ws"] - totals["z_ws"]), same * max(1.0, abs(totals["z_ws"])))
        for patch, other in zip(patches, answer["patches"]):
            for name, value, odd in zip(("xcp_tr", "ycp_tr", "zcp_tr", "deltcp_tr"), other["place"], (1.0, sign, 1.0, sign)):
                judge.exceeds(findings, "library", name.upper(), abs(odd * value - patch[name]), same * max(1.0, abs(patch[name])))
            for name, odd in (("fn", 1.0), ("fx", 1.0), ("pmax", 1.0), ("pen", 1.0)):
                judge.exceeds(findings, "library", name.upper(), abs(odd * other[name] - patch[name])
                              / max(abs(patch[name]), 0.1 * patch["fn"] if name == "fx" else 0.0), same)
    written = [name for name in os.listdir(tools.folder) if (name.startswith("caddon") and name.endswith(".inp"))
               or (name.startswith("through") and name.endswith(".inp"))]
    for name in written:
        with open(os.path.join(tools.folder, name), encoding="utf-8") as held:
            again = results(tools.run("written", held.read(), options=scene1.OPTIONS), scene["side"])
        compared(findings, "written input", cases, again, 1e-5)


RELATED = dict(mirror=mirror, translate=translate, scale=scale, file=file, refined_profile=refined_profile, cut=cut, slices=slices,
               refined_grid=refined_grid, library=library)

