"""Random contact problems of module 3: scenes, their input, and simpler ones."""
import copy
import math

import judge3

# Digits whose values are rows of the table
SHOWN = ("B", "T", "V", "L", "C", "M", "H", "G", "S", "E")
VARIANTS = ("mirror_y", "mirror_x", "scaled", "moved", "interchanged", "refined", "library", "interleaved", "threads", "checked")


def logarithmic(rng, low, high):
    return math.exp(rng.uniform(math.log(low), math.log(high)))


def short(value):
    """A number with seven figures in a usual notation"""
    return float(f"{value:.7g}")


def one_of(rng, *weighted):
    """A choice from pairs (weight, value)"""
    return rng.choices([value for _, value in weighted], [weight for weight, _ in weighted])[0]


# ---------------------------------------------------------------------------------------------------------- scenes

def generate(rng):
    """A sequence of one to three cases, nearly always valid"""
    scene = _rounded(_scene(rng))
    scene["module"] = 3
    return scene


def _rounded(item):
    if isinstance(item, float):
        return item if item == math.pi else short(item)
    if isinstance(item, dict):
        return {key: _rounded(value) for key, value in item.items()}
    if isinstance(item, (list, tuple)):
        return [_rounded(value) for value in item]
    return item


def _digits(rng):
    """Control digits that can be combined; in one scene of fifty they are random"""
    d = {"T": one_of(rng, (1, 0), (2, 1), (2, 2), (3, 3))}
    steady = d["T"] == 3
    d["M"] = one_of(rng, (6, 0), (2, 4), (1, 2), (1 if d["T"] else 0, 3), (1.5 if steady else 0, 1), (0.7 if steady else 0, 5))
    d["H"] = one_of(rng, (3, 0), (1 if steady else 0, 3))
    d["L"] = one_of(rng, (3, 0), (1, 2), (1, 3), (1, 4), (2 if d["H"] and d["M"] not in (2, 3, 5) else 0, 6))
    d["V"] = one_of(rng, (5, 0), (1, 3))
    d["B"] = one_of(rng, (8, 0), (0.7, 1), (1, 2), (1, 3), (1, 4), (1, 5), (1, 6))
    d["C"] = one_of(rng, (6, 2), (2, 3), (1, 4), (0.7, 9)) if d["M"] in (0, 4) else 2
    if d["B"] == 3 and d["M"] not in (2, 3, 5):
        d["M"] = 2 if d["T"] else 0
        d["C"] = 2
    if d["B"] == 6 and d["M"] == 1:
        d["B"] = 5  # ANALYN has no memory
    some = 1 if d["T"] and d["M"] != 5 else 0
    d["E"] = one_of(rng, (6, 0), (some, 9), (0.2*some, 2), (0.2*some, 3))
    d["S"] = one_of(rng, (6, 0), (1, 3))
    d["G"] = one_of(rng, (6, 0), (1, 2), (1, 3), (1, 4), (1, 5))
    if rng.random() < 0.02:
        for name, values in (("M", (0, 1, 2, 3, 4, 5)), ("C", (2, 3, 4, 9)), ("L", (0, 2, 3, 4, 6)), ("H", (0, 3)),
                             ("B", (0, 2, 3, 4, 5, 6))):
            d[name] = rng.choice(values)
    return d


def _scene(rng):
    d = _digits(rng)
    scene = {"digits": d}
    big = rng.random() < 0.03
    # a few have unusual values
    wild = rng.random() < 0.15
    mx = (rng.randint(20, 60) if big else rng.choice([1, 2, rng.randint(3, 24), rng.randint(3, 24), rng.randint(3, 24),
                                                      rng.randint(3, 24)]))
    my = (rng.randint(20, 60) if big else rng.choice([1, rng.randint(2, 20), rng.randint(3, 20), rng.randint(3, 20),
                                                      rng.randint(3, 20)]))
    # rubber to steel
    g1 = logarithmic(rng, 0.3, 1e5)
    g2 = g1 if rng.random() < 0.6 else logarithmic(rng, 0.3, 1e5)
    nu1 = rng.choice([0.28, rng.uniform(0, 0.5), 0.5, 0.0])
    nu2 = nu1 if g1 == g2 and rng.random() < 0.9 else rng.uniform(0, 0.5)
    scene["g"], scene["nu"] = [g1, g2], [nu1, nu2]
    g = 2/(1/g1 + 1/g2)
    a = logarithmic(rng, 0.05, 100)
    b = a*(logarithmic(rng, 0.02, 50) if wild else logarithmic(rng, 0.2, 5))
    dx, dy = 2.3*a/mx, 2.3*b/my
    curvature = logarithmic(rng, 1e-4, 2e-2)/a
    across = curvature*(a/b)**2*logarithmic(rng, 0.7, 1.4)
    pen = curvature*a*a*rng.uniform(0.3, 1.0)
    fn = g*math.sqrt(a*b)*pen*rng.uniform(0.5, 2.0)
    if wild:
        fn *= logarithmic(rng, 1e-4, 1e3)
        pen *= logarithmic(rng, 1e-3, 3)
    _grid(rng, scene, mx, my, a, b, dx, dy, curvature, across, pen, wild)
    if scene["grid"]["ipotcn"] < 0 and d["C"] == 9:
        d["C"] = 2
    n = rng.choice([0, 1])
    if d["B"] == 4 or scene["grid"]["ipotcn"] in (-4, -5):
        n = 1
    if d["B"] in (5, 6):
        n = 0
    slip = pen/a*(logarithmic(rng, 1e-4, 1e3) if wild else 0.5)
    _rolling(rng, scene, a, dx)
    _friction(rng, scene, my, slip, wild)
    _surface(rng, scene, a, b, g, pen)
    scene["eps"] = rng.choice([1e-2, 1e-3, 1e-4, 1e-7, 1e-8]) if wild else rng.choice([1e-4, 1e-5, 1e-5, 1e-6])
    similar = abs((1 - 2*nu1)/g1 - (1 - 2*nu2)/g2)*g < 4e-4 and d["C"] in (2, 3)
    scene["maxout"] = rng.choice([1, 1, 20]) if similar else rng.choice([20, 20, 100, 1])
    scene["maxin"] = 200 if d["L"] else 100
    scene["omega"] = {2: [0.9, 1.0, 0, 1], 3: [0.9, 1.0, 0, 1], 4: [rng.choice([-1, 0, 1]), 1],
                      5: rng.choice([[0.5, 1, 1, 1, 1, 1, 1, 1], [1, 0.99, 1, 1, 0, 1, 1, 1],
                                     [-2, 0.97, 2, 1, 0, 2, 1, 1]])}.get(d["G"])
    if d["S"]:
        scene["points"] = [[3, a*1e-2, a*0.3]]
    scene["cases"] = [_case(rng, scene, k, n, pen, fn, slip, a, b, mx, my) for k in range(rng.choice([1, 1, 1, 2, 2, 3]))]
    scene["variant"] = rng.choice(VARIANTS)
    return scene


def _grid(rng, scene, mx, my, a, b, dx, dy, curvature, across, pen, wild):
    d = scene["digits"]
    ip = rng.choice([1, 1, 1, 1, 2, 3, 4, -1, -2, -3])
    if d["B"] == 4:
        ip = -6
    elif d["B"] in (2, 3):
        ip = rng.choice([-1, -2, -3, -4, -5])
    if ip == 4 and min(mx, my) < 2:
        ip = 1
    grid = {"ipotcn": ip, "mx": mx, "my": my}
    scene["grid"] = grid
    if ip < 0:
        grid["values"] = {-1: [curvature, across], -2: [curvature, a / b], -3: [a, b], -4: [curvature, b], -5: [a, b],
                          -6: [a, b, b * rng.uniform(0.3, 1.5)]}[ip] + [rng.choice([1.1, 1.2,
                                                                                    rng.uniform(0.5 if wild else 1.05, 3 if wild
                                                                                                else 2)])]
        return
    # sometimes off the middle
    xl = -0.5*mx*dx + rng.choice([0, 0, rng.uniform(-0.2, 0.2)*a])
    yl = -0.5*my*dy + rng.choice([0, 0, rng.uniform(-0.2, 0.2)*b])
    grid.update(xl=short(xl), yl=short(yl), dx=short(dx), dy=short(dy))
    ibase = rng.choice([1, 1, 1, 2, 3, 9])
    mixed = rng.choice([0.0, 0.0, rng.uniform(-0.5, 0.5)*math.sqrt(curvature*across)])
    if ibase == 1:
        values = [curvature, mixed, across, rng.choice([0, rng.uniform(-0.3, 0.3)*curvature*a]),
                  rng.choice([0, rng.uniform(-0.3, 0.3)*across*b]), rng.choice([0, 0, rng.uniform(-1, 1)*pen*(100 if wild else 1)])]
        values = [float(value) for value in values]
    elif ibase == 2:
        count = rng.choice([2, 9, rng.randint(3, 30)]) if rng.random() < 0.3 else 9
        step = 3*b/(count - 1)
        values = [count, rng.choice([0.0, rng.uniform(-0.1, 0.1)*a]), 0.5/curvature, -1.5*b, step]
        values += [across*(-1.5*b + i*step)**2 for i in range(count)]
    elif ibase == 3:
        values = [rng.uniform(0, 0.1)*pen, rng.uniform(0.5, 4)/a, rng.uniform(-1, 1)*a, rng.uniform(0, 0.1)*pen,
                  rng.uniform(0.5, 4)/a, rng.uniform(-1, 1)*a, 1/curvature, 1/across]
    else:
        noise = rng.choice([0, 0.02, 0.1, 0.5 if wild else 0.1])*pen
        # one hump or two
        apart = rng.choice([0, 0, 0.5])*a

        def height(x, y):
            return curvature*(abs(x) - apart)**2 + across*y*y

        values = [height(xl + (i + 0.5)*dx, yl + (j + 0.5)*dy) + rng.uniform(0, 1)*noise for j in range(my) for i in range(mx)]
    grid["ibase"], grid["gap"] = ibase, values
    grid["iplan"] = rng.choice([1, 1, 1, 1, 2, 3])
    if grid["iplan"] == 2:
        grid["plan"] = [1/a**2, 0.0, 1/b**2, 0.0, 0.0, -0.8]
    elif grid["iplan"] == 3:
        grid["plan"] = [-a, a, -0.5*b, 0.5*b, -0.5*a, 0.5*a, -b, b]


def _friction(rng, scene, my, slip, wild):
    law = scene["digits"]["L"]
    # velocities at which friction changes are of the order of the slip velocities
    speed = slip*scene.get("rolling", [0, 0, 1.0])[2]

    def one():
        if law == 0:
            mu = logarithmic(rng, 1e-3, 3) if wild else rng.choice([0.3, rng.uniform(0.05, 0.8), rng.uniform(0.05, 0.8)])
            return [short(mu), short(mu)]
        if law in (2, 3, 4):
            return [rng.uniform(0.1, 0.4), rng.uniform(0, 0.2), max(speed, 1e-3)*logarithmic(rng, 0.1, 100),
                    rng.choice([0.0, rng.uniform(0, 0.1)]), max(speed, 1e-3)*logarithmic(rng, 0.1, 100)]
        return [rng.uniform(0.2, 0.5), rng.uniform(0, 30), rng.uniform(-0.09, 0.05), rng.uniform(100, 800)]

    scene["friction"] = [one() for _ in range(my if scene["digits"]["V"] == 3 else 1)]
    if law >= 2:
        scene["memory"] = [rng.choice([0.0, logarithmic(rng, 1e-3, 10)]), logarithmic(rng, 0.1, 10)]


def _rolling(rng, scene, a, dx):
    d = scene["digits"]
    if d["T"] < 2:
        return
    chi = rng.choice([0.0, 0.0, math.pi])
    if d["M"] == 1:
        chi = rng.choice([0.0, 0.0, 0.0, math.pi])
    oblique = (d["T"] == 2 and d["M"] == 0 and d["C"] in (2, 3) and not d["H"]) or \
              (d["T"] == 3 and d["G"] == 2 and d["M"] == 0 and d["L"] == 0 and not d["H"] and d["C"] == 2)
    if oblique and rng.random() < 0.3:
        chi = rng.uniform(-3, 3)
    side = scene["grid"].get("dx", dx)
    dq = side
    if (d["T"] == 2 and d["M"] != 4 and d["C"] in (2, 3)) or (oblique and d["T"] == 3):
        dq = rng.choice([side, side*logarithmic(rng, 0.1, 3)])
    scene["rolling"] = [chi, dq, logarithmic(rng, 1, 1e5)]
    if rng.random() < 0.1:
        scene["rolling"].append(rng.uniform(0, 0.5))


def _surface(rng, scene, a, b, g, pen):
    """Parameters of a kind of material or of coefficients besides G and nu"""
    d = scene["digits"]
    slope = [rng.choice([1.0, rng.uniform(0.2, 1)]), rng.choice([1.0, rng.uniform(0, 1)]), rng.choice([1.0, rng.uniform(0, 2)])]
    shift = d["T"] in (1, 2)
    if shift:
        slope = [1.0, 1.0, 1.0]
    d_values = {1: lambda: [rng.uniform(0, 3), rng.uniform(0, 3), logarithmic(rng, 1e-5, 1e-1), logarithmic(rng, 1e-5, 1e-1)],
                2: lambda: [logarithmic(rng, 0.1, 3)*a/g] + slope, 3: lambda: slope, 5: lambda: slope,
                4: lambda: [g*logarithmic(rng, 1e-3, 1), rng.choice([0.0, a*logarithmic(rng, 1e-4, 1e-1)]),
                            rng.choice([0.0, 0.0, pen/a*g*logarithmic(rng, 0.02, 1)]),
                            rng.choice([0, 1, -1])*g/a*logarithmic(rng, 1e-3, 1)]}
    if d["M"] in d_values:
        scene["material"] = d_values[d["M"]]()
    if d["M"] == 1 and rng.random() < 0.5:
        scene["material"][1], scene["material"][3] = scene["material"][0], scene["material"][2]
    if d["B"] == 1:
        scene["sheet"] = a/g*logarithmic(rng, 1e-3, 10)
    if d["C"] == 4:
        count = rng.choice([2, 3, 5])
        angle = rng.uniform(-0.4, 0.4)
        scene["angles"] = [rng.choice([0, 1]), rng.randint(1, 4),
                           [[-2 * b + 4 * b * i / (count - 1), angle * (-1 + 2 * i / (count - 1)) + rng.uniform(-0.02, 0.02)]
                            for i in range(count)]]
    if d["H"] == 3:
        body = [rng.uniform(0, 50), logarithmic(rng, 100, 1000), logarithmic(rng, 0.01, 0.1), 7.85e-6]
        scene["heat"] = [body, body if rng.random() < 0.5 else [rng.uniform(0, 50)] + body[1:]]


def _case(rng, scene, k, n, pen, fn, slip, a, b, mx, my):
    d = scene["digits"]
    hertz = scene["grid"]["ipotcn"] < 0
    case = {"N": n, "P": 2, "I": 0, "keep": False}
    if k:
        case["keep"] = rng.random() < 0.5 and not (hertz and d["B"])
        case["P"] = rng.choice([0, 0, 0, 1, 2, 3])
        case["I"] = rng.choice([0, 1, 1, 2, 3])
        if hertz and not case["keep"]:
            case["P"], case["I"] = 2, 0
        elif not hertz and not case["keep"] and scene["grid"]["ibase"] != 9 and d["C"] != 9 and rng.random() < 0.3:
            case["move"] = [rng.randint(-2, 2), rng.randint(-1, 1)]
        fn *= rng.uniform(0.7, 1.1)
        pen *= rng.uniform(0.7, 1.1)
    case["F"] = rng.choice([0, 0, 0, 1, 2]) if d["T"] else 0
    case["load"] = fn if n else pen
    offset = scene["grid"].get("gap", [0]*6)[5] if scene["grid"].get("ibase") == 1 else 0
    if not n:
        case["load"] = pen + offset
    size = slip*logarithmic(rng, 0.01, 5)*(a if d["T"] == 1 else 1)
    x, y, phi = (rng.choice([0.0, size*rng.uniform(-1, 1), size*rng.uniform(-1, 1)]) for _ in range(3))
    part, angle = rng.choice([rng.uniform(0, 0.95), rng.uniform(0, 0.95), 0.999, 0.0]), rng.uniform(0, 2*math.pi)
    if case["F"] >= 1:
        x = part*(math.cos(angle) if case["F"] == 2 else rng.choice([-1, 1]))
    if case["F"] == 2:
        y = part*math.sin(angle)
    case.update(x=x, y=y, phi=phi/a)
    if rng.random() < 0.2:
        case["centre"] = [rng.uniform(-1, 1)*a, rng.uniform(-1, 1)*b]
    if d["E"] == 9:
        case["extra"] = [[rng.uniform(-0.3, 0.3)*size, rng.uniform(-0.3, 0.3)*size] for _ in range(mx*my)]
    if rng.random() < 0.05:
        case["damping"] = [logarithmic(rng, 1e-6, 1e-2), logarithmic(rng, 1e-6, 1e-2), 1e10, 1e10]
    return case


# ----------------------------------------------------------------------------------------------------------- input

def number(value):
    return repr(value) if isinstance(value, int) else repr(float(value))


def numbers(values):
    return " " + " ".join(number(value) for value in values)


def files(scene):
    """The input of a scene, and the file of coefficients of C = 9"""
    result = {"run.inp": input_text(scene)}
    if scene["digits"]["C"] == 9:
        result["run.cf"] = judge3.coefficient_file(scene)
    return result


def input_text(scene):
    lines = []
    for k in range(len(scene["cases"])):
        lines += ["3 MODULE"] + case_lines(scene, k)
    return "\n".join(lines + ["0 END"]) + "\n"


def interleaved_text(scenes):
    """Interleaved cases of several scenes, each with its own result element"""
    lines = []
    for k in range(max(len(scene["cases"]) for scene in scenes)):
        for element, scene in enumerate(scenes, start=1):
            if k < len(scene["cases"]):
                lines += [f"3 {element} 1 MODULE"] + case_lines(scene, k)
    return "\n".join(lines + ["0 END"]) + "\n"


def case_lines(scene, k):
    """All lines of case k (from 0) after its module line"""
    d, lines, case = scene["digits"], [], scene["cases"][k]
    first, fresh = k == 0, not case["keep"]
    s = d["S"] if first else min(d["S"], 1)
    lines.append(f" {case['P']}{d['B']}{d['T']}{case['N']}{case['F']}{s} P-B-T-N-F-S")
    grid_digit, law, coefficients, gap = (2, d["L"], d["C"], 2) if fresh else (0, 1, 0, 0)
    damping = " 2" if "damping" in case else " 0"
    lines.append(f" {d['V']}{law}{grid_digit}{coefficients}{d['M']}{gap}{d['E']}{damping} V-L-D-C-M-Z-E")
    heat = d["H"] if fresh else min(d["H"], 1)
    lines.append(f" {heat}{d['G'] if fresh else 1}{case['I']}2201 H-G-I-A-O-W-R")
    if fresh:
        lines.append(f" 999 {scene['maxin']} 60 {scene['maxout']} {number(scene['eps'])} MAXGS")
        if scene["omega"]:
            lines.append(numbers(scene["omega"]))
    lines.append(numbers([case["load"], case["x"], case["y"], case["phi"]] + case.get("centre", [])))
    rows = [numbers(row) for row in scene["friction"]]
    if "memory" in scene:
        rows.append(numbers(scene["memory"]))
    if fresh and d["V"] == 0:
        lines += rows
    if fresh and d["T"] >= 2:
        lines.append(numbers(scene["rolling"]))
    if fresh:
        lines += _coefficient_lines(scene)
    if "damping" in case:
        lines.append(numbers(case["damping"]))
    if fresh and d["H"] == 3:
        lines += [numbers(body) for body in scene["heat"]]
        if d["M"] == 4:
            lines.append(" 0.5")
    if fresh:
        lines += _grid_lines(judge3.grid_of(scene, k + 1))
    if fresh and d["V"] == 3:
        lines += rows
    if d["E"] == 9:
        lines += [numbers(pair) for pair in case["extra"]]
    if first and d["S"] == 3:
        lines += [" 1 1", " 1"] + [numbers(row) for row in scene["points"]] + [" 0"]
    return lines


def _coefficient_lines(scene):
    d, lines = scene["digits"], []
    if d["C"] == 4:
        method, variant, table = scene["angles"]
        lines.append(f" {method} {variant} {len(table)}")
        lines += [numbers(pair) for pair in table]
    elif d["C"] == 9:
        lines.append(" 'run.cf'")
    lines.append(numbers(scene["nu"] + scene["g"]))
    if "sheet" in scene:
        lines.append(numbers([scene["sheet"]]))
    if "material" in scene:
        lines.append(numbers(scene["material"]))
    return lines


def _grid_lines(grid):
    ip, mx, my = grid["ipotcn"], grid["mx"], grid["my"]
    lines = [f" {ip} IPOTCN"]
    if ip < 0:
        return lines + [f" {mx} {my}" + numbers(grid["values"])]
    xl, yl, dx, dy = (grid[name] for name in ("xl", "yl", "dx", "dy"))
    values = {1: [xl, yl, dx, dy], 2: [xl, yl, xl + mx*dx, yl + my*dy], 3: [xl + dx/2, yl + dy/2, dx, dy],
              4: [xl + dx/2, yl + dy/2, xl + (mx - 0.5)*dx, yl + (my - 0.5)*dy]}[ip]
    lines += [f" {mx} {my}" + numbers(values), f" {grid['ibase']} {grid['iplan']}"]
    gap = grid["gap"]
    if grid["ibase"] == 2:
        lines.append(f" {int(gap[0])}" + numbers(gap[1:5]))
        gap = gap[5:]
    lines += [numbers(gap[i:i + 10]) for i in range(0, len(gap), 10)]
    if grid["iplan"] > 1:
        lines.append(numbers(grid["plan"]))
    return lines


# ---------------------------------------------------------------------------------------------------------- judging

def labels(scene):
    """Rows of the table"""
    result = [f"{name} = {scene['digits'][name]}" for name in SHOWN]
    result += sorted({f"P = {case['P']}" for case in scene["cases"]} | {f"N = {case['N']}" for case in scene["cases"]}
                     | {f"F = {case['F']}" for case in scene["cases"]})
    result.append(f"IPOTCN = {scene['grid']['ipotcn']}")
    if "ibase" in scene["grid"]:
        result += [f"IBASE = {scene['grid']['ibase']}", f"IPLAN = {scene['grid']['iplan']}"]
    return result


def check(scene, tools):
    return judge3.check(scene, tools)


# ------------------------------------------------------------------------------------------------------- reduction

def reduce(scene):
    """Simpler scenes: fewer cases, plain digits, plain numbers, smaller grids"""
    def changed(change):
        simpler = copy.deepcopy(scene)
        return simpler if change(simpler) is not False and simpler != scene else None

    def digit(name, value, *drop):
        def change(s):
            if s["digits"][name] == value:
                return False
            s["digits"][name] = value
            for key in drop:
                s.pop(key, None)
            if name == "E":
                for case in s["cases"]:
                    case.pop("extra", None)
            if name == "G":
                s["omega"] = None
            return True
        return change

    def last_cases(count):
        def change(s):
            if len(s["cases"]) <= count:
                return False
            s["cases"] = s["cases"][-count:]
            s["cases"][0].update(P=2, I=0, keep=False)
            return True
        return change

    def first_cases(s):
        if len(s["cases"]) < 2:
            return False
        s["cases"].pop()
        return True

    def coulomb(s):
        if s["digits"]["L"] == 0:
            return False
        s["digits"]["L"] = 0
        s.pop("memory", None)
        s["friction"] = [[0.3, 0.3] for _ in s["friction"]]
        return True

    def one_friction(s):
        if s["digits"]["V"] == 0:
            return False
        s["digits"]["V"] = 0
        s["friction"] = s["friction"][:1]
        return True

    def plain_cases(s):
        for case in s["cases"]:
            for key in ("centre", "damping"):
                case.pop(key, None)
            case["keep"] = False

    def zero(name):
        def change(s):
            for case in s["cases"]:
                case[name] = 0.0
        return change

    def plain_gap(s):
        grid = s["grid"]
        if grid["ipotcn"] < 0 or grid.get("ibase") == 1:
            return False
        x, y = grid["mx"]*grid["dx"]/2.3, grid["my"]*grid["dy"]/2.3
        pen = max(case["load"] for case in s["cases"]) if not s["cases"][0]["N"] else 0.01*x
        grid["ibase"], grid["gap"] = 1, [pen/x**2, 0.0, pen/y**2, 0.0, 0.0, 0.0]
        return True

    def no_move(s):
        return any(case.pop("move", None) for case in s["cases"]) or False

    def no_plan(s):
        if s["grid"].get("iplan", 1) == 1:
            return False
        s["grid"]["iplan"] = 1
        s["grid"].pop("plan", None)
        return True

    def smaller(axis, side):
        def change(s):
            grid = s["grid"]
            if grid[axis] < 4 or grid.get("ibase") == 9 or s["digits"]["E"] == 9 or (axis == "my" and s["digits"]["V"] == 3):
                return False
            half = (grid[axis] + 1)//2
            if side in grid:
                grid[side] *= grid[axis]/half
                if axis == "mx" and "rolling" in s:
                    s["rolling"][1] *= grid[axis]/half
            grid[axis] = half
            return True
        return change

    def same_bodies(s):
        s["g"], s["nu"] = [s["g"][0]]*2, [s["nu"][0]]*2

    def rounded(s):
        s["g"], s["nu"] = [float(f"{v:.1g}") for v in s["g"]], [float(f"{v:.1g}") for v in s["nu"]]
        for case in s["cases"]:
            for key in ("load", "x", "y", "phi"):
                case[key] = float(f"{case[key]:.2g}")

    def unrestricted(s):
        s["eps"] = 1e-5

    for change in (last_cases(1), last_cases(2), first_cases, digit("S", 0, "points"), digit("H", 0, "heat"), coulomb, one_friction,
                   digit("E", 0), digit("G", 0), digit("B", 0, "sheet"), no_move, digit("C", 2, "angles"),
                   digit("M", 0, "material"), plain_cases, no_plan, plain_gap, same_bodies, zero("phi"), zero("y"), zero("x"),
                   smaller("mx", "dx"), smaller("my", "dy"), rounded, unrestricted):
        simpler = changed(change)
        if simpler is not None:
            yield simpler
