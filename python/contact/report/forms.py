"""New experiments from a form, for common cases, in either format of the input.

The form is defined here; the page displays it and sends names and values back. The input is written in the readable format,
checked by the program, and converted by it if the other format is requested. A refused input is deleted again.
"""
from __future__ import annotations

import json
import math
import os
import re
import subprocess
from typing import Any

from .folder import FORMATS, Folder
from .job import program_path

#: Pattern of names of new experiments, maximum number of cases of one, and time limit of its check [s]
NAME, MAX_CASES, CHECK_TIME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,59}"), 500, 30.0

STEEL = [("gg", "Modulus of rigidity", "N/mm\u00b2", 82000.0), ("poiss", "Poisson ratio", "", 0.28)]
#: Kinds of experiments. A field is (name, label, unit, initial value) or, for a choice, (name, label, [(value, words)]), or,
#: for a file, (name, label, "profile", preferred suffixes); "vary" has the fields that can vary from case to case, with the
#: group of the input to which each belongs
KINDS: dict[str, dict[str, Any]] = {
    "hertz": {
        "title": "Two smooth bodies (Hertz)",
        "fields": [("motion", "Motion", [("steady_rolling", "steady rolling"), ("shift", "shift"), ("none", "frictionless")]),
                   ("fn", "Normal force", "N", 10000.0),
                   ("rx", "Radius along x, 1/R = 1/R1 + 1/R2", "mm", 460.0), ("ry", "Radius across", "mm", 300.0),
                   ("cksi", "Longitudinal creepage, or shift in mm", "", -0.001),
                   ("ceta", "Lateral creepage, or shift in mm", "", 0.0),
                   ("cphi", "Spin in rad/mm, or rotation in rad", "", 0.0), ("fstat", "Coefficient of friction", "", 0.3),
                   ("veloc", "Rolling velocity", "mm/s", 20000.0), *STEEL, ("mx", "Elements along x and across", "", 31)],
        "vary": {"fn": "kinematics", "cksi": "kinematics", "ceta": "kinematics", "cphi": "kinematics"}},
    "wheel": {
        "title": "A wheel on a rail",
        "fields": [("configuration", "Side", [("right_on_track", "right wheel"), ("left_on_track", "left wheel")]),
                   ("rail", "Profile of the rail", "profile", (".prr", ".rail")),
                   ("wheel", "Profile of the wheel", "profile", (".prw", ".whl", ".wheel")),
                   ("fz", "Vertical force on the wheel", "N", 60000.0), ("fx_ws", "Longitudinal force, 0: rolls freely", "N", 0.0),
                   ("y_ws", "Lateral position of the wheelset", "mm", 0.0), ("yaw", "Yaw angle", "rad", 0.0),
                   ("vs", "Forward speed", "mm/s", 20000.0), ("fstat", "Coefficient of friction", "", 0.3), *STEEL,
                   ("gaugwd", "Gauge", "mm", 1435.0), ("gaught", "Height of the gauge point", "mm", 14.0),
                   ("cant", "Cant of the rail", "rad", 0.025), ("fbdist", "Flange-back distance", "mm", 1360.0),
                   ("fbpos", "Position of the flange back in the profile", "mm", -70.0),
                   ("nomradw", "Nominal radius of the wheel", "mm", 460.0),
                   ("dx", "Size of the elements", "mm", 0.4)],
        "vary": {"fz": "position", "y_ws": "position", "yaw": "position", "fx_ws": "velocity"}},
}
#: Templates of the first case
HERTZ = """module = "contact"
motion = "{motion}"
normal = "force"
tangential = "creepages"
output_level = 2

[case.kinematics]
fn = {fn}
cksi = {cksi}
ceta = {ceta}
cphi = {cphi}

[case.friction]
fstat = {fstat}
fkin = {fstat}

[case.rolling]
dq = {dq}
veloc = {veloc}

[case.material]
gg = [{gg}, {gg}]
poiss = [{poiss}, {poiss}]

[case.grid]
form = "hertz_curvatures"
mx = {mx}
my = {mx}
a1 = {a1}
b1 = {b1}
scale = 1.2
"""
WHEEL = """module = "wheel_rail"
configuration = "{configuration}"
motion = "steady_rolling"
normal = "force"
tangential = "longitudinal_force"
output_level = 2

[case.friction]
fstat = {fstat}
fkin = {fstat}

[case.material]
gg = [{gg}, {gg}]
poiss = [{poiss}, {poiss}]

[case.search]
location = "locus"
dx = {dx}
ds = {dx}
a_sep = "90 deg"
d_turn = 12

[case.track]
gaught = {gaught}
gaugsq = 0
gaugwd = {gaugwd}
cant = {cant}

[case.rail_profile]
file = {rail}

[case.wheel_dimensions]
fbdist = {fbdist}
fbpos = {fbpos}
nomradw = {nomradw}

[case.wheel_profile]
file = {wheel}

[case.position]
fz = {fz}
y_ws = {y_ws}
yaw = {yaw}

[case.velocity]
vs = {vs}
fx_ws = {fx_ws}
"""


class Refused(Exception):
    """The form does not define a valid experiment; the message gives the reason"""


def form_of(folder: Folder, place: str) -> dict[str, Any]:
    """Data with which the page displays the form for new experiments in a folder"""
    return {"kinds": KINDS, "profiles": folder.profiles(place), "formats": FORMATS, "most": MAX_CASES}


def _values(kind: dict[str, Any], given: dict[str, Any], profiles: list[str]) -> dict[str, Any]:
    """The fields of a form, each one checked"""
    values: dict[str, Any] = {}
    for name, label, third, *_ in kind["fields"]:
        value = given.get(name)
        if isinstance(third, list):
            if value not in [choice for choice, _ in third]:
                raise Refused("%s is not one of the choices" % label)
        elif third == "profile":
            if value not in profiles:
                raise Refused("%s: there is no such file in this folder" % label)
        else:
            value = _number(label, value)
        values[name] = value
    return values


def _number(label: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value) or abs(value) > 1e9:
        raise Refused("%s is not a valid number" % label)
    return float(value)


def text_of(kind: str, values: dict[str, Any], vary: str = "", to: float = 0.0, count: int = 1) -> str:
    """The input in the readable format; one field may vary to another value in equal steps"""
    if kind == "hertz":
        if not (values["rx"] > 0.0 and values["ry"] > 0.0 and values["mx"] >= 1.0):
            raise Refused("Radii and number of elements must be positive")
        # about one element, for a ball of the mean radius on a plane (Hertz 1882); the program uses the element of its grid
        stiffness = values["gg"] / max(1.0 - values["poiss"], 0.1)
        radius = (0.75 * abs(values["fn"]) * math.sqrt(values["rx"] * values["ry"]) / max(stiffness, 1e-9)) ** (1 / 3)
        lines = HERTZ.format(**{**values, "mx": int(values["mx"]), "a1": 0.5 / values["rx"], "b1": 0.5 / values["ry"],
                                "dq": "%.3g" % max(2.4 * radius / values["mx"], 1e-6)})
        if values["motion"] != "steady_rolling":
            lines = re.sub(r"\[case\.rolling\]\n.*\n.*\n\n", "", lines)
    else:
        lines = WHEEL.format(**{**values, "rail": json.dumps(values["rail"]), "wheel": json.dumps(values["wheel"])})
    cases = ["[[case]]\n" + lines]
    for step in range(1, count):
        at = values[vary] + (to - values[vary]) * step / (count - 1)
        cases.append("[[case]]\n[case.%s]\n%s = %.12g\n" % (KINDS[kind]["vary"][vary], vary, at))
    return "\n".join(cases)


def _parse_form(body: bytes) -> tuple[dict[str, Any], str, str, str]:
    """The form as it was sent, with name, folder and format"""
    try:
        data = json.loads(body)
    except ValueError:
        data = None
    if not isinstance(data, dict) or not isinstance(data.get("values"), dict):
        raise Refused("the form is invalid")
    name, place, form = (data.get(key) for key in ("name", "folder", "format"))
    if not isinstance(name, str) or not NAME.fullmatch(name):
        raise Refused("A name consists of at most 60 letters, digits, - and _, and begins with a letter or a digit")
    if not isinstance(place, str) or form not in FORMATS or data.get("kind") not in KINDS:
        raise Refused("the form is invalid")
    return data, name, place, str(form)


def new_input(folder: Folder, body: bytes) -> dict[str, Any]:
    """Write the experiment of a form into a folder; returns its name and the messages of the program's check"""
    data, name, place, form = _parse_form(body)
    kind = KINDS[data["kind"]]
    path = folder.place(place)
    if path is None:
        raise Refused("there is no such folder")
    values = _values(kind, data["values"], folder.profiles(place))
    vary, count = data.get("vary") or "", data.get("count", 1)
    if vary and vary not in kind["vary"]:
        raise Refused("%s cannot be varied" % vary)
    if isinstance(count, bool) or not isinstance(count, int) or not 1 <= count <= MAX_CASES or (count > 1) != bool(vary):
        raise Refused("The number of cases must be 2 to %d if a value varies" % MAX_CASES)
    text = text_of(data["kind"], values, vary, _number("The last value", data.get("to", 0.0)), count)
    base = os.path.join(path, name)
    if any(os.path.lexists("%s.%s" % (base, other)) for other in FORMATS):
        raise Refused("there is already an experiment %s" % name)
    return {"name": (place + "/" if place else "") + name, "messages": _written(base, form, text)}


def _written(base: str, form: str, text: str) -> str:
    """Write an input in the readable format, check it, and convert it if the other format is requested; messages of the check"""
    source = base + ".toml"
    try:
        with open(source, "x", encoding="utf-8") as file:  # never overwrites a file or a link
            file.write(text)
    except OSError as reason:
        raise Refused("%s could not be written: %s" % (source, reason.strerror)) from None
    keep = False
    try:
        name = os.path.basename(base)
        messages = _program(base, "--confine", "--", "3", name + ".toml").replace(name + ".toml:", "%s.%s:" % (name, form))
        if form != "toml":
            _program(base, "convert", source)
        keep = form == "toml"
        return messages
    finally:
        if not keep:
            os.remove(source)


def _program(base: str, *arguments: str) -> str:
    """Output of the program; raises Refused if it fails"""
    try:
        run = subprocess.run([program_path(), *arguments], cwd=os.path.dirname(base), stdin=subprocess.DEVNULL,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", timeout=CHECK_TIME,
                             check=False)
    except subprocess.TimeoutExpired:
        raise Refused("the check took longer than %d s" % CHECK_TIME) from None
    if run.returncode:
        raise Refused("\n".join(line.strip() for line in run.stdout.splitlines() if "ERROR" in line) or run.stdout[-2000:])
    return run.stdout
