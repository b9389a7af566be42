"""The study laboratory as its users run it: lab_cli_test.py PROGRAM STUDY_DATA."""

import csv
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM, STUDY = sys.argv[1:3]


def run(*args, expect=0, **options):
    done = subprocess.run([PROGRAM, *args], capture_output=True, text=True, timeout=1800, **options)
    assert done.returncode == expect, (args, done.returncode, done.stdout, done.stderr)
    return done


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, *names):
        return os.path.join(self.folder.name, *names)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)


class Compare(Folder):
    def rows(self, pairs, seed=1):
        """One measure with ties and zeros (rounded), one without, one that hardly differs."""
        dice = random.Random(seed)
        lines = ["method,shape,curve,task,rounded,smooth,same"]
        for i in range(pairs):
            a, b = dice.lognormvariate(1, 0.8), dice.lognormvariate(0.8, 0.8)
            for method, x in (("a", a), ("b", b)):
                lines.append(f"{method},bunny,{i},{'one' if i % 2 else 'two'},{round(x)},{x!r},"
                             f"{dice.gauss(0, 1)!r}")
        return self.write("rows.csv", "\n".join(lines) + "\n"), lines

    def test_equals_r(self):
        rscript = shutil.which("Rscript")
        if rscript is None:
            self.skipTest("Rscript (package r-base-core) is absent")
        for pairs, continuity in ((12, False), (12, True), (200, False), (200, True)):
            rows, lines = self.rows(pairs, seed=pairs)
            extra = ["--continuity"] if continuity else []
            ours = json.loads(run("compare", rows, "--methods", "a,b", "--measures",
                                  "rounded,smooth,same", "--json", *extra).stdout)
            whole = ours["groups"][-1]
            self.assertEqual((whole["group"], whole["pairs"]), ("all", pairs))
            script = f"""
                d <- read.csv('{rows}'); a <- d[d$method == 'a',]; b <- d[d$method == 'b',]
                p <- c()
                for (m in c('rounded', 'smooth', 'same')) {{
                  t <- suppressWarnings(wilcox.test(a[[m]], b[[m]], paired=TRUE, exact=FALSE,
                                                    correct={'TRUE' if continuity else 'FALSE'}))
                  best <- suppressWarnings(wilcox.test(a[[m]], b[[m]], paired=TRUE,
                                                    correct={'TRUE' if continuity else 'FALSE'}))
                  p <- c(p, best$p.value)
                  cat(m, t$statistic, format(t$p.value, digits=15), format(best$p.value, digits=15),
                      format(mean(a[[m]]), digits=15), format(sd(b[[m]]), digits=15), '\\n')
                }}
                cat(format(p.adjust(p, 'holm'), digits=15), '\\n')"""
            theirs = subprocess.run([rscript, "-e", script], capture_output=True, text=True,
                                    timeout=1800, check=True).stdout.splitlines()
            for measure, line in zip(whole["measures"], theirs):
                name, v, p_normal, p, mean, sd = line.split()
                self.assertEqual(measure["measure"], name)
                self.assertEqual(measure["w_plus"], float(v), name)
                self.assertAlmostEqual(measure["p_normal"] / float(p_normal), 1, 9, name)
                self.assertAlmostEqual(measure["p"] / float(p), 1, 9, name)
                self.assertAlmostEqual(measure["a"]["mean"], float(mean), 12)
                self.assertAlmostEqual(measure["b"]["standard_deviation"], float(sd), 12)
            for measure, p in zip(whole["measures"], theirs[3].split()):
                self.assertAlmostEqual(measure["p_holm"] / float(p), 1, 9)

    def test_pairs_whatever_the_order(self):
        rows, lines = self.rows(30)
        body = lines[1:]
        random.Random(3).shuffle(body)
        shuffled = self.write("shuffled.csv", "\n".join(lines[:1] + body) + "\n")
        known = ("--methods", "a,b", "--measures", "smooth")
        tables = [run("compare", rows, *known), run("compare", shuffled, *known)]
        self.assertIn("all: 30 pairs", tables[0].stdout)
        self.assertIn("task one: 15 pairs", tables[0].stdout)
        z = [[g["measures"][0]["z"] for g in json.loads(run("compare", f, *known, "--json").stdout)
              ["groups"]] for f in (rows, shuffled)]
        self.assertEqual(z[0], z[1])

    def test_says_what_agrees_with_the_paper(self):
        rows = ["method,curve,task,K_E,T_c,nonsense"]
        for i in range(40):
            rows += [f"0,{i},tracing,{280 + i},1.05,1", f"1,{i},tracing,{100 + i / 2},1.0,{i}"]
        file = self.write("rows.csv", "\n".join(rows) + "\n")
        # There is one task only: no group is called by it, and nothing is set beside the paper.
        self.assertNotIn("paper", run("compare", file, "-m", "0,1").stdout)
        rows += ["0,1,re-creating,254,1,1", "1,1,re-creating,155,1.1,1"]
        file = self.write("rows.csv", "\n".join(rows) + "\n")
        done = run("compare", file, "-m", "0,1", "--measures", "K_E,T_c,nonsense").stdout
        first = {line.split()[0]: line.split()[-2:] for line in done.split("task tracing")[1]
                 .split("\n\n")[0].splitlines() if line.startswith(("K_E", "T_c"))}
        self.assertEqual(first, {"K_E": ["no", "yes"], "T_c": ["yes", "no"]})
        self.assertIn("both means within 25 % of the paper's in 3 of 4 rows", done)
        data = json.loads(run("compare", file, "-m", "0,1", "--json").stdout)
        self.assertEqual(data["agreement"], {"rows": 4, "means": 3, "differences": 1})
        agrees = data["groups"][1]["measures"][0]["paper"]["agrees"]
        self.assertEqual(agrees, {"a": True, "b": False, "means": False, "sign": True,
                                  "significance": True, "difference": True})
        self.assertNotIn("agreement", json.loads(run("compare", file, "-m", "1,0", "--json").stdout))

    def test_what_failed_is_left_out(self):
        rows = self.write("r.csv", "method,curve,D_ep_mm,short,rejected\n"
                          "0,0,1,0,\n1,0,2,0,\n0,1,1,1,\n1,1,5,0,\n0,2,,0,empty stroke\n1,2,3,0,\n"
                          "0,3,4,0,\n")
        group = json.loads(run("compare", rows, "-m", "spraycan,mimicry", "--json").stdout)["groups"]
        self.assertEqual([(g["group"], g["pairs"], g["left_out"], g["unpaired"]) for g in group],
                         [("all", 1, 2, 1)])
        kept = json.loads(run("compare", rows, "-m", "0,1", "--keep-failed", "--json").stdout)
        self.assertEqual(kept["groups"][0]["measures"][0]["pairs"], 2)

    def test_errors(self):
        rows, _ = self.rows(3)
        self.assertEqual(run("compare", rows, "-m", "a,b", "--measures", "same").stderr, "")
        former = run("compare", self.write("o.csv", "method,curve,repeat,K_E\n0,7,0,1\n1,7,0,2\n"),
                     "-m", "spraycan,mimicry")
        self.assertIn("all: 1 pairs", former.stdout)
        self.assertIn("o.csv: is of an earlier version; its column 'repeat'", former.stderr)
        self.assertIn("'c', only of a, b",
                      run("compare", rows, "-m", "a,c", "--measures", "same", expect=3).stderr)
        self.assertIn("no column 'K_E'",
                      run("compare", rows, "-m", "a,b", "--measures", "K_E", expect=3).stderr)
        self.assertIn("--measures", run("compare", rows, "-m", "a,b", expect=3).stderr)
        twice = self.write("t.csv", "method,curve,K_E\na,7,1\na,7,2\nb,7,2\n")
        self.assertIn("curve 7", run("compare", twice, "-m", "a,b", expect=3).stderr)
        self.assertIn("line 2", run("compare", self.write("u.csv", "method,K_E\na\n"), "-m", "a,b",
                                    expect=3).stderr)


class Replay(Folder):
    """Recorded strokes through techniques, on coarse built-in shapes."""

    TECHNIQUES = "anchored-closest,mimicry-live,spraycan"

    def strokes(self, count=3):
        file = self.path("s.json")
        run("simulate", "shape:torus:24", "--rate", "30", "--count", str(count), "--out", file)
        return file

    def replay(self, out, *args, expect=0):
        return run("replay", "--out", self.path(out), "-t", self.TECHNIQUES, *args, expect=expect)

    def rows(self, out):
        with open(self.path(out, "rows.csv"), newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def read(self, *names):
        with open(self.path(*names), "rb") as file:
            return file.read()

    def test_one_row_a_stroke_and_technique(self):
        file = self.strokes()
        done = self.replay("a", "--strokes", file, "--mesh", "shape:torus:24")
        rows = self.rows("a")
        with open(file, encoding="utf-8") as f:
            ids = [s["id"] for s in json.load(f)["strokes"]]
        self.assertEqual([(r["stroke"], r["method"]) for r in rows],
                         [(i, t) for i in ids for t in self.TECHNIQUES.split(",")])
        self.assertIn(f"{3 * len(ids)} rows, 0 of them rejected", done.stdout)
        lines = [json.loads(line) for line in self.read("a", "rows.jsonl").splitlines()]
        self.assertEqual(len(lines), len(rows))
        for line, row in zip(lines, rows):
            self.assertEqual(list(line), list(row))
            self.assertEqual(line["D_ep_mm"], float(row["D_ep_mm"]))
            self.assertTrue(0.1 < line["D_ep_mm"] < 200, row)
        compared = run("compare", self.path("a", "rows.csv"), "-m", "anchored-closest,mimicry-live",
                       "--json")
        self.assertEqual(json.loads(compared.stdout)["groups"][0]["pairs"], len(ids))

    def test_same_bytes_whatever_the_threads(self):
        file = self.strokes()
        for out, threads in (("a", "1"), ("b", "2"), ("c", "5")):
            self.replay(out, "--strokes", file, "--mesh", "shape:torus:24", "--threads", threads)
        for name in ("rows.csv", "rows.jsonl"):
            self.assertEqual(self.read("a", name), self.read("b", name))
            self.assertEqual(self.read("a", name), self.read("c", name))

    def test_killed_runs_go_on_and_lose_or_double_nothing(self):
        file = self.strokes(16)
        known = ["--strokes", file, "--mesh", "shape:torus:24", "--threads", "1"]
        self.replay("whole", *known)
        command = [PROGRAM, "replay", "--out", self.path("cut"), "-t", self.TECHNIQUES, *known]
        def written():
            try:
                return sum(entry.stat().st_size for entry in os.scandir(self.path("cut")))
            except FileNotFoundError:  # no folder yet, or a file that was renamed just now
                return 0

        kills = 0
        for _ in range(6):
            before = written()
            process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            while process.poll() is None and written() <= before:  # it has come further
                time.sleep(0.002)
            if process.poll() is None:
                process.kill()
                kills += 1
            process.wait()
        self.assertGreater(kills, 0)
        self.replay("cut", *known)
        for name in ("rows.csv", "rows.jsonl"):
            self.assertEqual(self.read("whole", name), self.read("cut", name), name)

    def test_whatever_was_written_last_is_cut_to_whole_jobs(self):
        file = self.strokes()
        known = ["--strokes", file, "--mesh", "shape:torus:24"]
        self.replay("whole", *known)
        journal = self.read("whole", "rows.journal")
        for part in (0, 10, len(journal) // 2, len(journal) - 1):
            shutil.copytree(self.path("whole"), self.path(f"p{part}"))
            with open(self.path(f"p{part}", "rows.journal"), "wb") as f:
                f.write(journal[:part])
            self.replay(f"p{part}", *known)
            for name in ("rows.csv", "rows.jsonl"):
                self.assertEqual(self.read("whole", name), self.read(f"p{part}", name), part)
        self.assertIn("other strokes", self.replay("whole", "--strokes", file, expect=3).stderr)

    def test_bad_strokes_are_rejected_with_reasons_and_the_rest_goes_on(self):
        with open(self.strokes(1), encoding="utf-8") as f:
            data = json.load(f)
        good = json.dumps(data["strokes"][0])
        bad = [json.loads(good) for _ in range(5)]
        bad[0]["frames"] = []
        bad[1]["frames"][3]["time_s"] = -5
        bad[2]["target"] = "donut"
        del bad[3]["intended"]
        bad[4]["intended"]["face"][0] = 999999
        data["strokes"] = [json.loads(good), *bad, json.loads(good)]
        file = self.write("bad.json", json.dumps(data))
        shapes = self.path("shapes")
        os.mkdir(shapes)
        run("shapes", "torus", "--resolution", "24", "--out", os.path.join(shapes, "torus.ply"))
        done = self.replay("o", "--strokes", file, "--shapes", shapes, expect=5)
        rows = self.rows("o")
        self.assertEqual(len(rows), 21)
        reasons = [r["rejected"] for r in rows[::3]]
        for reason, word in zip(reasons, ["", "empty", "frame 3", "donut", "no intended", "999999",
                                          ""]):
            self.assertIn(word, reason)
            self.assertEqual(word == "", reason == "")
        self.assertIn("vertices", reasons[5])
        self.assertIn("stroke 1", done.stderr)
        self.assertIn("21 rows, 15 of them rejected", done.stdout)
        cut = self.write("cut.json", json.dumps(data)[:-20000])
        self.replay("c", "--strokes", cut, "--shapes", shapes, expect=5)
        self.assertIn("ends early", self.rows("c")[-1]["rejected"])
        self.assertIn("there", self.replay("n", "--strokes", self.path("none"), expect=4).stderr)
        self.replay("e", "--strokes", self.write("e.json", "{}"), expect=3)


class Participants(Folder):
    def targets(self):
        """Curves of the torus as a file of targets."""
        run("simulate", "shape:torus", "--rate", "30", "--out", self.path("s.json"))
        with open(self.path("s.json"), encoding="utf-8") as file:
            curves = [s["intended"] for s in json.load(file)["strokes"]]
        shape = {"name": "torus", "scale": 0.4, "curves":
                 [{"face": c["face"], "bary": c["bary"]} for c in curves[:2]]}
        return self.write("t.json", json.dumps({"shapes": [shape]}))

    def test_protocol_recordings_and_replay(self):
        targets = self.targets()
        known = ["--targets", targets, "--count", "3", "--rate", "30", "-t",
                 "spraycan,anchored-closest"]
        for out, threads in (("a", "1"), ("b", "2")):
            run("participants", *known, "--out", self.path(out), "--threads", threads)
        for person in ("p00", "p01", "p02"):
            self.assertEqual(sorted(os.listdir(self.path("a", person))),
                             ["0_0.json", "2_0.json", "study_sequence.json"])
            for name in os.listdir(self.path("a", person)):
                with open(self.path("a", person, name), "rb") as a, \
                        open(self.path("b", person, name), "rb") as b:
                    self.assertEqual(a.read(), b.read(), name)
        with open(self.path("a", "p01", "study_sequence.json"), encoding="utf-8") as file:
            sequence = json.load(file)
        self.assertEqual(sequence["MethodSequence"], [2, 0])
        with open(self.path("a", "p00", "0_0.json"), encoding="utf-8") as file:
            strokes = json.load(file)
        self.assertEqual(len(strokes), 4)
        piece = strokes[0][0]
        self.assertEqual(piece["M"], "Spray")
        version = run("--version").stdout.strip()
        self.assertEqual({json.dumps(p["Simulated"]) for s in strokes for p in s}, {json.dumps(
            {"program": "mimicry " + version, "seed": 1, "technique": "spraycan"})})
        self.assertEqual(set(piece["F"][0]["DF"]), {"T", "HP", "PP", "HU", "HF", "CU", "CF", "SD"})
        times = [f["DF"]["T"] for s in strokes for p in s for f in p["F"]]
        self.assertEqual(times, sorted(times))

        run("replay", "--strokes", self.path("a", "p00"), self.path("a", "p01"), "--targets",
            targets, "-t", "spraycan,snap", "--out", self.path("o"))
        with open(self.path("o", "rows.csv"), newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 2 * 2 * 4 * 2)
        self.assertEqual({r["simulated"] for r in rows}, {f"mimicry {version} seed 1"})
        # The same technique again gives what was drawn.
        again = [r for r in rows if r["method"] == "spraycan" and r["recording"] == "0_0.json"]
        self.assertEqual([r["stroke"] for r in again], ["0_0.json#" + r["index"] for r in again])
        self.assertEqual({(r["method"], r["method_number"]) for r in rows},
                         {("spraycan", "0"), ("snap", "")})
        self.assertEqual({(r["shape"], r["shape_number"]) for r in rows}, {("torus", "0")})
        self.assertLess(max(float(r["D_ep_mm"]) for r in again), 30)
        self.assertEqual({r["task"] for r in rows}, {"tracing", "re-creating"})
        self.assertEqual(sorted({r["repetition"] for r in rows}), ["0", "1"])

        os.remove(self.path("a", "p00", "2_0.json"))
        os.mkdir(self.path("a", "nobody"))
        done = run("replay", "--strokes", self.path("a", "nobody"), self.path("a", "p00"),
                   "--targets", targets, "-t", "snap", "--out", self.path("q"), expect=5)
        self.assertIn("study_sequence.json", done.stderr)
        self.assertIn("2_0.json", done.stderr)
        self.assertIn("9 rows, 5 of them rejected", done.stdout)

    def test_errors(self):
        targets = self.targets()
        self.assertIn("twice", run("participants", "--targets", targets, "-t", "snap,snap", "--out",
                                   self.path("x"), expect=3).stderr)
        self.assertIn("no shape", run("participants", "--targets", targets, "--only", "cat", "--out",
                                      self.path("x"), expect=3).stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
