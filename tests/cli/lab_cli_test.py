"""The study laboratory as its users run it: lab_cli_test.py PROGRAM STUDY_DATA."""

import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, STUDY = sys.argv[1:3]


def run(*args, expect=0, **options):
    done = subprocess.run([PROGRAM, *args], capture_output=True, text=True, timeout=240, **options)
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
                                    timeout=120, check=True).stdout.splitlines()
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
        self.assertIn("'c', only of a, b",
                      run("compare", rows, "-m", "a,c", "--measures", "same", expect=3).stderr)
        self.assertIn("no column 'K_E'",
                      run("compare", rows, "-m", "a,b", "--measures", "K_E", expect=3).stderr)
        self.assertIn("--measures", run("compare", rows, "-m", "a,b", expect=3).stderr)
        twice = self.write("t.csv", "method,curve,K_E\na,7,1\na,7,2\nb,7,2\n")
        self.assertIn("curve 7", run("compare", twice, "-m", "a,b", expect=3).stderr)
        self.assertIn("line 2", run("compare", self.write("u.csv", "method,K_E\na\n"), "-m", "a,b",
                                    expect=3).stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
