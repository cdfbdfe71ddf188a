"""Experiments of a folder checked, run and seen in a browser on this machine.

The server listens on the loopback address and refuses requests that carry the name of another host or come from
a page of another origin, so that no web page elsewhere can use it. It runs one program only, contact, and on
nothing but the .inp files that lie in the folder; each run is confined to that folder and to the limits of --confine.
A request has to be complete after some seconds, and only so many connections are open at a time.
"""
from __future__ import annotations

import html
import io
import json
import os
import re
import shutil
import signal
import stat
import subprocess
import sys
import threading
import time
import urllib.parse
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from .page import page_of, resource
from .read import MissingResults

DEFAULT_PORT = 8765
ADDRESS = "127.0.0.1"
# How long a stream of messages waits before it says that it is alive [s]
PATIENCE = 10.0
# Time for a whole request, and for an answer to be taken [s]
REQUEST_TIME, ANSWER_TIME = 10.0, 60.0
# Connections at a time, and pages that are made from results at a time
MOST_CONNECTIONS, MOST_PAGES = 64, 2
# Longest body of a request [bytes], and messages of a run that are kept
MOST_BYTES, MOST_MESSAGES = 65536, 20000
# How long a run that is to end may take for the case in hand [s]
LAST_CASE = 2.0


def program_path() -> str:
    """The program: named by CONTACT_PROGRAM, or on the search path"""
    named = os.environ.get("CONTACT_PROGRAM")
    found = shutil.which(named or "contact")
    if not found:
        raise MissingResults("the program contact is not found; name it by the environment variable CONTACT_PROGRAM")
    return os.path.abspath(found)


class Folder:
    """The .inp files of one folder"""

    def __init__(self, path: str) -> None:
        if not os.path.isdir(path):
            raise MissingResults("%s is no folder" % path)
        self.path = os.path.realpath(path)

    def names(self) -> list[str]:
        """Names of experiments: ordinary files of this folder, no links that lead out of it"""
        found = []
        for entry in os.scandir(self.path):
            if not entry.name.endswith(".inp") or len(entry.name) == 4 or not entry.is_file():
                continue
            if os.path.dirname(os.path.realpath(entry.path)) == self.path:
                found.append(entry.name[:-4])
        return sorted(found)

    def result(self, name: str) -> tuple[str, float | None]:
        """The .h5 file of an experiment and when it was changed; None unless it is an ordinary file, and no link to one"""
        path = os.path.join(self.path, name + ".h5")
        try:
            status = os.lstat(path)
        except OSError:
            return path, None
        return path, status.st_mtime if stat.S_ISREG(status.st_mode) else None

    def list(self) -> list[dict[str, Any]]:
        files = []
        for name in self.names():
            status = os.stat(os.path.join(self.path, name + ".inp"))
            changed = self.result(name)[1]
            files.append({"name": name, "size": status.st_size, "changed": status.st_mtime,
                          "result": "none" if changed is None else "fresh" if changed >= status.st_mtime else "old"})
        return files


class Job:
    """One run of the program; its messages are kept, so that every listener gets all of them"""

    def __init__(self, folder: Folder, name: str, mode: str) -> None:
        self.name, self.mode = name, mode
        self.messages: list[tuple[str, Any]] = []
        self.done = False
        self.news = threading.Condition()
        # the name comes from the list of the folder; after -- it cannot be an option
        command = [program_path(), "--confine", *(["--hdf5"] if mode == "run" else []), "--", "2" if mode == "run" else "3",
                   os.path.join(folder.path, name)]
        self.process = subprocess.Popen(command, cwd=folder.path, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                        stderr=subprocess.STDOUT, start_new_session=True)
        threading.Thread(target=self._listen, daemon=True).start()

    def _tell(self, kind: str, value: Any) -> None:
        with self.news:
            self.messages.append((kind, value))
            self.done = kind == "end"
            self.news.notify_all()

    def _listen(self) -> None:
        assert self.process.stdout is not None
        with self.process.stdout as lines:
            for number, line in enumerate(lines):
                if number < MOST_MESSAGES:
                    self._tell("line", line[:1000].decode("utf-8", "replace").rstrip("\r\n"))
                elif number == MOST_MESSAGES:
                    self._tell("line", "There are more messages; the .out file has them.")
        self._tell("end", self.process.wait())

    def stop(self) -> None:
        """The first time the run ends after the case in hand, the second time at once"""
        if not self.done:
            self.process.terminate()

    def end(self) -> None:
        """End the run, with its files closed if the case in hand is short"""
        self.stop()
        try:
            self.process.wait(LAST_CASE)
        except subprocess.TimeoutExpired:
            self.process.kill()


class _InTime(io.RawIOBase):
    """What a client sends until some moment; then it is cut off, however slowly it went on"""

    def __init__(self, connection: Any) -> None:
        self.connection = connection
        self.start()

    def start(self) -> None:
        self.until = time.monotonic() + REQUEST_TIME

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: Any) -> int:
        left = self.until - time.monotonic()
        if left <= 0.0:
            raise TimeoutError("the request took too long")
        self.connection.settimeout(left)
        try:
            return int(self.connection.recv_into(buffer))
        finally:
            self.connection.settimeout(ANSWER_TIME)


class Handler(BaseHTTPRequestHandler):
    server: Server
    protocol_version = "HTTP/1.1"
    server_version = "contact-report"
    sys_version = ""

    def setup(self) -> None:
        super().setup()
        self.in_time = _InTime(self.connection)
        self.rfile = io.BufferedReader(self.in_time)

    def handle_one_request(self) -> None:
        self.in_time.start()
        try:
            super().handle_one_request()
        except (ConnectionError, TimeoutError):
            self.close_connection = True

    def log_message(self, form: str, *values: Any) -> None:
        pass

    def _answer(self, status: int, body: str, kind: str = "text/plain") -> None:
        data = body.encode("utf-8", "replace")
        self.send_response(status)
        self.send_header("Content-Type", kind + "; charset=utf-8")
        self.send_header("Content-Length", str(len(data)))
        self.send_header("X-Content-Type-Options", "nosniff")
        self.send_header("X-Frame-Options", "DENY")
        self.send_header("Cache-Control", "no-store")
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(data)

    def _is_foreign(self) -> bool:
        """Does the request name another host, or does it come from a page of another origin?"""
        own = ["%s:%d" % (host, self.server.server_port) for host in (ADDRESS, "localhost")]
        hosts, origins = self.headers.get_all("Host", []), self.headers.get_all("Origin", [])
        return (len(hosts) != 1 or hosts[0].lower() not in own
                or any(origin.lower() not in ["http://" + host for host in own] for origin in origins)
                or self.headers.get("Sec-Fetch-Site", "none") not in ("none", "same-origin"))

    def _experiment(self, query: dict[str, list[str]]) -> str | None:
        name = query.get("name", [""])[0]
        return name if name in self.server.folder.names() else None

    def _safely(self, work: Any) -> None:
        """Answer a request; what goes wrong is an answer too"""
        try:
            if self._is_foreign():
                self.close_connection = True
                return self._answer(403, "this server answers to pages of its own only")
            try:
                address = urllib.parse.urlsplit(self.path)
                query = urllib.parse.parse_qs(address.query, max_num_fields=8)
            except ValueError:
                return self._answer(400, "the address of the request cannot be understood")
            work(address.path, query)
        except (ConnectionError, TimeoutError):
            raise
        except Exception as fault:  # pylint: disable=broad-exception-caught
            print("contact report: a request failed: %r" % fault, file=sys.stderr)
            self.close_connection = True
            self._answer(500, "the request failed: %s" % type(fault).__name__)

    def do_GET(self) -> None:
        self._safely(self._show)

    def do_POST(self) -> None:
        lengths = self.headers.get_all("Content-Length", ["0"])
        if len(lengths) != 1 or not re.fullmatch("[0-9]{1,9}", lengths[0]) or "Transfer-Encoding" in self.headers:
            self.close_connection = True
            return self._answer(400, "the length of the request cannot be understood")
        if int(lengths[0]) > MOST_BYTES:
            self.close_connection = True
            return self._answer(413, "the request is too long")
        self.rfile.read(int(lengths[0]))
        return self._safely(self._do)

    def _show(self, path: str, query: dict[str, list[str]]) -> None:
        if path == "/":
            page = resource("start.html").replace("@FOLDER@", html.escape(self.server.folder.path))
            return self._answer(200, page, "text/html")
        if path == "/files":
            return self._answer(200, json.dumps(self.server.folder.list()), "application/json")
        if path == "/messages":
            return self._stream()
        if path == "/result":
            name = self._experiment(query)
            if name is None:
                return self._answer(404, "there is no such experiment in this folder")
            result, changed = self.server.folder.result(name)
            if changed is None:
                return self._answer(404, "there is no result of %s yet" % name)
            try:
                with self.server.pages:
                    page = page_of(result)
                return self._answer(200, page, "text/html")
            except MissingResults as reason:
                return self._answer(404, str(reason))
        return self._answer(404, "there is no such page")

    def _do(self, path: str, query: dict[str, list[str]]) -> None:
        if path == "/stop":
            self.server.stop_job()
            return self._answer(200, "stopped")
        if path not in ("/run", "/check"):
            return self._answer(404, "there is no such page")
        name = self._experiment(query)
        if name is None:
            return self._answer(404, "there is no such experiment in this folder")
        try:
            started = self.server.start_job(name, path[1:])
        except (MissingResults, OSError) as reason:
            return self._answer(500, str(reason))
        return self._answer(200 if started else 409, "started" if started else "another experiment is running; wait or stop it")

    def _stream(self) -> None:
        """Messages of the job as server-sent events, from its first one on"""
        job = self.server.job
        self.send_response(200)
        self.send_header("Content-Type", "text/event-stream")
        self.send_header("Cache-Control", "no-store")
        self.send_header("Connection", "close")
        self.end_headers()
        self.close_connection = True
        sent = 0
        try:
            while job is not None:
                with job.news:
                    if sent == len(job.messages) and not job.done:
                        job.news.wait(PATIENCE)
                    news, done = job.messages[sent:], job.done
                if not news:
                    self.wfile.write(b": still at work\n\n")
                for kind, value in news:
                    self.wfile.write(("event: %s\ndata: %s\n\n" % (kind, json.dumps(value))).encode("utf-8"))
                self.wfile.flush()
                sent += len(news)
                if done:
                    return
        except (ConnectionError, TimeoutError):
            pass


class Server(ThreadingHTTPServer):
    daemon_threads = True
    request_queue_size = MOST_CONNECTIONS

    def __init__(self, folder: str, port: int = DEFAULT_PORT) -> None:
        self.folder = Folder(folder)
        program_path()
        self.job: Job | None = None
        self._starting = threading.Lock()
        self._free = threading.BoundedSemaphore(MOST_CONNECTIONS)
        self.pages = threading.BoundedSemaphore(MOST_PAGES)
        super().__init__((ADDRESS, port), Handler)

    def process_request(self, request: Any, client_address: Any) -> None:
        """A thread for a connection, or the end of it when there are too many"""
        if not self._free.acquire(blocking=False):  # pylint: disable=consider-using-with
            return self.shutdown_request(request)
        try:
            super().process_request(request, client_address)
        except RuntimeError:  # the system gives no more threads
            self._free.release()
            self.shutdown_request(request)
        return None

    def process_request_thread(self, request: Any, client_address: Any) -> None:
        try:
            super().process_request_thread(request, client_address)
        finally:
            self._free.release()

    def handle_error(self, request: Any, client_address: Any) -> None:
        """A connection that ended in an unexpected way: one line, and the server goes on"""
        fault = sys.exc_info()[1]
        if not isinstance(fault, (ConnectionError, TimeoutError)):
            print("contact report: a connection failed: %r" % fault, file=sys.stderr)

    def start_job(self, name: str, mode: str) -> bool:
        """Start a run or a check unless one is going on"""
        with self._starting:
            if self.job is not None and not self.job.done:
                return False
            self.job = Job(self.folder, name, mode)
            return True

    def stop_job(self) -> None:
        if self.job is not None:
            self.job.stop()


def serve(folder: str, port: int = DEFAULT_PORT) -> None:
    """Serve a folder until the keyboard, or a signal to this process, ends it"""
    def end(number: int, frame: Any) -> None:
        raise KeyboardInterrupt

    server = Server(folder, port)
    if threading.current_thread() is threading.main_thread():
        for number in (signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, end)
    print("The experiments of %s are at http://%s:%d/ (on this machine only; end with Ctrl-C)"
          % (server.folder.path, ADDRESS, server.server_port), flush=True)
    try:
        server.serve_forever()
    finally:
        server.server_close()
        if server.job is not None:
            server.job.end()
