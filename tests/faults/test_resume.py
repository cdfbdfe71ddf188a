#!/usr/bin/env python3
"""An interrupted run is continued with --resume, and its files are those of an uninterrupted run.

usage: test_resume.py LIBRARY_TO_PRELOAD [--all [MOST]]

Runs end in two ways: at an error of the input that is mended afterwards, in front of each case, which leaves whole files; and as by
kill -9 at any call that writes, closes, renames or opens a file. --all takes all examples, MOST cases of each and as many places
of a kill (all cases and 40 places unless given, which takes hours); without it a choice is taken.
"""
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import time

try:
    import runs
except ImportError as reason:
    print(f"SKIPPED: {reason}")
    sys.exit(77)

SEED = 14
#: Sequences of shifts and rolling, steps, slip and friction memory, plasticity, relaxation, temperatures; one and several patches
CHOICE = ("bentall", "layer_traction")


def shift(fx, link=0, first=False, element="", estimate=1, mat=1, stored=1):
    """A shift of a ball by a force; each but the first keeps what it can"""
    text = f"3 {element} MODULE\n{2 if first else link}01120 P B T N F S\n"
    text += "0022020 V L D C M Z E\n" if first else "0101001 V L D C M Z E\n"
    text += f"00{0 if first else 1}{0 if first else estimate}{mat}2{0}{stored} X H G I A O W R\n"
    text += "100 100 30 1 1e-5\n" if first else ""
    text += f"9.1954 {fx} 0 0\n"
    if first:
        text += "0.4 0.4\n0.42 0.42 200 200\n1\n13 13 -1.3 -1.3 0.2 0.2\n1 1\n0.01 0 0.01 0 0 0\n"
    return text


def sequences():
    """Inputs with data that a resumed run must restore: histories, repeated steps, interleaved result elements, checked cases"""
    steps = (-0.3, -0.6, -0.875, -0.5, 0.2)
    plain = shift(-0.2, first=True) + "".join(shift(fx) for fx in steps)
    repeated = shift(-0.2, first=True) + shift(-0.5) + shift(-0.6, link=3) + shift(-0.7, link=1) + shift(-0.8, estimate=0)
    fresh = (shift(-0.2, first=True) + shift(-0.5) + shift(-0.6, link=2, estimate=0) + shift(-0.7) + shift(-0.8, link=2)
             + shift(-0.1))
    mixed = (shift(-0.2, first=True, element="1") + shift(-0.3, first=True, element="2") + shift(-0.5, element="1")
             + shift(-0.6, element="2", stored=3) + shift(-0.7, element="1") + shift(-0.8, element="2") + shift(-0.1, element="1"))
    # truncated contact: a larger window is recommended once
    cut = plain.replace("13 13 -1.3 -1.3 0.2 0.2", "5 5 -0.5 -0.5 0.2 0.2")
    return {name: text + "0 MODULE\n" for name, text in
            (("plain", plain), ("cut", cut), ("repeated", repeated), ("fresh", fresh), ("mixed", mixed))}


def prepare(folder, name, text):
    """The input of a run in an empty folder"""
    shutil.rmtree(folder, ignore_errors=True)
    runs.example(folder, name) if text is None else folder.mkdir(parents=True)
    if text is not None:
        (folder / f"{name}.inp").write_text(text)


def plain(folder):
    """The number of planned cases differs while the input cannot be read to its end"""
    for file in folder.glob("*.jsonl"):
        file.write_text(re.sub(r'"cases_planned":\d+', "", file.read_text()))


def resumed(folder, name):
    """Exit status and messages of the second part"""
    done = subprocess.run([runs.PROGRAM, "--resume", "2", name], cwd=folder, env=dict(os.environ, OMP_NUM_THREADS="1"),
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace", timeout=600)
    return done.returncode, done.stdout + done.stderr


class Campaign:
    def __init__(self, preload, everything, most):
        self.preload, self.everything, self.most = preload, everything, most
        self.chance = random.Random(SEED)
        self.failed = self.checks = self.went_on = 0

    def complain(self, text):
        self.failed += 1
        print("FAILED", text, flush=True)

    def judge(self, what, good, bad, name, must_go_on):
        """Resume, and compare all files"""
        self.checks += 1
        code, text = resumed(bad, name)
        went_on = "finished before" in text
        self.went_on += went_on
        if code != self.code or (must_go_on and not went_on):
            self.complain(f"{what}: status {code}: {text[-300:]}")
            return
        plain(bad)
        for complaint in runs.differences(good, bad):
            self.complain(f"{what}: {complaint}")
            return

    def run_one(self, name, text):
        good, bad = pathlib.Path.cwd() / "good", pathlib.Path.cwd() / "bad"
        prepare(good, name, text)
        self.code, said = runs.run(good, name, *runs.ALL_FILES, "--strict")
        lines = (good / f"{name}.inp").read_text().split("\n")
        cases = [json.loads(line) for line in (good / f"{name}.jsonl").read_text().splitlines()]
        if self.code == 1 or not cases[-1]["run"]["complete"]:
            self.complain(f"{name} is no good run: {said}")
            return
        code, said = resumed(good, name)
        if code or "nothing to resume" not in said:
            self.complain(f"{name} is complete, but resuming it: {code}, {said}")
        plain(good)
        starts = [case["line"] for case in cases[:-1]]
        self.code = 0
        boundaries = list(range(1, len(starts)))
        if len(boundaries) > self.most:
            boundaries = sorted(self.chance.sample(boundaries, self.most))
        for k in boundaries:
            prepare(bad, name, text)
            (bad / f"{name}.inp").write_text("\n".join("nonsense" if i + 1 == starts[k] else line for i, line in enumerate(lines)))
            code, said = runs.run(bad, name, *runs.ALL_FILES)
            if code != 1 or "nonsense" not in said:
                self.complain(f"{name} with nonsense in front of case {k + 1}: {code}, {said}")
            (bad / f"{name}.inp").write_text("\n".join(lines))
            self.judge(f"{name}, mended at case {k + 1}", good, bad, name, True)
        self.kill_some(name, text)

    def kill_some(self, name, text):
        """As by kill -9, with and without the HDF5 file, which contains the cases that were finished at its last update"""
        most = min(self.most, 40)
        for options, sample in ((("--json", "--vtk"), most if self.everything else 3),
                                (runs.ALL_FILES, most // 2 if self.everything else 2)):
            self.kill(name, text, options, sample)

    def kill(self, name, text, options, sample):
        """The same with some files, at the given number of system calls"""
        good, bad, count = pathlib.Path.cwd() / "killed-good", pathlib.Path.cwd() / "bad", pathlib.Path.cwd() / "count"
        prepare(good, name, text)
        inject = {"LD_PRELOAD": self.preload, "INJECT_CALL": "any", "INJECT_FOLDER": str(good) + "/", "INJECT_COUNT": str(count)}
        code, said = runs.run(good, name, *options, environment=inject)
        assert code == 0, said
        calls = int(count.read_text())
        for at in sorted(self.chance.sample(range(1, calls + 1), min(calls, sample))):
            prepare(bad, name, text)
            code, said = runs.run(bad, name, *options, environment=dict(
                inject, INJECT_AT=str(at), INJECT_ERROR="-1", INJECT_FOLDER=str(bad) + "/"))
            what = f"{name}, killed at call {at} of {calls}"
            if code == 0:  # the number of writes depends on time
                continue
            if code != 137:
                self.complain(f"{what}: status {code}, {said[-300:]}")
                continue
            try:
                held = runs.finished_cases(bad)
                assert held.get("h5", 0) <= held.get("jsonl", 0) + 1, held
            except (AssertionError, OSError, ValueError, KeyError, SyntaxError) as reason:
                self.complain(f"{what}: a file cannot be read: {reason!r}")
            code, said = resumed(bad, name)
            if "ordinary run" in said:  # no case was finished, and the journal not started
                code, said = runs.run(bad, name, *options)
            self.checks += 1
            self.went_on += "finished before" in said
            left = [complaint for complaint in runs.differences(good, bad)
                    if not complaint.endswith((".tmp is left", ".part is left"))]
            if code or left:
                self.complain(f"{what}: {code}, {left[:2] or said[-300:]}")


def refusals():
    """A run that cannot be resumed is refused in one sentence, without changes"""
    bad, complaints = pathlib.Path.cwd() / "bad", []
    text = sequences()["plain"]
    broken = text.replace("9.1954 0.2", "9.1954 nonsense")
    assert broken != text

    def judge(what, change, *options, expected):
        prepare(bad, "x", broken)
        runs.run(bad, "x", "--json")
        change()
        before = {file.name: file.read_bytes() for file in bad.iterdir()}
        code, said = runs.run(bad, "x", "--resume", *options)
        after = {file.name: file.read_bytes() for file in bad.iterdir()}
        if code != 1 or expected not in said or said.count("ERROR") != 1 or before != after:
            complaints.append(f"{what}: {code}, {said}, changed {[name for name in after if before.get(name) != after[name]]}")

    judge("changed input", lambda: (bad / "x.inp").write_text(text.replace("-0.6", "-0.61")), expected="the input was changed")
    judge("shorter input", lambda: (bad / "x.inp").write_text(text[:200]), expected="the input was changed")
    judge("another file", lambda: None, "--hdf5", expected="without --hdf5")
    judge("standard output", lambda: None, "--json=-", expected="--json=- does not go with --resume")
    judge("other temperatures", lambda: None, "--heat", "moving-source", expected="--heat")
    judge("another solver", lambda: None, "--classical", expected="--classical")
    prepare(bad, "x", text)
    code, said = runs.run(bad, "x", "--resume")
    if code or not (bad / "x.out").exists():
        complaints.append(f"nothing to resume: {code}, {said}")
    return complaints


def damaged_journals():
    """One character of the journal is changed: the run starts again or is refused, and no file becomes wrong"""
    good, bad, complaints = pathlib.Path.cwd() / "good", pathlib.Path.cwd() / "bad", []
    text = sequences()["plain"]
    prepare(good, "x", text)
    runs.run(good, "x", "--json")
    plain(good)
    chance = random.Random(SEED)
    prepare(bad, "x", text.replace("9.1954 0.2", "9.1954 nonsense"))
    runs.run(bad, "x", "--json")
    kept = {file.name: file.read_bytes() for file in bad.iterdir()}
    noted = kept["x.unfinished"]
    ends = [k for k, byte in enumerate(noted) if byte == 10]
    # characters of the settings, and of the lines of cases
    places = [k for k in range(ends[0] + 1, ends[1]) if noted[k:k + 1].strip()]
    for at in sorted(chance.sample(places, 12) + chance.sample(range(ends[1] + 1, len(noted)), 8)):
        for name, content in kept.items():
            (bad / name).write_bytes(content)
        other = {84: 70, 70: 84}.get(noted[at], 49 if noted[at] == 48 else 48)
        if other == noted[at]:
            continue
        (bad / "x.inp").write_text(text)
        (bad / "x.unfinished").write_bytes(noted[:at] + bytes([other]) + noted[at + 1:])
        code, said = resumed(bad, "x")
        if code == 1 and said.count("ERROR") == 1:
            continue
        if "ordinary run" in said:
            code, said = runs.run(bad, "x", "--json")
        plain(bad)
        complaints += [f"journal damaged at {at}: {code}, {complaint}" for complaint in runs.differences(good, bad)]
        for file in bad.iterdir():
            if file.name not in kept:
                file.unlink()
    return complaints


def profile_is_seen():
    """A profile that has changed since"""
    bad = pathlib.Path.cwd() / "bad"
    prepare(bad, "wheel_on_rail", None)
    file = bad / "wheel_on_rail.inp"
    lines = file.read_text().split("\n")
    first = next(k for k, line in enumerate(lines) if "1 MODULE" in line)
    second = next(k for k, line in enumerate(lines) if "1 MODULE" in line and k > first)
    file.write_text("\n".join(lines[:second] + ["nonsense"]))
    runs.run(bad, "wheel_on_rail")
    file.write_text("\n".join(lines[:second] + ["0 MODULE", ""]))
    profile = bad / "profiles" / "S1002.prw"
    profile.write_text(profile.read_text() + "\n")
    code, said = runs.run(bad, "wheel_on_rail", "--resume")
    return [] if code == 1 and "a profile or another file" in said else [f"changed profile: {code}, {said}"]


def main():
    """Examples and sequences"""
    started = time.time()
    everything = "--all" in sys.argv
    campaign = Campaign(sys.argv[1], everything, int(sys.argv[3]) if len(sys.argv) > 3 else 10**9 if everything else 2)
    for name, text in sequences().items():
        campaign.run_one(name, text)
    names = sorted(file.stem for file in runs.EXAMPLES.glob("*.inp")) if campaign.everything else CHOICE
    for name in names:
        before = time.time()
        campaign.run_one(name, None)
        if campaign.everything:
            print(f"{name}: {time.time() - before:.0f} s", flush=True)
    for complaint in refusals() + damaged_journals() + profile_is_seen():
        campaign.complain(complaint)
    print(f"seed {SEED}: {campaign.checks} interrupted runs, {campaign.went_on} went on behind finished cases, {campaign.failed} "
          f"complaints, {time.time() - started:.0f} s")
    return 1 if campaign.failed else 0


if __name__ == "__main__":
    sys.exit(main())
