#!/usr/bin/env python3
"""Results of the Python package for display: printed, plotted, as data sets of xarray, loaded from three kinds of files.

Usage: results_shown.py PROGRAM
"""
import json
import importlib
import os
import re
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "conformance"))
from checks import SOURCE, check, close, finish, same
import contact
import numpy as np
import python_intfc
from contact import _signatures, cntc
from contact._view import meaning_of


def has(module):
    """Is an optional module installed?"""
    try:
        importlib.import_module(module)
    except ImportError:
        print(f"{module} is not installed; tests that need it are skipped")
        return False
    return True


def raises(kind, call, word):
    """Check that a call raises an error whose text has a word"""
    try:
        call()
    except kind as error:
        check(word in str(error), f"'{word}' is in '{error}'")
    else:
        check(False, f"no {kind.__name__} with '{word}'")


def solved(units="mm", motion="steady"):
    """A ball on a plane, and stresses below it"""
    metre, newton = (1.0, 1.0) if units == "mm" else (1e-3, 1e6)
    with contact.Problem(motion=motion, units=units) as problem:
        problem.set_material(g=82000.0 * newton, nu=0.28)
        problem.set_friction(0.3)
        problem.set_hertz(21, 15, aa=5.0 * metre, bb=4.0 * metre)
        problem.set_normal_force(50e3)
        if motion != "frictionless":
            problem.set_creepages(0.001 if motion != "shift" else 0.005 * metre, 0.0005 if motion != "shift" else 0.0)
        problem.add_block([0.0, metre], [0.0], np.array([1.0, 2.0, 3.0]) * metre)
        return problem.solve(), problem.stresses()


def wear_shown():
    """Totals of wear that a case does not have are not printed as 0"""
    with contact.Problem() as problem:
        problem.set_hertz(15, 15, a1=1 / 80, b1=1 / 80)
        problem.set_material(g=82000.0, nu=0.28)
        problem.set_friction(0.3)
        problem.set_normal_force(5e3)
        problem.set_creepages(0.002)
        problem.set_wear()
        bare = problem.solve()
        problem.set_wear(1e-4, 3000.0, 300.0)
        problem.add_block([0.0], [0.0], [0.5, 1.0])
        full = problem.solve()
    requested = {"max_wear", "worn_section", "shakedown_load", "shakedown", "fatigue_index", "max_mises", "max_tresca"}
    same(requested & set(bare.totals()), set(), "without coefficients and points")
    check({"t_gamma", "traction"} <= set(bare.totals()) and requested <= set(full.totals()), "with them")
    check("max_mises" not in str(bare) and "max_mises" in str(full), "printed")
    # a ball of radius 40 mm on a plane, by Hertz: a1 = 1/(2 R)
    close(full.max_pressure, (6.0 * 5e3 * (82000.0 / 0.72)**2 / (np.pi**3 * 40.0**2))**(1 / 3), 15.0, "a1 of a ball")


def wheel(track=None, force=None, pitch=-2000.0 / 460.0):
    """A wheel on a rail; track replaces how the track is given, a longitudinal force the rate of pitch"""
    with contact.WheelRail() as pair:
        pair.set_material(g=82000.0, nu=0.28)
        pair.set_friction(0.3)
        pair.set_grid(dx=0.4, ds=0.4)
        pair.set_track(gauge_height=14.0, gauge_width=1435.0, cant=0.025)
        pair.set_wheelset(flange_back=1360.0, flange_back_position=-70.0, radius=460.0)
        pair.set_rail(os.path.join(SOURCE, "examples/profiles/60E1.prr"))
        pair.set_wheel(os.path.join(SOURCE, "examples/profiles/S1002.prw"))
        if track:
            track(pair.number)
        pair.set_position(y=2.0, yaw=0.0048)
        pair.set_velocity(2000.0, pitch=pitch)
        pair.set_vertical_force(10e3)
        if force is not None:
            pair.set_longitudinal_force(force)
        return pair.solve()


def printed(result, stresses, pair):
    """A summary, not arrays"""
    for item in (result, stresses, pair, pair.patches[0]):
        text = repr(item)
        check(len(text) < 300 and "array" not in text and "\n" not in text, f"one line: {text}")
    text = str(result)
    check("21 x 15 elements" in text and "solved" in text.split("\n")[0], f"the first line of {text}")
    row = next(line.split() for line in text.split("\n") if line.split()[0] == "fx")
    close(float(row[1]), result.fx, 1e-4 * result.fn, "the printed force")
    same(row[2], "N", "and its unit")
    same(len(str(pair).split("\n")), 1 + len(pair.totals()) + len(pair.patches), "lines of a wheel on a rail")
    same(pair.border_elements, 0, "elements at the border")
    close(pair.totals()["fz_tr"], 10e3, 1.0, "vertical force")


def descriptions_and_units():
    """Units and descriptions of all names, in the units of the problem"""
    for name in [*_signatures.FIELDS, *_signatures.TOTALS, "eldiv", "pt"]:
        check(meaning_of(name)[1] not in ("", name) or name == "rotation", f"{name} has a description")
    same(meaning_of("pn", "si")[0], "N/m2", "pressure in SI units")
    same(meaning_of("sx", "si", True)[0], "mm", "slip distances are in mm in all units")
    check("body 2" in meaning_of("fx", "simpack")[1], "Simpack's sign")
    shift = solved(motion="shift")[0]
    check("shift_x" in shift.totals() and "cksi" not in shift.totals(), "a shift is not a creepage")
    same(shift.meaning("sx"), ("mm", "longitudinal slip distance"), "slip of a shift")
    with contact.Problem() as problem:
        problem.set_flags(ic_tang=1, if_units=cntc.CNTC["un_si"])
        same((problem.motion, problem.units), ("shift", "si"), "motion and units by their flags")
    plain = solved(motion="frictionless")[0]
    check("px" not in plain.fields() and "pn" in plain.fields(), "fields without friction")


def in_si(unit):
    """Factor from a unit of mm, or of m, to that of m"""
    number = 1.0
    for part, sign in zip(unit.split("/"), (1, -1)):
        for power in re.findall(r"mm(\d?)", part):
            number *= 1e-3 ** (sign * int(power or 1))
    return number


def everything_solved(units, motion):
    """A ball on a plane with temperatures, wear, stresses and estimated errors, where its motion has them"""
    metre, newton = (1.0, 1.0) if units == "mm" else (1e-3, 1e6)
    with contact.Problem(motion=motion, units=units) as problem:
        problem.set_material(g=82000.0 * newton, nu=0.28)
        problem.set_friction(0.3)
        problem.set_hertz(21, 15, aa=5.0 * metre, bb=4.0 * metre)
        problem.set_normal_force(50e3)
        problem.set_creepages(*((0.005 * metre, 0.002 * metre) if motion == "shift" else (0.001, 0.0005, 1e-4 / metre)))
        problem.set_wear(1e-4, 3000.0 * newton, 300.0 * newton)
        problem.set_errors()
        problem.add_block([0.0, metre], [0.0], np.array([1.0, 2.0, 3.0]) * metre)
        if motion == "steady":
            problem.set_rolling(10e3 * metre)
            problem.set_temperatures(20.0)
        return problem.solve()


def units_of_values():
    """All totals, their errors and all fields have the stated unit, in all systems of units"""
    for motion in ("steady", "shift"):
        plain = everything_solved("mm", motion)
        for units in ("si", "simpack"):
            other = everything_solved(units, motion)
            for kind in ("totals", "errors", "fields"):
                first, second = ((item.errors if kind == "errors" else getattr(item, kind)()) for item in (plain, other))
                same(set(first), set(second), f"names of {kind} in {units}")
                for name in first:
                    value, found = (np.abs(np.asarray(one[name], float)) * in_si(item.meaning(name)[0])
                                    for one, item in ((first, plain), (second, other)))
                    # errors of almost exact values are round-off, as displacements of symmetric contacts
                    tolerance = (1e-3 if kind == "errors" else 1e-6) * np.max(value) + 1e-300
                    close(found, value, tolerance, f"{name} of a {motion} in {units}")


def drawn(result, stresses, pair):
    """Plots show the values at their positions"""
    raises(ValueError, lambda: result.plot("nothing"), "there are eldiv, h")
    if not has("matplotlib"):
        raises(ImportError, result.plot, "pip install matplotlib")
        return
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    axes = result.plot()
    mesh = axes.collections[0]
    shown = np.ma.asarray(mesh.get_array()).reshape(15, 21)
    close(shown.filled(0.0), result.pn, 0.0, "the drawn pressure")
    same(bool(np.array_equal(shown.mask, result.state == 0)), True, "values outside are not drawn")
    close(mesh.get_coordinates()[0, 0], [result.x[0] - result.dx / 2, result.y[0] - result.dy / 2], 1e-12, "the corner")
    same(axes.get_aspect(), 1.0, "to scale")
    check("[mm]" in axes.get_xlabel(), "unit of the axis")
    check(any("N/mm2" in other.get_ylabel() for other in axes.figure.axes), "unit of the colours")
    for field in ("pt", "eldiv", "h", "sx"):
        result.plot(field).figure.savefig(f"{field}.png")
        check(os.path.getsize(f"{field}.png") > 3000, f"a picture of {field}")
    same(len(pair.plot("pt")), len(pair.patches), "a picture for each patch")
    axes = stresses.plot("sigzz", shading="nearest")
    close(np.asarray(axes.collections[0].get_array()).reshape(3, 2), stresses.tensor[2, 2, :, 0, :], 0.0, "drawn stresses")
    check(axes.yaxis_inverted(), "depth points downwards")
    pyplot.close("all")
    # a missing package is reported in a sentence
    hidden = {name: sys.modules.pop(name) for name in list(sys.modules) if name.partition(".")[0] == "matplotlib"}
    sys.modules["matplotlib"] = None
    try:
        raises(ImportError, result.plot, "pip install matplotlib")
    finally:
        del sys.modules["matplotlib"]
        sys.modules.update(hidden)


def data_sets(result, stresses, pair):
    """xarray has the fields with their coordinates, units and flags"""
    if not has("xarray"):
        raises(ImportError, result.to_xarray, "pip install xarray")
        return
    import xarray
    data = result.to_xarray()
    same(dict(data.sizes), {"x": 21, "y": 15}, "sizes")
    close(data.pn.values, result.pn, 0.0, "pressure")
    close(float(data.pn.sum() * result.dx * result.dy), result.fn, 1e-6 * result.fn, "its sum")
    close(float(data.fx), result.fx, 0.0, "a total")
    same(data.eldiv.attrs["flag_meanings"], "exterior adhesion slip plastic", "states")
    same(data.eldiv.attrs["flag_values"].tolist(), [0, 1, 2, 3], "their numbers")
    for name, item in data.variables.items():
        check("long_name" in item.attrs and ("units" in item.attrs) != ("flag_values" in item.attrs), f"attributes of {name}")
    below = stresses.to_xarray()
    close(below.sigxy.values, stresses.tensor[0, 1], 0.0, "shear stress")
    same(below.sigvm.dims, ("z", "y", "x"), "its dimensions")
    if hasattr(xarray, "DataTree"):
        tree = pair.to_xarray()
        close(float(tree["patch_1/fn"]), pair.patches[0].fn, 0.0, "a patch in the tree")
        close(float(tree["fz_tr"]), 10e3, 1.0, "total force in the tree")


def displaced_without_motion():
    """Pressures displace the surfaces of dissimilar bodies laterally; those of like bodies have no such fields"""
    for stiffness, names in ((82000.0, set()), (2000.0, {"ux", "uy"})):
        with contact.Problem(motion="frictionless") as problem:
            problem.set_material(g=82000.0, nu=0.28, g2=stiffness, nu2=0.28)
            problem.set_friction(0.3)
            problem.set_hertz(11, 11, aa=4.0, bb=3.0)
            problem.set_normal_force(9000.0)
            result = problem.solve()
        same(set(result.fields()) & {"px", "py", "ux", "uy", "sx", "sy"}, names, f"fields without motion, {stiffness} N/mm2")


def loaded(program):
    """The three kinds of files contain the same values, up to their figures"""
    for name in ("cattaneo", "manchester"):
        with open(os.path.join(SOURCE, "examples", name + ".inp"), encoding="utf-8") as file:
            text = file.read()
        with open(name + ".inp", "w", encoding="utf-8") as file:
            file.write(text)
        shutil.copytree(os.path.join(SOURCE, "examples/profiles"), "profiles", dirs_exist_ok=True)
        subprocess.run([program, "--hdf5", "2", name], check=True, stdout=subprocess.DEVNULL)
        table, matrix = contact.load(name + ".out"), contact.load(name + ".mat")
        check(f"{len(table)} case{'s' if len(table) > 1 else ''}, " in repr(table), f"how many cases: {table!r}")
        for other in (matrix, table):
            check("solved" in repr(other), f"the status of {other!r}")
        same((len(table), table.complete), (2, True), "cases of the .out file")
        close(table[1].patch.pmax, float(matrix.case(2).patch.pn.max()), 1e-3 * table[1].patch.pmax, ".out and .mat")
        close(table.case(2).patch.fn, matrix.case(2).patch.fn, 1e-3 * table[1].patch.fn, "forces of .out and .mat")
        if has("h5py"):
            whole = contact.load(name + ".h5")
            same((len(whole), whole.complete), (2, True), "cases of the HDF5 file")
            for field in ("pn", "px", "un", "h"):
                inside = whole.case(2).patch.eldiv > 0
                close(matrix.case(2).patch.fields()[field][inside], whole[1].patch.fields()[field][inside],
                      1e-5 * abs(whole[1].patch.fields()[field]).max(), f"{field} of both")
            for total, value in table[0].patch.totals().items():
                close(whole[0].patch.totals().get(total, value), value, 1e-3 * max(abs(value), 0.05), f"{total} in .out and HDF5")
            for total, value in table[0].totals.items():
                close(whole[0].totals[total], value, 1e-3 * max(abs(value), 0.1), f"{total} of the case in .out and HDF5")
            same(whole[0].patch.state.shape, whole[0].patch.pn.shape, "names of solved patches")
            close(whole.table()["fn"], [case.patch.fn for case in whole], 0.0, "a column")
            same(contact.load(name + ".h5")[0].inputs["digits"]["t"], whole[0].inputs["digits"]["t"], "the requested motion")
            if has("xarray"):
                same(whole.to_xarray().fn.attrs["units"], "N", "columns as a data set")
    same(matrix[0].patch.number, 1, "the patch of a wheel")
    raises(AttributeError, lambda: matrix[0].patch.nothing, "it has fn")
    raises(FileNotFoundError, lambda: contact.load("absent.h5"), "absent")
    raises(FileNotFoundError, lambda: contact.load("absent.mat"), "absent.0001.mat")
    raises(contact.ContactError, lambda: contact.load("cattaneo.inp"), "none of")
    with open("manchester.0001a.mat", encoding="utf-8") as file:
        text = file.read()
    for place, piece in (("cut.0001a.mat", text[:2000]), ("no.out", "nothing\n\n"), ("no.h5", "nothing")):
        with open(place, "w", encoding="utf-8") as file:
            file.write(piece)
        raises((contact.ContactError, ImportError), lambda: contact.load(place), "")  # noqa: B023
    raises(KeyError, lambda: matrix.case(77), "77")


def places_of_wheels(program):
    """Moments and places of elements mean the same in all three kinds of files: in steps, on both sides, in conformal contact"""
    if not has("h5py"):
        return
    for example, left, count in (("single_wheel", False, 2), ("single_wheel", True, 2), ("conformal_wheel", False, 3)):
        with open(os.path.join(SOURCE, "examples", example + ".inp"), encoding="utf-8") as file:
            text = " 1 MODULE".join(file.read().split(" 1 MODULE")[:count + 1]) + " 0 MODULE\n"
        text = text.replace("0001201 ", "0002201 ")
        name = f"{example}_{left}"
        with open(name + ".inp", "w", encoding="utf-8") as file:
            file.write(re.sub("(?m)^ 1(20[0-9]{4} +C-P-B)", r" 0\1", text) if left else text)
        shutil.copytree(os.path.join(SOURCE, "examples/profiles"), "profiles", dirs_exist_ok=True)
        subprocess.run([program, "--hdf5", "2", name], check=True, stdout=subprocess.DEVNULL)
        printed, whole = contact.load(name + ".out"), contact.load(name + ".h5")
        moments = {key for case in printed for key in ("mz", "mz_elem", "bar_mn") if key in case.patch.totals()}
        same(moments, {"mz_elem"} if example == "single_wheel" else {"mz", "bar_mn"}, f"moments of {example}")
        for case, stored in zip(printed, whole):
            for total, value in case.patch.totals().items():
                close(stored.patch.totals()[total], value, 1e-3 * max(abs(value), 0.05), f"{total} of {example} {case.number}")
        if example == "single_wheel":
            for matrix in contact.load(name + ".mat"):
                for axis in ("x", "y"):
                    close(getattr(matrix.patch, axis), getattr(whole.case(matrix.number).patch, axis), 1e-5, f"{axis} of elements")


def forces_not_reached(program):
    """Relative forces of the .out file are those found, also where the input prescribes others that cannot be reached"""
    case = """3 MODULE
 203110
 0022020 0
 0002201
 200 100 30 1 1e-6
 1000 {fx} 0 {spin}
 0.3 0.3
 0 1 1
 0.28 0.28 82000 82000
 -3
 16 16 2 2 1.2
"""
    with open("missed.inp", "w", encoding="utf-8") as file:
        file.write(case.format(fx=0.5, spin=0) + case.format(fx=0.999999, spin=3) + "0\n")
    subprocess.run([program, "--json", "2", "missed"], check=True, stdout=subprocess.DEVNULL)
    with open("missed.jsonl", encoding="utf-8") as file:
        stored = [json.loads(line) for line in file][:2]
    same([item["status"] for item in stored], ["solved", "not converged"], "the second force is beyond friction")
    for case, item in zip(contact.load("missed.out"), stored):
        totals, right = case.patch.totals(), item["patches"][0]["totals"]
        for name in {"fx", "fy", "fx_rel", "fy_rel"} & set(totals):
            close(totals[name], right[name]["value"], 1e-3 * abs(right[name]["value"]) + 1e-5, f"{name} of case {case.number}")
        same("fx_rel" in totals, case.status == "solved", "a prescribed force that was reached")


def problems_of_elements(program):
    """Result elements and contact problems have files of their own, and cases that can be told apart"""
    with open(os.path.join(SOURCE, "examples/cattaneo.inp"), encoding="utf-8") as file:
        case = file.read().partition("MODULE\n")[2].partition("%")[0].replace("0000331", "0002231")
    with open("elements.inp", "w", encoding="utf-8") as file:
        file.writelines(f" 3 {place} MODULE\n" + case.replace("9.1954", force)
                        for place, force in (("1 1", "9.0"), ("1 2", "7.0"), ("2 1", "5.0")))
        file.write(" 0 MODULE\n")
    subprocess.run([program, "--hdf5", "--vtk", "2", "elements"], check=True, stdout=subprocess.DEVNULL)
    for name, force in (("re001", 9.0), ("re001_cp2", 7.0), ("re002", 5.0)):
        close(contact.load(f"elements_{name}.mat")[0].patch.fn, force, 1e-4, f"the .mat file of {name}")
        check(os.path.isfile(f"elements_{name}.0001.vts"), f"the VTK file of {name}")
    printed = contact.load("elements.out")
    close(printed.case(1, 2).patch.fn, 5.0, 1e-3, "a result element of the .out file")
    raises(KeyError, lambda: printed.case(1), "several cases 1: Case 1, result element 1, ")
    if has("h5py"):
        whole = contact.load("elements.h5")
        close([whole.case(1, *place).patch.fn for place in ((1, 1), (1, 2), (2,))], [9.0, 7.0, 5.0], 1e-4, "places of cases")
        table = whole.table()
        same((table["result_element"].tolist(), table["contact_problem"].tolist()), ([1, 1, 2], [1, 2, 1]), "columns of places")
        raises(KeyError, lambda: whole.case(1), "contact problem 2")


def cases_without_result(program):
    """A case whose input cannot be used, and one in which a file ends, are not solved in an .out file either"""
    with open(os.path.join(SOURCE, "examples/cattaneo.inp"), encoding="utf-8") as file:
        case = " 3 MODULE\n" + file.read().partition("MODULE\n")[2].partition("%")[0]
    with open("faulty.inp", "w", encoding="utf-8") as file:
        file.write(case + case.replace("9.1954", "-1") + case.replace("9.1954", "nan") + " 0 MODULE\n")
    run = subprocess.run([program, "--hdf5", "2", "faulty"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    same(run.returncode, 1, "exit status of a run with a faulty case")
    printed = contact.load("faulty.out")
    same([each.status for each in printed], ["solved", "refused"], "statuses of the .out file")
    check(printed[1].reason.startswith("its input cannot be used: faulty.inp:"), printed[1].reason)
    if has("h5py"):
        same([(each.status, each.reason) for each in contact.load("faulty.h5")], [(each.status, each.reason) for each in printed],
             "statuses of both files")
    with open("faulty.out", encoding="utf-8") as file:
        text = file.read()
    with open("cut.out", "w", encoding="utf-8") as file:
        file.write(text[:text.index(" Case     2") + 15])
    same([each.status for each in contact.load("cut.out")], ["solved", ""], "statuses of a file that ends in a case")


def layer():
    """The older name for layers keeps the elastic constants"""
    with contact.Problem(motion="shift") as problem:
        number = problem.number
        raises(ValueError, lambda: cntc.setinterfaciallayer(number, 1, 4, [8200.0, 0.02, 50.0, 10.0]), "elastic constants first")
        cntc.setmaterialproperties(number, 1, 82000.0, 0.28, 81000.0, 0.27)
        for more in ((), (4,)):
            cntc.setinterfaciallayer(number, 1, 4, *more, [8200.0, 0.02, 50.0, 10.0])
            same(cntc.getflags(number, 1, cntc.CNTC["ic_mater"]).tolist(), [4], "material with a layer")
        found = cntc.getparameters(number, 1, 2)
        same([found[name] for name in ("gg1", "gg2", "poiss1", "poiss2", "gg3", "laythk", "tau_c0", "k_tau")],
             [82000.0, 81000.0, 0.28, 0.27, 8200.0, 0.02, 50.0, 10.0], "all constants")
        cntc.setinterfaciallayer(number, 1, 0)
        same(cntc.getflags(number, 1, cntc.CNTC["ic_mater"]).tolist(), [0], "material without it")
        raises(ValueError, lambda: cntc.setinterfaciallayer(number, 1, 4, [1.0]), "4 with 4")


def track(expected):
    """Older routines for the track, which published scripts still call, and the library itself"""
    by_old = wheel(lambda number: python_intfc.settrackdimensions_old(number, 3, [1435.0, 14.0, 0.025, 0.0] + 6 * [0.0]))
    same(by_old.forces.track.force.tolist(), expected.forces.track.force.tolist(), "gauge width and height in the older order")
    by_new = wheel(lambda number: python_intfc.cntc_settrackdimensions_new(number, 1, [14.0, 0.0, 1435.0, 0.02, 0.0]))
    check(abs(by_new.forces.track.force[1] - expected.forces.track.force[1]) > 1.0, "another cant by the older name")
    raises(ValueError, lambda: python_intfc.settrackdimensions_old(1, 1, [1435.0]), "1 with 4")
    check(python_intfc.cntc_dll.cntc_initialize is not None, "the library as ctypes has it")
    raises(AttributeError, lambda: python_intfc.cntc_nothing, "cntc_nothing")


def rates_of_pitch():
    """A longitudinal force instead of the rate: the same contact with the computed rate, signs, and the state of a free wheel"""
    braked, free, driven = (wheel(force=force) for force in (1000.0, 0.0, -1000.0))
    for result, force in ((braked, 1000.0), (free, 0.0), (driven, -1000.0)):
        close(result.forces.wheelset.force[0], force, 1e-4 * 10e3, "the prescribed force")
    rates = [-result.wheelset_velocity[5] for result in (braked, free, driven)]
    again = wheel(pitch=-rates[0])
    close(again.forces.track.force, braked.forces.track.force, 1.0, "the same by the rate")
    check(rates[0] < rates[1] < rates[2], f"a braked wheel turns slower, a driven one faster: {rates}")
    close(rates[1], 2000.0 / 460.5, 0.01 * rates[1], "a free wheel rolls without slip")


if __name__ == "__main__":
    wear_shown()
    everything = (*solved(), wheel())
    printed(*everything)
    descriptions_and_units()
    units_of_values()
    drawn(*everything)
    data_sets(*everything)
    displaced_without_motion()
    loaded(sys.argv[1])
    places_of_wheels(sys.argv[1])
    forces_not_reached(sys.argv[1])
    problems_of_elements(sys.argv[1])
    cases_without_result(sys.argv[1])
    layer()
    track(everything[-1])
    rates_of_pitch()
    finish()
