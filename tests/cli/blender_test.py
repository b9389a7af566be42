"""What Blender makes of the curve files: blender_test.py PROGRAM. Skipped where Blender is absent."""

import csv
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv[1]
BLENDER = shutil.which("blender")
READER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "blender_reader.py")
FORMS = {"default": [], "other": ["--obj-lines", "polylines", "--curves-as", "lines"]}


# Blender's Python takes its packages from where the first python3 of PATH lies: the system's has numpy.
SYSTEM = {**os.environ, "PATH": "/usr/local/bin:/usr/bin:/bin"}


def run(*args, env=None):
    done = subprocess.run(args, capture_output=True, text=True, timeout=1800, env=env, check=False)
    assert done.returncode == 0, (args, done.stdout[-3000:], done.stderr[-3000:])


class Blender(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        path = lambda *names: os.path.join(cls.folder.name, *names)
        run(PROGRAM, "simulate", "shape:torus:24", "--rate", "30", "-o", path("strokes.json"))
        for form, options in FORMS.items():
            # Occlude leaves the target behind: its curves have gaps.
            run(PROGRAM, "project", "shape:torus:24", path("strokes.json"), "-t", "occlude,snap",
                "--misses", "split", "--formats", "obj,ply,glb,csv", "-o", path(form), *options)
        files = [path(form, "curves" + e) for form in FORMS for e in (".obj", ".ply", ".glb")]
        run(BLENDER, "--background", "--factory-startup", "--python-exit-code", "1", "--python",
            READER, "--", path("found.json"), *files, env=SYSTEM)
        with open(path("found.json"), encoding="utf-8") as file:
            found = json.load(file)
        print("Blender " + found["version"])
        cls.found = {tuple(p.split(os.sep)[-2:]): v for p, v in found["files"].items()}
        cls.curves = {}
        with open(path("default", "curves.csv"), encoding="utf-8", newline="") as file:
            for row in csv.DictReader(file):
                parts = cls.curves.setdefault(row["stroke"] + " " + row["technique"], {})
                parts.setdefault(row["part"], []).append([float(row[c]) for c in "xyz"])
        assert any(len(parts) > 1 for parts in cls.curves.values()), "a curve has a gap"

    def expected(self, name, lone_points=True):
        """Vertices, edges and length of a curve's lines."""
        parts = [p for p in self.curves[name].values() if lone_points or len(p) > 1]
        return (sum(map(len, parts)), sum(len(p) - 1 for p in parts),
                sum(math.dist(a, b) for p in parts for a, b in zip(p, p[1:])))

    def check_lines(self, objects, **options):
        for name in self.curves:
            vertices, edges, length = self.expected(name, **options)
            if edges == 0:
                continue
            self.assertEqual((objects[name]["vertices"], objects[name]["edges"],
                              objects[name]["faces"]), (vertices, edges, 0), name)
            # Single precision.
            self.assertAlmostEqual(objects[name]["length"] / length, 1, 4, name)

    def test_obj_has_every_segment(self):
        self.check_lines(self.found["default", "curves.obj"])

    def test_ply_is_one_mesh_of_closed_tubes_with_colours(self):
        (mesh,) = self.found["default", "curves.ply"].values()
        self.assertGreater(mesh["faces"], 1000)
        self.assertEqual(mesh["odd_edges"], 0)
        self.assertEqual(len(mesh["colors"]), 1)

    def test_ply_lines_have_every_edge(self):
        (mesh,) = self.found["other", "curves.ply"].values()
        vertices, edges, length = map(sum, zip(*map(self.expected, self.curves)))
        self.assertEqual((mesh["vertices"], mesh["edges"], mesh["faces"]), (vertices, edges, 0))
        self.assertAlmostEqual(mesh["length"] / length, 1, 4)

    def test_glb_has_the_target_and_a_closed_tube_for_each_curve(self):
        objects = self.found["default", "curves.glb"]
        self.assertEqual(sorted(objects), sorted(["torus", *self.curves]))
        for name in self.curves:
            self.assertGreater(objects[name]["faces"], 100, name)
            self.assertEqual(objects[name]["odd_edges"], 0, name)
            self.assertEqual(len(objects[name]["materials"]), 1, name)

    def test_glb_lines_have_every_segment(self):
        self.check_lines(self.found["other", "curves.glb"], lone_points=False)


if BLENDER is None:
    print("skipped: Blender is not installed")
    sys.exit(77)
unittest.main(argv=["blender_test"], verbosity=2)
