"""A Dask cluster on this machine: its processes are killed, restarted, added, slowed and limited in memory while a study runs.
Environment: ACTS, number of random actions."""
import os
import random
import re
import resource
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import contact
import numpy as np
import pytest
from bases import rolling

POINTS = 600
ACTS = int(os.environ.get("ACTS", "3"))


class Cluster:
    """A scheduler and a varying set of workers: separate processes on the loopback device"""

    def __init__(self, folder):
        self.folder, self.processes, self.readers = folder, [], []
        self.scheduler = self.start("scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard")
        self.address = re.search(r"tcp://127\.0\.0\.1:\d+", self.line_with(self.scheduler, "Scheduler at")).group()

    def start(self, kind, *words, **more):
        """A Dask process"""
        environment = {**os.environ, **more, "DASK_DISTRIBUTED__WORKER__MEMORY__TERMINATE": "0.95",
                       "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "10"}
        process = subprocess.Popen([sys.executable, "-m", "distributed.cli.dask_" + kind, *words], cwd=self.folder,
                                   env=environment, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
        self.processes.append(process)
        return process

    def line_with(self, process, words):
        """A line of the output of a process; the rest is read so that the process never blocks"""
        for line in process.stderr:
            if words in line:
                self.readers.append(threading.Thread(target=lambda: [None for _ in process.stderr], daemon=True))
                self.readers[-1].start()
                return line
        raise AssertionError(f"the process ended without the output {words}")

    def worker(self, *more, **variables):
        """Add a worker"""
        process = self.start("worker", self.address, "--no-nanny", "--nthreads", "1", "--no-dashboard", "--host", "127.0.0.1",
                             *more, **variables)
        self.line_with(process, "Registered to")
        return process

    def close(self):
        """End all remaining processes"""
        for process in self.processes:
            if process.poll() is None:
                process.send_signal(signal.SIGCONT)
                process.kill()
        for process in self.processes:
            process.wait()
        # a file that is closed while it is read is an error in its thread
        for reader in self.readers:
            reader.join()
        for process in self.processes:
            process.stderr.close()


@pytest.fixture
def cluster(tmp_path):
    """A cluster without workers"""
    made = Cluster(tmp_path)
    yield made
    made.close()


def test_workers_come_and_go(cluster, tmp_path, monkeypatch):
    study = contact.Study(rolling(7), {"kinematics.cksi": contact.study.span(-0.01, 0.01, POINTS // 2),
                                       "friction.coefficient": [0.2, -1.0]}, folder=tmp_path / "s")
    first, second = cluster.worker(), cluster.worker()
    acts = []

    def act(words):
        """One worker is killed, one is stopped and continued, two are added, one of them with too little memory"""
        done = int(words.split()[0])
        if done > 60 and not acts:
            acts.append("killed")
            first.kill()
        elif done > 150 and len(acts) == 1:
            acts.append("stopped")
            second.send_signal(signal.SIGSTOP)
            cluster.worker("--memory-limit", "60MB")
            cluster.worker()
        elif done > 250 and len(acts) == 2:
            acts.append("goes on")
            second.send_signal(signal.SIGCONT)
        time.sleep(0.05)

    shown = contact.study._study.Progress
    original = shown.add

    def add(self, points, failed):
        # called for every task, not four times a second
        self._last = 0.0
        original(self, points, failed)

    monkeypatch.setattr(shown, "add", add)
    begun = time.monotonic()
    found = study.run(scheduler=cluster.address, progress=act, points_per_task=10)
    took = time.monotonic() - begun
    assert acts == ["killed", "stopped", "goes on"], acts
    assert took < 120.0
    serial = contact.Study(rolling(7), {"kinematics.cksi": contact.study.span(-0.01, 0.01, POINTS // 2),
                                        "friction.coefficient": [0.2, -1.0]}).run(workers=1)
    assert (found.status.sel(coefficient=0.2) == 0).all() and (found.status.sel(coefficient=-1.0) == 2).all()
    for name, values in serial.data_vars.items():
        if values.dtype.kind == "f":
            assert values.values.tobytes() == found[name].values.tobytes(), name
    store = contact.study._store.Store(tmp_path / "s")
    keys = store.keys()
    store.close()
    assert len(np.unique(keys, axis=0)) == len(keys) == POINTS


def taken(process):
    """Size of the address space of a process [bytes]"""
    with open(f"/proc/{process.pid}/statm") as file:
        return int(file.read().split()[0]) * resource.getpagesize()


@pytest.mark.skipif(not hasattr(resource, "prlimit"), reason="limits of other processes")
def test_whatever_happens_to_workers(cluster, tmp_path, monkeypatch):
    """Random actions up to the required number; every case is present once and identical bit by bit"""
    points = 400 + 150 * ACTS
    inputs = {"kinematics.cksi": contact.study.span(-0.01, 0.01, points // 2), "friction.coefficient": [0.2, 0.4]}
    study = contact.Study(rolling(7), inputs, folder=tmp_path / "s")
    draw = random.Random(ACTS)
    workers = [cluster.worker(), cluster.worker()]
    acted = dict.fromkeys(("killed and started again", "stopped for a while", "slow", "added", "left", "without memory"), 0)

    def stop(worker, seconds):
        worker.send_signal(signal.SIGSTOP)
        time.sleep(seconds)
        worker.send_signal(signal.SIGCONT)

    def act(words):
        if sum(acted.values()) >= ACTS:
            return
        few = len(acted) >= ACTS
        kind = list(acted)[sum(acted.values())] if few else draw.choice(list(acted))
        acted[kind] += 1
        place = draw.randrange(len(workers))
        if kind == "killed and started again":
            workers.pop(place).kill()
            workers.append(cluster.worker())
        elif kind == "stopped for a while":
            threading.Thread(target=stop, args=(workers[place], draw.uniform(0.2, 1.0))).start()
        elif kind == "slow":
            os.setpriority(os.PRIO_PROCESS, workers[place].pid, 19)
        elif kind == "added":
            workers.append(cluster.worker())
        elif kind == "left" and len(workers) > 1:
            workers.pop(place).send_signal(signal.SIGTERM)
        else:
            # further requests for memory fail
            enough = taken(workers[place]) + (1 << 20)
            resource.prlimit(workers[place].pid, resource.RLIMIT_AS, (enough, enough))
            workers.append(cluster.worker())
        if len(workers) > 4:
            workers.pop(0).kill()

    shown = contact.study._study.Progress
    original = shown.add

    def add(self, count, failed):
        self._last = 0.0
        original(self, count, failed)

    monkeypatch.setattr(shown, "add", add)
    found = study.run(scheduler=cluster.address, progress=act, points_per_task=5)
    assert sum(acted.values()) == ACTS, acted
    serial = contact.Study(rolling(7), inputs).run(workers=1)
    assert (found.status == 0).all()
    for name, values in serial.data_vars.items():
        if values.dtype.kind == "f":
            assert values.values.tobytes() == found[name].values.tobytes(), name
    store = contact.study._store.Store(tmp_path / "s")
    keys = store.keys()
    store.close()
    assert len(np.unique(keys, axis=0)) == len(keys) == found.status.size


def test_workers_of_another_build_are_refused(cluster, tmp_path):
    """Wrong workers are refused by name: existing ones before anything is computed, one that joins later at its first task"""
    library = Path(os.environ["CONTACT_LIBRARY"])
    other = tmp_path / "other" / library.name
    other.parent.mkdir()
    # the same library with bytes appended
    other.write_bytes(library.read_bytes() + b"x")
    study = contact.Study(rolling(7), {"kinematics.cksi": contact.study.span(-0.01, 0.01, 200)}, folder=tmp_path / "s")
    first = cluster.worker()
    study.run(scheduler=cluster.address, stop=lambda: True)
    cluster.worker(CONTACT_LIBRARY=str(other))
    with pytest.raises(contact.ContactError, match=r"of another build than the study.*tcp://127.0.0.1:\d+ \(version .*library"):
        study.run(scheduler=cluster.address)

    cluster.processes[-1].kill()
    acts = []

    def act(words):
        """The right worker ends as soon as a wrong one has joined"""
        if not acts:
            acts.append(cluster.worker(CONTACT_LIBRARY=str(other)))
            first.kill()

    with pytest.raises(contact.ContactError, match=r"the worker \S+, process \d+, is of another build"):
        study.run(scheduler=cluster.address, points_per_task=2, progress=act)
    assert study.explain().there < 200


def test_a_worker_ends_while_it_is_asked_for_its_build(cluster):
    study = contact.Study(rolling(7), {"kinematics.cksi": contact.study.span(-0.01, 0.01, 20)})
    cluster.worker()
    ending = cluster.worker()
    ending.send_signal(signal.SIGSTOP)
    threading.Timer(0.5, ending.kill).start()
    assert (study.run(scheduler=cluster.address).status == 0).all()


def test_no_scheduler_is_told():
    with pytest.raises(contact.ContactError, match="no scheduler of Dask answers at tcp:"):
        contact.study.Engine(scheduler="tcp://127.0.0.1:9")
