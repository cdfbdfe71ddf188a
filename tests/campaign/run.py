#!/usr/bin/env python3
"""Campaign of random cases, judged by methods that share no code with the program.

    python3 tests/campaign/run.py --exe build/release/bin/contact --module 3 --cases 5000 --seed 1 --jobs 2 --store FOLDER

The results of each case are appended to FOLDER/module3-SEED.jsonl; started again with the same FOLDER it goes on where it
was. Cases in which judges disagree stay in FOLDER with their input, reduced to the smallest that still disagrees. At the end
comes a table of kinds and rates. The exit status is 1 when there was a disagreement.

A kind of case is a Python module with
    generate(rng) -> scene           a dictionary of numbers and texts, all that the case is
    files(scene) -> {name: text}     its input; one of the names is run.inp
    labels(scene) -> [kind, ...]     rows of the table to which it belongs
    check(scene, tools) -> findings  see judge.finding; an empty list means that all judges agreed
    reduce(scene) -> scenes          an iterator of simpler scenes
"""
import argparse
import collections
import importlib
import json
import multiprocessing
import os
import random
import shutil
import sys
import time
import traceback

try:
    import numpy  # noqa: F401
except ImportError:
    print("SKIPPED: there is no numpy")
    sys.exit(77)

import judge
import minimise

HERE = os.path.dirname(os.path.abspath(__file__))
STATES = ("agreed", "refused", "not converged", "open", "disagreement")


def kind_of(number):
    return importlib.import_module(f"module{number}")


def status_of(findings):
    """The most severe status of a list of findings"""
    found = {item["status"] for item in findings}
    return next((status for status in reversed(STATES) if status in found), "agreed")


def scene_of(module, seed, index):
    """The scene of one case: it depends on seed and index only"""
    return kind_of(module).generate(random.Random(f"{module}:{seed}:{index}"))


def judged(module, scene, options, folder):
    """Findings of one scene; an exception in a judge is a disagreement, too"""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    tools = judge.Tools(options.exe, options.library, options.python_path, folder, options.limit)
    try:
        return kind_of(module).check(scene, tools)
    except judge.Unreadable as error:
        return [judge.finding("files", str(error))]
    except Exception:  # a judge must not end the campaign
        return [judge.finding("judge", traceback.format_exc()[-1500:])]


def work(task):
    """One case in a worker process"""
    module, index, options = task
    begin = time.process_time()
    folder = os.path.join(options.store, f"scratch{os.getpid()}")
    scene = scene_of(module, options.seed, index)
    findings = judged(module, scene, options, folder)
    record = {"index": index, "status": status_of(findings), "labels": kind_of(module).labels(scene), "findings": findings,
              "seconds": round(time.process_time() - begin, 3)}
    if record["status"] == "disagreement":
        place = os.path.join(options.store, f"module{module}-{options.seed}-{index:06d}")
        record["place"] = place
        keep(kind_of(module), scene, findings, place)
        if options.minimise:
            def still(simpler):
                return judged(module, simpler, options, folder)
            scene, findings = minimise.smallest(kind_of(module), scene, findings, still, options.minimise)
            keep(kind_of(module), scene, findings, place + "-minimal")
    shutil.rmtree(folder, ignore_errors=True)
    return module, record


def keep(kind, scene, findings, folder):
    """Store a scene with its input and its findings"""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    for name, text in kind.files(scene).items():
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    with open(os.path.join(folder, "scene.json"), "w", encoding="utf-8") as file:
        json.dump({"scene": scene, "findings": findings}, file, indent=1)


def results_file(options, module):
    return os.path.join(options.store, f"module{module}-{options.seed}.jsonl")


def earlier_results(options, module):
    """Records of an earlier run by index; a case with a truncated line is repeated"""
    records = {}
    try:
        with open(results_file(options, module), encoding="utf-8") as file:
            for line in file:
                try:
                    record = json.loads(line)
                except ValueError:
                    continue
                records[record["index"]] = record
    except OSError:
        pass
    return records


def table(records):
    """The table of kinds and rates, then the reasons of disagreements"""
    rows = collections.OrderedDict()
    reasons = {status: collections.Counter() for status in STATES[1:]}
    for record in records:
        for label in ["all"] + sorted(record["labels"]):
            row = rows.setdefault(label, collections.Counter())
            row["cases"] += 1
            row[record["status"]] += 1
        for item in record["findings"]:
            if item["status"] != "disagreement":
                reasons[item["status"]][item["what"]] += 1
            else:
                reasons["disagreement"][item["judge"]] += 1
    lines = ["| kind | cases | " + " | ".join(STATES) + " |", "|---|---|" + "---|"*len(STATES)]
    for label in ["all"] + sorted(set(rows) - {"all"}):
        row = rows.get(label, collections.Counter())
        lines.append(f"| {label} | {row['cases']} | " + " | ".join(str(row[status]) for status in STATES) + " |")
    for status, counter in reasons.items():
        if counter:
            lines += ["", f"| {status} | times |", "|---|---|"]
            lines += [f"| {what.replace('|', '/')} | {count} |" for what, count in counter.most_common()]
    return "\n".join(lines)


def campaign(module, options):
    """All cases of one module; whether there was a disagreement"""
    records = {} if options.fresh else earlier_results(options, module)
    indices = [options.only] if options.only is not None else range(options.cases)
    tasks = [(module, index, options) for index in indices if index not in records or options.only is not None]
    print(f"module {module}: seed {options.seed}, {len(indices)} cases, {len(tasks)} to do, store {options.store}", flush=True)
    begin = time.time()
    with open(results_file(options, module), "w" if options.fresh else "a", encoding="utf-8") as file:
        def note(answer):
            _, record = answer
            records[record["index"]] = record
            file.write(json.dumps(record) + "\n")
            file.flush()
            if record["status"] == "disagreement":
                for item in record["findings"]:
                    if item["status"] == "disagreement":
                        print(f"  seed {options.seed} case {record['index']}: {item['judge']}: {item['what']}"
                              f" {item.get('size', '')} > {item.get('limit', '')}", flush=True)

        late = False
        if options.jobs == 1:
            for task in tasks:
                note(work(task))
                late = bool(options.seconds) and time.time() - begin > options.seconds
                if late:
                    break
        else:
            with multiprocessing.Pool(options.jobs, maxtasksperchild=200) as pool:
                for answer in pool.imap_unordered(work, tasks, chunksize=1):
                    note(answer)
                    late = bool(options.seconds) and time.time() - begin > options.seconds
                    if late:
                        pool.terminate()
                        break
        if late:
            print(f"ended after {options.seconds} s; start again to go on")
    done = [records[index] for index in sorted(records)]
    print(f"\nmodule {module}, seed {options.seed}, {len(done)} cases, {time.time() - begin:.0f} s\n")
    print(table(done))
    return any(record["status"] == "disagreement" for record in done)


def replay(options):
    """Judge scenes that are stored in files; whether there was a disagreement"""
    bad = False
    for path in options.scenes:
        with open(path, encoding="utf-8") as file:
            scene = json.load(file)["scene"]
        module = scene["module"]
        folder = os.path.join(options.store, f"scratch{os.getpid()}")
        findings = judged(module, scene, options, folder)
        if options.reduce and status_of(findings) == "disagreement":
            scene, findings = minimise.smallest(kind_of(module), scene, findings, lambda simpler, kind=module,
                                                folder=folder: judged(kind, simpler, options, folder), options.minimise)
            keep(kind_of(module), scene, findings, os.path.join(options.store, "minimal"))
        shutil.rmtree(folder, ignore_errors=True)
        bad = bad or status_of(findings) == "disagreement"
        print(f"{path}: {status_of(findings)}")
        for item in findings:
            print(f"  {item}")
    return bad


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--exe", default=os.environ.get("CONTACT_PROGRAM", "build/release/bin/contact"))
    parser.add_argument("--library", default=None, help="libcontact.so; default lib/ beside the folder of the program")
    parser.add_argument("--module", choices=("1", "3", "both"), default="both")
    parser.add_argument("--cases", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--store", default="campaign")
    parser.add_argument("--limit", type=float, default=60.0, help="seconds of processor time that one run of the program may take")
    parser.add_argument("--seconds", type=float, default=0.0, help="end the campaign after this time; started again it goes on")
    parser.add_argument("--only", type=int, default=None, help="one case by its number, done anew")
    parser.add_argument("--fresh", action="store_true", help="forget earlier results")
    parser.add_argument("--scenes", nargs="+", help="judge these stored scenes (files scene.json) and nothing else")
    parser.add_argument("--reduce", action="store_true", help="reduce a stored scene that disagrees, into STORE/minimal")
    parser.add_argument("--minimise", type=int, default=60, help="trials to reduce a disagreement, 0 for none")
    options = parser.parse_args()
    options.exe = os.path.abspath(options.exe)
    if options.library is None:
        options.library = os.path.join(os.path.dirname(os.path.dirname(options.exe)), "lib", "libcontact.so")
    options.library = os.path.abspath(options.library)
    options.python_path = os.path.join(os.path.dirname(os.path.dirname(HERE)), "python")
    options.store = os.path.abspath(options.store)
    return options


def main():
    options = arguments()
    os.makedirs(options.store, exist_ok=True)
    if options.scenes:
        return 1 if replay(options) else 0
    modules = ("1", "3") if options.module == "both" else (options.module,)
    return 1 if any(campaign(module, options) for module in modules) else 0


if __name__ == "__main__":
    sys.path.insert(0, HERE)
    sys.exit(main())
