"""Server with which experiments of a folder are checked, run and viewed in a browser on this machine.

The server listens on the loopback address and refuses requests for another host name and requests from pages of another
origin, so that no other web page can use it. It runs only the program contact, and only on inputs in the folder and its
subfolders; each run is confined to the folder of its input and to the limits of --confine. It writes results, and new inputs
from a form, which never overwrite a file.
The time of a request and the number of open connections are limited.
"""
from __future__ import annotations

import html
import io
import json
import re
import signal
import sys
import threading
import time
import urllib.parse
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from .folder import Folder
from .forms import Refused, form_of, new_input
from .job import Job, program_path
from .page import page_of, resource
from .read import MissingResults

DEFAULT_PORT = 8765
ADDRESS = "127.0.0.1"
# Interval of keep-alive comments in a stream without messages [s]
PATIENCE = 10.0
# Time limits of receiving a request and of sending an answer [s]
REQUEST_TIME, ANSWER_TIME = 10.0, 60.0
# Maximum number of simultaneous connections, and of pages that are generated at the same time
MAX_CONNECTIONS, MAX_PAGES = 64, 2
# Maximum length of the body of a request [bytes]
MAX_BYTES = 65536


class _TimedInput(io.RawIOBase):
    """Input stream of a connection with a deadline for the whole request, so that slow clients cannot occupy it"""

    def __init__(self, connection: Any) -> None:
        self.connection = connection
        self.start()

    def start(self) -> None:
        self.deadline = time.monotonic() + REQUEST_TIME

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: Any) -> int:
        left = self.deadline - time.monotonic()
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
        self.timed_input = _TimedInput(self.connection)
        self.rfile = io.BufferedReader(self.timed_input)

    def handle_one_request(self) -> None:
        self.timed_input.start()
        try:
            super().handle_one_request()
        except (ConnectionError, TimeoutError):
            self.close_connection = True

    def parse_request(self) -> bool:
        """Requests without a version have no headers that tell where they come from, so they are refused"""
        good = super().parse_request()
        if not good or self.request_version != "HTTP/0.9":
            return good
        self.close_connection = True
        self._answer(403, "this server answers requests with a version of HTTP only")
        return False

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
        """Is the request for another host name, or from a page of another origin?"""
        own = ["%s:%d" % (host, self.server.server_port) for host in (ADDRESS, "localhost")]
        hosts, origins = self.headers.get_all("Host", []), self.headers.get_all("Origin", [])
        return (len(hosts) != 1 or hosts[0].lower() not in own
                or any(origin.lower() not in ["http://" + host for host in own] for origin in origins)
                or self.headers.get("Sec-Fetch-Site", "none") not in ("none", "same-origin"))

    def _experiment(self, query: dict[str, list[str]]) -> str | None:
        name = query.get("name", [""])[0]
        return name if self.server.folder.input(name) else None

    def _safely(self, work: Any) -> None:
        """Answer a request; errors are answered too"""
        try:
            if self._is_foreign():
                self.close_connection = True
                return self._answer(403, "this server answers its own pages only")
            try:
                address = urllib.parse.urlsplit(self.path)
                query = urllib.parse.parse_qs(address.query, max_num_fields=8)
            except ValueError:
                return self._answer(400, "the address of the request is invalid")
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
            return self._answer(400, "the length of the request is invalid")
        if int(lengths[0]) > MAX_BYTES:
            self.close_connection = True
            return self._answer(413, "the request is too long")
        body = self.rfile.read(int(lengths[0]))
        return self._safely(lambda path, query: self._do(path, query, body))

    def _show(self, path: str, query: dict[str, list[str]]) -> None:
        if path == "/":
            page = resource("start.html").replace("@FOLDER@", html.escape(self.server.folder.path))
            return self._answer(200, page.replace("@SCRIPT@", resource("start.js")), "text/html")
        if path in ("/files", "/form"):
            folder = query.get("folder", [""])[0]
            if self.server.folder.place(folder) is None:
                return self._answer(404, "there is no such folder")
            return self._answer(200, json.dumps(self._files(folder) if path == "/files" else form_of(self.server.folder, folder)),
                                "application/json")
        if path == "/job":
            return self._answer(200, json.dumps(self.server.job.state() if self.server.job else None), "application/json")
        if path == "/messages":
            return self._stream()
        if path in ("/input", "/result"):
            name = self._experiment(query)
            if name is None:
                return self._answer(404, "there is no such experiment in this folder")
            if path == "/result":
                return self._result(name, query.get("with", [""])[0])
            text = self.server.folder.text(name, query.get("format", ["inp"])[0])
            return self._answer(404, "there is no input of this format") if text is None else self._answer(200, text)
        return self._answer(404, "there is no such page")

    def _files(self, folder: str) -> dict[str, Any]:
        """Folders and experiments of a folder for the start page"""
        return {"folder": folder, "folders": self.server.folder.folders(folder), "files": self.server.folder.list(folder)}

    def _result(self, name: str, other: str) -> None:
        """The page of a result, or of two results for comparison"""
        paths = []
        for one in [name, other] if other else [name]:
            path, changed = self.server.folder.result(one) if self.server.folder.input(one) else ("", None)
            if changed is None:
                return self._answer(404, "there is no result of %s yet" % one)
            paths.append(path)
        try:
            with self.server.pages:
                page = page_of(*paths)
            return self._answer(200, page, "text/html")
        except MissingResults as reason:
            return self._answer(404, str(reason))

    def _do(self, path: str, query: dict[str, list[str]], body: bytes) -> None:
        if path == "/stop":
            self.server.stop_job()
            return self._answer(200, "stopped")
        if path == "/new":
            try:
                return self._answer(200, json.dumps(new_input(self.server.folder, body)), "application/json")
            except Refused as reason:
                return self._answer(422, str(reason))
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
        """All messages of the job and its progress, as server-sent events"""
        job = self.server.job
        self.send_response(200)
        self.send_header("Content-Type", "text/event-stream")
        self.send_header("Cache-Control", "no-store")
        self.send_header("Connection", "close")
        self.end_headers()
        self.close_connection = True
        sent, reported = 0, None
        try:
            while job is not None:
                news, progress, done = job.follow(sent, PATIENCE)
                if not news and progress == reported:
                    self.wfile.write(b": still at work\n\n")
                for kind, value in news[:-1] if done else news:
                    self._event(kind, value)
                if progress != reported:
                    self._event("progress", progress)
                if done:
                    return self._event(*news[-1])
                self.wfile.flush()
                sent, reported = sent + len(news), progress
        except (ConnectionError, TimeoutError):
            pass

    def _event(self, kind: str, value: Any) -> None:
        self.wfile.write(("event: %s\ndata: %s\n\n" % (kind, json.dumps(value))).encode("utf-8"))


class Server(ThreadingHTTPServer):
    daemon_threads = True
    request_queue_size = MAX_CONNECTIONS

    def __init__(self, folder: str, port: int = DEFAULT_PORT) -> None:
        self.folder = Folder(folder)
        program_path()
        self.job: Job | None = None
        self._starting = threading.Lock()
        self._free = threading.BoundedSemaphore(MAX_CONNECTIONS)
        self.pages = threading.BoundedSemaphore(MAX_PAGES)
        super().__init__((ADDRESS, port), Handler)

    def process_request(self, request: Any, client_address: Any) -> None:
        """Start a thread for a connection, or close it if there are too many"""
        if not self._free.acquire(blocking=False):  # pylint: disable=consider-using-with
            return self.shutdown_request(request)
        try:
            super().process_request(request, client_address)
        except RuntimeError:  # the system cannot start another thread
            self._free.release()
            self.shutdown_request(request)
        return None

    def process_request_thread(self, request: Any, client_address: Any) -> None:
        try:
            super().process_request_thread(request, client_address)
        finally:
            self._free.release()

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Report a failed connection in one line; the server continues"""
        fault = sys.exc_info()[1]
        if not isinstance(fault, (ConnectionError, TimeoutError)):
            print("contact report: a connection failed: %r" % fault, file=sys.stderr)

    def start_job(self, name: str, mode: str) -> bool:
        """Start a run or a check unless a job is running"""
        with self._starting:
            if self.job is not None and not self.job.done:
                return False
            path = self.folder.input(name)
            if path is None:
                raise MissingResults("the input of %s no longer exists" % name)
            self.job = Job(name, path, mode)
            return True

    def stop_job(self) -> None:
        if self.job is not None:
            self.job.stop()


def serve(folder: str, port: int = DEFAULT_PORT) -> None:
    """Serve a folder until Ctrl-C or a signal"""
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
