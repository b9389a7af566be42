"""Every call that writes fails once, and the disk is full from every call on: io_faults_test.py PROGRAM
FAULTS. Files under their final names are then whole, old or new, nothing else is left, the exit code
is 4 and the message names the file and the remedy; what replay said is done stays."""

import errno
import json
import os
import shutil
import sys
import unittest

from program import Folder, run

FAULTS = sys.argv[2]
MOST_CALLS = 400  # a guard: no command below makes as many


class Faults(Folder):
    def setUp(self):
        super().setUp()
        os.mkdir(self.path("in"))
        self.strokes = self.path("in", "s.json")
        run("simulate", "shape:torus:24", "--rate", "20", "--out", self.strokes)

    def faulty(self, number, error, stays, *args, expect=None):
        """A run whose number-th call fails below out/, and whether it came to that."""
        fired = self.path("fired")
        environment = dict(os.environ, LD_PRELOAD=FAULTS, FAULT_AT=str(number),
                           FAULT_IN=self.path("out"), FAULT_ERRNO=str(error), FAULT_FIRED=fired)
        if stays:
            environment["FAULT_STAYS"] = "1"
        done = run(*args, env=environment, expect=expect)
        if not os.path.exists(fired):
            return done, False
        os.remove(fired)
        return done, True

    def every_fault(self, args, prepare, check):
        """Runs args with every fault; check(done) sees what is in out/. Returns the number of calls."""
        for error, stays in ((errno.ENOSPC, True), (errno.ENOSPC, False), (errno.EIO, False)):
            for number in range(1, MOST_CALLS):
                shutil.rmtree(self.path("out"), ignore_errors=True)
                prepare()
                done, fired = self.faulty(number, error, stays, *args)
                if not fired:
                    self.assertEqual(done.returncode, 0, done.stderr)
                    break
                with self.subTest(number=number, error=errno.errorcode[error], stays=stays):
                    self.assertEqual(done.returncode, 4, done.stderr)
                    self.assertIn(self.path("out"), done.stderr)
                    self.assertIn("check the path, the rights and the room left", done.stderr)
                    check()
            else:
                self.fail("there is no end of calls")
            self.assertGreater(number, 3)

    def check_whole_files(self, args, names):
        """Of a command that writes files: each is as before or whole."""
        os.mkdir(self.path("out"))
        run(*args)
        whole = self.files("out")
        self.assertEqual(sorted(whole), sorted(names))
        old = {name: b"what was there before" for name in names}

        def with_old_files():
            os.mkdir(self.path("out"))
            for name, content in old.items():
                os.makedirs(os.path.dirname(self.path("out", name)), exist_ok=True)
                self.write(os.path.join("out", name), content)

        def check(before):
            found = self.files("out")
            self.assertLessEqual(set(found), set(names))
            for name in before:
                self.assertIn(name, found)
            for name, content in found.items():
                self.assertIn(content, (before.get(name), whole[name]), name)

        self.every_fault(args, with_old_files, lambda: check(old))
        self.every_fault(args, lambda: os.mkdir(self.path("out")), lambda: check({}))

    def test_project(self):
        self.check_whole_files(("project", "shape:torus:24", self.strokes, "-t", "spraycan", "--out",
                                self.path("out")),
                               ["curves." + f for f in ("csv", "glb", "json", "obj", "ply")])

    def test_bake(self):
        self.check_whole_files(("bake", "shape:sphere:2", "--samples", "40", "--out",
                                self.path("out", "a.mimicry")), ["a.mimicry"])

    def test_bake_that_cannot_be_kept(self):
        """Nothing depends on the cache."""
        args = ("bake", "shape:sphere:2", "--samples", "40", "--out", self.path("a.mimicry"))
        os.environ["MIMICRY_CACHE"] = self.path("out")
        for number in range(1, MOST_CALLS):
            shutil.rmtree(self.path("out"), ignore_errors=True)
            done, fired = self.faulty(number, errno.ENOSPC, True, *args, expect=0)
            if not fired:
                break
            self.assertIn("not kept", done.stderr)
            left = self.files("out")
            self.assertTrue(all(name.endswith(".mimicry") for name in left), left)
        self.assertGreater(number, 3)

    def test_simulate(self):
        self.check_whole_files(("simulate", "shape:torus:24", "--rate", "20", "--out",
                                self.path("out", "s.json")), ["s.json"])

    def test_render(self):
        self.check_whole_files(("render", "shape:torus:24", "--width", "40", "--height", "40",
                                "--out", self.path("out", "p.png")), ["p.png"])

    def targets(self):
        with open(self.strokes, encoding="utf-8") as file:
            curves = [stroke["intended"] for stroke in json.load(file)["strokes"][:2]]
        shape = {"name": "torus", "scale": 0.4,
                 "curves": [{"face": c["face"], "bary": c["bary"]} for c in curves]}
        os.mkdir(self.path("shapes"))
        run("shapes", "torus", "--resolution", "24", "--out", self.path("shapes", "torus.obj"))
        return ["--shapes", self.path("shapes"), "--targets",
                self.write("t.json", json.dumps({"shapes": [shape]}))]

    def test_participants_and_measure(self):
        targets = self.targets()
        participants = ("participants", *targets, "--count", "2", "--rate", "20", "-t",
                        "spraycan", "--threads", "1")
        self.check_whole_files((*participants, "--out", self.path("out")),
                               [f"p0{p}/{name}" for p in (0, 1)
                                for name in ("0_0.json", "study_sequence.json")])
        run(*participants, "--out", self.path("study"))
        shutil.rmtree(self.path("out"))
        self.check_whole_files(("measure", self.path("study", "p00"), *targets, "--threads", "1",
                                "--out", self.path("out", "m.csv")), ["m.csv", "m.rejected.csv"])

    def test_replay(self):
        args = ("replay", "--strokes", self.strokes, "--mesh", "shape:torus:24", "-t",
                "spraycan,snap", "--threads", "2", "--out", self.path("out"))
        run(*args)
        whole = self.files("out")
        names = {"rows.csv", "rows.jsonl", "rows.journal", "replay.json"}
        self.assertEqual(set(whole), names)
        lines = whole["rows.csv"].count(b"\n")

        def check():
            left = self.files("out")
            self.assertLessEqual(set(left), names)
            journal = left.get("rows.journal", b"").split(b"\n")[1:-1]
            said = [int(n) for n in journal[-1].split()] if journal else [0, 0, 0, 0, 0]
            for name, size in (("rows.csv", said[3]), ("rows.jsonl", said[4])):
                # Whole lines, and all that were said to be done.
                rows = left.get(name, b"")
                self.assertGreaterEqual(len(rows), size)
                self.assertTrue(whole[name].startswith(rows), name)
                self.assertTrue(rows == b"" or rows.endswith(b"\n"), name)
            self.assertIn(left.get("replay.json", whole["replay.json"]), (whole["replay.json"],))
            run(*args)
            again = self.files("out")
            for name in ("rows.csv", "rows.jsonl"):
                self.assertEqual(again[name], whole[name])

        self.assertGreater(lines, 5)
        self.every_fault(args, lambda: None, check)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
