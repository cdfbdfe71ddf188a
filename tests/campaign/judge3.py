"""Judges of contact problems of module 3.

Tolerances. A program that reports "converged" guarantees relative residuals of at most EPS: of the contact conditions relative to
the approach, of the tangential problem relative to the bound of friction. Judges recompute these residuals from the printed
fields by plain sums, hence their limit is EPS itself with a small allowance for round-off and printed figures. Two solutions
of equivalent problems may differ by what residuals of that size can do: AMPLIFICATION times EPS.
"""
import copy
import json
import math
import os
import sys

import judge
import numpy as np
from judge import exceeds, finding

import elastic

# Allowed ratio of a residual to EPS: it is measured at another stage, or in another norm
ALLOWANCE = 2.0
# Allowed difference between solutions of two equivalent problems, in units of EPS and of the size of the field
AMPLIFICATION = 200.0
# The judge's own integrals over the memory of viscoelastic bodies
QUADRATURE = 1e-5
# Program and library differ by round-off, which iterations that end at EPS may carry to a part of EPS
LIBRARY = 1.0
# Input that was written by the library has a window that is cut down to the contact and its neighbours
WRITTEN = 20.0


# Known, open disagreements: judge, property of the scene or the finding, reason
OPEN = (
    ("mirror", lambda scene, item: scene["digits"]["B"] == 6,
     "B = 6: ANALYN takes local differences of the gap, which coarse and rough grids make uneven"),
    ("moved", lambda scene, item: scene["digits"]["B"] == 6, "B = 6: of two equally low columns ANALYN takes one, by round-off"),
)


class Fields(dict):
    """Fields and grid of one case with the coordinates of the centres"""

    def __init__(self, values):
        super().__init__(values)
        self.x = self["xl"] + (np.arange(self["mx"]) + 0.5)*self["dx"]
        self.y = self["yl"] + (np.arange(self["my"]) + 0.5)*self["dy"]
        zero = np.zeros((self["my"], self["mx"]))
        for name in ("px", "py", "ux", "uy", "sx", "sy", "mu"):
            self.setdefault(name, zero)
        self.area = self["dx"]*self["dy"]


def check(scene, tools):
    """Findings of all judges on a scene; those that are known get the status open and the reason"""
    findings = judged(scene, tools)
    for item in findings:
        for name, applies, reason in OPEN:
            if item["status"] == "disagreement" and item["judge"].startswith(name) and applies(scene, item):
                item.update(status="open", what=reason)
    return findings


def judged(scene, tools):
    findings = []
    run = tools.run("run", text_of(scene), other_files(scene))
    solved = judge.how_it_ended(run, len(scene["cases"]), findings)
    fields = {}
    for k in solved:
        fields[k] = Fields(run.fields(k))
        judge_numbers(run, k, fields[k], findings)
    for k, record in enumerate(run.cases, start=1):
        expected = {"solved": (True, True), "not converged": (True, False), "refused": (False, False)}.get(record.get("status"))
        if expected != (bool(record.get("solved")), is_converged(record)):
            findings.append(finding("status", f"case {k}: {record.get('status')}, solved {record.get('solved')}, converged"
                                    f" {record.get('converged')}"))
    for k in solved:
        not_converged(run.cases[k - 1], findings)
    if run.code == 1 or scene.get("variant") == "checked":
        checked(scene, run, tools, findings)
    if any(item["status"] != "refused" and item["judge"] in ("end", "numbers") for item in findings):
        return findings
    state = {}
    for k in solved:
        if k > 1 and k - 1 not in fields:
            break
        judge_grid(scene, k, fields[k], findings, state)
        if scene["digits"]["B"] not in (2, 3, 4):
            # pressures by formula vanish where those of the formula do
            judge_border(k, fields[k], run.cases[k - 1], findings)
        judge_totals(scene, k, run, fields[k], findings)
        judge_contact(scene, k, run, fields, findings, state)
        judge_hertz(scene, k, run, fields[k], findings)
    if not any(item["status"] == "disagreement" for item in findings) and run.code == 0:
        variant(scene, run, fields, tools, findings)
    return findings


def checked(scene, run, tools, findings):
    """The checking mode reports the same about the input as a run"""
    code, _, errors, _ = tools.command([tools.exe, "3", "run"])
    if code != run.code and "that were in contact in the previous case" not in run.errors:
        findings.append(
            finding(
                "checked", f"exit code {run.code} of the run, {code} of the check: {judge.without_numbers(errors or run.errors)}"
            )
        )


def text_of(scene):
    import module3
    return module3.input_text(scene)


def other_files(scene):
    return {"run.cf": coefficient_file(scene)} if scene["digits"]["C"] == 9 else {}


def is_converged(record):
    return bool(record.get("converged"))


def not_converged(record, findings):
    """Report which iteration did not converge, according to the program"""
    if is_converged(record):
        return
    what = []
    for patch in record.get("patches", []):
        solver = patch.get("solver", {})
        for part in ("normal", "tangential"):
            ended = solver.get(part + "_ended", "converged")
            if ended != "converged":
                what.append(f"{part} {solver.get(part + '_method', '')}: {ended}")
    findings.append(finding("end", judge.without_numbers("; ".join(what) or str(record.get("status") or record.get("failure")
                                                                              or "outer iteration")),
                            status="not converged"))


def judge_numbers(run, k, f, findings):
    """No field and no total is NaN or infinite"""
    for name, value in run.totals(k).items():
        if value is not None and not math.isfinite(value):
            findings.append(finding("numbers", f"total {name} of case {k}"))
    for name, value in f.items():
        if np.ndim(value) == 2 and not np.isfinite(value).all():
            findings.append(finding("numbers", f"field {name} of case {k}"))


def judge_border(k, f, record, findings):
    """Contact that the border of the window cuts off is reported; where the gap does not change towards the border a body ends"""
    h, inside = f["h"], f["eldiv"] > 0
    cut = []
    for side, (size, outer, inner) in {"x low": (f["mx"], np.s_[:, 0], np.s_[:, 1]),
                                       "x high": (f["mx"], np.s_[:, -1], np.s_[:, -2]), "y low": (f["my"], np.s_[0], np.s_[1]),
                                       "y high": (f["my"], np.s_[-1], np.s_[-2])}.items():
        if size >= 3 and (inside[outer] & (np.abs(h[outer] - h[inner]) > 1e-6*np.abs(h[outer]))).any():
            cut.append(side)
    reported = record["patches"][0].get("border", {})
    reported = reported.get("reached", "") if isinstance(reported, dict) else str(reported)
    for side in cut:
        if side not in reported:
            findings.append(finding("border", f"contact of case {k} is cut off at {side}, reported: {reported!r}"))


def value_of_gap(grid, x, y):
    """Undeformed distance of a scene's geometry at the positions x (mx,), y (my,), by the formulas of the guide"""
    x, y = x[np.newaxis, :], y[:, np.newaxis]
    b = grid["gap"]
    if grid["ibase"] == 1:
        return b[0]*x*x + b[1]*x*y + b[2]*y*y + b[3]*x + b[4]*y + b[5]
    if grid["ibase"] == 2:
        count, xm, rm, y1, dy1 = b[:5]
        heights = np.array(b[5:])
        i = np.clip(np.floor((y - y1)/dy1).astype(int), 0, int(count) - 2)
        share = (y - y1)/dy1 - i
        return heights[i]*(1 - share) + heights[i + 1]*share + (x - xm)**2/(2*rm)
    if grid["ibase"] == 3:
        return b[0]*np.sin(b[1]*(x - b[2])) - b[3]*np.sin(b[4]*(x - b[5])) + x*x/b[6] + y*y/b[7]
    return np.array(b).reshape(grid["my"], grid["mx"])


def excluded(grid, x, y, margin):
    """Elements outside the planform, and those too near its border to decide (margin: relative to the coordinates)"""
    x, y = x[np.newaxis, :], y[:, np.newaxis]
    p = grid.get("plan")
    if grid.get("iplan", 1) == 2:
        terms = [p[0]*x*x, p[1]*x*y, p[2]*y*y, p[3]*x, p[4]*y, p[5] + 0*x*y]
        value = sum(terms)
        return value >= 0, np.abs(value) < margin*sum(np.abs(term) for term in terms)
    if grid.get("iplan", 1) == 3:
        inside, near = False, False
        for xl, xh, yl, yh in (p[:4], p[4:]):
            inside = inside | ((x >= xl) & (x <= xh) & (y >= yl) & (y <= yh))
            for place, edges in ((x, (xl, xh)), (y, (yl, yh))):
                for edge in edges:
                    near = near | (np.abs(place - edge) < margin*abs(edge))
        return ~inside, near
    nothing = np.zeros((y.size, x.size), dtype=bool)
    return nothing, nothing


def offset_of(scene, k):
    """Shift of the window since the first case, in elements"""
    moves = [case.get("move", (0, 0)) for case in scene["cases"][:k]]
    return sum(move[0] for move in moves), sum(move[1] for move in moves)


def grid_of(scene, k):
    """Grid and geometry of case k"""
    kx, ky = offset_of(scene, k)
    if (kx, ky) == (0, 0):
        return scene["grid"]
    grid = dict(scene["grid"])
    grid["xl"] += kx*grid["dx"]
    grid["yl"] += ky*grid["dy"]
    return grid


def in_window(scene, k, field):
    """A field of case k - 1 in the window of case k, zero where it was outside"""
    kx, ky = scene["cases"][k - 1].get("move", (0, 0))
    return elastic.shifted(field, kx, ky)


def judge_grid(scene, k, f, findings, state):
    """Grid, undeformed distance and planform are those of the input; sets state["h"], state["out"]"""
    grid = grid_of(scene, k)
    if (f["mx"], f["my"]) != (grid["mx"], grid["my"]):
        findings.append(finding("grid", f"{f['mx']} x {f['my']} elements"))
        state["h"] = f["h"]
        return
    out = f["h"] > 1e29
    if grid["ipotcn"] > 0:
        for name in ("xl", "yl", "dx", "dy"):
            scale = grid["dx"] if name in ("xl", "dx") else grid["dy"]
            exceeds(findings, "grid", f"{name} of case {k}", abs(f[name] - grid[name])/scale, 1e-9 + 10*f["error"])
        x = grid["xl"] + (np.arange(grid["mx"]) + 0.5)*grid["dx"]
        y = grid["yl"] + (np.arange(grid["my"]) + 0.5)*grid["dy"]
        h = value_of_gap(grid, x, y)
        no, near = excluded(grid, x, y, 1e-9)
        if ((no != out) & ~near).any():
            findings.append(finding("planform", f"{int(((no != out) & ~near).sum())} elements"))
        both = ~out
        scale = np.abs(h).max() + 1e-30
        exceeds(findings, "gap", f"undeformed distance of case {k}", judge.relative((f["h"] - h)[both], scale), 1e-9 + 2*f["error"])
        state["h"] = h
    else:
        state["h"] = f["h"]
    state["out"] = out


def scale_of_friction(scene):
    """Static coefficient by which relative forces are divided"""
    d, row = scene["digits"], scene["friction"][0]
    if d["V"] == 3:
        return 1.0
    return row[0] if d["L"] in (0, 6) else row[0] + row[1] + row[3]


def judge_totals(scene, k, run, f, findings):
    """Totals are sums of the tractions, numbers of elements those of the division, and prescribed values are met"""
    d, case, t = scene["digits"], scene["cases"][k - 1], run.totals(k)
    tolerance = 1e-8 + 4*f["error"]
    pn, px, py = f["pn"], f["px"], f["py"]
    fn = pn.sum()*f.area
    scale = max(abs(t["fn"]), fn)
    if scale == 0:
        return
    mu = scale_of_friction(scene)
    exceeds(findings, "sum", f"FN of case {k}: {t['fn']:.7g}, tractions {fn:.7g}", abs(fn - t["fn"])/scale, tolerance)
    for name, p in (("fx", px), ("fy", py)):
        if t.get(name) is not None and d["T"]:
            total = p.sum()*f.area
            exceeds(findings, "sum", f"{name.upper()} of case {k}: {t[name]:.7g}, tractions {total:.7g}",
                    abs(total - t[name])/(mu*scale), tolerance)
    exceeds(findings, "totals", f"PMAX of case {k}", abs(pn.max() - t["pmax"])/max(pn.max(), 1e-300), tolerance)
    if t.get("mz") is not None:
        arm = max(np.abs(f.x).max(), np.abs(f.y).max(), f["dx"], f["dy"])
        mz = (py*f.x[np.newaxis, :] - px*f.y[:, np.newaxis]).sum()*f.area
        exceeds(findings, "sum", f"MZ of case {k}", abs(mz - t["mz"])/(mu*scale*arm), tolerance)
    for name, value in (("ncon", (f["eldiv"] > 0).sum()), ("nadh", (f["eldiv"] == 1).sum()), ("nslip", (f["eldiv"] == 2).sum())):
        if t.get(name) is not None and t[name] != value:
            findings.append(finding("totals", f"{name.upper()} of case {k}: {t[name]}, elements {value}"))
    if d["T"]:
        name, step = ("friction_power", scene["rolling"][2]) if d["T"] >= 2 else ("friction_work", 1.0)
        plastic = d["M"] == 4 and scene["material"][2] > 0
        if t.get(name) is not None and not plastic:
            power = (px*f["sx"] + py*f["sy"]).sum()*f.area*step/1000
            size = (np.hypot(px, py)*np.hypot(f["sx"], f["sy"])).sum()*f.area*step/1000
            exceeds(findings, "totals", f"{name} of case {k}: {t[name]:.7g}, fields {power:.7g}",
                    judge.relative(t[name] - power, size), 1e-6 + 20 * f["error"])
    if not is_converged(run.cases[k - 1]):
        return
    if case["N"]:
        exceeds(findings, "force", f"FN of case {k}: {case['load']:.7g} prescribed", abs(t["fn"] - case["load"])/case["load"],
                1e-8 if d["B"] in (0, 2, 3, 4) else 2*scene["eps"] + 1e-8)
    elif t.get("pen") is not None and d["B"] != 4:
        exceeds(findings, "force", f"approach of case {k}", abs(t["pen"] - case["load"])/(abs(case["load"]) + 1e-30), 1e-9)
    prescribed = {1: ("x",), 2: ("x", "y")}.get(case["F"], ())
    for name in prescribed:
        got = t["f" + name]/(mu*t["fn"])
        exceeds(findings, "force", f"F{name} of case {k}: {case[name]:.7g} prescribed", abs(got - case[name]),
                ALLOWANCE * scene["eps"] + 1e-8)


def half_spaces(scene, f):
    d = scene["digits"]
    if d["C"] == 4:
        return elastic.ConformalHalfSpaces(scene["g"], scene["nu"], f["mx"], f["my"], f["dx"], f["dy"], f.y, scene["angles"])
    if d["C"] == 9:
        return elastic.Tabulated(scene["g"], scene["nu"], f["mx"], f["my"], f["dx"], f["dy"], coefficients(scene))
    if d["M"] == 1:
        chi, _, veloc = scene["rolling"][:3]
        return elastic.ViscoelasticHalfSpaces(scene["g"], scene["nu"], f["mx"], f["my"], f["dx"], f["dy"], scene["material"], veloc,
                                              1 if math.cos(chi) > 0 else -1)
    return elastic.HalfSpaces(scene["g"], scene["nu"], f["mx"], f["my"], f["dx"], f["dy"], hats=d["C"] == 3)


def rigid_slip(scene, case, f, totals, eps_offset=True):
    """Rigid slip over the elements (relative in rolling, a distance in a shift), with the computed creepages"""
    d = scene["digits"]
    cksi = totals.get("cksi" if d["T"] >= 2 else "shift_x")
    ceta = totals.get("ceta" if d["T"] >= 2 else "shift_y")
    cksi = case["x"] if case["F"] == 0 or cksi is None else cksi
    ceta = case["y"] if case["F"] < 2 or ceta is None else ceta
    xo, yo = case.get("centre", (0.0, 0.0))
    if d["T"] >= 2:
        chi, dq, _, *factor = scene["rolling"]
        dq = step_of(scene, f)
        ahead = (factor[0] if factor else 1/6)*dq
        xo, yo = xo - ahead*math.cos(chi), yo - ahead*math.sin(chi)
    # E = 2 and 3 omit one part of the spin
    fx, fy = d["E"] != 3, d["E"] != 2
    wx = cksi - fx*case["phi"]*(f.y[:, np.newaxis] - yo) + 0*f.x[np.newaxis, :]
    wy = ceta + fy*case["phi"]*(f.x[np.newaxis, :] - xo) + 0*f.y[:, np.newaxis]
    if "extra" in case:
        extra = np.array(case["extra"]).reshape(f["my"], f["mx"], 2)
        wx, wy = wx + extra[:, :, 0], wy + extra[:, :, 1]
    return wx, wy


def step_of(scene, f):
    """Distance rolled per case: DQ, replaced by DX if the method has steps of one element"""
    d = scene["digits"]
    dq = scene["rolling"][1]
    if d["T"] == 3 or d["M"] == 4:
        # methods with steps of one element replace it, with a warning
        used = f.get("dq", f["dx"])
        return f["dx"] if abs(used - f["dx"]) < abs(used - dq) + 1e-12*dq else dq
    return dq


def previous_tractions(scene, k, fields, state):
    """px', py', pn' of the case, or None if this judge cannot compute them"""
    case = scene["cases"][k - 1]
    zero = np.zeros((fields[k]["my"], fields[k]["mx"]))
    if k == 1 or case["P"] == 2:
        return zero, zero, zero
    if case["P"] == 3:
        previous = state.get("previous")
        return previous and tuple(in_window(scene, k, field) for field in previous)
    last = fields[k - 1]
    if case["P"] == 1:
        return zero, zero, in_window(scene, k, last["pn"])
    return tuple(in_window(scene, k, last[name]) for name in ("px", "py", "pn"))


def judge_contact(scene, k, run, fields, findings, state):
    """Contact conditions by direct sums"""
    d, case, f = scene["digits"], scene["cases"][k - 1], fields[k]
    totals, record = run.totals(k), run.cases[k - 1]
    state["previous"] = previous = previous_tractions(scene, k, fields, state)
    if d["T"] == 3:
        state["previous"] = (f["px"], f["py"], f["pn"])
    pn, px, py, error = f["pn"], f["px"], f["py"], f["error"]
    inside = f["eldiv"] > 0
    top = pn.max()
    if top <= 0:
        h = np.where(state["out"], np.inf, state["h"])
        if d["B"] in (0, 1, 5) and not case["N"]:
            exceeds(findings, "gap", f"no contact in case {k}, and an overlap", case["load"] - h.min(), 1e-9*abs(case["load"]))
        return
    converged = is_converged(record)
    exceeds(findings, "tension", f"pressure in case {k}", -pn.min()/top, 0.0)
    if (np.abs(pn)[~inside] + np.abs(px)[~inside] + np.abs(py)[~inside]).sum() > 0:
        findings.append(finding("tension", f"tractions outside the contact of case {k}"))
    if state["out"].any() and inside[state["out"]].any():
        findings.append(finding("planform", f"contact outside the planform in case {k}"))
    mu = f["mu"]
    judge_friction_law(scene, k, f, findings, converged)
    bound = mu*pn if d["B"] != 3 else pn*0 + np.inf
    if d["M"] == 4 and "taucrt" in f:
        bound = np.minimum(bound, f["taucrt"])
    if d["T"]:
        # the iteration of a friction law ends when slip has converged within a thousandth
        loose = 3e-3 if d["L"] else 0.0
        exceeds(findings, "bound", f"traction above its bound in case {k}", (np.hypot(px, py) - bound)[inside].max()/(mu.max()*top),
                (ALLOWANCE*scene["eps"] if converged else 1e-3) + 4*error + loose)
    if not converged:
        return
    state["cut"] = k > 1 and "move" in case and not math.isclose(in_window(scene, k, fields[k - 1]["pn"]).sum(),
                                                                fields[k - 1]["pn"].sum())
    state["plastic"] = plastic_before(scene, k, fields, state)
    if d["M"] == 1 and f["mx"]*f["my"] > 80:
        # takes seconds
        return
    if d["M"] in (2, 3, 5):
        if d["B"] == 0 and elastic_uncoupled(scene):
            judge_normal(scene, k, f, state, totals, findings, half_spaces(scene, f), coupled=False)
        if d["M"] == 2 and d["T"]:
            judge_springs(scene, k, f, previous, totals, findings)
    else:
        spaces = half_spaces(scene, f)
        # below 1e-4 the difference parameter counts as none for the pressures, and MAXOUT becomes 1, with a warning
        alike = abs(spaces.k) < 1e-4 and d["C"] in (2, 3) and d["M"] != 1
        coupled = spaces.coupled and scene["maxout"] > 1 and not alike
        if d["B"] in (0, 1) and (coupled or not spaces.coupled or case["I"] == 0):
            judge_normal(scene, k, f, state, totals, findings, spaces, coupled)
        if d["T"]:
            judge_tangential(scene, k, run, f, previous, findings, spaces, state["plastic"], state)
            if d["L"] in (2, 3, 4):
                judge_falling_friction(scene, k, fields, findings)
    if d["H"] and d["T"] == 3:
        judge_temperature(scene, k, f, findings)
    if d["S"] and d["C"] != 3:
        judge_stress(scene, k, run, f, findings)


def elastic_uncoupled(scene):
    return abs(elastic.combined(scene["g"], scene["nu"])[2]) < 1e-6 and scene["digits"]["C"] == 2


def judge_friction_law(scene, k, f, findings, converged):
    """Coefficients of friction are within the range of the law, constant ones are those of the input"""
    d, inside = scene["digits"], f["eldiv"] > 0
    if not d["T"] or d["M"] in (2, 3, 5):
        return
    if d["V"] == 3 and d["L"] and (offset_of(scene, k)[1] or abs(math.sin(scene.get("rolling", [0])[0])) > 1e-3):
        # particles carry coefficients from rows with another law
        return
    rows = np.array(scene["friction"])
    if d["V"] == 0:
        rows = np.repeat(rows, f["my"], axis=0)
    if d["L"] == 0:
        low = high = rows[:, 0]
    elif d["L"] == 6:
        low, high = np.minimum(rows[:, 0], rows[:, 0] + rows[:, 2]), np.maximum(rows[:, 0], rows[:, 0] + rows[:, 2])
    else:
        low, high = rows[:, 0], rows[:, 0] + rows[:, 1] + rows[:, 3]
    below = (low[:, np.newaxis] - f["mu"])[inside].max()
    above = (f["mu"] - high[:, np.newaxis])[inside].max()
    exceeds(findings, "friction", f"coefficients of case {k} are those of the law", max(below, above)/high.max(), 1e-9 + f["error"])


def judge_normal(scene, k, f, state, totals, findings, spaces, coupled):
    """No gap in contact, no overlap outside, relative to the approach"""
    pn = f["pn"]
    un = spaces.displacement("n", f["px"], f["py"], pn, coupled=coupled)
    if scene["digits"]["B"] == 1:
        un = un + scene["sheet"]*pn
    pen = totals["pen"]
    h = np.where(state["out"], 0.0, state["h"])
    gap = np.where(state["out"], 1e30, h - pen + un)
    inside = f["eldiv"] > 0
    lowest = h[~state["out"]].min()
    scale = max(abs(pen), pen - lowest, np.abs(un).max()*0.1)
    size = np.abs(gap[inside]).max()
    if (~inside & ~state["out"]).any():
        size = max(size, -gap[~inside & ~state["out"]].min())
    allowance = 1.0 if not coupled else 5.0
    exceeds(findings, "gap", f"contact conditions of case {k}", size/scale, ALLOWANCE*allowance*scene["eps"] + 1e-10 + 10*f["error"]
            + (QUADRATURE if scene["digits"]["M"] == 1 else 0.0))


def judge_tangential(scene, k, run, f, previous, findings, spaces, plastic, state):
    """Slip against traction on the bound, none below it: the projected residual relative to the bound"""
    d, case, totals = scene["digits"], scene["cases"][k - 1], run.totals(k)
    if previous is None:
        return
    if "move" in case and case["P"] != 2 and k > 1 and d["T"] in (1, 2) and state.get("cut"):
        # formerly loaded elements are outside the new window
        return
    if spaces.coupled and case["P"] == 1 and k > 1:
        return
    px, py, pn = f["px"], f["py"], f["pn"]
    inside = f["eldiv"] > 0
    wx, wy = rigid_slip(scene, case, f, totals)
    layer = 0.0
    if d["M"] == 4:
        layer = scene["material"][1]/scene["material"][0] if scene["material"][1] >= 1e-10 else 0.0
    now = [spaces.displacement(c, px, py, pn) for c in "xy"]
    now[0], now[1] = now[0] + layer*px, now[1] + layer*py
    if d["T"] == 1:
        before = [spaces.displacement(c, *previous) for c in "xy"]
        before[0], before[1] = before[0] + layer*previous[0], before[1] + layer*previous[1]
        step = 1.0
    else:
        chi, step = scene["rolling"][0], step_of(scene, f)
        ahead = (step*math.cos(chi), step*math.sin(chi))
        if abs(math.sin(chi)) < 1e-9:
            ahead = (ahead[0], 0.0)
        old = (px, py, pn) if d["T"] == 3 else previous
        before = [spaces.displacement(c, *old, ahead=ahead) for c in "xy"]
        if layer:
            sign = 1 if math.cos(chi) > 0 else -1
            # tractions at the previous position of the particle, between two elements
            whole = int(step/f["dx"] + 1e-6)
            part = max(0.0, step/f["dx"] - whole)
            for c in (0, 1):
                there = (1 - part)*elastic.shifted(old[c], sign*whole, 0) + part*elastic.shifted(old[c], sign*(whole + 1), 0)
                before[c] = before[c] + layer*there
        along = abs(math.sin(chi)) < 1e-9
        is_reported = "DQ is larger than DX" in run.text(".out")
        if step > f["dx"]*1.01 and along and (not is_reported or (d["T"] == 2 and case["F"] == 0)):
            wx, wy, before = leading_edge(f, wx, wy, before, old, spaces, chi, step)
    sx, sy = wx*step + now[0] - before[0], wy*step + now[1] - before[1]
    bound = f["mu"]*pn
    if "taucrt" in f:
        if plastic is None:
            return
        growth = [f["uplsx"] - plastic[0], f["uplsy"] - plastic[1]]
        sx, sy = sx + growth[0], sy + growth[1]
        judge_yield(scene, k, f, growth, plastic[2], np.hypot(wx, wy).max()*step, findings)
        bound = np.minimum(bound, f["taucrt"])
    r = 1.0/(spaces.centre("xx") + layer)
    qx, qy = px - r*sx, py - r*sy
    size = np.hypot(qx, qy)
    cut = np.where(size > bound, bound/np.where(size > 0, size, 1), 1.0)
    residual = math.sqrt((((px - cut*qx)**2 + (py - cut*qy)**2)[inside]).sum()/(((f["mu"]*pn)[inside]**2).sum() + 1e-300))
    limit = ALLOWANCE*scene["eps"] + 1e-9 + 20*f["error"] + (QUADRATURE if d["M"] == 1 else 0.0)
    reported = run.cases[k - 1]["patches"][0]["solver"].get("tangential_residual")
    if reported is not None and reported > scene["eps"]:
        # methods that stop by their last update report their residual
        limit = max(limit, ALLOWANCE*reported)
    if spaces.coupled:
        limit *= 5
    exceeds(findings, "slip", f"tangential conditions of case {k}", residual, limit)
    # printed slip agrees with that computed from the tractions
    scale = np.hypot(wx, wy).max()*step + np.hypot(now[0], now[1]).max()
    slipping = f["eldiv"] == 2
    for name, s in (("sx", sx), ("sy", sy)):
        if f["error"] == 0 and slipping.any():
            exceeds(findings, "slip", f"printed {name} of case {k}", np.abs((f[name]*step - s)[slipping]).max()/scale,
                    10*scene["eps"] + 1e-8 + (5e-3 if d["L"] else 0.0) + (QUADRATURE if d["M"] == 1 else 0.0))


def upstream(field, sign):
    """Field of the element from which particles come, 0 beyond the window"""
    result = np.zeros_like(field)
    if sign > 0:
        result[:, :-1] = field[:, 1:]
    else:
        result[:, 1:] = field[:, :-1]
    return result


def leading_edge(f, wx, wy, before, old, spaces, chi, step):
    """Particles that entered the contact during the step: their fraction of the rigid slip, and the displacement at the
    centre of the first exterior element upstream"""
    sign = 1 if math.cos(chi) > 0 else -1
    inside = f["eldiv"] > 0
    share = np.ones(inside.shape)
    edge = np.full(inside.shape, -1)
    my, mx = inside.shape
    for j in range(my):
        first = None
        for i in (range(mx - 1, -1, -1) if sign > 0 else range(mx)):
            if not inside[j, i]:
                first = i
            elif first is not None:
                share[j, i] = min(1.0, abs(first - i)*f["dx"]/step)
                edge[j, i] = first
            else:
                edge[j, i] = -2
    u = [spaces.displacement(c, *old) for c in "xy"]
    part = share < 0.9999
    rows = np.arange(my)[:, np.newaxis] + 0*edge
    before = [np.where(part, u[c][rows, np.maximum(edge, 0)], before[c]) for c in (0, 1)]
    return wx*share, wy*share, before


def plastic_before(scene, k, fields, state):
    """Plastic displacements and yield limit of the particles a step ago (upx, upy, limit); None if unknown to this judge"""
    d, f, case = scene["digits"], fields[k], scene["cases"][k - 1]
    if "taucrt" not in f or not d["T"]:
        return None
    fresh = scene["material"][2]
    zero = np.zeros_like(f["pn"])
    if d["T"] == 3:
        source = f
    elif k == 1 or case["P"] in (1, 2):
        return zero, zero, zero + fresh
    elif case["P"] == 3:
        return state.get("plastic")
    else:
        source = fields[k - 1]
        if "taucrt" not in source or "move" in case:
            return None
    if d["T"] == 1:
        return source["uplsx"], source["uplsy"], source["taucrt"]
    sign = 1 if math.cos(scene["rolling"][0]) > 0 else -1
    return (upstream(source["uplsx"], sign), upstream(source["uplsy"], sign), upstream(source["taucrt"] - fresh, sign) + fresh)


def judge_yield(scene, k, f, growth, limit_before, slip, findings):
    """Plastic flow is parallel to the traction and changes the yield limit by K_TAU"""
    tau, slope = scene["material"][2:4]
    size = np.hypot(*growth)
    scale = max(size.max(), slip, 1e-300)
    inside = f["eldiv"] > 0
    # an element that slips may have hardened up to the bound of friction in this step
    plastic = (f["eldiv"] == 3) | ((f["eldiv"] == 2) & (size > 0))
    pt = np.hypot(f["px"], f["py"])
    # relative to the yield limit; the solvers' tolerance is relative to the bound of friction
    tolerance = 10*scene["eps"]*max(1.0, (f["mu"]*f["pn"]).max()/tau) + 1e-9 + 20*f["error"]
    if (~plastic & inside).any():
        exceeds(findings, "yield", f"plastic flow of elements that do not yield, case {k}", size[~plastic & inside].max() / scale,
                tolerance)
    want = np.maximum(limit_before + slope*size, 0.1*tau)
    exceeds(findings, "yield", f"yield limit of case {k}", np.abs(want - f["taucrt"])[inside].max()/tau,
            tolerance + abs(slope)*scale/tau*tolerance)
    if plastic.any():
        exceeds(findings, "yield", f"traction of yielding elements, case {k}", np.abs(pt - f["taucrt"])[plastic].max() / tau,
                tolerance)
        cross = np.abs(growth[0]*f["py"] - growth[1]*f["px"])[plastic].max()/(scale*tau)
        exceeds(findings, "yield", f"direction of plastic flow, case {k}", cross, 10*tolerance)
        along = (growth[0]*f["px"] + growth[1]*f["py"])[plastic].min()/(scale*tau)
        exceeds(findings, "yield", f"plastic flow against the traction, case {k}", -along, tolerance)


def judge_falling_friction(scene, k, fields, findings):
    """Coefficients follow from the slip by the law with its memory; the loop ends when slip has converged within 0.1 %"""
    d, case, f = scene["digits"], scene["cases"][k - 1], fields[k]
    if (case["P"] == 3 or "move" in case) and k > 1:
        return
    inside = f["eldiv"] > 0
    veloc, dq, chi = (scene["rolling"][2], step_of(scene, f), scene["rolling"][0]) if d["T"] >= 2 else (1.0, 1.0, 0.0)
    if d["T"] == 2 and abs(dq/f["dx"] - 1) > 1e-3 and k > 1 and case["P"] == 0:
        return
    speed = np.hypot(f["sx"], f["sy"])*veloc
    rows = np.array(scene["friction"])
    rows = np.repeat(rows, f["my"], axis=0) if d["V"] == 0 else rows
    mk, m1, s1, m2, s2 = (rows[:, i][:, np.newaxis] for i in range(5))
    s1, s2 = np.maximum(s1, np.where(m1 == 0, 1e-4, 0)), np.maximum(s2, np.where(m2 == 0, 1e-4, 0))
    law = {2: lambda v: mk + m1*np.maximum(0, 1 - v/(2*s1)) + m2*np.maximum(0, 1 - v/(2*s2)),
           3: lambda v: mk + m1/(1 + v/s1) + m2/(1 + (v/s2)**2), 4: lambda v: mk + m1*2**(-v/s1) + m2*2**(-v/s2)}[d["L"]]
    distance, lowest = scene["memory"]
    theta = distance/(distance + dq/veloc*np.maximum(speed, lowest)) if distance > 1e-9 else 0*speed
    target, static = law(speed), mk + m1 + m2 + 0*speed
    sign = 1 if math.cos(chi) > 0 else -1
    if d["T"] == 3:
        mu = np.empty_like(target)
        last = static[:, 0]
        for i in (range(f["mx"] - 1, -1, -1) if sign > 0 else range(f["mx"])):
            last = theta[:, i]*last + (1 - theta[:, i])*target[:, i]
            mu[:, i] = last
    else:
        old = static
        if k > 1 and case["P"] == 0:
            old = fields[k - 1]["mu"]
            if d["T"] == 2:
                if abs(math.sin(chi)) > 1e-3:
                    return
                old = upstream(old - static, sign) + static
        mu = theta*old + (1 - theta)*target
    error = math.sqrt((((mu - f["mu"])**2)[inside]).sum()/inside.sum())/static.max()
    exceeds(findings, "friction", f"coefficients of case {k} by the law, mean square", error, 1e-2)


def judge_springs(scene, k, f, previous, totals, findings):
    """Fastsim with one flexibility: a march through each row from the leading edge, or the same for each particle"""
    d, case = scene["digits"], scene["cases"][k - 1]
    flexibility, k0, alpha, _ = scene["material"]
    if alpha < 1 or previous is None or (case["P"] == 3 and k > 1):
        return
    stiffness = k0/flexibility
    wx, wy = rigid_slip(scene, case, f, totals)
    chi, _, _, *_ = scene["rolling"] if d["T"] >= 2 else (0.0, 1.0, 1.0)
    step = f["dx"] if d["T"] == 3 else scene["rolling"][1] if d["T"] == 2 else 1.0
    bound = f["mu"]*f["pn"]
    inside = f["eldiv"] > 0
    sign = 1 if math.cos(chi) > 0 else -1
    px, py = np.zeros_like(bound), np.zeros_like(bound)
    if d["T"] == 3:
        qx, qy = np.zeros(f["my"]), np.zeros(f["my"])
        for i in (range(f["mx"] - 1, -1, -1) if sign > 0 else range(f["mx"])):
            qx, qy = qx - stiffness*step*wx[:, i], qy - stiffness*step*wy[:, i]
            size = np.hypot(qx, qy)
            cut = np.where(size > bound[:, i], bound[:, i]/np.where(size > 0, size, 1), 1.0)*inside[:, i]
            qx, qy = cut*qx, cut*qy
            px[:, i], py[:, i] = qx, qy
    else:
        ox, oy = previous[:2]
        if d["T"] == 2:
            if (abs(step/f["dx"] - 1) > 1e-3 and k > 1 and case["P"] == 0) or abs(math.sin(chi)) > 1e-3:
                return
            ox, oy = upstream(ox, sign), upstream(oy, sign)
        qx, qy = ox - stiffness*step*wx, oy - stiffness*step*wy
        size = np.hypot(qx, qy)
        cut = np.where(size > bound, bound/np.where(size > 0, size, 1), 1.0)*inside
        px, py = cut*qx, cut*qy
    error = max(np.abs(px - f["px"]).max(), np.abs(py - f["py"]).max())/bound.max()
    exceeds(findings, "springs", f"tractions of case {k}", error, 1e-8 + 20*f["error"])


def judge_temperature(scene, k, f, findings):
    """Surface temperatures in the contact: heat that particles absorbed on their way, that of the current element by the
    established factor; equal temperatures of both surfaces"""
    if "temp1" not in f or scene["digits"]["M"] in (2, 3, 5) or "taucrt" in f:
        return
    (t1, c1, l1, r1), (t2, c2, l2, r2) = scene["heat"]
    b1, b2 = 1e3*math.sqrt(l1*r1*c1), 1e3*math.sqrt(l2*r2*c2)
    chi, _, veloc, *_ = scene["rolling"]
    dx, dq = f["dx"], step_of(scene, f)
    heat = np.hypot(f["sx"], f["sy"])*np.hypot(f["px"], f["py"])*veloc*(f["eldiv"] > 1)
    if chi not in (0.0, math.pi) or abs(dq/dx - 1) > 1e-6:
        return
    if chi == 0.0:
        heat = heat[:, ::-1]
    total = np.zeros_like(heat)
    for i in range(f["mx"]):
        for j in range(i):
            total[:, i] += heat[:, j]*(math.sqrt((i - j + 0.5)*dx) - math.sqrt((i - j - 0.5)*dx))
        total[:, i] += heat[:, i]*2*math.sqrt(0.5*dx)
    rise = 2/((b1 + b2)*math.sqrt(math.pi*veloc))*total
    if chi == 0.0:
        rise = rise[:, ::-1]
    middle = (b1*t1 + b2*t2)/(b1 + b2)
    inside = f["eldiv"] > 0
    # rows with one interval of contact: after a gap the bodies have already exchanged heat
    single = (np.diff(np.pad(inside, ((0, 0), (1, 1))).astype(int), axis=1) == 1).sum(axis=1) == 1
    chosen = inside & single[:, np.newaxis]
    if not chosen.any():
        return
    scale = max(rise.max(), abs(t1 - t2), 1e-6*abs(middle), 1e-12)
    for name in ("temp1", "temp2"):
        exceeds(findings, "temperature", f"{name} of case {k}", np.abs(f[name] - middle - rise)[chosen].max() / scale, 1e-6
                + 20 * f["error"])


def judge_stress(scene, k, run, f, findings):
    """Normal stress at the largest depth by point forces (Boussinesq and Cerruti: the same for all Poisson ratios)"""
    if judge.h5py is None:
        return
    with judge.h5py.File(run.path(".h5"), "r") as file:
        place = file[f"case_{k:04d}/patch_1"]
        if "subsurface/block_1/sigzz" not in place:
            findings.append(finding("stress", f"no stresses of case {k}"))
            return
        block = place["subsurface/block_1"]
        depth, stress = block["points/z"][-1], block["sigzz"][-1]
        finite = all(np.isfinite(block[name][()]).all() for name in block if name != "points")
    if not finite:
        findings.append(finding("numbers", f"stresses of case {k}"))
        return
    if depth < 0.7*max(f["dx"], f["dy"]) or stress.shape != f["pn"].shape:
        return
    x, y = f.x[np.newaxis, :], f.y[:, np.newaxis]
    want = np.zeros_like(stress)
    places, weights = np.array([-1, 0, 1])*math.sqrt(0.15), np.array([5, 8, 5])/18
    for j, i in zip(*np.nonzero(f["pn"])):
        for a in range(3):
            for b in range(3):
                dx, dy = x - f.x[i] - places[a]*f["dx"], y - f.y[j] - places[b]*f["dy"]
                r5 = (dx*dx + dy*dy + depth*depth)**2.5
                want -= weights[a]*weights[b]*f.area*3*depth**2/(2*math.pi*r5)*(
                    f["px"][j, i]*dx + f["py"][j, i]*dy + f["pn"][j, i]*depth)
    exceeds(findings, "stress", f"SIGZZ of case {k} at z = {depth:.4g}", np.abs(want - stress).max()/np.abs(want).max(), 0.02)


def hertz_of(scene, case):
    """Hertz's solution of an IPOTCN -1 ... -3 for the load of a case: semi-axes, curvatures, approach, force, largest
    pressure"""
    ip, values = scene["grid"]["ipotcn"], scene["grid"]["values"]
    g, nu, _ = elastic.combined(scene["g"], scene["nu"])
    modulus = g/(1 - nu)
    if ip == -1:
        ratio = _axes_ratio(values[0]/values[1], modulus)
    elif ip == -2:
        ratio = values[1]
    else:
        ratio = values[0]/values[1]
    # unit of length b = 1
    ax, by, approach, force = elastic.hertz_from_axes(ratio, 1.0, modulus)
    # with b as a scale: A = p0 ax/b, approach = p0 b, force = p0 b2
    if ip == -3:
        a, b = values[0], values[1]
        p0 = case["load"]/(force*b*b) if case["N"] else case["load"]/(approach*b)
    else:
        curvature = values[0]
        # p0 = A b/ax
        if case["N"]:
            b = (case["load"]*ax/(force*curvature))**(1/3)
        else:
            b = math.sqrt(case["load"]*ax/(approach*curvature))
        a, p0 = ratio*b, curvature*b/ax
    return {"a": a, "b": b, "A": p0*ax/b, "B": p0*by/b, "pen": p0*approach*b, "fn": p0*force*b*b, "pmax": p0}


def _axes_ratio(curvature_ratio, modulus):
    """a/b for A/B, by bisection in the logarithm"""
    low, high = math.log(1e-6), math.log(1e6)
    for _ in range(200):
        middle = 0.5*(low + high)
        ax, by, _, _ = elastic.hertz_from_axes(math.exp(middle), 1.0, modulus)
        if ax/by > curvature_ratio:
            low = middle
        else:
            high = middle
    return math.exp(0.5*(low + high))


def judge_hertz(scene, k, run, f, findings):
    """Hertzian input: the grid is scaled by the Hertzian ellipse; the result is close to Hertz's solution on fine grids"""
    d, case, t = scene["digits"], scene["cases"][k - 1], run.totals(k)
    if scene["grid"]["ipotcn"] not in (-1, -2, -3) or case["keep"] or case["load"] <= 0:
        return
    hz = hertz_of(scene, case)
    scale = scene["grid"]["values"][-1]
    for name, count, axis in (("dx", "mx", "a"), ("dy", "my", "b")):
        want = 2*scale*hz[axis]/f[count]
        exceeds(findings, "hertz", f"{name.upper()} of case {k}", abs(f[name]/want - 1), 1e-6 + 2*f["error"])
    h = hz["A"]*f.x[np.newaxis, :]**2 + hz["B"]*f.y[:, np.newaxis]**2
    exceeds(findings, "hertz", f"undeformed distance of case {k}", judge.relative(f["h"] - h, h.max()), 1e-6 + 2*f["error"])
    elements = min(f["mx"], f["my"])/scale
    if (d["B"] == 0 and d["C"] in (2, 3) and d["M"] != 1 and elements >= 6 and scale >= 1.05 and scene["maxout"] >= 1
        and is_converged(run.cases[k - 1])):
        coupling = abs(elastic.combined(scene["g"], scene["nu"])[2])
        limit = 1.0/elements + coupling
        for name in ("pen", "fn", "pmax"):
            exceeds(findings, "hertz", f"{name.upper()} of case {k}", abs(t[name]/hz[name] - 1), limit)
    if d["B"] == 2:
        # the shape is that of the formula at the centres, the sum is the force
        want = np.sqrt(np.clip(1 - (f.x[np.newaxis, :]/hz["a"])**2 - (f.y[:, np.newaxis]/hz["b"])**2, 0, None))
        want *= hz["fn"]/(want.sum()*f.area)
        exceeds(findings, "hertz", f"pressures of case {k}", np.abs(f["pn"] - want).max()/want.max(), 0.05/elements**1.5 + 1e-6)


# ------------------------------------------------------------------------------------------- equivalent problems

def variant(scene, run, fields, tools, findings):
    """An equivalent problem"""
    name = scene.get("variant")
    if name == "library":
        by_library(scene, run, fields, tools, findings)
        return
    if name == "refined":
        refined(scene, run, fields, tools, findings)
        return
    if name == "interleaved":
        interleaved(scene, run, tools, findings)
        return
    if name == "threads":
        second = tools.run("run2", text_of(scene), other_files(scene), options=("--json", "--quiet", "--strict"), threads=2)
        good = all(is_converged(record) for record in run.cases)
        if (second.code == 0) != good:
            findings.append(finding("strict", f"exit code {second.code} with --strict, all cases converged: {good}"))
        second.code = run.code
        same_totals("threads", run, second, scene, findings)
        return
    views = {"mirror_y": mirrored_y, "mirror_x": mirrored_x, "scaled": scaled, "moved": moved, "interchanged": interchanged}
    other, view = views.get(name, lambda s: (None, None))(copy.deepcopy(scene))
    if other is None:
        return
    second = tools.run("other", text_of(other), other_files(other))
    if name == "scaled" and second.code == 1 and "bound" in second.errors:
        # scaled beyond the bounds of the input
        return
    if second.code != run.code:
        findings.append(finding(name, f"exit codes {run.code} and {second.code}: {judge.without_numbers(second.errors)}"))
        return
    for k in range(1, len(scene["cases"]) + 1):
        one, two = run.cases[k - 1], second.cases[k - 1]
        if one.get("solved") != two.get("solved"):
            findings.append(finding(name, f"case {k} is solved in one view only"))
            return
        if not (one.get("solved") and is_converged(one) and is_converged(two)):
            return
        compare(scene, k, name, fields[k], Fields(second.fields(k)), run.totals(k), second.totals(k), view, findings)


def compare(scene, k, name, first, second, t1, t2, view, findings):
    """Pressures, tractions and forces of two views; view(field name, field) brings the second into the first"""
    d = scene["digits"]
    eps = scene["eps"]
    limit = AMPLIFICATION*eps + 20*first["error"]
    if d["G"] in (2, 3, 5) or d["L"]:
        limit = max(limit, 2e-2)
    top = first["pn"].max()
    if top <= 0:
        return
    bound = top*max(first["mu"].max(), 1e-30)
    area = max(int((first["eldiv"] > 0).sum()), 1)
    exceeds(findings, name, f"pressures of case {k}", np.abs(view("pn", second["pn"]) - first["pn"]).max()/top, limit)
    if d["T"]:
        for field in ("px", "py"):
            difference = view(field, second[field]) - first[field]
            exceeds(findings, name, f"{field} of case {k}", math.sqrt((difference**2).sum()/area)/bound, limit)
    for total in ("fn", "pen", "pmax"):
        if t1.get(total) is not None and t2.get(total) is not None and total != "pen":
            exceeds(findings, name, f"{total.upper()} of case {k}", abs(view(total, t2[total])/t1[total] - 1), limit)


def _flip(axis, sign_of):
    def view(name, value):
        if np.ndim(value) == 2:
            return sign_of.get(name, 1)*np.flip(value, axis=axis)
        return value
    return view


def mirrored_y(s):
    """y to -y"""
    if s["digits"]["C"] == 9:
        return None, None
    grid, my, mx = s["grid"], s["grid"]["my"], s["grid"]["mx"]
    if grid["ipotcn"] > 0:
        grid["yl"] = -(grid["yl"] + my*grid["dy"])
        b = grid["gap"]
        if grid["ibase"] == 1:
            b[1], b[4] = -b[1], -b[4]
        elif grid["ibase"] == 2:
            b[3] = -(b[3] + (int(b[0]) - 1)*b[4])
            b[5:] = b[:4:-1]
        elif grid["ibase"] == 9:
            grid["gap"] = np.array(b).reshape(my, mx)[::-1].ravel().tolist()
        p = grid.get("plan")
        if grid["iplan"] == 2:
            p[1], p[4] = -p[1], -p[4]
        elif grid["iplan"] == 3:
            p[2], p[3], p[6], p[7] = -p[3], -p[2], -p[7], -p[6]
    elif grid["ipotcn"] == -6:
        v = grid["values"]
        v[1], v[2] = v[2], v[1]
    if s["digits"]["V"] == 3:
        s["friction"].reverse()
    if "rolling" in s and s["rolling"][0] != math.pi:
        s["rolling"][0] = -s["rolling"][0]
    if "angles" in s:
        s["angles"][2] = [[-y, -angle] for y, angle in reversed(s["angles"][2])]
    for case in s["cases"]:
        case["y"], case["phi"] = -case["y"], -case["phi"]
        if "move" in case:
            case["move"][1] *= -1
        if "centre" in case:
            case["centre"][1] = -case["centre"][1]
        if "extra" in case:
            extra = np.array(case["extra"]).reshape(my, mx, 2)[::-1]*[1, -1]
            case["extra"] = extra.reshape(-1, 2).tolist()
    return s, _flip(0, {"py": -1})


def mirrored_x(s):
    """x to -x, rolling to the other side"""
    if s["digits"]["M"] == 1:
        return None, None
    grid, my, mx = s["grid"], s["grid"]["my"], s["grid"]["mx"]
    if grid["ipotcn"] > 0:
        grid["xl"] = -(grid["xl"] + mx*grid["dx"])
        b = grid["gap"]
        if grid["ibase"] == 1:
            b[1], b[3] = -b[1], -b[3]
        elif grid["ibase"] == 2:
            b[1] = -b[1]
        elif grid["ibase"] == 3:
            b[0], b[2], b[3], b[5] = -b[0], -b[2], -b[3], -b[5]
        else:
            grid["gap"] = np.array(b).reshape(my, mx)[:, ::-1].ravel().tolist()
        p = grid.get("plan")
        if grid["iplan"] == 2:
            p[1], p[3] = -p[1], -p[3]
        elif grid["iplan"] == 3:
            p[0], p[1], p[4], p[5] = -p[1], -p[0], -p[5], -p[4]
    if "rolling" in s:
        chi = s["rolling"][0]
        s["rolling"][0] = {0.0: math.pi, math.pi: 0.0}.get(chi, math.copysign(math.pi, chi) - chi)
    for case in s["cases"]:
        case["x"], case["phi"] = -case["x"], -case["phi"]
        if "move" in case:
            case["move"][0] *= -1
        if "centre" in case:
            case["centre"][0] = -case["centre"][0]
        if "extra" in case:
            extra = np.array(case["extra"]).reshape(my, mx, 2)[:, ::-1]*[-1, 1]
            case["extra"] = extra.reshape(-1, 2).tolist()
    return s, _flip(1, {"px": -1})


def interchanged(s):
    """Body 1 in place of body 2: the image in the plane of contact, in which tractions on body 1 have the opposite direction"""
    if s["digits"]["C"] == 9:
        return None, None
    s["g"].reverse()
    s["nu"].reverse()
    if s["digits"]["M"] == 1:
        fg1, fg2, tc1, tc2 = s["material"]
        s["material"] = [fg2, fg1, tc2, tc1]
    if "heat" in s:
        s["heat"].reverse()
    if "angles" in s:
        s["angles"][2] = [[y, -angle] for y, angle in s["angles"][2]]
    for case in s["cases"]:
        for name in ("x", "y", "phi"):
            case[name] = -case[name]
        if "extra" in case:
            case["extra"] = [[-x, -y] for x, y in case["extra"]]
    return s, lambda name, value: -value if name in ("px", "py") else value


def scaled(s, length=1000.0, modulus=0.001):
    """All lengths times one factor, all moduli times another"""
    d, grid = s["digits"], s["grid"]
    if "sheet" in s:
        s["sheet"] *= (length/modulus if grid["mx"] % 2 == 0 else modulus/length)
    if d["H"] or d["C"] == 9 or d["B"] == 6:
        # temperatures have other units; the table is given in mm; ANALYN has a bound of 1e-4 per mm for curvatures
        return None, None
    if any(not case["N"] and abs(case["load"]) < 1e-5 for case in s["cases"]):
        # approaches below 1e-9 mm are raised to it
        return None, None
    ell, mod = length, modulus
    if grid["mx"] % 2:
        ell, mod = 1/length, 1/modulus
    shift = d["T"] < 2
    s["g"] = [value*mod for value in s["g"]]

    def times(values, factors):
        return [value*factor for value, factor in zip(values, factors)]

    if grid["ipotcn"] > 0:
        for name in ("xl", "yl", "dx", "dy"):
            grid[name] *= ell
        b = grid["gap"]
        if grid["ibase"] == 1:
            grid["gap"] = times(b, [1/ell]*3 + [1, 1, ell])
        elif grid["ibase"] == 3:
            grid["gap"] = times(b, [ell, 1/ell, ell, ell, 1/ell, ell, ell, ell])
        else:
            grid["gap"] = [value*ell for value in b]
            if grid["ibase"] == 2:
                grid["gap"][0] = b[0]
        if grid["iplan"] == 2:
            grid["plan"] = times(grid["plan"], [1/ell**2]*3 + [1/ell]*2 + [1])
        elif grid["iplan"] == 3:
            grid["plan"] = [value*ell for value in grid["plan"]]
    else:
        factors = {-1: [1 / ell, 1 / ell], -2: [1 / ell, 1], -3: [ell, ell], -4: [1 / ell, ell], -5: [ell, ell],
                   -6: [ell] * 3}[grid["ipotcn"]]
        grid["values"] = times(grid["values"], factors + [1])
    if "rolling" in s:
        s["rolling"][1] *= ell
    if d["L"] >= 2:
        s["memory"][0] *= ell
        if shift:
            s["memory"][1] *= ell
            s["friction"] = [times(row, [1, 1, ell, 1, ell]) for row in s["friction"]]
    if "material" in s:
        factors = {1: [1, 1, ell, ell], 2: [ell/mod, 1, 1, 1], 4: [mod, ell, mod, mod/ell]}.get(d["M"], [1]*5)
        s["material"] = times(s["material"], factors)
    if "angles" in s:
        s["angles"][2] = [[y*ell, angle] for y, angle in s["angles"][2]]
    if "points" in s:
        s["points"] = [[count, z*ell, dz*ell] for count, z, dz in s["points"]]
    for case in s["cases"]:
        case["load"] *= mod*ell**2 if case["N"] else ell
        if shift:
            for name in "xy":
                if case["F"] < (1 if name == "x" else 2):
                    case[name] *= ell
        else:
            case["phi"] /= ell
        if "centre" in case:
            case["centre"] = [value*ell for value in case["centre"]]
        if "extra" in case and shift:
            case["extra"] = [[x*ell, y*ell] for x, y in case["extra"]]

    def view(name, value):
        return value/{"fn": mod*ell**2, "pen": ell}.get(name, mod)
    return s, view


def moved(s):
    """Window and geometry moved together"""
    grid = s["grid"]
    if grid["ipotcn"] < 0 or s["digits"]["C"] == 4 or (grid["ibase"] == 3):
        return None, None
    x, y = 7.3*grid["dx"], -4.6*grid["dy"]
    grid["xl"] += x
    grid["yl"] += y
    b = grid["gap"]

    def shifted(q):
        return [q[0], q[1], q[2], q[3] - 2*q[0]*x - q[1]*y, q[4] - 2*q[2]*y - q[1]*x,
                q[5] + q[0]*x*x + q[1]*x*y + q[2]*y*y - q[3]*x - q[4]*y]

    if grid["ibase"] == 1:
        grid["gap"] = shifted(b)
    elif grid["ibase"] == 2:
        b[1] += x
        b[3] += y
    if grid["iplan"] == 2:
        grid["plan"] = shifted(grid["plan"])
    elif grid["iplan"] == 3:
        grid["plan"] = [value + (x, x, y, y)[i % 4] for i, value in enumerate(grid["plan"])]
    for case in s["cases"]:
        xo, yo = case.get("centre", (0.0, 0.0))
        case["centre"] = [xo + x, yo + y]
    return s, lambda name, value: value


def same_totals(name, run, second, scene, findings, chosen=lambda record: True):
    """Totals of two runs are those of one computation"""
    records = [record for record in second.cases if chosen(record)]
    if second.code != run.code or len(records) != len(run.cases):
        findings.append(finding(name, f"exit codes {run.code} and {second.code}, {len(run.cases)} and {len(records)} cases:"
                                f" {judge.without_numbers(second.errors)}"))
        return
    for k, record in enumerate(records, start=1):
        if not is_converged(run.cases[k - 1]):
            return
        t, u = run.totals(k), judge.plain_totals(record)
        scale = max(abs(t["fn"]), 1e-300)*min(1.0, scale_of_friction(scene))
        for total in ("fn", "fx", "fy"):
            if t.get(total) is not None:
                exceeds(findings, name, f"{total.upper()} of case {k}", abs(t[total] - u[total])/scale, LIBRARY*scene["eps"])


def interleaved(scene, run, tools, findings):
    """Two interleaved problems, each with its result element, give the results of each alone"""
    import module3
    other, _ = mirrored_y(copy.deepcopy(scene))
    if other is None:
        return
    other["cases"] = other["cases"][::-1]
    other["cases"][0].update(P=2, I=0, keep=False)
    for case in other["cases"]:
        case.pop("move", None)
    both = tools.run("both", module3.interleaved_text([scene, other]), other_files(scene))
    same_totals("interleaved", run, both, scene, findings, lambda record: record["result_element"] == 1)


def refined(scene, run, fields, tools, findings):
    """Half the size of elements: forces change by no more than the uncertainty of the contact borders"""
    d, grid, case = scene["digits"], scene["grid"], scene["cases"][0]
    if (d["B"] or d["L"] or d["V"] or d["M"] not in (0, 4) or d["T"] == 2 or d["C"] not in (2, 3) or d["E"]
        or grid.get("ibase") == 9):
        return
    if "material" in scene and scene["material"][2] > 0:
        return
    elements = int((fields[1]["eldiv"] > 0).sum())
    if min(grid["mx"], grid["my"]) < 6 or elements < 24 or elements > 600:
        return
    other = copy.deepcopy(scene)
    other["cases"] = other["cases"][:1]
    other["grid"]["mx"], other["grid"]["my"] = 2*grid["mx"], 2*grid["my"]
    if grid["ipotcn"] > 0:
        other["grid"]["dx"], other["grid"]["dy"] = grid["dx"]/2, grid["dy"]/2
    if "rolling" in scene:
        other["rolling"][1] /= 2
    second = tools.run("other", text_of(other))
    if second.code != 0 or not (second.cases and second.cases[0].get("solved")):
        findings.append(finding("refined", f"exit code {second.code}: {judge.without_numbers(second.errors)}"))
        return
    if not (is_converged(run.cases[0]) and is_converged(second.cases[0])):
        return
    t1, t2, f2 = run.totals(1), second.totals(1), Fields(second.fields(1))
    limit = 2.5/math.sqrt(elements)
    mu = scale_of_friction(scene)
    for name, scale in (("fn", t2["fn"]), ("fx", mu*t2["fn"]), ("fy", mu*t2["fn"])):
        if t1.get(name) is not None and scale > 0 and (d["T"] or name == "fn"):
            exceeds(findings, "refined", f"{name.upper()}: {t1[name]:.5g}, finer {t2[name]:.5g}", abs(t1[name] - t2[name]) / scale,
                    limit)
    area = f2.area*(f2["eldiv"] > 0).sum()
    exceeds(findings, "refined", "contact area", abs(fields[1].area*elements/area - 1), 2*limit)
    if case["N"] and grid["ipotcn"] > 0:
        depth = t2["pen"] - f2["h"].min()
        exceeds(findings, "refined", "approach", abs(t1["pen"] - t2["pen"])/depth, limit)


def expressible(scene):
    """Does the library have calls for all inputs of a scene?"""
    d, grid = scene["digits"], scene["grid"]
    if d["C"] in (4, 9) or d["V"] or d["S"] or d["B"] == 1 or grid.get("iplan", 1) != 1 or len(scene.get("rolling", [])) > 3:
        return False
    if d["H"] and d["M"] == 4:
        return False
    for case in scene["cases"]:
        if case["keep"] and grid["ipotcn"] < 0:
            # the library recomputes the Hertzian grid for each load
            return False
        if "centre" in case or "damping" in case or "move" in case:
            return False
        if case["F"] and max(abs(case["x"]), abs(case["y"])) > 0.99:
            # forces next to the bound are shortened by the library, as documented
            return False
    return True


def by_library(scene, run, fields, tools, findings):
    """The same cases by calls of the library, and by the input that it writes: equal to round-off"""
    if not expressible(scene) or not tools.library:
        return
    with open(os.path.join(tools.folder, "scene.json"), "w", encoding="utf-8") as file:
        json.dump(scene, file)
    code, _, errors, _ = tools.command(
        [sys.executable, "-B", os.path.join(os.path.dirname(os.path.abspath(__file__)), "library3.py"), "scene.json", "answer.json"]
    )
    if code != 0:
        findings.append(finding("library", f"exit code {code}: {errors.strip()[-300:]}"))
        return
    with open(os.path.join(tools.folder, "answer.json"), encoding="utf-8") as file:
        answer = json.load(file)
    for k, result in enumerate(answer, start=1):
        f, t, converged = fields[k], run.totals(k), is_converged(run.cases[k - 1])
        if (result["code"] < 0) == converged:
            findings.append(finding("library", f"case {k}: code {result['code']}, {result['message']}; the program: converged"
                                    f" {converged}"))
        if not converged or result["code"] < 0:
            return
        top = f["pn"].max()
        if top <= 0:
            continue
        bound = top*max(f["mu"].max(), 1e-30)
        for name, scale in (("pn", top), ("px", bound), ("py", bound)):
            exceeds(findings, "library", f"{name} of case {k}", np.abs(np.array(result[name]) - f[name]).max()/scale,
                    LIBRARY*scene["eps"] + 5*f["error"])
        for name, scale in (("fn", t["fn"]), ("fx", bound*t["fn"]/top), ("fy", bound*t["fn"]/top)):
            if t.get(name) is not None:
                exceeds(findings, "library", f"{name.upper()} of case {k}", abs(result[name] - t[name])/scale, LIBRARY*scene["eps"])
    with open(os.path.join(tools.folder, "library.inp"), encoding="utf-8") as file:
        written = file.read()
    again = tools.run("again", written)
    if again.code != 0 or len(again.cases) != len(answer):
        findings.append(finding("written", f"exit code {again.code}: {again.errors.strip()[:200]}"))
        return
    for k in range(1, len(answer) + 1):
        t, u = run.totals(k), again.totals(k)
        scale = max(scale_of_friction(scene)*t["fn"], 1e-300)
        for name in ("fn", "fx", "fy"):
            if t.get(name) is not None and u.get(name) is not None:
                exceeds(findings, "written", f"{name.upper()} of case {k}", abs(t[name] - u[name])/scale,
                        WRITTEN*scene["eps"] if not scene["digits"]["L"] else 2e-2)


def coefficients(scene):
    """A table of coefficients that is not quite symmetric in y: those of half-spaces times a factor that grows with y"""
    grid = scene["grid"]
    spaces = elastic.HalfSpaces(scene["g"], scene["nu"], grid["mx"], grid["my"], grid["dx"], grid["dy"])
    y = np.arange(-(grid["my"] - 1), grid["my"])[:, np.newaxis]
    factor = 1 + 0.05*np.tanh(y/grid["my"])
    return {i + j: spaces.table(i + j)*factor for i in "xyn" for j in "xyn"}


def coefficient_file(scene):
    grid, tables = scene["grid"], coefficients(scene)
    g = elastic.combined(scene["g"], scene["nu"])[0]
    mx, my = grid["mx"], grid["my"]
    lines = ["1 1", "0 312", "1 0", f"{mx} {my} {grid['dx']!r} {grid['dy']!r}"]
    for row in range(2*my - 1):
        lines.append(f"% offset in y {row - my + 1}")
        for i in range(mx):
            values = [tables[a + b][row, mx - 1 + i]*g for a in "nxy" for b in "nxy"]
            lines.append(f"{i} {i*grid['dx']!r} " + " ".join(repr(float(value)) for value in values))
    return "\n".join(lines) + "\n"
