#!/usr/bin/env python3
"""The order of the settings before a calculation does not matter, nor do units that change between them; values whose meaning has
changed are not used silently.

usage: call_order.py contact | pair | kept | results
"""
import random
import sys

import numpy as np
from checks import check, close, finish, profiles, same
from contact import cntc
from contact._library import last_error
from contact.cntc import CNTC

ORDERS = 6
#: Length of the unit of the caller in mm, inverse
UNITS = {"un_cntc": 1.0, "un_si": 1e-3, "un_spck": 1e-3}


def flag(icp, name, value):
    return lambda: cntc.setflags(1, icp, CNTC[name], value)


def start(module, units):
    same(cntc.initialize(1, module)[1], 0, "initialize")
    cntc.setflags(1, 1 if module == 3 else -1, CNTC["if_units"], CNTC[units])


def make(module, units, settings, order):
    """Make all settings, in order 0 as listed, otherwise at random; with units that change between them if `units` is "any"

    Returns the units after them.
    """
    dice = random.Random(order)
    names = ("un_cntc", "un_si" if module == 3 else "un_spck")
    lists = {name: settings(name) for name in names}
    numbers = list(range(len(lists[names[0]])))
    if order > 0:
        dice.shuffle(numbers)
    now = names[0] if units == "any" else units
    start(module, now)
    for number in numbers:
        if units == "any":
            now = dice.choice(names)
            cntc.setflags(1, 1 if module == 3 else -1, CNTC["if_units"], CNTC[now])
        lists[now][number]()
    return now


def contact_settings(big, motion):
    """Settings of a ball that rolls or is shifted, with an extra rigid slip, in units of mm/big"""
    size, area = (big if motion == 1 else 1.0), big**2

    def window():
        cntc.setpotcontact(1, 1, 1, [9, 7, -3.6*big, -2.8*big, 0.8*big, 0.8*big])
        cntc.setundeformeddistc(1, 1, 1, [0.001/big, 0.0002/big, 0.0015/big, 1e-4, 0.0, 0.0])
        cntc.setextrarigidslip(1, 1, np.full(63, 1e-4), np.zeros(63))

    return [flag(1, "ic_tang", motion), flag(1, "ic_sens", 3), flag(1, "ic_force", 1), window,
            lambda: cntc.setmaterialparameters(1, 1, 0, [0.28, 0.3, 82e3/area, 70e3/area]),
            lambda: cntc.setfrictionmethod(1, 1, 2, [0.2, 0.1, 5*big, 0.05, 50*big, 0.1*big, 5*big]),
            lambda: cntc.setsolverflags(1, 1, 0, [999, 100, 30, 20], [1e-8]),
            lambda: cntc.setreferencevelocity(1, 1, 2000*big), lambda: cntc.setrollingstepsize(1, 1, 0.0, 0.8*big),
            lambda: cntc.setnormalforce(1, 1, 900.0), lambda: cntc.settangentialforces(1, 1, 0.4, 0.0),
            lambda: cntc.setcreepages(1, 1, 0.001*size, -0.0015*size, 2e-4/(1.0 if motion == 1 else big))]


def contact_results(big, motion):
    """Forces, creepages and approach in mm"""
    size = big if motion == 1 else 1.0
    fn, fx, fy, mz = cntc.getcontactforces(1, 1)
    cksi, ceta, cphi = cntc.getcreepages(1, 1)
    spin = cphi*(1.0 if motion == 1 else big)
    return np.array([fn, fx, fy, mz/big, 1e6*cksi/size, 1e6*ceta/size, 1e6*spin, 1e6*cntc.getpenetration(1, 1)/big])


def contact():
    """Contact problems: in shifts creepages are lengths, which matters in m"""
    for motion in (1, 2, 3):
        expected = None
        for units in ("un_cntc", "un_si", "any"):
            for order in range(ORDERS):
                units_now = make(3, units, lambda name: contact_settings(UNITS[name], motion), order)  # noqa: B023
                same(cntc.calculate(1, 1), 0, f"T = {motion}, {units}, order {order}: {last_error(1, 1)[1]}")
                got = contact_results(UNITS[units_now], motion)
                expected = got if expected is None else expected
                close(got, expected, 1e-5*np.abs(expected).max(), f"T = {motion}, {units}, order {order}")
                cntc.finalize(1)


def pair_settings(big, roller, left):
    """Settings of a wheel on a rail or a roller, in units of mm/big"""
    rail, wheel = profiles()
    speed = -4.0 if roller else 2000*big
    track = [14*big, 0, 1435*big, 0.0, 500*big if roller else 0.0, 0.1*big, 0.1*big, 1e-3, big, 2*big, 0.01]
    flexible = [0.1*big, 0.2*big, 0.05*big, 1e-3, 1e-3, 1e-3, 5*big, 5*big, big, 0.01, 0.01, 0.01]
    return [flag(-1, "ic_config", (4 if roller else 0) + (0 if left else 1)), flag(-1, "ic_tang", 3), flag(-1, "ic_discns", 2),
            lambda: cntc.setsolverflags(1, -1, 0, [999, 100, 30, 1], [1e-6]),
            lambda: cntc.setmaterialparameters(1, -1, 0, [0.28, 0.28, 82e3/big**2, 82e3/big**2]),
            lambda: cntc.setfrictionmethod(1, -1, 0, [0.3, 0.3]),
            lambda: cntc.setpotcontact(1, -1, -1, [big, big, 1.5, 8*big, 4*big]),
            lambda: cntc.settrackdimensions(1, 3, track), lambda: cntc.setprofileinputfname(1, rail, [0], [1.0, 0.0]),
            lambda: cntc.setprofileinputfname(1, wheel, [1], [1.0, 0.0]),
            lambda: cntc.setwheelsetdimensions(1, 5, np.array([1360.0, -70.0, 460.0])*big),
            lambda: cntc.setwheelsetposition(1, 5, [0, 2*big, 0, -1e-4, 0.005, 0.1]),
            lambda: cntc.setwheelsetvelocity(1, 5, [speed, 3*big, 0, 0.01, 0.01, -4.345]),
            lambda: cntc.setwheelsetflexibility(1, 5, flexible), lambda: cntc.setverticalforce(1, 60000.0)]


def pair():
    """Wheel on rail and roller: the first velocity is a speed or a rate, whether the configuration is given before or after it"""
    for roller, left in ((False, False), (False, True), (True, False), (True, True)):
        expected = None
        for order in range(ORDERS):
            units = make(1, ("un_cntc", "un_spck", "any")[order % 3], lambda name: pair_settings(UNITS[name], roller, left),  # noqa: B023
                         order)
            what = f"{'roller' if roller else 'track'} {'left' if left else 'right'}, order {order}"
            same(cntc.calculate(1, -1), 0, f"{what}: {last_error(1, -1)[1]}")
            got = cntc.getglobalforces(1, -1)[:3]*(-1.0 if units == "un_spck" else 1.0)
            expected = got if expected is None else expected
            close(got, expected, 1e-3, what)
            cntc.finalize(1)


def message(icp):
    """Code of a calculation and the message about it"""
    cntc.setflags(1, icp, CNTC["ic_pvtime"], 2)
    code = cntc.calculate(1, icp)
    return f"{code} {last_error(1, icp)[1]}"


def kept():
    """Values that are kept across a change between rolling and shift, or between track and roller"""
    start(3, "un_cntc")
    for setting in contact_settings(1.0, 3):
        setting()
    same(message(1), "0 ", "rolling")
    for motion in (2, 0, 3):
        cntc.setflags(1, 1, CNTC["ic_tang"], motion)
        same(message(1), "0 ", f"the creepages and the slip of rolling, T = {motion}")
    cntc.setflags(1, 1, [CNTC["ic_tang"], CNTC["ic_force"]], [1, 2])
    check("extra rigid slip are kept" in message(1), "the slip of rolling in a shift")
    same(message(1), "0 ", "is reported once")
    cntc.setflags(1, 1, CNTC["ic_tang"], 3)
    cntc.setextrarigidslip(1, 1, np.zeros(63), np.zeros(63))
    check("0 cntc_calculate: Warning: the creepages are kept" in message(1), "the rotation of a shift in rolling")
    cntc.setflags(1, 1, CNTC["ic_tang"], 1)
    cntc.setcreepages(1, 1, 0.001, 0.0, 0.0)
    cntc.setextrarigidslip(1, 1, np.zeros(63), np.zeros(63))
    same(message(1), "0 ", "new shifts")
    cntc.setflags(1, 1, [CNTC["ic_tang"], CNTC["ic_force"]], [3, 2])
    same(message(1), "0 ", "shifts that forces replace")
    cntc.finalize(1)

    start(1, "un_cntc")
    for setting in pair_settings(1.0, False, False):
        setting()
    same(message(-1), "0 ", "a wheel on a track")
    cntc.setflags(1, -1, CNTC["ic_tang"], 1)
    check("velocities of the" in message(-1), "velocities in a shift")
    cntc.setflags(1, -1, CNTC["ic_tang"], 3)
    cntc.setwheelsetvelocity(1, 2, [2000.0, 3.0, 0.0, 0.0, 0.0, -4.345])
    cntc.setwheelsetflexibility(1, 5, np.zeros(12))
    check("velocities of the rail are kept" in message(-1), "a shift of the rail in rolling")
    same(message(-1), "0 ", "is reported once")
    height = cntc.getwheelsetposition(1)[2]
    cntc.setflags(1, -1, [CNTC["ic_return"]], [2])
    same(message(-1), "0 ", "a check")
    same(cntc.getwheelsetposition(1)[2], height, "leaves the height")
    cntc.setflags(1, -1, [CNTC["ic_return"], CNTC["ic_config"]], [1, 5])
    cntc.settrackdimensions(1, 1, [14.0, 0.0, 1435.0, 0.0, 500.0])
    check("-99 cntc_calculate: the velocities of the wheelset belong to a track" in message(-1), "a speed on a roller")
    cntc.setwheelsetvelocity(1, 2, [-4.0, 3.0, 0.0, 0.0, 0.0, -4.345])
    same(message(-1), "0 ", "a pitch rate")
    cntc.setflags(1, -1, CNTC["ic_config"], 1)
    check("belong to a roller" in message(-1), "a pitch rate on a track")


def results():
    """Results do not change with settings for the next case"""
    for next_motion in (1, 3):
        start(3, "un_si")
        for setting in contact_settings(1e-3, 4 - next_motion):
            setting()
        same(message(1), "0 ", "a contact problem in m")
        cntc.subs_addblock(1, 1, 1, 9, [0.0], [0.0, 1e-3], [5e-4, 2e-3])
        got = []
        for setting in (lambda: None, flag(1, "ic_tang", next_motion),
                        lambda: cntc.setmaterialparameters(1, 1, 0, [0.28, 0.3, 1e9, 2e9])):
            setting()
            same(cntc.subs_calculate(1, 1), 0, "stresses")
            got.append([cntc.subs_getresults(1, 1, 1, range(1, 22)), cntc.getsensitivities(1, 1), cntc.getcreepages(1, 1)])
        for later in got[1:]:
            for before, after in zip(got[0], later):
                close(after, before, 0.0, f"results of T = {4 - next_motion} after other settings")
        cntc.finalize(1)


if __name__ == "__main__":
    cntc.initlibrary(idebug=0)
    {"contact": contact, "pair": pair, "kept": kept, "results": results}[sys.argv[1]]()
    finish()
