"""What the tests of `mimicry serve` share: a server to talk to, over a client or a bare socket. The program is the first argument."""
import http.client
import json
import pathlib
import re
import signal
import socket
import ssl
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = sys.argv.pop(1)
SCRIPT = b"console.log('studio');\n" * 100


class Served:
    """A running server; `data` and `studio` lie in `work`."""

    def __init__(self, work, *arguments, before=(), **options):
        self.work = pathlib.Path(work)
        self.studio = self.work / "studio"
        self.data = self.work / "data"
        (self.studio / "assets").mkdir(parents=True, exist_ok=True)
        (self.studio / "index.html").write_text("<!doctype html><title>studio</title>")
        (self.studio / "assets" / "core-1a2b.wasm").write_bytes(b"\0asm")
        (self.studio / "assets" / "main-3c4d.js").write_bytes(SCRIPT)
        (self.work / "secret.txt").write_text("secret")
        link = self.studio / "link.txt"
        if not link.is_symlink():
            link.symlink_to(self.work / "secret.txt")
        self.process = subprocess.Popen(
            [*before, PROGRAM, "serve", "--port", "0", "--studio", str(self.studio), "--data", str(self.data), *arguments],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)
        line = self.process.stdout.readline()
        found = re.search(r"(https?)://127\.0\.0\.1:(\d+)/", line)
        assert found, (line, self.process.stderr.read())
        self.secure = found[1] == "https"
        self.port = int(found[2])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop(signal.SIGINT)

    def stop(self, number):
        """Seconds until it has ended."""
        began = time.monotonic()
        if self.process.poll() is None:
            self.process.send_signal(number)
        if not self.process.stdout.closed:
            self.rest, self.errors = self.process.communicate(timeout=300)
        self.code = self.process.returncode
        return time.monotonic() - began

    def connect(self):
        if not self.secure:
            return http.client.HTTPConnection("127.0.0.1", self.port, timeout=300)
        return http.client.HTTPSConnection("127.0.0.1", self.port, timeout=300, context=ssl._create_unverified_context())

    def ask(self, method, path, body=None, **headers):
        connection = self.connect()
        try:
            connection.request(method, path, body, {name.replace("_", "-"): value for name, value in headers.items()})
            response = connection.getresponse()
            return response.status, dict(response.getheaders()), response.read()
        finally:
            connection.close()

    def bake(self, name, mesh, **headers):
        return self.ask("POST", f"/api/bake?name={name}", mesh, **headers)

    def refused(self, path, body, **headers):
        status, _, answer = self.ask("POST", path, body, **headers)
        return status, json.loads(answer)["error"]

    def status(self):
        return json.loads(self.ask("GET", "/api/status")[2])

    def wait_for_bake(self, waiting=0):
        """Until a bake runs and so many wait."""
        end = time.monotonic() + 300
        while time.monotonic() < end:
            status = self.status()
            if "bake" in status and status["waiting"] >= waiting:
                return
            time.sleep(0.02)
        raise AssertionError(status)

    def wait_for_no_bake(self):
        end = time.monotonic() + 300
        while time.monotonic() < end:
            if "bake" not in self.status():
                return
            time.sleep(0.02)
        raise AssertionError("a bake goes on")

    def socket(self):
        raw = socket.create_connection(("127.0.0.1", self.port), timeout=300)
        return ssl._create_unverified_context().wrap_socket(raw) if self.secure else raw

    def raw(self, *parts):
        """Status and all that follows of what a bare socket is answered; None where it is closed without an answer."""
        with self.socket() as s:
            try:
                for part in parts:
                    s.sendall(part)
            except OSError:
                pass  # it may be refused before it is all sent
            answer = b""
            try:
                while part := s.recv(65536):
                    answer += part
            except OSError:
                pass
        return (int(answer[9:12]), answer) if answer.startswith(b"HTTP/1.1 ") else (None, answer)

    def memory_mb(self):
        """Resident, the largest so far."""
        text = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(re.search(r"VmHWM:\s+(\d+) kB", text)[1]) / 1000

    def children(self):
        task = pathlib.Path(f"/proc/{self.process.pid}/task")
        return [int(child) for thread in task.iterdir() for child in (thread / "children").read_text().split()]


def shape(work, name, *arguments):
    file = pathlib.Path(work) / f"{name}.obj"
    subprocess.run([PROGRAM, "shapes", name, *arguments, "--out", str(file)], check=True, stdout=subprocess.DEVNULL)
    return file.read_bytes()


def slow_mesh(work):
    """A mesh whose bake takes longer than any test waits for it."""
    return shape(work, "torus", "--resolution", "200")


def post(path, body, *headers, length=None):
    """A request as bytes."""
    lines = [f"POST {path} HTTP/1.1", "Host: localhost", f"Content-Length: {len(body) if length is None else length}", *headers]
    return "\r\n".join(lines).encode() + b"\r\n\r\n" + body


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = folder.name

    def assert_alive(self, server):
        self.assertEqual(server.ask("GET", "/")[0], 200)
