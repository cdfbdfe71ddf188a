#!/usr/bin/env python3
"""The server's folders, inputs, new experiments from a form, and runs that continue after their page is closed.

Skipped (exit status 77) without h5py. Environment: CONTACT_PROGRAM, CONTACT_SOURCE.
"""
import http.client
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import urllib.parse

try:
    import h5py  # noqa: F401
except ImportError as reason:
    print("SKIPPED: %s" % reason)
    sys.exit(77)

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = os.environ["CONTACT_SOURCE"]
EXAMPLES = os.path.join(SOURCE, "examples")
sys.path.insert(0, os.path.join(SOURCE, "python"))
from contact.report.forms import KINDS
from contact.report.server import Server


class Folders(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = os.path.join(scratch.name, "inside")
        self.outside = os.path.join(scratch.name, "outside")
        for path in (self.outside, os.path.join(self.folder, "study", "deep"), os.path.join(self.folder, ".hidden"),
                     os.path.join(self.folder, "profiles")):
            os.makedirs(path)
        for name in ("cattaneo.inp", "study/run7.inp", "study/deep/run8.toml", ".hidden/secret.inp"):
            shutil.copy(os.path.join(EXAMPLES, "cattaneo." + name[-4:].strip(".")), os.path.join(self.folder, name))
        shutil.copy(os.path.join(EXAMPLES, "cattaneo.inp"), os.path.join(self.outside, "secret.inp"))
        for name in ("60E1.prr", "S1002.prw"):
            shutil.copy(os.path.join(EXAMPLES, "profiles", name), os.path.join(self.folder, "profiles"))
        os.symlink(self.outside, os.path.join(self.folder, "way_out"))
        os.symlink(os.path.join(self.folder, "study"), os.path.join(self.folder, "way_in"))
        os.environ["CONTACT_PROGRAM"] = PROGRAM
        self.server = Server(self.folder, 0)
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.addCleanup(self.server.server_close)
        self.addCleanup(self.server.shutdown)

    def ask(self, method, path, body=None, **query):
        connection = http.client.HTTPConnection("127.0.0.1", self.server.server_port, timeout=60)
        connection.request(method, path + ("?" + urllib.parse.urlencode(query) if query else ""), body)
        answer = connection.getresponse()
        text = answer.read().decode("utf-8")
        connection.close()
        return answer.status, text

    def listed(self, folder=""):
        return json.loads(self.ask("GET", "/files", folder=folder)[1])

    def events(self):
        stream = self.ask("GET", "/messages")[1]
        return [(kind, json.loads(data)) for kind, data in re.findall(r"event: (\w+)\ndata: (.*)\n", stream)]

    def job(self):
        return json.loads(self.ask("GET", "/job")[1])

    def test_folders_below_and_no_others(self):
        top = self.listed()
        self.assertEqual((top["folders"], [file["name"] for file in top["files"]]), (["profiles", "study"], ["cattaneo"]))
        deep = [(file["name"], file["formats"]) for file in self.listed("study/deep")["files"]]
        self.assertEqual(deep, [("study/deep/run8", ["toml"])])
        for folder in ("..", "../outside", "way_out", "way_in", ".hidden", "study/..", "study//deep", "/", "/etc", "study/", ".",
                       "%00", "cattaneo.inp", "study\0"):
            self.assertEqual(self.ask("GET", "/files", folder=folder)[0], 404, folder)
            self.assertEqual(self.ask("GET", "/form", folder=folder)[0], 404, folder)
        for name in ("way_out/secret", "../outside/secret", ".hidden/secret", "way_in/run7", "study/../cattaneo", "./cattaneo",
                     "study"):
            self.assertEqual(self.ask("POST", "/run", name=name)[0], 404, name)
            for path in ("/input", "/result"):
                self.assertEqual(self.ask("GET", path, name=name)[0], 404, name)
        self.assertIsNone(self.job())

    def test_inputs_are_shown(self):
        with open(os.path.join(self.folder, "study", "run7.inp"), encoding="utf-8") as file:
            self.assertEqual(self.ask("GET", "/input", name="study/run7", format="inp"), (200, file.read()))
        for form in ("toml", "h5", "out", "../cattaneo.inp"):
            self.assertEqual(self.ask("GET", "/input", name="study/run7", format=form)[0], 404, form)

    def test_runs_below_and_two_results_side_by_side(self):
        for name in ("study/deep/run8", "cattaneo"):
            self.assertEqual(self.ask("POST", "/run", name=name)[0], 200)
            self.assertEqual(self.events()[-1], ("end", 0))
        self.assertTrue(os.path.isfile(os.path.join(self.folder, "study", "deep", "run8.h5")))
        file = self.listed("study/deep")["files"][0]
        self.assertEqual((file["result"], file["run"]["complete"], file["run"]["cases_finished"]), ("fresh", 1, 2))
        both = self.ask("GET", "/result", **{"name": "study/deep/run8", "with": "cattaneo"})
        self.assertEqual(both[0], 200)
        self.assertRegex(both[1], 'id="data-other">[{].*"experiment":"cattaneo"')
        self.assertRegex(self.ask("GET", "/result", name="cattaneo")[1], 'id="data-other">null<')
        self.assertEqual(self.ask("GET", "/result", **{"name": "cattaneo", "with": "../outside/secret"})[0], 404)

    def test_a_run_is_found_again_stopped_and_told_incomplete(self):
        shutil.copy(os.path.join(EXAMPLES, "catt_to_cart.inp"), os.path.join(self.folder, "long.inp"))
        self.assertEqual(self.ask("POST", "/run", name="long")[0], 200)
        start = time.monotonic()
        while not (self.job()["begun"] > 1 and self.job()["planned"]) and time.monotonic() - start < 30:
            time.sleep(0.02)
        state = self.job()
        self.assertEqual((state["name"], state["mode"], state["done"], state["planned"]), ("long", "run", False, 171))
        self.assertEqual(self.ask("POST", "/stop")[0], 200)
        self.assertTrue(self.job()["stopping"] or self.job()["done"])
        events = self.events()
        self.assertEqual(events[-1][0], "end")
        self.assertGreater(events[-1][1], 128)
        self.assertIn(("progress", {"begun": self.job()["begun"], "planned": 171}), events)
        run = next(file for file in self.listed()["files"] if file["name"] == "long")["run"]
        self.assertEqual((run["complete"], run["cases_planned"]), (0, 171))
        self.assertLess(run["cases_finished"], 171)
        page = self.ask("GET", "/result", name="long")[1]
        data = json.loads(re.search(r'id="data">(.*?)</script>', page, re.DOTALL)[1])
        self.assertEqual(data["run"]["cases_finished"], run["cases_finished"])

    def form(self, which, **changes):
        fields = KINDS[which]["fields"]
        values = {name: third[0][0] if isinstance(third, list) else rest[0] if rest else None for name, _, third, *rest in fields}
        values.update({"rail": "profiles/60E1.prr", "wheel": "profiles/S1002.prw"} if which == "wheel" else {})
        values.update(changes.pop("values", {}))
        body = dict(kind=which, folder="", name="new", format="toml", values=values, vary="", to=0, count=1)
        return self.ask("POST", "/new", json.dumps({**body, **changes}))

    def test_new_experiments_in_both_formats(self):
        offered = json.loads(self.ask("GET", "/form", folder="")[1])
        self.assertEqual(offered["profiles"], ["profiles/60E1.prr", "profiles/S1002.prw"])
        for kind, vary, to in (("hertz", "cksi", -0.003), ("wheel", "y_ws", 4.0)):
            totals = {}
            for form in ("inp", "toml"):
                name = kind + form
                status, answer = self.form(kind, name=name, format=form, vary=vary, to=to, count=3)
                self.assertEqual(status, 200, answer)
                self.assertEqual(json.loads(answer)["name"], name)
                self.assertEqual([os.path.isfile(os.path.join(self.folder, name + "." + f)) for f in ("inp", "toml")],
                                 [f == form for f in ("inp", "toml")])
                # the second order of steady rolling is the default of the readable format, and an option of the other one
                order = ["--order", "2"] if form == "inp" else []
                run = subprocess.run([PROGRAM, "--json=-", *order, "2", os.path.join(self.folder, name)], capture_output=True,
                                     text=True, stdin=subprocess.DEVNULL, timeout=120)
                cases = [json.loads(line) for line in run.stdout.splitlines()][:-1]
                self.assertEqual([case["status"] for case in cases], ["solved"]*3)
                totals[form] = [case["patches"][0]["totals"] for case in cases]
            self.assertEqual(totals["inp"], totals["toml"])
            if kind == "hertz":   # values are passed correctly, in equal steps; pressure is that of Hertz
                self.assertEqual([round(t["cksi"]["value"], 9) for t in totals["inp"]], [-0.001, -0.002, -0.003])
                self.assertAlmostEqual(totals["inp"][0]["fn"]["value"], 10000.0, delta=0.01)
            else:
                fy = [case["totals"]["y_ws"]["value"] for case in cases]
                self.assertEqual([round(y, 9) for y in fy], [0.0, 2.0, 4.0])

    def test_forms_that_are_refused_leave_nothing(self):
        before = sorted(os.listdir(self.folder))
        refused = [dict(name="../new"), dict(name="new/x"), dict(name=""), dict(name=".new"), dict(name="a b"), dict(name="x" *
                   61), dict(name="new.inp"), dict(name=7), dict(folder="../outside"), dict(folder="way_out"),
                   dict(folder=".hidden"), dict(format="h5"), dict(kind="other"), dict(name="cattaneo"), dict(count=0),
                   dict(count=1000, vary="cksi"), dict(count=3), dict(count=2.5, vary="cksi"), dict(vary="mx", count=3),
                   dict(vary="cksi", count=3, to=None), dict(values={"fn": None}), dict(values={"fn": "1\n[case]"}),
                   dict(values={"fn": True}), dict(values={"fn": 1e300}), dict(values={"motion": "other"}), dict(values={"rx":
                   -1.0}), dict(values={"gg": -1.0}), dict(values={"mx": 0})]
        for changes in refused:
            status, answer = self.form("hertz", **changes)
            self.assertEqual(status, 422, (changes, answer))
        for profile in ("../outside/secret.inp", "profiles/../profiles/60E1.prr", "/etc/passwd", "cattaneo.inp"):
            self.assertEqual(self.form("wheel", values={"rail": profile})[0], 422, profile)
        for body in ("", "[]", "{}", "{", '{"values": {}}', "\0"):
            self.assertEqual(self.ask("POST", "/new", body)[0], 422, body)
        self.assertEqual(sorted(os.listdir(self.folder)), before)
        # bounds are checked by the program, with its messages
        self.assertRegex(self.form("hertz", values={"poiss": 0.7})[1], "(?i)poiss")
        self.assertEqual(os.listdir(self.outside), ["secret.inp"])
        os.symlink(os.path.join(self.outside, "made.toml"), os.path.join(self.folder, "new.toml"))
        self.assertEqual(self.form("hertz")[0], 422)
        self.assertEqual(os.listdir(self.outside), ["secret.inp"])


if __name__ == "__main__":
    unittest.main()
