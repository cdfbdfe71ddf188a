#!/usr/bin/env python3
"""Plant faults in a copy of the sources and see which of them the tests catch.

usage: plant.py [--seed N] [--count N] [--store FOLDER] [--again] [--renew] [--measure] [--only ROOM ...] [--limit S] [--table]
                [--chosen-at COMMIT] [--every N]

    --seed N        faults that are chosen [1]
    --count N       how many, over all rooms, most of them at the doors [240]
    --store FOLDER  the copy, its build and the results [build/planted below the checkout]
    --again         judge those once more that were not caught
    --renew         take the sources as they are committed now, and build them
    --measure       find out again which test reaches which line
    --only ROOM     these rooms only
    --limit S       seconds of tests for one fault [240]
    --table         only write the table of what is known
    --chosen-at C   choose from the sources of this commit, so that a seed means the faults of an earlier campaign; judge them in
                    the sources of now, as far as their lines are still there
    --every N       judge every N-th of the faults only

One after the other: write the fault, compile its file, link, run the tests that reach the line until one fails. Which tests
reach a line is measured once with gcov, and again with --measure. Results are lines of FOLDER/results.jsonl, the last one of a
fault counts; a campaign that was ended goes on where it was. Faults of which the object file is the same as without them are
replaced, and those of equivalent.json, which were judged by hand, are no loss. Tests run without the reference data.
"""
import argparse
import collections
import json
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import faults

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parent.parent
# Faults in each room, of 240
ROOMS = {"input": 24, "control": 12, "capi": 30, "output": 22, "hdf5": 10, "experiment": 12, "cases": 20, "cli": 6, "python": 10,
         "matlab": 10, "base": 4, "text": 6, "fft": 2, "numeric": 4, "profile": 8, "grid": 3, "elastic": 7, "normal": 6,
         "friction": 3, "temperature": 2, "subsurface": 5, "tangential": 8, "simplified": 4, "patch": 8, "wheelrail": 14}
# Tests of sources or pictures, and tests that need a static library or the clock, or are slow
NOT_THESE = re.compile(r"capi_statics|capi_consumer|capi_types|capi_generated|harness|house|performance|make_profiles|planted|"
                       r"octave_figures|force_search|worn_profiles|capi_wheel$|faults_of|fuzz")
# Coverage of scripts is not measured: tests that run them, fastest first
SCRIPTS = {"python": re.compile(r"capi_(?!host)|report_|hdf5_file|campaign|json|doubts"), "matlab": re.compile("octave")}
# Lines that gcov does not see because the process was ended from outside
UNSEEN = re.compile("limits|capi_host_traps")
# Drawing, which is judged by eye only
NOT_THESE_FILES = re.compile(r"private/(draw_|finish_colors|set_colors|is_black|line_options|pick_arrows)|"
                             r"plot|Contents|setup\.py")
# Tests with other processes, sockets, clocks or threads
SENSITIVE = re.compile("host|server|threads|limits|command_line|rounds|messages|timers|robust|vtk")
# Tests that compare many values from input to output
VALUES = re.compile("settings|outputs|linked|published|grids|doubts|capi_python_package")
LIBRARIES = ["lib/libcontact_all_rooms.so", "lib/libcontact.so", "bin/contact_addon_linux64.so"]  # links are followed
MEMORY = 12 << 30


class Store:
    """The copy of the sources, its build, and the results"""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder).resolve()
        self.source = self.folder / "source"
        self.build = self.folder / "build"
        self.work = self.folder / "work"

    def read_lines(self, name):
        path = self.folder / name
        return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()] if path.exists() else []

    def add_line(self, name, value):
        with open(self.folder / name, "a", encoding="utf-8") as file:
            file.write(json.dumps(value) + "\n")

    def read(self, name):
        path = self.folder / name
        return json.loads(path.read_text(encoding="utf-8")) if path.exists() else None

    def write(self, name, value):
        (self.folder / name).write_text(json.dumps(value), encoding="utf-8")

    def libraries(self):
        """Files that a fault changes, below the build folder"""
        return [os.path.relpath(os.path.realpath(self.build / name), self.build) for name in LIBRARIES]

    # The copy ------------------------------------------------------------------------------------------------------
    def prepare(self, renew, measure):
        """Copy, build and measure as far as necessary"""
        self.folder.mkdir(parents=True, exist_ok=True)
        if renew or not self.source.exists():
            self.copy_sources()
            (self.folder / "built").unlink(missing_ok=True)
        if not (self.folder / "built").exists():
            self.compile()
            (self.folder / "built").touch()
        if measure:
            shutil.rmtree(self.folder / "reach", ignore_errors=True)
        self.measure()

    def copy_sources(self):
        """Committed files; only changed ones get a new date, so that little is compiled"""
        fresh = self.folder / "fresh"
        shutil.rmtree(fresh, ignore_errors=True)
        fresh.mkdir()
        commit = subprocess.run(["git", "-C", TOP, "rev-parse", "HEAD"], check=True, capture_output=True, text=True).stdout.strip()
        archive = subprocess.run(["git", "-C", TOP, "archive", commit], check=True, capture_output=True).stdout
        subprocess.run(["tar", "-x", "-C", fresh], input=archive, check=True)
        present = {str(p.relative_to(fresh)) for p in fresh.rglob("*") if p.is_file()}
        if self.source.exists():
            for path in list(self.source.rglob("*")):
                if path.is_file() and str(path.relative_to(self.source)) not in present:
                    path.unlink()
        for name in present:
            old, new = self.source / name, fresh / name
            if not old.exists() or old.read_bytes() != new.read_bytes():
                old.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(new, old)
        shutil.rmtree(fresh)
        self.write("commit.json", commit)

    def compile(self):
        """Build program, libraries and tests; keep a copy of the libraries without a fault"""
        configure = ["cmake", "-G", "Ninja", "-S", self.source, "-B", self.build, "-DCMAKE_BUILD_TYPE=None",
                     "-DCMAKE_Fortran_FLAGS=-O1",
                     "-DCMAKE_C_FLAGS=-O1", "-DCONTACT_SHARED_ROOMS=ON", "-DCONTACT_REFERENCE=/nonexistent"]
        subprocess.run(configure, check=True, stdout=subprocess.DEVNULL)
        if (self.folder / "right").exists():
            # a library with a fault may be left by an interrupted campaign
            self.restore()
        subprocess.run(["ninja", "-C", self.build, "-k", "0"], check=True, stdout=subprocess.DEVNULL)
        kept = self.folder / "right"
        kept.mkdir(exist_ok=True)
        commands = {}
        for name in self.libraries():
            shutil.copy2(self.build / name, kept / os.path.basename(name))
            last = subprocess.run(["ninja", "-C", self.build, "-t", "commands", name], check=True, capture_output=True,
                                  text=True).stdout
            last = last.rstrip().rsplit("\n", 1)
            commands[name] = last[-1]
        compile_all = subprocess.run(["ninja", "-C", self.build, "-t", "compdb"], check=True, capture_output=True, text=True).stdout
        objects = {}
        for entry in json.loads(compile_all):
            output = entry.get("output", "")
            # the compilation, not the search for modules
            if output.startswith("src/CMakeFiles/") and output.endswith(".f90.o") and " -c " in entry["command"]:
                file = re.sub(r"^src/CMakeFiles/contact_\w+\.dir/", "src/", output)[:-2]
                objects[file] = {"object": output, "command": entry["command"]}
        self.write("commands.json", {"link": commands, "compile": objects})
        self.write("tests.json", self.list_tests())

    def list_tests(self):
        """Command, folder and environment of each test"""
        listing = subprocess.run(["ctest", "--test-dir", self.build, "--show-only=json-v1"], check=True, capture_output=True,
                              text=True).stdout
        tests = {}
        for test in json.loads(listing)["tests"]:
            properties = {p["name"]: p["value"] for p in test.get("properties", [])}
            if NOT_THESE.search(test["name"]) or properties.get("WILL_FAIL") or "long" in properties.get("LABELS", []):
                continue
            tests[test["name"]] = {"command": test["command"], "folder": properties["WORKING_DIRECTORY"],
                                   "label": properties["LABELS"][0],
                                   "environment": dict(line.split("=", 1) for line in properties.get("ENVIRONMENT", []))}
        return tests

    def compile_file(self, file, source, output, extra=()):
        """Compile a source instead of a file of src; True on success"""
        command = self.commands["compile"][file]["command"]
        command = command.split("&&")[0] if "&&" in command else command
        words = list(command.replace("\\(", "(").replace("\\)", ")").split())
        result, k = [], 0
        while k < len(words):
            word = words[k]
            if word.startswith("-J"):
                result += ["-I" + word[2:], "-J" + str(self.work)]
            elif word == "-fpreprocessed":
                pass
            elif word in ("-o", "-c"):
                k += 1
            else:
                result.append(word)
            k += 1
        done = subprocess.run(result + list(extra) + ["-c", str(source), "-o", str(output)], cwd=self.build, capture_output=True,
                              text=True)
        return done.returncode == 0

    def link(self, replaced, names):
        """Link these libraries with some objects replaced"""
        for name in names:
            command = self.commands["link"][name]
            for old, new in replaced.items():
                command = command.replace(" %s " % old, " %s " % new)
            done = subprocess.run(command, shell=True, cwd=self.build, capture_output=True, text=True)
            if done.returncode:
                return False
        return True

    @staticmethod
    def needs(test, library):
        """Does a test use this library? Linking takes as long as many tests"""
        host = re.search("capi|library|campaign|report|wheel$", test)
        return bool(host) if "contact.so" in library else bool(re.search("interface|library|wheel$",
                                                                         test)) if "addon" in library else True

    def restore(self):
        """Restore the libraries without a fault"""
        for name in self.libraries():
            target = self.build / name
            target.unlink(missing_ok=True)
            shutil.copy2(self.folder / "right" / os.path.basename(name), target)

    def load(self):
        """Load the data of the build; a script with a fault, left by an interrupted campaign, is restored"""
        changed = self.read("changed.json")
        if changed:
            pathlib.Path(changed["path"]).write_text(changed["text"], encoding="utf-8", errors="surrogateescape")
        self.commands = self.read("commands.json")
        self.tests = self.read("tests.json")
        shutil.rmtree(self.work, ignore_errors=True)
        self.work.mkdir(exist_ok=True)

    def run_test(self, name, limit, **more):
        """Run a test; outcome passed, failed, skipped or late, and its time [s]"""
        test = self.tests[name]
        environment = {**os.environ, "OMP_NUM_THREADS": "1", **test["environment"], "CONTACT_REFERENCE": "/nonexistent",
                       "CONTACT_PYTHON": str(self.source / "python"), **{key: str(value) for key, value in more.items()}}
        os.makedirs(test["folder"], exist_ok=True)
        started = time.monotonic()

        def limits():
            os.setsid()
            if "browser" not in name:
                resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 30, 1 << 30))
        with open(self.folder / "last_test.txt", "wb") as output:
            process = subprocess.Popen(test["command"], cwd=test["folder"], env=environment, stdin=subprocess.DEVNULL,
                                       stdout=output,
                                       stderr=subprocess.STDOUT, preexec_fn=limits)
            try:
                status = process.wait(limit)
                outcome = {0: "passed", 77: "skipped"}.get(status, "failed")
            except subprocess.TimeoutExpired:
                outcome = "late"
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
            process.wait()
        return outcome, round(time.monotonic() - started, 2)

    # Which test reaches which line -----------------------------------------------------------------------------------
    def measure(self):
        """Run each test that was not run yet with objects that count lines"""
        self.load()
        (self.folder / "reach").mkdir(exist_ok=True)
        missing = sorted(name for name in self.tests if not (self.folder / "reach" / (name + ".json")).exists())
        if not missing:
            return
        counted = self.folder / "counted"
        counted.mkdir(exist_ok=True)
        replaced, failed = {}, []
        for file, entry in self.commands["compile"].items():
            output, source = counted / (file.replace("/", "__") + ".o"), self.source / file
            old = not output.exists() or output.stat().st_mtime < source.stat().st_mtime
            if old and not self.compile_file(file, source, output, ["--coverage"]):
                failed.append(file)
            replaced[entry["object"]] = output
        if failed:
            sys.exit("not compiled with --coverage: " + " ".join(failed))
        plain = dict(self.commands["link"])
        self.commands["link"] = {name: re.sub(r"(-shared )", r"--coverage \1", command, count=1) for name, command in plain.items()}
        if not self.link(replaced, self.libraries()):
            sys.exit("not linked with --coverage")
        for name in missing:
            counts = self.folder / "counts"
            shutil.rmtree(counts, ignore_errors=True)
            counts.mkdir()
            outcome, seconds = self.run_test(name, 600, GCOV_PREFIX=counts, GCOV_PREFIX_STRIP=99)
            reach = collections.defaultdict(list)
            found = sorted(counts.glob("*.gcda"))
            for path in found:
                note = counted / (path.stem + ".gcno")
                os.symlink(note, counts / note.name)
            if found:
                text = subprocess.run(["gcov", "--json-format", "--stdout"] + [p.name for p in found], cwd=counts,
                                      capture_output=True,
                                      text=True, check=False).stdout
                for line in text.splitlines():
                    for file in json.loads(line)["files"]:
                        if "/source/src/" in file["file"]:
                            short = file["file"].split("/source/", 1)[1]
                            reach[short] += sorted({item["line_number"] for item in file["lines"] if item["count"]})
            self.write("reach/%s.json" % name, {"outcome": outcome, "seconds": seconds, "lines": reach})
            print("%-40s %-8s %6.1f s, reaches %d files" % (name, outcome, seconds, len(reach)), flush=True)
        self.commands["link"] = plain
        self.restore()
        for name in missing:
            found = self.read("reach/%s.json" % name)
            if found["outcome"] in ("failed", "late"):
                # possibly due to the coverage counters
                found["outcome"], found["seconds"] = self.run_test(name, 600)
                self.write("reach/%s.json" % name, found)
                print("%-40s %-8s %6.1f s without counting" % (name, found["outcome"], found["seconds"]), flush=True)

    def read_reach(self):
        """Outcome of each test without a fault, and the tests that reach each line"""
        self.outcome, self.coverage = {}, collections.defaultdict(lambda: collections.defaultdict(set))
        for name in self.tests:
            found = self.read("reach/%s.json" % name)
            if found:
                self.outcome[name] = found
                for file, numbers in found.pop("lines").items():
                    for number in numbers:
                        self.coverage[file][number].add(name)

    # Faults ----------------------------------------------------------------------------------------------------------
    def choose(self, seed, rooms=tuple(ROOMS)):
        """All faults of each room in an order given by the seed, with alternating kinds and one fault a line"""
        order = {}
        for room in rooms:
            if room in SCRIPTS:
                files = sorted((self.source / room).rglob("*.py" if room == "python" else "*.m"))
            else:
                files = sorted((self.source / "src" / room).glob("*.f90"))
            by_kind = collections.defaultdict(list)
            for path in files:
                name = str(path.relative_to(self.source))
                if NOT_THESE_FILES.search(name) or name.endswith("cli/main.f90"):
                    continue
                for fault in faults.faults_of(name, path.read_text(encoding="utf-8", errors="surrogateescape")):
                    by_kind[fault.kind].append(fault)
            generator = random.Random("%d %s" % (seed, room))
            for items in by_kind.values():
                generator.shuffle(items)
            chosen, lines = [], set()
            while any(by_kind.values()) and len(chosen) < 400:
                kinds = sorted(kind for kind, items in by_kind.items() if items)
                generator.shuffle(kinds)
                for kind in kinds:
                    while by_kind[kind]:
                        fault = by_kind[kind].pop()
                        if (fault.file, fault.line) not in lines:
                            lines.add((fault.file, fault.line))
                            chosen.append(fault)
                            break
            order[room] = chosen
        return order

    def order_at(self, commit, seed):
        """As faults_of, with the sources of a commit"""
        with tempfile.TemporaryDirectory() as folder:
            old = Store(folder)
            old.source.mkdir()
            archive = subprocess.run(["git", "-C", TOP, "archive", commit], check=True, capture_output=True).stdout
            subprocess.run(["tar", "-x", "-C", old.source], input=archive, check=True)
            return old.choose(seed)

    def order_of_tests(self, fault, room, caught):
        """Tests that reach the fault, ordered by detections per time"""
        if room in SCRIPTS:
            names = [name for name in self.tests if SCRIPTS[room].search(name)]
            reached = True
        else:
            text = (self.source / fault.file).read_text(encoding="utf-8").split("\n")
            first = last = fault.line
            while first > 1 and text[first - 2].split("!")[0].rstrip().endswith("&"):
                first -= 1
            while text[last - 1].split("!")[0].rstrip().endswith("&"):
                last += 1
            known = self.coverage[fault.file]
            names = sorted({name for k in range(first, last + 1) for name in known.get(k, [])})
            reached = bool(names)
            if not reached:
                names = [name for name in self.tests if UNSEEN.search(name)]
        names = [name for name in names if self.outcome.get(name, {}).get("outcome") == "passed"]

        def cost(name):
            kind = self.tests[name]["label"]
            likely = 60 if VALUES.search(name) else {"unit": 4, "regression": 3, "analytic": 2, "property": 2, "campaign": 0.5,
                                                     "stability": 0.5}.get(kind, 1)
            return (self.outcome[name]["seconds"] + 0.3)/(likely + 4*caught[fault.file, name] + 2*caught[room, name]
                                                          + 0.2*caught["all", name])
        return sorted(names, key=cost), reached

    def place_of(self, fault):
        """Current path and number of the line of a fault: the nearest in its file, or the only one elsewhere; None if it is gone"""
        path = self.source / fault.file
        if path.exists():
            lines = path.read_text(encoding="utf-8", errors="surrogateescape").split("\n")
            near = [number for number, line in enumerate(lines, 1) if line == fault.old]
            if near:
                return path, min(near, key=lambda number: abs(number - fault.line))
        found = []
        for other in sorted((self.source / "src").rglob("*.f90")) if fault.file.startswith("src/") else []:
            lines = other.read_text(encoding="utf-8", errors="surrogateescape").split("\n")
            found += [(other, number) for number, line in enumerate(lines, 1) if line == fault.old]
        return found[0] if len(found) == 1 else (None, 0)

    def judge(self, fault, room, limit, caught):
        """Plant one fault and run the tests; returns the outcome"""
        result = {"file": fault.file, "line": fault.line, "kind": fault.kind, "old": fault.old, "new": fault.new, "room": room}
        path, number = self.place_of(fault)
        if path is None:
            return dict(result, outcome="gone")
        text = path.read_text(encoding="utf-8", errors="surrogateescape")
        lines = text.split("\n")
        fault = fault._replace(line=number, file=str(path.relative_to(self.source)))
        lines[number - 1] = fault.new
        script = room in SCRIPTS
        self.restore()
        if script:
            # a copy of the correct file is kept, from which an interrupted campaign is restored
            self.write("changed.json", {"path": str(path), "text": text})
            path.write_text("\n".join(lines), encoding="utf-8", errors="surrogateescape")
        else:
            planted = self.work / fault.file.replace("/", "_")
            planted.write_text("\n".join(lines), encoding="utf-8")
            plain = self.work / (fault.file.replace("/", "__") + ".o")
            output = self.work / "planted.o"
            if not self.compile_file(fault.file, planted, output):
                return dict(result, outcome="not compiled")
            if not plain.exists():
                # compiled from the same path, so that only the code differs
                planted.write_text(text, encoding="utf-8")
                self.compile_file(fault.file, planted, plain)
            if output.read_bytes() == plain.read_bytes():
                return dict(result, outcome="same code")
            replaced = {self.commands["compile"][fault.file]["object"]: output}
        try:
            linked = set()
            tests, reached = self.order_of_tests(fault, room, caught)
            spent, run = 0.0, 0
            for name in tests:
                usual = self.outcome[name]["seconds"]
                if spent and spent + usual > limit:
                    continue
                if not script:
                    to_link = [library for library in self.libraries() if library not in linked and self.needs(name, library)]
                    linked.update(to_link)
                    if not self.link(replaced, to_link):
                        return dict(result, outcome="not linked")
                outcome, seconds = self.run_test(name, 20 + 5*usual)
                if outcome != "passed" and (outcome == "late" or SENSITIVE.search(name)) and not self.passes_without_fault(name, 20
                    + 5*usual, script and path, text):
                    # caused by the machine, not by the fault
                    outcome = "passed"
                    if script:
                        path.write_text("\n".join(lines), encoding="utf-8", errors="surrogateescape")
                    elif not self.link(replaced, sorted(linked)):
                        return dict(result, outcome="not linked")
                spent, run = spent + seconds, run + 1
                if outcome in ("failed", "late"):
                    for key in (fault.file, name), (room, name), ("all", name):
                        caught[key] += 1
                    return dict(result, outcome="caught", by=name, late=outcome == "late", tests=run, seconds=round(spent, 1),
                                reached=reached)
            return dict(result, outcome="survived", tests=run, of=len(tests), seconds=round(spent, 1), reached=reached)
        finally:
            if script:
                path.write_text(text, encoding="utf-8", errors="surrogateescape")
                (self.folder / "changed.json").unlink()

    def passes_without_fault(self, name, limit, path, text):
        """Repeat a test that may have failed for lack of time, threads or sockets"""
        self.restore()
        if path:
            path.write_text(text, encoding="utf-8", errors="surrogateescape")
        return self.run_test(name, limit)[0] == "passed"

    def campaign(self, options):
        """Choose and judge faults until each room has its number"""
        self.load()
        self.read_reach()
        name = "order-%d%s.json" % (options.seed, "-" + options.chosen_at if options.chosen_at else "")
        order = self.read(name)
        if order is None:
            order = self.order_at(options.chosen_at, options.seed) if options.chosen_at else self.choose(options.seed)
            self.write(name, order)
        order = {room: [faults.Fault(*item) for item in items] for room, items in order.items()}
        latest = latest_results(self)
        caught = collections.Counter()
        for result in latest.values():
            if result["outcome"] == "caught":
                for key in (result["file"], result["by"]), (result["room"], result["by"]), ("all", result["by"]):
                    caught[key] += 1
        whole = sum(ROOMS.values())
        quota = {room: max(1, round(n*options.count/whole)) for room, n in ROOMS.items() if not options.only
                 or room in options.only}
        try:
            if options.again:
                for result in list(latest.values()):
                    if result["outcome"] == "survived" and result["room"] in quota and not judged_by_hand(result):
                        self.report(self.judge(faults.Fault(*[result[k] for k in faults.Fault._fields]), result["room"],
                                             options.limit, caught), options)
                return
            if options.every > 1:
                listed = [(room, fault) for room in quota for fault in order[room][:quota[room]]]
                for room, fault in listed[options.every//2::options.every]:
                    if identity(fault._asdict()) not in latest:
                        self.report(self.judge(fault, room, options.limit, caught), options)
                return
            done = dict.fromkeys(quota, 0)
            places = {room: iter(order[room]) for room in quota}
            while any(done[room] < n for room, n in quota.items()):
                # rooms alternate, so that a part of a campaign covers all of them
                room = min((r for r in quota if done[r] < quota[r]), key=lambda r: (done[r] + 0.5)/quota[r])
                fault = next(places[room], None)
                if fault is None:
                    quota[room] = done[room]
                    continue
                result = latest.get(identity(fault._asdict()))
                if result is None or result["outcome"] == "gone":
                    result = self.judge(fault, room, options.limit, caught)
                    self.report(result, options)
                done[room] += result["outcome"] in ("caught", "survived")
        finally:
            self.restore()

    def report(self, result, options):
        result = dict(result, seed=options.seed, commit=self.read("commit.json"))
        self.add_line("results.jsonl", result)
        print("%-12s %s:%d %s\n   - %s\n   + %s%s" % (result["outcome"], result["file"], result["line"], result["kind"],
                                                      result["old"].strip(),
              result["new"].strip(), "\n   " + result["by"] if "by" in result else ""), flush=True)


def identity(result):
    return result["file"], result["old"], result["new"], result["line"]


def latest_results(store):
    """The last result of each fault, with its first outcome"""
    latest = {}
    for result in store.read_lines("results.jsonl"):
        key = identity(result)
        result["first"] = latest[key]["first"] if key in latest and latest[key]["outcome"] != "gone" else result["outcome"]
        latest[key] = result
    return latest


def judged_by_hand(result):
    """Reason why a fault cannot be detected by any test; None if there is none"""
    for entry in json.loads((HERE / "equivalent.json").read_text(encoding="utf-8")):
        if entry["file"] == result["file"] and entry["old"] == result["old"].strip() and entry["new"] == result["new"].strip():
            return entry["reason"]
    return None


def table(store):
    """Counts by room and by kind"""
    results = [r for r in latest_results(store).values() if r["outcome"] in ("caught", "survived")]
    for title, key, names in (("room", "room", list(ROOMS)), ("kind", "kind", sorted({r["kind"] for r in results}))):
        print("| %s | planted | equivalent | caught at first | caught now | survived |\n|---|---|---|---|---|---|" % title)
        total = [0]*5
        for name in names + ["all"]:
            rows = [r for r in results if r[key] == name]
            equal = [r for r in rows if r["outcome"] == "survived" and judged_by_hand(r)]
            counts = [len(rows), len(equal), sum(r["first"] == "caught" for r in rows), sum(r["outcome"] == "caught" for r in rows)]
            counts.append(counts[0] - counts[1] - counts[3])
            if name == "all":
                counts = total
            else:
                total = [a + b for a, b in zip(total, counts)]
            if counts[0]:
                print("| %s | %s |" % (name, " | ".join(str(n) for n in counts)))
        print()
    real = total[0] - total[1]
    if real:
        print("caught of those that are not equivalent: %.1f %% at first, %.1f %% now" % (100*total[2]/real, 100*total[3]/real))
    print("seeds %s, commits %s" % (sorted({r["seed"] for r in results}), sorted({r["commit"][:9] for r in results})))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=240)
    parser.add_argument("--store", default=str(TOP / "build" / "planted"))
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--renew", action="store_true")
    parser.add_argument("--measure", action="store_true")
    parser.add_argument("--only", nargs="+", choices=list(ROOMS))
    parser.add_argument("--limit", type=float, default=240)
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--chosen-at")
    parser.add_argument("--every", type=int, default=1)
    options = parser.parse_args()
    store = Store(options.store)
    if not options.table:
        store.prepare(options.renew, options.measure)
        store.campaign(options)
    table(store)


if __name__ == "__main__":
    main()
