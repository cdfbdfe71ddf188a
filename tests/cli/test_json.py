#!/usr/bin/env python3
"""contact --json: every case is a line of valid JSON, with the values of the .out file.

The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = os.environ["CONTACT_SOURCE"]
sys.path.insert(0, os.path.join(SOURCE, "tests", "regression"))
import out_file

EMPTY = """3
200100
022020
0000201
100 100 30 1 1e-5
{pen} 0 0 0
0.3 0.3
0.28 0.28 82000 82000
1
5 5 -1.0 -1.0 0.4 0.4
1 1
0.001 0 0.001 0 0 0
"""


def refuse(constant):
    raise ValueError("not JSON: " + constant)


def read(text):
    """The cases; the last line marks the end"""
    *cases, end = [json.loads(line, parse_constant=refuse) for line in text.splitlines()]
    assert end["case"] == 0 and end["patches"] == [] and end["run"]["cases_finished"] <= end["run"]["cases_planned"], end
    assert all(case["cases_planned"] == end["run"]["cases_planned"] for case in cases)
    return cases


def faults(value, schema, place="line"):
    """Violations of a schema by a value; supports the keywords of JSON Schema used in ours"""
    if schema is False:
        return [place + " must not be there"]
    if "anyOf" in schema:
        found = [faults(value, choice, place) for choice in schema["anyOf"]]
        return [] if [] in found else min(found, key=len)
    kinds = {"object": dict, "array": list, "string": str, "number": (int, float), "integer": int, "boolean": bool,
             "null": type(None)}
    kind = schema.get("type", list(kinds))
    allowed = [kinds[word] for word in ([kind] if isinstance(kind, str) else kind)]
    if not any(isinstance(value, one) and (isinstance(value, bool) <= (one in (bool, object))) for one in allowed):
        return ["%s is %r, not of type %s" % (place, value, kind)]
    if ("const" in schema and value != schema["const"]) or value not in schema.get("enum", [value]):
        return ["%s is %r" % (place, value)]
    found = []
    if isinstance(value, dict):
        found += [place + " lacks " + name for name in schema.get("required", ()) if name not in value]
        for name, item in value.items():
            if name in schema.get("properties", {}):
                found += faults(item, schema["properties"][name], place + "." + name)
            elif not schema.get("additionalProperties", True):
                found.append("%s has %s" % (place, name))
    if isinstance(value, list) and "items" in schema:
        for k, item in enumerate(value):
            found += faults(item, schema["items"], "%s[%d]" % (place, k))
    return found


class Json(unittest.TestCase):
    def test_numbers_have_the_fewest_digits(self):
        text = self.run_program("--quiet", "--errors", "--json=-", "--output-dir", ".", "2",
                                os.path.join(SOURCE, "examples", "manchester")).stdout
        numbers = []
        for line in text.splitlines():
            json.loads(line, parse_float=numbers.append)
        lengths = set()
        for number in numbers:
            # both are the shortest text that is read back as the same number; the digits are compared
            digits, shortest = (word.lower().split("e")[0].replace(".", "").strip("-0") for word in (number, repr(float(number))))
            self.assertEqual(digits, shortest, number)
            lengths.add(len(digits))
        self.assertTrue({15, 16, 17} <= lengths, lengths)

    def test_lines_are_as_the_schema_says(self):
        with open(os.path.join(SOURCE, "doc/user/results.schema.json"), encoding="utf-8") as file:
            schema = json.load(file)
        lines = []
        for name in ("cattaneo", "manchester", "falling_friction", "sliding_temperature", "simplified", "layer_element"):
            self.run_example(name)
            with open(os.path.join(self.folder, name + ".jsonl"), encoding="utf-8") as file:
                lines += [json.loads(line) for line in file]
        for name in ("cattaneo", "manchester"):
            text = self.run_program("--quiet", "--errors", "--json=-", "--output-dir", ".", "2",
                                    os.path.join(SOURCE, "examples", name)).stdout
            lines += [json.loads(line) for line in text.splitlines()]
        with open(os.path.join(self.folder, "short.inp"), "w", encoding="utf-8") as file:
            file.write(EMPTY.format(pen=2000).replace("5 5 -1.0 -1.0", "3 3 -0.6 -0.6") + "0\n")
        lines += [json.loads(line) for line in self.run_program("--quiet", "--json=-", "2", "short").stdout.splitlines()]
        self.assertTrue(any("border" in patch for line in lines for patch in line["patches"]), "contact at the border is tried")
        for line in lines:
            self.assertEqual(faults(line, schema), [])
        # a violation is described
        for change, word in ((lambda line: line.pop("status"), "lacks status"), (lambda line: line.update(fn=1), "has fn"),
                             (lambda line: line["patches"][0]["totals"]["fn"].update(unit="kN"), "unit is 'kN'"),
                             (lambda line: line.update(solved=1), "not of type boolean"),
                             (lambda line: line.update(case=True), "not of type integer")):
            line = json.loads(json.dumps(lines[0]))
            change(line)
            self.assertTrue(any(word in fault for fault in faults(line, schema)), (word, faults(line, schema)))
        try:
            import jsonschema
        except ImportError:
            return
        kind = jsonschema.validators.validator_for(schema)
        kind.check_schema(schema)
        judge = kind(schema)
        for line in lines:
            judge.validate(line)

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=120)

    def run_example(self, name):
        run = self.run_program("--quiet", "--json", "--output-dir", ".", "2", os.path.join(SOURCE, "examples", name))
        self.assertEqual(run.returncode, 0, run.stderr[-2000:])
        with open(os.path.join(self.folder, name + ".jsonl"), encoding="utf-8") as file:
            return read(file.read()), out_file.read(os.path.join(self.folder, name + ".out"))

    def agrees(self, total, printed, unit):
        """A total has this unit and the printed value, to the printed figures"""
        self.assertEqual(total["unit"], unit)
        self.assertAlmostEqual(total["value"], printed, delta=2e-4*abs(printed) + 1e-9)

    def test_values_are_those_of_the_out_file(self):
        lines, printed = self.run_example("cattaneo")
        self.assertEqual([line["case"] for line in lines], sorted(printed))
        for line in lines:
            self.assertTrue(line["solved"] and line["converged"])
            self.assertEqual(line["module"], 3)
            self.assertEqual(len(line["patches"]), 1)
            totals = line["patches"][0]["totals"]
            for name, column, unit in (("fn", "FN", "N"), ("fx", "FX", "N"), ("pmax", "PMAX", "N/mm2"), ("pen", "APPROACH", "mm")):
                self.agrees(totals[name], printed[line["case"]][column], unit)
            self.assertEqual(totals["ncon"], printed[line["case"]]["NCON"])
        shift = lines[1]["patches"][0]
        self.assertEqual(shift["totals"]["shift_x"]["unit"], "mm")
        self.assertNotIn("cksi", shift["totals"])
        self.assertEqual(shift["solver"]["tangential_ended"], "converged")
        self.assertLessEqual(shift["solver"]["tangential_residual"], shift["solver"]["tangential_tolerance"])

    def test_wheel_on_rail_has_its_patches_inside(self):
        lines, printed = self.run_example("wheel_on_rail")
        self.assertEqual(len(lines), len(printed))
        sides = set()
        for line in lines:
            self.assertEqual(line["module"], 1)
            sides.add(line["side"])
            self.assertEqual(line["totals"]["fz_tr"]["unit"], "N")
            self.assertGreaterEqual(len(line["patches"]), 1)
            for patch in line["patches"]:
                self.assertEqual(patch["totals"]["deltcp_tr"]["unit"], "rad")
                y = patch["totals"]["ycp_tr"]["value"]
                self.assertGreater(y if line["side"] == "right" else -y, 0.0)
        with open(os.path.join(self.folder, "wheel_on_rail.out")) as file:
            printed = file.read().count("DATA FOR CONTACT PATCH")
        self.assertEqual(sum(len(line["patches"]) for line in lines), printed)
        self.assertEqual(sides, {"left", "right"})

    def test_moments_name_their_origins(self):
        """In steps, MN of .out is about the origin of the elements, mz about the contact reference; both are written"""
        lines, printed = self.run_example("rolling_steps")
        count = 0
        for line in lines:
            if len(line["patches"]) != 1:
                continue
            totals = line["patches"][0]["totals"]
            if "mz_elem" in totals:
                value, printed_value = totals["mz_elem"]["value"], printed[line["case"]]["MZ"]
                self.assertAlmostEqual(value, printed_value, delta=6e-4*abs(printed_value))
                count += abs(totals["mz"]["value"]/totals["mz_elem"]["value"] - 1.0) > 0.1
            else:
                self.agrees(totals["mz"], printed[line["case"]]["MZ"], "N mm")
        self.assertGreater(count, 0, "a step in which the origins are apart")

    def test_no_contact_and_no_nan(self):
        with open(os.path.join(self.folder, "empty.inp"), "w") as file:
            file.write(EMPTY.format(pen=-1).replace("200100", "200000") + "0\n")
        run = self.run_program("--json=-", "2", "empty")
        self.assertEqual((run.returncode, run.stderr), (0, ""), run.stdout)
        line, = read(run.stdout)
        self.assertEqual(line["patches"][0]["totals"]["ncon"], 0)
        self.assertEqual(line["patches"][0]["totals"]["fn"], {"value": 0, "unit": "N"})

    def test_faulty_case_has_a_line(self):
        with open(os.path.join(self.folder, "faulty.inp"), "w") as file:
            file.write(EMPTY.format(pen=1) + EMPTY.format(pen=1).replace("0.28 0.28 8", "0.28 0.98 8") + "0\n")
        run = self.run_program("--json=-", "2", "faulty")
        self.assertEqual(run.returncode, 1)
        first, second = read(run.stdout)
        self.assertTrue(first["solved"])
        self.assertFalse(second["solved"])
        self.assertEqual(second["patches"], [])
        self.assertIn("input", second["failure"])

    def test_without_the_flag_nothing_is_written(self):
        name = os.path.join(SOURCE, "examples", "carter2d")
        self.assertEqual(self.run_program("--quiet", "--output-dir", ".", "2", name).returncode, 0)
        self.assertFalse([file for file in os.listdir(self.folder) if file.endswith(".jsonl")])

    def test_a_folder_that_is_missing_and_a_wrong_value(self):
        name = os.path.join(SOURCE, "examples", "carter2d")
        run = self.run_program("--quiet", "--json=yes", "2", name)
        self.assertEqual(run.returncode, 1)
        self.assertIn("--json", run.stderr)
        os.mkdir(os.path.join(self.folder, "carter2d.jsonl"))
        run = self.run_program("--quiet", "--json", "--output-dir", ".", "2", name)
        self.assertEqual(run.returncode, 1)
        self.assertIn("carter2d.jsonl", run.stderr)


if __name__ == "__main__":
    unittest.main()
