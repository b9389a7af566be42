#!/usr/bin/env python3
"""`mimicry serve`: the page and nothing beside it, HTTPS, what it says, how it ends. usage: serve_test.py MIMICRY"""
import gzip
import os
import pathlib
import re
import signal
import socket
import ssl
import subprocess
import threading
import time
import unittest

from served import PROGRAM, SCRIPT, Case, Served, post, slow_mesh


class Serve(Case):
    def test_the_page_and_nothing_beside_it(self):
        with Served(self.work) as server:
            status, headers, body = server.ask("GET", "/")
            self.assertEqual((status, headers["Content-Type"]), (200, "text/html; charset=utf-8"))
            self.assertIn(b"studio", body)
            status, headers, body = server.ask("GET", "/assets/core-1a2b.wasm")
            self.assertEqual((status, headers["Content-Type"], body), (200, "application/wasm", b"\0asm"))
            self.assertIn("immutable", headers["Cache-Control"])
            for path in ["/none", "/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "/assets/../../secret.txt",
                         "/link.txt", "//etc/passwd", "/assets", "/assets/", "/%00", "/index.html%00.txt", "/..\\secret.txt",
                         "/%c0%ae%c0%ae/secret.txt", "/assets/..%5c..%5csecret.txt", "/proc/self/environ"]:
                status, _, body = server.ask("GET", path)
                self.assertIn(status, [400, 404], path)
                self.assertNotIn(b'"secret"', body)
                self.assertNotEqual(body, b"secret", path)
            self.assertTrue(server.status()["bakes"])
            status, headers, _ = server.ask("DELETE", "/index.html")
            self.assertEqual((status, headers["Allow"]), (405, "GET, HEAD"))
            # Of this machine alone.
            with socket.socket() as s, self.assertRaises(OSError):
                s.connect((own_address(), server.port))
        self.assertEqual((server.code, server.errors), (0, ""))

    def test_sends_the_form_that_the_browser_takes(self):
        path = "/assets/main-3c4d.js"
        forms = {"br": b"brotli of it", "gzip": gzip.compress(SCRIPT)}
        assets = pathlib.Path(self.work) / "studio" / "assets"
        assets.mkdir(parents=True)
        for coding, ending in [("br", ".br"), ("gzip", ".gz")]:
            (assets / ("main-3c4d.js" + ending)).write_bytes(forms[coding])
        (assets / "alone.gz").write_bytes(b"no form of anything")
        with Served(self.work) as server:
            tags = set()
            for accepted, coding in [("gzip, deflate, br, zstd", "br"), ("gzip", "gzip"), ("br;q=0, gzip;q=0.5", "gzip"), ("br ; q=1", "br"),
                                     ("identity", None), ("gzip;q=0", None), ("xbr, brx", None), ("", None)]:
                status, headers, body = server.ask("GET", path, Accept_Encoding=accepted)
                self.assertEqual((status, headers.get("Content-Encoding"), body), (200, coding, forms.get(coding, SCRIPT)), accepted)
                self.assertEqual((headers["Vary"], headers["Content-Type"]), ("Accept-Encoding", "text/javascript; charset=utf-8"))
                self.assertIn("immutable", headers["Cache-Control"])
                tags.add(headers["ETag"])
                again = server.ask("GET", path, Accept_Encoding=accepted, If_None_Match=f'"other", {headers["ETag"]}')
                self.assertEqual((again[0], again[2], again[1]["ETag"]), (304, b"", headers["ETag"]))
            # Each form is another thing.
            self.assertEqual(len(tags), 3)
            status, headers, body = server.ask("HEAD", path)
            self.assertEqual((status, int(headers["Content-Length"]), body), (200, len(SCRIPT), b""))
            # A form has no address of its own; a file that only looks like one has.
            self.assertEqual(server.ask("GET", path + ".br")[0], 404)
            self.assertEqual(server.ask("GET", "/assets/alone.gz")[2], b"no form of anything")

    def test_tells_the_browser_what_the_page_may(self):
        with Served(self.work) as server:
            for method, path in [("GET", "/"), ("GET", "/none"), ("GET", "/api/status"), ("POST", "/api/none")]:
                headers = server.ask(method, path)[1]
                policy = headers["Content-Security-Policy"]
                for rule in ["default-src 'none'", "frame-ancestors 'none'", "base-uri 'none'", "form-action 'none'"]:
                    self.assertIn(rule, policy)
                self.assertNotIn("unsafe-inline", policy)
                self.assertNotIn("'unsafe-eval'", policy)
                self.assertEqual((headers["X-Content-Type-Options"], headers["X-Frame-Options"]), ("nosniff", "DENY"))
                self.assertNotIn("Access-Control-Allow-Origin", headers)

    def test_in_the_network_over_https(self):
        with Served(self.work, "--lan") as server:
            self.assertTrue(server.secure)
            self.assertEqual(server.ask("GET", "/")[0], 200)
            self.assertEqual(server.ask("GET", "/", Host=f"{own_address()}:{server.port}")[0], 200)
            kept = server.data / "certificate.pem"
            self.assertEqual(kept.stat().st_mode & 0o777, 0o600)
            # Whoever trusts the certificate can reach it by its address.
            context = ssl.create_default_context(cadata=kept.read_text().split("-----BEGIN PRIVATE")[0])
            with socket.create_connection(("127.0.0.1", server.port)) as raw, context.wrap_socket(raw, server_hostname="127.0.0.1"):
                pass
            old = ssl._create_unverified_context()
            old.maximum_version = ssl.TLSVersion.TLSv1_1
            with socket.create_connection(("127.0.0.1", server.port)) as raw, self.assertRaises(OSError):
                old.wrap_socket(raw)
            # Plain text on the secure port ends that connection and no other.
            with socket.create_connection(("127.0.0.1", server.port), timeout=300) as raw:
                raw.sendall(b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n")
                while raw.recv(4096):
                    pass
            self.assertEqual(server.bake("a.obj", b"v 0 0 x")[0], 422)
            first = kept.read_bytes()
        with Served(self.work, "--lan") as server:
            self.assertEqual((server.data / "certificate.pem").read_bytes(), first)
        with Served(self.work, "--cert", str(pathlib.Path(self.work) / "data" / "certificate.pem")) as server:
            self.assertTrue(server.secure)
        (pathlib.Path(self.work) / "data" / "certificate.pem").write_text("damaged")
        with Served(self.work, "--lan") as server:
            self.assertEqual(server.ask("GET", "/")[0], 200)
            self.assertEqual((server.data / "certificate.pem").stat().st_mode & 0o777, 0o600)

    def test_nobody_else_can_read_the_key_at_any_moment(self):
        seen = set()
        done = threading.Event()
        data = pathlib.Path(self.work) / "data"

        def watch():
            while not done.is_set():
                for file in data.glob("certificate*"):
                    try:
                        seen.add(file.stat().st_mode & 0o077)
                    except OSError:
                        pass
        watcher = threading.Thread(target=watch)
        watcher.start()
        try:
            for _ in range(5):
                with Served(self.work, "--lan", preexec_fn=lambda: os.umask(0)) as server:
                    pass
                (server.data / "certificate.pem").unlink()
        finally:
            done.set()
            watcher.join()
        self.assertEqual(seen, {0})

    def test_says_what_is_wrong(self):
        def fails(*arguments):
            done = subprocess.run([PROGRAM, "serve", *arguments], capture_output=True, text=True, timeout=300)
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
            code, message = fails("--studio", str(server.studio), "--port", "0", "--name", "a:b:c")
            self.assertEqual(code, 3)
            self.assertIn("--name", message)

    def test_ends_soon_whatever_is_under_way(self):
        mesh = slow_mesh(self.work)
        for number in [signal.SIGINT, signal.SIGTERM]:
            server = Served(self.work)
            self.addCleanup(server.stop, signal.SIGKILL)
            idle = [server.socket() for _ in range(20)]
            for half in idle[:10]:
                half.sendall(b"GET / HT")
            idle[10].sendall(post("/api/bake?name=a.obj", b"v 0 0 0\n", length=1000))
            baking = server.socket()
            baking.sendall(post("/api/bake?name=torus.obj", mesh))
            server.wait_for_bake()
            child = server.children()
            self.assertEqual(len(child), 1)
            self.assertLess(server.stop(number), 2.0)  # what is promised
            self.assertEqual((server.code, server.errors), (0, ""))
            answer = baking.recv(65536)
            self.assertIn(b"503", answer[:20])
            self.assertIn(b"stopped", answer)
            self.assertFalse(pathlib.Path(f"/proc/{child[0]}").exists())
            for s in [*idle, baking]:
                s.close()

    def test_ends_soon_with_a_client_that_does_not_read(self):
        assets = pathlib.Path(self.work) / "studio" / "assets"
        assets.mkdir(parents=True)
        (assets / "large.bin").write_bytes(bytes(30_000_000))
        for arguments in [[], ["--lan"]]:
            server = Served(self.work, *arguments)
            self.addCleanup(server.stop, signal.SIGKILL)
            with server.socket() as reader:
                reader.sendall(b"GET /assets/large.bin HTTP/1.1\r\nHost: localhost\r\n\r\n")
                self.assertTrue(reader.recv(1000))
                self.assertLess(server.stop(signal.SIGTERM), 2.0)
                self.assertEqual(server.code, 0)

    def test_ends_soon_while_it_starts(self):
        studio = pathlib.Path(self.work) / "studio"
        studio.mkdir()
        (studio / "index.html").write_text("")
        with (studio / "large.bin").open("wb") as file:
            file.truncate(300 << 20)  # reading it takes about a second
        for pause in [0, 0.02, 0.1, 0.3]:
            process = subprocess.Popen([PROGRAM, "serve", "--port", "0", "--studio", str(studio), "--data", self.work],
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            self.addCleanup(process.kill)
            time.sleep(pause)
            began = time.monotonic()
            process.terminate()
            process.communicate(timeout=300)
            self.assertLess(time.monotonic() - began, 60)
            self.assertIn(process.returncode, [0, 130, -signal.SIGTERM])  # ready, not yet, not even begun

    def test_a_bake_does_not_outlive_a_server_that_is_killed(self):
        mesh = slow_mesh(self.work)
        server = Served(self.work)
        self.addCleanup(server.stop, signal.SIGKILL)
        with server.socket() as baking:
            baking.sendall(post("/api/bake?name=torus.obj", mesh))
            server.wait_for_bake()
            child = server.children()[0]
            server.stop(signal.SIGKILL)
            end = time.monotonic() + 300
            while (state := state_of(child)) not in ["", "Z"] and time.monotonic() < end:
                time.sleep(0.02)
            self.assertIn(state, ["", "Z"])


def state_of(process):
    try:
        return re.search(r"\) (\w)", pathlib.Path(f"/proc/{process}/stat").read_text())[1]
    except OSError:
        return ""


def own_address():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as s:
        try:
            s.connect(("192.0.2.1", 9))
            return s.getsockname()[0]
        except OSError:
            return "127.0.0.2"


if __name__ == "__main__":
    unittest.main()
