"""Common part of the Python conformance programs: counting checks, and the package of the checkout."""
import os
import sys

SOURCE = os.environ.get("CONTACT_SOURCE") or os.path.abspath(os.path.join(os.path.dirname(__file__), "../../.."))
REFERENCE = os.path.join(os.environ.get("CONTACT_REFERENCE", ""), "examples")
sys.path.insert(0, os.path.join(SOURCE, "python"))

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)

_counts = {"checks": 0, "failed": 0}


def check(condition, what):
    """Count one check"""
    _counts["checks"] += 1
    if not condition:
        _counts["failed"] += 1
        print(f"FAILED {what}")


def close(got, expected, tolerance, what):
    """Check that numbers or arrays agree within an absolute tolerance"""
    got, expected = np.asarray(got, float), np.asarray(expected, float)
    good = got.shape == expected.shape and bool(np.all(np.abs(got - expected) <= tolerance))
    check(good, f"{what}: got {got}, expected {expected} within {tolerance}" if not good else what)


def same(got, expected, what):
    """Check that two values are equal"""
    check(got == expected, f"{what}: got {got!r}, expected {expected!r}")


def extreme(field):
    """Entry with the largest absolute value"""
    flat = np.asarray(field).reshape(-1)
    return flat[np.argmax(np.abs(flat))]


def log_text(name="contact_addon"):
    """Present content of the .out file"""
    with open(name + ".out", encoding="utf-8", errors="replace") as file:
        return file.read()


def profiles():
    """Rail and wheel of the Manchester benchmark; where they are absent, those of the examples"""
    published = [os.path.join(REFERENCE, name) for name in ("MBench_UIC60_v3.prr", "MBench_S1002_v3.prw")]
    own = [os.path.join(SOURCE, "examples", "profiles", name) for name in ("60E1.prr", "S1002.prw")]
    return published if all(os.path.isfile(name) for name in published) else own


def finish():
    """Print the counts; exit status 0 passed, 1 failed"""
    print(f"{_counts['checks']} checks, {_counts['failed']} failed")
    sys.exit(1 if _counts["failed"] or not _counts["checks"] else 0)
