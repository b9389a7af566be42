"""Bakes, their files and what asks them: embedding_cli_test.py PROGRAM."""

import csv
import json
import math
import os
import random
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = sys.argv[1]
SHAPE = "shape:torus:8"


class Embeddings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shared = tempfile.TemporaryDirectory()
        cls.baked = os.path.join(cls.shared.name, "torus.mimicry")
        cls.run_in(cls.shared.name, "bake", SHAPE, "-o", cls.baked, "--samples", "100")

    @classmethod
    def tearDownClass(cls):
        cls.shared.cleanup()

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    @staticmethod
    def run_in(cache, *args, expect=0):
        environment = dict(os.environ, MIMICRY_CACHE=cache)
        done = subprocess.run([PROGRAM, *args], capture_output=True, text=True, timeout=1800,
                              env=environment)
        assert done.returncode == expect, (args, done.returncode, done.stdout, done.stderr)
        return done

    def run_cli(self, *args, expect=0):
        return self.run_in(self.path("cache"), *args, expect=expect)

    def path(self, *names):
        return os.path.join(self.folder.name, *names)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return self.path(name)

    @staticmethod
    def rows(file):
        with open(file, encoding="utf-8", newline="") as text:
            return list(csv.DictReader(text))

    def scp(self, points, *extra, expect=0, embedding=None):
        return self.run_cli("scp", "--embedding", embedding or self.baked, "--points", points,
                            "--out", self.path("q.csv"), *extra, expect=expect)

    # The torus lies around the z axis: ring 0.8, tube 0.32.
    def test_scp_answers_every_point_in_order(self):
        rng = random.Random(5)
        points = []
        for _ in range(3000):
            around, across, r = rng.uniform(0, 7), rng.uniform(0, 7), rng.uniform(0.28, 0.36)
            ring = 0.8 + r * math.cos(across)
            points.append((ring * math.cos(around), ring * math.sin(around), r * math.sin(across)))
        points += [(9, 9, 9), (1e70, 0, 0)]
        text = "id,z,x,y\n" + "".join(f"{i},{p[2]!r},{p[0]!r},{p[1]!r}\n"
                                      for i, p in enumerate(points))
        done = self.scp(self.write("p.csv", text), "--threads", "1", expect=5)
        self.assertIn("line 3003", done.stderr)
        with open(self.path("q.csv"), "rb") as file:
            one = file.read()
        self.assertTrue(one.startswith(b"face,b0,b1,b2,x,y,z,label\n"))
        self.scp(self.path("p.csv"), "--threads", "2", expect=5)
        with open(self.path("q.csv"), "rb") as file:
            self.assertEqual(one, file.read(), "the number of threads does not matter")
        rows = self.rows(self.path("q.csv"))
        self.assertEqual(len(rows), len(points))
        for p, row in zip(points[:3000], rows):
            self.assertEqual(row["label"], "smooth")
            q = [float(row[k]) for k in "xyz"]
            self.assertLess(math.dist(p, q), 0.1, row)
            bary = [float(row[k]) for k in ("b0", "b1", "b2")]
            self.assertAlmostEqual(sum(bary), 1, places=12)
            self.assertGreaterEqual(min(bary), 0)
        self.assertEqual(rows[3000]["label"], "outside-shell")
        self.assertEqual((rows[3001]["label"], rows[3001]["face"], rows[3001]["x"]),
                         ("not-finite", "-1", "nan"))

    def test_scp_reads_what_spreadsheets_write(self):
        want = None
        for text in ("x,y,z\n1.1,0,0.1\n", "\ufeffx,y,z\r\n1.1,0,0.1\r\n\r\n", "x, y, z\n1.1, 0, 0.1",
                     '"x","y","z"\n"1.1","0","0.1"\n\n\n'):
            self.scp(self.write("p.csv", text))
            with open(self.path("q.csv"), encoding="utf-8") as file:
                got = file.read()
            want = want or got
            self.assertEqual(got, want, text)
        self.assertEqual(len(want.splitlines()), 2)
        self.scp(self.write("none.csv", "x,y,z\n"))
        with open(self.path("q.csv"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "face,b0,b1,b2,x,y,z,label\n")
        for bad in ("nan", "inf", "-inf"):
            self.scp(self.write("p.csv", f"x,y,z\n{bad},0,0\n1.1,0,0\n"), expect=5)
            self.assertEqual([r["label"] for r in self.rows(self.path("q.csv"))],
                             ["not-finite", "smooth"])

    def test_scp_refuses_by_file_and_line(self):
        for text, part in (("", "is empty"), ("\n\n", "is empty"),
                           ("x,y\n1,2\n", "the heading has no column 'z'"),
                           ("1,2,3\n", "no column 'x'"),
                           ("x,y,z,x\n1,2,3,4\n", "line 1: two columns are named 'x'"),
                           ("x,y,z\n1,2,3\n1,2\n", "line 3: has 2 fields, the heading has 3"),
                           ("x,y,z\n\n1,2,3,4\n", "line 3: has 4 fields"),
                           ("x,y,z\n1,2,three\n", "line 2: 'three' is not a number, for z"),
                           ("x,y,z\n1,,3\n", "line 2: '' is not a number, for y")):
            done = self.scp(self.write("p.csv", text), expect=3)
            self.assertTrue(done.stderr.startswith("mimicry: p.csv: "), done.stderr)
            self.assertIn(part, done.stderr)
            self.assertFalse(os.path.exists(self.path("q.csv")))
        self.assertIn("none.csv", self.scp(self.path("none.csv"), expect=4).stderr)

    def test_damaged_files_are_refused_by_name(self):
        with open(self.baked, "rb") as file:
            good = file.read()
        points = self.write("p.csv", "x,y,z\n1,0,0\n")
        later = good[:8] + struct.pack("<I", 99) + good[12:]
        flipped = bytearray(good)
        flipped[len(good) // 2] ^= 4
        for content, part in ((b"", "does not begin"), (good[:20], "header"),
                              (good[:len(good) // 2], "bytes"), (good + b"x", "bytes"),
                              (bytes(flipped), "checksum"), (later, "version 99"),
                              (b"solid cube\n" * 9, "does not begin")):
            bad = self.write("bad.mimicry", content)
            for args in (("scp", "--embedding", bad, "--points", points, "-o", self.path("q")),
                         ("quality", bad), ("info", bad)):
                done = self.run_cli(*args, expect=3)
                self.assertTrue(done.stderr.startswith("mimicry: bad.mimicry: "), done.stderr)
                self.assertIn(part, done.stderr)

    def test_embedding_of_another_mesh_is_refused_by_name(self):
        self.run_cli("simulate", "shape:torus:9", "-o", self.path("s.json"), "--rate", "30")
        done = self.run_cli("project", "shape:torus:9", self.path("s.json"), "-t", "mimicry",
                            "--embedding", self.baked, "-o", self.path("o"), expect=3)
        self.assertIn("torus.mimicry: embedding: it is of another mesh", done.stderr)
        self.assertFalse(os.path.exists(self.path("o")))

    def test_mimicry_files_stand_for_their_mesh(self):
        by_shape = json.loads(self.run_cli("info", SHAPE, "--json").stdout)
        by_file = json.loads(self.run_cli("info", self.baked, "--json").stdout)
        by_shape["name"] = by_file["name"]
        self.assertEqual(by_shape, by_file)

    def test_quality_as_text_csv_and_json(self):
        # Named as the paper's cube, which it is not.
        self.run_cli("shapes", "cube", "--resolution", "6", "--out", self.path("cube.obj"))
        inputs = (self.path("cube.obj"), self.baked, "shape:sphere:4")
        rows = json.loads(self.run_cli("quality", *inputs, "--json").stdout)
        again = json.loads(self.run_cli("quality", *inputs, "--json", "--threads", "1").stdout)
        self.assertEqual([r.pop("from_cache") for r in rows], [False, False, False])
        self.assertEqual([r.pop("from_cache") for r in again], [True, False, True])
        self.assertEqual(rows, again)
        self.assertEqual([r["mesh"] for r in rows], ["cube.obj", "torus.mimicry", "shape:sphere:4"])
        self.assertEqual(rows[0]["paper"]["sliver_percent"], 17.44)
        self.assertEqual(rows[1]["paper"]["tetrahedra"], "58K")
        self.assertIsNone(rows[2]["paper"])
        for row in rows:
            self.assertEqual(row["queries"] + row["beyond_queries"], 4 * row["tetrahedra"])
            self.assertLess(row["fail_percent"], 2)  # coarse meshes
            self.assertLess(row["surface_misses"], 4)
        table = list(csv.DictReader(self.run_cli("quality", *inputs, "--csv").stdout.splitlines()))
        for row, line in zip(rows, table):
            for key in ("sliver_percent", "fail_percent", "stress", "surface_error"):
                self.assertEqual(float(line[key]), row[key])
        self.assertEqual(table[2]["paper_fail_percent"], "")
        text = self.run_cli("quality", *inputs).stdout
        self.assertIn("17.44", text)
        self.run_cli("quality", expect=2)
        self.run_cli("quality", SHAPE, "--csv", "--json", expect=2)
        self.run_cli("quality", self.path("none.obj"), expect=4)
        partly = self.run_cli("quality", self.path("none.obj"), SHAPE, "shape:moebius:8", "--json", expect=5)
        self.assertEqual([row["mesh"] for row in json.loads(partly.stdout)],
                         [SHAPE, "shape:moebius:8"])
        self.assertIn("left out: " + self.path("none.obj"), partly.stderr)

    @staticmethod
    def text_file(vertices, elements):
        lines = [str(len(vertices)), str(len(elements))]
        for p in vertices:
            lines.append(" ".join(repr(float(x)) for x in p))
            lines.append(" ".join(repr(float(x)) for x in (*p, 0, 0, 0, 0, 0)))
        lines += [" ".join(map(str, e)) for e in elements]
        return "\n".join(lines) + "\n"

    def octahedron(self):
        inner = [(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
        faces = [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4), (1, 0, 5), (2, 1, 5), (3, 2, 5),
                 (0, 3, 5)]
        outer = [(1.2 * x, 1.2 * y, 1.2 * z) for x, y, z in inner]
        # Prisms over the faces, three tetrahedra each; their orientations are mixed.
        tets = []
        for f in faces:
            a, b, c = sorted(f)
            tets += [(a, b, c, c + 6), (a, b, c + 6, b + 6), (a, a + 6, b + 6, c + 6)]
        return inner, faces, inner + outer, tets

    def test_import_of_text_embeddings(self):
        inner, faces, all_vertices, tets = self.octahedron()
        tri = self.write("tri.txt", self.text_file(inner, faces))
        obj = self.write("octahedron.obj",
                         "".join("v %r %r %r\n" % tuple(map(float, p)) for p in inner) +
                         "".join("f %d %d %d\n" % tuple(v + 1 for v in f) for f in faces))
        renumbered = [all_vertices[11 - i] for i in range(12)]
        points = self.write("p.csv", "x,y,z\n0.4,0.4,0.4\n1,0,0\n-0.5,0.1,-0.6\n3,3,3\n")
        answers = []
        for name, vertices, elements in (
                ("same.txt", all_vertices, tets),
                ("other.txt", renumbered, [tuple(11 - v for v in t) for t in tets])):
            tet = self.write(name, self.text_file(vertices, elements).replace("\n", "\r\n"))
            baked = self.path("octahedron.mimicry")
            done = self.run_cli("import-embedding", tri, tet, "-o", baked)
            self.assertIn("8 faces", done.stdout)
            self.assertIn("24 tetrahedra", done.stdout)
            self.scp(points, embedding=baked)
            answers.append(self.rows(self.path("q.csv")))
        self.assertEqual(answers[0], answers[1], "the shell's numbering does not matter")
        # The embedding is the object itself: here the smooth closest point of a point of M is it.
        self.assertEqual([r["label"] for r in answers[0]],
                         ["smooth", "smooth", "smooth", "outside-shell"])
        self.assertAlmostEqual(float(answers[0][1]["x"]), 1, places=9)
        row = json.loads(self.run_cli("quality", baked, "--json").stdout)[0]
        self.assertLess(row["surface_error"], 1e-9)
        self.assertIsNone(row["stress"])
        pose = {"orientation": [0, 0, 0, 1]}
        self.write("s.json", json.dumps({
            "format": "mimicry-strokes", "version": 1, "convention": "openxr", "strokes": [{
                "id": "s", "target": "octahedron.obj",
                "model_to_world": {"rotation": [0, 0, 0, 1], "translation": [0, 0, 0], "scale": 1},
                "frames": [{"time_s": i, "trigger": 1, "head": {"position": [0, 0, 5], **pose},
                            "controller": {"position": [0.1 + 0.02 * i, 0.2, 1], **pose}}
                           for i in range(9)]}]}))
        self.run_cli("project", obj, self.path("s.json"), "-t", "mimicry", "--embedding", baked,
                     "--formats", "json", "-o", self.path("o"))
        # A text with fewer digits than the mesh: --mesh brings the mesh's own.
        rounded = self.write("rounded.txt", self.text_file(
            [(x * 1.00001, y, z) for x, y, z in inner], faces))
        self.run_cli("import-embedding", rounded, self.path("same.txt"), "-o", baked)
        project = ("project", obj, self.path("s.json"), "-t", "mimicry", "--embedding", baked,
                   "--formats", "json", "-o", self.path("o"))
        self.run_cli(*project, expect=3)
        self.run_cli("import-embedding", rounded, self.path("same.txt"), "--mesh", obj, "-o", baked)
        self.run_cli(*project)
        other = self.run_cli("import-embedding", tri, self.path("same.txt"), "--mesh", "shape:cube",
                             "-o", self.path("none.mimicry"), expect=3)
        self.assertIn("cube: its vertices or faces", other.stderr)
        self.assertFalse(os.path.exists(self.path("none.mimicry")))

    def test_wrong_text_embeddings_are_refused_by_file_and_line(self):
        inner, faces, all_vertices, tets = self.octahedron()
        tri_text, tet_text = self.text_file(inner, faces), self.text_file(all_vertices, tets)
        tri, tet = self.write("tri.txt", tri_text), self.write("tet.txt", tet_text)
        lines = tri_text.splitlines()

        def changed(line, text):
            return "\n".join(lines[:line - 1] + [text] + lines[line:]) + "\n"

        for text, part in (
                ("", "line 0: the file ends where the number of vertices"),
                ("6\n", "the number of elements"), ("six\n8\n", "line 1: 'six'"),
                ("-1\n8\n", "line 1: '-1'"), ("100000000\n8\n", "cut short"),
                ("6\n99999\n" + "\n".join(lines[2:]), "cut short"),
                ("\n".join(lines[:9]), "cut short"), ("\n".join(lines[:-1]), "element 7"),
                (tri_text + "0 1 2\n", "line 23: '0 1 2' after the last element"),
                (changed(3, "1 0"), "line 3: 2 numbers where 3 should stand"),
                (changed(3, "1 0 0 0"), "line 3: more than 3 numbers"),
                (changed(4, "1 0 0 0 0 0 0"), "line 4: 7 numbers where 8 should stand"),
                (changed(5, "0 nan 0"), "line 5: 'nan' is not finite"),
                (changed(5, "0 1e31 0"), "line 5: '1e31'"),
                (changed(15, "0 1 6"), "line 15: element 0 refers to vertex 6"),
                (changed(15, "0 1 -1"), "refers to vertex -1"),
                (changed(15, "0 1 x"), "'x' is not a vertex"), (tet_text, "surface's file first")):
            bad = self.write("bad.txt", text)
            done = self.run_cli("import-embedding", bad, tet, "-o", self.path("o.mimicry"), expect=3)
            self.assertTrue(done.stderr.startswith("mimicry: bad.txt: line "), done.stderr)
            self.assertIn(part, done.stderr)
        done = self.run_cli("import-embedding", tri, tri, "-o", self.path("o.mimicry"), expect=3)
        self.assertIn("surface's file first", done.stderr)
        flat = self.write("flat.txt", self.text_file([(0, 0, 0)] * 3, [(0, 1, 2)]))
        done = self.run_cli("import-embedding", flat, tet, "-o", self.path("o.mimicry"), expect=3)
        self.assertIn("flat.txt: ", done.stderr)
        self.assertFalse(os.path.exists(self.path("o.mimicry")))

    def test_second_bake_is_remembered_and_the_same(self):
        first = self.run_cli("bake", SHAPE, "-o", self.path("a.mimicry"), "--samples", "90").stdout
        second = self.run_cli("bake", SHAPE, "-o", self.path("b.mimicry"), "--samples", "90").stdout
        self.assertNotIn("earlier bake", first)
        self.assertIn("earlier bake", second)
        anew = self.run_cli("bake", SHAPE, "-o", self.path("c.mimicry"), "--samples", "90",
                            "--no-cache").stdout
        self.assertNotIn("earlier bake", anew)
        contents = []
        for name in "abc":
            with open(self.path(name + ".mimicry"), "rb") as file:
                contents.append(file.read())
        self.assertEqual(contents[0], contents[1])
        self.assertEqual(contents[0], contents[2])
        # Other options and meshes are other bakes.
        self.assertNotIn("earlier", self.run_cli("bake", SHAPE, "-o", self.path("d"), "--samples",
                                                 "91").stdout)
        self.assertNotIn("earlier", self.run_cli("bake", "shape:torus:9", "-o", self.path("d"),
                                                 "--samples", "90").stdout)
        self.assertEqual(len(os.listdir(self.path("cache"))), 3)

    def test_damaged_cache_is_made_good(self):
        def bake():
            return self.run_cli("bake", SHAPE, "-o", self.path("a.mimicry"), "--samples", "90")

        bake()
        [kept] = os.listdir(self.path("cache"))
        kept = self.path("cache", kept)
        with open(kept, "rb") as file:
            good = file.read()
        for bad in (b"", good[:1000], good[:-1] + b"\xff", b"x" * 4000):
            with open(kept, "wb") as file:
                file.write(bad)
            self.assertNotIn("earlier", bake().stdout)
            with open(kept, "rb") as file:
                self.assertEqual(file.read(), good)
        self.assertIn("earlier", bake().stdout)
        # Where nothing can be kept the work is done all the same.
        blocked = self.write("file", "")
        done = self.run_in(os.path.join(blocked, "cache"), "bake", SHAPE, "-o", self.path("e"),
                           "--samples", "90")
        self.assertIn("is not kept", done.stderr)
        self.assertEqual(self.run_in("", "bake", SHAPE, "-o", self.path("e"), "--samples",
                                     "90").stderr, "")

    def test_programs_may_share_the_cache(self):
        environment = dict(os.environ, MIMICRY_CACHE=self.path("cache"))
        together = [subprocess.Popen([PROGRAM, "bake", SHAPE, "-o", self.path(f"{i}.mimicry"),
                                      "--samples", "90"], env=environment,
                                     stdout=subprocess.DEVNULL) for i in range(4)]
        self.assertEqual([p.wait(1800) for p in together], [0] * 4)
        self.assertEqual(len(os.listdir(self.path("cache"))), 1)
        self.assertIn("earlier", self.run_cli("bake", SHAPE, "-o", self.path("a"), "--samples",
                                              "90").stdout)

    def test_a_bake_with_seams_says_so_where_it_is_the_mesh(self):
        corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        soup = self.write("soup.obj", "".join("v %d %d %d\n" % corners[c] for f in faces for c in f) +
                          "".join(f"f {3 * f + 1} {3 * f + 2} {3 * f + 3}\n" for f in range(4)))
        for options, said in (["--no-join"], True), ([], False):
            baked = self.path("soup.mimicry")
            self.run_cli("bake", soup, "-o", baked, "--samples", "10", "--offset", "0.4", *options)
            for command in (["info", baked], ["render", baked, "--width", "16", "--height", "16", "-o",
                                              self.path("p.png")]):
                told = self.run_cli(*command).stderr
                self.assertEqual("soup.mimicry: 6 seam edges are not joined" in told, said, told)

    def wait_until_caught(self, process, number):
        """Before the program has begun, a signal ends it in the system's own way."""
        for _ in range(6000):
            with open(f"/proc/{process.pid}/status", encoding="ascii") as status:
                caught = next(line for line in status if line.startswith("SigCgt"))
            if int(caught.split()[1], 16) >> (number - 1) & 1:
                return
            time.sleep(0.1)
        self.fail("the program does not catch the signal")

    def test_interrupted_bake_leaves_nothing_behind(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            environment = dict(os.environ, MIMICRY_CACHE=self.path("cache"))
            bake = subprocess.Popen([PROGRAM, "bake", "shape:torus:80", "-o",
                                     self.path("big.mimicry")], env=environment,
                                    stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            self.wait_until_caught(bake, number)
            time.sleep(0.3)
            bake.send_signal(number)
            bake.communicate(timeout=1800)
            self.assertEqual(bake.returncode, 130)
            self.assertEqual(os.listdir(self.folder.name), [])


unittest.main(argv=["embedding_cli_test"], verbosity=2)
