#!/usr/bin/env python3
"""Calls on files that fail while a host has its cases written as input (flag 2002), and while the page of results is made.

usage: test_host_files.py LIBRARY_TO_PRELOAD, with CONTACT_LIBRARY, CONTACT_PROGRAM and CONTACT_SOURCE set

Each place of write, close, rename and open, alone, and for a full disk and too many open files with all later ones. Right are a
whole file, or one without its end and a message; the host lives on. Of the page: the whole one or none.
"""
import ctypes
import errno
import os
import pathlib
import subprocess
import sys

CASES = 12
FAULTS = [("write", errno.EIO, False), ("write", errno.ENOSPC, True), ("close", errno.EIO, False), ("rename", errno.EACCES, False),
          ("open", errno.EMFILE, True)]


def host(folder):
    """Solve cases of one problem, and print the messages of the library about each"""
    library = ctypes.CDLL(os.environ["CONTACT_LIBRARY"])

    def whole(*values):
        return (ctypes.c_int * len(values))(*values)

    def real(*values):
        return (ctypes.c_double * len(values))(*values)

    def print_error(ire):
        message = ctypes.create_string_buffer(1000)
        if library.contact_last_error(ire, 1, message, len(message)) or message.value:
            print("TOLD", message.value.decode())

    one, code, path = whole(1), whole(0), folder.encode()
    library.cntc_initialize(one, whole(3), whole(0), code, path, whole(len(path)))
    library.cntc_setflags(one, one, one, whole(2002), whole(2))
    library.cntc_setmaterialparameters(one, one, whole(0), whole(4), real(0.28, 0.28, 82000, 82000))
    library.cntc_setfrictionmethod(one, one, whole(0), whole(2), real(0.3, 0.3))
    library.cntc_sethertzcontact(one, one, whole(-3), whole(5), real(5, 5, 4.25, 7.0, 1.2))
    library.cntc_setpenetration(one, one, real(0.05))
    for k in range(CASES):
        library.cntc_setcreepages(one, one, real(1e-3 * k), real(0), real(0))
        library.cntc_calculate(one, one, code)
        if code[0] < 0:
            print("CODE", code[0])
        print_error(0)
    library.cntc_finalizelast()
    print_error(0)
    print("ALIVE")


def empty(folder):
    folder.mkdir(exist_ok=True)
    for file in folder.iterdir():
        file.unlink()


def run(folder, command, preload, **inject):
    """Exit status and messages"""
    settings = {key: str(value) for key, value in inject.items() if value is not None}
    environment = dict(os.environ, LD_PRELOAD=preload, INJECT_FOLDER=f"{folder}/", OMP_NUM_THREADS="1", **settings)
    done = subprocess.run(command, env=environment,
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace", timeout=120)
    return done.returncode, done.stdout + done.stderr


def each_fault(folder, command, prepare, preload, judge):
    """Fail each occurrence of each call; number of faults and of complaints"""
    tried = bad = 0
    count = pathlib.Path.cwd() / "count"
    for call, error, for_ever in FAULTS:
        prepare()
        code, said = run(folder, command, preload, INJECT_CALL=call, INJECT_COUNT=count)
        assert code == 0, said
        places = int(count.read_text(encoding="utf-8"))
        for place in range(1, places + 1):
            prepare()
            code, said = run(folder, command, preload, INJECT_CALL=call, INJECT_AT=place, INJECT_ERROR=error,
                             INJECT_FOR_EVER=1 if for_ever else None)
            tried += 1
            complaint = judge(code, said)
            if complaint:
                bad += 1
                print(f"FAILED {command[1:3]}, {call} {place} of {places}, error {error}: {complaint}; {said[-300:]}")
        print(f"{call}, error {error}: {places} places")
    return tried, bad


def main():
    preload, room = sys.argv[1], pathlib.Path.cwd()
    folder = room / "host"
    command = [sys.executable, "-B", os.path.abspath(__file__), "--host", str(folder)]
    empty(folder)
    assert run(folder, command, preload)[0] == 0
    dump = folder / "contact_addon.inp"
    good = dump.read_bytes()
    assert good.count(b"MODULE, RE, CP") == CASES and good.endswith(b" 0  MODULE\n"), good[-300:]

    def judge_host(code, said):
        if code or "ALIVE" not in said or "CODE" in said:
            return f"the host ends with {code}"
        found = dump.read_bytes() if dump.exists() else b""
        if found == good:
            return ""
        if b" 0  MODULE" in found:
            return "the damaged file has its end"
        is_reported = "TOLD" in said and ("contact_addon.inp" in said or "input file of the library" in said)
        return "" if is_reported else "no error was reported"

    tried, bad = each_fault(folder, command, lambda: empty(folder), preload, judge_host)

    results = room / "page"
    empty(results)
    example = pathlib.Path(os.environ["CONTACT_SOURCE"], "examples", "carter2d")
    command = [os.environ["CONTACT_PROGRAM"], "--quiet", "--hdf5", "--output-dir", str(results), "2", str(example)]
    subprocess.run(command, check=True, stdin=subprocess.DEVNULL, timeout=300)
    page = results / "carter2d.html"
    command = [os.environ["CONTACT_PROGRAM"], "report", str(results / "carter2d")]
    code, said = run(results, command, preload)
    if code == 0:
        good_page = page.read_bytes()

        def judge_page(code, said):
            left = sorted(file.name for file in results.iterdir() if file.suffix not in (".h5", ".out", ".mat", ".html"))
            if left:
                return f"{left} is left"
            if page.exists() and page.read_bytes() != good_page:
                return "a page that is not whole"
            if code == 0:
                return "" if page.exists() else "no page, and no word of it"
            return "" if "carter2d" in said and "Traceback" not in said else "no message"

        more, worse = each_fault(results, command, lambda: page.unlink(missing_ok=True), preload, judge_page)
        tried, bad = tried + more, bad + worse
    else:
        print(f"the page is left out: {said[-200:]}")
    print(f"{tried} faults, {bad} complaints")
    return 1 if bad else 0


if __name__ == "__main__":
    if sys.argv[1] == "--host":
        host(sys.argv[2])
    else:
        sys.exit(main())
