"""Common part of all judges: running the program, reading its results, findings and tolerances.

Nothing here looks at the sources of the program; results are read from the files that users read.
"""
import json
import math
import os
import re
import resource
import signal
import subprocess
import sys

import numpy as np

try:
    import h5py
except ImportError:
    h5py = None

# Six figures are printed in .mat files: relative error of one value
PRINTED = 5e-6
# Round-off of sums over some thousand elements
ROUND_OFF = 1e-9
# Columns of the element lines of a .mat file, from the first
MAT_COLUMNS = ["element", "eldiv", "h", "mu", "pn", "px", "py", "un", "ux", "uy", "slip"]


def finding(judge, what, size=None, limit=None, status="disagreement"):
    """One finding of a judge.

    status is "refused" (what: the reason), "not converged" (what: which iteration), "open" (what: a known reason) or
    "disagreement". A size above its
    limit is what makes a disagreement, where there is a number.
    """
    result = {"status": status, "judge": judge, "what": what}
    if size is not None:
        result["size"] = float(size)
    if limit is not None:
        result["limit"] = float(limit)
    return result


def exceeds(findings, judge, what, size, limit):
    """Add a finding if a size is above its limit, or not a number"""
    if not size <= limit:
        findings.append(finding(judge, what, size, limit))


def without_numbers(text):
    """A message with its numbers and names replaced, so that equal reasons count as one"""
    text = re.sub(r"^\S+?\.inp:\d+:\d+: ", "", text.strip())
    return re.sub(r"[-+]?\d+(\.\d*)?([eEdD][-+]?\d+)?", "#", text)[:200]


class Unreadable(Exception):
    """A file of results that contradicts the documentation"""


class Run:
    """One run of the program: exit code, texts, and results by case (from 1)"""

    def __init__(self, folder, name, code, screen, errors, seconds):
        self.folder, self.name = folder, name
        self.code, self.screen, self.errors, self.seconds = code, screen, errors, seconds
        self.cases = []

    def path(self, ending):
        return os.path.join(self.folder, self.name + ending)

    def text(self, ending):
        """A file of results as text, empty if there is none"""
        try:
            with open(self.path(ending), encoding="utf-8", errors="replace") as file:
                return file.read()
        except OSError:
            return ""

    def read_cases(self):
        for line in self.text(".jsonl").splitlines():
            try:
                case = json.loads(line, parse_constant=_refuse_constant)
                if case["case"]:  # the last line has the progress of the run
                    self.cases.append(case)
            except ValueError as error:
                raise Unreadable(f"{self.name}.jsonl: {error}: {line[:200]}") from error

    def totals(self, case, patch=1):
        """Totals of a patch as plain numbers, by their names"""
        return plain_totals(self.cases[case - 1], patch)

    def fields(self, case, patch=1):
        """Fields of a patch over the elements, arrays (my, mx), with the grid: from the HDF5 file where there is one and
        h5py is installed (all figures), otherwise from the .mat file (six figures)"""
        if h5py is not None and os.path.exists(self.path(".h5")):
            with h5py.File(self.path(".h5"), "r") as file:
                place = file[f"case_{case:04d}/patch_{patch}"]
                result = {name: place["grid"][name][()] for name in ("mx", "my", "xl", "yl", "dx", "dy")}
                for name in ("chi", "dq", "veloc"):
                    if name in place["grid"]:
                        result[name] = place["grid"][name][()]
                for name in place["fields"]:
                    result[name] = place["fields"][name][()]
                result["error"] = 0.0
                return result
        return self.printed_fields(case)

    def printed_fields(self, case, letter=""):
        """Fields of the .mat file"""
        path = self.path(f".{case:04d}{letter}.mat")
        try:
            with open(path, encoding="utf-8") as file:
                rows = [line.split() for line in file]
        except OSError as error:
            raise Unreadable(str(error)) from error
        names = [row for row in rows if row and row[0].startswith("%")]
        try:
            values = [[float(word) for word in row] for row in rows if row and not row[0].startswith("%")]
        except ValueError as error:
            raise Unreadable(f"{os.path.basename(path)}: {error}") from error
        if len(values) < 6 or len({len(row) for row in values}) != 1:
            raise Unreadable(f"{os.path.basename(path)}: rows of different lengths")
        table = np.array(values)
        if not np.isfinite(table).all():
            raise Unreadable(f"{os.path.basename(path)}: a value is not finite")
        mx, my, xl, yl, dx, dy, chi, dq = table[3, :8]
        result = {"mx": int(mx), "my": int(my), "xl": xl, "yl": yl, "dx": dx, "dy": dy, "chi": chi, "dq": dq,
                  "veloc": table[5, 2], "error": PRINTED}
        elements = table[6:, 0].astype(int) - 1
        # the line of titles has one % before the names
        more = [word.lower() for word in names[6][len(MAT_COLUMNS) + 1:]]
        for column, name in enumerate(MAT_COLUMNS[1:] + more, start=1):
            field = np.zeros(int(mx)*int(my))
            field[elements] = table[6:, column]
            result[name] = field.reshape(int(my), int(mx))
        result["eldiv"] = result["eldiv"].astype(int)
        result["elements"] = elements
        return result


def plain_totals(record, patch=1):
    """Totals of a patch in a record of a case"""
    totals = record["patches"][patch - 1]["totals"]
    return {name: value["value"] if isinstance(value, dict) else value for name, value in totals.items()}


def _refuse_constant(word):
    raise ValueError(f"{word} is no JSON")


class Tools:
    """Environment of a judge: the program, the library, a scratch folder and limits"""

    def __init__(self, exe, library, python_path, folder, seconds=60, gigabytes=4):
        self.exe, self.library, self.python_path, self.folder = exe, library, python_path, folder
        self.seconds, self.gigabytes = seconds, gigabytes

    def _limits(self):
        size = int(self.gigabytes*2**30)
        # the address sanitizer takes address space without limit
        if "CONTACT_SLOWER" not in os.environ:
            resource.setrlimit(resource.RLIMIT_AS, (size, size))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        # processor time: on a busy machine a run may take several times as long
        resource.setrlimit(resource.RLIMIT_CPU, (int(self.seconds) + 1, int(self.seconds) + 2))

    def command(self, arguments):
        """Run a command in the scratch folder: (exit code or None when it took too long, output, errors, seconds)"""
        environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", CONTACT_LIBRARY=self.library or "",
                           PYTHONPATH=self.python_path or "")
        if arguments[0] == sys.executable and "CONTACT_INSTRUMENTS" in os.environ:
            # a library with the sanitizers needs theirs loaded first; memory held by Python is not a leak
            environment.update(LD_PRELOAD=os.environ["CONTACT_INSTRUMENTS"],
                               ASAN_OPTIONS="detect_leaks=0:allocator_may_return_null=1")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        process = subprocess.Popen(arguments, cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, env=environment, preexec_fn=self._limits, start_new_session=True)
        try:
            output, errors = process.communicate(timeout=10*self.seconds)
            code = None if process.returncode in (-signal.SIGXCPU, -signal.SIGKILL) else process.returncode
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            output, errors = process.communicate()
            code = None
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return (code, output.decode(errors="replace"), errors.decode(errors="replace"),
                after.ru_utime - before.ru_utime)

    def run(self, name, text, files=None, options=("--json", "--hdf5", "--quiet"), threads=1):
        """Run the program on an input text; files are further texts by their names"""
        for file_name, content in {name + ".inp": text, **(files or {})}.items():
            with open(os.path.join(self.folder, file_name), "w", encoding="utf-8") as file:
                file.write(content)
        code, output, errors, seconds = self.command([self.exe, "2", name, "--threads", str(threads), *options])
        run = Run(self.folder, name, code, output, errors, seconds)
        run.read_cases()
        return run


def how_it_ended(run, expected_cases, findings):
    """Exit code, refusals and messages of a run: findings that need no fields.

    Returns the numbers of the cases that have results.
    """
    if run.code is None:
        findings.append(finding("end", "the run took too long"))
        return []
    if run.code not in (0, 1):
        findings.append(finding("end", f"exit code {run.code}: {run.errors.strip()[-200:]}"))
        return []
    for ending in (".out", ".jsonl"):
        text = run.text(ending)
        match = re.search(r"\bNaN\b|[-+ ]Infinity|\*{6}", text)
        if match:
            findings.append(finding("numbers", f"{ending}: {text[max(0, match.start() - 60):match.end() + 60]}"))
    solved = [number for number, case in enumerate(run.cases, start=1) if case.get("solved")]
    if run.code == 1:
        message = next((line for line in (run.errors or run.screen).splitlines() if line.strip()), "")
        if not message:
            findings.append(finding("end", "exit code 1 without a message"))
        findings.append(finding("end", without_numbers(re.sub(r"^\s*(Input: )?(ERROR\.?)?\s*", "", message)), status="refused"))
    elif len(solved) < expected_cases:
        findings.append(finding("end", f"{len(solved)} of {expected_cases} cases have results, and the exit code is 0"))
    return solved


def relative(difference, scale):
    """Relative size of a difference, also for a scale of zero"""
    size = float(np.max(np.abs(difference))) if np.size(difference) else 0.0
    if size == 0.0:
        return 0.0
    return size/scale if scale > 0 else math.inf
