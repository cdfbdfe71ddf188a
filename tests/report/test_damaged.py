"""Damaged HDF5 files: the reader of the page gives an error in one sentence or correct numbers; no traceback, no endless loop.

usage: test_damaged.py [COUNT [SEED]]
"""
import collections
import hashlib
import json
import os
import pathlib
import random
import resource
import subprocess
import sys
import tempfile

try:
    import h5py  # noqa: F401
    import numpy  # noqa: F401
except ImportError as reason:
    print(f"SKIPPED: {reason}")
    sys.exit(77)

SOURCE = pathlib.Path(os.environ["CONTACT_SOURCE"])
sys.path.insert(0, str(SOURCE / "python"))
from contact.report.read import MissingResults, read_experiment

PATIENCE = 20


def places_of_indices(data):
    """Bytes of the chunk index of arrays, the only ones without a checksum in HDF5 1.8"""
    found = []
    at = data.find(b"TREE")
    while at >= 0:
        if data[at + 4] == 1 and data[at + 5] == 0:
            entries = int.from_bytes(data[at + 6:at + 8], "little")
            # length, mask of the filters, offsets in one or two directions and 0, address; two directions are assumed here
            found += list(range(at + 24, min(len(data), at + 24 + 32*max(1, min(entries, 16)))))
        at = data.find(b"TREE", at + 4)
    return found


def damaged(data, chance, indices):
    """One of five kinds of damage: a bit, a byte, truncation, a range of random bytes, a bit of an index"""
    kind = chance.randrange(5)
    changed = bytearray(data)
    at = chance.choice(indices) if kind == 4 else chance.randrange(len(changed))
    if kind in (0, 4):
        changed[at] ^= 1 << chance.randrange(8)
    elif kind == 1:
        changed[at] = chance.randrange(256)
    elif kind == 2:
        del changed[at:]
    else:
        end = min(len(changed), at + chance.randrange(1, 200))
        changed[at:end] = chance.randbytes(end - at)
    return bytes(changed), f"{('bit', 'byte', 'cut', 'stretch', 'bit of an index')[kind]} at {at}"


def read(path):
    """The outcome of reading a file, in words"""
    try:
        found = read_experiment(path)
    except MissingResults as reason:
        text = str(reason)
        return "said" if path in text and "\n" not in text else f"unclear: {text}"
    return hashlib.sha256(json.dumps(found, sort_keys=True).encode()).hexdigest()


def in_a_child(path):
    """The same in a separate process: HDF5 itself may crash, exhaust the memory or not terminate"""
    back, there = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))
            resource.setrlimit(resource.RLIMIT_CPU, (PATIENCE, PATIENCE))
            answer = read(path)
        except BaseException as reason:  # pylint: disable=broad-except
            answer = f"traceback: {reason!r}"
        os.write(there, answer.encode()[:4000])
        os._exit(0)
    os.close(there)
    with os.fdopen(back, "rb") as pipe:
        answer = pipe.read().decode()
    status = os.waitpid(child, 0)[1]
    return answer if status == 0 else f"died: {status}"


def main():
    """Mutations of two files"""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 120
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 15
    chance, found, wrong = random.Random(seed), collections.Counter(), 0
    for name in ("bentall", "single_wheel"):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([os.environ["CONTACT_PROGRAM"], "--quiet", "--hdf5", "--output-dir", folder, "2",
                            str(SOURCE / "examples" / name)], check=True, stdin=subprocess.DEVNULL)
            whole = os.path.join(folder, name + ".h5")
            good = in_a_child(whole)
            assert len(good) == 64, good
            with open(whole, "rb") as file:
                data = file.read()
            indices = places_of_indices(data)
            assert len(indices) > 1000, len(indices)
            changed = os.path.join(folder, "damaged.h5")
            for _ in range(count):
                text, what = damaged(data, chance, indices)
                with open(changed, "wb") as file:
                    file.write(text)
                answer = in_a_child(changed)
                kind = "right numbers" if answer == good else answer if answer == "said" else "wrong"
                found[kind] += 1
                if kind == "wrong":
                    wrong += 1
                    print(f"FAILED {name}, {what}: {answer[:300] if len(answer) != 64 else 'other numbers than before'}")
    print(f"seed {seed}: {2*count} damaged files, " + ", ".join(f"{number} {kind}" for kind, number in sorted(found.items())))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
