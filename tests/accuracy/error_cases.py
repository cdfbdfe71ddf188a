"""Random contacts of many kinds, as cases of the readable format on any grid.

A contact is a dictionary without a grid: geometry, loads, motion, friction, materials. `text_of` writes it for a
number of elements along each side and an offset of the grid, so that the same contact can be solved on any grid.
"""
import math
import os
import sys
from pathlib import Path


def elliptic(g):
    """Integrals B and D of Hertz's theory and the complete ones K and E for the ratio g of the semi-axes."""
    a, b, c, total, power = 1.0, g, math.sqrt(max(0.0, 1.0 - g * g)), 0.0, 1.0
    while abs(c) > 1e-15:
        total += power * c * c / 2.0
        a, b, c, power = (a + b) / 2.0, math.sqrt(a * b), (a - b) / 2.0, power * 2.0
    k = math.pi / (2.0 * a)
    e = k * (1.0 - total)
    k2 = 1.0 - g * g
    if k2 < 1e-8:
        return math.pi / 4, math.pi / 4, k, e
    return (e - g * g * k) / k2, (k - e) / k2, k, e


def curvatures(a, b, modulus, fn):
    """Coefficients of x**2 and y**2 for a Hertzian ellipse with the semi-axes a and b under the force fn."""
    g = min(a, b) / max(a, b)
    bb, dd, _, e = elliptic(g)
    ratio = g * g * dd / bb
    rho = 4.0 * math.pi * math.sqrt(a * b) ** 3 * modulus * math.sqrt(g) / (3.0 * fn * e)
    larger = 2.0 / rho / (1.0 + ratio)
    return (larger, ratio * larger) if a <= b else (ratio * larger, larger)


def contact(random, kind):
    """One contact of a kind."""
    a, b = (math.exp(random.uniform(math.log(1.0), math.log(8.0))) for _ in "ab")
    poisson, shear = random.choice([(0.28, 82000.0), (0.3, 80000.0), (0.45, 1000.0)])
    p0 = random.uniform(0.002, 0.01) * shear
    fn = 2.0 * math.pi * a * b * p0 / 3.0
    mu = random.uniform(0.1, 0.6)
    # creepage of about full sliding
    full = mu * p0 / shear * math.sqrt(a * b) * 4.0 * (1.0 - poisson) / max(a, 0.5 * b)
    angle = random.uniform(0.0, 2.0 * math.pi)
    size = full * math.exp(random.uniform(math.log(0.05), math.log(1.2)))
    c = {"kind": kind, "a": a, "b": b, "fn": fn, "mu": mu, "poiss": [poisson] * 2, "gg": [shear] * 2, "margin": 1.15,
         "motion": "steady_rolling", "tangential": "creepages", "normal": "force", "steps": 1, "extra": "", "maxout": 1,
         "creep": (size * math.cos(angle), size * math.sin(angle)), "chi": 0.0, "order": 1, "model": "elastic",
         "material": "", "friction": f'law = "coulomb"\nvariation = "none"\nfstat = {mu!r}\nfkin = {mu!r}\n',
         "spin": random.choice([0.0, 1.0]) * random.uniform(-1.0, 1.0) * full / math.sqrt(a * b)}
    b1, b3 = curvatures(a, b, shear / (1.0 - poisson), fn)
    c["geometry"] = f'form = "quadratic"\nplanform = "unrestricted"\nb = [{b1!r}, 0.0, {b3!r}, 0.0, 0.0, 0.0]\n'
    (CHANGES | FURTHER)[kind](random, c, b1, b3, full)
    return c


def _normal(random, c, b1, b3, full):
    c.update(motion="none", order=2)
    if random.random() < 0.5:
        _by_approach(c, b1, b3)


def _by_approach(c, b1, b3):
    """Prescribe the Hertzian approach instead of the force."""
    g = min(c["a"], c["b"]) / max(c["a"], c["b"])
    _, _, k, e = elliptic(g)
    c.update(normal="approach", pen=min(c["a"], c["b"]) ** 2 * (b1 + b3) * k / e)


def _shift(random, c, b1, b3, full):
    length = math.sqrt(c["a"] * c["b"])
    c.update(motion="shift", order=2, creep=tuple(x * length for x in c["creep"]), spin=c["spin"] * length)


def _forces(random, c, b1, b3, full):
    angle, size = random.uniform(0, 2 * math.pi), random.uniform(0.1, 0.9)
    c.update(tangential="fx_and_fy", force=(size * math.cos(angle), size * math.sin(angle)))


def _dissimilar(random, c, b1, b3, full):
    c.update(poiss=[0.3, 0.3], gg=[c["gg"][0], c["gg"][0] * random.uniform(2.0, 5.0)], maxout=20)


def _profile(random, c, b1, b3, full):
    """A circle along x, and across it a non-parabolic profile: flat, skew, or with two parts."""
    b, n = c["b"], 2001
    amplitude, waves, phase = random.uniform(0.1, 0.5), random.uniform(0.8, 2.5), random.uniform(0, 6.28)
    y1, dy = -4.0 * b, 8.0 * b / (n - 1)
    values = []
    for k in range(n):
        y = y1 + k * dy
        values.append(b3 * y * y + b3 * b * b * amplitude * math.cos(waves * math.pi * y / b + phase))
    c["geometry"] = (f'form = "profile"\nplanform = "unrestricted"\nxm = 0.0\nrm = {1 / (2 * b1)!r}\ny1 = {y1!r}\ndy1 = {dy!r}\n'
                     "b = [" + ", ".join(f"{v:.12g}" for v in values) + "]\n")
    c["margin"] = 1.9


def _falling(random, c, b1, b3, full):
    mu, speed = c["mu"], 1000.0 * full * random.uniform(0.2, 2.0)
    c["friction"] = (f'law = "exponential"\nvariation = "none"\nfkin = {0.7 * mu!r}\nfexp1 = {0.3 * mu!r}\n'
                     f"sabsh1 = {speed!r}\nfexp2 = 0.0\nsabsh2 = 1.0\nmemdst = 0.001\nmem_s0 = 1.0\n")


def _viscoelastic(random, c, b1, b3, full):
    c.update(model="viscoelastic", maxout=20, margin=1.5,
             material=f"fg = [1.0, 1.0]\ntc = [{c['a'] / 2000.0!r}, {c['a'] / 2000.0!r}]\n")


def _layer(random, c, b1, b3, full):
    thickness = random.uniform(0.005, 0.03)
    c.update(model="interfacial_layer",
             material=f"gg3 = {c['gg'][0] / 100.0!r}\nlaythk = {thickness!r}\ntau_c0 = 0.0\nk_tau = 0.0\n")


#: Surface temperatures of bodies of steel at 20 degC
STEEL = ('[case.heat]\nmodel = "flash"\nbktemp1 = 20.0\nheatcp1 = 450.0\nlambda1 = 0.05\ndens1 = 7.85e-6\n'
         "bktemp2 = 20.0\nheatcp2 = 450.0\nlambda2 = 0.05\ndens2 = 7.85e-6\n")


def _heat(random, c, b1, b3, full):
    c["extra"] = STEEL
    c["creep"] = tuple(2.0 * x for x in c["creep"])


def _transient(random, c, b1, b3, full):
    # a step is about one element of the coarsest grid, with the same length on finer ones
    c.update(motion="transient_rolling", steps=4, dq=0.15 * c["a"])


def _steps(random, c, b1, b3, full):
    """The same with steps of less than one to many elements, up to eight of them."""
    c.update(motion="transient_rolling", steps=random.choice([1, 2, 3, 5, 8]),
             dq=c["a"] * math.exp(random.uniform(math.log(0.06), math.log(0.5))))


def _reverse(random, c, b1, b3, full):
    c["chi"] = math.pi


def _plain(random, c, b1, b3, full):
    pass


def _fastsim(random, c, b1, b3, full):
    c.update(model="fastsim", material="")


def _unlike(random, c, b1, b3, full):
    """Bodies from similar to very dissimilar, very low to high friction, creepages around those caused by the pressures."""
    mu, ratio = math.exp(random.uniform(math.log(1e-3), math.log(0.6))), math.exp(random.uniform(0.1, math.log(10.0)))
    p0 = 1.5 * c["fn"] / (math.pi * c["a"] * c["b"])
    driven = 0.3 * p0 / c["gg"][0] * (1 - 1 / ratio)
    angle, size = random.uniform(0, 2 * math.pi), driven * random.uniform(0, 1.5) + random.uniform(0, 1) * full * mu / c["mu"]
    # the softer body must not enlarge the contact beyond the grid: the semi-axes remain
    b1, b3 = curvatures(c["a"], c["b"], 2.0 * c["gg"][0] / (1.0 + ratio) / 0.7, c["fn"])
    c["geometry"] = f'form = "quadratic"\nplanform = "unrestricted"\nb = [{b1!r}, 0.0, {b3!r}, 0.0, 0.0, 0.0]\n'
    c.update(mu=mu, poiss=[0.3, 0.3], gg=[c["gg"][0], c["gg"][0] / ratio], maxout=20,
             creep=(size * math.cos(angle), size * math.sin(angle)), spin=c["spin"] * random.choice([0.0, mu / c["mu"]]),
             friction=f'law = "coulomb"\nvariation = "none"\nfstat = {mu!r}\nfkin = {mu!r}\n')


def _extreme(random, c, b1, b3, full):
    """From very small creepage to far beyond full sliding, and pure spin."""
    size = full * math.exp(random.uniform(math.log(1e-3), math.log(20.0)))
    angle = random.uniform(0, 2 * math.pi)
    c["creep"] = random.choice([(0.0, 0.0), (size * math.cos(angle), size * math.sin(angle)), (size, 0.0), (0.0, size)])
    spin = full / math.sqrt(c["a"] * c["b"]) * math.exp(random.uniform(math.log(0.01), math.log(20.0)))
    c["spin"] = random.choice([-1, 1]) * spin


def _warm(random, c, b1, b3, full):
    """Friction that depends on the surface temperature."""
    _heat(random, c, b1, b3, full)
    c["creep"] = tuple(10.0 * x for x in c["creep"])
    if random.random() < 0.5:
        c["extra"] += 'source = "established"\n'
    c["friction"] = (f'law = "temperature"\nvariation = "none"\nfref = {c["mu"]!r}\ntref = 50.0\ndfheat = {-0.4 * c["mu"]!r}\n'
                     f"dtheat = {random.uniform(50.0, 400.0)!r}\nmemdst = 0.0\nmem_s0 = 1.0\n")


def _shifts(random, c, b1, b3, full):
    """Four shifts, each continuing the previous one, with other directions and loads."""
    _shift(random, c, b1, b3, full)
    c["steps"] = 4
    size = math.hypot(*c["creep"])
    c["changes"] = {step: {"fn": c["fn"] * random.uniform(0.6, 1.2), "cksi": size * random.uniform(-1.0, 1.0),
                           "ceta": size * random.uniform(-1.0, 1.0)} for step in range(1, c["steps"])}


def _slender(random, c, b1, b3, full):
    """Ellipses of 1:4 to 1:10 in both directions, with the given mean of the semi-axes and creepages relative to full sliding."""
    ratio, mean = random.uniform(4.0, 10.0) ** random.choice([-0.5, 0.5]), math.sqrt(c["a"] * c["b"])
    larger = max(mean * ratio, mean / ratio) / max(c["a"], 0.5 * c["b"])
    c.update(a=mean * ratio, b=mean / ratio, creep=tuple(v / larger for v in c["creep"]))
    b1, b3 = curvatures(c["a"], c["b"], c["gg"][0] / (1.0 - c["poiss"][0]), c["fn"])
    c["geometry"] = f'form = "quadratic"\nplanform = "unrestricted"\nb = [{b1!r}, 0.0, {b3!r}, 0.0, 0.0, 0.0]\n'


def _spun(random, c, full):
    """With spin, 0.1 to 2 times that of full sliding."""
    c["spin"] = random.choice([-1, 1]) * full / math.sqrt(c["a"] * c["b"]) * math.exp(random.uniform(math.log(0.1), math.log(2.0)))


def _layer_spin(random, c, b1, b3, full):
    _layer(random, c, b1, b3, full)
    _spun(random, c, full)


def _dissimilar_spin(random, c, b1, b3, full):
    _dissimilar(random, c, b1, b3, full)
    _spun(random, c, full)


def _viscoelastic_spin(random, c, b1, b3, full):
    """Relaxation over a tenth to five times the half length, with spin."""
    length = c["a"] * math.exp(random.uniform(math.log(0.1), math.log(5.0))) / 1000.0
    c.update(model="viscoelastic", maxout=20, margin=1.5, material=f"fg = [1.0, 1.0]\ntc = [{length!r}, {length!r}]\n")
    _spun(random, c, full)


def _falling_forces(random, c, b1, b3, full):
    """Falling friction, forces below its kinetic value; half of the contacts with one prescribed force and spin."""
    _falling(random, c, b1, b3, full)
    _forces(random, c, b1, b3, full)
    c["force"] = tuple(0.65 * v for v in c["force"])
    if random.random() < 0.5:
        c["tangential"] = "fx_and_ceta"
        _spun(random, c, full)


def _one_force(random, c, b1, b3, full):
    """FX prescribed, with lateral creepage and spin."""
    c.update(tangential="fx_and_ceta", force=(random.uniform(-0.9, 0.9), c["creep"][1]))
    _spun(random, c, full)


def _with_heat(change):
    """A kind with surface temperatures."""
    def changed(random, c, b1, b3, full):
        change(random, c, b1, b3, full)
        _heat(random, c, b1, b3, full)
    return changed


def _two(random, c, b1, b3, full):
    """Two circles side by side, one of them lower."""
    b, n = c["b"], 2001
    apart, lower, y1, dy = random.uniform(0.9, 1.4) * b, random.uniform(0.0, 0.3), -4.0 * b, 8.0 * b / (n - 1)
    values = (min(b3 * (y + apart) ** 2, b3 * (y - apart) ** 2 + lower * b3 * b * b) for y in (y1 + k * dy for k in range(n)))
    c["geometry"] = (f'form = "profile"\nplanform = "unrestricted"\nxm = 0.0\nrm = {1 / (2 * b1)!r}\ny1 = {y1!r}\ndy1 = {dy!r}\n'
                     "b = [" + ", ".join(f"{v:.12g}" for v in values) + "]\n")
    c["margin"] = 2.2


CHANGES = {"rolling": _plain, "normal": _normal, "shift": _shift, "forces": _forces, "dissimilar": _dissimilar,
           "profile": _profile, "falling": _falling, "viscoelastic": _viscoelastic, "layer": _layer, "heat": _heat,
           "transient": _transient, "reverse": _reverse}
#: Kinds with extreme parameters, not part of the tables
FURTHER = {"unlike": _unlike, "extreme": _extreme, "warm": _warm, "shifts": _shifts, "steps": _steps,
           "slender": _slender, "layer_spin": _layer_spin, "dissimilar_spin": _dissimilar_spin,
           "viscoelastic_spin": _viscoelastic_spin, "falling_forces": _falling_forces, "one_force": _one_force, "two": _two}
FURTHER |= {f"{name}_heat": _with_heat(change)
            for name, change in (("dissimilar", _dissimilar_spin), ("layer", _layer_spin), ("viscoelastic", _viscoelastic_spin),
                                 ("profile", _profile), ("two", _two), ("slender", _slender))}
#: Kinds without second order: steps of the same length on finer grids
FIRST_ORDER = ("transient", "steps")


def stress_points(c):
    """Points below the surface, near the largest stresses."""
    depth, x, y = min(c["a"], c["b"]), c["a"] / 3.0, c["b"] / 3.0
    return ["[case.stress_output]", "matfil_s = 0", "output_s = 0", "[[case.stress_points]]", 'points = "free"',
            f"x = {[-x, 0.0, x]}", f"y = {[-y, 0.0, y]}", f"z = {[0.4 * depth, 0.6 * depth, 0.9 * depth]}"]


def text_of(c, n, offset, eps=1e-6, options=""):
    """The cases of a contact on n elements along each side; the grid is shifted by fractions of an element."""
    length_x, length_y = 2 * c["margin"] * c["a"], 2 * c["margin"] * c["b"]
    dx, dy = length_x / n, length_y / n
    xl, yl = -0.5 * length_x + (offset[0] - 0.5) * dx, -0.5 * length_y + (offset[1] - 0.5) * dy
    rolling = c["motion"].endswith("rolling")
    lines = []
    for step in range(c["steps"]):
        lines.append("[[case]]")
        lines += ['module = "contact"', f"result_element = {2 if c['extra'] else 1}",
                  f'motion = "{c["motion"]}"', f'normal = "{c["normal"]}"',
                  f'tangential = "{c["tangential"]}"', f'material_model = "{c["model"]}"', "output_level = 0", options,
                  f'sequence = "{"continue_all" if step else "initiate"}"', f'estimate = "{"previous" if step else "fresh"}"']
        if c.get("stresses"):
            lines += stress_points(c)
        if step:
            if step in c.get("changes", {}):
                lines += ["[case.kinematics]", *(f"{name} = {value!r}" for name, value in c["changes"][step].items())]
            continue
        load = f"fn = {c['fn']!r}" if c["normal"] == "force" else f"pen = {c['pen']!r}"
        xi, eta = c["creep"]
        lines += ["[case.iteration]", 'solver = "default"', f"eps = {eps!r}", "maxgs = 999", "maxin = 200", "maxnr = 60",
                  f"maxout = {c['maxout']}", "[case.kinematics]", load, f"cphi = {c['spin']!r}"]
        along, across = {"creepages": ("cksi", "ceta"), "fx_and_ceta": ("fx", "ceta")}.get(c["tangential"], ("fx", "fy"))
        given = (xi, eta) if along == "cksi" else c["force"]
        lines += [f"{along} = {given[0]!r}", f"{across} = {given[1]!r}"]
        lines += ["[case.friction]", c["friction"]]
        if rolling:
            lines += ["[case.rolling]", f"chi = {c['chi']!r}", f"dq = {c.get('dq', dx)!r}", "veloc = 1000.0"]
        lines += ["[case.material]", 'influence = "piecewise_constant"', f"poiss = {c['poiss']}", f"gg = {c['gg']}", c["material"],
                  "[case.grid]", 'form = "corner_and_sides"', f"mx = {n + 1}", f"my = {n + 1}", f"xl = {xl!r}", f"yl = {yl!r}",
                  f"dx = {dx!r}", f"dy = {dy!r}", "[case.geometry]", c["geometry"], c["extra"]]
    return "\n".join(lines) + "\n"


#: Points below the surface of a patch of wheel and rail [mm]
WHEEL_POINTS = """[case.stress_output]
matfil_s = 0
output_s = 0
[[case.stress_points]]
points = "free"
x = [-2.0, 0.0, 2.0]
y = [-1.5, 0.0, 1.5]
z = [0.7, 1.2, 2.0, 3.2, 5.0]
"""


#: Profiles of the examples
PROFILES = Path(__file__).resolve().parents[2] / "examples" / "profiles"


def some_wheels(random, count, folder=None):
    """Random wheels: ordinary ones, or, with a folder for the files of their profiles, wheels of any profiles."""
    if folder is None:
        return [wheel(random) for _ in range(count)]
    write_profiles(folder)
    return [any_wheel(random, PROFILES) for _ in range(count)]


def wheel(random):
    """A wheel S1002 on a rail 60E1 somewhere between the tread and the flange."""
    vs = 20000.0
    return {"kind": "wheel on rail", "steps": 1, "order": 1, "a": 1.0, "b": 1.0, "y": random.uniform(-5.0, 6.5),
            "yaw": random.uniform(-0.008, 0.008), "fz": random.uniform(20000.0, 120000.0), "mu": random.uniform(0.1, 0.5), "vs": vs,
            "vpitch": -vs / 460.0 * (1.0 + random.uniform(-0.0012, 0.0012)), "cant": random.choice([0.025, 0.05]),
            "normal": "force", "dx": random.uniform(0.3, 0.7)}


#: Pairs of rails and wheels in examples/profiles, and of files that tests/stability/worn_profiles.py writes; smoothed where rough
PAIRS = {"new": ("60E1.prr", "S1002.prw"), "both worn": ("60E1_worn.prr", "S1002_worn.prw"),
         "worn rail": ("60E1_worn.prr", "S1002.prw"), "worn wheel": ("60E1.prr", "S1002_worn.prw"),
         "hollow": ("worn.prr", "hollow.prw"), "deep": ("new.prr", "deep.prw"), "conformal": ("worn.prr", "deep.prw"),
         "flat": ("flat.prr", "new.prw"), "mirrored": ("mirrored_rail.txt", "mirrored_wheel.txt"),
         "smoothed": ("rough.ban", "rough.whl")}


def write_profiles(folder):
    """Write the files of the pairs that are not in examples/profiles."""
    sys.path.append(str(Path(__file__).resolve().parents[1] / "stability"))
    import worn_profiles
    present = Path.cwd()
    os.chdir(folder)
    rail, tread, simpack = worn_profiles.nominal()
    worn_profiles.write_profiles()
    simpack("deep.prw", 1, "deep", worn_profiles.worn_wheel(tread, 4.0, 2.5))
    simpack("flat.prr", 0, "flat", [(y, z + 2.5 * worn_profiles.bell(y, 3.0, 22.0)) for y, z in rail])
    os.chdir(present)


def any_wheel(random, profiles):
    """A wheel of any pair of profiles, from little creepage to sliding, on a track or a roller, some with a prescribed force."""
    vs = 20000.0

    def size(least, most):
        return math.exp(random.uniform(math.log(least), math.log(most)))

    pair = random.choice(sorted(PAIRS))
    # options that a case does not give are those of the case before
    more = {"mirrory": int(pair == "mirrored"), "smooth": 3.0 if pair == "smoothed" else 0.0, "ismooth": int(pair == "smoothed")}
    files = [({"file": str(profiles / name) if (profiles / name).exists() else name} | more) for name in PAIRS[pair]]
    creep = random.uniform(-0.0012, 0.0012) if random.random() < 0.5 else random.choice([-1, 1]) * size(5e-5, 5e-3)
    c = {"kind": pair, "steps": 1, "order": 1, "a": 1.0, "b": 1.0, "normal": "force", "vs": vs, "files": files,
         "y": random.uniform(3.0, 9.5) if random.random() < 0.4 else random.uniform(-12.0, 6.0),
         "yaw": random.choice([-1, 1]) * size(2e-4, 0.02), "fz": size(5000.0, 200000.0), "mu": random.uniform(0.1, 0.5),
         "vpitch": -vs / 460.0 * (1.0 + creep), "cant": random.choice([0.0, 0.025, 0.05]), "dx": size(0.2, 1.0)}
    c["place"], c["roller"] = ("roller" if random.random() < 0.2 else "track"), random.choice([300.0, 500.0, 1000.0])
    if random.random() < 0.2:
        c["tangential"], c["fx_ws"] = "longitudinal_force", random.uniform(-0.8, 0.8) * c["mu"] * c["fz"]
    return c


def wheel_text(c, factor, profiles, sides=None, full=False):
    """The case of a wheel with elements smaller by a factor, or of given sides (dx, ds) [mm]; full: with temperatures and stresses.

    Profiles are those of the folder, or those with names of their own.
    """
    along, across = sides or (c["dx"] / factor, c["dx"] / factor)
    rail, tread = ("\n".join(f"{name} = {value!r}" for name, value in part.items())
                   for part in c.get("files", ({"file": f"{profiles}/60E1.prr"}, {"file": f"{profiles}/S1002.prw"})))
    rolling = c.get("tangential", "velocities") != "longitudinal_force"
    given = f"vpitch = {c['vpitch']!r}" if rolling else f"fx_ws = {c['fx_ws']!r}"
    on = c.get("place", "track")
    track = f"gaught = 14.0\ngaugsq = 0.0\ngaugwd = 1435.0\ncant = {c['cant']!r}" if on == "track" else \
        f"gaught = -1.0\nraily0 = 752.0\nrailz0 = 0.0\nnomradr = {c.get('roller')!r}"
    speed = f"vs = {c['vs']!r}" if on == "track" else f"rpitch = {c['vs'] / c['roller']!r}"
    return f"""[[case]]
module = "wheel_rail"
configuration = "right_on_{on}"
motion = "steady_rolling"
normal = "force"
tangential = "{c.get("tangential", "velocities")}"
output_level = 0
sequence = "initiate"
estimate = "fresh"
[case.iteration]
solver = "default"
maxin = 100
maxnr = 60
maxgs = 999
eps = 1e-6
npot_max = 400000
[case.friction]
law = "coulomb"
variation = "none"
fstat = {c["mu"]!r}
fkin = {c["mu"]!r}
[case.material]
influence = "piecewise_constant"
poiss = [0.28, 0.28]
gg = [82000.0, 82000.0]
[case.search]
location = "locus"
dx = {along!r}
ds = {across!r}
a_sep = "90.0 deg"
d_turn = 12.0
[case.track]
{track}
[case.rail_profile]
{rail}
[case.deviations]
[case.wheel_dimensions]
fbdist = 1360.0
fbpos = -70.0
nomradw = 460.0
[case.wheel_profile]
{tread}
[case.position]
y_ws = {c["y"]!r}
yaw = {c["yaw"]!r}
fz = {c["fz"]!r}
[case.velocity]
{speed}
{given}
{STEEL + WHEEL_POINTS if full else ""}"""
