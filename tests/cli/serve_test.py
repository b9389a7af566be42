#!/usr/bin/env python3
"""`mimicry serve`: the page and nothing beside it, HTTPS, bakes with their limits. usage: serve_test.py MIMICRY"""
import gzip
import http.client
import json
import os
import pathlib
import re
import signal
import socket
import ssl
import subprocess
import sys
import tempfile
import threading
import unittest

PROGRAM = sys.argv.pop(1)


class Served:
    """A running server; `data` and `studio` lie in `work`."""

    def __init__(self, work, *arguments):
        self.work = pathlib.Path(work)
        self.studio = self.work / "studio"
        (self.studio / "assets").mkdir(parents=True, exist_ok=True)
        (self.studio / "index.html").write_text("<!doctype html><title>studio</title>")
        (self.studio / "assets" / "core-1a2b.wasm").write_bytes(b"\0asm")
        (self.work / "secret.txt").write_text("secret")
        link = self.studio / "link.txt"
        if not link.is_symlink():
            link.symlink_to(self.work / "secret.txt")
        self.process = subprocess.Popen(
            [PROGRAM, "serve", "--port", "0", "--studio", str(self.studio), "--data", str(self.work / "data"), *arguments],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        found = re.search(r"(https?)://127\.0\.0\.1:(\d+)/", line)
        assert found, (line, self.process.stderr.read())
        self.secure = found[1] == "https"
        self.port = int(found[2])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.send_signal(signal.SIGINT)
        self.code = self.process.wait(timeout=30)
        self.rest = self.process.stdout.read()
        self.errors = self.process.stderr.read()
        self.process.stdout.close()
        self.process.stderr.close()

    def connect(self):
        if not self.secure:
            return http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        return http.client.HTTPSConnection("127.0.0.1", self.port, timeout=60, context=ssl._create_unverified_context())

    def ask(self, method, path, body=None, **headers):
        connection = self.connect()
        try:
            connection.request(method, path, body, headers)
            response = connection.getresponse()
            return response.status, dict(response.getheaders()), response.read()
        finally:
            connection.close()


def shape(work, name, *arguments):
    file = pathlib.Path(work) / f"{name}.obj"
    subprocess.run([PROGRAM, "shapes", name, *arguments, "--out", str(file)], check=True, stdout=subprocess.DEVNULL)
    return file.read_bytes()


class Serve(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = folder.name

    def test_the_page_and_nothing_beside_it(self):
        with Served(self.work) as server:
            status, headers, body = server.ask("GET", "/")
            self.assertEqual((status, headers["Content-Type"]), (200, "text/html; charset=utf-8"))
            self.assertIn(b"studio", body)
            status, headers, body = server.ask("GET", "/assets/core-1a2b.wasm")
            self.assertEqual((status, headers["Content-Type"], body), (200, "application/wasm", b"\0asm"))
            self.assertIn("immutable", headers["Cache-Control"])
            _, headers, body = server.ask("GET", "/assets/core-1a2b.wasm", **{"Accept-Encoding": "gzip, br"})
            self.assertEqual((headers["Content-Encoding"], gzip.decompress(body)), ("gzip", b"\0asm"))
            for path in ["/none", "/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "/assets/../../secret.txt",
                         "/link.txt", "//etc/passwd", "/assets", "/assets/", "/%00", "/index.html%00.txt", "/..\\secret.txt"]:
                status, _, body = server.ask("GET", path)
                self.assertGreaterEqual(status, 400, path)
                self.assertNotIn(b"secret\n", body)
                self.assertNotEqual(body, b"secret", path)
            self.assertTrue(json.loads(server.ask("GET", "/api/status")[2])["bakes"])
            self.assertEqual(server.ask("DELETE", "/index.html")[0], 404)
            # Of this machine alone.
            with socket.socket() as s, self.assertRaises(OSError):
                s.connect((own_address(), server.port))
        self.assertEqual((server.code, server.errors), (0, ""))

    def test_bakes_and_keeps_what_it_baked(self):
        mesh = shape(self.work, "sphere", "--resolution", "6")
        with Served(self.work) as server:
            status, headers, body = server.ask("POST", "/api/bake?name=ball.obj", mesh)
            self.assertEqual((status, headers["Content-Type"]), (200, "application/octet-stream"), body[:200])
            self.assertTrue(body.startswith(b"MIMICRY\n"))
            kept = list((server.work / "data").iterdir())
            self.assertEqual([k.read_bytes() for k in kept], [body])
            self.assertEqual(server.ask("POST", "/api/bake?name=other.obj", mesh)[2], body)
            kept[0].write_bytes(b"damaged")
            self.assertEqual(server.ask("POST", "/api/bake?name=ball.obj", mesh)[2], body)
            (pathlib.Path(self.work) / "baked.mimicry").write_bytes(body)
            # Names are names only.
            server.ask("POST", "/api/bake?name=../../evil.obj", mesh)
            self.assertEqual(sorted(k.name for k in (server.work / "data").iterdir()), [kept[0].name])
            self.assertEqual(sorted(p.name for p in server.work.iterdir()), ["baked.mimicry", "data", "secret.txt", "sphere.obj", "studio"])

    def test_refuses_with_a_sentence(self):
        with Served(self.work, "--largest-upload-mb", "0.01") as server:
            def refused(path, body, **headers):
                status, _, answer = server.ask("POST", path, body, **headers)
                return status, json.loads(answer)["error"]
            self.assertEqual(refused("/api/bake?name=notes.txt", b"hello")[0], 422)
            status, sentence = refused("/api/bake?name=bad.obj", b"v 0 0 x")
            self.assertEqual(status, 422)
            self.assertIn("bad.obj", sentence)
            self.assertEqual(refused("/api/bake?name=a.obj", b"", Origin="https://elsewhere.example")[0], 403)
            self.assertEqual(server.ask("POST", "/api/bake?name=a.obj", b"x" * 20000)[0], 413)
            # It goes on afterwards.
            self.assertEqual(server.ask("GET", "/")[0], 200)

    def test_a_bake_ends_in_time(self):
        mesh = shape(self.work, "sphere")
        with Served(self.work, "--longest-bake-s", "0.001") as server:
            status, _, body = server.ask("POST", "/api/bake?name=a.obj", mesh)
            self.assertEqual(status, 503)
            self.assertIn("longer", json.loads(body)["error"])

    def test_one_bakes_one_waits_others_are_refused(self):
        with Served(self.work) as server:
            # Two uploads that do not end hold both places.
            held = []
            for _ in range(2):
                connection = server.connect()
                connection.putrequest("POST", "/api/bake?name=a.obj")
                connection.putheader("Content-Length", "1000")
                connection.endheaders()
                connection.send(b"v 0 0 0\n")
                held.append(connection)
            threading.Event().wait(0.5)
            status, headers, body = server.ask("POST", "/api/bake?name=a.obj", b"v 0 0 0\n")
            self.assertEqual((status, headers["Retry-After"]), (503, "10"))
            self.assertIn("waits", json.loads(body)["error"])
            for connection in held:
                connection.close()

    def test_in_the_network_over_https(self):
        with Served(self.work, "--lan") as server:
            self.assertTrue(server.secure)
            self.assertEqual(server.ask("GET", "/")[0], 200)
            kept = server.work / "data" / "certificate.pem"
            self.assertEqual(kept.stat().st_mode & 0o777, 0o600)
            # Whoever trusts the certificate can reach it by its address.
            context = ssl.create_default_context(cadata=kept.read_text().split("-----BEGIN PRIVATE")[0])
            with socket.create_connection(("127.0.0.1", server.port)) as raw, context.wrap_socket(raw, server_hostname="127.0.0.1"):
                pass
            first = kept.read_bytes()
        with Served(self.work, "--lan") as server:
            self.assertEqual((server.work / "data" / "certificate.pem").read_bytes(), first)
        with Served(self.work, "--cert", str(pathlib.Path(self.work) / "data" / "certificate.pem")) as server:
            self.assertTrue(server.secure)
        (pathlib.Path(self.work) / "data" / "certificate.pem").write_text("damaged")
        with Served(self.work, "--lan") as server:
            self.assertEqual(server.ask("GET", "/")[0], 200)

    def test_says_what_is_wrong(self):
        def fails(*arguments):
            done = subprocess.run([PROGRAM, "serve", *arguments], capture_output=True, text=True, timeout=30)
            return done.returncode, done.stderr
        code, message = fails("--studio", self.work)
        self.assertEqual(code, 4)
        self.assertIn("--target web_page", message)
        with Served(self.work) as server:
            code, message = fails("--studio", str(server.studio), "--port", str(server.port))
            self.assertEqual(code, 4)
            self.assertIn("--port", message)
            code, message = fails("--studio", str(server.studio), "--cert", str(server.studio / "index.html"))
            self.assertEqual(code, 3)
            self.assertIn("certificate", message)


def own_address():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as s:
        try:
            s.connect(("192.0.2.1", 9))
            return s.getsockname()[0]
        except OSError:
            return "127.0.0.2"


if __name__ == "__main__":
    unittest.main()
