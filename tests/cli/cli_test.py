"""Runs the program as its users do: cli_test.py PROGRAM STUDY_DATA."""

import json
import os
import struct
import subprocess
import sys
import tempfile
import unittest

PROGRAM, STUDY = sys.argv[1:3]
CACHE = tempfile.TemporaryDirectory()  # of bakes: the user's own stays out of it
os.environ["MIMICRY_CACHE"] = CACHE.name


def run(*args, expect=0):
    done = subprocess.run([PROGRAM, *args], capture_output=True, text=True, timeout=1800)
    assert done.returncode == expect, (args, done.returncode, done.stdout, done.stderr)
    return done


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, *names):
        return os.path.join(self.folder.name, *names)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def test_from_shape_to_picture(self):
        mesh, strokes, out = self.path("cube.ply"), self.path("s.json"), self.path("deep", "out")
        run("shapes", "rounded-cube", "--out", mesh)
        run("simulate", mesh, "--shape", "rounded-cube", "--out", strokes, "--rate", "30")
        table = json.loads(run("project", mesh, strokes, "--out", out, "--json").stdout)
        names = [row["technique"] for row in table["techniques"]]
        listed = [t["name"] for t in json.loads(run("techniques", "--json").stdout)]
        self.assertEqual(names, listed)
        for row in table["techniques"]:
            self.assertGreater(row["points"], 20, row)
            self.assertGreater(row["length_m"], 0.1, row)
        self.assertEqual(sorted(os.listdir(out)), ["curves." + f for f in
                                                   ("csv", "glb", "json", "obj", "ply")])
        picture = self.path("deep", "p.png")
        run("render", mesh, "--strokes", strokes, "--curves", os.path.join(out, "curves.json"),
            "--side-by-side", "--width", "120", "--height", "100", "--out", picture)
        with open(picture, "rb") as file:
            head = file.read(24)
        self.assertEqual(head[:8], b"\x89PNG\r\n\x1a\n")
        self.assertGreater(struct.unpack(">II", head[16:])[0], 240)

    def test_gltf_with_its_buffer_in_another_file(self):
        def gltf(name, uri):
            return self.write(name, json.dumps({
                "asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
                "accessors": [{"bufferView": 0, "count": 3, "componentType": 5126, "type": "VEC3"}],
                "bufferViews": [{"buffer": 0, "byteLength": 36}],
                "buffers": [{"uri": uri, "byteLength": 36}], "images": [{"uri": "missing.png"}],
                "extensionsRequired": ["KHR_materials_unlit"]}))

        os.mkdir(self.path("model"))
        for name in ("model/corner 1.bin", "secret.bin"):
            with open(self.path(name), "wb") as file:
                file.write(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 2, 0))
        done = run("info", gltf("model/corner.gltf", "corner%201.bin"), "--json")
        report = json.loads(done.stdout)
        self.assertEqual((report["vertices"], report["faces"], report["area"]), (3, 1, 1))
        self.assertIn("corner.gltf: the extension 'KHR_materials_unlit'", done.stderr)
        self.assertIn("'no.bin'", run("info", gltf("model/none.gltf", "no.bin"), expect=4).stderr)
        self.assertIn("'../secret.bin'",
                      run("info", gltf("model/out.gltf", "../secret.bin"), expect=3).stderr)
        os.symlink("../secret.bin", self.path("model/link.bin"))
        self.assertIn("link.bin", run("info", gltf("model/link.gltf", "link.bin"), expect=3).stderr)

    def test_gltf_that_unfolds_to_too_much(self):
        small = self.write("small.gltf", json.dumps({
            "asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"count": 60000000, "componentType": 5126, "type": "VEC3"}]}))
        said = run("info", small, expect=3).stderr
        self.assertIn("unfolds to 20000000 triangles, more than the 10000000", said)
        self.assertIn("MIMICRY_MAX_UNFOLDED", said)
        for limit, answer in (("20000001", "unfolds to 60000000 vertices, more than the 20000001"),
                              ("many", "'many' is not a number of triangles")):
            done = subprocess.run([PROGRAM, "info", small], capture_output=True, text=True, timeout=1800,
                                  env={**os.environ, "MIMICRY_MAX_UNFOLDED": limit})
            self.assertEqual(done.returncode, 3)
            self.assertIn(answer, done.stderr)

    def test_same_input_gives_the_same_files(self):
        for out in ("a", "b"):
            run("simulate", "shape:torus:24", "--seed", "7", "--out", self.path(out + ".json"))
            run("project", "shape:torus:24", self.path(out + ".json"), "--out", self.path(out))
        for name in os.listdir(self.path("a")):
            with open(self.path("a", name), "rb") as a, open(self.path("b", name), "rb") as b:
                self.assertEqual(a.read(), b.read(), name)

    def test_closed_loop_comes_nearer(self):
        off = []
        for extra in ([], ["--closed-loop", "anchored-closest"]):
            run("simulate", "shape:torus:48", "--out", self.path("s.json"), *extra)
            done = run("project", "shape:torus:48", self.path("s.json"), "-t", "anchored-closest",
                       "--json", "--formats", "csv", "--out", self.path("o"))
            off.append(json.loads(done.stdout)["techniques"][0]["mean_distance_to_intended_m"])
        self.assertLess(off[1], 0.5 * off[0])

    def test_people_who_see_their_ink_stand_beside_blind_ones(self):
        torus, seen, blind, out = "shape:torus:24", self.path("seen.json"), self.path("blind.json"), self.path("o")
        run("simulate", torus, "--closed-loop", "anchored-closest,spraycan", "--count", "2", "--rate",
            "30", "--seed", "5", "-o", seen)
        run("simulate", torus, "--rate", "30", "--seed", "5", "-o", blind)
        with open(seen, encoding="utf-8") as file:
            strokes = json.load(file)["strokes"]
        with open(blind, encoding="utf-8") as file:
            unseen = json.load(file)["strokes"]
        version = run("--version").stdout.strip()
        self.assertEqual(len({s["id"] for s in strokes}), len(strokes))
        self.assertEqual(len(strokes), 4 * len(unseen))
        for technique in ("spraycan", "anchored-closest"):
            mark = {"program": "mimicry " + version, "seed": 5, "technique": technique}
            self.assertEqual(sum(s["simulated"] == mark for s in strokes), 2 * len(unseen))
        self.assertEqual({json.dumps(s["simulated"]) for s in unseen},
                         {json.dumps({"program": "mimicry " + version, "seed": 5})})
        # Each is drawn with the technique whose ink was seen; the others stand beside.
        rows = json.loads(run("project", torus, seen, "--beside", blind, "--json", "-o", out)
                          .stdout)["techniques"]
        self.assertEqual([r["technique"] for r in rows], ["spraycan", "anchored-closest"])
        for row in rows:
            own = [s["id"] for s in strokes if s["simulated"]["technique"] == row["technique"]]
            self.assertEqual([s["stroke"] for s in row["strokes"]], own)
            self.assertEqual((row["measures"]["strokes"], row["beside"]["strokes"]),
                             (len(own), len(unseen)))
        anchored = rows[1]
        self.assertLess(anchored["measures"]["d_ep_m"], 0.5 * anchored["beside"]["d_ep_m"])
        self.assertEqual(anchored["measures"]["share_jumping"], 0)
        with open(os.path.join(out, "curves.json"), encoding="utf-8") as file:
            curves = json.load(file)["curves"]
        self.assertEqual([c["stroke"] for c in curves], [s["stroke"] for r in rows for s in r["strokes"]])
        table = run("project", torus, seen, "--beside", blind, "-o", out).stdout
        self.assertRegex(table.splitlines()[0],
                         "^technique +ink seen: off mm +K_E rad/m +jumps % +blind: off mm +K_E")
        self.assertIn("%.1f" % (1e3 * anchored["measures"]["d_ep_m"]), table.splitlines()[2])
        for line in ("ink seen: simulated people who see", "blind: simulated strokes"):
            self.assertIn(line, table)
        # Named techniques draw all strokes, whoever saw what.
        rows = json.loads(run("project", torus, seen, "-t", "snap", "--json", "-o", out).stdout)
        self.assertEqual(len(rows["techniques"][0]["strokes"]), len(strokes))
        self.assertNotIn("beside", rows["techniques"][0])
        # In the picture too: a panel has its own strokes.
        for name in ("all.png", "one.png"):
            run("render", torus, "--strokes", seen, "--curves", os.path.join(out, "curves.json"),
                "--side-by-side", "--width", "90", "--height", "90", "-o", self.path(name))

    def test_smoothness_and_jumps_of_strokes_that_meant_nothing(self):
        run("simulate", "shape:torus:24", "--rate", "30", "-o", self.path("s.json"))
        with open(self.path("s.json"), encoding="utf-8") as file:
            document = json.load(file)
        for stroke in document["strokes"]:
            del stroke["intended"], stroke["simulated"]
        path = self.write("own.json", json.dumps(document))
        done = run("project", "shape:torus:24", path, "-t", "snap", "--json", "-o", self.path("o"))
        row = json.loads(done.stdout)["techniques"][0]
        self.assertIsNone(row["measures"]["d_ep_m"])
        self.assertGreater(row["measures"]["k_e_rad_per_m"], 1)
        head, snap = run("project", "shape:torus:24", path, "-t", "snap", "-o", self.path("o")) \
            .stdout.splitlines()[:2]
        self.assertRegex(head, "^technique +off mm +K_E rad/m +jumps %")
        self.assertRegex(snap, "^snap +- +[0-9]")

    def test_forms_of_curve_files(self):
        run("simulate", "shape:torus:24", "--rate", "30", "-o", self.path("s.json"))
        with open(self.path("s.json"), encoding="utf-8") as file:
            document = json.load(file)

        def curves(name, strokes, *options):
            run("project", "shape:torus:24", strokes, "-t", "snap", "-o", self.path(name), *options)
            files = {}
            for ending in ("obj", "ply", "glb"):
                with open(self.path(name, "curves." + ending), "rb") as file:
                    files[ending] = file.read()
            return files

        plain = curves("a", self.path("s.json"))
        self.assertEqual({len(l.split()) for l in plain["obj"].decode().splitlines() if l[:2] == "l "}, {3})
        other = curves("b", self.path("s.json"), "--obj-lines", "polylines", "--curves-as", "lines")
        lines = [l for l in other["obj"].decode().splitlines() if l[:2] == "l "]
        self.assertEqual(len(lines), len(document["strokes"]))
        self.assertIn(b"element edge", other["ply"])
        self.assertIn(b'"mode":3', other["glb"])
        # At half of its pressure a pen draws as thick as one without pressure.
        for pressure, same in ((0.5, True), (0.9, False)):
            for stroke in document["strokes"]:
                for frame in stroke["frames"]:
                    frame["pressure"] = pressure
            path = self.write("pressed.json", json.dumps(document))
            pressed = curves("c", path)
            self.assertEqual(pressed["glb"] == plain["glb"], same)
            self.assertEqual(pressed["ply"] == plain["ply"], same)
            self.assertEqual(curves("d", path, "--tube-width", "constant"), plain)

    def test_info_of_attributes(self):
        mesh = self.write("cup.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\no cup\ng lower side\n"
                          "usemtl red\nf 1/1 2/2 3/9\ng upper\nf 1 3 2\n")
        done = run("info", mesh, "--json")
        self.assertIn("line 9", done.stderr)
        self.assertEqual({"texcoord_corners": 2, "texcoords": 2, "color_corners": 0, "colors": 0,
                          "groups": ["lower side", "upper"], "materials": ["red"], "objects": ["cup"]},
                         json.loads(done.stdout)["attributes"])
        text = run("info", mesh).stdout
        self.assertRegex(text, r"texture coordinates +2, at 2 corners of 6")
        self.assertRegex(text, r"groups +2: lower side, upper")
        plain = run("info", "shape:torus")
        self.assertNotIn("groups", plain.stdout)

    def test_info(self):
        report = json.loads(run("info", "shape:double-torus", "--json").stdout)
        self.assertEqual((report["genus"], report["closed"], report["drawable"]), (2, True, True))
        book = "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0 0\nf 1 2 3\nf 2 1 4\nf 1 2 5\n"
        mesh = self.write("book.obj", book)
        done = run("info", mesh)
        self.assertIn("non-manifold edges                 1 (first: vertices 0-1)", done.stdout)
        self.assertIn("1 edge of three or more faces was split", done.stdout)
        done = run("info", mesh, "--strict", expect=3)
        self.assertIn("cannot be drawn on: book.obj: target: strictly", done.stdout)
        self.assertIn("no longer needed", run("info", mesh, "--allow-nonmanifold").stderr)

    def test_errors_name_thing_place_and_remedy(self):
        def fails(expect, *args):
            done = run(*args, expect=expect)
            self.assertTrue(done.stderr.startswith("mimicry: ") or expect == 2, done.stderr)
            return done.stderr

        self.assertIn("nowhere.obj", fails(4, "info", self.path("nowhere.obj")))
        self.assertIn("cut.obj", fails(3, "info", self.write("cut.obj", "v 0 0 zero\n")))
        self.assertIn("torus", fails(3, "info", "shape:donut"))
        self.assertIn("resolution", fails(3, "info", "shape:torus:many"))
        self.assertIn("empty.obj", fails(3, "info", self.write("empty.obj", "")))
        fails(2, "project")
        fails(2, "fly")
        run("simulate", "shape:sphere", "--out", self.path("s.json"))
        self.assertIn("snap", fails(3, "project", "shape:sphere", self.path("s.json"), "-t", "smap",
                                    "--out", self.path("o")))
        self.assertIn("muzzle", fails(3, "project", "shape:sphere", self.path("s.json"), "--option",
                                      "muzzle=1", "--out", self.path("o")))
        with open(self.path("s.json"), encoding="utf-8") as file:
            cut = file.read(5000)
        self.assertIn("half.json: stroke 0", fails(3, "project", "shape:sphere",
                                                   self.write("half.json", cut)))
        self.assertIn("face", fails(3, "project", "shape:sphere:1", self.path("s.json"),
                                    "--out", self.path("o")))
        self.assertFalse(os.path.exists(self.path("o")), "nothing is left behind")
        blocked = self.write("file", "")
        fails(4, "project", "shape:sphere", self.path("s.json"), "--out", os.path.join(blocked, "x"))

    def test_numbers_that_are_none_are_refused(self):
        for option, *words in (("--seed", "-1", "99999999999999999999", "", "1.5", "x", "0x10"),
                               ("--distance", "", "near")):
            for word in words:
                given = [option + "=" + word] if word else [option, word]
                said = run("simulate", "shape:torus:24", *given, "--out", self.path("no.json"),
                           expect=2).stderr
                self.assertIn("'" + word + "' is not a", said)
        self.assertFalse(os.path.exists(self.path("no.json")))
        run("simulate", "shape:torus:24", "--seed", "18446744073709551615", "--rate", "20", "--out",
            self.path("yes.json"))

    def test_stroke_with_a_fault_is_left_out_and_named(self):
        run("simulate", "shape:sphere", "--count", "3", "--out", self.path("s.json"))
        with open(self.path("s.json"), encoding="utf-8") as file:
            recorded = json.load(file)
        self.assertGreater(len(recorded["strokes"]), 2)
        bad = recorded["strokes"][1]
        bad["frames"][50]["head"]["orientation"] = [0, 0, 0, 0]
        faulty = self.write("f.json", json.dumps(recorded))
        done = run("project", "shape:sphere", faulty, "-t", "snap", "--formats", "json",
                   "--out", self.path("o"), expect=5)
        self.assertIn("left out: f.json: stroke 1", done.stderr)
        self.assertIn(bad["id"], done.stderr)
        self.assertIn("frame 50", done.stderr)
        self.assertIn("remove the frame or record it again", done.stderr)
        with open(self.path("o", "curves.json"), encoding="utf-8") as file:
            drawn = [curve["stroke"] for curve in json.load(file)["curves"]]
        self.assertEqual(drawn, [s["id"] for s in recorded["strokes"] if s is not bad])
        done = run("render", "shape:sphere", "--strokes", faulty, "--width", "60", "--height", "50",
                   "--out", self.path("p.png"), expect=5)
        self.assertIn("left out: f.json: stroke 1", done.stderr)
        recorded["strokes"] = [bad]
        run("project", "shape:sphere", self.write("f.json", json.dumps(recorded)), "-t", "snap",
            "--out", self.path("none"), expect=3)
        self.assertFalse(os.path.exists(self.path("none")), "nothing is left behind")

    def test_distances_of_another_program(self):
        rows = "\ufeffdistance,vertex\r" + "".join(f"{n / 10},{n}\r" for n in range(25))
        run("render", "shape:grid:4", "--distances", self.write("d.csv", rows), "--width", "60",
            "--height", "50", "--out", self.path("p.png"))
        wrong = run("render", "shape:grid:4", "--distances", self.write("d.csv", "a,b\n1,2\n"),
                    "--out", self.path("p.png"), expect=3)
        self.assertIn("vertex,distance", wrong.stderr)

    def test_options_reach_the_technique(self):
        run("simulate", "shape:sphere", "--out", self.path("s.json"))
        run("project", "shape:sphere", self.path("s.json"), "-t", "spraycan", "--option",
            "nozzle=0,0,1", "--misses", "split", "--formats", "json", "--out", self.path("o"))
        with open(self.path("o", "curves.json"), encoding="utf-8") as file:
            curves = json.load(file)["curves"]
        self.assertEqual(curves[0]["options"], {"nozzle": [0, 0, 1]})
        self.assertLess(sum(len(c["points"]) for c in curves), 50, "it sprays backwards")

    def test_baked_file_draws_as_the_bake_in_memory(self):
        baked, strokes = self.path("c.mimicry"), self.path("s.json")
        run("bake", "shape:rounded-cube:6", "--out", baked, "--samples", "100")
        run("bake", "shape:rounded-cube:6", "--out", self.path("d.mimicry"), "--samples", "100",
            "--threads", "1")
        with open(baked, "rb") as a, open(self.path("d.mimicry"), "rb") as b:
            data = a.read()
            self.assertEqual(data, b.read(), "the number of threads does not matter")
        run("simulate", "shape:rounded-cube:6", "--out", strokes, "--rate", "30")
        run("project", "shape:rounded-cube:6", strokes, "-t", "mimicry", "--embedding", baked,
            "--formats", "json", "--out", self.path("o"))
        other = run("project", "shape:rounded-cube:7", strokes, "-t", "mimicry", "--embedding", baked,
                    "--out", self.path("o"), expect=3)
        self.assertIn("c.mimicry", other.stderr)
        with open(self.path("cut.mimicry"), "wb") as file:
            file.write(data[:5000])
        cut = run("project", "shape:rounded-cube:6", strokes, "-t", "mimicry", "--embedding",
                  self.path("cut.mimicry"), "--out", self.path("o"), expect=3)
        self.assertIn("cut.mimicry", cut.stderr)

    def test_geodesics(self):
        grid, out = "shape:grid:4", self.path("p.json")
        run("geodesic", grid, "--from", "v0", "--to", "v24", "--out", out)
        with open(out, encoding="utf-8") as file:
            self.assertAlmostEqual(json.load(file)["length"], 8 ** 0.5, places=12)
        run("geodesic", grid, "--from", "v0", "--out", self.path("d.csv"))
        with open(self.path("d.csv"), encoding="utf-8") as file:
            rows = file.read().splitlines()
        self.assertEqual(rows[0], "vertex,distance")
        self.assertAlmostEqual(float(rows[25].split(",")[1]), 8 ** 0.5, places=12)
        run("geodesic", "--from", "v0", "--from", "v24", grid, "-o", self.path("d.csv"))
        self.assertIn("v99", run("geodesic", grid, "--from", "v99", "-o", out, expect=3).stderr)
        self.assertIn("point ''", run("geodesic", grid, "--from", "v1", "--to", "", "-o", out,
                                      expect=3).stderr)
        apart = run("geodesic", "shape:two-spheres:2", "--from", "v0", "--to", "v80", "-o",
                    self.path("none.json"), expect=5)
        self.assertIn("no path", apart.stdout)
        self.assertIn("name a .json", run("geodesic", grid, "--from", "v0", "--to", "v1", "-o",
                                          self.path("p.csv"), expect=2).stderr)
        self.assertIn("give --to", run("geodesic", grid, "--from", "v0", "-o", self.path("d.json"),
                                       expect=2).stderr)
        self.assertFalse(os.path.exists(self.path("none.json")))

    def test_study_targets(self):
        if not os.path.isdir(STUDY):
            self.skipTest("the study's shapes are not there: " + STUDY)
        bunny, targets = os.path.join(STUDY, "bunny.obj"), os.path.join(STUDY, "targets.json")
        run("simulate", bunny, "--targets", targets, "--curves", "bunny-2", "--out", self.path("s.json"))
        done = run("project", bunny, self.path("s.json"), "-t", "spraycan,anchored-closest", "--json",
                   "--formats", "csv", "--out", self.path("o"))
        for row in json.loads(done.stdout)["techniques"]:
            self.assertLess(row["mean_distance_to_intended_m"], 0.1, row)


unittest.main(argv=["cli_test"], verbosity=2)
