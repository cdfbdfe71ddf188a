"""Generate the functions for Matlab and GNU Octave that call the routines of the library; used by make_interface.py."""
import os
import re
import textwrap

WIDTH = 116
LETTERS = {("in", "int"): "i", ("in", "real"): "r", ("in", "text"): "s",
           ("out", "int"): "I", ("inout", "int"): "I", ("out", "real"): "R", ("inout", "real"): "R"}
IDS = {"patch": "result element and contact patch or problem (default 1, 1)",
       "patch or whole": "result element and contact patch or problem (default 1, 1); -1: wheel and rail as a whole",
       "whole": "result element (default 1) and contact patch or problem; -1 (default): wheel and rail as a whole",
       "pair": "result element of a wheel-rail problem (default 1)"}
IDEBUG = ("idebug", "1: report error codes; 2: also remarks; 0: silent (default: that of cntc_initlibrary)")
#: Functions of matlab/ without a routine, by the section of Contents.m at the beginning of which they are listed
FURTHER = {"Begin and end": ["cntc_buildmex", "cntc_initlibrary", "cntc_managelicense", "cntc_getmagicnumbers",
                             "cntc_closelibrary"], "Settings of both modules": ["cntc_setmaterialproperties"],
           "Settings of basic contact": ["cntc_setinterfaciallayer"],
           "Settings of wheel and rail": ["cntc_settrackdimensions_new", "cntc_settrackdimensions_old"],
           "Results": ["cntc_getcpresults"]}


class Function:
    """A function: the arguments of the routine that callers pass, and the values of the other arguments"""

    def __init__(self, routine, constants, origin):
        self.routine, self.origin = routine, origin
        values = {item.name: item.value for _, items in constants for item in items}
        words = routine.words
        self.by_hand, self.absent = "by hand" in words, "no function" in words
        self.idebug, self.silent = "idebug" in words, "silent" in words
        self.defaults = {name: (str(values.get(value, value)), value)
                         for name, value in (re.split(r" = ", word) for word in words if " = " in word)}
        self.see = [word[4:] for word in words if word.startswith("see ")]
        self.kind = next((word for word in words if word in (*IDS, "element")), None)
        self.lengths = {name: item for item in reversed(routine.arguments) if item.kind != "text" and len(item.lengths) == 1
                        for name in item.lengths}
        self.texts = {item.lengths[0]: item for item in routine.arguments if item.kind == "text"}
        self.inputs = [item for item in routine.arguments
                       if item.direction == "in" and item.name not in self.lengths and item.name not in self.texts]
        self.outputs = [item for item in routine.arguments if item.direction != "in"]
        self.is_grid = any(item.size == "grid" and item.direction != "in" for item in routine.arguments)

    def given(self):
        """Names of the arguments of the function"""
        return [outer(item.name) for item in self.inputs] + (["idebug"] if self.idebug else [])

    def help(self):
        """Lines of the help text"""
        name, results = self.routine.name, [outer(item.name) for item in self.outputs]
        left = f"[{', '.join(results)}] = " if len(results) > 1 else f"{results[0]} = " if results else ""
        lines = [f"{name.upper()}  {' '.join(self.routine.text)}", "", f"  {left}{name}( {', '.join(self.given())} )", ""]
        about = [(names, with_defaults(names, text, self.defaults)) for names, text in self.routine.about]
        described = {name for names, _ in about for name in re.split(r", ", names)}
        if self.kind in IDS:
            about.insert(0, ("ire" if self.kind == "pair" else "ire, icp", IDS[self.kind]))
        elif self.kind == "element":
            about = [(names, text + " (default 1)" if names == "ire" else text) for names, text in about]
        if self.idebug:
            about.append(IDEBUG)
        indent = 4 + max([8] + [len(", ".join(map(outer, names.split(", ")))) for names, _ in about])
        for names, text in about:
            if names:
                first = f"  {', '.join(map(outer, names.split(', '))):<{indent - 2}}"
                lines += textwrap.wrap(text, WIDTH, initial_indent=first, subsequent_indent=" " * indent,
                                       break_long_words=False, break_on_hyphens=False)
            else:
                lines.append("  " + text)
        rest = [f"{outer(key)} = {shown}" for key, (_, shown) in self.defaults.items() if key not in described]
        if rest:
            lines.append(f"  Default: {', '.join(rest)}.")
        if self.is_grid or any(item.size == "grid" for item in self.inputs):
            lines.append("  Values of elements are (my,mx) arrays" + ("; 0 if there is no grid yet." if self.is_grid else "."))
        if self.see:
            lines += ["", f"See also: {', '.join(self.see)}."]
        return [("% " + re.sub(r"\bCNTC_(?=[a-z])", "CNTC.", line)).rstrip() for line in lines + ["", self.origin]]

    def body(self):
        """Lines of the code"""
        name, places, lines = self.routine.name, {item: k for k, item in enumerate(self.given(), 1)}, []

        def default(argument, value, note=""):
            lines.extend([f"   if (nargin<{places[argument]} || isempty({argument}))", f"      {argument} = {value};{note}",
                          "   end"])

        if self.kind == "element":
            default("ire", "1")
        elif self.kind:
            ids = ["ire"] if self.kind == "pair" else ["ire", "icp"]
            for item in ids:
                lines += [f"   if (nargin<{places[item]})", f"      {item} = [];", "   end"]
            lines.append("   ire = cntc_ids(ire);" if self.kind == "pair"
                         else f"   [ire, icp] = cntc_ids(ire, icp, '{self.kind}', '{name}');")
        for argument, (value, shown) in self.defaults.items():
            default(outer(argument), value, f"   % {shown.replace('_', '.', 1)}" if value != shown else "")
        if self.idebug:
            default("idebug", "cntc_library('idebug')")
        lists = [item for item in self.inputs if item.is_array and item.kind != "text" and len(self.sharing(item)) > 1]
        if len(lists) == 2:
            first, second = (item.name for item in lists)
            text = f"{first} has %d values, {second} has %d." if lists[0].size else f"there are %d {first} and %d {second}."
            lines += [f"   if (numel({first})~=numel({second}))",
                      f"      error('{name}: {text}', numel({first}), numel({second}));", "   end"]
        fields = [item.name for item in self.inputs if item.size == "grid"]
        lines += [f"   {item} = {item}';" for item in fields]
        results = [outer(item.name) for item in self.outputs]
        if self.is_grid:
            lines += ["   [mx, my] = cntc_getnumelements(ire, icp);", "   if (mx*my<=0)"]
            lines += [f"      {item} = 0;" for item in results] + ["      return", "   end"]
        left = f"[{', '.join(results)}] = " if len(results) > 1 else f"{results[0]} = " if results else ""
        words = ", ".join([f"'{name}'"] + [self.passed(item, fields) for item in self.routine.arguments])
        lines += [line.replace("\xa0", " ") for line in textwrap.wrap(
            f"   {left}cntc_call({words});".replace(" ", "\xa0").replace(",\xa0", ", "), WIDTH,
            subsequent_indent=" " * (len(left) + 13))]
        lines[:] = [line + " ..." if line.endswith(",") else line for line in lines]
        if self.kind and not self.silent:
            problem = "icp" if "icp" in places else "-1"
            code = ", ierror" if "ierror" in results else ""
            lines.append(f"   cntc_report_errors('{name}', ire, {problem}{code}{', idebug' if self.idebug else ''});")
        if self.is_grid:
            lines += [f"   {item} = {item}';" for item in results]
        return lines

    def sharing(self, item):
        """Arguments of equal length"""
        return [other for other in self.inputs if other.lengths == item.lengths]

    def passed(self, item, fields):
        """Expression passed to the routine for one of its arguments"""
        if item.name in self.texts:
            return f"numel({outer(self.texts[item.name].name)})"
        if item.name in self.lengths:
            array = self.lengths[item.name]
            if array.direction != "in" and array.size:
                return "mx*my" if array.size == "grid" else array.size
            return f"numel({array.name})"
        if item in self.inputs:
            return f"{item.name}(:)" if item.name in fields else outer(item.name)
        if not item.is_array:
            return "[]"
        if item.size == "grid":
            return "zeros(mx,my)"
        if item.size:
            return f"zeros({item.size},1)"
        if len(item.lengths) == 2:
            return f"zeros({','.join(item.lengths)})"
        return f"zeros(numel({self.lengths[item.lengths[0]].name}),1)"

    def lines(self):
        """The whole file"""
        results = [outer(item.name) for item in self.outputs]
        left = f"[ {', '.join(results)} ] = " if results else ""
        return [f"function {left}{self.routine.name}( {', '.join(self.given())} )", *self.help(), "", *self.body(), "",
                f"end % function {self.routine.name}"]


def outer(name):
    """Name of an argument outside of C"""
    return name.removeprefix("c_")


def with_defaults(names, text, defaults):
    """Description of an argument with its default"""
    shown = [defaults[name][1] for name in names.split(", ") if name in defaults and defaults[name][1] not in ("' '", "[]")]
    return f"{text} (default {', '.join(shown)})" if shown else text


def magic_numbers(constants, origin):
    lines = ["function [ CNTC ] = cntc_getmagicnumbers( )",
             "% CNTC_GETMAGICNUMBERS  Struct with the named numbers of flags, fields, and so on.", "%",
             "%   CNTC = cntc_getmagicnumbers()"]
    for title, items in constants:
        lines += ["%", f"% {title}", "%"]
        lines += [f"%   CNTC.{item.name.removeprefix('CNTC_'):<12} {item.text}" for item in items]
    lines += ["%", "% " + origin, ""]
    for _, items in constants:
        lines += [f"   CNTC.{item.name.removeprefix('CNTC_')} = {item.value};" for item in items]
    return lines + ["", "end % function cntc_getmagicnumbers"]


def signatures(routines, origin):
    lines = ["function [ letters ] = cntc_signature( name )",
             "% CNTC_SIGNATURE  Kinds of the arguments of a routine of the library, one letter each.", "%",
             "%   i, r, s   integers, real numbers, text going in",
             "%   I, R      integers, real numbers coming out", "%", "% " + origin, "",
             "   persistent table;", "   if (isempty(table))"]
    for _, items in routines:
        for routine in items:
            letters = "".join(LETTERS[argument.direction, argument.kind] for argument in routine.arguments)
            lines.append(f"      table.{routine.name} = '{letters}';")
    return lines + ["   end", "   if (~isfield(table, name))",
                    "      error('cntc_signature: the library has no routine %s.', name);", "   end",
                    "   letters = table.(name);", "", "end % function cntc_signature"]


def contents(folder, routines, functions):
    """Text of Contents.m: the part before the library is written by hand"""
    with open(os.path.join(folder, "Contents.m"), encoding="utf-8") as file:
        lines = file.read().split("% The library: ")[0].rstrip("\n").split("\n")
    for title, items in routines:
        title = title.split(";")[0]
        names = FURTHER.get(title, []) + [item.name for item in items if not functions[item.name].absent]
        lines += [f"% The library: {title[0].lower()}{title[1:]}.", "%"]
        lines += [f"%   {name:<27} - {first_line(folder, functions, name)}" for name in names] + ["%"]
    return lines[:-1]


def first_line(folder, functions, name):
    """Purpose of a function in one line"""
    if name in functions:
        text = " ".join(functions[name].routine.text)
    else:
        with open(os.path.join(folder, name + ".m"), encoding="utf-8") as file:
            text = next(line for line in file if line.startswith("%")).split("  ", 1)[1].strip()
    return text[0].lower() + text[1:]


def files(constants, routines, top, origin):
    """Lines of all files by path"""
    folder = os.path.join(top, "matlab")
    functions = {item.name: Function(item, constants, origin) for _, items in routines for item in items}
    made = {f"matlab/{name}.m": function.lines() for name, function in functions.items()
            if not function.by_hand and not function.absent}
    made["matlab/cntc_getmagicnumbers.m"] = magic_numbers(constants, origin)
    made["matlab/private/cntc_signature.m"] = signatures(routines, origin)
    made["matlab/Contents.m"] = contents(folder, routines, functions)
    return made
