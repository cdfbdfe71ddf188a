#!/usr/bin/env python3
"""contact report: pages from results, the launcher, and a server that refuses foreign requests.

Skipped (exit status 77) without h5py. Environment: CONTACT_PROGRAM, CONTACT_SOURCE.
"""
import contextlib
import http.client
import json
import os
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from random import Random

try:
    import h5py  # noqa: F401
except ImportError as reason:
    print("SKIPPED: %s" % reason)
    sys.exit(77)

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = os.environ["CONTACT_SOURCE"]
sys.path.insert(0, os.path.join(SOURCE, "python"))
from contact.report import (MissingResults, read_experiment, server)
from contact.report.server import Server


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
                              capture_output=True, text=True, timeout=120)

    def test_page_is_one_file_without_network(self):
        run = self.report("cattaneo")
        self.assertEqual((run.returncode, run.stdout.strip()), (0, "cattaneo.html"), run.stderr)
        with open(os.path.join(self.folder, "cattaneo.html"), encoding="utf-8") as file:
            page = file.read()
        # the name of the SVG namespace looks like an address
        page = page.replace("http://www.w3.org/2000/svg", "")
        found = re.search(r"""(src|href)\s*=|https?://|@[A-Z]+@|\bfetch\(""", page)
        self.assertIsNone(found, found and page[found.start() - 80:found.end() + 80])
        self.assertIn("default-src 'none'", page)
        self.assertEqual(len(re.findall("</script>", page)), 5)
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
                             capture_output=True, text=True, timeout=60)
        if run.returncode:   # unless the package is installed for all
            self.assertIn("CONTACT_PYTHON", run.stderr)
        run = subprocess.run([os.path.join(lonely, "contact"), "report", "cattaneo"], cwd=self.folder, stdin=subprocess.DEVNULL,
                             env=dict(os.environ, CONTACT_PYTHON=os.path.join(SOURCE, "python")),
                             capture_output=True, text=True, timeout=60)
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

    def files(self, folder=""):
        return json.loads(self.ask("GET", "/files?folder=" + folder)[1])["files"]

    def messages(self):
        status, text = self.ask("GET", "/messages")
        self.assertEqual(status, 200)
        return [(kind, json.loads(data)) for kind, data in re.findall(r"event: (\w+)\ndata: (.*)\n", text) if kind != "progress"]

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
        found = json.loads(self.ask("GET", "/files")[1])
        self.assertEqual([file["name"] for file in found["files"]], ["--version", "cattaneo", "wrong"])
        self.assertEqual(found["folders"], ["folder.inp"])
        for name in ("link", "..%2Foutside%2Fsecret", "../outside/secret", "folder", "other", "other.txt", "", "cattaneo.inp",
                     "%00", "cattaneo;id"):
            for path in ("/run", "/check"):
                self.assertEqual(self.ask("POST", "%s?name=%s" % (path, name))[0], 404, name)
            self.assertEqual(self.ask("GET", "/result?name=" + name)[0], 404, name)
        for path in ("/cattaneo.inp", "/../outside/secret.inp", "/%2e%2e/outside/secret.inp"):
            self.assertEqual(self.ask("GET", path)[0], 404)
        self.assertIsNone(self.server.job)

    def test_run_with_messages_and_result(self):
        self.assertEqual(self.ask("GET", "/result?name=cattaneo")[0], 404)
        self.assertEqual(self.ask("POST", "/run?name=cattaneo")[0], 200)
        messages = self.messages()
        self.assertEqual(messages[-1], ("end", 0))
        self.assertTrue(any("Case" in str(text) for kind, text in messages if kind == "line"))
        self.assertEqual(messages, self.messages())
        state = json.loads(self.ask("GET", "/job")[1])
        self.assertEqual((state["name"], state["mode"], state["done"], state["status"], state["begun"]),
                         ("cattaneo", "run", True, 0, 2))
        status, page = self.ask("GET", "/result?name=cattaneo")
        self.assertEqual(status, 200)
        self.assertIn("cattaneo", page)
        self.assertEqual({file["name"]: file["result"] for file in self.files()}["cattaneo"], "fresh")

    def test_check_tells_errors_and_names_are_no_options(self):
        self.assertEqual(self.ask("POST", "/check?name=wrong")[0], 200)
        messages = self.messages()
        self.assertEqual(messages[-1], ("end", 1))
        self.assertTrue(any("wrong.inp:2" in str(text) for _, text in messages))
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

    def test_runs_are_confined(self):
        with open(os.path.join(SOURCE, "examples", "wheel_on_rail.inp")) as source:
            text = source.read()
        os.mkdir(os.path.join(self.folder, "profiles"))
        for name in re.findall(r"profiles/\w+\.\w+", text):
            shutil.copy(os.path.join(SOURCE, "examples", name), os.path.join(self.folder, "profiles"))
        with open(os.path.join(self.folder, "inside.inp"), "w") as file:
            file.write(text)
        outside = os.path.join(os.path.dirname(self.folder), "outside", "profiles")
        shutil.copytree(os.path.join(self.folder, "profiles"), outside)
        with open(os.path.join(self.folder, "away.inp"), "w") as file:
            file.write(text.replace("profiles/", "../outside/profiles/"))
        for name, status in (("inside", 0), ("away", 1)):
            self.assertEqual(self.ask("POST", "/check?name=" + name)[0], 200)
            messages = self.messages()
            self.assertEqual(messages[-1], ("end", status), messages)
        self.assertTrue(any("not below the folder" in str(text) for _, text in messages))
        os.symlink(os.path.join(self.folder, "other.txt"), os.path.join(self.folder, "cattaneo.h5"))
        self.assertEqual(self.ask("GET", "/result?name=cattaneo")[0], 404)

    def test_requests_have_their_time(self):
        before = server.REQUEST_TIME
        server.REQUEST_TIME = 1.0
        self.addCleanup(setattr, server, "REQUEST_TIME", before)
        with socket.create_connection(("127.0.0.1", self.server.server_port), timeout=20) as connection:
            start = time.monotonic()
            connection.settimeout(0.1)
            with contextlib.suppress(ConnectionError):
                while time.monotonic() - start < 5:   # single bytes, sent until the time limit of the request
                    connection.sendall(b"G")
                    with contextlib.suppress(TimeoutError):
                        if not connection.recv(1):
                            break
            self.assertLess(time.monotonic() - start, 4)


class Hostile(unittest.TestCase):
    """The server as a separate process, with requests that no browser sends"""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        shutil.copy(os.path.join(SOURCE, "examples", "cattaneo.inp"), self.folder)
        self.server = subprocess.Popen([PROGRAM, "report", "--serve", self.folder, "--port", "0"], stdin=subprocess.DEVNULL,
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=self.environment())
        self.addCleanup(self.end)
        line = self.server.stdout.readline()
        self.port = int(re.search(r":(\d+)/", line)[1])
        self.own = b"Host: 127.0.0.1:%d\r\n" % self.port

    @staticmethod
    def environment():
        return dict(os.environ, CONTACT_PYTHON=os.path.join(SOURCE, "python"))

    def end(self):
        if self.server.poll() is None:
            self.server.kill()
        self.server.communicate()

    def send(self, data, seconds=5.0, shut=False):
        """The answer to some bytes, b"" without an answer"""
        with socket.create_connection(("127.0.0.1", self.port), timeout=seconds) as connection:
            try:
                connection.sendall(data)
                if shut:
                    with contextlib.suppress(OSError):   # the server has closed the connection
                        connection.shutdown(socket.SHUT_WR)
                answer = b""
                while len(answer) < 1000000:
                    more = connection.recv(65536)
                    if not more:
                        break
                    answer += more
                    if b"\r\n\r\n" in answer and b"event-stream" not in answer:
                        break
            except ConnectionError:
                return b""
            except TimeoutError:
                self.fail("no answer, and the connection is not closed after %r" % data[:80])
        return answer

    def good(self):
        start, answer = time.monotonic(), b""
        while not answer and time.monotonic() - start < 5:   # closed connections are still counted for a short time
            answer = self.send(b"GET /files HTTP/1.1\r\n" + self.own + b"Connection: close\r\n\r\n")
        self.assertTrue(answer.startswith(b"HTTP/1.1 200"), answer[:100])

    def ended_well(self):
        self.good()
        self.server.terminate()
        _, errors = self.server.communicate(timeout=10)
        self.assertEqual(self.server.returncode, 0)
        self.assertNotIn("Traceback", errors)
        self.assertEqual(errors, "")

    def test_hostile_requests(self):
        own = self.own
        requests = [b"POST /run?name=cattaneo HTTP/1.1\r\n" + own + "Content-Length: \u00b2\r\n\r\n".encode("latin-1"),
                    b"POST /run?name=cattaneo HTTP/1.1\r\n" + own + b"Content-Length: -1\r\n\r\n",
                    b"POST /run?name=cattaneo HTTP/1.1\r\n" + own + b"Content-Length: 99999999999999999999\r\n\r\n",
                    b"POST /run?name=cattaneo HTTP/1.1\r\n" + own + b"Content-Length: 1\r\nContent-Length: 0\r\n\r\n",
                    b"POST /run?name=cattaneo HTTP/1.1\r\n" + own + b"Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n",
                    b"POST /run HTTP/1.1\r\n" + own + b"Content-Length: 70000\r\n\r\n" + b"x" * 70000, b"GET http://[ HTTP/1.1\r\n"
                    + own + b"\r\n", b"GET //[ HTTP/1.1\r\n" + own + b"\r\n", b"GET /result?name=%00 HTTP/1.1\r\n" + own + b"\r\n",
                    b"GET /result?name=../../etc/passwd HTTP/1.1\r\n" + own + b"\r\n", b"GET /../../etc/passwd HTTP/1.1\r\n" + own
                    + b"\r\n", b"GET /\0 HTTP/1.1\r\n" + own + b"\r\n", b"GET /?" + b"a=1&" * 10000 + b" HTTP/1.1\r\n" + own
                    + b"\r\n", b"GET /" + b"a" * 70000 + b" HTTP/1.1\r\n" + own + b"\r\n", b"GET /\r\n", b"GET\r\n", b"\r\n",
                    b"\0\0\0\0\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"GET / HTTP/1.1\r\n\r\n", b"BREW /pot HTTP/1.1\r\n" + own
                    + b"\r\n", b"HEAD / HTTP/1.1\r\n" + own + b"\r\n", b"PUT / HTTP/1.1\r\n" + own + b"\r\n", b"GET / HTTP/1.1\r\n"
                    + own + b"A: b\r\n" * 200 + b"\r\n", b"GET / HTTP/1.1\r\n" + own + b"A: " + b"b" * 70000 + b"\r\n\r\n",
                    b"GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n", b"GET / HTTP/1.1\r\n" + own + own + b"\r\n",
                    b"GET / HTTP/1.1\r\n" + own + b"Origin: http://127.0.0.1.evil.example\r\n\r\n",
                    b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + bytes(200)]
        for request in requests:
            answer = self.send(request, shut=True)
            status = re.match(rb"HTTP/1\.[01] (\d+)", answer)
            if status:
                self.assertIn(int(status[1]), (400, 403, 404, 413, 414, 431, 501, 505), (request[:80], answer[:80]))
            self.assertNotIn(b"root:", answer)
        self.assertNotIn(b'"files"', self.send(b"GET /files\r\n" + own + b"\r\n", shut=True))   # HTTP/0.9, of older browsers
        random = Random(14)
        seeds = [b"GET /files HTTP/1.1\r\n" + own + b"\r\n", b"POST /check?name=cattaneo HTTP/1.1\r\n" + own
                 + b"Content-Length: 3\r\n\r\nabc", b"GET /result?name=cattaneo HTTP/1.1\r\n" + own
                 + b"Origin: http://127.0.0.1\r\n\r\n"]
        for _ in range(300):
            data = bytearray(random.choice(seeds))
            for _ in range(random.randint(1, 6)):
                at = random.randrange(len(data))
                kind = random.randrange(4)
                if kind == 0:
                    data[at] = random.randrange(256)
                elif kind == 1:
                    del data[at:at + random.randint(1, 20)]
                elif kind == 2:
                    data[at:at] = bytes(random.randrange(256) for _ in range(random.randint(1, 20)))
                else:
                    data[at:at] = data[random.randrange(len(data)):][:40]
                data = data or bytearray(b"\n")
            answer = self.send(bytes(data), shut=True)
            status = re.match(rb"HTTP/1\.[01] (\d+)", answer)
            self.assertTrue(status is None or int(status[1]) in (200, 400, 403, 404, 409, 411, 413, 414, 431, 501, 505),
                            answer[:80])
        self.ended_well()

    def test_slow_and_many(self):
        with contextlib.ExitStack() as open_ones:
            slow = [open_ones.enter_context(socket.create_connection(("127.0.0.1", self.port))) for _ in range(200)]
            for connection in slow:
                with contextlib.suppress(ConnectionError):
                    connection.sendall(b"GET / HT")
            self.assertIsNone(self.server.poll())
        self.good()
        self.ended_well()

    def test_ends_with_its_process(self):
        self.good()
        self.server.terminate()
        self.assertEqual(self.server.wait(10), 0)
        with self.assertRaises(OSError):
            socket.create_connection(("127.0.0.1", self.port), timeout=1)

    def test_ports(self):
        for port in ("99999", "-1", "x", "", "\u00b2"):
            run = subprocess.run([PROGRAM, "report", "--serve", self.folder, "--port", port], stdin=subprocess.DEVNULL,
                                 env=self.environment(), capture_output=True, text=True, timeout=60)
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertIn("port numbers are 0 to 65535", run.stderr)
            self.assertNotIn("Traceback", run.stderr)
        run = subprocess.run([PROGRAM, "report", "--serve", self.folder, "--port", str(self.port)], stdin=subprocess.DEVNULL,
                             env=self.environment(), capture_output=True, text=True, timeout=60)
        self.assertEqual(run.returncode, 1)
        self.assertIn("in use", run.stderr)


if __name__ == "__main__":
    unittest.main()
