"""The program for Windows, under wine: windows_cli_test.py PROGRAM WINE... Names in UTF-8, line ends, what
is left out of this build, exit codes, files that are in use."""

import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM, *WINE = sys.argv[1:]
# wine hands its own locale's names on; paths must not lose a character on their way to the program.
ENVIRONMENT = {**os.environ, "LC_ALL": "C.UTF-8"}


class Windows(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.environment = {**ENVIRONMENT, "MIMICRY_CACHE": self.path("caché 曲")}

    def path(self, *names):
        return os.path.join(self.folder.name, *names)

    def run_it(self, *args, expect=0):
        done = subprocess.run([*WINE, PROGRAM, *args], capture_output=True, timeout=900,
                              cwd=self.folder.name, env=self.environment)
        self.assertEqual(done.returncode, expect, (args, done.stdout, done.stderr))
        return done.stdout.decode("utf-8"), done.stderr.decode("utf-8")

    def test_a_stroke_is_drawn_and_named_in_any_script(self):
        os.mkdir(self.path("Übung 曲線"))
        mesh, strokes = "Übung 曲線/rücken.obj", "Übung 曲線/strokes 🖌.json"
        self.run_it("shapes", "torus", "--resolution", "24", "--out", mesh)
        self.run_it("simulate", mesh, "--count", "2", "--shape", "torus", "--out", strokes)
        out, _ = self.run_it("project", mesh, strokes, "-t", "spraycan,snap", "--formats",
                             "json,ply,csv", "--out", "aus/gabe ø")
        self.assertIn("aus/gabe ø", out.replace("\\", "/"))
        self.assertNotIn("\r", out)
        with open(self.path("aus/gabe ø/curves.json"), "rb") as file:
            text = file.read()
        self.assertNotIn(b"\r", text)
        self.assertEqual({c["technique"] for c in json.loads(text)["curves"]}, {"spraycan", "snap"})
        self.assertEqual([name for name in os.listdir(self.path("aus/gabe ø"))
                          if name.endswith((".part", ".lock"))], [])
        told = json.loads(self.run_it("info", mesh, "--json")[0])
        self.assertEqual(told["name"], "rücken.obj")
        # Once more over what is there.
        self.run_it("project", mesh, strokes, "-t", "spraycan", "--formats", "json", "--out", "aus/gabe ø")
        with open(self.path("aus/gabe ø/curves.json"), "rb") as file:
            self.assertLess(len(file.read()), len(text))

    def test_what_is_not_in_this_build_says_so(self):
        for command in ("render", "report", "serve"):
            for extra in ((), ("--port", "1", "x")):
                _, error = self.run_it(command, *extra, expect=2)
                self.assertRegex(error, f"^{command}: is not in this build.*MIMICRY_")
        self.assertIn("not in this build", self.run_it("--help")[0])

    def test_errors_name_the_file(self):
        _, error = self.run_it("info", "nirgends ø.obj", expect=4)
        self.assertRegex(error, "nirgends ø.obj: cannot be opened: ")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
