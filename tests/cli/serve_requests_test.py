#!/usr/bin/env python3
"""`mimicry serve`: requests as the protocol allows and forbids them, and from whom. usage: serve_requests_test.py MIMICRY"""
import random
import socket
import tempfile
import unittest

from served import SCRIPT, Case, Served, post

GET = b"GET / HTTP/1.1\r\nHost: localhost\r\n"
END = b"Connection: close\r\n\r\n"


class ServeRequests(Case):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.server = Served(cls.folder.name, "--name", "studio.example")
        cls.addClassCleanup(cls.server.__exit__)

    def tearDown(self):
        self.assert_alive(self.server)

    def assert_answer(self, expected, *parts):
        status, answer = self.server.raw(*parts)
        self.assertIn(status, expected if isinstance(expected, list) else [expected], (parts[0][:200], answer[:300]))
        return answer

    def test_requests_that_are_not_well_formed(self):
        bake = b"POST /api/bake?name=a.obj HTTP/1.1\r\nHost: localhost\r\n"
        for request in [
                b"nonsense\r\n\r\n", b"GET\r\n\r\n", b"GET / HTTP/9.9\r\nHost: localhost\r\n\r\n", b"\x16\x03\x01\x02\x00\x01\x00\r\n\r\n",
                b"GET / HTTP/1.1\r\n\r\n", b"GET / HTTP/1.0\r\n\r\n", b"GET none HTTP/1.1\r\nHost: localhost\r\n\r\n",
                GET + b"Host: localhost\r\n\r\n", b"GET / HTTP/1.1\r\nHost: \r\n\r\n", b"GET / HTTP/1.1\r\nHost: localhost:x\r\n\r\n",
                GET + b"No colon\r\n\r\n", GET + b"Bad name: x\r\n\r\n", GET + b"X: a\0b\r\n\r\n", GET + b" : x\r\n\r\n",
                b"GET /%zz HTTP/1.1\r\nHost: localhost\r\n\r\n", b"GET /% HTTP/1.1\r\nHost: localhost\r\n\r\n", b"GET /a%00b HTTP/1.1\r\nHost: localhost\r\n\r\n",
                b"GET /?a=%g1 HTTP/1.1\r\nHost: localhost\r\n\r\n", b"GET /a\0b HTTP/1.1\r\nHost: localhost\r\n\r\n",
                bake + b"Content-Length: x\r\n\r\n", bake + b"Content-Length: -1\r\n\r\n", bake + b"Content-Length: 99999999999999999999999\r\n\r\n",
                bake + b"Transfer-Encoding: chunked\r\n\r\nzz\r\n", bake + b"Transfer-Encoding: chunked\r\n\r\n5\r\nabc",
                bake + b"Content-Length: 100\r\n\r\nv 0 0 0\n"]:
            with self.subTest(request=request):
                with socket.create_connection(("127.0.0.1", self.server.port), timeout=300) as s:
                    s.sendall(request)
                    s.shutdown(socket.SHUT_WR)
                    answer = b""
                    while part := s.recv(65536):
                        answer += part
                # A request that is cut short may be answered by closing.
                self.assertIn(answer[:12], [b"HTTP/1.1 400", b""], answer[:300])
                if request.endswith(b"\r\n\r\n") and b"chunked" not in request:
                    self.assertNotEqual(answer, b"")

    def test_a_length_that_can_be_understood_in_two_ways(self):
        for headers in [b"Content-Length: 5\r\nTransfer-Encoding: chunked\r\n", b"Transfer-Encoding: chunked\r\nContent-Length: 5\r\n",
                        b"Content-Length: 5\r\nContent-Length: 6\r\n", b"Content-Length: 5\r\nContent-Length: 5\r\n", b"Content-Length: 5, 6\r\n",
                        b"Content-Length: +5\r\n", b"Content-Length: 0x5\r\n", b"Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n",
                        b"Transfer-Encoding: chunked, identity\r\n", b"Transfer-Encoding: xchunked\r\n", b"Transfer-Encoding : chunked\r\n",
                        b"Transfer-Encoding: identity\r\nContent-Length: 5\r\n"]:
            with self.subTest(headers=headers):
                answer = self.assert_answer([400, 501], b"POST /api/bake?name=a.obj HTTP/1.1\r\nHost: localhost\r\n" + headers +
                                            b"\r\n0\r\n\r\nGET /smuggled HTTP/1.1\r\nHost: localhost\r\n\r\n")
                # What follows is no request.
                self.assertEqual(answer.count(b"HTTP/1.1"), 1)
        self.assert_answer(400, b"POST /api/bake HTTP/1.0\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n")

    def test_heads_that_are_too_large(self):
        self.assert_answer(431, GET + b"X: " + b"a" * 100_000 + b"\r\n\r\n")
        self.assert_answer(431, GET + b"".join(b"X%d: y\r\n" % n for n in range(100_000)) + b"\r\n")
        self.assert_answer(431, GET + b"A: b\r\n" * 200 + b"\r\n")
        self.assert_answer(200, GET + b"A: b\r\n" * 50 + END)
        self.assert_answer(431, b"GET /" + b"a" * 1_000_000)
        self.assert_answer(414, b"GET /" + b"a" * 8000 + b" HTTP/1.1\r\nHost: localhost\r\n\r\n")

    def test_hosts(self):
        port = self.server.port
        for host in [f"127.0.0.1:{port}", "127.0.0.1", f"localhost:{port}", "LOCALHOST", "localhost.", "localhost:9", "studio.example", "Studio.Example:443"]:
            self.assert_answer(200, f"GET / HTTP/1.1\r\nHost: {host}\r\n".encode() + END)
        for host in ["evil.example", f"evil.example:{port}", "127.0.0.1.evil.example", "localhost.evil.example", "10.9.8.7", "0.0.0.0", "[::1]",
                     "a.studio.example", "evil.example#localhost", "\x80\xff"]:
            self.assert_answer([400, 421], f"GET / HTTP/1.1\r\nHost: {host}\r\n".encode("latin-1") + END)
        self.assert_answer(421, b"GET http://evil.example/ HTTP/1.1\r\nHost: localhost\r\n" + END)
        self.assert_answer(421, b"GET http://localhost/ HTTP/1.1\r\nHost: evil.example\r\n" + END)
        self.assert_answer(200, b"GET http://localhost/ HTTP/1.1\r\nHost: localhost\r\n" + END)
        self.assert_answer(400, b"GET http:///x HTTP/1.1\r\nHost: localhost\r\n" + END)
        answer = self.assert_answer(421, b"POST /api/bake HTTP/1.1\r\nHost: evil.example\r\nContent-Length: 1\r\n\r\nv")
        self.assertIn(b"--name evil.example", answer)

    def test_pages_of_other_sites(self):
        own = f"localhost:{self.server.port}"
        body = b"v 0 0 x"
        for origin, site, expected in [
                (f"http://{own}", None, 422), (None, None, 422), (f"http://{own}", "same-origin", 422), (None, "none", 422),
                ("https://elsewhere.example", None, 403), ("null", None, 403), (f"http://{own}.evil.example", None, 403),
                ("http://localhost:1", None, 403), (None, "cross-site", 403), (f"http://{own}", "cross-site", 403), (None, "same-site", 403)]:
            headers = {name: value for name, value in [("Origin", origin), ("Sec_Fetch_Site", site)] if value}
            self.assertEqual(self.server.ask("POST", "/api/bake?name=a.obj", body, Host=own, **headers)[0], expected, (origin, site))
        self.assertEqual(self.server.ask("OPTIONS", "/api/bake", Host=own, Origin="https://elsewhere.example", Access_Control_Request_Method="POST")[0], 403)

    def test_forms_are_not_taken(self):
        for body in [b"--x\r\nContent-Disposition: form-data; name=a\r\n\r\nv 0 0 0\r\n--x--\r\n", b"--x", b"--x\r\nContent-Dispo", b"", b"\r\n\r\n--x--x--\0"]:
            for boundary in ["; boundary=x", "", "; boundary=", '; boundary="', "; boundary=" + "y" * 1000]:
                status, _, _ = self.server.bake("a.obj", body, Content_Type="multipart/form-data" + boundary)
                self.assertEqual(status, 400, (body, boundary))
        for kind in ["Multipart/Form-Data; boundary=x", "application/x-www-form-urlencoded", "APPLICATION/X-WWW-FORM-URLENCODED; charset=utf-8"]:
            self.assertEqual(self.server.bake("a.obj", b"v=0", Content_Type=kind)[0], 400, kind)

    def test_methods(self):
        for method, path, expected in [("POST", "/", 405), ("PUT", "/index.html", 405), ("DELETE", "/api/bake", 405), ("GET", "/api/bake", 405),
                                       ("POST", "/api/status", 405), ("OPTIONS", "/", 405), ("TRACE", "/", 405), ("BREW", "/", [400, 405]),
                                       ("HEAD", "/api/status", 200), ("GET", "/api/none", 404)]:
            self.assert_answer(expected, f"{method} {path} HTTP/1.1\r\nHost: localhost\r\n".encode() + END)
        # Content where none is taken.
        self.assert_answer(413, b"GET /api/status HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5\r\n\r\nhello")

    def test_one_connection_many_requests(self):
        connection = self.server.connect()
        for _ in range(20):
            connection.request("GET", "/assets/main-3c4d.js")
            self.assertEqual(connection.getresponse().read(), SCRIPT)
        connection.close()
        # Sent all at once, answered in order.
        answer = self.assert_answer(200, b"".join(b"GET /none%d HTTP/1.1\r\nHost: localhost\r\n\r\n" % n if n else GET + b"\r\n" for n in range(50)) + GET + END)
        self.assertEqual(answer.count(b"HTTP/1.1 200"), 2)
        places = [answer.index(b"/none%d:" % n) for n in range(1, 50)]
        self.assertEqual(places, sorted(places))
        # After content, too; the smaller half of the next request comes with it.
        self.assert_answer(422, post("/api/bake?name=a.obj", b"v 0 0 x"), GET)
        answer = self.assert_answer(200, b"GET / HTTP/1.0\r\nHost: localhost\r\n\r\n")
        self.assertIn(b"Connection: close", answer)

    def test_content_in_chunks_and_after_asking(self):
        head = b"POST /api/bake?name=a.obj HTTP/1.1\r\nHost: localhost\r\n"
        self.assertIn(b"a.obj: line 1", self.assert_answer(422, head + b"Transfer-Encoding: chunked\r\n\r\n4\r\nv 0 \r\n4;x=y\r\n0 x\n\r\n0\r\n\r\n"))
        with self.server.socket() as s:
            s.sendall(head + b"Content-Length: 8\r\nExpect: 100-continue\r\n\r\n")
            self.assertEqual(s.recv(1000), b"HTTP/1.1 100 Continue\r\n\r\n")
            s.sendall(b"v 0 0 x\n")
            self.assertTrue(s.recv(1000).startswith(b"HTTP/1.1 422"))
        self.assert_answer(413, head + b"Content-Length: 999999999999\r\nExpect: 100-continue\r\n\r\n")
        self.assert_answer(417, head + b"Content-Length: 8\r\nExpect: gold\r\n\r\n")

    def test_ranges_are_not_served(self):
        many = "bytes=" + ",".join("0-" for _ in range(2000))
        for wanted in ["bytes=0-0", many, "bytes=9-1", "bytes=-", "lines=1"]:
            status, headers, body = self.server.ask("GET", "/assets/main-3c4d.js", Range=wanted)
            self.assertEqual((status, body), (200, SCRIPT))

    def test_mutated_requests(self):
        seed = 20240611
        print(f"seed {seed}")
        generator = random.Random(seed)
        seeds = [GET + END, post("/api/bake?name=a.obj", b"v 0 0 x\n", "Connection: close"),
                 b"POST /api/bake?name=%41.obj HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n4\r\nv 0 \r\n0\r\n\r\n"]
        answered = 0
        for _ in range(400):
            request = bytearray(generator.choice(seeds))
            for _ in range(generator.randint(1, 4)):
                at = generator.randrange(len(request))
                kind = generator.randrange(4)
                if kind == 0:
                    request[at] = generator.randrange(256)
                elif kind == 1:
                    del request[at:at + generator.randint(1, 8)]
                elif kind == 2:
                    request[at:at] = generator.choice([b"\r\n", b"\0", b" ", b":", b"%", b"\xff\xfe", b"0" * 20, b"Host: x\r\n"])
                else:
                    request[at:at] = request[at:at + generator.randint(1, 40)]
            with self.server.socket() as s:
                s.sendall(bytes(request))
                s.shutdown(socket.SHUT_WR)
                answer = b""
                try:
                    while part := s.recv(65536):
                        answer += part
                except ConnectionError:
                    pass
            answered += answer != b""
            self.assertNotIn(answer[:12], [b"HTTP/1.1 500"], bytes(request))
        self.assertGreater(answered, 200)


if __name__ == "__main__":
    unittest.main()
