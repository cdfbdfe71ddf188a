#!/usr/bin/env python3
"""Threads of a caller with different settings: each result is that of the same calls alone, to the last digit.

Each thread has one problem, a wheel on a rail or a contact of two bodies, and changes one setting at random before each call, as in
changes.py: order, estimated errors, friction, material, search, wear. Forces are read in several units, stresses and derivatives
too. The threads run one after the other, and then at the same time.

    at_once.py [--threads N] [--changes N] [--seed S]
"""
import argparse
import random
import sys
import threading

import changes
import contact
import numpy as np
from contact import cntc

#: Units of the results: mm and N; m and N on body 1; m and N on body 2
UNITS = (1934, 1936, 1935)


def bits(value):
    """A result as bytes: NaN equals itself, and 0 differs from -0"""
    if isinstance(value, (int, float, np.ndarray, list, tuple)):
        return np.asarray(value, dtype=float).tobytes()
    return repr(value).encode()


def everything(problem, result, how):
    """All numbers of a result"""
    found = [how]
    if result is None:
        return found
    for patch in getattr(result, "patches", (result,)):
        for values in (patch.totals(), patch.errors or {}, patch.fields()):
            found += [(name, bits(values[name])) for name in sorted(values)]
    for read in (derivatives, stresses):
        try:
            found += read(problem)
        except contact.ContactError as error:
            found.append(str(error))
    return found


def derivatives(problem):
    """Those of a wheel on a rail"""
    return [("derivatives", bits(problem.jacobian().values))] if isinstance(problem, contact.WheelRail) else []


def stresses(problem):
    """Stresses at the points of the problem, in each patch"""
    blocks = problem.stresses()
    return [(name, bits(values)) for block in (blocks if isinstance(blocks, tuple) else (blocks,))
            for name, values in block.fields().items()]


def forces_in(problem, units, icp):
    """Forces of a contact in other units"""
    cntc.setflags(problem.number, icp, [1933], [units])
    forces = cntc.getcontactforces(problem.number, 1)
    cntc.setflags(problem.number, icp, [1933], [UNITS[0]])
    return bits(forces)


def sequence(seed, count):
    """Results of one problem whose settings change"""
    dice = random.Random(seed)
    kind, table, icp = ((contact.WheelRail, changes.WHEEL, -1), (contact.Problem, changes.CONTACT, 1))[seed % 2]
    state = {name: values[0] if isinstance(values, tuple) else changes.chosen(dice, values) for name, (values, _) in table.items()}
    problem, found = changes.make(kind, table, state), []
    problem.add_block([0.0, 1.0], [-1.0, 0.0, 0.5], [0.5, 2.0])
    for _ in range(count):
        name = dice.choice(list(table))
        state[name] = changes.chosen(dice, table[name][0])
        table[name][1](problem, state[name])
        result, how = changes.solve(problem)
        found.append(([name], everything(problem, result, how)))
        if result is None:
            for other in ("motion", "material", "pressures", "temperatures", "friction"):
                state[other] = table[other][0][0]
                table[other][1](problem, state[other])
        elif getattr(result, "patches", (result,)):
            found[-1][1].append(("forces", forces_in(problem, dice.choice(UNITS), icp)))
    problem.close()
    return found


def main():
    reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for option, number in (("--threads", 4), ("--changes", 25), ("--seed", 1)):
        reader.add_argument(option, type=int, default=number)
    chosen = reader.parse_args()
    seeds = range(chosen.seed, chosen.seed + chosen.threads)
    alone = [sequence(seed, chosen.changes) for seed in seeds]
    together, wrong = [None] * chosen.threads, 0

    def work(place):
        together[place] = sequence(seeds[place], chosen.changes)

    callers = [threading.Thread(target=work, args=(place,)) for place in range(chosen.threads)]
    for caller in callers:
        caller.start()
    for caller in callers:
        caller.join()
    results = 0
    for place, seed in enumerate(seeds):
        if together[place] is None:
            sys.exit(f"FAILED the thread of seed {seed} ended early")
        for k, (before, after) in enumerate(zip(alone[place], together[place])):
            results += len(before[1]) > 1
            if before != after:
                wrong += 1
                names = [one[0] if isinstance(one, tuple) else one for one, other in zip(before[1], after[1]) if one != other]
                print(f"FAILED seed {seed}, call {k + 1} after a change of {before[0][0]}: {', '.join(names)[:200]}")
                break
    print(f"{chosen.threads} threads, {results} calls with results, {wrong} threads with differences")
    if results < chosen.threads * chosen.changes / 2:
        sys.exit("FAILED most calls have results")
    sys.exit(wrong > 0)


main()
