"""Mutations of a source that imitate typical mistakes: which of them are possible.

A fault is one line of a source written differently. Only executable statements are touched; texts of messages and
comments are not.
"""
import collections
import re

Fault = collections.namedtuple("Fault", "file line kind old new")

# Endings of names that are easily confused
PAIRS = [("fx", "fy"), ("cksi", "ceta"), ("px", "py"), ("sx", "sy"), ("ux", "uy"), ("wx", "wy"), ("mx", "my"), ("nx", "ny"),
         ("dx", "dy"), ("first", "last"), ("lower", "upper"), ("left", "right"), ("wheel", "rail"), ("x", "y"), ("fn", "fx"),
         ("gg", "nu"), ("roll", "yaw"), ("xl", "yl"), ("row", "column"), ("line", "column")]
OTHER = {a: b for pair in PAIRS for a, b in (pair, pair[::-1])}
COMPARE = {"<": ">", ">": "<", "<=": ">=", ">=": "<=", "==": "/=", "/=": "==", "!=": "==", "~=": "=="}
NAME = r"[a-z_]\w*(?:%[a-z_]\w*|\.[a-z_]\w*)*"
SIMPLE = re.compile(r"-?(?:%s(?:\([^()]*\))?|\d[\w.]*)" % NAME, re.IGNORECASE)
DECLARATION = re.compile(r"(use|implicit|import|integer|real|logical|complex|character|class\s*\(|type\s*[(,:]|type\s+\w+$|"
                         r"procedure\s*[(,:]|parameter|dimension|intrinsic|external|private|public|enum|save|generic|final|sequence|contains|include|"
                         r"select\s+type|type\s+is|class\s+is|class\s+default)\b", re.IGNORECASE)
HEADER = re.compile(r"(?:(?:pure|elemental|impure|recursive|module|integer|logical|character|real|type|class|non_recursive)\b"
                    r"(?:\s*\([^()]*(?:\([^()]*\)[^()]*)*\))?\s*)*(subroutine|function)\s+\w+", re.IGNORECASE)


FRAME = re.compile(r"end\b|end\s*\w+|else$|case\b|associate|block|critical|stop|error stop")
# Of Python and Matlab
NOT_EXECUTED = re.compile(r"(import|from|def|class|function|end\w*|else|case|otherwise|persistent|global|@|catch|try|pass)\b")


def mask(line, language):
    """The line with texts made of ~ and without comment; same columns"""
    out, quote = [], None
    for k, c in enumerate(line):
        if quote:
            out.append("~")
            quote = None if c == quote else quote
        elif c == '"' or (c == "'" and (language != "m" or not re.search(r"[\w)\]}.']$", line[:k]))):
            quote = c
            out.append("~")
        elif c == {"f90": "!", "py": "#", "m": "%"}[language] or (language == "m" and c == "#"):
            break
        else:
            out.append(c)
    return "".join(out).rstrip()


def statements(text, language):
    """Number, code and whether it is a whole statement, of each line that is executed"""
    if language == "f90":
        yield from fortran_statements(text)
        return
    triple, depth = False, 0
    for number, line in enumerate(text.split("\n"), 1):
        quotes = line.count('"""') if language == "py" else 0
        if triple or quotes:
            triple ^= quotes % 2 == 1
            continue
        code = mask(line, language)
        whole = depth == 0
        depth += sum(code.count(c) for c in "([{") - sum(code.count(c) for c in ")]}")
        word = code.strip()
        if word and not NOT_EXECUTED.match(word):
            yield number, code, whole and depth == 0 and not word.endswith("...")


def fortran_statements(text):
    """The same of Fortran: after the declarations of a procedure"""
    inside, interface, continued, executable = False, False, False, False
    for number, line in enumerate(text.split("\n"), 1):
        code = mask(line, "f90")
        word = code.strip().lower()
        if not word:
            continue
        starts = not continued
        continued = word.endswith("&")
        if not starts:
            if executable:
                yield number, code, False
            continue
        executable = False
        if re.match(r"(abstract\s+)?interface\b", word):
            interface = True
        elif re.match(r"end\s*interface", word):
            interface = False
        elif interface:
            continue
        elif HEADER.match(word) and not re.match(r"end\b", word):
            inside = True
        elif re.match(r"(end\s*(subroutine|function|module|program)|contains|module\s|program\s|submodule)", word):
            inside = inside and not re.match(r"(end\s*(subroutine|function|module)|contains)", word)
        elif inside and not DECLARATION.match(word) and not FRAME.match(word):
            executable = True
            yield number, code, not continued


def places(pattern, code, flags=re.IGNORECASE):
    return list(re.finditer(pattern, code, flags))


def arguments(code):
    """Spans of adjacent plain arguments, and of pairs in brackets"""
    stack, lists = [], []
    for k, c in enumerate(code):
        if c in "([":
            stack.append((k, [k + 1]))
        elif c in ")]" and stack:
            _, starts = stack.pop()
            lists.append([(a, b - 1) for a, b in zip(starts, starts[1:] + [k + 1])])
        elif c == "," and stack:
            stack[-1][1].append(k + 1)
    for spans in lists:
        for (a, b), (c, d) in zip(spans, spans[1:]):
            one, two = code[a:b], code[c:d]
            if SIMPLE.fullmatch(one.strip()) and SIMPLE.fullmatch(two.strip()) and one.strip() != two.strip():
                lead_one, lead_two = len(one) - len(one.lstrip()), len(two) - len(two.lstrip())
                yield a + lead_one, a + len(one.rstrip()), c + lead_two, c + len(two.rstrip())


def top_level(code, start, signs):
    """Positions of these signs outside brackets, after a value"""
    depth, found = 0, []
    for k in range(start, len(code)):
        c = code[k]
        depth += (c in "([{") - (c in ")]}")
        if (depth == 0 and c in signs and re.search(r"[\w)\]]\s*$", code[start:k])
            and not re.search(r"\d[ed]$", code[:k], re.IGNORECASE)):
            found.append(k)
    return found


def variants(code, whole, language):
    """Pairs of kind and list of (from, to, replacement)"""
    fortran = language == "f90"
    indent = len(code) - len(code.lstrip())
    nothing = {"f90": "continue", "py": "pass", "m": ";"}[language]
    # sign
    for m in places(r"(?<=[\w)\]])\s*([+-])\s*(?=[\w(])", code):
        if not re.search(r"\d[ed]$", code[:m.start(1)], re.IGNORECASE):
            yield "sign", [(m.start(1), m.end(1), "-" if m[1] == "+" else "+")]
    for m in places(r"[=(,\[*/<>]\s*(-)(?=[a-z(])", code):
        yield "sign", [(m.start(1), m.end(1), "")]
    # factor: inverted, or omitted
    for m in places(r"(?<=[\w)\]])\s?(\.?[*/])\s?(?=[\w(])", code):
        if code[m.start(1) - 1] not in "*/." and code[m.end(1)] not in "*/=":
            yield "factor", [(m.start(1), m.end(1), m[1].replace("*", "#").replace("/", "*").replace("#", "/"))]
    for m in places(r"(?<=[\w)\]])\s?\.?[*/]\s?(?:[a-z_][\w%]*|\d+\.?\d*(?:e[+-]?\d+)?(?:_wp)?)(?![\w%(.*])", code):
        if code[m.start() - 1] not in "*/" and not m[0].startswith(("**", "//")):
            yield "unit", [(m.start(), m.end(), "")]
    # exchanged
    for a, b, c, d in arguments(code):
        yield "exchanged", [(a, b, code[c:d]), (c, d, code[a:b])]
    for m in places(r"(?<=[(,\s])([12])(?=[),])", code):
        yield "component", [(m.start(1), m.end(1), "2" if m[1] == "1" else "1")]
    for m in places(r"[a-z_]\w*", code):
        for length in (len(m[0]), None):
            name = m[0] if length else m[0].split("_")[-1]
            if name.lower() in OTHER and (length or "_" in m[0]):
                yield "component", [(m.end() - len(name), m.end(), OTHER[name.lower()])]
                break
    # off by one
    m = re.match(r"\s*do\s+(?:concurrent\s*\()?\w+\s*=\s*", code, re.IGNORECASE) if fortran else None
    if m:
        parts = split_top(code, m.end())
        if len(parts) >= 2:
            (a, b), (c, d) = parts[0], parts[1]
            yield "off by one", [(b, b, " + 1")]
            yield "off by one", [(d, d, " - 1")]
    for m in places(r"\s?[+-]\s?1(?![\w.])", code):
        if re.search(r"[\w)\]]$", code[:m.start()]) and not re.search(r"\d[ed]$", code[:m.start()], re.IGNORECASE):
            yield "off by one", [(m.start(), m.end(), "")]
    for m in places(r"\b(?:range|len|size|numel)\(" + NAME + r"\)", code):
        yield "off by one", [(m.end(), m.end(), " - 1") if m[0][0] in "lsn" else (m.end() - 1, m.end() - 1, " - 1")]
    # dropped term
    m = re.match(r"\s*[a-z_][\w%.]*(?:\([^=]*\))?\s*=(?!=)\s*", code, re.IGNORECASE)
    if m and whole:
        signs = top_level(code, m.end(), "+-")
        if signs:
            yield "dropped term", [(signs[-1], len(code.rstrip("; ")), "")]
    # comparison
    for m in places(r"(?<![<>=/~!+*-])(<=|>=|==|/=|~=|!=|<|>)(?![=>])", code):
        if not (language == "f90" and m[1] in ("!=", "~=")) and not (language != "f90" and m[1] == "/="):
            turned = COMPARE[m[1]]
            yield "comparison", [(m.start(1), m.end(1), {"py": "!=", "m": "~=", "f90": "/="}[language] if turned == "/="
                                  else turned)]
    for one, two in ((".and.", ".or."), (" and ", " or "), ("&&", "||")):
        for a, b in ((one, two), (two, one)):
            for m in places(re.escape(a), code):
                yield "comparison", [(m.start(), m.end(), b)]
    # constants
    for m in places(r"(?<![\w.])(\d+\.\d*(?:e[+-]?\d+)?)(_wp)?", code):
        kind = m[2] or ""
        yield "constant", [(m.start(), m.end(), ("1.0" if float(m[1]) == 0.0 else "2.0" + kind + "*" + m[1]) + kind)]
    for m in places(r"(?<![\w.~-])(\d+)(?![\w.~])", code):
        yield "constant", [(m.start(), m.end(), str(int(m[1]) + 1))]
    for one, two in ((".true.", ".false."), ("True", "False"), ("true", "false")):
        for a, b in ((one, two), (two, one)):
            for m in places(r"(?<![\w.])%s(?![\w.])" % re.escape(a), code, 0):
                yield "constant", [(m.start(), m.end(), b)]
    # effects of a whole statement
    if whole:
        if re.match(r"\s*[a-z_][\w%.]*(?:\([^=]*\))?\s*(?:=(?![=>])|\+=)", code, re.IGNORECASE) and (
            fortran or not re.match(r"\s*\w+\s*=", code)
        ):
            yield "missing update", [(indent, len(code), nothing)]
        elif re.match(r"\s*call\s", code, re.IGNORECASE):
            error = re.match(r"\s*call\s+[\w%]*(fail|refuse|error|report_error|warn|add)\w*\s*\(", code, re.IGNORECASE)
            yield "error dropped" if error else "missing update", [(indent, len(code), nothing)]
        if re.match(r"\s*if \(allocated\((error|fatal|problem)\w*\)\) (return|exit|cycle)", code) or \
                re.match(r"\s*if \(.*(error|status|stat|code|ierr)\b.*\) (return|exit|cycle)$",
                         code) or re.match(r"\s*(raise|error)\b", code):
            yield "error dropped", [(indent, len(code), nothing)]
        elif re.match(r"\s*(if \(.*\) )?(exit|cycle|return|break|continue)( \w+)?;?$", code):
            yield "early exit", [(indent, len(code), nothing)]
    # conditions
    m = re.match(r"(\s*(?:else )?if )(\(.*\)) (then|\S.*)$", code) if fortran else re.match(r"(\s*(?:el)?(?:else)?if )(.+?)(:?)$",
        code)
    if m and whole and balanced(m[2]):
        a, b = m.start(2), m.end(2)
        inner = code[a + 1:b - 1] if fortran else m[2]
        yield "branches", [(a, b, "(.not. %s)" % "(KEEP)" if fortran else " not (KEEP)" if language == "py" else " ~(KEEP)")]
        if re.fullmatch(r"\s*(\.not\. |not |~)?%s\s*" % NAME, inner, re.IGNORECASE):
            yield "option ignored", [(a, b, "(.false.)" if fortran else " False" if language == "py" else " (false)")]
    for m in places(r"\bmerge\(", code):
        parts = split_top(code, m.end(), ")")
        if len(parts) == 3:
            (a, b), (c, d) = parts[0], parts[1]
            yield "branches", [(a, b, code[c:d].strip()), (c, d, " " + code[a:b].strip())]
    # procedures
    for m in places(r"\b(min|max|minval|maxval|floor|ceiling|minloc|maxloc|ceil)(?=\()", code):
        other = {"min": "max", "max": "min", "minval": "maxval", "maxval": "minval", "floor": "ceiling" if fortran else "ceil",
                 "ceiling": "floor", "ceil": "floor", "minloc": "maxloc", "maxloc": "minloc"}[m[1]]
        yield "min for max", [(m.start(1), m.end(1), other)]
    for m in places(r"\b(abs|sqrt|trim|adjustl|nint)(?=\()", code):
        if m[1] in ("abs", "sqrt"):
            yield "abs dropped", [(m.start(1), m.end(1), "")]
    for m in places(r"\b\w*(tolerance|tol|eps|epsens|accuracy)\b(?![\w%(])", code):
        if re.search(r"[<>*]\s*[\w%]*$", code[:m.end()]):
            start = re.search(r"[\w%.]*$", code[:m.end()]).start()
            yield "tolerance", [(start, m.end(), "1000*" + code[start:m.end()])]


def split_top(code, start, end=None):
    """Spans between commas, from start to the closing bracket or the end of the line"""
    depth, begin, parts = 0, start, []
    for k in range(start, len(code)):
        c = code[k]
        if c in "([":
            depth += 1
        elif c in ")]":
            if depth == 0:
                parts.append((begin, k))
                return parts
            depth -= 1
        elif c == "," and depth == 0:
            parts.append((begin, k))
            begin = k + 1
    parts.append((begin, len(code)))
    return parts if end is None else []


def balanced(text):
    depth = 0
    for k, c in enumerate(text):
        depth += (c == "(") - (c == ")")
        if depth == 0 and c == ")" and k < len(text) - 1 and text[0] == "(":
            return False
    return depth == 0


def faults_of(file, text):
    """All possible faults of a source"""
    language = file.rsplit(".", 1)[1]
    lines = text.split("\n")
    for number, code, whole in statements(text, language):
        old = lines[number - 1]
        seen = set()
        for kind, edits in variants(code, whole, language):
            new = old
            for a, b, replacement in sorted(edits, reverse=True):
                # texts are masked in the code: unchanged parts come from the line itself
                new = new[:a] + replacement.replace("KEEP", old[a + 1:b - 1] if language == "f90" else old[a:b]) + new[b:]
            if new != old and new not in seen and "~" not in "".join(edit[2] for edit in edits).replace(" ~(KEEP)", ""):
                seen.add(new)
                yield Fault(file, number, kind, old, new)
