"""measure, keypoints and targets as researchers run them: study_cli_test.py PROGRAM STUDY_DATA.

The recordings are made here, on a flat plate, where every measure can be computed by hand."""

import copy
import csv
import json
import math
import os
import random
import subprocess
import sys
import tempfile
import unittest

PROGRAM, STUDY = sys.argv[1:3]
CELLS = 10  # of the plate, a side
SCALE = 0.4  # metres per mesh unit
COLUMNS = ("participant,stroke,recording,method,method_number,shape,shape_number,index,curve,repetition,task,"
           "simulated,D_ep_mm,D_sym_mm,K_E,K_g,F_g,T_h,R_h,T_c,R_c,tau_s,short,noisy,inverted,"
           "mimicry_violation,L_X_m,pieces,K_g_normalised,largest_jump,share_jumping,gaps,frechet_mm,"
           "end_lag_mm,length_ratio,boundary_nodes,undefined_nodes,frames,missed,rejected").split(",")
ORDER = [3, 1, 0, 2, 4, 3, 7, 5, 6, 9, 8, 7]


def run(*args, expect=0):
    done = subprocess.run([PROGRAM, *args], capture_output=True, text=True, timeout=1800)
    assert done.returncode == expect, (args, done.returncode, done.stdout, done.stderr)
    return done


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    size = math.sqrt(dot(a, a))
    return [x / size for x in a]


def dist(a, b):
    return math.dist(a, b)


def plate_obj():
    lines = [f"v {i / CELLS!r} {j / CELLS!r} 0" for j in range(CELLS + 1) for i in range(CELLS + 1)]
    at = lambda i, j: j * (CELLS + 1) + i + 1
    for j in range(CELLS):
        for i in range(CELLS):
            lines.append(f"f {at(i, j)} {at(i + 1, j)} {at(i + 1, j + 1)}")
            lines.append(f"f {at(i, j)} {at(i + 1, j + 1)} {at(i, j + 1)}")
    return "\n".join(lines) + "\n"


def locate(x, y):
    """Face (from 0) and barycentrics of a point of the plate."""
    i, j = min(int(x * CELLS), CELLS - 1), min(int(y * CELLS), CELLS - 1)
    u, v = x * CELLS - i, y * CELLS - j
    face = 2 * (j * CELLS + i)
    return (face, [1 - u, u - v, v]) if u >= v else (face + 1, [1 - v, u, v - u])


def target_points(curve):
    """A gentle wave across the plate."""
    y = 0.2 + 0.06 * curve
    return [(0.12 + 0.76 * t / 100, y + 0.08 * math.sin(0.09 * t + curve)) for t in range(101)]


def xyz(v):
    return dict(zip("xyz", v))


def turned(angle, axis):
    """Columns of the rotation by Rodrigues' formula."""
    c, s = math.cos(angle), math.sin(angle)
    columns = []
    for k in range(3):
        e = [float(i == k) for i in range(3)]
        w = cross(axis, e)
        columns.append([c * e[i] + s * w[i] + (1 - c) * dot(axis, e) * axis[i] for i in range(3)])
    return columns


ROTATION = turned(0.7, unit([1, 2, -1]))
MATRIX = [x for column in ROTATION for x in [*(SCALE * c for c in column), 0.0]] + \
    [0.3, 1.2, -0.4, 1.0]


def drawn_stroke(dice, curve, method="AnchorPhong", frames=60, breaks=()):
    """A shaky stroke along a target curve, in the published format."""
    wanted = target_points(curve)
    t_ms = 1000.0 * dice.uniform(0, 100)
    forward, up = [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]
    head_axis, pen_axis = unit([1, 0.3, 0.2]), unit([0.1, 1, -0.5])
    pieces = [[]]
    for k in range(frames):
        x, y = wanted[round(k * (len(wanted) - 1) / (frames - 1))]
        x, y = x + dice.gauss(0, 0.002), y + dice.gauss(0, 0.002)
        face, bary = locate(x, y)
        rotate = lambda axis, angle, v: [sum(c[i] * v[k] for k, c in enumerate(turned(angle, axis)))
                                         for i in range(3)]
        head_angle, pen_angle = 0.1 * math.sin(0.1 * k), 0.3 * math.sin(0.07 * k + 1)
        frame = {"T": t_ms,
                 "HP": xyz([0.5 + 0.02 * math.sin(0.1 * k), 0.5, 1.2]),
                 "PP": xyz([x + dice.gauss(0, 0.001), y + dice.gauss(0, 0.001),
                            0.12 + dice.gauss(0, 0.001)]),
                 "HU": xyz(rotate(head_axis, head_angle, up)),
                 "HF": xyz(rotate(head_axis, head_angle, forward)),
                 "CU": xyz(rotate(pen_axis, pen_angle, up)),
                 "CF": xyz(rotate(pen_axis, pen_angle, forward)),
                 "SD": xyz(forward)}
        if k in breaks:
            pieces.append([])
        pieces[-1].append({"PT": xyz([x, y, 0]), "N": xyz([0, 0, 1]), "TI": face + 1,
                           "B": xyz(bary), "D": 0.12, "DF": frame})
        t_ms += dice.choice([11.0, 11.125, 11.25, 0.0 if k == 5 else 11.5])
    return [{"P": [f["PT"] for f in piece], "F": piece, "M": method,
             "ModelMatrix": {"data": MATRIX}} for piece in pieces]


# The measures once more, from their definitions.

def length(points):
    return sum(dist(a, b) for a, b in zip(points, points[1:]))


def resampled(points, count=101):
    total, result, done, k = length(points), [], 0.0, 0
    for i in range(count - 1):
        want = total * i / (count - 1)
        while k + 1 < len(points) - 1 and done + dist(points[k], points[k + 1]) < want:
            done += dist(points[k], points[k + 1])
            k += 1
        t = (want - done) / dist(points[k], points[k + 1])
        result.append([a + t * (b - a) for a, b in zip(points[k], points[k + 1])])
    return result + [points[-1]]


def filtered(frames, keys):
    frames = [f for f, g in zip(frames, frames[1:] + [None]) if g is None or g["T"] != f["T"]]
    result = []
    for f in frames:
        sums, weights = {k: [0, 0, 0] for k in keys}, 0
        for g in frames:
            dt = (g["T"] - f["T"]) / 1000
            if abs(dt) > 0.050:
                continue
            w = math.exp(-dt * dt / (2 * 0.020 ** 2))
            weights += w
            for k in keys:
                sums[k] = [s + w * g[k][c] for s, c in zip(sums[k], "xyz")]
        result.append({k: [s / weights for s in v] for k, v in sums.items()})
    return result


def rotation_path(frames, forward, up):
    total, last = 0.0, None
    for f in frames:
        u = unit(f[up])
        v = unit(sub(f[forward], [dot(f[forward], u) * x for x in u]))
        axes = [v, u, cross(v, u)]
        if last:
            trace = sum(dot(a, b) for a, b in zip(axes, last))
            # The angle from the chords: acos loses small angles.
            total += 2 * math.asin(min(1, math.sqrt(sum(
                dist(a, b) ** 2 for a, b in zip(axes, last)) / 8)))
            assert abs(math.acos(max(-1, min(1, (trace - 1) / 2)))) < 1
        last = axes
    return total


def expected_row(stroke, curve, keypoints):
    frames = [f for piece in stroke for f in piece["F"]]
    device = [f["DF"] for f in frames]
    q = [[SCALE * f["PT"][c] for c in "xyz"] for f in frames]
    x = [[SCALE * a, SCALE * b, 0.0] for a, b in target_points(curve)]
    pen = [[SCALE * d["PP"][c] for c in "xyz"] for d in device]
    l_x = length(x)
    q101, x101, p101 = resampled(q), resampled(x), resampled(pen)
    deviation = []  # at every node: the points, and 0 where an edge is crossed
    for i in range(1, len(q) - 1):
        a, b = sub(q[i], q[i - 1]), sub(q[i + 1], q[i])
        if frames[i]["TI"] != frames[i - 1]["TI"]:
            deviation.append(0.0)
        deviation.append(math.atan2(a[0] * b[1] - a[1] * b[0], dot(a, b)))
    if frames[-1]["TI"] != frames[-2]["TI"]:
        deviation.append(0.0)
    head, hand = (filtered(device, keys) for keys in (("HP", "HU", "HF"), ("PP", "CU", "CF")))
    closest = [min(range(len(q)), key=lambda i: dist(q[i], x[k])) for k in keypoints]
    inversions = sum(closest[a] > closest[b] for a in range(len(closest))
                     for b in range(a + 1, len(closest)))
    spread = [dist(a, b) for a, b in zip(p101, x101)]
    return {
        "D_ep_mm": 1e3 * sum(map(dist, q101, x101)) / 101,
        "D_sym_mm": 500 * (sum(min(dist(a, b) for b in x101) for a in q101) +
                           sum(min(dist(a, b) for b in q101) for a in x101)) / 101,
        "K_E": sum(map(abs, deviation)) / l_x,
        "K_g": sum(map(abs, deviation)) / l_x,
        "F_g": sum(abs(b - a) for a, b in zip(deviation, deviation[1:])) / l_x,
        "T_h": SCALE * length([f["HP"] for f in head]) / l_x,
        "R_h": rotation_path(head, "HF", "HU") / l_x,
        "T_c": SCALE * length([f["PP"] for f in hand]) / l_x,
        "R_c": rotation_path(hand, "CF", "CU") / l_x,
        "tau_s": (device[-1]["T"] - device[0]["T"]) / 1000,
        "short": length(q) < l_x / 2,
        "noisy": any(dist(a, b) > 0.05 for a, b in zip(pen, pen[1:])),
        "inverted": inversions > len(keypoints) * (len(keypoints) - 1) / 4,
        "mimicry_violation": (max(spread) - min(spread)) / l_x,
        "L_X_m": l_x,
        "pieces": sum(bool(piece["F"]) for piece in stroke)}


class Study(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = folder.name
        os.mkdir(self.path("shapes"))
        self.write("shapes/torus.obj", plate_obj())
        curves = []
        for c in range(10):
            located = [locate(x, y) for x, y in target_points(c)]
            curves.append({"face": [f for f, _ in located], "bary": [b for _, b in located],
                           "keypoints": [0, 30, 60, 100]})
        self.write("targets.json", json.dumps(
            {"shapes": [{"name": "torus", "scale": SCALE, "curves": curves}]}))
        dice = random.Random(1)
        self.strokes = [drawn_stroke(dice, c, breaks=(20, 41) if i == 3 else ())
                        for i, c in enumerate(ORDER)]

    def path(self, *names):
        return os.path.join(self.root, *names)

    def write(self, name, text):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def participant(self, name="p1", strokes=None, methods=(1,), shapes=(0,), order=None,
                    files=None):
        self.write(f"{name}/study_sequence.json", json.dumps(
            {"MethodSequence": methods, "ShapeSequence": shapes, "StrokeSequence": order or ORDER}))
        for file, content in (files or {"1_0.json": strokes or self.strokes}).items():
            self.write(f"{name}/{file}", content if isinstance(content, str)
                       else json.dumps(content))
        return self.path(name)

    def measure(self, *participants, expect=0, more=()):
        out = self.path("rows.csv")
        done = run("measure", *participants, "--shapes", self.path("shapes"), "--targets",
                   self.path("targets.json"), "--out", out, *more, expect=expect)
        with open(out, encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        with open(self.path("rows.rejected.csv"), encoding="utf-8", newline="") as file:
            rejected = list(csv.DictReader(file))
        return rows, rejected, done

    def check(self, row, stroke, curve):
        for name, value in expected_row(stroke, curve, [0, 30, 60, 100]).items():
            got = float(row[name])
            # Definitions agree to rounding; where a point lies within 1e-7 of an edge it is moved.
            self.assertLess(abs(got - value), 1e-6 * (1 + abs(value)), (name, got, value, row))

    def test_every_measure_equals_its_definition(self):
        rows, rejected, _ = self.measure(self.participant())
        self.assertEqual(list(rows[0]), COLUMNS)
        self.assertEqual(rejected, [])
        self.assertEqual(len(rows), 12)
        for i, row in enumerate(rows):
            self.assertEqual([row[c] for c in COLUMNS[:12]],
                             ["p1", "", "1_0.json", "mimicry", "1", "torus", "0", str(i),
                              str(ORDER[i]), "1" if i in (5, 11) else "0",
                              "tracing" if i < 6 else "re-creating", ""])
            self.assertEqual(int(row["frames"]), sum(len(p["F"]) for p in self.strokes[i]))
            self.assertEqual((row["missed"], row["rejected"]), ("", ""))
            self.check(row, self.strokes[i], ORDER[i])
        self.assertEqual(rows[3]["pieces"], "3")

    def test_filters(self):
        backwards = [dict(p, F=p["F"][::-1]) for p in copy.deepcopy(self.strokes[0])]
        for early, late in zip(backwards[0]["F"], self.strokes[0][0]["F"]):
            early["DF"]["T"] = late["DF"]["T"]
        brief = [dict(self.strokes[1][0], F=self.strokes[1][0]["F"][:20])]
        jump = copy.deepcopy(self.strokes[2])
        jump[0]["F"][7]["DF"]["PP"]["z"] += 0.2
        strokes = [backwards, brief, jump] + self.strokes[3:]
        rows, _, _ = self.measure(self.participant(strokes=strokes))
        flags = [(r["short"], r["noisy"], r["inverted"]) for r in rows]
        self.assertEqual(flags[:4], [("0", "0", "1"), ("1", "0", "0"), ("0", "1", "0"),
                                     ("0", "0", "0")])
        for i in range(4):
            self.check(rows[i], strokes[i], ORDER[i])

    def test_orders_may_be_written_in_several_ways(self):
        want, _, _ = self.measure(self.participant())
        for order in ([ORDER], [3, 1, 0, 2, 4, 7, 5, 6, 9, 8], [[3, 1, 0, 2, 4, 7, 5, 6, 9, 8]],
                      [[ORDER]]):
            self.assertEqual(self.measure(self.participant(order=order))[0], want, order)
        parallel = self.participant(methods=[1] * 12, shapes=[0] * 12)
        self.assertEqual(self.measure(parallel)[0], want)

    def test_what_m_says_is_right(self):
        spray = [[dict(p, M="Spray") for p in stroke] for stroke in self.strokes]
        rows, rejected, done = self.measure(self.participant(
            methods=(0, 1), files={"0_0.json": self.strokes, "1_0.json": spray}))
        self.assertEqual(rejected, [])
        self.assertEqual([(r["recording"], r["method"], r["method_number"]) for r in rows],
                         [("0_0.json", "mimicry", "1")] * 12 + [("1_0.json", "spraycan", "0")] * 12)
        self.assertIn("0_0.json: holds strokes of M 'AnchorPhong'", done.stderr)

    def test_several_participants(self):
        rows, _, _ = self.measure(self.participant(), self.participant("p2"))
        self.assertEqual(list(rows[0]), COLUMNS)
        self.assertEqual([r["participant"] for r in rows], ["p1"] * 12 + ["p2"] * 12)
        again, _, _ = self.measure(self.path("p1"), self.path("p2"), more=["--threads", "1"])
        self.assertEqual(rows, again)

    def test_more_measures(self):
        rows, _, _ = self.measure(self.participant())
        same, _, done = self.measure(self.path("p1"), more=["--all"])
        self.assertEqual(same, rows)
        self.assertIn("--all is no longer needed", done.stderr)
        self.assertGreater(float(rows[0]["largest_jump"]), 1)
        self.assertEqual([r["gaps"] for r in rows], ["2" if i == 3 else "0" for i in range(12)])
        pieces, _, _ = self.measure(self.path("p1"), more=["--per-piece"])
        self.assertLess(float(pieces[3]["K_E"]), float(rows[3]["K_E"]))
        self.assertEqual(pieces[2]["K_E"], rows[2]["K_E"])

    def test_what_cannot_be_measured_is_listed_and_the_rest_goes_on(self):
        bad = copy.deepcopy(self.strokes)
        bad[0][0]["F"][4]["TI"] = 2 * CELLS * CELLS + 1
        bad[1] = []
        bad[2][0]["F"] = []
        bad[3][0]["F"][0]["DF"]["T"] = float("nan")
        bad[4][0]["F"][9]["DF"]["T"] = 0
        del bad[5][0]["F"][2]["DF"]["CU"]
        bad[6].insert(0, {"P": [], "F": [], "M": "AnchorPhong", "ModelMatrix": {"data": MATRIX}})
        bad[7][0]["ModelMatrix"] = {"data": [2 * x if 4 <= i < 8 else x
                                             for i, x in enumerate(MATRIX)]}
        for f in bad[8][0]["F"]:
            f["PT"]["z"] += 0.5
        bad[9][0]["F"][3]["DF"]["PP"]["x"] = None
        rows, rejected, done = self.measure(self.participant(strokes=bad[:11]), expect=5)
        self.assertEqual([r["index"] for r in rows], ["6", "10"])
        self.assertEqual(rows[0]["pieces"], "1")
        reasons = {int(r["index"]): r["reason"] for r in rejected}
        self.assertEqual(sorted(reasons), [0, 1, 2, 3, 4, 5, 7, 8, 9, 11])
        for index, words in {
                0: "frame 4: lies on face 200, but the mesh has 121 vertices and 200 faces",
                1: "empty", 2: "empty", 3: "the time T is not a number",
                4: "time runs backwards at frame 9", 5: "piece 0: frame 2: DF: 'CU' is missing",
                7: "uniform scale", 8: "not the mesh that was drawn on", 9: "not finite",
                11: "is missing: the file has 11 strokes"}.items():
            self.assertIn(words, reasons[index])
            self.assertIn(words, done.stderr)

    def test_missing_files_and_shapes(self):
        participant = self.participant(methods=(1, 0), shapes=(0, 1))
        os.mkdir(self.path("nobody"))
        rows, rejected, _ = self.measure(participant, self.path("nobody"), expect=5)
        self.assertEqual(len(rows), 12)
        found = {(r["participant"].split("/")[-1], r["method_number"], r["shape_number"]): r["reason"]
                 for r in rejected}
        self.assertEqual({(r["recording"], r["method"], r["shape"]) for r in rejected},
                         {("", "", ""), ("1_1.json", "mimicry", "cube"), ("0_0.json", "spraycan", "torus"),
                          ("0_1.json", "spraycan", "cube")})
        self.assertEqual(set(found), {("nobody", "", ""), ("p1", "1", "1"), ("p1", "0", "0"),
                                      ("p1", "0", "1")})
        self.assertIn("has no mesh cube.obj", found["p1", "1", "1"])
        self.assertIn("0_0.json", found["p1", "0", "0"])
        self.assertIn("study_sequence.json", found["nobody", "", ""])
        rows, rejected, _ = self.measure(self.path("nobody"), expect=3)
        self.assertEqual((rows, len(rejected)), ([], 1))

    def test_keypoints_of_given_curves(self):
        done = run("keypoints", self.path("shapes/torus.obj"), "--targets",
                   self.path("targets.json"), "--shape", "torus", "--json")
        for entry in json.loads(done.stdout)["curves"]:
            points = entry["keypoints"]
            self.assertEqual((points[0], points[-1]), (0, 100))
            self.assertEqual(points, sorted(set(points)))

    def test_published_keypoints(self):
        if not os.path.exists(os.path.join(STUDY, "targets.json")):
            self.skipTest("no study data in " + STUDY)
        with open(os.path.join(STUDY, "targets.json"), encoding="utf-8") as file:
            published = {s["name"]: s["curves"] for s in json.load(file)["shapes"]}
        equal = near = total = 0
        for shape in ("torus", "cube", "trebol"):
            done = run("keypoints", os.path.join(STUDY, shape + ".obj"), "--targets",
                       os.path.join(STUDY, "targets.json"), "--shape", shape, "--json")
            ours = json.loads(done.stdout)["curves"]
            self.assertEqual(len(ours), len(published[shape]))
            for mine, curve in zip(ours, published[shape]):
                equal += len(mine["keypoints"]) == len(curve["keypoints"])
                total += len(curve["keypoints"])
                # In parameters, of which the curves have 500; lengths: docs/study.md.
                near += sum(min(abs(k - m) for m in mine["keypoints"]) <= 5
                            for k in curve["keypoints"])
        self.assertGreaterEqual(equal, 27)
        self.assertGreaterEqual(near, 0.8 * total)

    def test_sampled_targets(self):
        out, again = self.path("t.json"), self.path("u.json")
        run("targets", "shape:sphere:6", "--count", "2", "--seed", "5", "--out", out)
        with open(self.path("t.png"), "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")
        run("targets", "shape:sphere:6", "--count", "2", "--seed", "5", "--out", again,
            "--no-picture")
        with open(out, "rb") as a, open(again, "rb") as b:
            self.assertEqual(a.read(), b.read())
        self.assertFalse(os.path.exists(self.path("u.png")))
        with open(out, encoding="utf-8") as file:
            (shape,) = json.load(file)["shapes"]
        self.assertEqual((shape["name"], len(shape["curves"])), ("sphere", 2))
        for curve in shape["curves"]:
            self.assertEqual(len(curve["face"]), 501)
            self.assertGreaterEqual(len(curve["keypoints"]), 2)
            self.assertTrue(0.05 <= curve["parameters"]["k_G"] <= 0.25)
        done = run("keypoints", "shape:sphere:6", "--targets", out, "--json")
        self.assertEqual([c["keypoints"] for c in json.loads(done.stdout)["curves"]],
                         [c["keypoints"] for c in shape["curves"]])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
