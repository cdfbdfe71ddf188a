"""Limits of effects: two cases with the same solution, made from a scene of limit_scenes.

A relation returns a dictionary:
    one, two   the scenes; two may be a function of the records of the first one
    limit      relative difference that the limit leaves
    factor     factors of the totals of the second one
    skip       totals that are not compared
    cases      pairs of numbers of cases from 0; default: each with its own
It raises DoesNotApply for scenes without the effect, or that it cannot be combined with.
"""
import copy
import math

from limit_scenes import LAWS, SIMPLIFIED, logarithmic

RELATIONS = {}
# Lower bound of the input [W/(mm degC)]
LEAST_CONDUCTIVITY = 1e-5


class DoesNotApply(Exception):
    pass


def demand(condition):
    if not condition:
        raise DoesNotApply


def relation(function):
    RELATIONS[function.__name__] = function
    return function


def pair(scene, **more):
    """Two copies of a scene"""
    return {"one": copy.deepcopy(scene), "two": copy.deepcopy(scene), **more}


def make_elastic(scene):
    """Homogeneous elastic bodies without a layer"""
    scene["common"]["material_model"] = "elastic"
    for name in ("fg", "tc", "gg3", "laythk", "tau_c0", "k_tau"):
        scene["common"]["material"].pop(name, None)


def make_coulomb(scene, value):
    """Coulomb friction, with a coefficient from the parameters of the law"""
    coefficient = value(scene["common"]["friction"])
    scene["common"]["friction"] = {"law": "coulomb", "fstat": coefficient, "fkin": coefficient}


def multiply(scene, names, factor):
    """Multiply numbers of the kinematics of all cases"""
    for step in scene["steps"]:
        for name in names:
            if name in step["kinematics"]:
                step["kinematics"][name] *= factor


# ---- Materials -------------------------------------------------------------------------------------------


@relation
def viscoelastic_limit(scene, rng):
    """Relaxation at once or never, of each body; a body of which nothing relaxes"""
    demand(scene["kind"] == "viscoelastic")
    result = pair(scene, skip=("elastic_energy",))
    passage, material = scene["size"]/scene["veloc"], result["one"]["common"]["material"]
    moduli = list(material["gg"])
    for body in range(2):
        short, left = rng.choice([(True, 0.0), (True, 1e-9), (False, 1e9), (False, None)])
        material["tc"][body] = 1e15 if left is None else left*passage
        result["limit"] = max(result.get("limit", 0.0), 1e-6 if left else 0.0)
        if short:
            moduli[body] /= 1.0 + material["fg"][body]
    make_elastic(result["two"])
    result["two"]["common"]["material"]["gg"] = moduli
    return result


@relation
def viscoelastic_division(scene, rng):
    """Bodies that relax alike and do not couple pressures with tractions: only the sums of their flexibilities count"""
    demand(scene["kind"] == "viscoelastic" and not (scene["module"] == 1 and per_element(scene)))
    result = pair(scene)
    material = result["one"]["common"]["material"]
    material["poiss"], material["tc"][1] = [0.5, 0.5], material["tc"][0]
    other, part = copy.deepcopy(material), rng.uniform(0.2, 0.8)
    immediate = sum(1.0/g for g in material["gg"])
    late = sum(f/g for f, g in zip(material["fg"], material["gg"]))
    other["gg"] = [1.0/(immediate*part), 1.0/(immediate*(1.0 - part))]
    other["fg"] = [late/immediate]*2
    result["two"]["common"]["material"] = other
    return result


def per_element(scene):
    """Wheels whose slip of the elements depends on the share of the rail in the compliance"""
    return scene["common"]["search"]["location"] in ("locus_extended", "conformal")


@relation
def layer_limit(scene, rng):
    """A layer without thickness, or of a stiff material"""
    demand(scene["kind"] == "layer")
    result = pair(scene)
    material = result["one"]["common"]["material"]
    if rng.random() < 0.5:
        material["laythk"] = 0.0
    else:
        material["gg3"] = 1e20
    make_elastic(result["two"])
    return result


@relation
def yield_limit(scene, rng):
    """A yield limit above all tractions, or hardening without end; a layer that yields is of order 1"""
    demand(scene["kind"] == "plastic")
    result = pair(scene, limit=1e-5)
    for name in ("one", "two"):
        result[name]["common"]["iteration"]["order"] = 1
    if rng.random() < 0.5:
        result["one"]["common"]["material"]["tau_c0"] = 100.0*max(scene["stress"], 1.0)
    else:
        result["one"]["common"]["material"]["k_tau"] = 1e7*scene["modulus"]/scene["size"]
    result["two"]["common"]["material"]["tau_c0"] = 0.0
    return result


@relation
def sheet_limit(scene, rng):
    """A sheet that hardly yields; with a sheet order 1 is used"""
    demand(scene["common"].get("pressure") == "thin_sheet")
    result = pair(scene)
    for name in ("one", "two"):
        result[name]["common"]["iteration"]["order"] = 1
    least = max(1e-9*scene["size"]/scene["modulus"], 1.01e-10)
    result["one"]["common"]["material"]["flxz"] = least
    result["limit"] = 1e-6 + 3.0*least*scene["modulus"]/scene["size"]
    del result["two"]["common"]["material"]["flxz"]
    result["two"]["common"]["pressure"] = "full"
    return result


@relation
def like_bodies(scene, rng):
    """Unlike bodies whose tractions do not couple are two like ones with the combined constants"""
    demand(scene["kind"] not in ("viscoelastic", "fastsim", "fastrip"))
    demand(not (scene["module"] == 1 and per_element(scene)))
    nu, ratio = rng.uniform(0.1, 0.4), rng.uniform(0.7, 1.4)
    other = 0.5*(1.0 - ratio*(1.0 - 2.0*nu))
    demand(0.0 <= other < 0.5)
    moduli = [scene["modulus"], scene["modulus"]*ratio]
    both = 2.0/(1.0/moduli[0] + 1.0/moduli[1])
    mean = 0.5*both*(nu/moduli[0] + other/moduli[1])
    result = pair(scene)
    result["one"]["common"]["material"].update(poiss=[nu, other], gg=moduli)
    result["two"]["common"]["material"].update(poiss=[mean, mean], gg=[both, both])
    result["one"]["common"]["iteration"]["maxout"] = rng.choice([1, 100])
    return result


# ---- Friction and heat -----------------------------------------------------------------------------------


@relation
def constant_law(scene, rng):
    """Falling friction whose terms vanish, or whose velocities are out of reach; memory does not matter then"""
    demand(scene["law"] in LAWS)
    name, vanish = LAWS[scene["law"]], rng.random() < 0.5
    result = pair(scene, limit=0.0 if vanish else 1e-5)
    friction = result["one"]["common"]["friction"]
    if vanish:
        friction[name + "1"] = 0.0
    else:
        friction["sabsh1"] = 1e9
    make_coulomb(result["two"], lambda f: f["fkin"] + (0.0 if vanish else f[name + "1"]))
    return result


@relation
def constant_temperature(scene, rng):
    """Friction that does not change with temperature, changes far above it, or hardly"""
    demand(scene["law"] == "temperature")
    result = pair(scene, limit=1e-5)
    friction = result["one"]["common"]["friction"]
    which = rng.randrange(3)
    if which == 0:
        friction["dfheat"] = 0.0
    elif which == 1:
        friction["tref"] = 99999.0
    else:
        friction["dtheat"], friction["dfheat"] = 99999.0, 1e-4*friction["dfheat"]
    make_coulomb(result["two"], lambda f: f["fref"])
    return result


@relation
def heat_is_a_result(scene, rng):
    """Temperatures change nothing if friction does not depend on them"""
    demand("heat" in scene["common"] and scene["law"] != "temperature")
    result = pair(scene)
    del result["two"]["common"]["heat"]
    return result


@relation
def like_friction(scene, rng):
    """Equal friction in all rows, or at all inclinations or positions"""
    demand(scene["common"]["tangential"] in ("creepages", "velocities", "longitudinal_force"))
    result = pair(scene)
    friction = result["one"]["common"]["friction"]
    shared = {name: friction[name] for name in ("law", "memdst", "mem_s0") if name in friction}
    row = {name: value for name, value in friction.items() if name not in shared}
    if scene["module"] == 3:
        rows = [dict(row) for _ in range(scene["common"]["grid"]["my"])]
        result["one"]["common"]["friction"] = {**shared, "variation": "by_row", "set": rows}
    else:
        word, name, unit = rng.choice([("by_angle", "alpha", 1.0), ("by_position", "svf", 100.0)])
        rows = [{name: unit*place, **row} for place in (-0.4, 0.1, 0.5)]
        result["one"]["common"]["friction"] = {**shared, "variation": word, "set": rows}
    return result


# ---- Scales ----------------------------------------------------------------------------------------------


@relation
def stiffer(scene, rng):
    """All moduli, stresses and forces times one factor"""
    k = logarithmic(rng, 0.1, 10.0)
    result = pair(scene, factor=dict.fromkeys(("fn", "fx", "fy", "mz", "pmax", "elastic_energy"), 1.0/k))
    common = result["two"]["common"]
    material = common["material"]
    material["gg"] = [g*k for g in material["gg"]]
    for name, factor in (("flxz", 1.0/k), ("flx", 1.0/k), ("gg3", k), ("tau_c0", k), ("k_tau", k)):
        if name in material:
            material[name] *= factor
    if "heat" in common:
        for name in ("lambda", "heatcp"):
            common["heat"][name] = [value*k for value in common["heat"][name]]
        demand(min(common["heat"]["lambda"]) > LEAST_CONDUCTIVITY)
    for step in result["two"]["steps"]:
        for group, name in (("kinematics", "fn"), ("position", "fz"), ("velocity", "fx_ws")):
            if name in step.get(group, {}):
                step[group][name] *= k
    return result


@relation
def faster(scene, rng):
    """All velocities times one factor, all times over it"""
    demand(scene["motion"] != "shift")
    k = logarithmic(rng, 0.1, 10.0)
    result = pair(scene)
    common = result["two"]["common"]
    if scene["module"] == 3:
        common["rolling"]["veloc"] *= k
    else:
        for step in result["two"]["steps"]:
            step["velocity"] = {name: value if name == "fx_ws" else value*k for name, value in step["velocity"].items()}
    if "tc" in common["material"]:
        common["material"]["tc"] = [time/k for time in common["material"]["tc"]]
    if scene["law"] in LAWS:
        demand(common["friction"]["sabsh1"]*k > 1e-4)
        common["friction"]["sabsh1"] *= k
        common["friction"]["mem_s0"] *= k
    if "heat" in common:
        common["heat"]["lambda"] = [value*k for value in common["heat"]["lambda"]]
        demand(min(common["heat"]["lambda"]) > LEAST_CONDUCTIVITY)
    return result


@relation
def rougher(scene, rng):
    """Friction, slips and tangential tractions of like bodies times one factor"""
    demand(scene["module"] == 3)
    k = logarithmic(rng, 0.1, 10.0)
    names = ("fx", "fy", "mz", "cksi", "ceta", "shift_x", "shift_y")
    result = pair(scene, factor=dict.fromkeys(names, 1.0/k), skip=("elastic_energy",))
    for name in ("one", "two"):
        material = result[name]["common"]["material"]
        material["poiss"] = [0.5, 0.5] if scene["kind"] == "viscoelastic" else [material["poiss"][0]]*2
        if scene["kind"] != "viscoelastic":
            material["gg"] = [material["gg"][0]]*2
    common = result["two"]["common"]
    friction = common["friction"]
    for name in friction:
        if name in ("fstat", "fkin", "fref", "dfheat", "sabsh1", "mem_s0", "memdst") or name[:4] in LAWS.values():
            friction[name] *= k
    demand(friction.get("sabsh1", 1.0) > 1e-4)
    if "tau_c0" in common["material"]:
        common["material"]["tau_c0"] *= k
    if "heat" in common:
        for name in ("lambda", "heatcp"):
            common["heat"][name] = [value*k*k for value in common["heat"][name]]
        demand(min(common["heat"]["lambda"]) > LEAST_CONDUCTIVITY)
    multiply(result["two"], ("cksi", "ceta", "cphi"), k)
    return result


# ---- Geometry and motion -----------------------------------------------------------------------------------


@relation
def whole_planform(scene, rng):
    """Planforms that exclude nothing, and parts that act on each other with full strength"""
    demand(scene["module"] == 3)
    result = pair(scene)
    far, half = 1e30, rng.uniform(-0.3, 0.3)*scene["size"]
    result["one"]["common"]["geometry"].update(rng.choice([
        {"planform": "quadratic", "pl": [0.0]*5 + [-1.0]},
        {"planform": "weighted_rectangles", "rectangles": [[-far, far, -far, far]], "fac": []},
        {"planform": "weighted_rectangles", "rectangles": [[-far, half, -far, far], [-far, far, -far, far]], "fac": [1.0]}]))
    return result


@relation
def plane_conformal(scene, rng):
    """Conformal contact on a plane, also an inclined one"""
    demand(scene["module"] == 3 and scene["kind"] in ("elastic", "layer", "plastic"))
    result = pair(scene)
    for name in ("one", "two"):
        result[name]["common"]["iteration"]["order"] = 1
    angle = rng.choice([0.0, 0.2])
    result["one"]["common"]["material"]["influence"] = "conformal"
    result["one"]["common"]["influence"] = {"if_meth": rng.choice([0, 1]), "variant": rng.randint(1, 4),
                                            "inclinations": [[-10.0, angle], [10.0, angle]]}
    result["two"]["common"]["material"]["influence"] = "piecewise_constant"
    return result


@relation
def other_spin_centre(scene, rng):
    """The same motion about another point"""
    common = scene["common"]
    demand(scene["module"] == 3 and common["tangential"] == "creepages" and "slip_source" not in common)
    demand(scene["kind"] not in SIMPLIFIED)
    result = pair(scene, skip=("cksi", "ceta", "shift_x", "shift_y"))
    x, y = rng.uniform(-1.0, 1.0)*scene["size"], rng.uniform(-1.0, 1.0)*scene["size"]
    for step, other in zip(result["one"]["steps"], result["two"]["steps"]):
        kinematics = other["kinematics"]
        step["kinematics"].update(spinxo=x, spinyo=y)
        kinematics["cksi"] += kinematics["cphi"]*y
        kinematics["ceta"] -= kinematics["cphi"]*x
    return result


@relation
def short_roll(scene, rng):
    """A shift is a roll over a very short distance"""
    demand(scene["motion"] == "shift" and scene["module"] == 3 and scene["common"]["tangential"] == "creepages")
    demand(scene["kind"] in ("elastic", "fastsim_single"))
    result = pair(scene, limit=1e-4, skip=("cksi", "ceta", "shift_x", "shift_y"))
    common = result["two"]["common"]
    distance, veloc = 1e-6*common["grid"]["dx"], logarithmic(rng, 1e-3, 1.0)
    common.update(motion="transient_rolling", rolling={"chi": 0.0, "dq": distance, "veloc": veloc, "facphi": 0.0})
    common["iteration"]["order"] = 1
    if scene["law"] in LAWS:
        for name in ("sabsh1", "mem_s0"):
            common["friction"][name] *= veloc/distance
            demand(common["friction"][name] < 1e9)
    multiply(result["two"], ("cksi", "ceta", "cphi"), 1.0/distance)
    return result


@relation
def prescribed(scene, rng):
    """The forces of a case with creepages give its creepages, its normal force its approach, and the reverse"""
    common = scene["common"]
    demand(scene["module"] == 3 and common["tangential"] == "creepages" and scene["kind"] not in ("fastsim", "fastrip", "plastic"))
    demand(scene["law"] in ("coulomb", "temperature"))
    normal, tangential = common.get("pressure") != "kpec", rng.choice(["creepages", "fx_and_ceta"])

    def from_results(records):
        two = copy.deepcopy(scene)
        two["common"]["tangential"] = tangential
        if normal:
            two["common"]["normal"] = {"force": "approach", "approach": "force"}[common["normal"]]
        for step, record in zip(two["steps"], records):
            totals, kinematics = record["patches"][0], step["kinematics"]
            if normal and "pen" in kinematics:
                del kinematics["pen"]
                kinematics["fn"] = totals["fn"]
            elif normal:
                del kinematics["fn"]
                kinematics["pen"] = totals["pen"]
            if tangential == "fx_and_ceta":
                if math.hypot(totals["fx_rel"], totals["fy_rel"]) > 0.95:
                    return None  # next to full sliding creepages are not determined by forces
                del kinematics["cksi"]
                kinematics["fx"] = totals["fx"]/(totals["fn"]*totals["mu_scal"])
        return two

    return {"one": copy.deepcopy(scene), "two": from_results, "limit": 19.0*200.0*common["iteration"]["eps"]}


# ---- Wheel on rail -----------------------------------------------------------------------------------------


@relation
def roller_without_end(scene, rng):
    """A roller of a radius of 1000 km is a track"""
    # in shifts grids are fixed to the particles, which are numbered from elsewhere on a roller
    demand(scene["module"] == 1 and not per_element(scene) and scene["motion"] != "shift")
    result = pair(scene, limit=2e-4)
    common = result["one"]["common"]
    del common["track"]["cant"]
    common["track"]["nomradr"] = 1e9
    common["configuration"] = common["configuration"].replace("track", "roller")
    for step in result["one"]["steps"]:
        step["velocity"]["rpitch"] = step["velocity"].pop("vs")/1e9
    return result


@relation
def stiff_springs(scene, rng):
    """A rail on stiff springs is a rigid one"""
    demand(scene["module"] == 1 and scene["common"]["tangential"] == "velocities")
    result = pair(scene, limit=1e-4)
    result["one"]["common"]["tangential"] = "massless_rail"
    result["one"]["common"]["springs"] = {"kyrail": 1e13, "fyrail": 0.0, "kzrail": rng.choice([0.0, 1e13]), "fzrail": 0.0}
    return result


@relation
def rail_and_wheelset_moved(scene, rng):
    """Rail and wheelset are elsewhere, and move together"""
    demand(scene["module"] == 1)
    result = pair(scene, limit=1e-6)
    dy, dz = rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)
    vy = 0.5*scene["slip"]*(1.0 if scene["motion"] == "shift" else scene["veloc"])
    result["one"]["common"]["deviations"] = {"dyrail": dy, "dzrail": dz, "vyrail": vy}
    for step in result["one"]["steps"]:
        step["position"]["y_ws"] += dy
        step["velocity"]["vy"] += vy
    return result


@relation
def height_and_force(scene, rng):
    """The height of a prescribed vertical force gives this force"""
    demand(scene["module"] == 1)

    def from_results(records):
        two = copy.deepcopy(scene)
        two["common"]["normal"] = "approach"
        for step, record in zip(two["steps"], records):
            del step["position"]["fz"]
            step["position"]["z_ws"] = record["totals"]["z_ws"]
        return two

    return {"one": copy.deepcopy(scene), "two": from_results, "limit": 5e-4}
