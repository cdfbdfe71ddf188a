#!/usr/bin/env python3
"""Store the outputs of the program and the library, and report later what has changed.

    bytes.py store DIR --exe PROGRAM --library LIBRARY      run everything, store the outputs in DIR
    bytes.py compare DIR --exe PROGRAM --library LIBRARY    run the same again, report every file that differs

An interrupted store is resumed. It has its own copies of inputs, profiles, scripts and of the Python package,
so that a comparison concerns program and library only. It runs the examples, and the inputs below
CONTACT_REFERENCE if there are any, through these interfaces:

    program   contact 2 with .out, .mat, .subs, HDF5, JSON, VTK, and its messages
    check     contact 3, also on inputs with single words replaced: errors, and the echo of the input
    run       contact_run_with of the library, the same files
    read      cntc_readinpfile for inputs of wheel and rail, then every cntc_get* in several units, and the input that is written
    calls     the scripts of tests/capi and examples/library; every call of a routine with its results, and the files they write

Times, versions, and names of machine and folders are excluded from a comparison, see CHANGING. Computations use one thread.
"""
import argparse
import concurrent.futures
import difflib
import fnmatch
import gzip
import hashlib
import json
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
#: Lines of texts that differ from build to build
CHANGING = re.compile(rb"Version \d+\.\d+\.\d+|^contact \d+\.\d+|compiled by", re.IGNORECASE)
#: Rows of the table of times: name and count are compared
TIMES = re.compile(rb"^(\s*\|[^|\n]*\|\s*\d+ \|)(?:\s*[\d.]+ \|){4}", re.MULTILINE)
#: Folders that scripts make
TEMPORARY = re.compile(rb"(<work>/tmp/(?:contact_|tmp))\w{8}")
#: Keys of JSON records, attributes and data sets of HDF5 that differ
CHANGING_KEYS = {"seconds", "date", "created", "version", "host", "compiler", "history", "program", "threads"}
#: Limit of processor time of runs in a quick comparison [s]
QUICK = 2.5
#: Processor time after which a run of a new store is postponed to the end [s]
SHORT = 6
#: Replacements of a word in the inputs of "check"
REPLACED = ("x", "-1", "0", "1e9", "99", "", "1.5", "7", "0d", "'name'")
#: Maximum size of a stored text; of longer ones only the hash is stored [bytes]
KEPT = 60_000_000
SKIPPED = 77


def canonical(path, places):
    """The content of a file without data that change from run to run"""
    with open(path, "rb") as file:
        data = file.read()
    if data[:8] == b"\x89HDF\r\n\x1a\n":
        return hdf5_text(path).encode()
    for place, name in places:
        data = data.replace(place.encode(), name)
    if path.endswith(".jsonl"):
        return "\n".join(json.dumps(without_changing(json.loads(line)), indent=0) for line in data.decode().splitlines()).encode()
    if b"\0" in data:
        return data
    data = TEMPORARY.sub(rb"\1", TIMES.sub(rb"\1", data))
    return b"\n".join(line for line in data.split(b"\n") if not CHANGING.search(line))


def without_changing(value):
    if isinstance(value, dict):
        return {key: without_changing(item) for key, item in value.items() if key not in CHANGING_KEYS}
    if isinstance(value, list):
        return [without_changing(item) for item in value]
    return value


def hdf5_text(path):
    """Everything in an HDF5 file: groups, types, shapes, attributes, values"""
    import h5py
    import numpy as np
    lines = []

    def values_of(array):
        array = np.asarray(array)
        if array.dtype.kind in "OSU":
            return " ".join(repr(item) for item in array.ravel().tolist())
        if array.dtype.kind == "V":
            return repr(array.tolist())
        if array.size > 400:
            digest = hashlib.sha256(np.ascontiguousarray(array).tobytes()).hexdigest()
            return f"sha256 {digest} least {np.nanmin(array)!r} largest {np.nanmax(array)!r} sum {np.nansum(array)!r}"
        return " ".join(format(item, ".17g") if isinstance(item, float) else str(item) for item in array.ravel().tolist())

    def attributes(name, item):
        for key in sorted(item.attrs):
            if key in ("REFERENCE_LIST", "DIMENSION_LIST"):
                lines.append(f"{name} @{key}")
            elif key.lower() not in CHANGING_KEYS:
                lines.append(f"{name} @{key} = {values_of(item.attrs[key])}")

    def visit(name, item):
        if name.split("/")[-1].lower() in CHANGING_KEYS:
            return
        if isinstance(item, h5py.Dataset):
            lines.append(f"{name} {item.dtype} {item.shape} {values_of(item[()])}")
        else:
            lines.append(f"{name}/")
        attributes(name, item)

    with h5py.File(path, "r") as file:
        attributes("", file)
        file.visititems(visit)
    return "\n".join(lines) + "\n"


def tree(folder, suffixes):
    """Files below a folder"""
    for where, _, names in sorted(os.walk(folder)):
        for name in sorted(names):
            if name.lower().endswith(suffixes):
                yield os.path.relpath(os.path.join(where, name), folder)


def freeze(store, source, inputs):
    """Copy the inputs of the runs into the store"""
    clients = os.path.join(store, "clients")
    for part in ("examples", "python", "tests/capi", "tests/regression"):
        shutil.copytree(os.path.join(source, part), os.path.join(clients, "source", part),
                        ignore=shutil.ignore_patterns("__pycache__", "figures"))
    shutil.copytree(os.path.join(source, "doc/user"), os.path.join(clients, "source/doc/user"))
    shutil.copy(os.path.join(source, "README.md"), os.path.join(clients, "source"))
    shutil.copy(os.path.join(HERE, "bytes_client.py"), clients)
    if inputs:
        for name in tree(inputs, (".inp", ".prr", ".prw", ".slcs", ".slcw", ".ban", ".txt", ".prf")):
            place = os.path.join(clients, "reference", name)
            os.makedirs(os.path.dirname(place), exist_ok=True)
            shutil.copy(os.path.join(inputs, name), place)
    for name in list(tree(clients, (".inp",))):
        mutate(os.path.join(clients, name))


def mutate(path):
    """Variants of an input with one word replaced, always the same"""
    with open(path, encoding="latin-1", newline="") as file:
        text = file.read()
    if text.count("\n") > 2000:
        return
    folder, name = os.path.split(path)
    choose = random.Random(name)
    lines = text.split("\n")
    words = [(k, found) for k, line in enumerate(lines) for found in re.finditer(r"\S+", line.split("%")[0])]
    for number in range(min(8, len(words))):
        k, found = choose.choice(words[:300])
        line = lines[k][:found.start()] + choose.choice(REPLACED) + lines[k][found.end():]
        with open(os.path.join(folder, f"mutated{number:02}_{name}"), "w", encoding="latin-1", newline="") as file:
            file.write("\n".join(lines[:k] + [line] + lines[k + 1:]))


def scenarios(source):
    """Scripts that call the library, with their arguments"""
    with open(os.path.join(source, "tests/capi/CMakeLists.txt"), encoding="utf-8") as file:
        text = file.read()
    for names, script in re.findall(r"foreach\(scenario ([^)]*)\)\s*capi_script_test\(\S+ \S*/conformance/(\w+\.py)", text):
        for name in names.split():
            if name != "timers":
                yield f"{script[:-3]}_{name}", [f"tests/capi/conformance/{script}", name]
    yield "creep_force_book", ["tests/capi/conformance/creep_force_book.py", "12"]
    yield "hostile", ["tests/capi/robust/hostile.py", "3000"]
    yield "package", ["tests/capi/package.py"]
    for name in ("creep_curve", "manchester", "subsurface"):
        yield f"example_{name}", [f"examples/library/{name}.py", "examples/profiles"]


def tasks(store, patterns):
    """All runs: door, name, command"""
    clients = os.path.join(store, "clients")
    found = []
    for name in tree(clients, (".inp",)):
        path = os.path.join(clients, name)[:-4]
        plain = not os.path.basename(name).startswith("mutated")
        found.append(("check", name, ["EXE", "3", path, "--output-dir", "."]))
        if plain:
            found.append(("program", name, ["EXE", "--hdf5", "--json", "--vtk", "--output-dir", ".", "2", path]))
            found.append(("run", name, ["CLIENT", "run", path]))
            with open(path + ".inp", encoding="latin-1") as file:
                if re.search(r"^\s*1\s+(?:%.*)?MODULE|^\s*1\s+%", file.read(), re.MULTILINE | re.IGNORECASE):
                    found.append(("read", name, ["CLIENT", "read", path + ".inp"]))
    for name, words in scenarios(os.path.join(clients, "source")):
        found.append(("calls", name, ["CLIENT", "calls", *words]))
    return [task for task in found if any(fnmatch.fnmatch(f"{task[0]}/{task[1]}", pattern) for pattern in patterns)]


def limited():
    """Executed in a new process before its program starts"""
    resource.setrlimit(resource.RLIMIT_CPU, (SHORT, SHORT + 2))


def perform(task, store, tools, keep):
    """Run one task; hash and text of every file, seconds"""
    _door, _name, command = task
    clients = os.path.join(store, "clients")
    source = os.path.join(clients, "source")
    environment = dict(os.environ, OMP_NUM_THREADS="1", CONTACT_LIBRARY=tools["library"], CONTACT_PROGRAM=tools["exe"],
                       CONTACT_SOURCE=source, CONTACT_REFERENCE=os.path.join(clients, "reference"), PYTHONDONTWRITEBYTECODE="1",
                       PYTHONPATH=tools["python"] or os.path.join(source, "python"), PYTHONHASHSEED="0")
    work = tempfile.mkdtemp(prefix="bytes")
    temporary = os.path.join(work, "tmp")
    os.mkdir(temporary)
    environment["TMPDIR"] = temporary
    if command[0] == "EXE":
        command = [tools["exe"], *command[1:]]
    else:
        command = [sys.executable, os.path.join(clients, "bytes_client.py"), command[1],
                   *(os.path.join(source, word) if "/" in word and not word.startswith("/") else word for word in command[2:])]
    begin = resource.getrusage(resource.RUSAGE_CHILDREN)
    with open(os.path.join(work, "stdout"), "wb") as out, open(os.path.join(work, "stderr"), "wb") as err:
        try:
            code = subprocess.run(command, cwd=work, env=environment, stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                                  timeout=tools["patience"], preexec_fn=limited if tools.get("limit") else None).returncode
        except subprocess.TimeoutExpired:
            code = None
    if code in (-signal.SIGXCPU, -signal.SIGKILL, 128 + signal.SIGXCPU):
        code = None
    end = resource.getrusage(resource.RUSAGE_CHILDREN)
    if code is None:
        shutil.rmtree(work, ignore_errors=True)
        return task, None, 0.0
    seconds = end.ru_utime + end.ru_stime - begin.ru_utime - begin.ru_stime
    files = {}
    places = sorted(((work, b"<work>"), (clients, b"<clients>"), (tools["exe"], b"<exe>"), (tools["library"], b"<library>")),
                    key=lambda item: -len(item[0]))
    for path in tree(work, ("",)):
        text = canonical(os.path.join(work, path), places)
        if path == "stderr":
            text += f"\nexit status {code}".encode()
        label = re.sub(r"^tmp/tmp\w+", "tmp/t", path)
        files[label] = (hashlib.sha256(text).hexdigest(), text if keep and len(text) < KEPT else None)
    shutil.rmtree(work, ignore_errors=True)
    return task, files, seconds


def place_of(store, door, name, file):
    return os.path.join(store, "texts", door, name.replace("/", "_"), file.replace("/", "_") + ".gz")


def everything(chosen, store, tools, jobs):
    with concurrent.futures.ProcessPoolExecutor(jobs) as pool:
        futures = [pool.submit(perform, task, store, tools, True) for task in chosen]
        for future in concurrent.futures.as_completed(futures):
            yield future.result()


def read_index(store):
    """Index of the store; empty if it is new"""
    try:
        with open(os.path.join(store, "index.json"), encoding="utf-8") as file:
            return json.load(file)
    except FileNotFoundError:
        return {}


def write_index(store, index):
    with open(os.path.join(store, "index.tmp"), "w", encoding="utf-8") as file:
        json.dump(index, file, indent=0, sort_keys=True)
    os.replace(os.path.join(store, "index.tmp"), os.path.join(store, "index.json"))


def do_store(store, arguments, tools):
    if not os.path.exists(os.path.join(store, "clients")):
        freeze(store, arguments.source, arguments.inputs)
    # slow runs come last, so that a store can be used while it is being made
    index = read_index(store)
    waiting = [task for task in tasks(store, arguments.only) if f"{task[0]}/{task[1]}" not in index]
    for tools["limit"] in (SHORT, None):
        again = []
        for task, files, seconds in everything(waiting, store, tools, arguments.jobs):
            door, name, _ = task
            if tools["limit"] and files is None:
                again.append(task)
                continue
            index[f"{door}/{name}"] = {"seconds": round(seconds, 2),
                                       "files": {file: digest for file, (digest, _) in (files or {}).items()}}
            for file, (_, text) in (files or {}).items():
                if text is not None:
                    place = place_of(store, door, name, file)
                    os.makedirs(os.path.dirname(place), exist_ok=True)
                    with gzip.open(place, "wb", compresslevel=1) as out:
                        out.write(text)
            if len(index) % 50 == 0:
                write_index(store, index)
        waiting = again
        write_index(store, index)
    print(f"{len(index)} runs, {sum(len(run['files']) for run in index.values())} files, {store}")


def stored_text(store, door, name, file):
    try:
        with gzip.open(place_of(store, door, name, file), "rb") as stored:
            return stored.read()
    except OSError:
        return None


def differences(old, new, ignored, lines):
    """The first differing lines; None if all differences are ignored"""
    def split(text):
        return [line for line in text.decode("utf-8", errors="backslashreplace").split("\n")
                if not (ignored and ignored.search(line))]
    before, after = split(old), split(new)
    if before == after:
        return None
    if len(before) + len(after) > 40000 or b"\0" in old:
        pairs = [(k, a, b) for k, (a, b) in enumerate(zip(before, after), 1) if a != b]
        text = [f"{len(before)} and {len(after)} lines, {len(pairs)} of them differ"]
        for k, a, b in pairs[:lines]:
            text += [f"  {k}: - {a[:200]}", f"  {k}: + {b[:200]}"]
        return text
    found = [line[:220] for line in difflib.unified_diff(before, after, lineterm="", n=0) if not line.startswith(("---", "+++"))]
    return found[:3 * lines] + ([f"... {len(found)} lines in all"] if len(found) > 3 * lines else [])


def do_compare(store, arguments, tools):
    index = read_index(store)
    chosen = [task for task in tasks(store, arguments.only) if f"{task[0]}/{task[1]}" in index]
    chosen = [task for task in chosen
              if arguments.all or index[f"{task[0]}/{task[1]}"]["seconds"] <= QUICK]
    ignored = re.compile("|".join(arguments.ignore)) if arguments.ignore else None
    count, different, shown = 0, 0, {}
    for (door, name, _), files, _ in everything(chosen, store, tools, arguments.jobs):
        before = index[f"{door}/{name}"]["files"]
        if files is None:
            different += 1
            print(f"{door}/{name} did not end within {arguments.patience:g} s", flush=True)
            continue
        for file in sorted(set(before) | set(files)):
            count += 1
            label = f"{door}/{name}: {file}"
            if file not in files or file not in before:
                different += 1
                print(label, "is new" if file in files else "is missing", flush=True)
                continue
            digest, text = files[file]
            if digest == before[file]:
                continue
            old = stored_text(store, door, name, file)
            lines = ["too long to be stored"]
            if old is not None and text is not None:
                lines = differences(old, text, ignored, arguments.lines)
            if lines is None:
                continue
            different += 1
            if arguments.keep and old is not None:
                for version, content in (("old", old), ("new", text)):
                    place = os.path.join(arguments.keep, version, door, name.replace("/", "_"), file.replace("/", "_"))
                    os.makedirs(os.path.dirname(place), exist_ok=True)
                    with open(place, "wb") as out:
                        out.write(content)
            said = "\n".join(re.sub(r"^@@.*", "@@", line) for line in lines)
            if said in shown:
                print(f"{label}: as {shown[said]}", flush=True)
            else:
                shown[said] = label
                print(label, *("    " + line for line in lines), sep="\n", flush=True)
    print(f"{len(chosen)} runs, {count} files, {different} differ")
    return 1 if different else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("store", "compare"))
    parser.add_argument("store")
    parser.add_argument("--exe", default=os.environ.get("CONTACT_PROGRAM"), help="program; default CONTACT_PROGRAM")
    parser.add_argument("--library", default=os.environ.get("CONTACT_LIBRARY"), help="shared library; default CONTACT_LIBRARY")
    parser.add_argument("--inputs", default=os.environ.get("CONTACT_REFERENCE"),
                        help="folder of more inputs; default CONTACT_REFERENCE")
    parser.add_argument("--source", default=os.path.dirname(os.path.dirname(HERE)),
                        help="sources from which a store takes examples")
    parser.add_argument("--python", help="compare: use this Python package instead of the stored one")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--patience", type=float, default=900.0, help="seconds that one run may take")
    parser.add_argument("--only", nargs="*", default=["*"], help="door/name patterns, as 'program/*cattaneo*'")
    parser.add_argument("--all", action="store_true", help=f"compare: also runs that took more than {QUICK:g} seconds")
    parser.add_argument("--ignore", nargs="*", help="compare: regular expressions of lines whose differences are ignored")
    parser.add_argument("--lines", type=int, default=4, help="compare: differences shown per file")
    parser.add_argument("--keep", help="compare: write old and new texts that differ to this folder")
    arguments = parser.parse_args()
    tools = {"exe": os.path.abspath(arguments.exe), "library": os.path.abspath(arguments.library),
             "python": arguments.python and os.path.abspath(arguments.python), "patience": arguments.patience}
    store = os.path.abspath(arguments.store)
    if arguments.what == "store":
        return do_store(store, arguments, tools)
    return do_compare(store, arguments, tools)


if __name__ == "__main__":
    sys.exit(main())
