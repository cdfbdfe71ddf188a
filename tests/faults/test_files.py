#!/usr/bin/env python3
"""A system call on a file fails, or the process is killed there, at every such call of a small run.

usage: test_files.py LIBRARY_TO_PRELOAD [STEP [FIRST]]

After a failure: success with right files, or an error, and nothing half-written that could be taken for whole. After a kill:
every file can be read, and holds all cases up to the last but one or two. Every STEP-th place is tried, by default 37;
FIRST, from 0 to below STEP, chooses which of them, so that STEP runs try all places.
"""
import errno
import pathlib
import re
import shutil
import sys
import time
import xml.etree.ElementTree

try:
    import runs
except ImportError as reason:
    print(f"SKIPPED: {reason}")
    sys.exit(77)

ROOM = pathlib.Path.cwd()
#: Kinds of runs: example, cases of it that are kept, options
KINDS = {
    "all files": ("cattaneo", 2, runs.ALL_FILES),
    "report only": ("cattaneo", 2, ()),
    "stresses": ("subsurface", 1, ("--vtk",)),
    "sequence": ("catt_to_cart", 4, ("--json",)),
    "wheel on rail": ("single_wheel", 2, ("--json", "--vtk")),
    "wheel on rail, HDF5": ("single_wheel", 2, ("--hdf5",)),
}
#: What fails: call, errno, all later ones too; -1 ends the process, -2 is a write of half of its bytes, which is no failure
FAULTS = [(call, error, for_ever)
          for call, errors in (("write", (errno.EIO, errno.ENOSPC)), ("close", (errno.EIO,)), ("rename", (errno.EACCES,)),
                               ("open", (errno.EMFILE,)), ("fsync", (errno.EIO,)))
          for error in errors for for_ever in ((False, True) if error in (errno.ENOSPC, errno.EMFILE) else (False,))]
FAULTS += [("write", errno.EINTR, False), ("write", -2, False), ("any", -1, False)]


def shortened(text, cases):
    """The first cases of an input"""
    lines, found = text.split("\n"), 0
    for k, line in enumerate(lines):
        if re.match(r"\s*[13](\s+\d+)*\s+(MODULE|%)", line) or re.match(r"[13]\s*$", line):
            found += 1
            if found > cases:
                return "\n".join(lines[:k] + ["0 MODULE", ""])
    return text


def prepare(folder, kind):
    """The input of a kind of run in an empty folder; its name and options"""
    name, cases, options = KINDS[kind]
    shutil.rmtree(folder, ignore_errors=True)
    runs.example(folder, name)
    file = folder / f"{name}.inp"
    text = shortened(file.read_text(), cases)
    file.write_text(text)
    return name, options


def run(folder, kind, preload, **inject):
    """Exit status and messages of a run into an empty folder"""
    name, options = prepare(folder, kind)
    settings = {key: str(value) for key, value in inject.items() if value is not None}
    return runs.run(folder, name, *options, environment=dict(LD_PRELOAD=preload, INJECT_FOLDER=str(folder) + "/", **settings),
                    timeout=60)


def half_written(file):
    """Is this file, which exists after an error, unreadable?"""
    try:
        if file.suffix == ".h5":
            runs.read_all(file)
        elif file.suffix in (".vts", ".mat", ".subs"):
            runs.check_whole(file)
        elif file.suffix == ".jsonl":
            for line in file.read_text(encoding="utf-8").splitlines():
                runs.json.loads(line)
        elif file.suffix == ".pvd":
            xml.etree.ElementTree.parse(file)
    except (OSError, ValueError, AssertionError, KeyError, xml.etree.ElementTree.ParseError) as reason:
        return repr(reason)
    return ""


def after_kill(folder):
    """Complaints about the files of a run that was killed"""
    try:
        runs.finished_cases(folder)
    except (OSError, ValueError, AssertionError, KeyError, xml.etree.ElementTree.ParseError) as reason:
        return [repr(reason)]
    return []


def after_failure(good, folder, code, text):
    """Complaints about the files of a run in which a call has failed"""
    names = {file.name for file in folder.iterdir() if file.is_file()}
    if code == 0:
        return runs.differences(good, folder)
    bad = [] if "ERROR" in text else [f"no message with exit status {code}"]
    bad += [f"{name} is left" for name in sorted(names) if name.endswith((".tmp", ".part"))]
    for name in sorted(names):
        # files that grow from case to case may be truncated; the message names them
        growing = name.endswith((".jsonl", ".pvd")) and f"{name}: the file is not complete" in text
        what = half_written(folder / name)
        if what and not growing:
            bad.append(f"{name}: {what}")
        # a case without results has no surfaces, but is finished
        if name.endswith(".pvd") and "(writing VTK files)" in text:
            whole, found = (good / name).read_text(encoding="utf-8"), (folder / name).read_text(encoding="utf-8")
            if "<!-- complete" in found and found.count("<DataSet") < whole.count("<DataSet"):
                bad.append(f"{name} is marked as complete")
    return bad


#: Calls of which every occurrence is tested: renaming of the updated HDF5 file, which has no other effect, and reading of files
ALWAYS = (("rename", "wheel on rail, HDF5"), ("open", "wheel on rail, HDF5"))


def main():
    """All kinds, all faults"""
    preload, step, first = sys.argv[1], *(int(word) for word in (sys.argv[2:] + ["37", "0"][len(sys.argv) - 2:])[:2])
    good, folder, count_file = ROOM / "good", ROOM / "bad", ROOM / "count"
    table, complaints, started, turn = {}, 0, time.time(), 0
    for kind in KINDS:
        for call, error, for_ever in FAULTS:
            if (kind, call) not in table:
                code, text = run(good, kind, preload, INJECT_CALL=call, INJECT_COUNT=count_file)
                assert code == 0, text
                table[kind, call] = [int(count_file.read_text(encoding="utf-8")), 0, 0, 0]
            row = table[kind, call]
            count = row[0]
            for place in range(1, count + 1):
                turn += 1
                if turn % step != first and (call, kind) not in ALWAYS:
                    continue
                code, text = run(folder, kind, preload, INJECT_CALL=call, INJECT_AT=place, INJECT_ERROR=error,
                                 INJECT_FOR_EVER=1 if for_ever else None)
                row[1] += 1
                if error == -1:
                    # the number of writes depends on time: the last ones may not be reached
                    bad = after_kill(folder) if code in (0, 137) else [f"not killed: {code}"]
                elif code not in (0, 1) or (error == -2 and code):
                    bad = [f"ended with {code}: {text[-300:]}"]
                else:
                    row[2] += code == 0
                    bad = after_failure(good, folder, code, text)
                row[3] += len(bad) > 0
                complaints += len(bad)
                for complaint in bad:
                    print(f"FAILED {kind}, {call} {place} of {count}, error {error}{' and later' if for_ever else ''}: {complaint}",
                          flush=True)
    print("| run | call | places | faults | of these no failure of the run | complaints |\n|---|---|---|---|---|---|")
    for (kind, call), row in table.items():
        print(f"| {kind} | {call} | " + " | ".join(str(value) for value in row) + " |")
    print(f"{sum(row[1] for row in table.values())} faults, {complaints} complaints, {time.time() - started:.0f} s")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
