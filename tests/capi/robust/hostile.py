"""Every routine of the library with invalid arguments: null pointers, numbers out of range, NaN, lengths that do
not fit. The process must survive, memory beyond the arrays must not change, and a
valid case must still be solved afterwards. No call may take longer than a minute, and memory may not grow.

The list of routines is src/capi/interface.txt. With more than one thread all of them call at the same time, on the same
result elements. usage: hostile.py ROUNDS [SEED [THREADS]]
"""
import ctypes
import math
import os
import random
import re
import signal
import sys
import tempfile
import threading

ROOM, GUARD = 64, 16
# [s]; the signal ends the process
LONGEST_CALL = 60
# Allowed increase of memory in the last quarter over the third one [kB]
GROWTH = 20000
MARK = 123456789


def routines(file):
    """name -> list of (direction, kind, is_array)"""
    found = {}
    with open(file, encoding="utf-8") as table:
        lines = table.readlines()
    for line in lines:
        match = re.match(r"((?:cntc|subs)_\w+)\((.*)\)\s*$", line)
        if not match:
            continue
        arguments = []
        for argument in filter(None, (word.strip() for word in match.group(2).split(","))):
            direction, kind, name = argument.split()[:3]
            arguments.append((direction, kind, "[" in name, name.split("[")[0]))
        found[match.group(1)] = arguments
    return found


SOURCE = os.environ["CONTACT_SOURCE"]
LIBRARY = ctypes.CDLL(os.environ["CONTACT_LIBRARY"])
ROUTINES = routines(os.path.join(SOURCE, "src/capi/interface.txt"))
for extra, count in (("cntc_calculate1", 2), ("cntc_calculate3", 3)):
    ROUTINES.setdefault(extra, [("in", "int", False, name) for name in ("ire", "icp")[:count - 1]]
                        + [("out", "int", False, "ierror")])
INTEGERS = [-2147483648, -106, -6, -5, -3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 20, 21, 32, 55, 99, 1000, 1933,
            1935, 1970, 1972, 1973, 1974, 1977, 1978, 1986, 1988, 1990, 2002, 2004, 2005, 2147483647]
REALS = [math.nan, math.inf, -math.inf, -1.0, -1e-30, 0.0, 1e-300, 1e-9, 1e-3, 0.05, 0.28, 0.3, 1.0, 2.0, 3.0, 5.0, 7.0, 9.0, 14.0,
         80.0, 1e15, 1e300]
# Settings that only make calculations long are kept small
TAME = {"lenarr": range(-2, ROOM + 1), "npx": range(-1, 6), "npy": range(-1, 6), "npz": range(-1, 6)}


def value(generator, name):
    """A number for a scalar integer argument"""
    if name == "ire":
        return generator.choice([-1, 0, 1, 1, 1, 2, 2, 3, 999, 1000, 2147483647])
    if name == "icp":
        return generator.choice([-1, -1, 0, 1, 1, 2, 9, 10])
    if name.startswith(("len", "n")) and name not in ("nx", "ny", "nz"):
        return generator.choice(TAME.get(name, list(range(-2, 14)) + [ROOM]))
    return generator.choice(INTEGERS)


def call(generator, name, with_null):
    """One call; returns the arrays that it may have written, to check beyond their ends"""
    arguments, arrays = [], []
    for _, kind, is_array, argument in ROUTINES[name]:
        if with_null and generator.random() < with_null:
            arguments.append(None)
        elif kind == "text":
            arguments.append(ctypes.create_string_buffer(bytes(generator.choice(b" abc\x00\xff") for _ in range(300))))
        else:
            kind_of = ctypes.c_int if kind == "int" else ctypes.c_double
            # lengths are at most ROOM, so that correct arrays are never too short; products need more
            array = (kind_of * (ROOM * ROOM + GUARD if is_array else 1 + GUARD))()
            if is_array:
                for k in range(ROOM):
                    # thousands of depths would only be slow
                    array[k] = generator.choice(INTEGERS if kind == "int" else REALS[:-3 if name == "subs_addblock" else None])
            else:
                array[0] = value(generator, argument) if kind == "int" else generator.choice(REALS)
            for k in range(1, GUARD + 1):
                array[len(array) - k] = MARK
            arrays.append(array)
            arguments.append(array)
    signal.alarm(LONGEST_CALL)
    getattr(LIBRARY, name)(*arguments)
    for array in arrays:
        if any(array[len(array) - k] != MARK for k in range(1, GUARD + 1)):
            sys.exit(f"{name} wrote beyond the end of an array")


def pointer(value):
    return ctypes.byref(ctypes.c_int(value) if isinstance(value, int) else ctypes.c_double(value))


def numbers(*values):
    return (ctypes.c_double * len(values))(*values)


def start(element, module):
    version, error = ctypes.c_int(), ctypes.c_int()
    LIBRARY.cntc_initialize(pointer(element), pointer(module), ctypes.byref(version), ctypes.byref(error), b" ", pointer(1))


def set_rolling(element):
    """A Hertzian contact that rolls"""
    start(element, 3)
    ire, icp = pointer(element), pointer(1)
    LIBRARY.cntc_setmaterialparameters(ire, icp, pointer(0), pointer(4), numbers(0.28, 0.28, 82000.0, 82000.0))
    LIBRARY.cntc_setfrictionmethod(ire, icp, pointer(0), pointer(2), numbers(0.3, 0.3))
    LIBRARY.cntc_sethertzcontact(ire, icp, pointer(-3), pointer(5), numbers(21, 33, 4.25, 7.0, 21 / 17))
    LIBRARY.cntc_setpenetration(ire, icp, pointer(0.05))
    LIBRARY.cntc_setcreepages(ire, icp, pointer(0.001), pointer(0.0), pointer(0.0004))


def set_wheel(element):
    """A wheel on a rail, with a prescribed force"""
    start(element, 1)
    ire, whole = pointer(element), pointer(-1)
    LIBRARY.cntc_setmaterialparameters(ire, whole, pointer(0), pointer(4), numbers(0.28, 0.28, 82000.0, 82000.0))
    LIBRARY.cntc_setfrictionmethod(ire, whole, pointer(0), pointer(2), numbers(0.3, 0.3))
    LIBRARY.cntc_setpotcontact(ire, whole, pointer(0), pointer(3), numbers(0.8, 0.8, 0.0))
    LIBRARY.cntc_settrackdimensions(ire, pointer(3), pointer(11), numbers(14, 0, 1435, *8 * [0]))
    LIBRARY.cntc_setwheelsetdimensions(ire, pointer(3), pointer(3), numbers(1360, -70, 460))
    for profile in ("60E1.prr", "S1002.prw"):
        name = os.path.join(SOURCE, "examples/profiles", profile).encode()
        LIBRARY.cntc_setprofileinputfname(ire, name, pointer(len(name)), pointer(0), None, pointer(0), None)
    LIBRARY.cntc_setverticalforce(ire, pointer(10000.0))


def good_case():
    """Normal force and tangential forces of the contact that rolls"""
    ire, icp, error = pointer(700), pointer(1), ctypes.c_int(99)
    set_rolling(700)
    LIBRARY.cntc_calculate(ire, icp, ctypes.byref(error))
    force = [ctypes.c_double() for _ in range(4)]
    LIBRARY.cntc_getcontactforces(ire, icp, *[ctypes.byref(f) for f in force])
    LIBRARY.cntc_finalize(ire)
    return error.value, [f.value for f in force]


def ask(generator):
    """The functions that are not in the table: error messages, status of a case, a run of an experiment"""
    buffer = generator.choice([None, ctypes.create_string_buffer(40)])
    length = generator.choice([-2147483648, -1, 0, 1, 5, 40])
    ire, icp = generator.choice(INTEGERS), generator.choice(INTEGERS)
    choice = generator.randrange(3)
    if choice == 0:
        LIBRARY.contact_last_error(ire, icp, buffer, length)
    elif choice == 1:
        LIBRARY.contact_case_status(ire, icp, generator.choice([None, ctypes.byref(ctypes.c_int())]), buffer, length)
    else:
        name = generator.choice([None, b"", b"/", b"nothing_here", b"\xff\xfe", b"a" * 5000, b"."])
        LIBRARY.contact_run_limited(name, generator.choice([2, 3, *INTEGERS[:3]]),
                                    generator.choice([None, b"", EMPTY.name.encode()]), generator.choice([-1, 0, 1, 2]),
                                    generator.choice([0, 1, 7, 8, -1]), 0, *(ctypes.c_double(generator.choice(REALS))
                                                                             for _ in range(3)), buffer, length)


EMPTY = tempfile.TemporaryDirectory()


def resident():
    """Memory of the process [kB], 0 if the system does not report it"""
    try:
        with open("/proc/self/statm", encoding="ascii") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE") // 1024
    except OSError:
        return 0


def attack(generator, rounds, alone, sizes):
    """Random calls, with a solvable problem from time to time"""
    names = sorted(ROUTINES)
    for k in range(rounds):
        if k % 100 == 0:
            set_rolling(1)
            set_wheel(2)
        if k % 20 == 0:
            call(generator, "cntc_calculate", 0.0)
        if k % 10 == 0:
            ask(generator)
        name = generator.choice(names)
        # threads that free each other's elements again and again would compute nothing
        if alone or not name.startswith("cntc_finalize") or k % 50 == 0:
            call(generator, name, 0.1 if k % 4 == 0 else 0.0)
        sizes.append(resident() if k % 10 == 0 else sizes[-1])


def main():
    rounds, seed = int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1
    threads = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    generator = random.Random(seed)
    sizes = [0]
    if len(ROUTINES) != 73:
        sys.exit(f"{len(ROUTINES)} routines are known, not 73")
    print(f"seed {seed}")
    names = sorted(ROUTINES)
    # all arguments null, in the virgin state and after it
    for _ in range(2):
        for name in names:
            call(generator, name, 2.0)
        code, before = good_case()
        if code != 0:
            sys.exit(f"the good case ends with {code}")
    if threads == 1:
        attack(generator, rounds, True, sizes)
    else:
        at_work = [threading.Thread(target=attack, args=(random.Random(seed + k), rounds, False, [0])) for k in range(threads)]
        for thread in at_work:
            thread.start()
        for thread in at_work:
            thread.join()
    quarter = rounds // 4
    # the address sanitizer keeps freed memory
    keeps = "asan" in os.environ.get("LD_PRELOAD", "")
    if threads == 1 and rounds >= 4000 and not keeps and max(sizes[3 * quarter:]) > max(sizes[2 * quarter:3 * quarter]) + GROWTH:
        sys.exit(f"memory grows: {sizes[::quarter]} kB")
    code, after = good_case()
    if code != 0 or any(abs(a - b) > 1e-9 * abs(b) for a, b in zip(after, before)):
        sys.exit(f"the good case changed from {before} to {after}, code {code}")
    LIBRARY.cntc_finalizelast()
    print(f"{rounds} calls, forces of the good case {after}")


main()
