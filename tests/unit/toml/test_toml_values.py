"""Every text that our TOML parser accepts has the same values in Python's parser; every text refused there is refused by ours

Usage: test_toml_values.py PROGRAM [NUMBER OF DOCUMENTS]. Documents are made by a grammar, and then damaged.
"""
import random
import struct
import subprocess
import sys
import tempfile

try:
    import tomllib
except ImportError:
    print("skipped: this Python has no tomllib")
    sys.exit(77)

# features outside the subset, which may be refused although Python reads them
LACKING = ("no number", "decimal", "date", "time", "several lines", "too large", "too small", "no number that a case",
           "nested", "parts", "no value")

BY_HAND = [
    b"", b"\n", b"# only a comment", b"a = 1", b"a=1#c\r\nb = 2\r\n", b"a = 1 b = 2", b"a = ", b"= 1", b"a",
    b"a.b.c = 1\na.b.d = 2",
    b"a.b = 1\na = 2", b"a = 1\na.b = 2", b"a = 1\na = 2", b"[a]\nb = 1\n[a]\nc = 2", b"[a.b]\nx = 1\n[a]\ny = 2",
    b"[a]\nb.c = 1\n[a.b]\nd = 2", b"[a]\nb.c = 1\n[a.b.d]\ne = 2", b"[a.b.c]\n[a]\nb.x = 1", b"[a.b]\n[a]\nb.x = 1",
    b"[[a]]\nx = 1\n[[a]]\nx = 2\n[a.b]\ny = 3", b"[a]\n[[a]]", b"[[a]]\n[a]", b"a = []\n[[a]]", b"a = [{b = 1}]\n[[a]]",
    b"a = [{b = 1}]\n[a.c]", b"a = {b = 1}\n[a]", b"a = {b = 1}\na.c = 2", b"a = {b = 1}\n[a.c]", b"a = {b.c = 1, b.d = 2}",
    b"a = {b = {c = 1}, b.d = 2}", b"a = {b.c = 1, b = 2}", b"a = {b = 1,}", b"a = {\nb = 1}", b"a = {}", b"a = { }\nb = []",
    b"[[a.b]]\nx = 1\n[[a.b]]\ny = 2\n[a.b.c]\nz = 3", b"[[a]]\nb.c = 1\n[[a]]\nb.c = 2", b"[[x]]\nb.c = 1\n[x.b]",
    b"[[fruit]]\nname = 'a'\n[[fruit.kind]]\nn = 1\n[[fruit.kind]]\nn = 2\n[[fruit]]\n[[fruit.kind]]\nn = 3",
    b"[fruit]\napple.color = 'r'\napple.taste.sweet = true\n[fruit.apple.texture]\nsmooth = true",
    b"[fruit]\napple.color = 'r'\n[fruit.apple]", b"a = [1, 2,\n 3, # c\n]", b"a = [1 2]", b"a = [,]", b"a = [1,,2]", b"a = [",
    b"a = [[1, 'b'], {c = 2}, 1.5, true]", b"a = '''x'''", b'a = """x"""', b"a = 'x", b'a = "x\ny"', b'a = "\\u00e9\\U0001F600\\n"',
    b'a = "\\ud800"', b'a = "\\x41"', b'a = "\\"', b"a = '\\'", b"a = '\x01'", b"a = 'tab\tin'", b"# \x01", b"# \x7f", b"a = 1\r",
    b"a = 1 # \r x", b"\xef\xbb\xbfa = 1", b"a = '\xff'", b"a = '\xed\xa0\x80'", b"a = '\xc0\x80'", b"a = '\xf4\x90\x80\x80'",
    b"a = '\xc3\xa9'", b"\xc3\xa9 = 1", b"'\xc3\xa9' = 1", b"'' = 1\n\"\" = 2", b"'' = 1", b"'a.b' = 1\na.b = 2", b"a . b = 1",
    b"a\n= 1", b"1 = 2", b"-_- = 1", b"[a]b = 1", b"[a", b"[a]]", b"[[a]", b"[ a . b ]", b"[ [a] ]", b"[[a] ]", b"[]", b"[[]]",
    b"[a.]", b"[.a]", b"a. = 1", b"a..b = 1", b"a = 01", b"a = 0", b"a = -0", b"a = +0", b"a = +1", b"a = 0.0", b"a = -0.0",
    b"a = 1.", b"a = .5", b"a = 1e5", b"a = 1E+05", b"a = 1e", b"a = 1.e5", b"a = 1_000", b"a = 1__0", b"a = _1", b"a = 1_",
    b"a = 1_.5", b"a = 1._5", b"a = 1.5_0", b"a = 1e1_0", b"a = 9223372036854775807", b"a = -9223372036854775808",
    b"a = 9223372036854775808", b"a = 1e400", b"a = 1e-400", b"a = 1e-310", b"a = 0e999", b"a = 2.2250738585072014e-308",
    b"a = 1.7976931348623157e307", b"a = 0.1000000000000000055511151231257827021181583404541015625", b"a = 123456789012345678901e0",
    b"a = 0x1F", b"a = 0b1", b"a = 0o7", b"a = inf", b"a = -inf", b"a = nan", b"a = +nan", b"a = 1979-05-27", b"a = 07:32:00",
    b"a = 1979-05-27T07:32:00Z", b"a = true", b"a = True", b"a = false # no", b"a = yes", b"a = 5 mm", b"a = 5mm", b"a = 1,2",
    b"a = 'x' 'y'", b"a = 1\n\n\n  b = 2", b"\ta = 1", b"a = [" * 30 + b"]" * 30, b"a = " + b"[" * 15 + b"]" * 15, b"a = 1\x00",
    b"a = \"a\x00b\"", b'a = "\\u0000"', b"a" + b".a" * 30 + b" = 1", b"a = \"\"", b"a = \"\"\"\"", b"a = ''''", b'"a\\tb" = 1',
    b'"a\nb" = 1', b"\"\"\"a\"\"\" = 1", b"[a.'b c'.\"d\"]\nx=1", b"a = {b = [1,\n2]}", b"a = {b = 1} c = 2", b"a = 3\n[a.b]",
    b"[a]\nb = 1\n[a.b]", b"[a]\nb = 1\n[a.b.c]", b"[[a.b]]\n[a]\nb.c = 1", b"[a]\n[a.b]\n[[a.b]]", b"a.b = []\n[a]",
    b"[[a]]\n[[a.b]]\n[a.b]",
    b"[[a]]\n[a.b]\n[[a]]\n[a.b]", b"x = [{a = 1}, {a = 2}]\nx.a = 3", b"a = {b = {c = 1}}\n[a.b]", b"a = {b = [{c = 1}]}\n[[a.b]]",
]


def make_key(r):
    return r.choice([lambda: r.choice(["a", "b", "c", "case", "x-1", "0", "fstat"]),
                     lambda: "'" + r.choice(["a", "b b", "", "c.d"]) + "'",
                     lambda: '"' + r.choice(["a", "\\u0062", "q\\\"", "\u00e9"]) + '"'])()


def dotted(r):
    return ".".join(make_key(r) for _ in range(r.choice([1, 1, 1, 2, 3])))


def number(r):
    kind = r.randrange(8)
    if kind == 0:
        return str(r.randrange(-10**r.randrange(1, 19), 10**r.randrange(1, 19)))
    if kind == 1:
        return repr(struct.unpack("d", struct.pack("Q", r.getrandbits(64)))[0])
    if kind == 2:
        return f"{r.uniform(-1, 1):.{r.randrange(25)}e}"
    if kind == 3:
        return f"{r.randrange(1000)}_{r.randrange(1000):03}"
    if kind == 4:
        return "".join(r.choice("0123456789._e+-") for _ in range(r.randrange(1, 8)))
    if kind == 5:
        return f"{r.randrange(10**12)}.{r.randrange(10**12)}{r.choice(['', 'e3', 'E-12'])}"
    return repr(r.uniform(-1000, 1000))


def value(r, depth=0):
    kind = r.randrange(9 if depth < 4 else 6)
    if kind < 3:
        return number(r)
    if kind == 3:
        return r.choice(["true", "false", "'lit\\eral'", "''", '""'])
    if kind in (4, 5):
        letters = ["a", " ", "\\n", "\\\\", "\\u20ac", "\u20ac", "#", "[", "\\\"", "mm"]
        return '"' + "".join(r.choice(letters) for _ in range(5)) + '"'
    if kind == 6:
        return "{" + ", ".join(f"{dotted(r)} = {value(r, depth + 1)}" for _ in range(r.randrange(3))) + "}"
    glue = r.choice([", ", ",", ",\n  ", " , # x\n"])
    return "[" + glue.join(value(r, depth + 1) for _ in range(r.randrange(4))) + r.choice(["", ",", "\n"]) + "]"


def document(r):
    lines = []
    for _ in range(r.randrange(8)):
        kind = r.randrange(6)
        if kind == 0:
            lines.append(f"[{dotted(r)}]")
        elif kind == 1:
            lines.append(f"[[{dotted(r)}]]" + r.choice(["", "  # note"]))
        elif kind == 2:
            lines.append(r.choice(["", "# a comment", "   "]))
        else:
            lines.append(f"{dotted(r)} = {value(r)}")
    text = r.choice(["\n", "\n", "\r\n"]).join(lines).encode()
    if r.random() < 0.4 and text:
        text = bytearray(text)
        for _ in range(r.randrange(1, 4)):
            at = r.randrange(len(text))
            action = r.randrange(3)
            if action == 0:
                text[at] = r.choice(b"[]{}=.,'\"#\\\n\r\t 0_e-") if r.random() < 0.9 else r.randrange(256)
            elif action == 1:
                del text[at]
            else:
                text.insert(at, r.choice(b"[]{}=.,'\"#\\\n 0_"))
            if not text:
                break
        text = bytes(text)
    return text


def rebuild(lines):
    """The value printed by our program as a Python value; integers and real numbers are distinguished"""
    word, _, rest = next(lines).partition(" ")
    if word == "table":
        table = {}
        for _ in range(int(rest)):
            key = bytes.fromhex(next(lines).partition(" ")[2]).decode()
            table[key] = rebuild(lines)
        return table
    if word == "array":
        return [rebuild(lines) for _ in range(int(rest))]
    if word == "string":
        return bytes.fromhex(rest).decode()
    if word == "integer":
        return int(rest)
    if word == "real":
        return struct.pack("Q", int(rest, 16))
    return rest == "T"


def bare(thing):
    """Numbers as their bytes, so that -0.0 is not 0.0 and 1 is not 1.0 or true"""
    if isinstance(thing, dict):
        return {key: bare(value) for key, value in thing.items()}
    if isinstance(thing, list):
        return [bare(value) for value in thing]
    return struct.pack("d", thing) if isinstance(thing, float) else (type(thing), thing)


def typed(thing):
    if isinstance(thing, dict):
        return {key: typed(value) for key, value in thing.items()}
    if isinstance(thing, list):
        return [typed(value) for value in thing]
    return thing if isinstance(thing, bytes) else (type(thing), thing)


def main():
    program = sys.argv[1]
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 4000
    r = random.Random(15)
    documents = BY_HAND + [document(r) for _ in range(count)]
    with tempfile.NamedTemporaryFile() as file:
        for text in documents:
            file.write(b"%d\n" % len(text) + text)
        file.flush()
        output = subprocess.run([program, file.name], stdout=subprocess.PIPE, check=True, timeout=200).stdout.decode("latin-1")
    answers = output.split("\n.\n")[:-1]
    if len(answers) != len(documents):
        sys.exit(f"{len(answers)} answers to {len(documents)} documents")
    wrong, good, lacking = 0, 0, 0
    for text, answer in zip(documents, answers):
        try:
            right = tomllib.loads(text.decode())
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as reason:
            right, why = None, reason
        if answer.startswith("error "):
            if right is None:
                good += 1
            elif any(word in answer for word in LACKING):
                lacking += 1
            else:
                wrong += 1
                print("refused, but Python reads it:", text, answer)
        elif right is None:
            wrong += 1
            print("accepted, but Python refuses it:", text, why)
        else:
            good += 1
            if typed(rebuild(iter(answer.split("\n")))) != bare(right):
                wrong += 1
                print("other values:", text, answer, right)
    print(f"{good} documents agree, {lacking} with features outside the subset, {wrong} wrong")
    sys.exit(wrong > 0 or good < 0.8*len(documents))


if __name__ == "__main__":
    main()
