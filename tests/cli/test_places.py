#!/usr/bin/env python3
"""Errors of an input are reported with line, column and name: every number of all examples.

The comments of the examples name the numbers before them. The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import glob
import os
import re
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]
EXAMPLES = os.path.join(os.environ["CONTACT_SOURCE"], "examples")
NUMBER = r"[-+]?\d[\w.+-]*|[-+]?\.\d+"
WHOLE = set("""MODULE P B T N F S L D C M Z E H G I A O W R M2 C1 V X MAXGS MAXIN MAXNR MAXOUT NPOT_MAX IPOTCN MX MY IBASE IPLAN NN
    NX NY NZ ISUBS MATFIL MATFIL_S OUTPUT OUTPUT_S NVF MIRRORY MIRRORZ ISMOOTH INISLP KDOWFB IF_METH VARIANT IXL IXINC IXH IYL IYINC
    IYH""".split())
# Numbers that have a longer name in messages; with "|" the two meanings of a position in two forms of a line
LONGER = {"POISS": "POISS1 POISS2", "GG": "GG1 GG2", "GAUGSQ": "GAUGSQ|RAILY0 RAILY0",
          "RAILY0": "GAUGSQ|RAILY0 GAUGSQ", "GAUGWD": "GAUGWD|RAILZ0 RAILZ0", "RAILZ0": "GAUGWD|RAILZ0 GAUGWD",
          "DX": "VS", "DY": "DYRAIL VY", "DZ": "DZRAIL VZ", "DROLL": "VROLL",
          "DYAW": "VYAW", "DPITCH": "VPITCH", "DENSITY": "DENS1 DENS2"}


def lines_with_names(path):
    """Lines of an input, and for each the positions and names of its numbers"""
    with open(path, encoding="utf-8") as file:
        for line in file.read().split("\n"):
            row = re.match(r"((?:\s*(?:%s)(?=\s))+)\s*%%?\s*([A-Z].*)$" % NUMBER, line)
            numbers = list(re.finditer(NUMBER, row[1])) if row else []
            names = [name.rstrip(":") for name in re.split(r"[\s,]+", row[2])] if row else []
            good = len(names) >= len(numbers)
            yield line, [(number, name) for number, name in zip(numbers, names)
                         if good and re.fullmatch(r"[A-Z][A-Z0-9_()]*", name)]


def is_named(shown, name):
    """Is it the number named by the comment?"""
    return (shown in (name.replace("B1", "B(1)"), *LONGER.get(name, "").split()) or shown.startswith(name)
            or (len(name) > 1 and name in shown))


class Places(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        os.symlink(os.path.join(EXAMPLES, "profiles"), os.path.join(self.folder, "profiles"))

    def check_only(self, lines):
        with open(os.path.join(self.folder, "x.inp"), "w", encoding="utf-8") as file:
            file.write("\n".join(lines))
        run = subprocess.run([PROGRAM, "3", "x"], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                             timeout=60)
        self.assertEqual(run.returncode, 1, run.stdout)
        return run.stderr

    def test_numbers_beyond_their_bounds(self):
        """All real numbers of an example are out of bounds: each is reported at its position"""
        found = 0
        for path in sorted(glob.glob(os.path.join(EXAMPLES, "*.inp"))):
            for wrong, word in (("1e300", "above"), ("-1e299", "below")):
                lines, expected = [], {}
                for number, (line, numbers) in enumerate(lines_with_names(path), 1):
                    built, last = "", 0
                    for place, name in numbers:
                        if name in WHOLE or name in ("B6", "R)"):
                            continue
                        built += line[last:place.start()]
                        expected[number, len(built) + 1] = name
                        built, last = built + wrong, place.end()
                    lines.append(built + line[last:])
                if not expected:
                    continue
                output = self.check_only(lines)
                places = {(int(row), int(column)): (name, said) for row, column, name, said in re.findall(
                    r"x\.inp:(\d+):(\d+): (\S+) = %s is (\w+) its (?:upper|lower) bound" % wrong, output)}
                for place, name in expected.items():
                    if wrong == "1e300":
                        self.assertIn(place, places, (path, name))
                        self.assertEqual(places[place][1], word)
                    if place in places:
                        self.assertTrue(is_named(places[place][0], name), (path, place, name, places[place]))
                        found += 1
        self.assertGreater(found, 2500)

    def test_words_in_place_of_numbers(self):
        """The first number of each name in all examples, its digits included, is not a number"""
        done = set()
        for path in sorted(glob.glob(os.path.join(EXAMPLES, "*.inp"))):
            rows = list(lines_with_names(path))
            for k, (line, numbers) in enumerate(rows):
                for place, name in numbers:
                    # words of digits have more names than numbers
                    if name in done or len(name) == 1:
                        continue
                    done.add(name)
                    output = self.check_only([row for row, _ in rows[:k]] + [line[:place.start()] + "@7" + line[place.end():]])
                    self.assertIn(f"x.inp:{k + 1}:{place.start() + 1}: ", output, (path, name))
                    self.assertIn('"@7"', output)
                    # the words of the first line of a case come before its number
                    self.assertRegex(output, r"case \d+\)|MODULE", (path, name))
        self.assertGreater(len(done), 100)


if __name__ == "__main__":
    unittest.main()
