"""Every file of results shows if it is complete, and how many cases were planned."""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
except ImportError as reason:
    print(f"SKIPPED: {reason}")
    sys.exit(77)

PROGRAM = os.environ["CONTACT_PROGRAM"]
CASE = """{module} MODULE
201100 PBTNFS
0022020 VLDCMZE
0000011 HGIAOWR
100 100 30 1 1e-4
{force} 0 0 0
0.4 0.4
0.42 0.42 200 200
-3
9 9 1 1 1.3
"""


def text_of(*forces):
    return "".join(CASE.format(module=3, force=force) for force in forces) + "0 MODULE\n"


class Complete(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def run_input(self, text, *options):
        """Exit status, and completeness by all files: last line of JSON, attributes of HDF5, end of .out, remark of the
        collection"""
        with open(os.path.join(self.folder, "x.inp"), "w") as file:
            file.write(text)
        done = subprocess.run([PROGRAM, "--quiet", "--json", "--hdf5", "--vtk", *options, "2", "x"], cwd=self.folder, timeout=60,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True)
        with open(os.path.join(self.folder, "x.jsonl")) as file:
            lines = [json.loads(line) for line in file]
        with h5py.File(os.path.join(self.folder, "x.h5")) as file:
            attributes = {name: value.decode().strip() if isinstance(value, bytes) else value for name, value in file.attrs.items()}
            rows = list(file["cases/status_code"][...])
        with open(os.path.join(self.folder, "x.out")) as file:
            out = file.read()
        with open(os.path.join(self.folder, "x.pvd")) as file:
            remark = re.search(r"<!-- (.*?) *-->\n</VTKFile>\n\Z", file.read()).group(1)
        self.assertEqual({line["cases_planned"] for line in lines[:-1]} | {attributes["cases_planned"]},
                         {lines[-1]["run"]["cases_planned"]})
        for name, value in lines[-1]["run"].items():
            self.assertEqual(attributes[name], value, name)
        self.assertEqual([line["status_code"] for line in lines[:-1]], rows)
        return done.returncode, lines[-1]["run"], out, remark

    def test_whole_run(self):
        code, run, out, remark = self.run_input(text_of(9, 10, 11))
        self.assertEqual(code, 0)
        self.assertEqual(run, {"complete": True, "cases_planned": 3, "input_readable": True, "cases_finished": 3, "solved": 3,
                               "not_converged": 0, "refused": 0})
        self.assertNotIn("Not complete", out)
        self.assertEqual(remark, "complete, 3 of 3 cases")

    def test_wrong_value_in_the_second_case(self):
        code, run, out, remark = self.run_input(text_of(9, -10, 11, 12))
        self.assertEqual(code, 1)
        self.assertEqual([run[name] for name in ("complete", "cases_planned", "input_readable", "cases_finished")],
                         [False, 4, True, 1])
        self.assertIn("FN", run["reason"])
        self.assertIn(" Not complete: 1 of 4 cases finished\n", out)
        self.assertEqual(remark, "not complete, 1 of 4 cases")

    def test_text_that_cannot_be_read(self):
        code, run, out, remark = self.run_input(text_of(9, 10, "word", 12))
        self.assertEqual(code, 1)
        self.assertEqual([run[name] for name in ("complete", "cases_planned", "input_readable", "cases_finished")],
                         [False, 3, False, 2])
        self.assertIn("word", run["reason"])
        self.assertIn(" Not complete: 2 of at least 3 cases finished\n", out)
        self.assertEqual(remark, "not complete, 2 of at least 3 cases")

    def test_refused_cases_are_finished(self):
        code, run, out, _ = self.run_input(text_of(9, 10), "--limit-elements", "50")
        self.assertEqual(code, 1)
        self.assertEqual([run[name] for name in ("complete", "cases_planned", "cases_finished", "solved", "refused")],
                         [True, 2, 2, 0, 2])
        self.assertNotIn("Not complete", out)

    def test_surfaces_that_could_not_be_written(self):
        # a folder has the name of the second surface; the run itself ends at a wrong value, and is resumed
        os.mkdir(os.path.join(self.folder, "x.0002.vts"))
        code, run, _, remark = self.run_input(text_of(9, 10, 11))
        self.assertEqual((code, run["complete"]), (1, True))
        self.assertEqual(remark, "not complete, 3 of 3 cases, files missing in 1")
        self.run_input(text_of(9, 10, 11, "word"))
        code, _, _, remark = self.run_input(text_of(9, 10, 11, 12), "--resume")
        self.assertEqual((code, remark), (1, "not complete, 4 of 4 cases, files missing in 1"))
        with open(os.path.join(self.folder, "x.pvd")) as file:
            self.assertEqual(re.findall("timestep=.([0-9]+)|of case ([0-9]+)", file.read()),
                             [("1", ""), ("", "2"), ("3", ""), ("4", "")])

    def test_without_other_files_the_report_tells_it(self):
        with open(os.path.join(self.folder, "y.inp"), "w") as file:
            file.write(text_of(9, -10, 11, 12))
        subprocess.run([PROGRAM, "--quiet", "2", "y"], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True, timeout=60)
        with open(os.path.join(self.folder, "y.out")) as file:
            self.assertIn(" Not complete: 1 of 4 cases finished\n", file.read())


if __name__ == "__main__":
    unittest.main()
