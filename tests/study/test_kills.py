"""A study is killed at random times and restarted: every case once, identical bit by bit. Environment: KILLS, their number."""
import os
import random
import signal
import subprocess
import sys
import time

import contact
import numpy as np
from bases import rolling
from contact.study._store import Store

KILLS = int(os.environ.get("KILLS", "4"))
POINTS = 150 * KILLS + 600
CHILD = """
import sys
from test_kills import study
study(sys.argv[1]).run(workers=2, points_per_task=7)
"""


def study(folder=None):
    """The study that is killed"""
    return contact.Study(rolling(7), {"kinematics.cksi": contact.study.span(-0.01, 0.01, POINTS // 3),
                                      "friction.coefficient": [0.1, 0.3, 0.5]}, folder=folder)


def stored(folder):
    """Keys of the stored points"""
    store = Store(folder)
    keys = store.keys()
    store.close()
    return keys


def test_nothing_is_lost_and_nothing_is_twice(tmp_path):
    draw = random.Random(KILLS)
    killed, sizes = 0, []
    for _ in range(20 * KILLS):
        child = subprocess.Popen([sys.executable, "-c", CHILD, str(tmp_path)])
        before = len(stored(tmp_path)) if killed == 0 else sizes[-1]
        # not during its start: first computes something, then is killed at a random time
        file = tmp_path / "cases.sqlite"
        begun = file.stat().st_mtime_ns if file.exists() else 0
        while child.poll() is None and (not file.exists() or file.stat().st_mtime_ns == begun):
            time.sleep(0.002)
        time.sleep(draw.uniform(0.0, 0.05))
        if child.poll() is None:
            child.send_signal(signal.SIGKILL)
            killed += 1
        child.wait()
        keys = stored(tmp_path)
        assert len(np.unique(keys, axis=0)) == len(keys) >= before
        sizes.append(len(keys))
        if killed == KILLS or len(keys) == POINTS:
            break
    assert killed == KILLS, f"the study was ready after {killed} kills"
    found = study(tmp_path).run(workers=2)
    keys = stored(tmp_path)
    assert len(np.unique(keys, axis=0)) == len(keys) == POINTS
    serial = study().run(workers=1)
    assert (found.status == 0).all()
    for name, values in serial.data_vars.items():
        assert values.dtype == object or values.values.tobytes() == found[name].values.tobytes(), name
