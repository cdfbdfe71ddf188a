"""Random cases with several effects, for their limits: two bodies, and a wheel on a rail, in the readable format.

A scene is a dictionary:
    common, steps   groups of the first case, and what each case gives
    files           profiles by their names
    kind, law       material and friction law
    size, slip      length of the contact [mm]; creepage, or shift [mm], of the order of full sliding
    stress, mu      pressure of the contact [N/mm2], coefficient of friction
    modulus, veloc  combined modulus of rigidity [N/mm2], rolling velocity [mm/s]
"""
import functools
import math
import os

PROFILES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "profiles")
LAWS = {"linear": "flin", "rational": "frat", "exponential": "fexp"}
MODELS = {"elastic": "elastic", "viscoelastic": "viscoelastic", "layer": "interfacial_layer", "plastic": "interfacial_layer",
          "fastsim_single": "fastsim_single", "fastsim": "fastsim", "fastrip": "fastrip"}
SIMPLIFIED = ("fastsim_single", "fastsim", "fastrip")
WHEEL_RADIUS = 460.0


def short(value):
    """A number with five figures"""
    return float(f"{value:.5g}")


def logarithmic(rng, low, high):
    return math.exp(rng.uniform(math.log(low), math.log(high)))


def scene(rng):
    """A scene of one of the modules"""
    motion = rng.choice(["shift", "transient_rolling", "steady_rolling", "steady_rolling"])
    steady = motion == "steady_rolling"
    kind = rng.choice(["elastic"]*4 + ["layer"]*3 + ["plastic"]*2 + ["fastsim_single", "fastsim"]
                      + (["viscoelastic"]*4 + ["fastrip"])*steady)
    result = {"module": 1 if rng.random() < 0.35 else 3, "kind": kind, "motion": motion, "mu": rng.uniform(0.1, 0.6), "files": {}}
    gg = 82000.0 if result["module"] == 1 else rng.choice([82000.0, 10.0])
    poiss, moduli = [0.28, 0.28], [gg, gg]
    if rng.random() < 0.35:
        poiss, moduli = [short(rng.uniform(0.1, 0.5)), short(rng.uniform(0.1, 0.5))], [gg, short(gg*logarithmic(rng, 0.3, 3.0))]
    result["modulus"] = 2.0/(1.0/moduli[0] + 1.0/moduli[1])
    result["veloc"] = short(logarithmic(rng, 100.0, 1e4))
    result["common"] = common = {
        "motion": motion, "errors": rng.random() < 0.3, "material_model": MODELS[kind],
        "iteration": {"eps": rng.choice([1e-6, 1e-7]), "maxout": 100, "maxin": 300, "maxgs": 999, "maxnr": 60,
                      "order": rng.choice([1, 2])},
        "material": {"poiss": poiss, "gg": moduli, "influence": "piecewise_constant"}}
    (_two_bodies if result["module"] == 3 else _wheel)(rng, result)
    _material(rng, result, common["material"])
    _friction(rng, result)
    return result


def described(scene):
    """Words for a report"""
    common = scene["common"]
    words = [f"module {scene['module']}", scene["motion"], scene["kind"], scene["law"], f"order {common['iteration']['order']}"]
    words += [word for word in ("heat", "influence", "errors") if common.get(word)]
    words += [common[word] for word in ("pressure", "tangential", "slip_source") if common.get(word)]
    return ", ".join(words + [common["search"]["location"]] if scene["module"] == 1 else words)


def _two_bodies(rng, result):
    """Module 3: a quadratic distance, creepages or forces, approach or normal force"""
    common, motion = result["common"], result["motion"]
    mx, my = rng.randint(11, 15), rng.randint(9, 13)
    a, b = rng.choice([(3.0, 3.0), (2.0, 4.0), (4.0, 1.5)])
    curvature = logarithmic(rng, 1e-4, 3e-3)
    pen = curvature*a*a*rng.uniform(0.5, 0.8)
    dx, dy = short(2.4*a/mx), short(2.4*b/my)
    result.update(size=a, stress=result["modulus"]*pen/a, slip=1.5*result["mu"]*pen/a*(a if motion == "shift" else 1.0))
    common.update({"module": "contact", "normal": "approach", "tangential": "creepages"})
    common["grid"] = {"form": "corner_and_sides", "mx": mx, "my": my, "xl": -0.5*mx*dx, "yl": (rng.uniform(-0.4, 0.4) - 0.5*my)*dy,
                      "dx": dx, "dy": dy}
    common["geometry"] = {"form": "quadratic", "planform": "unrestricted", "b": [curvature, 0.0, curvature*(a/b)**2, 0.0, 0.0, 0.0]}
    if motion != "shift":
        common["rolling"] = {"chi": rng.choice([0.0, 0.0, math.pi]), "dq": dx, "veloc": result["veloc"]}
    if rng.random() < 0.15:
        common["pressure"] = "thin_sheet"
        common["material"]["flxz"] = max(short(a/result["modulus"]*logarithmic(rng, 0.01, 1.0)), 1e-9)
    elif rng.random() < 0.1:
        common["pressure"] = "kpec"
    if result["kind"] in ("elastic", "layer", "plastic"):
        common["material"]["influence"] = rng.choice(["piecewise_constant", "piecewise_constant", "bilinear"])
    if result["kind"] != "fastrip" and rng.random() < 0.2:
        common["slip_source"] = rng.choice(["no_spin_x", "no_spin_y"])
    result["steps"] = []
    for number in range(1 if motion == "steady_rolling" else rng.randint(1, 3)):
        part = [rng.choice([0.0, rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)])*result["slip"] for _ in range(3)]
        step = {"kinematics": {"pen": short(pen*rng.uniform(0.9, 1.1)), "cksi": short(part[0]), "ceta": short(part[1]),
                               "cphi": short(part[2]/a)}}
        result["steps"].append({**step, "sequence": "continue_all"} if number else step)
    _forces(rng, result, a, b)


def _forces(rng, result, a, b):
    """Sometimes forces in place of approach and creepages"""
    common = result["common"]
    if rng.random() < 0.3 and common.get("pressure") != "kpec":
        common["normal"] = "force"
        for step in result["steps"]:
            step["kinematics"]["fn"] = short(1.2*result["modulus"]*math.sqrt(a*b)*step["kinematics"].pop("pen"))
    if rng.random() < 0.2:
        common["tangential"] = "fx_and_ceta"
        for step in result["steps"]:
            del step["kinematics"]["cksi"]
            step["kinematics"]["fx"] = short(rng.uniform(-0.6, 0.6))
            step["kinematics"]["ceta"] *= 0.2
            step["kinematics"]["cphi"] *= 0.2


@functools.lru_cache(maxsize=1)
def _profiles():
    result = {}
    for name in ("60E1.prr", "S1002.prw"):
        with open(os.path.join(PROFILES, name), encoding="utf-8") as file:
            result[name] = file.read()
    return result


def _wheel(rng, result):
    """Module 1: a wheel S1002 on a rail 60E1"""
    common, motion = result["common"], result["motion"]
    fz = short(10.0**rng.uniform(4.0, 5.0))
    a = 6.0*(fz/1e5)**(1.0/3.0)
    stress = 0.7*fz/(a*a)
    slip = 0.7*result["mu"]*stress/result["modulus"]*(a if motion == "shift" else 1.0)
    result.update(size=a, stress=stress, slip=slip, files=dict(_profiles()))
    right = rng.random() < 0.5
    common.update({"module": "wheel_rail", "configuration": "right_on_track" if right else "left_on_track", "normal": "force",
                   "tangential": "velocities"})
    dx = short(2.0*a/rng.uniform(7.0, 10.0))
    location = rng.choice(["locus", "locus", "locus_extended", "conformal", "grid", "first_contact"])
    common["search"] = {"location": location, "dx": dx, "ds": short(0.6*dx), "a_sep": "90 deg", "d_sep": 8.0, "d_comb": 4.0}
    common["track"] = {"gaught": -1.0, "raily0": 753.0 if right else -753.0, "railz0": 0.0, "cant": 0.0}
    common["rail_profile"], common["deviations"] = {"file": "60E1.prr"}, {}
    common["wheel_dimensions"] = {"fbdist": 1360.0, "fbpos": -70.0, "nomradw": WHEEL_RADIUS}
    common["wheel_profile"] = {"file": "S1002.prw"}
    position = {"y_ws": short(rng.uniform(-3.0, 3.0)), "roll": 0.0, "yaw": short(rng.uniform(-5e-3, 5e-3)), "fz": fz}
    result["steps"] = []
    for number in range(1 if motion == "steady_rolling" else rng.randint(1, 2)):
        part = [rng.uniform(-1.0, 1.0)*slip for _ in range(3)]
        if motion == "shift":
            velocity = {"vs": short(part[0]), "vy": short(part[1]), "vpitch": short(part[2]/WHEEL_RADIUS)}
        else:
            veloc = result["veloc"]
            velocity = {"vs": veloc, "vy": short(part[1]*veloc), "vpitch": short(-veloc/WHEEL_RADIUS*(1.0 + part[0])),
                        "vyaw": short(rng.choice([0.0, 0.1*part[2]*veloc/a]))}
        step = {"position": dict(position), "velocity": velocity}
        result["steps"].append({**step, "sequence": "continue_all"} if number else step)
    if motion != "shift" and rng.random() < 0.2:
        common["tangential"] = "longitudinal_force"
        for step in result["steps"]:
            del step["velocity"]["vpitch"]
            step["velocity"]["fx_ws"] = short(rng.uniform(-0.6, 0.6)*result["mu"]*fz)


def _material(rng, result, material):
    """Numbers of the kind of material"""
    kind, modulus, a = result["kind"], result["modulus"], result["size"]
    if kind == "viscoelastic":
        passage = a/result["veloc"]
        material["fg"] = [short(rng.uniform(0.1, 3.0)), short(rng.uniform(0.1, 3.0))]
        material["tc"] = [short(passage*logarithmic(rng, 0.03, 30.0)), short(passage*logarithmic(rng, 0.03, 30.0))]
    elif kind in ("layer", "plastic"):
        material.update(gg3=short(modulus), laythk=short(a*logarithmic(rng, 1e-3, 1.0)), tau_c0=0.0, k_tau=0.0)
        if kind == "plastic":
            material["tau_c0"] = short(result["mu"]*result["stress"]*rng.uniform(0.2, 0.9))
            material["k_tau"] = short(rng.choice([0.0, 1.0])*modulus/a*logarithmic(rng, 0.01, 1.0))
    elif kind in SIMPLIFIED:
        if kind == "fastsim_single":
            material["flx"] = short(a/modulus*logarithmic(rng, 0.3, 3.0))
        reduced = rng.random() < 0.5 and result["motion"] != "shift"
        material.update(k0_mf=0.6, alfamf=0.5, betamf=0.8) if reduced else material.update(k0_mf=1.0, alfamf=1.0, betamf=0.0)


def _friction(rng, result):
    """A law, its memory and temperatures"""
    common, mu, motion = result["common"], result["mu"], result["motion"]
    speed = result["slip"]*(1.0 if motion == "shift" else result["veloc"])
    laws = ["coulomb"]*3 + list(LAWS)
    if motion == "steady_rolling" and rng.random() < 0.35:
        # conductivity and capacity for flash temperatures of some hundred degrees
        peclet = max(result["veloc"]*result["size"]*7.85e-6*450.0/0.05, 1.0)
        times = max(mu*result["stress"]*speed*1e-3*result["size"]/0.05/math.sqrt(peclet)/logarithmic(rng, 50.0, 500.0), 1e-3)
        common["heat"] = {"model": "flash", "bktemp": [10.0, 10.0], "heatcp": [450.0*times]*2, "lambda": [0.05*times]*2,
                          "dens": [7.85e-6, 7.85e-6]}
        laws += ["temperature"]*(3 if result["kind"] not in (*SIMPLIFIED, "plastic") else 0)
    result["law"] = law = rng.choice(laws)
    if law == "coulomb":
        values = {"fstat": short(mu), "fkin": short(mu)}
    elif law == "temperature":
        values = {"fref": short(mu), "tref": 20.0, "dfheat": short(-0.3*mu), "dtheat": 400.0, "memdst": 0.0}
    else:
        name = LAWS[law]
        values = {"fkin": short(0.7*mu), name + "1": short(0.3*mu), "sabsh1": max(short(speed*logarithmic(rng, 2.0, 30.0)), 1e-4),
                  name + "2": 0.0, "sabsh2": 1.0, "memdst": rng.choice([0.0, short(result["size"]*logarithmic(rng, 0.05, 1.0))]),
                  "mem_s0": short(max(speed, 1e-6)*0.1)}
    common["friction"] = {"law": law, **values}
