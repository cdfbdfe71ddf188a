#!/usr/bin/env python3
"""contact report: pages from results, the launcher, and a server that does nothing for strangers.

Skipped (exit status 77) without h5py. The environment tells CONTACT_PROGRAM and CONTACT_SOURCE.
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

try:
    import h5py  # noqa: F401
except ImportError as reason:
    print("SKIPPED: %s" % reason)
    sys.exit(77)

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = os.environ["CONTACT_SOURCE"]
sys.path.insert(0, os.path.join(SOURCE, "python"))
from contact.report import MissingResults, read_experiment  # noqa: E402
from contact.report.server import Server  # noqa: E402


def make_results(folder, name):
    """The .h5 file of an example"""
    subprocess.run([PROGRAM, "--quiet", "--hdf5", "--output-dir", folder, "2", os.path.join(SOURCE, "examples", name)],
                   check=True, stdin=subprocess.DEVNULL, timeout=120)


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = cls.scratch.name
        make_results(cls.folder, "cattaneo")

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def report(self, *arguments, **changes):
        environment = dict(os.environ, **changes)
        return subprocess.run([PROGRAM, "report", *arguments], cwd=self.folder, stdin=subprocess.DEVNULL, env=environment,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=120)

    def test_page_is_one_file_without_network(self):
        run = self.report("cattaneo")
        self.assertEqual((run.returncode, run.stdout.strip()), (0, "cattaneo.html"), run.stderr)
        with open(os.path.join(self.folder, "cattaneo.html"), encoding="utf-8") as file:
            page = file.read()
        self.assertNotRegex(page, r"""(src|href)\s*=|https?://|@[A-Z]+@|\bfetch\(""")
        self.assertIn("default-src 'none'", page)
        self.assertEqual(len(re.findall("</script>", page)), 3)
        again = self.report("cattaneo.inp", "-o", "a 'b' $c.html")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertTrue(os.path.isfile(os.path.join(self.folder, "a 'b' $c.html")))

    def test_what_is_missing_is_said(self):
        run = self.report("nothing")
        self.assertEqual(run.returncode, 1)
        self.assertIn("neither nothing.h5 nor nothing.inp", run.stderr)
        with open(os.path.join(self.folder, "waiting.inp"), "w") as file:
            file.write("0\n")
        run = self.report("waiting")
        self.assertIn("contact --hdf5 2 waiting", run.stderr)
        with open(os.path.join(self.folder, "broken.h5"), "w") as file:
            file.write("no results")
        self.assertIn("cannot be read", self.report("broken").stderr)
        lonely = os.path.join(self.folder, "bin")
        os.makedirs(lonely, exist_ok=True)
        shutil.copy(PROGRAM, lonely)
        run = subprocess.run([os.path.join(lonely, "contact"), "report", "cattaneo"], cwd=self.folder, stdin=subprocess.DEVNULL,
                             env={k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "CONTACT_PYTHON")},
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=60)
        if run.returncode:   # unless the package is installed for all
            self.assertIn("CONTACT_PYTHON", run.stderr)
        run = subprocess.run([os.path.join(lonely, "contact"), "report", "cattaneo"], cwd=self.folder, stdin=subprocess.DEVNULL,
                             env=dict(os.environ, CONTACT_PYTHON=os.path.join(SOURCE, "python")),
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_data_of_the_page(self):
        data, blobs = read_experiment(os.path.join(self.folder, "cattaneo.h5"))
        self.assertEqual([case["number"] for case in data["cases"]], [1, 2])
        patch = data["cases"][1]["patches"][0]
        self.assertAlmostEqual(patch["totals"]["fx_rel"], -0.875, places=3)
        self.assertLess(max(patch["fields"].values()), len(blobs))
        json.dumps(data, allow_nan=False)
        with self.assertRaises(MissingResults):
            read_experiment(os.path.join(self.folder, "missing.h5"))


class Serving(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        outside = os.path.join(scratch.name, "outside")
        self.folder = os.path.join(scratch.name, "inside")
        os.mkdir(outside)
        os.mkdir(self.folder)
        example = os.path.join(SOURCE, "examples", "cattaneo.inp")
        shutil.copy(example, self.folder)
        shutil.copy(example, os.path.join(outside, "secret.inp"))
        shutil.copy(example, os.path.join(self.folder, "--version.inp"))
        os.symlink(os.path.join(outside, "secret.inp"), os.path.join(self.folder, "link.inp"))
        os.mkdir(os.path.join(self.folder, "folder.inp"))
        with open(os.path.join(self.folder, "other.txt"), "w") as file:
            file.write("no input")
        with open(os.path.join(self.folder, "wrong.inp"), "w") as file:
            file.write("3\nnonsense\n")
        os.environ["CONTACT_PROGRAM"] = PROGRAM
        self.server = Server(self.folder, 0)
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.addCleanup(self.server.server_close)
        self.addCleanup(self.server.shutdown)

    def ask(self, method, path, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.server.server_port, timeout=60)
        connection.putrequest(method, path, skip_host="Host" in headers)
        for name, value in headers.items():
            connection.putheader(name.replace("_", "-"), value)
        if method == "POST":
            connection.putheader("Content-Length", "0")
        connection.endheaders()
        answer = connection.getresponse()
        text = answer.read().decode("utf-8")
        connection.close()
        return answer.status, text

    def messages(self):
        status, text = self.ask("GET", "/messages")
        self.assertEqual(status, 200)
        return [(kind, json.loads(data)) for kind, data in re.findall(r"event: (\w+)\ndata: (.*)\n", text)]

    def test_listens_on_the_loopback_address_only(self):
        self.assertEqual(self.server.server_address[0], "127.0.0.1")

    def test_strangers_are_refused(self):
        own = "127.0.0.1:%d" % self.server.server_port
        self.assertEqual(self.ask("GET", "/files", Host=own)[0], 200)
        self.assertEqual(self.ask("GET", "/files", Host=own, Origin="http://" + own)[0], 200)
        for headers in (dict(Host="evil.example"), dict(Host="127.0.0.1:1"), dict(Host=own, Origin="http://evil.example"),
                        dict(Host=own, Origin="null"), dict(Host=own, Sec_Fetch_Site="cross-site")):
            for method, path in (("GET", "/"), ("GET", "/files"), ("POST", "/run?name=cattaneo"), ("POST", "/stop")):
                self.assertEqual(self.ask(method, path, **headers)[0], 403, (headers, path))
        self.assertIsNone(self.server.job)

    def test_only_inputs_of_the_folder(self):
        files = json.loads(self.ask("GET", "/files")[1])
        self.assertEqual([file["name"] for file in files], ["--version", "cattaneo", "wrong"])
        for name in ("link", "..%2Foutside%2Fsecret", "../outside/secret", "folder", "other", "other.txt", "", "cattaneo.inp", "%00",
                     "cattaneo;id"):
            for path in ("/run", "/check"):
                self.assertEqual(self.ask("POST", "%s?name=%s" % (path, name))[0], 404, name)
            self.assertEqual(self.ask("GET", "/result?name=" + name)[0], 404, name)
        for path in ("/cattaneo.inp", "/../outside/secret.inp", "/%2e%2e/outside/secret.inp"):
            self.assertEqual(self.ask("GET", path)[0], 404)
        self.assertIsNone(self.server.job)

    def test_run_with_messages_and_result(self):
        self.assertEqual(self.ask("GET", "/result?name=cattaneo")[0], 404)
        self.assertEqual(self.ask("POST", "/run?name=cattaneo")[0], 200)
        told = self.messages()
        self.assertEqual(told[-1], ("end", 0))
        self.assertTrue(any("Case" in str(text) for kind, text in told if kind == "line"))
        self.assertEqual(told, self.messages())
        status, page = self.ask("GET", "/result?name=cattaneo")
        self.assertEqual(status, 200)
        self.assertIn("cattaneo", page)
        self.assertEqual({file["name"]: file["result"] for file in json.loads(self.ask("GET", "/files")[1])}["cattaneo"], "fresh")

    def test_check_tells_errors_and_names_are_no_options(self):
        self.assertEqual(self.ask("POST", "/check?name=wrong")[0], 200)
        told = self.messages()
        self.assertEqual(told[-1], ("end", 1))
        self.assertTrue(any("wrong.inp:2" in str(text) for _, text in told))
        self.assertEqual(self.ask("POST", "/check?name=--version")[0], 200)
        self.assertTrue(any("checked" in str(text) for _, text in self.messages()))

    def test_one_run_at_a_time_and_stop(self):
        with open(os.path.join(self.folder, "long.inp"), "w") as file, \
                open(os.path.join(SOURCE, "examples", "catt_to_cart.inp")) as source:
            text = source.read()
            file.write(text)
        self.assertEqual(self.ask("POST", "/run?name=long")[0], 200)
        self.assertEqual(self.ask("POST", "/run?name=cattaneo")[0], 409)
        self.assertEqual(self.ask("POST", "/stop")[0], 200)
        self.assertNotEqual(self.messages()[-1], ("end", 0))
        time.sleep(0.1)
        self.assertEqual(self.ask("POST", "/check?name=cattaneo")[0], 200)
        self.assertEqual(self.messages()[-1], ("end", 0))


if __name__ == "__main__":
    unittest.main()
