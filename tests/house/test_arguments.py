#!/usr/bin/env python3
"""Every dummy argument of a public procedure says what it is, by a comment with its declaration.

Public are the procedures that a module names after `public`, those behind the public bindings of a public type, and the
abstract interfaces of either. Exempt are `self`, which its type describes, and the arguments of a procedure that overrides
another where the first one describes them. A comment is `!>` above the declaration or `!!` behind it, as FORD reads them; one
comment serves all names of its declaration. A comment that only repeats the words of the name and the type is none. Described
elsewhere are the arguments that mean the same everywhere (doc/develop/glossary.md), those of cntc_* and subs_*
(src/capi/interface.txt), and those of the functions of include/contact.h.
"""
import os
import pathlib
import re
import sys

PROCEDURE = re.compile(r"^(?!end\b)(?:[a-z][^'\"!]*\s)?(?:subroutine|function)\s+(\w+)\s*(\([^)]*\))?")
KIND = re.compile(r"(?:(?:type|class)\(\s*)?(\w+)")
HOUSEHOLD = re.compile(r"^\| (`\w+`(?:, `\w+`)*) \| `(\w+)` \| \w", re.MULTILINE)
ROUTINE = re.compile(r"^((?:cntc|subs)_\w+)\(", re.MULTILINE)
FUNCTION = re.compile(r"\b(contact_\w+)\(")
BLOCK = re.compile(r"^(?:abstract )?interface\b\s*(\w*)")
TYPE = re.compile(r"^type\s*(?:,\s*([^:]*))?::\s*(\w+)|^type\s+(\w+)\s*$")
DECLARATION = re.compile(r"^(?:integer|real|complex|logical|character|type|class|procedure)\b.*?::\s*(.*)")
#: Words that add nothing to a name
EMPTY = {"a", "an", "the", "of", "this", "that", "its", "it", "value", "values", "argument", "type"}


def statements(lines):
    """Number, text and comment of each statement, continued lines joined, in lower case"""
    text, comment, number = "", [], 0
    found = []
    for count, raw in enumerate(lines, 1):
        line = raw.strip()
        if line.startswith("!>"):
            comment.append(line[2:].strip())
            continue
        if line.startswith("!!") and found:
            found[-1][2] += " " + line[2:].strip()
            continue
        if line.startswith("!") or not line:
            if not text:
                comment = [] if not line else comment
            continue
        code, behind = split_comment(line)
        if not text:
            number = count
        text += code.lstrip("&").strip() if text else code
        if behind.startswith("!!"):
            comment.append(behind[2:].strip())
        if text.endswith("&"):
            text = text[:-1].rstrip() + " "
            continue
        found.append([number, text, " ".join(comment)])
        text, comment = "", []
    return found


def split_comment(line):
    """Code and comment of a line"""
    quote = ""
    for k, letter in enumerate(line):
        if quote:
            quote = "" if letter == quote else quote
        elif letter in "'\"":
            quote = letter
        elif letter == "!":
            return line[:k].rstrip(), line[k:]
    return line, ""


def names_of(entities):
    """Names in a list of entities with dimensions and initial values"""
    depth, flat = 0, ""
    for letter in entities:
        depth += {"(": 1, "[": 1, ")": -1, "]": -1}.get(letter, 0)
        flat += letter if depth == 0 and letter not in ")]" else ""
    return [re.match(r"\s*(\w*)", part)[1] for part in flat.split(",")]


class Source:
    """Contents of a module: procedures with their arguments, types with their bindings, public names"""

    def __init__(self, lines):
        #: name -> list of (argument, number of the line, declaration, comment), in the order of the declarations
        self.procedures = {}
        #: type -> (parent, is it public by its attribute, {binding: procedure}, {generic or public bindings})
        self.types = {}
        #: generic name -> procedures
        self.generics = {}
        self.public, self.closed = set(), False
        self.read(statements(lines))

    def read(self, found):
        """Parse the statements of a file"""
        stack, block, kind, bound = [], None, None, False
        for number, text, comment in found:
            low = text.lower()
            if kind is not None:
                if low.startswith("end type"):
                    kind = None
                elif low == "contains":
                    bound = True
                elif bound:
                    self.bind(kind, low)
                continue
            if re.match(r"end\s*(subroutine|function|procedure)\b", low):
                stack.pop()
            elif low.startswith("end interface"):
                block = None
            elif BLOCK.match(low) and not stack:
                block = BLOCK.match(low)[1]
            elif block and low.startswith(("module procedure", "procedure ::")):
                self.generics.setdefault(block, []).extend(names_of(low.split("procedure")[1].lstrip(": ")))
            elif PROCEDURE.match(low):
                name, dummies = PROCEDURE.match(low).groups()
                stack.append(name)
                if len(stack) == 1:
                    self.procedures[name] = ([d.strip() for d in (dummies or "()")[1:-1].split(",") if d.strip()], [])
            elif not stack and TYPE.match(low) and not low.startswith("type("):
                attributes, name, plain = TYPE.match(low).groups()
                kind, bound = name or plain, False
                parent = re.search(r"extends\s*\(\s*(\w+)", attributes or "")
                self.types[kind] = [parent and parent[1], "public" in (attributes or ""), {}, set(), False]
            elif not stack and low == "private":
                self.closed = True
            elif not stack and re.match(r"public\b", low):
                self.public |= set(names_of(re.sub(r"^public\s*(::)?", "", low)))
            elif len(stack) == 1 and DECLARATION.match(low):
                dummies, declared = self.procedures[stack[0]]
                for name in names_of(DECLARATION.match(low)[1]):
                    if name in dummies:
                        declared.append((name, number, low, comment))
        assert not stack, stack

    def bind(self, kind, low):
        """One line of the bindings of a type"""
        if low == "private":
            self.types[kind][4] = True
            return
        match = re.match(r"(procedure|generic)\s*(\(\s*\w+\s*\))?\s*((?:,\s*\w+(?:\(\w+\))?\s*)*)(?:::)?\s*(.*)", low)
        if not match:
            return
        what, interface, attributes, rest = match.groups()
        hidden = "private" in attributes or (self.types[kind][4] and "public" not in attributes)
        if what == "generic":
            if not hidden:
                self.types[kind][3] |= {name.strip() for name in rest.split("=>")[1].split(",")}
            return
        for part in rest.split(","):
            name, _, target = (word.strip() for word in part.partition("=>"))
            self.types[kind][2][name] = interface.strip("() ") if interface else target or name
            if not hidden:
                self.types[kind][3].add(name)


def first_of(kind, binding, types):
    """Module and procedure of the first type that has a binding, up the parents of a type"""
    found = None
    while kind in types:
        source, (parent, _, bindings, *_) = types[kind]
        if binding in bindings:
            found = source, bindings[binding]
        kind = parent
    return found


def echoes(comment, name, declaration):
    """Does a comment only repeat the name and the type?"""
    said = set(re.findall(r"[a-z0-9]+", comment.lower()))
    return not said - EMPTY - set(re.findall(r"[a-z0-9]+", (name + " " + declaration.split("::")[0]).replace("_", " ")))


def is_household(declaration, name, household):
    """Is this an argument of the glossary, with the same meaning everywhere?"""
    kind = KIND.match(declaration)
    return kind is not None and (name, kind[1]) in household


def offences(sources, household=(), routines=()):
    """Source, line, procedure and argument of each argument without a comment; sources by their names; arguments with their types
    and procedures that are described elsewhere"""
    types = {kind: (source, what) for source in sources.values() for kind, what in source.types.items()}
    for key, source in sources.items():
        public = {n for name in source.public for n in source.generics.get(name, [name])}
        if not source.closed:
            public |= set(source.procedures)
        first = {}
        for kind, (_, is_public, bindings, shown, _) in source.types.items():
            if not (is_public or kind in source.public or not source.closed):
                continue
            for binding in shown & set(bindings):
                public.add(bindings[binding])
                first[bindings[binding]] = first_of(kind, binding, types)
        for name in sorted((public & set(source.procedures)) - set(routines)):
            described = set()
            if name in first and first[name] != (source, name):
                other, origin = first[name]
                described = {d[0] for d in other.procedures.get(origin, ([], []))[1]}
            for dummy, number, declaration, comment in source.procedures[name][1]:
                if is_household(declaration, dummy, household):
                    continue
                if dummy != "self" and dummy not in described and echoes(comment, dummy, declaration):
                    yield key, number, name, dummy


PLANTED = """
module planted
   use elsewhere, only : wp
   private
   public :: child, parent, shown, generic_one
   type, abstract :: parent
   contains
      procedure(far), deferred :: over
      procedure :: seen
      procedure, private :: unseen
   end type parent
   type, extends(parent) :: child
   contains
      procedure :: over => over_child
   end type child
   interface generic_one
      module procedure first_of_two
   end interface generic_one
   abstract interface
      subroutine far(self, x)
         class(parent), intent(in) :: self
         !> Place [mm]
         real(wp), intent(in) :: x
      end subroutine far
   end interface
contains
   subroutine over_child(self, x)
      class(child), intent(in) :: self
      real(wp), intent(in) :: x
   end subroutine over_child
   pure real(wp) function seen(self, &
      & a, b) result(c)
      class(parent), intent(in) :: self
      real(wp), intent(in) :: a !! Angle [rad]

      real(wp), intent(in) :: b
   end function seen
   subroutine unseen(self, y)
      class(parent), intent(in) :: self
      real(wp), intent(in) :: y
   end subroutine unseen
   !> Describes what is done, not what it is done with
   subroutine shown(number, size_of_it, list)
      !> The number
      integer, intent(in) :: number
      ! not for readers of the pages
      integer, intent(in) :: size_of_it
      !> Two in one declaration
      !> of several lines
      real(wp), intent(in) :: list(:), &
         & more(2)
   contains
      subroutine inner(z)
         real(wp), intent(in) :: z
      end subroutine inner
   end subroutine shown
   subroutine hidden(z)
      real(wp), intent(in) :: z
   end subroutine hidden
   subroutine first_of_two(w)
      real(wp), intent(in) :: w
   end subroutine first_of_two
end module planted
"""


def judge_itself():
    """Test of this script: exactly the planted offences are found"""
    found = [what[2:] for what in offences({"planted": Source(PLANTED.splitlines())})]
    assert found == [("first_of_two", "w"), ("seen", "b"), ("shown", "number"), ("shown", "size_of_it")], found
    routine = ["subroutine cntc_x(log, a)", "type(log_type), intent(in) :: log", "real, intent(in) :: a", "end subroutine"]
    for household, routines, left in ((), (), ["log", "a"]), ({("log", "log_type")}, (), ["a"]), ({("a", "real")}, (), ["log"]), \
            ((), {"cntc_x"}, []):
        found = [what[3] for what in offences({"x": Source(routine)}, household, routines)]
        assert found == left, found


def main():
    """All files of src"""
    judge_itself()
    top = pathlib.Path(os.environ["CONTACT_SOURCE"])
    files = sorted(pathlib.Path(top, "src").rglob("*.f90"))
    sources = {file.relative_to(top / "src").as_posix(): Source(file.read_text(encoding="utf-8").splitlines()) for file in files}
    glossary = HOUSEHOLD.findall((top / "doc/develop/glossary.md").read_text(encoding="utf-8"))
    household = {(name, kind) for names, kind in glossary for name in re.findall(r"\w+", names)}
    known = {kind for source in sources.values() for kind in source.types} | {"integer"}
    routines = set(ROUTINE.findall((top / "src/capi/interface.txt").read_text(encoding="utf-8")))
    routines |= set(FUNCTION.findall((top / "include/contact.h").read_text(encoding="utf-8")))
    bad = 0
    for kind in sorted({kind for _, kind in household} - known):
        bad += 1
        print(f"FAILED doc/develop/glossary.md: src has no type {kind}")
    for key, number, name, dummy in offences(sources, household, routines):
        bad += 1
        print(f"FAILED src/{key}:{number}: {name}: {dummy} needs a comment above its declaration: meaning, shape, unit, sign")
    print(f"{len(files)} files, {bad} failures")
    return 1 if bad or len(files) < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
