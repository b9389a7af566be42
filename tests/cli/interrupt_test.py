"""Signals at any time: interrupt_test.py PROGRAM. A command ends soon, with 130 where it was not done,
leaves no part of a file, and replay goes on where it was. Times of the signals are random and printed;
limits on the time are generous: what is tested is that there is an end. No test counts on a machine's
speed: a signal that must be handled waits for its handler, one that must come in time is sent again."""

import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
import unittest

from program import PROGRAM, Folder, run

SEED = random.randrange(1 << 30)
SIGNALS = (signal.SIGINT, signal.SIGTERM)
MOST_SECONDS = 600  # far more than the second that it takes: against hangs
MOST_TRIES = 40
UNNAMED = (".part", ".lock", ".tmp")


def start(*args, **options):
    return subprocess.Popen([PROGRAM, *args], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            **options)


def wait_for(what, process):
    """Waits until what() holds, or the process has ended by itself."""
    until = time.monotonic() + MOST_SECONDS
    while not what() and process.poll() is None:
        if time.monotonic() > until:
            process.kill()
            raise AssertionError(f"{process.args} did not begin")
        time.sleep(0.005)


def handles_signals(process):
    """Whether the program has its handler: before that, a signal ends it as it ends any program."""
    try:
        with open(f"/proc/{process.pid}/status", encoding="ascii") as status:
            caught = next(line for line in status if line.startswith("SigCgt:"))
    except (OSError, StopIteration):
        return False
    return all(int(caught.split()[1], 16) >> (number - 1) & 1 for number in SIGNALS)


class Interrupts(Folder):
    def setUp(self):
        super().setUp()
        os.environ["MIMICRY_CACHE"] = ""  # what was interrupted is not done the next time
        self.dice = random.Random(SEED)
        run("shapes", "torus", "--resolution", "150", "--out", self.path("big.obj"))
        run("simulate", "shape:torus", "--count", "9", "--out", self.path("s.json"))

    def end(self, process, seconds, number):
        """Sends a signal after some time. Returns the exit code: 0 where it was done before."""
        try:
            process.wait(timeout=seconds)
        except subprocess.TimeoutExpired:
            process.send_signal(number)
        out, error = process.communicate(timeout=MOST_SECONDS)
        self.assertIn(process.returncode, (0, 130, -number), (out, error))
        return process.returncode

    def interrupt(self, args, names, times=3, longest=1.5):
        """args with signals at random times in its run; files below out/ are whole."""
        out = self.path("out")
        os.mkdir(out)
        begin = time.monotonic()
        whole = None
        try:
            run(*args, timeout=longest)
            whole = self.files("out")
            self.assertEqual(set(whole), set(names))
        except subprocess.TimeoutExpired:
            pass  # long enough that it is never done here
        took = min(longest, time.monotonic() - begin)
        ended = tries = 0
        while tries < 2 * times or (ended == 0 and tries < MOST_TRIES):
            number = SIGNALS[tries % 2]
            tries += 1
            shutil.rmtree(out)
            os.mkdir(out)
            begin = time.monotonic()
            code = self.end(start(*args), self.dice.uniform(0, took), number)
            ended += code != 0
            left = self.files("out")
            for name, content in left.items():
                self.assertFalse(any(mark in name for mark in UNNAMED), name)
                self.assertIn(name, names)
                if whole:
                    self.assertEqual(content, whole[name], name)
            if code == 0:
                self.assertEqual(set(left), set(names))
                took = min(took, time.monotonic() - begin)
        self.assertGreater(ended, 0)
        shutil.rmtree(out)

    def test_bake(self):
        self.interrupt(("bake", self.path("big.obj"), "--out", self.path("out", "a.mimicry")),
                       ["a.mimicry"])

    def test_exact_geodesics(self):
        self.interrupt(("geodesic", self.path("big.obj"), "--from", "v0", "--out",
                        self.path("out", "d.csv")), ["d.csv"])

    def test_project(self):
        self.interrupt(("project", "shape:torus", self.path("s.json"), "-t", "spraycan,snap",
                        "--out", self.path("out")),
                       ["curves." + f for f in ("csv", "glb", "json", "obj", "ply")])

    def test_render(self):
        self.interrupt(("render", self.path("big.obj"), "--width", "1600", "--height", "1200",
                        "--out", self.path("out", "p.png")), ["p.png"])

    def test_simulate(self):
        self.interrupt(("simulate", "shape:torus", "--count", "999", "--out",
                        self.path("out", "s.json")), ["s.json"])

    def test_quality(self):
        self.interrupt(("quality", self.path("big.obj")), [])

    def test_targets(self):
        self.interrupt(("targets", "shape:torus:24", "--count", "500", "--out",
                        self.path("out", "t.json")), ["t.json", "t.png"])

    def study(self):
        with open(self.path("s.json"), encoding="utf-8") as file:
            curves = [s["intended"] for s in json.load(file)["strokes"]]
        shape = {"name": "torus", "scale": 0.4,
                 "curves": [{"face": c["face"], "bary": c["bary"]} for c in curves[:2]]}
        os.mkdir(self.path("shapes"))
        run("shapes", "torus", "--out", self.path("shapes", "torus.obj"))
        return ["--shapes", self.path("shapes"), "--targets",
                self.write("t.json", json.dumps({"shapes": [shape]}))]

    def test_participants_and_measure(self):
        known = self.study()
        count = 3
        names = [f"p{p:02}/{name}" for p in range(count) for name in
                 ("0_0.json", "2_0.json", "study_sequence.json")]
        participants = ("participants", *known, "--count", str(count), "-t", "spraycan,snap")
        self.interrupt((*participants, "--out", self.path("out")), names)
        run(*participants, "--out", self.path("study"))
        people = [self.path("study", p) for p in sorted(os.listdir(self.path("study")))]
        self.interrupt(("measure", *people, *known, "--out", self.path("out", "m.csv")),
                       ["m.csv", "m.rejected.csv"])

    def test_compare_with_many_resamples(self):
        lines = ["method,curve,x"] + [f"{m},{i},{self.dice.random()}" for m in "ab"
                                      for i in range(2000)]
        rows = self.write("rows.csv", "\n".join(lines) + "\n")
        self.interrupt(("compare", rows, "-m", "a,b", "--measures", "x", "--resamples", "1000000"),
                       [])

    def test_replay_goes_on(self):
        args = ("replay", "--strokes", self.path("s.json"), "--mesh", "shape:torus", "-t",
                "spraycan,snap,anchored-closest", "--threads", "2", "--out")
        begin = time.monotonic()
        run(*args, self.path("whole"))
        took = time.monotonic() - begin
        began = tries = 0
        while tries < 6 or (began == 0 and tries < MOST_TRIES):
            number = SIGNALS[tries % 2]
            tries += 1
            process = start(*args, self.path("out"))
            wait_for(lambda running=process: handles_signals(running), process)
            code = self.end(process, self.dice.uniform(0, took), number)
            began += code == 130
            for name in self.files("out") if os.path.exists(self.path("out")) else ():
                self.assertFalse(any(mark in name for mark in UNNAMED), name)
            if code == 0 and began == 0:
                shutil.rmtree(self.path("out"))  # done before the signal: nothing would go on
        run(*args, self.path("out"))
        self.assertGreater(began, 0)
        for name in ("rows.csv", "rows.jsonl"):
            self.assertEqual(self.read("out", name), self.read("whole", name))

    def test_interrupted_bake_of_a_replay_is_no_reason_to_reject(self):
        args = ("replay", "--strokes", self.path("s.json"), "--mesh", self.path("big.obj"), "-t",
                "mimicry", "--out", self.path("out"))
        process = start(*args)
        wait_for(lambda: os.path.exists(self.path("out", "rows.csv")), process)
        code = self.end(process, 0.3, signal.SIGINT)  # the bake of this mesh takes many seconds
        self.assertEqual(code, 130)
        self.assertEqual(self.read("out", "rows.csv").count(b"\n"), 1)  # the heading

    def test_stage_that_does_not_ask_is_ended(self):
        pipe = self.path("never.obj")
        os.mkfifo(pipe)
        for number in SIGNALS:
            process = start("info", pipe)
            wait_for(lambda running=process: handles_signals(running), process)
            self.assertEqual(self.end(process, 0.2, number), 130)
        # And at once where it is told twice.
        process = start("bake", pipe, "--out", self.path("a.mimicry"))
        wait_for(lambda: handles_signals(process), process)
        process.send_signal(signal.SIGTERM)
        time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        self.assertEqual(self.end(process, MOST_SECONDS, signal.SIGINT), 130)
        self.assertEqual(sorted(os.listdir(self.folder.name)), ["big.obj", "never.obj", "s.json"])

    def test_report(self):
        args = ("replay", "--strokes", self.path("s.json"), "--mesh", "shape:torus", "-t",
                "spraycan,snap", "--out", self.path("study"))
        run(*args)
        whole = None
        if run("report", self.path("study"), "--out", self.path("r"), expect=None).returncode != 0:
            self.skipTest("this build has no plots")
        whole = self.files("r")
        for number in SIGNALS:
            for _ in range(4):
                shutil.rmtree(self.path("r"))
                self.end(start("report", self.path("study"), "--out", self.path("r")),
                         self.dice.uniform(0, 2), number)
                if not os.path.exists(self.path("r")):
                    os.mkdir(self.path("r"))
                self.assertLessEqual(set(self.files("r")), set(whole))


if __name__ == "__main__":
    print("seed", SEED, flush=True)
    unittest.main(argv=sys.argv[:1], verbosity=2)
