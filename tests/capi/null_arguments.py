#!/usr/bin/env python3
"""Functions of contact.h with null pointers, negative lengths, and numbers that are not finite: an answer, and no signal.

Those of contact_addon.h are in robust/hostile.py. The host traps invalid operations, overflow and division by zero.
"""
import ctypes
import hashlib
import math
import os
import struct
import sys
import tempfile

LIBRARY = ctypes.CDLL(os.environ["CONTACT_LIBRARY"])
MATHS = ctypes.CDLL("libm.so.6")
#: FE_INVALID, FE_DIVBYZERO and FE_OVERFLOW of x86-64 and AArch64
TRAPS = 0x0D if os.uname().machine == "x86_64" else 0x07
TEXT = b"""
[[case]]
module = "contact"
"""
failures = 0


def check(condition, what):
    global failures
    if not condition:
        failures += 1
        print("FAILED", what)


def call(name, *arguments, expected=None):
    """A function, called by a host with traps"""
    function = getattr(LIBRARY, name)
    function.restype = ctypes.c_void_p if name.endswith("_open") else ctypes.c_int
    MATHS.feenableexcept(TRAPS)
    found = function(*arguments)
    traps = MATHS.fedisableexcept(TRAPS)
    check(traps == TRAPS, f"{name}: the traps of the host are as they were")
    if expected is not None:
        check(found in expected, f"{name}{arguments}: {found}, not {expected}")
    return found


def reals(*values):
    return (ctypes.c_double * len(values))(*values)


def write_table(path):
    """A table with forces that increase with the creepages: 4 nodes along each axis, constant offset"""
    knots = []
    for low, high in ((-1.0, 1.0), (0.0, 1.0), (-1.0, 1.0), (0.0, 1.0)):
        knots += [low] * 4 + [high] * 4
    nodes = [(-k / 3.0, -(j - 1.5) / 3.0, -m / 9.0) for _ in range(4) for k in range(4) for j in range(4) for m in range(4)]
    body = struct.pack(f"<{len(knots)}d", *knots) + b"".join(struct.pack("<3f", *node) for node in nodes)
    head = b"CONTACT table 2\n" + struct.pack("<8i", 1, 4, 1, 4, 4, 4, 9, 2) + struct.pack("<q9d", 192 + len(body), 0.28,
                                                                                       *[0.01] * 7, 0.0)
    with open(path, "wb") as file:
        file.write(head + body + hashlib.sha256(head + body).hexdigest().encode())


def tables(folder):
    path = os.path.join(folder, "t.table").encode()
    write_table(path)
    answer = ctypes.create_string_buffer(200)
    for name in (None, b"", b"/dev/zero", folder.encode(), b"x" * 5000):
        check(call("contact_table_open", name, answer, 200) is None and answer.value, f"no table {name!r:.20}")
        call("contact_table_open", name, None, -1)
    table = ctypes.c_void_p(call("contact_table_open", path, answer, 200))
    check(table, answer.value)
    patch, creepage = reals(7e4, 0.3, 82e3, 5.0, 5.0, 5.0), reals(1e-3, 0.0, 0.0)
    force, slopes = reals(*[7.0] * 3), reals(*[7.0] * 9)
    call("contact_table_force", table, patch, creepage, force, expected=[0])
    check(force[0] < 0.0, "a table has forces")
    facts = ctypes.create_string_buffer(200)
    for handle in (table, None):
        wrong = [0] if handle else [1]
        call("contact_table_about", handle, facts, expected=wrong)
        call("contact_table_about", handle, None, expected=[1])
        for absent in range(1, 16):
            given = [None if absent >> k & 1 else one for k, one in enumerate((patch, creepage, force, slopes))]
            call("contact_table_force", handle, *given[:3], expected=[0] if handle and not absent & 7 else [2])
            call("contact_table_force_derivatives", handle, *given, expected=[2])
            call("contact_table_forces", handle, 1, *given, None, expected=[0] if handle and not absent & 7 else [2])
        call("contact_table_forces", handle, 0, None, None, None, None, None, expected=[2])
        call("contact_table_forces", handle, -5, patch, creepage, force, slopes, None, expected=[2])
    for value in (math.nan, math.inf, -math.inf, 1e308, -1e308, 5e-324, 0.0, -1.0):
        for k in range(9):
            numbers = [7e4, 0.3, 82e3, 5.0, 5.0, 5.0, 1e-3, 1e-3, 1e-4]
            numbers[k] = value
            answer = call("contact_table_force_derivatives", table, reals(*numbers[:6]), reals(*numbers[6:]), force, slopes,
                          expected=[0, 1] if math.isfinite(value) and (k > 5 or (k < 2 and abs(value) < 1e40)) else [2])
            check(all(map(math.isfinite, [*force, *slopes])), f"number {k} = {value}: {answer}, {[*force]}, {[*slopes]}")
    LIBRARY.contact_table_close(table)
    LIBRARY.contact_table_close(None)


class Job(ctypes.Structure):
    """contact_batch_job"""
    _fields_ = [(name, ctypes.c_char_p) for name in ("text", "folder", "names")] + [
        ("numbers", ctypes.c_int), ("sets", ctypes.c_int), ("given", ctypes.c_void_p)] + [
        (name, ctypes.c_int) for name in ("room_rows", "room_columns", "room_cases")] + [
        (name, ctypes.c_void_p) for name in ("values", "places", "states", "reasons")] + [
        (name, ctypes.c_int) for name in ("reason_length", "rows", "cases", "columns")]


def batches():
    message = ctypes.create_string_buffer(200)
    whole, frame, text = ctypes.byref(ctypes.c_int()), reals(*[0.0] * 4), ctypes.create_string_buffer(200)
    for seconds in (math.nan, math.inf, -1.0, 0.0):
        batch = ctypes.c_void_p(call("contact_batch_open", -7, ctypes.c_double(seconds)))
        check(batch, "a batch")
        for handle in (batch, None):
            call("contact_batch_solve", handle, None, message, 200, expected=[1])
            for job in ({}, {"text": b""}, {"text": TEXT, "numbers": 3, "sets": -2}, {"text": TEXT, "room_rows": -1}):
                call("contact_batch_solve", handle, ctypes.byref(Job(**job)), message, 200, expected=[1])
                check(message.value, "a wrong job is reported")
            for number in (-1, 0, 1, 2147483647):
                call("contact_batch_column", handle, number, None, None, None, -1, expected=[-1])
            for name in (None, b"", b"pn"):
                call("contact_batch_field", handle, 1, name, None, None, None, None, 0, expected=[1])
                call("contact_batch_field", handle, 1, name, whole, whole, frame, text, 200, expected=[1])
                call("contact_batch_field_values", handle, 1, name, -4, None, expected=[1])
        LIBRARY.contact_batch_close(batch)
    LIBRARY.contact_batch_close(None)


def runs():
    message, none = ctypes.create_string_buffer(200), None
    for name in (None, b"", b"absent", b"x" * 5000):
        for mode in (-1, 2, 3, 2147483647):
            call("contact_run", name, mode, none, 1, none, -1)
            check(call("contact_run_with", name, mode, none, 1, 0, message, 200) > 0 and message.value, f"no run {name!r:.20}")
        for limit in (math.nan, math.inf, -1.0, 1e308):
            limits = [ctypes.c_double(limit)] * 3
            check(call("contact_run_limited", name, 2, none, 1, 0, 0, *limits, message, 200) > 0, "a limit is refused")
        check(call("contact_convert_experiment", name, none, 0, message, 200) > 0, "nothing to convert")
        check(call("contact_explain_experiment", name, message, -200, none) > 0, "nothing to explain")
    call("contact_last_error", -2147483648, 2147483647, none, -1)
    call("contact_case_status", -1, 99, none, none, -1, expected=[-1])
    call("contact_wheel_rail_jacobian", -1, none, 1000, none, -1, expected=[-1])


with tempfile.TemporaryDirectory() as scratch:
    tables(scratch)
batches()
runs()
sys.exit(failures > 0)
