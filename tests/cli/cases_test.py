"""Inputs as real files have them: cases_test.py PROGRAM CASES. Skips where the folder is absent.

The right values are what other readers and analysis give."""

import csv
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM, CASES = sys.argv[1:3]
CACHE = tempfile.TemporaryDirectory()
os.environ["MIMICRY_CACHE"] = CACHE.name


def case(*names):
    return os.path.join(CASES, *names)


def run(*args, expect=0):
    done = subprocess.run([PROGRAM, *args], capture_output=True, text=True, timeout=1800)
    assert done.returncode == expect, (args, done.returncode, done.stdout, done.stderr)
    return done


def info(*names):
    return json.loads(run("info", case(*names), "--json").stdout)


class Cases(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def curves(self, mesh, strokes, *args, expect=0):
        """Lengths in model units by technique, and the kinds of pieces."""
        run("project", mesh, strokes, "--formats", "json", "-o", self.folder, *args, expect=expect)
        with open(os.path.join(self.folder, "curves.json"), encoding="utf-8") as file:
            curves = json.load(file)["curves"]
        return ({c["technique"]: c["length"] for c in curves},
                {p["kind"] for c in curves for p in c["pieces"]}, curves)

    def distances(self, mesh, start):
        out = os.path.join(self.folder, "d.csv")
        run("geodesic", mesh, "--from", start, "-o", out)
        with open(out, encoding="utf-8") as file:
            return [float(row["distance"]) for row in csv.DictReader(file)]

    def test_vertices_without_faces_do_not_count(self):
        for name in ("octahedron_stray.obj", "sphere_stray.obj"):
            mesh = case("01-isolated-vertex-crash", name)
            bake = os.path.join(self.folder, "b.mimicry")
            run("bake", mesh, "-o", bake)
            run("quality", mesh)
        report = info("02-isolated-vertex-size", "sphere_stray.obj")
        self.assertAlmostEqual(report["diagonal"], 2 * math.sqrt(3), places=3)
        self.assertEqual(report["isolated_vertices"]["count"], 1)
        lengths, kinds, _ = self.curves(case("02-isolated-vertex-size", "sphere_stray.obj"),
                                        case("02-isolated-vertex-size", "stroke.json"))
        self.assertNotIn("chord", kinds)
        self.assertAlmostEqual(lengths["snap"], 2.0722, delta=5e-4)

    def test_seams_are_closed(self):
        report = info("04-seams-not-joined", "cube24.ply")
        self.assertEqual((len(report["components"]), report["closed"], report["volume"]),
                         (1, True, 8.0))
        self.assertEqual((report["vertices"], report["surface"]["vertices"]), (24, 8))
        found = self.distances(case("04-seams-not-joined", "cube24.ply"), "v0")
        self.assertEqual(len(found), 24)
        right = [0.0, 2.0, math.sqrt(8.0), math.sqrt(20.0)]
        for d in found:
            self.assertLess(min(abs(d - r) for r in right), 1e-9, d)
        self.assertEqual(len({round(d, 6) for d in found}), 4)
        self.assertEqual(len(info("04-seams-not-joined", "seam2.obj")["components"]), 1)

        mesh, strokes = case("04-seams-not-joined", "sphere_seam.obj"), case(
            "04-seams-not-joined", "stroke.json")
        lengths, kinds, _ = self.curves(mesh, strokes)
        self.assertNotIn("chord", kinds)
        for name in ("occlude", "spraycan", "head-centric"):
            self.assertAlmostEqual(lengths[name], 2.0569, delta=5e-4, msg=name)
        self.assertAlmostEqual(lengths["snap"], 2.0722, delta=5e-4)
        self.assertAlmostEqual(lengths["mimicry"], 2.2528, delta=5e-3)
        self.assertAlmostEqual(lengths["mimicry-live"], 2.2519, delta=5e-4)
        # Not joined, and said so.
        done = run("project", mesh, strokes, "-t", "snap", "--no-join", "-o", self.folder)
        self.assertIn("are not joined", done.stderr)

    def test_faces_that_repeat_a_corner_are_left_out(self):
        report = info("21-repeated-corners", "polygon_first_again.obj")
        self.assertEqual(report["area"], 1.0)
        self.assertTrue(report["drawable"])
        report = info("21-repeated-corners", "sphere_two_degenerate.obj")
        self.assertEqual((report["surface"]["faces"], report["closed"]), (2208, True))

    def test_polygons_that_are_not_convex(self):
        for name, faces, area in (("L.obj", 4, 3.0), ("concave_arrow.off", 2, 2.0),
                                  ("concave_arrow.ply", 2, 2.0)):
            report = info("07-concave-polygons", name)
            self.assertEqual(report["faces"], faces, name)
            self.assertAlmostEqual(report["area"], area, places=12, msg=name)
        _, kinds, curves = self.curves(case("07-concave-polygons", "L.obj"),
                                       case("07-concave-polygons", "L_stroke.json"), "-t", "snap")
        self.assertNotIn("chord", kinds)
        for found, right in zip(curves[0]["points"][0]["position"], (1.0, 1.8, 0.0)):
            self.assertAlmostEqual(found, right, places=9)

    def test_text_as_other_programs_write_it(self):
        for name in ("bom.obj", "bom.off", "bom.ply", "bom.stl"):
            report = info("08-byte-order-mark", name)
            self.assertEqual((report["vertices"], report["faces"], report["area"]), (8, 12, 24.0))
        self.assertEqual(info("08-byte-order-mark", "silent.obj")["area"], 1.0)
        for name in ("broken_lines", "glued", "lower", "no_keyword", "one_line"):
            report = info("16-off-dialects", name + ".off")
            self.assertEqual((report["vertices"], report["faces"], report["area"]), (8, 12, 24.0))

    def test_one_bad_frame(self):
        strokes = case("20-one-bad-frame", "zero_quaternion.json")
        done = run("project", "shape:torus", strokes, "-t", "snap", "--formats", "json",
                   "-o", self.folder, expect=5)
        self.assertRegex(done.stderr, "left out: zero_quaternion.json: stroke 1: .*frame 50: ")
        with open(os.path.join(self.folder, "curves.json"), encoding="utf-8") as file:
            self.assertEqual(len(json.load(file)["curves"]), 2)

    def test_two_sided_and_turned_faces(self):
        strokes = case("24-two-sided-and-mixed-orientation", "stroke.json")
        for name in ("sphere_half_turned", "sphere_both_sides", "sphere_two_sheets"):
            mesh = case("24-two-sided-and-mixed-orientation", name + ".obj")
            lengths, kinds, curves = self.curves(mesh, strokes, "-t", "mimicry-live,mimicry-planar")
            self.assertNotIn("chord", kinds, name)
            self.assertAlmostEqual(lengths["mimicry-live"], 2.252, delta=1e-3, msg=name)
            self.assertAlmostEqual(lengths["mimicry-planar"], 2.243, delta=1e-3, msg=name)
            # Faces and barycentrics are the file's.
            with open(mesh, encoding="utf-8") as file:
                words = [line.split() for line in file]
            vertices = [[float(x) for x in w[1:]] for w in words if w and w[0] == "v"]
            faces = [[int(v) - 1 for v in w[1:]] for w in words if w and w[0] == "f"]
            for p in curves[0]["points"][::7]:
                corners = [vertices[v] for v in faces[p["face"]]]
                for k in range(3):
                    x = sum(b * c[k] for b, c in zip(p["bary"], corners))
                    self.assertAlmostEqual(x, p["position"][k], places=12)
            run("info", mesh, "--strict", expect=3)


if __name__ == "__main__":
    if not os.path.isdir(CASES):
        print("no cases in", CASES, "- skipped")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)
