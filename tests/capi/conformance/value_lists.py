#!/usr/bin/env python3
"""Lists of points of profiles: every task in arrays of every length, and lines on a variable profile against each other"""
import math
import os

import numpy as np
from checks import SOURCE, check, close, finish, profiles, same
from contact import cntc
from contact._library import call, last_error

SLICES = os.path.join(SOURCE, "examples", "profiles", "flat.slcw")
NOTHING = 7.25


def ask(task, length, kind, method=1, reals=(1.0,)):
    """The first entries of an array that is longer than requested"""
    room = np.full(length + 5, NOTHING)
    call("cntc_getprofilevalues", 1, task, 2, np.array([kind, method]), len(reals), np.array(reals), length, room)
    check(bool(np.all(room[length:] == NOTHING)), f"task {task}: nothing beyond an array of {length}")
    return room[:length]


def lengths(task, kind, full, label, **how):
    """Arrays that are shorter have the beginning of the whole list, the rest of longer ones is unchanged"""
    n = len(full)
    for length in sorted({2, 3, n // 3 - 1, n // 3, n // 3 + 1, n // 2, 2 * n // 3, 2 * n // 3 + 1, n - 1,
                          n} & set(range(2, n + 1))):
        np.testing.assert_array_equal(ask(task, length, kind, **how), full[:length], f"{label}, task {task}, {length} of {n}")
    longer = ask(task, n + 4, kind, **how)
    np.testing.assert_array_equal(longer[:n], full)
    check(bool(np.all(longer[n:] == NOTHING)), f"{label}, task {task}: an array that is longer")


def plain():
    """Rail and wheel: points, arc lengths and slopes are consistent"""
    same(cntc.initialize(1, 1)[1], 0, "initialize")
    for name, kind in zip(profiles(), (0, 1)):
        cntc.setprofileinputfname(1, name, [kind], [1.0, 0.0])
        for method, reals in ((-1, (1.0,)), (0, (1.0,)), (1, (0.6,)), (3, (1.0,))):
            how = dict(method=method, reals=reals)
            n = int(ask(0, 1, kind, **how)[0])
            lists = {}
            for task, width in ((1, 2), (2, 2), (4, 1), (5, 1)):
                lists[task] = ask(task, width * n, kind, **how)
                check(bool(np.all(np.isfinite(lists[task]))), f"task {task}")
                lengths(task, kind, lists[task], f"body {kind}, sampling {method}", **how)
            y, z = lists[1].reshape(2, n)
            # chords: nearly as long as the arc, and with the inclination of the curve at the middle
            steps = np.hypot(np.diff(y), np.diff(z))
            close(np.diff(lists[4]), steps, 1e-2 * steps + 2e-3, f"body {kind}, sampling {method}: arc lengths")
            turn = np.abs((np.diff(lists[5]) + math.pi) % (2 * math.pi) - math.pi)
            smooth = turn < 0.05
            between = lists[5][:-1] + 0.5 * ((np.diff(lists[5]) + math.pi) % (2 * math.pi) - math.pi)
            chord = np.arctan2(np.diff(z), np.diff(y))
            off = np.abs((chord - between + math.pi) % (2 * math.pi) - math.pi)
            check(smooth.sum() > 0.7 * n and float(off[smooth].max()) < 0.03,
                  f"body {kind}, sampling {method}: angles {off[smooth].max()}")


def surface():
    """A wheel with a flat in slices: positions, ranges, and where lines of the three kinds cross"""
    same(cntc.initialize(1, 1)[1], 0, "initialize")
    cntc.settrackdimensions(1, 3, [14.0, 0.0, 1435.0] + 8 * [0.0])
    cntc.setprofileinputfname(1, profiles()[0], [0], [1.0, 0.0])
    cntc.setprofileinputfname(1, SLICES, [1], [1.0, 0.0])
    same(list(ask(-1, 2, 1)), [0.0, 0.0], f"the slices are taken: {last_error(1, -1)}")
    step = 0.002
    lists = {}
    for task, place in ((6, 0.01), (7, 40.0), (8, 3.0)):
        how = dict(reals=(step if task > 6 else 0.5, place))
        n = int(ask(task, 1, 1, **how)[0])
        check(n > 20, f"task {task}: {n} points")
        full = ask(task, 3 * n, 1, **how)
        lengths(task, 1, full, "slices", **how)
        lists[task] = full.reshape(3, n)
        # a part of it begins and ends at the requested positions
        first, last = (2.0, 7.1) if task == 6 else (-0.021, 0.0305)
        width = how["reals"][0]
        how["reals"] += (first, last)
        part = int(ask(task, 1, 1, **how)[0])
        same(part, int((last - first) / width + 1e-9) + 1, f"task {task}: points of a part")
        points = ask(task, 3 * part, 1, **how).reshape(3, part)
        if task != 6:
            close(points[0], first + width * np.arange(part), 1e-12, f"task {task}: positions of a part")
        # without a range: from end to end
        if task != 6:
            close(np.ptp(np.diff(lists[task][0]) - step), 0, 1e-12, f"task {task}: positions")
    close(np.abs(lists[6][0] - 0.01).max(), 0, 0, "a line at one position of the slices")
    there = np.abs(lists[8][1]) < 900
    close(np.abs(lists[8][1][there] - 3.0).max(), 0, 1e-9, "a line of one y")
    # the line at u = 0.01 and the line v = 40 have a point in common, and so have u = 0.01 and y = 3
    crossing = ask(7, 3, 1, reals=(1.0, 40.0, 0.01, 0.01))
    found = ask(6, 3, 1, reals=(1.0, 0.01, 40.0, 40.0))
    close(found[1:], crossing[1:], 1e-9, "lines u and v cross")
    on_y = ask(8, 3, 1, reals=(1.0, crossing[1], 0.01, 0.01))
    close(on_y[1:], crossing[1:], 1e-6, "lines u and y cross")
    check(cntc.getprofilevalues(1, 6, [0, 1], [0.5, 0.0]) is not None, "a rail that does not vary")
    check("does not vary" in last_error(1, -1)[1], "a rail that does not vary is refused with the reason")


def states():
    """Why a profile cannot be used: not given, no such file, or not a profile"""
    same(cntc.initialize(1, 1)[1], 0, "initialize")
    same(ask(-1, 2, 0)[1], 1.0, "not given")
    cntc.setprofileinputfname(1, "no_such_file.prr", [0], [1.0, 0.0])
    same(ask(-1, 2, 0)[1], 2.0, "no such file")
    with open("nonsense.prr", "w", encoding="utf-8") as file:
        file.write("nothing\nof\nuse\n")
    cntc.setprofileinputfname(1, "nonsense.prr", [0], [1.0, 0.0])
    same(ask(-1, 2, 0)[1], 99.0, "a file that is not a profile")
    cntc.setprofileinputfname(1, profiles()[0], [0], [1.0, 0.0])
    same(list(ask(-1, 2, 0)), [0.0, 0.0], "a good one")


states()
plain()
surface()
finish()
