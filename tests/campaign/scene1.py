"""Scenes of module 1, wheel on rail or roller, at random: their input and simpler ones.

A scene is a dictionary for the right-hand picture: `text` writes it for the right or for the left side of the track.

    pair       recipes of the profiles, track and wheelset, see profiles.py
    side       "right" or "left"
    roller     nominal radius of the roller [mm], 0 on a track
    digits     T N F D B M L V C G, numbers
    grid       DX DS DQREL A_SEP D_SEP D_COMB
    friction   the coefficient without slip, and a smaller one for laws that fall
    materials  POISS 1, 2, GG 1, 2
    springs    KYRAIL FYRAIL KZRAIL FZRAIL, with F = 3
    curve      curvature of the track, positive to the right; or none
    cases      one after the other: s y z fz roll yaw pitch, speed (6), p, deviation (6), flexible (12) or none, fx with F = 1
    relation   which of the relations is judged beside the results themselves
"""
import copy
import math
import random

import geometry1
import profiles

TRIALS = 30  # for the vertical force
EPS = 1e-5
# Contact angles of rails in slices are those at the contact: the angle of the section below the axle, the default of
# input files, causes a warning
OPTIONS = ("--json", "--hdf5", "--quiet", "--contact-angle", "contact")
RELATIONS = ("none", "mirror", "translate", "scale", "file", "refined_profile", "cut", "slices", "refined_grid", "library")

# ---- Scenes --------------------------------------------------------------------------------------------


def generate(rng):
    """A scene of module 1"""
    pair = profiles.pair(rng)
    kind, radius = pair["kind"], pair["wheelset"][2]
    size = radius / profiles.RADIUS if kind == "scaled" else 1.0
    roller = 0.0
    if kind in ("flanged", "crown", "scaled", "grooved") and rng.random() < 0.15:
        roller = radius * rng.choice([0.5, 1.0, 1.0, 2.0, 5.0])
    digits = {"T": rng.choice([0, 3, 3, 3, 3, 1, 2]), "N": rng.choice([1, 1, 1, 0]), "F": 0, "D": rng.choice([2, 2, 2, 3, 4, 5, 6]),
              "B": rng.choice([0] * 8 + [5, 6]), "M": rng.choice([0] * 8 + [1, 2, 3, 4, 5]), "L": rng.choice([0, 0, 0, 3, 4, 2]),
              "V": rng.choice([0, 0, 0, 0, 1, 2]), "C": rng.choice([2, 2, 3, 4]), "G": 0}
    if kind in ("flat", "varying"):
        digits["D"] = rng.choice([2, 5])
    if digits["M"] in (1, 2, 3, 5):
        digits["T"], digits["C"] = 3, 2
    if digits["M"] == 1 and digits["B"] == 6:
        digits["B"] = 5  # ANALYN has no memory
    if digits["C"] == 4:
        digits["D"] = 4
    if digits["B"] in (5, 6) and digits["D"] == 4:
        digits["B"] = 0
    if digits["T"] and digits["N"] and rng.random() < 0.15 and digits["M"] in (0, 3):
        digits["F"] = rng.choice([1, 3])
        if roller:
            digits["F"] = 0
    force = 10.0**rng.uniform(0.0, math.log10(2e5)) * size**2
    if kind in ("crown", "grooved"):
        force = min(force, 3e4)
    # half width of the contact of two bodies of this radius
    half = (1.5 * force * 0.28 / 82000.0 * radius)**(1.0 / 3.0)
    step = float("%.3g" % (half / rng.choice([3.0, 5.0, 5.0, 8.0])))
    mu = round(rng.uniform(0.05, 0.6), 3)
    scene = {"module": 1, "pair": pair, "side": rng.choice(["right", "left"]), "roller": roller, "digits": digits,
             "grid": [step, float("%.3g" % (step * rng.choice([0.5, 1.0, 1.0]))), 1.0, 90, round(8.0 * size, 3),
                      round(4.0 * size, 3)],
             "friction": [mu, rng.choice([mu * 0.5, mu * 0.8])],
             "materials": rng.choice([[0.28, 0.28, 82000.0, 82000.0]] * 3 + [[0.28, 0.28, 82000.0, 41000.0],
                                                                             [0.3, 0.45, 80000.0, 4000.0]])}
    if digits["T"] == 2 and digits["D"] != 4:
        scene["grid"][2] = rng.choice([0.5, 1.0])
    wide = 3.0 if kind in ("crown", "grooved") else 10.0 * size
    count = rng.choice([1, 1, 2]) if digits["T"] in (0, 3) else rng.choice([1, 3])
    scene["cases"] = [_case(rng, scene, wide, size) for _ in range(count)]
    for k, case in enumerate(scene["cases"]):
        case["fz"] = float("%.6g" % (force * rng.choice([1.0, 1.0, 0.7])))
        if digits["T"] in (1, 2) and k > 0:  # a step of the previous scene
            case.update({name: copy.deepcopy(scene["cases"][0][name])
                         for name in ("s", "y", "roll", "yaw", "pitch", "fz", "deviation")})
            case["p"] = 0
        if "flexible" in scene["cases"][k - 1] and k > 0:  # kept until others are given
            case.setdefault("flexible", list(scene["cases"][k - 1]["flexible"]))
    if digits["F"] == 3:
        scene["springs"] = [rng.choice([1e3, 1e4, 1e5]), 0.0, rng.choice([0.0, 1e5]), 0.0]
    if digits["N"] == 0:
        _give_heights(rng, scene)
    scene["relation"] = rng.choice(RELATIONS)
    _curve_and_roller(random.Random(rng.random()), scene)
    return scene


def _curve_and_roller(rng, scene):
    """A curve of the track, and deviations of a roller; drawn apart, so that all other numbers of a seed stay the same"""
    size = scene["pair"]["wheelset"][2] / profiles.RADIUS
    if rng.random() < 0.25:
        scene["curve"] = float("%.3g" % (rng.choice([-1.0, 1.0]) * 10.0**rng.uniform(-7.0, -5.0) / size))
    if scene["roller"] and scene["digits"]["N"] and rng.random() < 0.5:
        fast = 0.0 if scene["digits"]["T"] == 1 else 20000.0 * size
        deviation = [_gauss(rng, 0.5 * size), _gauss(rng, 0.5 * size), _gauss(rng, 0.003), _gauss(rng, 0.0005 * fast),
                     _gauss(rng, 0.0005 * fast), _gauss(rng, 0.01) if fast else 0.0]
        for case in scene["cases"]:
            case["deviation"] = list(deviation)


def _case(rng, scene, wide, size):
    radius, digits = scene["pair"]["wheelset"][2], scene["digits"]
    gentle = scene["pair"]["kind"] in ("crown", "grooved")
    fast = rng.choice([1000.0, 20000.0, 50000.0]) * size
    slip = rng.choice([0.0, rng.gauss(0.0, 0.001), rng.gauss(0.0, 0.01)])
    if digits["T"] == 1:
        fast = 0.0
    about = scene["roller"] or radius
    speed = [fast / scene["roller"] if scene["roller"] else fast, rng.choice([0.0, rng.gauss(0.0, 0.002) * fast]), 0.0, 0.0, 0.0,
             -fast / radius * (1.0 + slip)]
    if digits["T"] == 1:
        shift = 10.0**rng.uniform(-4.0, -1.5) * size
        speed = [rng.choice([0.0, shift]), rng.gauss(0.0, shift), 0.0, 0.0, 0.0, rng.gauss(0.0, shift) / radius]
        if scene["roller"]:
            speed[0] /= about
    elif rng.random() < 0.2:
        speed[2], speed[3], speed[4] = rng.gauss(0.0, 0.001) * fast, rng.gauss(0.0, 0.02), rng.gauss(0.0, 0.02)
    case = {"s": round(rng.uniform(-50.0, 50.0), 3) if scene["pair"]["kind"] == "varying" else rng.choice([0.0, 1000.0]),
            "y": round(rng.uniform(-wide, wide), 4), "fz": 0.0, "z": 0.0,
            "roll": rng.choice([0.0, round(rng.uniform(-0.01, 0.01) * (0.3 if gentle else 1.0), 6)]),
            "yaw": rng.choice([0.0, round(rng.uniform(-0.03, 0.03), 6)]),
            "pitch": round(rng.uniform(-0.06, 0.06), 6) if scene["pair"]["kind"] == "flat" else rng.choice([0.0, 1.0]),
            "speed": [float("%.9g" % value) for value in speed], "p": 2, "deviation": [0.0] * 6}
    if scene["roller"]:
        case["s"] = 0.0
    elif rng.random() < 0.2:
        case["deviation"] = [_gauss(rng, 0.5 * size), _gauss(rng, 0.5 * size), _gauss(rng, 0.003), _gauss(rng, 0.0005 * fast),
                             _gauss(rng, 0.0005 * fast), _gauss(rng, 0.01) if fast else 0.0]
    if rng.random() < 0.15:
        case["flexible"] = [_gauss(rng, 0.3 * size) for _ in range(3)] + [_gauss(rng, 0.002), _gauss(rng, 0.002), 0.0] \
            + [_gauss(rng, 0.0003 * fast) for _ in range(3)] + [_gauss(rng, 0.05) if fast else 0.0 for _ in range(3)]
    if digits["F"] == 1:
        case["fx"] = round(rng.uniform(-0.8, 0.8), 3)  # in mu FZ
    return case


def _gauss(rng, size):
    """A random number of five digits"""
    return float("%.5g" % rng.gauss(0.0, size))


def _give_heights(rng, scene):
    """Prescribe heights of the wheelset at which the bodies overlap a little"""
    pair = copy.deepcopy(scene["pair"])
    for body in ("rail", "wheel"):
        if (pair[body].get("smooth") or [0])[0] == 2:
            pair[body].pop("smooth")  # not known here; accurate enough for a height
    curves = geometry1.curves_of(pair)
    depth = 0.5 * scene["cases"][0]["fz"]**(2.0 / 3.0) * 4e-5
    for case in scene["cases"]:
        touch = geometry1.Placed(scene, case, 0.0, curves=curves).smallest()
        case["z"] = float("%.9g" % ((touch[0] if touch else 0.3) + depth * rng.choice([1.0, 1.0, 0.7])))


def sampled(scene):
    """Can the judge sample the geometry? No spline of method 2, slices that are interpolated exactly"""
    both = (scene["pair"]["rail"], scene["pair"]["wheel"])
    return all((recipe.get("smooth") or [0])[0] != 2 and (not recipe.get("slices") or recipe.get("interpol", 1) == 1)
               for recipe in both)


def labels(scene):
    """Rows of the table"""
    digits = scene["digits"]
    result = ["profiles: " + scene["pair"]["kind"], "relation: " + scene["relation"],
              "%s, %s" % ("roller" if scene["roller"] else "track", scene["side"])]
    result += ["%s = %d" % (name, digits[name]) for name in ("T", "N", "F", "D", "B", "M", "L", "V", "C")]
    if any(case.get("flexible") for case in scene["cases"]):
        result.append("flexible wheelset")
    if len(scene["cases"]) > 1 and digits["T"] in (1, 2):
        result.append("sequence")
    if digits["N"]:
        result.append("FZ 1e%d" % math.floor(math.log10(scene["cases"][0]["fz"])))
    return result


# ---- Input -----------------------------------------------------------------------------------------------

# Positions of the values that change their signs on the left side of the track
ODD = dict(speed=(1, 3, 4), deviation=(0, 2, 3, 5), flexible=(1, 3, 4, 7, 9, 10))


def signed(values, kind, sign):
    """Values of one kind for a side of the track"""
    return [sign * value if k in ODD[kind] else value for k, value in enumerate(values)]


def _words(values, kind, sign):
    return " " + " ".join("%.12g" % (value + 0.0) for value in signed(values, kind, sign))


def text(scene, side=None):
    """Input of a scene for a side of the track"""
    sign = -1.0 if (side or scene["side"]) == "left" else 1.0
    digits, pair = scene["digits"], scene["pair"]
    rail, _ = profiles.files(pair["rail"], "rail")
    wheel, _ = profiles.files(pair["wheel"], "wheel")
    config = (1 if sign > 0 else 0) + (4 if scene["roller"] else 0)
    lines = []
    for k, case in enumerate(scene["cases"]):
        first, flexible = k == 0, case.get("flexible")
        e_digit = (5 if first else 4) if flexible else (3 if first else 2)
        lines += [" 1 MODULE",
                  " %d%d%d%d%d%d0    C-P-B-T-N-F-S" % (config, case["p"], digits["B"], digits["T"], digits["N"], digits["F"]),
                  " %d%d%d%d%d%d%d    V-L-D-C-M-Z-E" % (digits["V"], digits["L"] if first else 1, digits["D"] if first else 1,
                                                        digits["C"] if first else 1, digits["M"], 3 if first else 2, e_digit),
                  " 0%d02111    H-G-I-A-O-W-R" % (digits["G"] if first else 1)]
        if first:
            lines.append(" 999 100 %d %d %g    MAXGS MAXIN MAXNR MAXOUT EPS" % (TRIALS, 20 if coupled(scene) else 1, EPS))
            lines += _friction(scene)
            if digits["C"] == 4:
                lines.append(" 0 4    IF_METH VARIANT")
            lines.append(" %g %g %g %g    POISS GG" % tuple(scene["materials"]))
            lines += {1: [" 0.5 0.5 0.001 0.001    FG TC"], 2: [" 1e-4 0.5 0.8 1.0"], 3: [" 0.5 0.8 1.0"], 4: [" 10000 0.02 0 0"],
                      5: [" 0.5 0.8 1.0"]}.get(digits["M"], [])
            grid = scene["grid"]
            lines.append(" %.12g %.12g %g %gd %.12g %.12g    DX DS DQREL A_SEP D_SEP D_COMB" % tuple(grid))
            track = pair["track"]
            y_rail = track[1] if track[0] > 0.0 else sign * track[1]
            last = scene["roller"] or track[3]
            lines.append(" %.12g %.12g %.12g %.12g %.12g    GAUGHT ..." % (track[0], y_rail, track[2], last,
                                                                         sign * scene.get("curve", 0.0)))
            lines.append(rail)
        lines.append(_words(case["deviation"], "deviation", sign) + "    DY DZ ROLL VY VZ VROLL")
        if digits["F"] == 3:
            spring = scene["springs"]
            lines.append(" %g %g %g %g    KYRAIL FYRAIL KZRAIL FZRAIL" % (spring[0], sign * spring[1], spring[2], spring[3]))
        if first:
            lines += [" %.12g %.12g %.12g    FBDIST FBPOS NOMRADW" % tuple(pair["wheelset"]), wheel]
        lines.append(" %.12g %.12g %.12g %.12g %.12g %.12g    S Y Z|FZ ROLL YAW PITCH" % (
            case["s"], sign * case["y"], case["fz"] if digits["N"] else case["z"], sign * case["roll"], sign * case["yaw"],
            case["pitch"]))
        speed = list(case["speed"])
        if digits["F"] == 1:
            speed[5] = case["fx"] * scene["friction"][0] * case["fz"]
        lines.append(_words(speed, "speed", sign) + "    VS VY VZ VROLL VYAW VPITCH")
        if flexible:
            words = _words(flexible, "flexible", sign).split()
            lines += [" " + " ".join(words[:6]), " " + " ".join(words[6:])]
    return "\n".join(lines) + "\n 0 MODULE\n"


def coupled(scene):
    nu1, nu2, g1, g2 = scene["materials"]
    return (nu1, g1) != (nu2, g2) or scene["digits"]["C"] == 4


def law(scene):
    """Values of the friction law"""
    digits, (mu, other) = scene["digits"], scene["friction"]
    return [mu, mu] if digits["L"] == 0 else [other, mu - other if digits["L"] != 3 else mu / other - 1.0, 500.0, 0.0, 1.0]


def _friction(scene):
    digits, words = scene["digits"], " ".join("%.12g" % value for value in law(scene))
    if digits["V"] == 0:
        lines = [" %s    FRICTION" % words]
    else:
        places = ("-30d", "30d") if digits["V"] == 1 else ("-200", "200")
        lines = [" 2    NVF"] + [" %s %s" % (place, words) for place in places]
    if digits["L"] >= 2:
        lines.append(" 0.01 100    MEMDST MEM_S0")
    return lines


def files(scene):
    """The input and the profiles by their names"""
    pair = scene["pair"]
    return {"run.inp": text(scene), **profiles.files(pair["rail"], "rail")[1], **profiles.files(pair["wheel"], "wheel")[1]}


def solve(scene, tools, name="run", side=None):
    """Run the program on a scene"""
    held = files(scene)
    del held["run.inp"]
    return tools.run(name, text(scene, side), held, options=OPTIONS)


# ---- Simpler scenes ------------------------------------------------------------------------------------------


def reduce(scene):
    """Simpler scenes, the most helpful first"""
    def changed(change):
        other = copy.deepcopy(scene)
        change(other)
        if other != scene:
            yield other

    for k in range(len(scene["cases"])):
        if len(scene["cases"]) > 1:
            yield from changed(lambda s, k=k: (s["cases"].pop(k), s["cases"][0].update(p=2)))
    if scene["relation"] != "none":
        yield from changed(lambda s: s.update(relation="none"))
    yield from changed(lambda s: s.pop("curve", None))
    for name, value in (("T", 0), ("F", 0), ("B", 0), ("M", 0), ("L", 0), ("V", 0), ("C", 2), ("D", 2)):
        if scene["digits"][name] != value and not (name == "C" and scene["digits"]["D"] == 4 and value == 4):
            yield from changed(lambda s, name=name, value=value: s["digits"].update({name: value}))
    yield from changed(lambda s: s.update(materials=[0.28, 0.28, 82000.0, 82000.0]))
    yield from changed(lambda s: s.update(side="right"))
    for body in ("rail", "wheel"):
        plain_shape = "60E1" if body == "rail" else "S1002"
        for key in ("noise", "spacing", "smooth", "waves", "wear", "mirror", "reverse", "up", "metres", "slices", "seed"):
            if scene["pair"][body].get(key):
                yield from changed(lambda s, body=body, key=key: s["pair"][body].pop(key))
        yield from changed(lambda s, body=body: s["pair"][body].update(format="simpack"))
        if scene["pair"]["kind"] == "flanged":
            yield from changed(lambda s, body=body, shape=plain_shape: s["pair"][body].update(shape=[shape]))
    for k, case in enumerate(scene["cases"]):
        yield from changed(lambda s, k=k: s["cases"][k].pop("flexible", None))
        yield from changed(lambda s, k=k: s["cases"][k].update(deviation=[0.0] * 6))
        for name in ("s", "roll", "yaw", "pitch"):
            yield from changed(lambda s, k=k, name=name: s["cases"][k].update({name: 0.0}))
        for j in (1, 2, 3, 4):
            yield from changed(lambda s, k=k, j=j: s["cases"][k]["speed"].__setitem__(j, 0.0))
        for name, digits in (("y", "%.2g"), ("fz", "%.2g")):
            yield from changed(lambda s, k=k, name=name, value=float(digits % case[name]): s["cases"][k].update({name: value}))
