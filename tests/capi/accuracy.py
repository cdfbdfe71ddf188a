#!/usr/bin/env python3
"""A prescribed accuracy in the library: the flags, the grid of the result, accuracies not reached, refused cases"""
import os
import sys
import warnings

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "conformance"))
from checks import check, close, finish, same
import contact
from contact import cntc
from contact.cntc import CNTC


def ellipse(accuracy, n=12, order=2):
    """An ellipse that rolls with spin"""
    problem = contact.Problem()
    problem.set_material(g=82000.0, nu=0.28)
    problem.set_friction(0.3)
    problem.set_hertz(n, n, aa=3.0, bb=5.0, scale=1.2)
    problem.set_normal_force(30e3)
    problem.set_creepages(5e-4, 2e-4, 3e-4)
    problem.set_rolling(30e3)
    problem.set_solver(order=order, accuracy=accuracy)
    return problem


def reached():
    """The result is on a chosen grid, with errors; the next solution without an accuracy has the grid of the caller"""
    with ellipse(0.0, 150) as problem:
        fine = problem.solve()
    check(fine.errors is None, "no errors unless requested")
    with ellipse(1e-3) as problem:
        result = problem.solve()
        check(result.pn.shape[0] > 12, f"{result.pn.shape} elements")
        close(result.fx / (0.3 * 30e3), fine.fx / (0.3 * 30e3), 1e-3, "FX")
        close(result.fy / (0.3 * 30e3), fine.fy / (0.3 * 30e3), 1e-3, "FY")
        check(result.errors["fx"] <= 1e-3 * 0.3 * 30e3, "estimated error of FX")
        number = problem.number
        same([int(v) for v in cntc.getflags(number, 1, [CNTC["own_accuracy"], CNTC["own_reached"]])], [1000, 1], "flags")
        again = problem.solve()
        same(again.fx, result.fx, "the same once more")
        problem.set_solver(accuracy=0.0)
        plain = problem.solve()
        same(plain.pn.shape, (12, 12), "grid of the caller")
        same(int(cntc.getflags(number, 1, [CNTC["own_reached"]])[0]), 0, "no accuracy was required")


def allowed():
    """A simplified method if allowed, without estimates of its own; otherwise none"""
    with ellipse(0.0, 60) as problem:
        problem.set_creepages(5e-4, 2e-4, 0.0)
        fine = problem.solve()
    for allow, words in (("approximate", (20, 20)), ("nothing", None)):
        with ellipse(0.0) as problem:
            problem.set_creepages(5e-4, 2e-4, 0.0)
            problem.set_solver(accuracy=0.06, allow=allow)
            same(int(cntc.getflags(problem.number, 1, [CNTC["own_approximate"]])[0]), int(allow == "approximate"), "permission")
            result = problem.solve()
            close(result.fx / (0.3 * 30e3), fine.fx / (0.3 * 30e3), 0.06, "FX, " + allow)
            check((result.pn.shape == (20, 20)) == bool(words), f"{allow}: {result.pn.shape} elements")
            check(bool(result.errors) != bool(words), f"{allow}: errors {result.errors}")
            same(int(cntc.getflags(problem.number, 1, [CNTC["own_reached"]])[0]), 1, "reached")
    with contact.Problem() as problem:
        try:
            problem.set_solver(accuracy=0.06, allow="all")
        except ValueError as error:
            check("allow" in str(error), "another word")
        else:
            check(False, "another word is refused")


def missed():
    """An invalid value, a case that is not possible, and an accuracy that cannot be reached"""
    for value in (0.5, -1e-3, 1e-7, float("nan")):
        try:
            ellipse(value).close()
        except ValueError as error:
            check("accuracy" in str(error), f"accuracy {value}")
        else:
            check(False, f"accuracy {value} is refused")
    with contact.Problem() as problem:
        try:
            problem.set_flags(own_accuracy=5)
        except contact.ContactError as error:
            check("10 to 1000000 are accepted" in str(error), f"one part in 5: {error}")
        same(int(cntc.getflags(problem.number, 1, [CNTC["own_accuracy"]])[0]), 0, "one part in 5 is not stored")
        problem.set_material(g=82000.0, nu=0.28)
        problem.set_friction(0.3)
        problem.set_grid(20, 20, 0.4, 0.6)
        problem.set_distance(lambda x, y: 0.005 * x**2 + 0.002 * y**2)
        problem.set_normal_force(30e3)
        problem.set_rolling(30e3, 0.4)
        problem.set_solver(accuracy=1e-3)
        try:
            problem.solve()
        except contact.ContactError as error:
            check("element by element" in str(error), f"refusal: {error}")
        else:
            check(False, "distances of elements are refused")
    with ellipse(1e-2) as problem, warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        problem.set_creepages(5e-4)
        problem.solve()
        same([str(w.message) for w in caught], [], "no warning where it is reached")


reached()
allowed()
missed()
finish()
