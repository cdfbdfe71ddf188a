"""Process of bytes.py: calls one interface of the library and prints all results.

    bytes_client.py run NAME              contact_run_with on an experiment, all outputs
    bytes_client.py read NAME             cntc_readinpfile on an experiment of wheel and rail, then every getter
    bytes_client.py calls SCRIPT [ARG..]  a script of the Python package; each call with its results goes to calls.txt

The environment gives CONTACT_LIBRARY; the package contact is found by PYTHONPATH.
"""
import ctypes
import inspect
import os
import runpy
import sys

#: Maximum number of values of an array that are printed one by one
WHOLE = 20000
#: Results that are times or addresses
CHANGING = ("cntc_getcalculationtime",)


def printed(value):
    """A value with all its digits"""
    if value is None or isinstance(value, (int, str)):
        return repr(value)
    if isinstance(value, float):
        return format(value, ".17g")
    if isinstance(value, (bytes, os.PathLike)):
        return repr(os.fspath(value))
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {printed(item)}" for key, item in value.items()) + "}"
    if hasattr(value, "tolist"):
        if value.size > WHOLE:
            return f"array {value.shape} {hash_of(value)}"
        return f"array {value.shape} [" + " ".join(printed(item) for item in value.ravel().tolist()) + "]"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(printed(item) for item in value) + "]"
    if hasattr(value, "__dict__"):
        return type(value).__name__ + printed(vars(value))
    return repr(value)


def hash_of(array):
    import hashlib
    return hashlib.sha256(array.tobytes()).hexdigest()


def run(name):
    """contact_run_with: its code and message; the files are compared by bytes.py"""
    library = ctypes.CDLL(os.environ["CONTACT_LIBRARY"])
    message = ctypes.create_string_buffer(4000)
    code = library.contact_run_with(name.encode(), 2, b".", 1, 1 + 2 + 4, message, len(message))
    print(code, message.value.decode("utf-8", errors="replace"))


def getters(cntc):
    """Functions that only read, with their arguments besides the numbers of element and problem"""
    further = {"getflags": [list(cntc.CNTC.values())[1:31]], "getfielddata": None, "getparameters": None, "getprofilevalues": None,
               "getcalculationtime": None, "getsensitivities": [4, 4]}
    for name, function in vars(cntc).items():
        if name.startswith("get") and inspect.isfunction(function) and further.get(name, ()) is not None:
            yield name, function, further.get(name, [])
    for number in sorted(value for key, value in cntc.CNTC.items() if key.startswith("fld_")):
        yield f"getfielddata {number}", cntc.getfielddata, [number]
    for task in (1, 2, 3):
        yield f"getparameters {task}", cntc.getparameters, [task]


def ask(cntc, ire, icp):
    """All getters on one problem"""
    for name, function, more in getters(cntc):
        names = list(inspect.signature(function).parameters)
        here = ([ire] if "ire" in names else []) + ([icp] if "icp" in names else [])
        try:
            print(icp, name, printed(function(*here, *more)))
        except Exception as error:  # a refusal is a result, too
            print(icp, name, type(error).__name__, error)


def read(name):
    """The first case of an input file by cntc_readinpfile, and the values that can be read afterwards"""
    from contact import cntc
    from contact._library import case_status, last_error
    cntc.initlibrary(outdir=".", expnam="library", idebug=0)
    cntc.setglobalflags([cntc.CNTC["if_idebug"], cntc.CNTC["if_openmp"]], [0, 1])
    cntc.initialize(1, 1)
    cntc.setflags(1, -1, [cntc.CNTC["if_wrtinp"], cntc.CNTC["ic_matfil"], cntc.CNTC["ic_output"]], [1, 1, 4])
    print("read", cntc.readinpfile(1, cntc.CNTC["inp_modul1"], name), last_error(1, -1))
    for units in ("un_cntc", "un_spck", "un_si"):
        cntc.setflags(1, -1, [cntc.CNTC["if_units"]], [cntc.CNTC[units]])
        if units == "un_cntc":
            print("calculate", cntc.calculate(1, -1), last_error(1, -1), case_status(1, -1))
        print(units)
        for icp in range(-1, 1 + max(0, int(cntc.getnumcontactpatches(1)))):
            if icp != 0:
                ask(cntc, 1, icp)
    cntc.finalizelast()


def calls(script, arguments):
    """Record every call of a script"""
    import contact
    from contact import _library, cntc
    assert contact, "the package"
    plain = {name: getattr(_library, name) for name in ("call", "last_error", "case_status")}
    with open("calls.txt", "w", encoding="utf-8") as log:
        def noting(name):
            def wrapper(*values, **named):
                answer = plain[name](*values, **named)
                given = values[0] if name == "call" else name
                if given not in CHANGING:
                    log.write(f"{given} {printed(list(values[1:] if name == 'call' else values))} -> {printed(answer)}\n")
                return answer
            return wrapper
        for name, function in plain.items():
            for module in list(sys.modules.values()):
                if getattr(module, "__name__", "").split(".")[0] == "contact" and getattr(module, name, None) is function:
                    setattr(module, name, noting(name))
        assert cntc.call is not plain["call"]
        sys.argv = [script] + arguments
        sys.path.insert(0, os.path.dirname(script))
        runpy.run_path(script, run_name="__main__")


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    if sys.argv[1] == "run":
        run(sys.argv[2])
    elif sys.argv[1] == "read":
        read(sys.argv[2])
    else:
        calls(sys.argv[2], sys.argv[3:])
