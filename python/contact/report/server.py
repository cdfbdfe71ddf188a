"""Experiments of a folder checked, run and seen in a browser on this machine.

The server listens on the loopback address and refuses requests that carry the name of another host or come from
a page of another origin, so that no web page elsewhere can use it. It runs one program only, contact, and on
nothing but the .inp files that lie in the folder.
"""
from __future__ import annotations

import html
import json
import os
import shutil
import subprocess
import threading
import urllib.parse
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from .page import page_of, resource
from .read import MissingResults

DEFAULT_PORT = 8765
ADDRESS = "127.0.0.1"
# How long a stream of messages waits before it says that it is alive [s]
PATIENCE = 10.0


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

    def list(self) -> list[dict[str, Any]]:
        files = []
        for name in self.names():
            source, result = (os.path.join(self.path, name + suffix) for suffix in (".inp", ".h5"))
            status = os.stat(source)
            fresh = os.path.isfile(result) and os.stat(result).st_mtime >= status.st_mtime
            files.append({"name": name, "size": status.st_size, "changed": status.st_mtime,
                          "result": "fresh" if fresh else "old" if os.path.isfile(result) else "none"})
        return files


class Job:
    """One run of the program; its messages are kept, so that every listener gets all of them"""

    def __init__(self, folder: Folder, name: str, mode: str) -> None:
        self.name, self.mode = name, mode
        self.messages: list[tuple[str, Any]] = []
        self.done = False
        self.news = threading.Condition()
        # the name comes from the list of the folder; after -- it cannot be an option
        command = [program_path(), *(["--hdf5"] if mode == "run" else []), "--", "2" if mode == "run" else "3",
                   os.path.join(folder.path, name)]
        self.process = subprocess.Popen(command, cwd=folder.path, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                        stderr=subprocess.STDOUT)
        threading.Thread(target=self._listen, daemon=True).start()

    def _tell(self, kind: str, value: Any) -> None:
        with self.news:
            self.messages.append((kind, value))
            self.done = kind == "end"
            self.news.notify_all()

    def _listen(self) -> None:
        assert self.process.stdout is not None
        with self.process.stdout as lines:
            for line in lines:
                self._tell("line", line.decode("utf-8", "replace").rstrip("\r\n"))
        self._tell("end", self.process.wait())

    def stop(self) -> None:
        if not self.done:
            self.process.terminate()


class Handler(BaseHTTPRequestHandler):
    server: "Server"
    protocol_version = "HTTP/1.1"
    server_version = "contact-report"
    sys_version = ""

    def log_message(self, form: str, *values: Any) -> None:
        pass

    def _answer(self, status: int, body: str, kind: str = "text/plain") -> None:
        data = body.encode("utf-8")
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

    def do_GET(self) -> None:
        if self._is_foreign():
            return self._answer(403, "this server answers to pages of its own only")
        address = urllib.parse.urlsplit(self.path)
        query = urllib.parse.parse_qs(address.query)
        if address.path == "/":
            page = resource("start.html").replace("@FOLDER@", html.escape(self.server.folder.path))
            return self._answer(200, page, "text/html")
        if address.path == "/files":
            return self._answer(200, json.dumps(self.server.folder.list()), "application/json")
        if address.path == "/messages":
            return self._stream()
        if address.path == "/result":
            name = self._experiment(query)
            if name is None:
                return self._answer(404, "there is no such experiment in this folder")
            try:
                return self._answer(200, page_of(os.path.join(self.server.folder.path, name + ".h5")), "text/html")
            except MissingResults as reason:
                return self._answer(404, str(reason))
        return self._answer(404, "there is no such page")

    def do_POST(self) -> None:
        length = self.headers.get("Content-Length", "0")
        if not length.isdigit() or int(length) > 65536:
            self.close_connection = True
            return self._answer(413, "the request is too long")
        self.rfile.read(int(length))
        if self._is_foreign():
            return self._answer(403, "this server answers to pages of its own only")
        address = urllib.parse.urlsplit(self.path)
        if address.path == "/stop":
            self.server.stop_job()
            return self._answer(200, "stopped")
        if address.path not in ("/run", "/check"):
            return self._answer(404, "there is no such page")
        name = self._experiment(urllib.parse.parse_qs(address.query))
        if name is None:
            return self._answer(404, "there is no such experiment in this folder")
        try:
            started = self.server.start_job(name, address.path[1:])
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
        except (BrokenPipeError, ConnectionResetError):
            pass


class Server(ThreadingHTTPServer):
    daemon_threads = True

    def __init__(self, folder: str, port: int = DEFAULT_PORT) -> None:
        self.folder = Folder(folder)
        program_path()
        self.job: Job | None = None
        self._starting = threading.Lock()
        super().__init__((ADDRESS, port), Handler)

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
    """Serve a folder until the keyboard interrupts"""
    server = Server(folder, port)
    print("The experiments of %s are at http://%s:%d/ (on this machine only; end with Ctrl-C)"
          % (server.folder.path, ADDRESS, server.server_port), flush=True)
    try:
        server.serve_forever()
    finally:
        server.stop_job()
        server.server_close()
