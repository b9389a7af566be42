"""Names that are not UTF-8: names_test.py PROGRAM. They work, or an error names them; what is written for
other programs is valid UTF-8, with U+FFFD in place of what is not."""

import json
import os
import subprocess
import sys
import unittest

from program import PROGRAM, Folder, run

BAD = b"h\xff\xfe\x80"


class Names(Folder):
    def path_of(self, name):
        return os.path.join(self.folder.name.encode(), name)

    def raw(self, *args, expect=0):
        """A run whose output must be valid UTF-8."""
        done = subprocess.run([PROGRAM, *args], capture_output=True, timeout=1800)
        self.assertEqual(done.returncode, expect, (args, done.stdout, done.stderr))
        return done.stdout, done.stderr.decode("utf-8")

    def test_files(self):
        mesh, strokes, out = (self.path_of(BAD + end) for end in (b".obj", b".json", b""))
        self.raw("shapes", "torus", "--resolution", "24", "--out", mesh)
        told = json.loads(self.raw("info", mesh, "--json")[0].decode("utf-8"))
        self.assertIn("h\ufffd", json.dumps(told, ensure_ascii=False))
        self.raw("simulate", mesh, "--shape", "torus", "--rate", "20", "--out", strokes)
        with open(strokes, "rb") as file:
            self.assertIn("h\ufffd", json.load(file)["strokes"][0]["target"])
        table = json.loads(self.raw("project", mesh, strokes, "-t", "spraycan", "--json", "--out",
                                    out)[0].decode("utf-8"))
        self.assertEqual(len(table["files"]), 5)
        for name in ("curves.json", "curves.glb"):
            self.assertTrue(os.path.exists(os.path.join(out, name.encode())))
        with open(os.path.join(out, b"curves.json"), "rb") as file:
            json.load(file)
        with open(os.path.join(out, b"curves.obj"), encoding="utf-8") as file:
            self.assertIn("h\ufffd", file.readline())
        self.raw("render", mesh, "--curves", os.path.join(out, b"curves.json"), "--side-by-side",
                 "--width", "60", "--height", "50", "--out", self.path_of(BAD + b".png"))
        self.raw("bake", mesh, "--samples", "40", "--out", self.path_of(BAD + b".mimicry"))
        rows = json.loads(self.raw("quality", self.path_of(BAD + b".mimicry"), "--json")[0]
                          .decode("utf-8"))
        self.assertIn("h\ufffd", rows[0]["mesh"])
        self.raw("geodesic", mesh, "--from", "v0", "--to", "v9", "--out", self.path_of(BAD + b"p"))

    def test_strokes_and_people(self):
        """Through replay and report, whose settings and tables have the names in them."""
        strokes = self.path_of(BAD + b".json")
        self.raw("simulate", "shape:torus:24", "--rate", "20", "--out", strokes)
        people = self.path_of(b"p" + BAD)
        os.mkdir(people)
        out = self.path_of(b"out" + BAD)
        self.raw("replay", "--strokes", strokes, people, "--mesh", "shape:torus:24", "-t",
                 "spraycan,snap", "--out", out, expect=5)
        with open(os.path.join(out, b"rows.jsonl"), encoding="utf-8") as file:
            lines = [json.loads(line) for line in file]
        self.assertIn("h\ufffd", lines[0]["participant"])
        with open(os.path.join(out, b"replay.json"), encoding="utf-8") as file:
            json.load(file)
        with open(os.path.join(out, b"rows.csv"), encoding="utf-8") as file:
            self.assertIn("h\ufffd", file.read())
        # Once more: what is there is recognised.
        self.assertIn("there already",
                      self.raw("replay", "--strokes", strokes, people, "--mesh", "shape:torus:24",
                               "-t", "spraycan,snap", "--out", out, expect=5)[1])
        compared = self.raw("compare", os.path.join(out, b"rows.csv"), "-m", "spraycan,snap",
                            "--json")[0]
        json.loads(compared.decode("utf-8"))
        done = subprocess.run([PROGRAM, "report", out, "--gallery", "1"], capture_output=True,
                              timeout=1800)
        if b"no plots" in done.stderr:
            return
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(os.path.join(out, b"report.html"), encoding="utf-8") as file:
            self.assertIn("</html>", file.read())
        with open(os.path.join(out, b"figures", b"data.json"), encoding="utf-8") as file:
            json.load(file)

    def test_words_of_the_command_line(self):
        for expect, *args in (
                (2, BAD),
                (2, "info", "shape:torus", b"--" + BAD),
                (3, "info", b"shape:" + BAD),
                (4, "info", BAD + b".obj"),
                (2, "bake", "shape:torus", "--samples", BAD, "--out", "a"),
                (3, "simulate", "shape:torus", "--curves", BAD, "--out", self.path("a")),
                (3, "simulate", "shape:torus", "--closed-loop", BAD, "--out", self.path("a")),
                (3, "geodesic", "shape:torus", "--from", BAD, "--out", self.path("a"))):
            _, error = self.raw(*args, expect=expect)
            self.assertNotIn("unexpected", error)
            self.assertTrue(error)
        self.assertEqual(os.listdir(self.folder.name), [])

    def test_names_in_files(self):
        """Bytes that are not UTF-8 inside a file are an error that says where, or are replaced."""
        run("simulate", "shape:torus:24", "--rate", "20", "--out", self.path("s.json"))
        bad = self.read("s.json").replace(b'"torus"', b'"' + BAD + b'"')
        error = self.raw("project", "shape:torus:24", self.write("b.json", bad), "--out",
                         self.path("o"), expect=3)[1]
        self.assertIn("b.json", error)
        obj = b"o " + BAD + b"\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 " + BAD + b"\n"
        error = self.raw("info", self.write("b.obj", obj), expect=3)[1]
        self.assertIn("b.obj", error)
        self.assertNotIn("\x1b", self.raw("info", self.write("c.obj", obj.replace(b"\xff", b"\x1b[")),
                                          expect=3)[1])
        rows = b"method,curve,x,group\n" + b"".join(
            b"%s,%d,%d,%s\n" % (m, i, i * i % 7 + len(m), BAD + b"%d" % (i % 2)) for m in (b"a", b"bb")
            for i in range(20))
        told = self.raw("compare", self.write("rows.csv", rows), "-m", "a,bb", "--measures", "x",
                        "--by", "group", "--json")[0]
        self.assertIn("h\ufffd", json.dumps(json.loads(told.decode("utf-8")), ensure_ascii=False))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
