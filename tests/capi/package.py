#!/usr/bin/env python3
"""The Python package: objects, errors, wrong use, threads."""
import copy
import gc
import inspect
import os
import pickle
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import warnings

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "conformance"))
from checks import SOURCE, check, close, finish, same
import contact
import numpy as np
from contact import cntc
from contact._library import call, last_error

PROFILES = os.path.join(SOURCE, "examples/profiles")


def raises(kind, call, word, what):
    """Check that a call raises an error whose text has a word; returns the error"""
    try:
        call()
    except kind as error:
        check(word in str(error), f"{what}: '{word}' is in '{error}'")
        return error
    check(False, f"{what}: no error")
    return None


def ball(problem, mx=15):
    """A ball on a plane, with creepage"""
    problem.set_material(g=82000.0, nu=0.28)
    problem.set_friction(0.3)
    problem.set_hertz(mx, mx, aa=5.0, bb=5.0)
    problem.set_normal_force(50e3)
    problem.set_creepages(0.001, 0.0005)


def results():
    """Shapes, sums and units of results"""
    with contact.Problem() as problem:
        ball(problem)
        result = problem.solve()
    same(result.pn.shape, (15, 15), "shape of fields")
    same((result.x.shape, result.y.shape), ((15,), (15,)), "shape of coordinates")
    element = result.dx * result.dy
    close([result.pn.sum() * element, result.px.sum() * element], [result.fn, result.fx], 1e-6 * result.fn, "sums")
    close(result.contact_area, element * np.count_nonzero(result.state), 1e-9, "area")
    same(result.border_elements, 0, "border")
    check(0.0 < result.max_traction <= 0.3 * result.max_pressure * (1 + 1e-9), "largest traction")
    raises(contact.ContactError, problem.solve, "closed", "a closed problem")
    with contact.Problem(units="si") as problem:
        problem.set_material(g=82e9, nu=0.28)
        problem.set_friction(0.3)
        problem.set_hertz(15, 15, aa=5e-3, bb=5e-3)
        problem.set_normal_force(50e3)
        problem.set_creepages(0.001, 0.0005)
        metres = problem.solve()
    close(metres.fx, result.fx, 1e-9 * result.fn, "force in SI units")
    close(metres.pn * 1e-6, result.pn, 1e-6, "pressure in SI units")


def distance():
    """A distance as function and as array is that of Hertz' geometry"""
    with contact.Problem() as problem:
        ball(problem, 21)
        hertz = problem.solve()
        a1, b1 = cntc.gethertzcontact(problem.number, 1)[:2]
        x, y = problem.set_grid(21, 21, hertz.dx, hertz.dy)
        close(x, hertz.x, 1e-9, "centres of elements")
        problem.set_distance(lambda x, y: a1 * x**2 + b1 * y**2)
        function = problem.solve()
        problem.set_distance(a1 * x[np.newaxis, :]**2 + b1 * y[:, np.newaxis]**2)
        array = problem.solve()
    for other in (function, array):
        close(other.pn, hertz.pn, 1e-3 * hertz.max_pressure, "pressure")
        close([other.fx, other.fy], [hertz.fx, hertz.fy], 1e-4 * hertz.fn, "forces")


def arrays():
    """Arrays that cannot be meant are refused: masked elements, complex numbers, transposed or of another size"""
    with contact.Problem() as problem:
        ball(problem)
        x, y = problem.set_grid(12, 9, 0.5, 0.5)
        right = x[np.newaxis, :]**2 / 200.0 + y[:, np.newaxis]**2 / 300.0
        problem.set_distance(right)
        problem.set_normal_force(5000.0)
        fx = problem.solve().fx
        for same_values in (np.asfortranarray(right), np.repeat(right, 2, axis=1)[:, ::2], right.tolist(), right.astype(">f8"),
                            np.ma.array(right, mask=False), lambda x, y: x**2 / 200.0 + y**2 / 300.0):
            problem.set_distance(same_values)
            same(problem.solve().fx, fx, "the same array in another form")
        cntc.setundeformeddistc(problem.number, 1, 9, right.ravel())
        same(problem.solve().fx, fx, "as one row")
        shape = "(my, mx) = (9, 12)"
        for wrong, word in ((np.ma.array(right, mask=right > 0.02), "masked"), (right + 1j, "complex"), (right.T, shape),
                            (right.ravel(), shape), (right[None], shape)):
            raises(ValueError, lambda given=wrong: problem.set_distance(given), word, "an array of distances")
        raises(ValueError, lambda: cntc.setundeformeddistc(problem.number, 1, 9, right.T), shape, "transposed")
        raises(ValueError, lambda: cntc.setextrarigidslip(problem.number, 1, right.T, right.T), shape, "transposed")
        same(problem.solve().fx, fx, "nothing was changed by them")
        # a distance that was refused is not needed with a Hertzian geometry
        raises(contact.ContactError, lambda: problem.set_distance(np.where(right > 0.02, np.nan, right)), "not a number", "NaN")
        raises(contact.ContactError, problem.solve, "was refused and not made again", "a distance that is missing")
        ball(problem)
        same(problem.solve().status, "solved", "Hertz after a refused distance")
        # an error of a single routine is not that of the next setting of the object
        cntc.setnormalforce(problem.number, 1, -1.0)
        problem.set_friction(0.2)
        raises(contact.ContactError, problem.solve, "FN = -1", "it is told by the calculation")
    # values per element are not those of a grid with other columns and rows
    with contact.Problem() as problem:
        ball(problem)
        for mx, my in ((12, 9), (9, 12)):
            other = f"given for {my} x {mx} elements" if mx < my else ""
            x, y = problem.set_grid(mx, my, 0.5, 0.5)
            if other:
                raises(contact.ContactError, problem.solve, other, "a distance per element on another grid")
            problem.set_distance(x[np.newaxis, :]**2 / 200.0 + y[:, np.newaxis]**2 / 300.0)
            if other:
                raises(contact.ContactError, problem.solve, "columns or rows", "a slip per element on another grid")
            cntc.setextrarigidslip(problem.number, 1, np.full((my, mx), 1e-4), np.zeros((my, mx)))
            same(problem.solve().status, "solved", f"{mx} x {my} elements")
            problem.set_grid(mx, my, 0.6, 0.5)
            same(problem.solve().status, "solved", "values move with their elements")


def dissimilar_bodies():
    """Pressures and tractions of dissimilar bodies are iterated, whether solver or material is set first"""
    found = {}
    for order in ("solver, material", "material, solver", "material", "one pass"):
        with contact.Problem() as problem:
            problem.set_friction(0.4)
            problem.set_hertz(15, 15, a1=0.04, b1=0.03)
            problem.set_normal_force(90.0)
            problem.set_creepages(0.003, -0.001, 0.01)
            for what in order.split(", "):
                if what == "solver":
                    problem.set_solver(eps=1e-6)
                else:
                    problem.set_material(g=2000.0, nu=0.3, g2=500.0, nu2=0.42)
            if order == "one pass":
                problem.set_solver(eps=1e-6, maxout=1)
            result = problem.solve()
            found[order] = result.fx / result.fn
    for order in ("solver, material", "material, solver"):
        close(found[order], found["material"], 1e-6, order)
    check(abs(found["one pass"] - found["material"]) > 2e-4, f"Johnson's method differs: {found}")


def prescribed_and_transient():
    """Forces prescribed; a shift that continues"""
    with contact.Problem() as problem:
        ball(problem)
        problem.set_tangential_force(-0.5, 0.3)
        result = problem.solve()
        close([result.fx, result.fy], [-0.5 * 0.3 * 50e3, 0.3 * 0.3 * 50e3], 1e-3 * 15e3, "prescribed forces")
        problem.set_tangential_force(-0.5)
        result = problem.solve()
        close(result.fx, -0.5 * 0.3 * 50e3, 1e-3 * 15e3, "prescribed longitudinal force")
    with contact.Problem(motion="shift") as problem:
        ball(problem)
        problem.set_creepages(0.005)
        first = problem.solve()
        second = problem.solve(initiation=False)
        check(abs(second.fx) > 1.2 * abs(first.fx), "a second shift adds to the first")
        again = problem.solve()
        close(again.fx, first.fx, 1e-9 * first.fn, "a new sequence has no history")


def errors():
    """Wrong settings are reported at once, in words, and once"""
    with contact.Problem() as problem:
        ball(problem)
        error = raises(contact.ContactError, lambda: problem.set_material(g=82000.0, nu=0.28, model=4), "", "material")
        check(error.code != 0, "an error has a code")
        raises(contact.ContactError, problem.solve, "was refused", "a material that was refused")
        problem.set_material(g=82000.0, nu=0.28)
        texts = warned(lambda: problem.set_flags(ic_matfil=9))[1]
        check(len(texts) == 1 and "= 9" in texts[0] and "replaced by 0" in texts[0], f"a flag that is replaced warns: {texts}")
        same(problem.solve().border_elements, 0, "the problem still works")
        raises(contact.ContactError, lambda: problem.set_creepages(float("nan")), "number", "an invalid creepage")
        raises(ValueError, lambda: problem.set_flags(ic_nothing=3), "ic_nothing", "unknown flag")
        raises(ValueError, lambda: problem.set_hertz(5, 5, aa=1.0), "aa and bb", "half a geometry")
        raises(ValueError, lambda: problem.set_hertz(5.5, 5, aa=1.0, bb=1.0), "5.5", "half an element")
        raises(ValueError, lambda: problem.set_grid(5, 5.5, 1.0, 1.0), "5.5", "half an element of a grid")
        raises(ValueError, lambda: problem.set_flags(ic_tang=2.9), "integers", "a digit that is none")
        raises(ValueError, lambda: problem.set_flags(ic_tang="2"), "integers", "a digit in quotes")
        raises(ValueError, lambda: problem.set_solver(maxgs=1.5), "integers", "half an iteration")
        raises(ValueError, lambda: problem.set_rolling(0.0), "positive", "no velocity")
        raises(ValueError, lambda: problem.set_rolling(-1000.0), "direction", "rolling backwards")
        for copied in (copy.copy, copy.deepcopy, pickle.dumps):
            raises(TypeError, lambda: copied(problem), "anew", "a copy of a problem")  # noqa: B023
        raises(ValueError, lambda: contact.Problem(units="inch"), "inch", "unknown units")
        raises(ValueError, lambda: contact.Problem(motion="flying"), "flying", "unknown motion")
        raises(contact.ContactError, lambda: contact.output_to("elsewhere"), "before", "output_to too late")
        raises(contact.ContactError, lambda: contact.WheelRail().set_rail("no_such_file.prr"), "rail", "missing profile")
    raises(ValueError, lambda: cntc.getcontactforces(1, 0), "icp", "a patch is needed")
    raises(TypeError, lambda: call("cntc_finalize", 1, 2), "too many", "too many values")


def many():
    """Problems are released when they are no longer used; more at a time than the limit are refused"""
    for _ in range(250):
        ball(contact.Problem())
    gc.collect()
    problems = []

    def fill():
        while len(problems) < 101:
            problems.append(contact.Problem())

    raises(contact.ContactError, fill, "close some", "too many problems")
    same(len(problems), 100, "problems at a time")
    for problem in problems:
        problem.close()
    with contact.Problem() as problem:
        ball(problem)
        problem.solve()


def threads():
    """Problems in threads of Python have the same results as one after the other"""
    creepages = [0.0002 * k for k in range(1, 25)]

    def curve(cases):
        with contact.Problem() as problem:
            ball(problem)
            for cksi in cases:
                problem.set_creepages(cksi)
                forces[cksi] = problem.solve().fx

    forces = {}
    curve(creepages)
    alone, forces = forces, {}
    cntc.setglobalflags(cntc.CNTC["if_openmp"], -1)
    count = min(4, cntc.getmaxnumthreads())
    workers = [threading.Thread(target=curve, args=(creepages[k::count],)) for k in range(count)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    check(forces == alone, "threads and one by one")


def wheel(pair):
    """A wheel on a rail, in mm"""
    pair.set_material(g=82000.0, nu=0.28)
    pair.set_friction(0.3)
    pair.set_grid(dx=0.4, ds=0.4)
    pair.set_track(gauge_height=14.0, gauge_width=1435.0, cant=0.025)
    pair.set_wheelset(flange_back=1360.0, flange_back_position=-70.0, radius=460.0)
    pair.set_rail(os.path.join(PROFILES, "60E1.prr"))
    pair.set_wheel(os.path.join(PROFILES, "S1002.prw"))
    pair.set_position(y=2.0, yaw=0.0048)
    pair.set_velocity(2000.0, pitch=-2000.0 / 460.0)
    pair.set_vertical_force(10e3)


def wheel_on_rail():
    """Sums, sides, profiles as arrays, heights instead of forces, stresses"""
    with contact.WheelRail("right") as pair:
        wheel(pair)
        result = pair.solve()
        same(len(result.patches), 1, "patches")
        patch = result.patches[0]
        close(result.forces.track.force[2], 10e3, 1.0, "vertical force")
        turned = patch.fn * np.cos(patch.angle) + patch.fy * np.sin(patch.angle)
        close(turned, result.forces.track.force[2], 1.0, "forces of the patch, turned into the track system")
        close(patch.pn.sum() * patch.dx * patch.dy, patch.fn, 1.0, "sum of pressures")
        sizes = [np.linalg.norm(part.force) for part in (result.forces.wheel, result.forces.wheelset, result.forces.rail)]
        close(sizes, 3 * [np.linalg.norm(result.forces.track.force)], 1e-3, "one force in four directions")

        pair.add_block(x=[0.0, 1.0], y=[0.0], z=[0.0, 1.0, 3.0])
        stresses = pair.stresses()
        same((len(stresses), stresses[0].von_mises.shape), (1, (3, 1, 2)), "stresses of one patch")
        tensor = stresses[0].tensor[:, :, 1, 0, 1]
        close(tensor, tensor.T, 1e-9 * np.abs(tensor).max(), "the tensor is symmetric")
        close(np.sort(np.linalg.eigvalsh(tensor)), np.sort(stresses[0].principal[:, 1, 0, 1]),
              1e-6 * np.abs(tensor).max(), "principal stresses")
        close(np.trace(tensor) / 3, stresses[0].hydrostatic[1, 0, 1], 1e-6 * np.abs(tensor).max(), "hydrostatic stress")

        pair.set_position(y=2.0, yaw=0.0048, z=result.wheelset_position[2])
        given = pair.solve()
        close(given.forces.track.force, result.forces.track.force, 20.0, "the height gives the force")
        pair.set_position(y=2.0, yaw=0.0048, z=-50.0)
        apart = pair.solve()
        same(len(apart.patches), 0, "a wheel above the rail touches nowhere")
        close(apart.forces.track.force, np.zeros(3), 0.0, "and has no force")

        pair.set_position(y=2.0, yaw=0.0048)
        pair.set_vertical_force(10e3)
        for setter, kind in ((pair.set_rail, 0), (pair.set_wheel, 1)):
            setter(cntc.getprofilevalues(pair.number, 1, [kind, 0]))
        arrays = pair.solve()
        close(arrays.forces.track.force, result.forces.track.force, 20.0, "profiles as arrays")
        height = arrays.wheelset_position[2]
        pair.set_position(y=2.0, z=height + 0.01, yaw=0.0048)
        check(pair.solve().forces.track.force[2] > 1.02 * arrays.forces.track.force[2], "a given height replaces the force")
        pair.set_position(y=2.0, yaw=0.0048)
        close(pair.solve().wheelset_position[2], height, 1e-5, "without a height it is computed again")
    with contact.WheelRail() as pair:
        pair.set_position(y=2.0)
        raises(ValueError, pair.solve, "set_vertical_force", "neither height nor force")
        pair.set_vertical_force(10e3)
        raises(contact.ContactError, pair.solve, "profile", "a force, but no profiles")
    with contact.WheelRail("left") as pair:
        wheel(pair)
        pair.set_position(y=-2.0, yaw=-0.0048)
        left = pair.solve()
    close(left.forces.track.force, result.forces.track.force * [1, -1, 1], 1e-3, "left and right are mirror images")
    close(left.patches[0].pn, patch.pn[::-1], 1e-6 * patch.max_pressure, "pressures too")
    with contact.WheelRail("right") as pair:
        raises(contact.ContactError, pair.solve, "profile", "no profiles")
    with contact.Problem() as problem:
        raises(TypeError, lambda: problem.set_material((82000.0, 200.0), (0.28, 0.42)), "g2", "two materials")
    raises(ValueError, lambda: contact.WheelRail("middle"), "middle", "side")


def curve_and_tape():
    """A curve turns the rail about the centre of the track, mirrored on the left; a radius may be given at a tape circle"""
    curvature, rail_y, found = 2e-6, 753.0, {}
    for side, sign in (("right", 1.0), ("left", -1.0)):
        with contact.WheelRail(side) as pair:
            wheel(pair)
            pair.set_position(y=2.0 * sign, yaw=0.0048 * sign)
            for curve in (0.0, curvature):
                pair.set_rail_position(rail_y * sign, 0.0, cant=0.025, curvature=curve * sign)
                found[side, curve] = pair.solve()
            pair.set_track(gauge_height=14.0, gauge_width=1435.0, cant=0.025, curvature=curvature * sign)
            found[side, "gauge"] = pair.solve()
    for case in (0.0, curvature, "gauge"):
        close(found["left", case].forces.track.force, found["right", case].forces.track.force * [1, -1, 1], 1e-3, "mirrored curve")
    contacts = [found["right", curve].patches[0] for curve in (0.0, curvature)]
    # the contact is a few millimetres beside the origin of the rail
    close(abs(contacts[1].cksi - contacts[0].cksi), rail_y * curvature, 0.02 * rail_y * curvature, "creepage of the curve")

    with open(os.path.join(PROFILES, "S1002.prw"), encoding="utf-8") as file:
        points = np.array(re.findall(r"^ +(-?\d+\.\d+) +(-?\d+\.\d+)$", file.read(), re.MULTILINE), dtype=float)
    points = points[np.argsort(points[:, 0])]
    height = np.interp(20.0, *points.T)
    check(abs(height) > 0.1, "the radius varies across the wheel")
    with contact.WheelRail() as pair:
        wheel(pair)
        results = []
        for radius, tape in ((460.0, 20.0), (460.0 - height, None), (460.0, None)):
            pair.set_wheelset(flange_back=1360.0, flange_back_position=-70.0, radius=radius, tape=tape)
            results.append(pair.solve())
    close(results[0].forces.track.force, results[1].forces.track.force, 5.0, "radius at a tape circle or at the origin")
    check(abs(results[2].patches[0].cksi - results[0].patches[0].cksi) > 1e-4, "the tape circle acts, and is forgotten")


def profiles():
    """Warnings about a profile reach the caller that sets it: a flange on the outer side, z upwards"""
    with open(os.path.join(PROFILES, "S1002.prw"), encoding="utf-8") as file:
        points = np.array(re.findall(r"^ +(-?\d+\.\d+) +(-?\d+\.\d+)$", file.read(), re.MULTILINE), dtype=float)
    with contact.WheelRail() as pair:
        wheel(pair)
        for factors, word in (((1.0, 1.0), None), ((-1.0, 1.0), "flange on the outer side")):
            _, messages = warned(lambda given=points * factors: pair.set_wheel(given))
            same([word in message for message in messages] if word else messages, [True] if word else [], "warnings of a wheel")


def thin_sheet():
    """A sheet between wheel and rail needs its flexibility, which was 0 without a word"""
    with contact.WheelRail() as pair:
        wheel(pair)
        whole = pair.solve().patches[0].max_pressure
        pair.set_flags(ic_bound=1)
        raises(contact.ContactError, pair.solve, "FLXZ = 0 is below its lower bound", "a sheet without flexibility")
        cntc.setmaterialparameters(pair.number, -1, 0, [0.28, 0.28, 82000.0, 82000.0, 1e-5])
        check(pair.solve().patches[0].max_pressure < 0.9 * whole, "a sheet distributes the pressure")


def older_scripts():
    """Scripts for the published package: its name, and values that the options do not need"""
    import python_intfc
    same(python_intfc.getmagicnumbers()["if_units"], 1933, "named numbers")
    check(cntc.cntc_setflags is cntc.setflags is python_intfc.setflags, "names with and without cntc_")
    with open(os.path.join(SOURCE, "tests/octave/published_names.txt")) as table:
        words = [line.split() for line in table if line.strip() and not line.startswith("#")]
    calls = [call.split("/") for line in words if line[0] == "call" for call in line[1:] if call.startswith(("cntc_", "subs_"))]
    check(len(calls) > 60, "calls of the table")
    for name, arguments, _ in calls:
        # only Matlab has routines for licences
        if name != "cntc_managelicense":
            takes = inspect.signature(getattr(python_intfc, name)).parameters
            check(len(takes) >= int(arguments), f"{name} takes {arguments} arguments")
    constants = {name for line in words if line[0] == "constant" for name in line[1:]}
    check(constants <= set(python_intfc.getmagicnumbers()), f"constants {constants - set(python_intfc.getmagicnumbers())}")
    raises(AttributeError, lambda: cntc.cntc_nothing, "cntc_nothing", "an unknown name")
    with contact.WheelRail() as pair:
        cntc.setwheelsetdimensions(pair.number, 2, [1360.0, -70.0, 460.0])
        cntc.setwheelsetflexibility(pair.number, 1, np.zeros(12))
        cntc.settrackdimensions(pair.number, 0, [14.0, 0.0, 1435.0])
        same(last_error(pair.number, -1), (0, ""), "values that are not needed can be omitted")
        cntc.setflags(pair.number, None, cntc.CNTC["ic_tang"], 1)
        same(cntc.getflags(pair.number, [], cntc.CNTC["ic_tang"]).tolist(), [1], "None and [] are the default")


def documents():
    """The code blocks of Python in the documents run as printed"""
    folder = os.getcwd()
    with tempfile.TemporaryDirectory() as scratch:
        # beside the examples; their output is not part of the sources
        os.symlink(os.path.join(SOURCE, "examples"), os.path.join(scratch, "examples"))
        os.chdir(scratch)
        for name in ("README.md", "python/README.md", "doc/user/python.md"):
            with open(os.path.join(SOURCE, name), encoding="utf-8") as file:
                pieces = re.findall(r"^```python\n(.*?)^```", file.read(), re.MULTILINE | re.DOTALL)
            check(len(pieces) > 0, f"{name} has pieces of Python")
            room = {}
            for piece in pieces:
                exec(compile(piece, name, "exec"), room)
        os.chdir(folder)


def warned(call):
    """The result of a call, and the texts of its warnings"""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = call()
    return found, [str(warning.message) for warning in caught if issubclass(warning.category, contact.ContactWarning)]


def doubts():
    """Truncated contact, larger elements, and stresses near the surface between centres give warnings"""
    with contact.Problem() as problem:
        problem.set_material(g=1.0, nu=0.28)
        problem.set_friction(0.3)
        problem.set_normal_force(9.1954)
        problem.set_creepages(0.001)
        for first, border in (((-0.5, -0.5), ("x low", "x high", "y low", "y high")), ((-2.2, -0.6), ("y low",)),
                              ((-2.2, -2.2), ())):
            mx = 10 if len(border) == 4 else 44
            problem.set_grid(mx, mx, 0.1, 0.1, *first)
            problem.set_distance(lambda x, y: 0.5 * (x**2 + y**2))
            result, messages = warned(problem.solve)
            same(result.border, border, "sides that cut contact off")
            same([text.startswith("contact reaches " + ", ".join(border)) for text in messages], [True] * bool(border),
                 "their warning")
            same(result.border_elements > 0, bool(border), "elements at the border")
        problem.add_block([0.0, 0.05], [0.05], [0.0, 0.02, 0.025, 0.5])
        stresses, messages = warned(problem.stresses)
        same([text.split()[0] for text in messages], ["2"], "points between centres near the surface")
        problem.add_block(None, None, [0.0, 0.5])
        stresses, messages = warned(problem.stresses)
        same((stresses.von_mises.shape, messages), ((2, 44, 44), []), "centres of all elements")
        same(np.allclose(stresses.x, result.x), True, "positions of the centres")
        raises(ValueError, lambda: problem.add_block(None, [0.0], [0.0]), "both", "half of the centres")
        problem.set_grid(7, 7, 1.2, 1.2, -4.2, -4.2)
        problem.set_distance(lambda x, y: 0.5 * (x**2 + y**2))
        result, messages = warned(problem.solve)
        across = cntc.getflags(problem.number, 1, cntc.CNTC["own_across"])
        same((result.elements_across, across.tolist()), (3, [3]), "elements across")
        same([text.split(":")[0] for text in messages], ["contact is only 3 elements wide"], "warning of few elements")
    with open(os.path.join(PROFILES, "60E1.prr"), encoding="utf-8") as file:
        rows = np.array([[float(word) for word in line.split()[:2]] for line in file
                         if re.match(r"\s*[-0-9.]+\s+[-0-9.]+\s*$", line)])
    for side in ("right", "left"):
        with contact.WheelRail(side) as pair:
            braked_wheel(pair)
            pair.set_rail(rows[rows[:, 0] <= -1.0])
            result, messages = warned(pair.solve)
        same([patch.border for patch in result.patches], [("outer end of the rail profile",)], "end of the rail")
        same([text.split(" reaches")[0] for text in messages], ["contact patch 1"], "warning of the end of the rail")
    with contact.WheelRail() as pair:
        braked_wheel(pair)
        pair.set_rail(rows)
        pair.set_flags(ic_npomax=1000)
        result, messages = warned(pair.solve)
        same(result.patches[0].dx, 0.8, "elements are twice as large")
        text = "the elements of contact patch 1 have sides of 0.8 x 0.8 in place of 0.4 x 0.4, because there are at most "
        same(messages, [text + "ic_npomax = 1000"], "warning of larger elements")
        pair.set_flags(ic_npomax=20000)
        result, messages = warned(pair.solve)
        same((result.patches[0].dx, messages), (0.4, []), "elements of the prescribed size")


def braked_wheel(pair):
    """S1002 on 60E1"""
    pair.set_material(g=82000.0, nu=0.28)
    pair.set_friction(0.3)
    pair.set_grid(dx=0.4, ds=0.4)
    pair.set_track(gauge_height=14.0, gauge_width=1435.0, cant=0.025)
    pair.set_wheelset(flange_back=1360.0, flange_back_position=-70.0, radius=460.0)
    pair.set_wheel(os.path.join(PROFILES, "S1002.prw"))
    pair.set_position()
    pair.set_velocity(20000.0, pitch=-41.0)
    pair.set_vertical_force(60e3)


def temperatures():
    """By moving sources unless the established ones are requested by name; in any units"""
    highest = {}
    for units, length in (("mm", 1.0), ("si", 1e-3)):
        for source in (None, "moving", "established"):
            with contact.Problem(units=units) as problem:
                problem.set_material(g=82000.0 / length**2, nu=0.28)
                problem.set_friction(0.3)
                problem.set_hertz(30, 15, aa=6.0 * length, bb=6.0 * length)
                problem.set_normal_force(100e3)
                problem.set_creepages(0.05)
                problem.set_rolling(20000.0 * length)
                problem.set_temperatures(20.0, **({"source": source} if source else {}))
                result = problem.solve()
            same(result.temperatures.shape, (2, 15, 30), "shape of temperatures")
            highest[units, source] = result.temperatures.max() - 20.0
    close(highest["mm", "moving"], highest["mm", None], 1e-9, "moving sources are the default")
    check(1.1 < highest["mm", "established"] / highest["mm", "moving"] < 1.2, "the established ones are higher")
    close(highest["si", "moving"], highest["mm", "moving"], 1e-5, "temperatures in SI units")
    with contact.Problem() as problem:
        same(cntc.getflags(problem.number, 1, [cntc.CNTC["own_heat"]])[0], 1, "flag of an object")
        raises(ValueError, lambda: problem.set_temperatures(20.0, source="hot"), "none of", "an unknown source")
    with contact.WheelRail() as pair:
        braked_wheel(pair)
        pair.set_rail(os.path.join(PROFILES, "60E1.prr"))
        pair.set_temperatures(90.0, 15.0)
        patch = pair.solve().patches[0]
        check(patch.temperatures.max() > 90.0, "a braked wheel is warm")
        # a cold rail takes the wheel's heat: in contact no body has the temperature that it has outside
        pair.set_velocity(20000.0, pitch=-20000.0 / 460.0)
        pair.set_temperatures(15.0, 90.0)
        patch = pair.solve().patches[0]
        shown = cntc.getmaximumtemperature(pair.number, 1)
        for body in (0, 1):
            close(shown[body], patch.temperatures[body][patch.state > 0].max(), 1e-9, f"highest in contact, body {body + 1}")
            close(patch.totals()[f"max_temp{body + 1}"], shown[body], 1e-9, f"total of body {body + 1}")
        check(patch.temperatures[1].max() - shown[1] > 1.0, "outside the contact the wheel is warmer")
    number = 7
    cntc.initialize(number, 3)
    same(cntc.getflags(number, 1, [cntc.CNTC["own_heat"]])[0], 0, "the routines keep the established ones")
    cntc.finalize(number)


def estimated_errors():
    """Errors are part of results that request them, in the units of the caller, and not of others"""
    found = {}
    for units, length in (("mm", 1.0), ("si", 1e-3)):
        with contact.Problem(units=units) as problem:
            rolling_ball(problem, length)
            same(problem.solve().errors, None, "no errors unless requested")
            problem.set_errors()
            found[units] = problem.solve()
            problem.set_errors(False)
            same(problem.solve().errors, None, "no errors after the request is withdrawn")
    mm, si = found["mm"].errors, found["si"].errors
    check("fn" not in mm and "cksi" not in mm, "prescribed values have no error")
    same(sorted(mm), sorted(si), "totals with errors in both units")
    check(0.0 < mm["fx"] < 0.05 * found["mm"].fn * 0.3, "error of the force")
    close(si["fx"], mm["fx"], 1e-5, "forces in N in both")
    close(si["pen"], 1e-3 * mm["pen"], 1e-5, "approach in SI units")
    close(si["mz"], 1e-3 * mm["mz"], 1e-5, "moment in SI units")
    with contact.WheelRail() as pair:
        braked_wheel(pair)
        pair.set_rail(os.path.join(PROFILES, "60E1.prr"))
        pair.set_errors()
        patch = pair.solve().patches[0]
        check(0.0 < patch.errors["fx"] < 0.05 * patch.fn, "error of a patch of wheel and rail")


def rolling_ball(problem, length):
    """A ball that rolls with creepage"""
    problem.set_material(g=82000.0 / length**2, nu=0.28)
    problem.set_friction(0.3)
    problem.set_hertz(31, 31, aa=5.0 * length, bb=5.0 * length)
    problem.set_normal_force(50e3)
    problem.set_creepages(0.001)


def places():
    """Search path of the library without a setting: existing files, then names for the system"""
    from contact import _library
    chosen = os.environ.pop("CONTACT_LIBRARY")
    try:
        found = _library.candidates()
        with tempfile.TemporaryDirectory() as folder:
            # an installation: share/contact/python/contact beside bin
            python = os.path.join(folder, "share", "contact", "python")
            shutil.copytree(os.path.dirname(_library.__file__), os.path.join(python, "contact"))
            os.mkdir(os.path.join(folder, "bin"))
            name = os.path.join(os.path.realpath(folder), "bin", _library._names()[-1])
            with open(name, "w", encoding="utf-8"):
                pass
            run = subprocess.run([sys.executable, "-c", "from contact import _library; print(_library.candidates()[0])"],
                                 capture_output=True, text=True, cwd=folder,
                                 env={**os.environ, "PYTHONPATH": os.pathsep.join([python, *sys.path])})
            same(os.path.realpath(run.stdout.strip()), name, f"the library of an installation {run.stderr[-300:]}")
    finally:
        os.environ["CONTACT_LIBRARY"] = chosen
    for place in found:
        check(os.path.isfile(place) or os.sep not in place, f"{place} is a file, or a name")
    same(_library.candidates(), [chosen], "a chosen path is the only one")


def checked_only():
    """With R = 3 a wheel on a rail has no results, also after a solution; the next calculation has them again"""
    with contact.WheelRail("right") as pair:
        wheel(pair)
        for digit, patches in ((3, 0), (1, 1), (3, 0), (1, 1)):
            pair.set_flags(ic_return=digit)
            result = pair.solve()
            same(len(result.patches), patches, f"patches with R = {digit}")
            same(result.status, "solved" if digit == 1 else "checked", f"status with R = {digit}")
            same("only the input was checked" in result.reason, digit == 3, f"reason with R = {digit}")
    with contact.Problem() as problem:
        problem.set_material(g=82000.0, nu=0.28)
        problem.set_friction(0.3)
        problem.set_hertz(9, 9, aa=6.0, bb=6.0)
        problem.set_normal_force(80e3)
        for digit in (3, 1, 2, 0):
            same(last_error(problem.number, 1)[0], 0, "no error is left by the call before")
            problem.set_flags(ic_return=digit)
            same(problem.solve().status, "solved" if digit < 2 else "checked", f"status of two bodies with R = {digit}")


def no_points():
    """Columns outside the grid: a block without points has no results, and the next block has all"""
    with contact.Problem() as problem:
        problem.set_material(g=82000.0, nu=0.28)
        problem.set_friction(0.3)
        problem.set_hertz(9, 9, aa=6.0, bb=6.0)
        problem.set_normal_force(80e3)
        # ISUBS = 7: columns, rows and depths
        contact.cntc.subs_addblock(problem.number, 1, 1, 7, [210], [2], [0.5, 1.0])
        contact.cntc.subs_addblock(problem.number, 1, 2, 7, [5, 210], [2], [0.5, 1.0])
        problem.solve()
        for block, shape in ((1, (0, 0, 0)), (2, (2, 1, 1))):
            found = problem.stresses(block)
            same(found.von_mises.shape, shape, f"points of block {block}")
            same((len(found.z), len(found.y), len(found.x)), shape, f"coordinates of block {block}")
            same("no points" in repr(found), block == 1, "text of a block")


def output():
    """Files are written to the requested folder"""
    contact.output_to("results", "run")
    with contact.Problem() as problem:
        problem.set_flags(ic_output=2, ic_matfil=1, if_wrtinp=1)
        ball(problem)
        problem.set_temperatures(20.0)
        problem.solve()
    check(os.path.getsize("results/run.out") > 1000, "the .out file")
    check(any(name.endswith(".mat") for name in os.listdir("results")), "the .mat file")
    with open("results/run.inp", encoding="utf-8") as file:
        text = file.read()
    check("--heat moving-source" in text, "the input file has a remark on the temperatures with which it is to be run")
    check("% needs --order 2" in text, "the input file has a remark on the order with which it is to be run")
    contact.output_to("results", "roller")
    with contact.WheelRail("left", roller=True) as pair:
        wheel(pair)
        pair.set_flags(if_wrtinp=1)
        pair.set_track(gauge_height=14.0, gauge_width=1435.0, cant=0.025, roller_radius=500.0)
        pair.set_velocity(4.0, pitch=-2000.0 / 460.0)
        pair.solve()
        missing = "the roller has CANT = 0.025 rad"
        check(missing in last_error(pair.number, -1)[1], "a warning of a cant that is not written")
    with open("results/roller.inp", encoding="utf-8") as file:
        check(f"not in this file: {missing}" in file.read(), "a remark on the cant of a roller, which is not written")


if __name__ == "__main__":
    for part in (results, distance, arrays, dissimilar_bodies, prescribed_and_transient, errors, many, threads, wheel_on_rail,
                 curve_and_tape,
                 profiles, thin_sheet, older_scripts, documents, doubts, temperatures, estimated_errors, places, checked_only,
                 no_points, output):
        part()
    finish()
