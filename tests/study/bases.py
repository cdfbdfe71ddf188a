"""Base cases of the studies in the tests."""
import os
from pathlib import Path

SOURCE = Path(os.environ["CONTACT_SOURCE"])
EXAMPLES = SOURCE / "examples"


def rolling(n=9):
    """A small contact problem in steady rolling"""
    return {"module": "contact", "motion": "steady_rolling", "normal": "force",
            "kinematics": {"fn": 70000.0, "cksi": 0.001, "ceta": 0.0, "cphi": 0.0}, "friction": {"fstat": 0.3, "fkin": 0.3},
            "material": {"poiss": [0.28, 0.28], "gg": [82000.0, 82000.0]}, "rolling": {"veloc": 30000.0, "dq": 1.0},
            "grid": {"form": "hertz_axes", "mx": n, "my": n, "aa": 6.0, "bb": 5.0, "scale": 1.3}}
