"""Reports as their readers get them: report_test.py PROGRAM REPORT_FOLDER [TEST...]."""

import base64
import csv
import html
import json
import math
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import study_cli_test as recordings

PROGRAM, SCRIPTS = sys.argv[1:3]
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
SEED = 7

MEASURES = {"D_ep_mm": 2, "D_sym_mm": 0.7, "K_E": 250, "K_g": 220, "F_g": 350, "T_h": 0.8,
            "R_h": 1.5, "T_c": 1.05, "R_c": 5, "tau_s": 4.5}


def run(*args, expect=0, **options):
    done = subprocess.run([PROGRAM, *args], capture_output=True, text=True, timeout=1800, **options)
    assert done.returncode == expect, (args, done.returncode, done.stdout, done.stderr)
    return done


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


METHODS = {"0": "spraycan", "1": "mimicry"}
SHAPES = {0: "torus", 4: "hand", 5: "fertility"}


def write_rows(path, participants=3, methods=("spraycan", "mimicry"), hostile="", former=False):
    """Rows as measure writes them: three shapes, 12 strokes each, one of them noisy. former: with the
    names of earlier versions."""
    dice = random.Random(SEED)
    numbers = {name: number for number, name in METHODS.items()}
    identity = (["method", "shape", "index", "curve", "repeat", "task"] if former else
                ["recording", "method", "method_number", "shape", "shape_number", "index", "curve",
                 "repetition", "task"])
    with open(path, "w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow([*identity, *MEASURES, "short", "noisy", "inverted", "mimicry_violation", "L_X_m",
                       "pieces", "largest_jump", "share_jumping", "gaps", "participant"])
        for person in range(participants):
            for m, method in enumerate(methods):
                for shape in (0, 4, 5):
                    for index in range(12):
                        half = index // 6
                        curve, repeat = (5 * half, 1) if index % 6 == 5 else (5 * half + index % 6, 0)
                        scale = 0.7 ** m * dice.lognormvariate(0, 0.3)
                        values = [repr(v * scale * dice.lognormvariate(0, 0.2))
                                  for v in MEASURES.values()]
                        noisy = int(person == 1 and shape == 4 and index == 3 and m == 0)
                        number = numbers.get(method, "")
                        who = ([number or method, shape] if former else
                               [f"{number or 2}_{shape}.json", method, number, SHAPES[shape], shape])
                        rows.writerow([*who, index, curve, repeat, ("tracing", "re-creating")[half],
                                       *values, 0, noisy, 0, dice.random() / 3, 0.3, 1,
                                       dice.lognormvariate(1, 1), max(0, dice.gauss(0, 0.01)), 0,
                                       f"p{person}{hostile}"])


def data_of(page):
    text = re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.S)
    return json.loads(text.group(1))


class Report(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = os.path.join(folder.name, "study")
        os.mkdir(self.folder)
        self.rows = os.path.join(self.folder, "rows.csv")

    def report(self, *more, node=False):
        """Without Node's second unless its files matter."""
        environment = dict(os.environ) if node else {"PATH": self.folder}
        done = run("report", self.folder, "--resamples", "500", *more, env=environment)
        return done, read(os.path.join(self.folder, "report.html"))

    def test_says_what_compare_says(self):
        write_rows(self.rows)
        _, page = self.report("--gallery", "0")
        ours = data_of(page)["comparisons"]
        self.assertEqual([(c["a"], c["b"]) for c in ours], [("spraycan", "mimicry")])
        same = json.loads(run("compare", self.rows, "-m", "spraycan,mimicry", "--resamples", "500",
                              "--without", "shape=torus", "--json").stdout)
        theirs = same["groups"]
        self.assertEqual(ours[0]["agreement"], same["agreement"])
        self.assertEqual([g["group"] for g in ours[0]["groups"]],
                         ["task tracing", "task re-creating", "all"])
        by_group = {g["group"]: g for g in theirs}
        for group in ours[0]["groups"]:
            self.assertEqual(group, by_group[group["group"]])
        self.assertEqual((by_group["all"]["pairs"], by_group["all"]["left_out"]), (71, 1))
        # The table itself, cell by cell, and what the paper has beside it.
        table = re.search(r'<table class="comparison">.*?</table>', page, re.S).group(0)
        cells = [[html.unescape(re.sub("<[^>]*>", "", c)) for c in re.findall("<td.*?</td>", line)]
                 for line in table.splitlines() if line.startswith("<tr><td")]
        self.assertEqual(len(cells), 30)
        for line, measure in zip(cells, ours[0]["groups"][0]["measures"]):
            for at, side in ((1, "a"), (2, "b")):
                mean, deviation = line[at].split(" ± ")
                for text, value in ((mean, "mean"), (deviation, "standard_deviation")):
                    half_a_digit = 0.5 * 10.0 ** -len(text.partition(".")[2])
                    self.assertLessEqual(abs(float(text) - measure[side][value]),
                                         1.0001 * half_a_digit)
            self.assertAlmostEqual(float(line[3].replace("\u2212", "-")), measure["z"], delta=0.0051)
        plain = [[c.rstrip(" ✓✗") for c in line] for line in cells]
        self.assertEqual(plain[0][-4:], ["2.31 ± 2.64", "1.13 ± 1.11", "8.36", "<.001"])
        self.assertEqual(plain[11][-4:], ["0.75 ± 0.65", "1.12 ± 11.51", "0.55", ">.05"])
        self.assertEqual(cells[21][-1], "")
        # What agrees with the paper, by the rule as a reader would apply it to the table.
        count = {"rows": 0, "means": 0, "differences": 0}
        measures = [m for g in ours[0]["groups"][:2] for m in g["measures"]]
        for line, measure in zip(cells, measures):
            near = [abs(measure[side]["mean"] - float(line[at].split(" ± ")[0])) <=
                    0.25 * float(line[at].split(" ± ")[0]) for side, at in (("a", -4), ("b", -3))]
            z = float(line[-2].replace("\u2212", "-"))
            found = not line[-1].startswith(">")
            difference = (measure["p"] < 0.05) == found and (not found or measure["z"] * z > 0)
            self.assertEqual([c[-1] for c in (line[-4], line[-3], line[-1])],
                             ["✓" if yes else "✗" for yes in (*near, difference)], line)
            self.assertEqual(measure["paper"]["agrees"]["means"], all(near))
            self.assertEqual(measure["paper"]["agrees"]["difference"], difference)
            self.assertEqual(measure["paper"]["z"], z)
            count["rows"] += 1
            count["means"] += all(near)
            count["differences"] += difference
        self.assertEqual(ours[0]["agreement"], count)
        self.assertTrue(0 < count["means"] < 20 and 0 < count["differences"] < 20, count)
        self.assertIn(f"in {count['means']} of 20 rows", page)
        self.assertNotIn("paper", by_group["all"]["measures"][0])
        for line in table.splitlines():
            if line.startswith("<tr><td"):
                p = re.findall("<td.*?</td>", line)[4]
                value = html.unescape(re.sub("<[^>]*>", "", p))
                self.assertEqual("<b>" in p, value.startswith("<") or float(value) < 0.05, line)

    def test_numbers_of_the_plots(self):
        write_rows(self.rows)
        _, page = self.report("--gallery", "0")
        data = data_of(page)
        self.assertEqual((data["tasks"], data["shapes"]),
                         (["tracing", "re-creating"], ["hand", "fertility"]))
        with open(self.rows, encoding="utf-8") as file:
            rows = [r for r in csv.DictReader(file) if r["shape"] != "torus" and r["noisy"] == "0"]
        for box in data["by_shape"]:
            values = sorted(float(r[box["measure"]]) for r in rows
                            if (r["shape"], r["method"]) == (box["group"], box["method"]))
            self.assertEqual(box["strokes"], len(values))
            n = len(values)
            middle = (values[(n - 1) // 2] + values[n // 2]) / 2
            self.assertAlmostEqual(box["median"] / middle, 1, 4)
            self.assertAlmostEqual(box["mean"] / (sum(values) / n), 1, 4)
        plot = data["scatter"][0]["plots"][0]
        self.assertEqual((plot["measure"], len(plot["points"])), ("K_E", 71))
        # Changes of repeats: none of these is five deviations off.
        mine = [r for r in rows if r["method"] == "mimicry"]
        key = lambda r: (r["participant"], r["shape"], r["task"], r["curve"])
        first = {key(r): float(r["F_g"]) for r in mine if r["repetition"] == "0"}
        changes = [abs(first[key(r)] - float(r["F_g"])) / first[key(r)]
                   for r in mine if r["repetition"] == "1"]
        self.assertRegex(page, r"</span>mimicry</td>.*<td>12</td><td>[\d.]+ %%</td><td>%.1f %%</td>"
                         % (100 * sum(changes) / len(changes)))
        # The line goes through the mean of the logarithms.
        x = sum(math.log10(p["x"]) for p in plot["points"]) / 71
        y = sum(math.log10(p["y"]) for p in plot["points"]) / 71
        self.assertAlmostEqual(plot["line"]["intercept"] + plot["line"]["slope"] * x, y, 4)

    def test_files(self):
        write_rows(self.rows, participants=2)
        done, page = self.report("--gallery", "0", node=True)
        names = sorted(os.listdir(os.path.join(self.folder, "figures")))
        if shutil.which("node") is None:
            self.assertIn("node", done.stderr)
            self.skipTest("node is absent")
        ids = re.findall('data-figure="([a-z-]*)"', page)
        self.assertEqual(ids, ["scatter-spraycan-mimicry", "boxes", "shapes"])
        self.assertEqual(names, sorted(["data.json"] + [i + e for i in ids for e in (".svg", ".png")]))
        for i in ids:
            path = os.path.join(self.folder, "figures", i)
            root = xml.etree.ElementTree.parse(path + ".svg").getroot()
            self.assertTrue(root.tag.endswith("svg"))
            texts = ["".join(t.itertext()) for t in root.iter() if t.tag.endswith("}text")]
            self.assertTrue(any("rad/m" in t for t in texts), texts)
            with open(path + ".png", "rb") as file:
                head = file.read(24)
            self.assertEqual(head[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual(int.from_bytes(head[16:20], "big"),
                             2 * int(float(root.get("width"))))

    def test_page_without_node(self):
        write_rows(self.rows, participants=1)
        done, page = self.report("--gallery", "0")
        self.assertIn("node", done.stderr)
        self.assertIn('data-figure="boxes"', page)
        self.assertEqual(os.listdir(os.path.join(self.folder, "figures")), ["data.json"])

    def test_opens_in_a_browser(self):
        if CHROMIUM is None or not os.path.isdir(os.path.join(SCRIPTS, "node_modules")):
            self.skipTest("chromium or the npm packages of report/ are absent")
        # Names that would leave their place in the page.
        write_rows(self.rows, hostile="</script><b>\"&'", methods=("spraycan", "a-technique", "z"))
        with open(os.path.join(self.folder, "rows.rejected.csv"), "w", encoding="utf-8") as file:
            file.write("participant,method,shape,index,reason\np9,0,4,3,<i>face 9</i>\n")
        _, page = self.report("--gallery", "0", "--title", "<Study>")
        self.assertNotRegex(page, r'(src|href)="(?!#|data:)')
        done = subprocess.run(["node", os.path.join(SCRIPTS, "test", "open_page.mjs"), CHROMIUM,
                               os.path.join(self.folder, "report.html")],
                              capture_output=True, text=True, timeout=1800, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        seen = json.loads(done.stdout)
        self.assertEqual((seen["drawn"], seen["errors"]), ("yes", []))
        self.assertEqual([u for u in seen["requests"] if not u.startswith("file:")], [])
        self.assertEqual(len(seen["requests"]), 1, seen["requests"])
        self.assertEqual(len(seen["plots"]), 4)
        for plot in seen["plots"]:
            self.assertGreater(plot["marks"], 20, plot)
        self.assertLessEqual(seen["overflow"], 0)
        self.assertTrue(seen["saved"].endswith(".svg"))
        self.assertIn("&lt;i&gt;face 9", page)

    def test_says_that_strokes_are_simulated(self):
        def marked(every, mark="mimicry 0.1.0 seed 3"):
            write_rows(self.rows)
            with open(self.rows, encoding="utf-8", newline="") as file:
                head, *rows = csv.reader(file)
            with open(self.rows, "w", encoding="utf-8", newline="") as file:
                csv.writer(file, lineterminator="\n").writerows(
                    [[*head, "simulated"],
                     *([*row, mark if i % every == 0 else ""] for i, row in enumerate(rows))])
            return self.report("--gallery", "0")[1]

        write_rows(self.rows)
        self.assertNotIn('id="simulated"', self.report("--gallery", "0")[1])
        notice = re.search('<p class="notice" id="simulated">.*?</p>', marked(1)).group(0)
        self.assertIn("No person drew these strokes: they are made by mimicry 0.1.0 seed 3.", notice)
        notice = re.search('<p class="notice" id="simulated">.*?</p>', marked(2, "<x>")).group(0)
        self.assertIn("72 of 144 strokes were drawn by no person: they are made by &lt;x&gt;.", notice)

    def test_participants_are_tested_beside_their_strokes(self):
        write_rows(self.rows, participants=8)
        _, page = self.report("--gallery", "0")
        group = data_of(page)["comparisons"][0]["groups"][0]
        self.assertEqual(group["group"], "task tracing")
        with open(self.rows, encoding="utf-8") as file:
            rows = [r for r in csv.DictReader(file)
                    if r["shape"] != "torus" and r["task"] == "tracing"
                    and (r["participant"], r["shape"], r["index"]) != ("p1", "hand", "3")]
        table = re.search(r'<table class="comparison">.*?</table>', page, re.S).group(0)
        cells = [[html.unescape(re.sub("<[^>]*>", "", c)) for c in re.findall("<td.*?</td>", line)]
                 for line in table.splitlines() if line.startswith("<tr><td")]
        for line, measure in zip(cells, group["measures"]):
            means = {}
            for r in rows:
                means.setdefault((r["participant"], r["method"]), []).append(float(r[measure["measure"]]))
            differences = sorted((sum(means[p, m]) / len(means[p, m])
                                  - sum(means[p, "mimicry"]) / len(means[p, "mimicry"])
                                  for p, m in means if m == "spraycan"), key=abs)
            # Counted over all 2^8 signs.
            plus = sum(i + 1 for i, d in enumerate(differences) if d > 0)
            sums = [sum(i + 1 for i in range(8) if s >> i & 1) for s in range(256)]
            low = min(plus, 36 - plus)
            p = min(1, 2 * sum(w <= low for w in sums) / 256)
            self.assertEqual(measure["participants"]["count"], 8)
            self.assertAlmostEqual(measure["participants"]["p"], p, places=12)
            self.assertAlmostEqual(float(line[6]), p, delta=0.00051)
        self.assertIn("of 8 participants", table)
        compared = run("compare", self.rows, "-m", "spraycan,mimicry", "--resamples", "500").stdout
        self.assertIn("p by participant", compared)
        self.assertIn("95 pairs, 1 left out (rejected or filtered), 8 participants",
                      run("compare", self.rows, "-m", "spraycan,mimicry", "--resamples", "500",
                          "--without", "shape=0").stdout.replace("task tracing: ", ""))

    def test_bold_rows_whose_interval_spans_zero_are_explained(self):
        def page_of(largest):
            """Most pairs differ by 1 in the same direction, one by much in the other."""
            with open(self.rows, "w", encoding="utf-8") as file:
                print("method,participant,shape,curve,K_E,D_ep_mm", file=file)
                for i in range(40):
                    print("spraycan", "p", "cube", i, 100, 5 + 0.01 * i, sep=",", file=file)
                    print("mimicry", "p", "cube", i, 99 - 0.01 * i + (largest if i == 7 else 0), 5,
                          sep=",", file=file)
            return self.report("--gallery", "0")[1]

        note = re.search('<p id="spanning-zero">.*?</p>', page_of(200)).group(0)
        self.assertIn("spans 0: K<sub>E</sub> (all strokes).", note)
        self.assertNotIn('id="spanning-zero"', page_of(0))

    def test_names_of_measures_are_typeset_alike(self):
        write_rows(self.rows, participants=1)
        if shutil.which("node") is None:
            self.skipTest("node is absent")
        _, page = self.report("--gallery", "0", node=True)
        self.assertIn("K<sub>E</sub>", page)
        for name in ("boxes", "shapes", "scatter-spraycan-mimicry"):
            root = xml.etree.ElementTree.parse(
                os.path.join(self.folder, "figures", name + ".svg")).getroot()
            texts = [t for t in root.iter() if t.tag.endswith("}text")]
            named = [t for t in texts if "".join(t.itertext()).startswith("KE (rad/m)")]
            self.assertEqual([len(named), [c.text for c in named[0]]], [1, ["E", " (rad/m)" if
                             name != "scatter-spraycan-mimicry" else named[0][1].text]])
            self.assertFalse([t.text for t in texts if "_" in "".join(t.itertext())])

    def test_rows_of_earlier_versions_give_the_same_page(self):
        write_rows(self.rows)
        _, page = self.report("--gallery", "0")
        write_rows(self.rows, former=True)
        done, former = self.report("--gallery", "0")
        self.assertEqual(former, page)
        self.assertIn("rows.csv: is of an earlier version; its column 'repeat'", done.stderr)

    def test_what_is_left_out(self):
        write_rows(self.rows)
        _, page = self.report("--gallery", "0")
        table = re.search('<table id="rejected">.*?</table>', page, re.S).group(0)
        self.assertEqual(table.count("<tr><td"), 1)
        self.assertRegex(table, "p1</td>.*spraycan.*hand.*noisy")
        self.assertIn("The tutorial's 72 strokes are left out", page)
        _, page = self.report("--gallery", "0", "--keep-tutorial")
        self.assertEqual(data_of(page)["shapes"], ["torus", "hand", "fertility"])

    def test_one_technique(self):
        write_rows(self.rows, methods=("mimicry",))
        _, page = self.report("--gallery", "0")
        self.assertIn("nothing to compare", page)
        self.assertEqual(data_of(page)["scatter"], [])

    def test_points_have_a_colour_where_rows_have_no_task(self):
        with open(self.rows, "w", encoding="utf-8") as file:
            print("participant,stroke,method,shape,index,K_E,D_ep_mm", file=file)
            for i in range(8):
                for m, method in enumerate(("spraycan", "mimicry")):
                    print("strokes.json", i, method, "cube", i, 100 + i * (m + 1), 5 + i, sep=",",
                          file=file)
        data = data_of(self.report("--gallery", "0")[1])
        points = data["scatter"][0]["plots"][0]["points"]
        self.assertEqual(len(points), 8)
        self.assertLessEqual({p["task"] for p in points}, set(data["tasks"]))

    def test_pictures_of_strokes(self):
        run("simulate", "shape:cube", "-o", os.path.join(self.folder, "strokes.json"))
        strokes = json.loads(read(os.path.join(self.folder, "strokes.json")))["strokes"]
        with open(self.rows, "w", encoding="utf-8") as file:
            print("participant,stroke,method,shape,index,K_E,D_ep_mm", file=file)
            for i, stroke in enumerate(strokes):
                for m, method in enumerate(("spraycan", "anchored-closest")):
                    print("strokes.json", stroke["id"], method, "cube", i, 100, 5 + i - m, sep=",",
                          file=file)
            print("strokes.json,none,spraycan,cube,3,1,99", file=file)
        _, page = self.report("--gallery", "1")
        self.assertRegex(page, "spraycan, strokes.json, none, cube: .* has no sound stroke 3")
        images = [base64.b64decode(i) for i in re.findall('src="data:image/png;base64,([^"]*)"', page)]
        captions = re.findall("<figcaption>.*?</figcaption>", page)
        self.assertEqual([re.sub("<[^>]*>", "", c) for c in captions],
                         [f"Dep {5 + i - m}.00 mm: strokes.json, {strokes[i]['id']}, cube"
                          for m, i in ((0, 0), (1, 2), (1, 0))])
        names = ["spraycan-best-1", "anchored-closest-worst-1", "anchored-closest-best-1"]
        for image, name in zip(images, names):
            self.assertEqual(image[:8], b"\x89PNG\r\n\x1a\n")
            with open(os.path.join(self.folder, "figures", name + ".png"), "rb") as file:
                self.assertEqual(file.read(), image)
        self.assertEqual(len(set(images)), 3)

    def test_measured_study(self):
        """From recordings to the page; one stroke cannot be read."""
        def write(name, content):
            os.makedirs(os.path.dirname(os.path.join(self.folder, name)), exist_ok=True)
            with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
                file.write(content if isinstance(content, str) else json.dumps(content))

        write("shapes/torus.obj", recordings.plate_obj())
        located = [[recordings.locate(x, y) for x, y in recordings.target_points(c)]
                   for c in range(10)]
        write("targets.json", {"shapes": [{"name": "torus", "scale": recordings.SCALE, "curves": [
            {"face": [f for f, _ in points], "bary": [b for _, b in points],
             "keypoints": [0, 30, 60, 100]} for points in located]}]})
        dice = random.Random(SEED)
        for person in ("p1", "p2"):
            write(f"{person}/study_sequence.json", {"MethodSequence": [0, 1], "ShapeSequence": [0],
                                                    "StrokeSequence": recordings.ORDER})
            for method, word in enumerate(("Spray", "AnchorPhong")):
                strokes = [recordings.drawn_stroke(dice, c, word) for c in recordings.ORDER]
                if (person, method) == ("p2", 1):
                    strokes[4] = []
                write(f"{person}/{method}_0.json", strokes)
        where = ("--shapes", os.path.join(self.folder, "shapes"), "--targets",
                 os.path.join(self.folder, "targets.json"))
        run("measure", os.path.join(self.folder, "p1"), os.path.join(self.folder, "p2"), *where,
            "--out", self.rows, expect=5)
        done, page = self.report("--keep-tutorial", "--gallery", "2", *where)
        self.assertEqual(page.count('src="data:image/png;base64,'), 8)
        self.assertNotIn("without a picture", page)
        self.assertNotIn("no pictures", done.stderr)
        self.assertIn("47 measured strokes of 2 participants", page)
        table = re.search('<table id="rejected">.*?</table>', page, re.S).group(0)
        self.assertRegex(table, "p2</td>.*mimicry.*torus.*<td>4</td>")
        self.assertIn('id="jumps"', page)

    def test_replayed_strokes_are_found(self):
        """In their place, in a study that was moved, and not where they are gone."""
        study = os.path.join(self.folder, "study")
        os.makedirs(os.path.join(study, "recorded"))
        strokes = os.path.join(study, "recorded", "strokes.json")
        run("simulate", "shape:cube:20", "--rate", "30", "-o", strokes)
        run("replay", "--strokes", strokes, "--mesh", "shape:cube:20", "-t",
            "spraycan,anchored-closest", "-o", os.path.join(study, "replay"))

        def pictures(folder):
            done = run("report", folder, "--gallery", "1", "--resamples", "500",
                       env={"PATH": self.folder})
            page = read(os.path.join(folder, "report.html"))
            return re.findall('src="data:image/png;base64,([^"]*)"', page), page, done.stderr

        images, page, _ = pictures(os.path.join(study, "replay"))
        self.assertEqual(len(images), 4)
        self.assertNotIn("without a picture", page)
        moved = os.path.join(self.folder, "moved")
        os.rename(study, moved)
        self.assertEqual(pictures(os.path.join(moved, "replay"))[0], images)
        os.remove(os.path.join(moved, "recorded", "strokes.json"))
        images, page, said = pictures(os.path.join(moved, "replay"))
        self.assertEqual(images, [])
        self.assertIn(strokes + ": is no longer where it was replayed from", said)
        self.assertIn("4 strokes without a picture", page)
        with open(os.path.join(moved, "replay", "replay.json"), "w", encoding="utf-8") as file:
            file.write("{}")
        self.assertIn("is no settings of mimicry replay",
                      run("report", os.path.join(moved, "replay"), expect=3).stderr)

    def test_replayed_participants_are_found(self):
        os.makedirs(os.path.join(self.folder, "shapes"))
        shape = os.path.join(self.folder, "shapes", "cube.obj")
        run("shapes", "cube", "--resolution", "10", "--out", shape)
        targets = os.path.join(self.folder, "targets.json")
        run("targets", shape, "--count", "2", "--seed", "3", "--no-picture", "--out", targets)
        people = os.path.join(self.folder, "people")
        where = ("--shapes", os.path.join(self.folder, "shapes"), "--targets", targets)
        run("participants", *where, "--count", "2", "--rate", "30", "-t",
            "spraycan,anchored-closest", "-o", people)
        out = os.path.join(self.folder, "again")
        run("replay", "--strokes", os.path.join(people, "p00"), os.path.join(people, "p01"), *where,
            "-t", "spraycan,anchored-closest", "-o", out)
        run("report", out, "--gallery", "1", "--resamples", "500", env={"PATH": self.folder})
        page = read(os.path.join(out, "report.html"))
        self.assertEqual(page.count('src="data:image/png;base64,'), 4)
        self.assertNotIn("without a picture", page)

    def test_no_recordings(self):
        write_rows(self.rows, participants=1)
        done, page = self.report("--gallery", "1")
        self.assertIn("--recordings", done.stderr)
        self.assertIn("4 strokes without a picture", page)

    def test_errors(self):
        def fails(expect, *words, folder=self.folder, more=()):
            text = run("report", folder, *more, expect=expect).stderr
            for word in words:
                self.assertIn(word, text)

        fails(4, "no-such", "is no folder", folder=os.path.join(self.folder, "no-such"))
        fails(4, "has no rows.csv", "mimicry measure")
        for text, words in (("a,b\n1,2\n", "no column 'method'"),
                            ("method,K_E\n", "no rows"),
                            ("method,x\n0,1\n", "none of the paper's measures"),
                            ("method,K_E,participant,shape,task\n0,1,p,0,tracing\n", "--keep-tutorial"),
                            ("method,K_E\n0,1,2\n", "line 2")):
            with open(self.rows, "w", encoding="utf-8") as file:
                file.write(text)
            fails(3, "rows.csv", words)
        self.assertEqual(os.listdir(self.folder), ["rows.csv"])
        write_rows(self.rows, participants=1)
        fails(3, "'snap'", "spraycan, mimicry", more=("-m", "spraycan,snap"))
        fails(3, "no column 'nope'", more=("--gallery-by", "nope"))


if __name__ == "__main__":
    if "without plots" in subprocess.run([PROGRAM, "report", "--help"], capture_output=True, text=True,
                                         check=False).stdout:
        print("skipped: the program was built without plots (scripts/setup, then build again)")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
