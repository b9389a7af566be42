#!/usr/bin/env python3
"""`mimicry serve`: bakes, what is kept of them, and their limits. usage: serve_bake_test.py MIMICRY CASES"""
import json
import pathlib
import shutil
import subprocess
import sys
import time
import unittest

from served import Case, Served, post, shape, slow_mesh

CASES = pathlib.Path(sys.argv.pop(1))


class ServeBake(Case):
    def test_bakes_and_keeps_what_it_baked(self):
        mesh = shape(self.work, "sphere", "--resolution", "6")
        with Served(self.work) as server:
            status, headers, body = server.bake("ball.obj", mesh)
            self.assertEqual((status, headers["Content-Type"]), (200, "application/octet-stream"), body[:200])
            self.assertTrue(body.startswith(b"MIMICRY\n"))
            server.wait_for_no_bake()
            kept = list((server.data / "bakes").iterdir())
            self.assertEqual([k.read_bytes() for k in kept], [body])
            self.assertEqual(server.bake("other.obj", mesh)[2], body)
            kept[0].write_bytes(b"damaged")
            self.assertEqual(server.bake("ball.obj", mesh)[2], body)
            # Names are names only.
            for name in ["../../evil.obj", "%2e%2e%2fevil.obj", "--help.obj", "=.obj", "$(touch%20evil).obj"]:
                self.assertEqual(server.bake(name, mesh)[2], body, name)
            server.wait_for_no_bake()
            self.assertEqual([k.name for k in (server.data / "bakes").iterdir()], [kept[0].name])
            self.assertEqual(sorted(p.name for p in server.data.iterdir()), ["bakes"])
            self.assertEqual(sorted(p.name for p in server.work.iterdir()), ["data", "secret.txt", "sphere.obj", "studio"])

    def test_a_bake_that_cannot_be_kept_is_sent(self):
        mesh = shape(self.work, "sphere", "--resolution", "6")
        data = pathlib.Path(self.work) / "data"
        data.mkdir()
        (data / "bakes").write_text("no folder")
        with Served(self.work) as server:
            status, _, body = server.bake("ball.obj", mesh)
            self.assertEqual(status, 200)
            self.assertTrue(body.startswith(b"MIMICRY\n"))
            server.wait_for_no_bake()
        self.assertIn("is not kept", server.errors)

    @unittest.skipUnless(shutil.which("unshare") and subprocess.run(
        ["unshare", "-rm", "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True).returncode == 0, "no disk can be made here")
    def test_a_full_disk_does_not_lose_a_bake(self):
        mesh = shape(self.work, "sphere", "--resolution", "6")
        data = pathlib.Path(self.work) / "data"
        data.mkdir()
        small = ["unshare", "-rm", "sh", "-c", f'mount -t tmpfs -o size=8k none "{data}" && exec "$@"', "sh"]
        with Served(self.work, before=small) as server:
            for _ in range(2):
                status, _, body = server.bake("ball.obj", mesh)
                self.assertEqual(status, 200)
                self.assertTrue(body.startswith(b"MIMICRY\n") and len(body) > 8192)
                server.wait_for_no_bake()
        self.assertEqual(server.errors.count("is not kept"), 2, server.errors)

    def test_refuses_with_a_sentence(self):
        with Served(self.work, "--largest-upload-mb", "0.01") as server:
            self.assertEqual(server.refused("/api/bake?name=notes.txt", b"hello")[0], 422)
            status, sentence = server.refused("/api/bake?name=bad.obj", b"v 0 0 x")
            self.assertEqual(status, 422)
            self.assertIn("bad.obj", sentence)
            self.assertEqual(server.refused("/api/bake?name=a.obj", b"")[0], 422)
            self.assertEqual(server.refused("/api/bake", b"v 0 0 0")[0], 422)
            status, sentence = server.refused("/api/bake?name=a.obj", b"x" * 20000)
            self.assertEqual(status, 413)
            self.assertNotIn("0 MB", sentence.replace("0.", ""))
            status, sentence = server.refused("/api/bake?name=" + "n" * 2000 + ".obj", b"v 0 0 x")
            self.assertIn("line 1", sentence)  # it was read as what its name says
            # Announced: refused before it is sent; chunked: when it has become too much.
            self.assertEqual(server.raw(post("/api/bake?name=a.obj", b"", length=20000))[0], 413)
            chunk = b"4000\r\n" + b"x" * 0x4000 + b"\r\n"
            chunked = b"POST /api/bake?name=a.obj HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n"
            self.assertEqual(server.raw(chunked, chunk)[0], 413)
            self.assert_alive(server)

    def test_a_name_that_is_not_utf_8(self):
        with Served(self.work) as server:
            for name in ["%ff.obj", "%c3%28.ply", "%ed%a0%80.stl", "a%00b.obj", "%1b[31mred.obj", "%0d%0aX-Evil:%201.obj"]:
                status, headers, body = server.bake(name, b"v 0 0 x\n")
                self.assertEqual(status, 422, name)
                sentence = json.loads(body.decode("utf-8"))["error"]
                self.assertNotIn("X-Evil", headers)
                self.assertTrue(all(ord(c) >= 32 for c in sentence), sentence)
            self.assertIn("\ufffd", json.loads(server.bake("%ff.obj", b"v 0 0 x\n")[2])["error"])
            self.assert_alive(server)
        self.assertEqual((server.code, server.errors), (0, ""))

    def test_a_bake_ends_in_time(self):
        mesh = slow_mesh(self.work)
        with Served(self.work, "--longest-bake-s", "0.5") as server:
            status, _, body = server.bake("torus.obj", mesh)
            self.assertEqual(status, 503)
            self.assertIn("longer", json.loads(body)["error"])
            self.assertEqual(server.children(), [])
            self.assert_alive(server)

    def test_faces_are_limited(self):
        mesh = shape(self.work, "sphere", "--resolution", "6")
        with Served(self.work, "--most-faces", "10") as server:
            status, sentence = server.refused("/api/bake?name=a.obj", mesh)
            self.assertEqual(status, 422)
            self.assertIn("more than 10 triangles", sentence)

    @unittest.skipUnless((CASES / "31-instancing-bomb").is_dir(), "no cases here")
    def test_instances_that_multiply(self):
        bomb = (CASES / "31-instancing-bomb" / "amp_mid.gltf").read_bytes()
        with Served(self.work) as server:
            began = time.monotonic()
            status, sentence = server.refused("/api/bake?name=amp_mid.gltf", bomb)
            self.assertEqual(status, 422)
            self.assertRegex(sentence, r"196000000 triangles|more than 2000000 triangles")
            self.assertNotIn("MIMICRY_", sentence)  # nothing that whoever sends it can set
            self.assertLess(time.monotonic() - began, 60)
            self.assertLess(server.memory_mb(), 1000)
            self.assert_alive(server)

    def test_memory_is_limited(self):
        if b"__asan_init" in pathlib.Path(sys.modules["served"].PROGRAM).read_bytes():
            self.skipTest("address space is not limited with the address sanitizer")
        mesh = slow_mesh(self.work)
        with Served(self.work, "--bake-memory-mb", "150") as server:
            status, sentence = server.refused("/api/bake?name=torus.obj", mesh)
            self.assertEqual(status, 507, sentence)
            self.assertIn("150 MB", sentence)
            self.assertIn("--bake-memory-mb", sentence)
            self.assert_alive(server)

    def test_ends_when_its_client_leaves(self):
        mesh = slow_mesh(self.work)
        quick = shape(self.work, "sphere", "--resolution", "6")
        with Served(self.work) as server:
            first, second = server.socket(), server.socket()
            first.sendall(post("/api/bake?name=torus.obj", mesh))
            server.wait_for_bake()
            second.sendall(post("/api/bake?name=torus.obj", mesh))
            server.wait_for_bake(waiting=1)
            second.close()
            first.close()
            server.wait_for_no_bake()
            self.assertEqual(server.children(), [])
            self.assertEqual(server.bake("ball.obj", quick)[0], 200)

    def test_some_wait_and_others_are_refused(self):
        mesh = slow_mesh(self.work)
        with Served(self.work) as server:
            held = []
            for count in range(4):
                held.append(server.socket())
                held[-1].sendall(post("/api/bake?name=torus.obj", mesh))
                server.wait_for_bake(waiting=count)
            status, headers, body = server.bake("a.obj", b"v 0 0 0\n")
            self.assertEqual((status, headers["Retry-After"]), (503, "10"))
            self.assertIn("wait", json.loads(body)["error"])
            for s in held:
                s.close()
            server.wait_for_no_bake()

    def test_the_status_tells_how_far_a_bake_is(self):
        mesh = slow_mesh(self.work)
        with Served(self.work) as server, server.socket() as s:
            s.sendall(post("/api/bake?name=torus.obj", mesh))
            seen = set()
            end = time.monotonic() + 300
            while len(seen) < 2 and time.monotonic() < end:
                if "bake" in (status := server.status()):
                    seen.add((status["bake"]["stage"], status["bake"]["fraction"]))
                time.sleep(0.01)
            self.assertGreaterEqual(len(seen), 2)  # it moves; how often it is asked is the machine's
            self.assertTrue(all(0 <= fraction <= 1 for _, fraction in seen))


if __name__ == "__main__":
    unittest.main()
