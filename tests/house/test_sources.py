#!/usr/bin/env python3
"""Patterns that must not return to src, and to the top folder: one rule a line, each with its reason."""
import os
import pathlib
import re
import sys

# Allowed names in the top folder, besides names that begin with a dot; build is generated
TOP = {"CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "build", "doc", "examples", "include", "matlab", "python",
       "src", "tests"}
# A format in quotes: after the unit of write or read, or given to a variable
FORMAT = re.compile(r"""(?:\b(?:write|read)\s*\(\s*[\w%*]+\s*,\s*|\bform\w*(?:\([^)]*\))?\s*=\s*\[?)(['"])(\(.*?)\1""")


# Rooms that use control digits; all others use named choices
DOORS = {"control", "input", "output", "capi"}
DIGIT = re.compile(r"\bcase_digits\b|\bdigits\s*%|\bcontact_control_(?:digits|translation)\b")
# A message that names a digit: a capital letter with a digit after an equals sign; names in the code are in lower case
TOLD_DIGIT = re.compile(r"""\b(?:[A-Z]|C1|M2) ?= ?\d|\b[A-Z]-digit""")
# A message that names choices: motion = ""none"" or ""shift""
TOLD_CHOICE = re.compile(r"""([a-z_.]+) = (""\w+""(?:(?:, | or )""\w+"")*)""")
# A choice says what is done, never "as in the previous case"
KEEP = re.compile(r"::.*\bkeep\s*=\s*\d")
# A named choice compared with its number, and a digit compared with the choice of the same name
CHOICE = re.compile(r"\bspec%(force|motion|normal|pressure|kernel|material_model|solver|variation|link|estimate) ?"
                    r"(==|/=|[<>]=?) ?\d")
MIXED = re.compile(r"\bdigits%\w+ ?(==|/=) ?(motion|normal_control|force_control|variation|kernel_model|material_model)%")
# Procedures that compute a result read the specification and do not change it
PROCEDURE = re.compile(r"^ *(?:\w+ )*subroutine (\w+)\(.*?^ *end subroutine \1$", re.MULTILINE | re.DOTALL)
CHANGED_INPUT = re.compile(r"(?:type|class)\((?:\w+_spec|input_case)\), intent\(inout\)")
MADE_RESULT = re.compile(r"(?:type|class)\(\w+_result\), intent\((?:inout|out)\)")
# First line of a comment that begins in the middle of a sentence
CUT_OFF = re.compile(r"   !> [a-z]{3,}(?:$|,| [a-z])")
# The names that a module takes from another one; with the signs of operators they are not followed
IMPORT = re.compile(r"^ *use\b.*only : (.*)$", re.MULTILINE)
# A derived type with its components, the names in a declaration of components, and statements that may set a component
TYPE = re.compile(r"^ *type(?:, [^\n:]*)? ?:: (\w+)\n(.*?)^ *(?:contains|end type)\b", re.MULTILINE | re.DOTALL)
COMPONENTS = re.compile(r"^(?!.*\bprocedure\b).*?:: (.*)$", re.MULTILINE)
COMPONENT = re.compile(r"(\w+)(?:\([^()]*\))?(?: *=>? *[^,()]*(?:\([^()]*\))?)?(?:, |$)")
SETS = r"%{}\b[^=]*(?<![=/<>])=(?!=)|\b(?:call|allocate|move_alloc|read|open|inquire|source)\b|=>"


def unused_imports(text):
    """Names that a module takes from another one and does not use, also not as the kind of a number, 0.0_wp"""
    text = re.sub(r"&\s*\n\s*&", "", text)
    body = re.sub(r"^ *(?:use\b|!).*$", "", text, flags=re.MULTILINE)
    for names in IMPORT.findall(text):
        for name in names.split(","):
            name = name.split("=>")[0].strip()
            if re.fullmatch(r"\w+", name) and not re.search(rf"(?:\b|\d_){name}\b", body, re.IGNORECASE):
                yield name


def written_back(text):
    """Names of procedures that may store computed data in the specification"""
    for match in PROCEDURE.finditer(text):
        own = match[0].split("\n   contains\n")[0]
        if CHANGED_INPUT.search(own) and MADE_RESULT.search(own):
            yield match[1]


def offences(lines, room="base"):
    """Number, line and reason of each line that breaks a rule"""
    inside = False
    for number, line in enumerate(lines, 1):
        if inside and line.startswith("!"):
            yield number, line, "comments within a module are indented"
        inside = (inside or bool(re.match(r"(?:module|program) ", line))) and not line.startswith("end ")
        if CUT_OFF.match(line) and not (number > 1 and lines[number - 2].lstrip().startswith("!")):
            yield number, line.strip(), "a sentence begins with a capital: its first line was lost"
        if room not in DOORS and DIGIT.search(line):
            yield number, line.strip(), "digits end at the reader; a case has choices and parts"
        if room == "base" and KEEP.search(line):
            yield number, line.strip(), "what a case keeps is the source of its parts, not a choice"
        if room not in DOORS and not line.lstrip().startswith("!") and TOLD_DIGIT.search(line):
            yield number, line.strip(), 'messages below the readers name choices, sequence = "initiate", not digits'
        if CHOICE.search(line):
            yield number, line.strip(), "choices have names: spec%motion /= motion%none"
        if MIXED.search(line):
            yield number, line.strip(), "a digit is not a choice: problem%motion() returns the choice"
        for match in FORMAT.finditer(line):
            descriptors = re.sub(r"""(['"]).*?\1""", "", match[2])
            if re.search("[a-z]", descriptors):
                yield (number, line.strip(), ("an edit descriptor in small letters: the run-time library makes capitals of them "
                       "by the host's locale, and a Turkish i has none"))


def unknown_choices(text, keys, words):
    """Choices in messages that cannot be converted to digits"""
    joined = re.sub(r"&\n\s*&", "", text)
    for key, named in TOLD_CHOICE.findall(joined):
        for word in re.findall(r'""(\w+)""', named):
            if (keys.get(key), word) not in words:
                yield f'{key} = "{word}"'


def unset_components(texts):
    """Components of derived types that are read and never set; types with structure constructors are not judged"""
    code = [joined(text) for text in texts]
    used, owners, constructed = {}, {}, set()
    for text in code:
        for line in text.splitlines():
            for name in re.findall(r"%(\w+)", line):
                used.setdefault(name, []).append(line)
        constructed.update(re.findall(r"(?<!type\()(?<!class\()\b(\w+)\(", text))
        for kind, body in TYPE.findall(text):
            for name in (name for names in COMPONENTS.findall(body) for name in COMPONENT.findall(names)):
                owners.setdefault(name, set()).add(kind)
    for name, kinds in sorted(owners.items()):
        if len(kinds) == 1 and not kinds & constructed and name in used:
            sets = re.compile(SETS.format(name))
            if not any(sets.search(line) for line in used[name]):
                yield f"{min(kinds)}%{name}"


def joined(text):
    """The statements of a source, each on one line, without lines of comments"""
    return re.sub(r" *&\n *&", " ", re.sub(r"^ *!.*\n", "", text, flags=re.MULTILINE))


def lacks_default(declaration):
    """Does a declaration of components have one that a structure constructor must give?"""
    left, _, names = declaration.partition("::")
    while re.search(r"\([^()]*\)|\[[^][]*\]", names):
        names = re.sub(r"\([^()]*\)|\[[^][]*\]", "", names)
    return not re.search("allocatable|pointer|procedure", left) and any("=" not in name for name in names.split(",") if name)


def incomplete_constructors(texts):
    """Structure constructors without values, `kind()`, of types with a component that has no default of its own: gfortran accepts
    them, the standard and other compilers do not. A variable of the type, or allocate, has the same value"""
    code = [joined(text) for text in texts]
    needy = {kind for text in code for kind, body in TYPE.findall(text) if any(lacks_default(line) for line in body.splitlines())}
    for text in code:
        yield from (name for name in re.findall(r"(?<!type\()(?<!class\()(?<![%\w])(\w+)\(\)", text) if name in needy)


def refused_selectors(text):
    """Selectors of `associate` with a function that is bound to a type of the same module: gfortran 14 refuses them"""
    code = joined(text)
    lists = re.findall(r"^ *procedure\b[^:\n]*:: *(.+)$", code, re.MULTILINE)
    bound = {name for names in lists for name in re.findall(r"(\w+)(?: *=> *\w+)?", names)}
    for line in code.splitlines():
        if re.match(r" *associate *\(", line):
            yield from (name for name in re.findall(r"\bself%(\w+)\(", line) if name in bound)


def main():
    """All files of src"""
    planted = list(offences(["   write(text, '(a, i0)') what", "   if (bad) write(unit, '(es12.4)', iostat=status) x",
                             "   write(text, '(A, I0)') 'a', 1", "   read(number, form, iostat=status) value",
                             """   write(name, '("case_", i0)') k""", """   write(name, '("case_", I0)') k"""]))
    assert [line[0] for line in planted] == [1, 2, 5], planted
    cut = ["", "   !> cases", "   !> A part", "   !> sign, and the rest", "", "   !> slip := slip + what", "",
           "   !> sign, and that"]
    assert [line[0] for line in offences(cut)] == [2, 8], "texts whose beginning is lost"
    digits = ["   if (spec%digits%c >= 2) return", "      integer :: none = 0, keep = 1", "   keep = 1"]
    assert [line[0] for line in offences(digits, "base")] == [1, 2], "digits and kept values in choices"
    assert [line[0] for line in offences(digits, "input")] == [], "digits of the reader"
    lines = ['   call fatal_error(error, "conformal contact (C = 4) needs")', '   text = "the solver of the G-digit"',
            '   ! C = 4', '   text = "GG = 4, DX = 1 and motion = ""shift"""', '   call say("P=2 with I=0")']
    assert [line[0] for line in offences(lines, "patch")] == [1, 2, 5], "digits in messages"
    assert not list(offences(lines, "input")), "digits in messages of the reader"
    mixed = ["   if (spec%motion > 0) return", "   if (digits%t == motion%shift) return", "   if (spec%force /= force_control%a)"]
    assert [line[0] for line in offences(mixed, "capi")] == [1, 2], "numbers of choices"
    made = ("   pure subroutine a(spec, result)\n      type(case_spec), intent({}) :: spec\n"
            "      type(patch_result), intent(out) :: result\n   end subroutine a\n")
    taken = ("   use a, only : wp, long, &\n      & one, two, operator(+)\n   use b, only : mine => yours, three\n   ! two\n"
             "   x = 0.0_wp + one(mine)\n   call tell('three')\n")
    assert list(unused_imports(taken)) == ["long", "two"], "names that are taken and not used"
    assert list(written_back(made.format("inout"))) == ["a"] and not list(written_back(made.format("in"))), "results in the input"
    comments = ["!> A module", "module a", "!> a component", "   !> Another", "end module a", "! behind it"]
    assert [line[0] for line in offences(comments)] == [3], "comments that are not indented"
    shape = ("type :: shape\n real(wp) :: bend = 0.0_wp, cusp = 0.0_wp\nend type shape\n"
             "s%bend = 1.0_wp\nif (s%cusp == 0.0_wp) e = s%bend + s%cusp\n")
    assert list(unset_components([shape])) == ["shape%cusp"], "components that are never set"
    assert not list(unset_components([shape, "call find(&\n & s%cusp)\n"])), "a component that a call may set"
    kinds = ("type :: whole\n integer :: n(2) = [1, 2], m = max(1, 2)\n real, allocatable :: x(:)\nend type whole\n"
             "type :: needy\n type(whole) :: part\nend type needy\na = whole()\nallocate(b, source=needy())\ntype(needy) :: c\n")
    assert list(incomplete_constructors([kinds])) == ["needy"], "structure constructors that lack a value"
    bound = ("procedure, private :: place\nprocedure :: at => that\n"
             "associate (a => self%x(self%place(1)), &\n & b => self%y(2))\nassociate (a => self%y(place))\n")
    assert list(refused_selectors(bound)) == ["place"], "bound functions in selectors of associate"
    top = pathlib.Path(os.environ["CONTACT_SOURCE"])
    keys = pathlib.Path(top, "src/control/words.f90").read_text(encoding="utf-8")
    keys = {f"{group}.{key}" if group else key: name
            for name, group, key in re.findall(r'key_row\("(\w+)", \w+, "(\w*)", "(\w+)"', keys)}
    digits = pathlib.Path(top, "src/control/digits.f90").read_text(encoding="utf-8").replace("&\n", "")
    words = set(re.findall(r'digit_row\("(\w+)",[^"]*"[^"]*",[ &]*"(\w+)"\)', digits))
    assert list(unknown_choices('"motion = ""none"", ""shift"" &\n   &or ""rest"""', keys, words)) == ['motion = "rest"']
    files = sorted(pathlib.Path(top, "src").rglob("*.f90"))
    unset = list(unset_components(file.read_text(encoding="utf-8") for file in files))
    tests = sorted(file for folder in ("tests", "examples") for file in pathlib.Path(top, folder).rglob("*.f90"))
    incomplete = sorted(incomplete_constructors(file.read_text(encoding="utf-8") for file in files + tests))
    left_out = sorted(name for name in os.listdir(top) if name not in TOP and not name.startswith("."))
    bad = len(left_out) + len(unset) + len(incomplete)
    if unset:
        print(f"FAILED components that are read and never set: {', '.join(unset)}")
    if incomplete:
        print(f"FAILED structure constructors without values for all components: {', '.join(incomplete)}")
    if left_out:
        print(f"FAILED {top} holds {left_out[:10]}: left by a test that ran there, or misplaced")
    for file in files:
        if file.parent.name in DOORS:
            continue
        for choice in unknown_choices(file.read_text(encoding="utf-8"), keys, words):
            bad += 1
            print(f"FAILED {file}: no reader knows the choice {choice}")
    for file in files + tests:
        for name in refused_selectors(file.read_text(encoding="utf-8")):
            bad += 1
            print(f"FAILED {file}: {name} is bound to a type of this module and stands in a selector of associate; "
                  "a local variable takes its result")
    for file in files:
        for name in unused_imports(file.read_text(encoding="utf-8")):
            bad += 1
            print(f"FAILED {file}: {name} is taken from another module and not used")
        for name in written_back(file.read_text(encoding="utf-8")):
            bad += 1
            print(f"FAILED {file}: {name} makes a result and may change its specification: problem in, result out")
        for number, line, reason in offences(file.read_text(encoding="utf-8").splitlines(), file.parent.name):
            bad += 1
            print(f"FAILED {file}:{number}: {line}\n  {reason}")
    print(f"{len(files)} files, {bad} offences")
    return 1 if bad or len(files) < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
