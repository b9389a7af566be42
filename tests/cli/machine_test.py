"""A machine that gives less than is asked for: machine_test.py PROGRAM FAULTS. Threads that cannot be
started, standard output that is full or closed, pipes and devices where files belong, files over a
limit of the process, folders that another program writes to."""

import fcntl
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import threading
import unittest

from program import PROGRAM, Folder, run

FAULTS = sys.argv[2]


class Threads(Folder):
    def few(self, most):
        return dict(os.environ, LD_PRELOAD=FAULTS, FAULT_THREADS=str(most))

    def test_fewer_threads_give_the_same(self):
        bake = ("bake", "shape:sphere:2", "--samples", "40", "--no-cache", "--threads", "8", "--out")
        simulate = ("simulate", "shape:torus:24", "--rate", "20", "--out")
        run(*bake, self.path("whole.mimicry"))
        run(*simulate, self.path("s.json"))
        replay = ("replay", "--strokes", self.path("s.json"), "--mesh", "shape:torus:24", "-t",
                  "spraycan,snap", "--threads", "8", "--out")
        render = ("render", "shape:torus:24", "--width", "60", "--height", "50", "--out")
        run(*replay, self.path("whole"))
        run(*render, self.path("whole.png"))
        for most in (0, 1, 3):
            environment = self.few(most)
            run(*bake, self.path("few.mimicry"), env=environment)
            self.assertEqual(self.read("few.mimicry"), self.read("whole.mimicry"))
            run(*replay, self.path(f"few{most}"), env=environment)
            self.assertEqual(self.read(f"few{most}", "rows.csv"), self.read("whole", "rows.csv"))
            run(*render, self.path("few.png"), env=environment)
            self.assertEqual(self.read("few.png"), self.read("whole.png"))

    def test_number_of_threads_is_bounded(self):
        for command in (("bake", "shape:torus:24", "--out", self.path("a")),
                        ("replay", "--strokes", "x", "-t", "snap", "--out", self.path("a"))):
            for threads in ("257", "100000", "-1"):
                done = run(*command, "--threads", threads, expect=2)
                self.assertIn("256", done.stderr)


class StandardOutput(Folder):
    def test_full(self):
        for command in (("techniques",), ("techniques", "--json"), ("--help",), ("--version",),
                        ("info", "shape:torus")):
            with open("/dev/full", "wb") as full:
                done = subprocess.run([PROGRAM, *command], stdout=full, stderr=subprocess.PIPE,
                                      timeout=1800)
            self.assertEqual(done.returncode, 4, command)
            self.assertIn(b"standard output", done.stderr)

    def test_reader_that_left(self):
        read, write = os.pipe()
        os.close(read)
        done = subprocess.run([PROGRAM, "techniques", "--json"], stdout=write,
                              stderr=subprocess.PIPE, timeout=1800)
        os.close(write)
        self.assertEqual((done.returncode, done.stderr), (4, b""))

    def test_closed(self):
        """What is printed does not get into the files that are written."""
        run("simulate", "shape:torus:24", "--rate", "20", "--out", self.path("s.json"))
        for closed in (">&-", "<&- >&-", "<&- >&- 2>&-"):
            out = self.path("closed.json")
            done = subprocess.run(["sh", "-c", f'"$@" {closed}', "sh", PROGRAM, "simulate",
                                   "shape:torus:24", "--rate", "20", "--out", out], timeout=1800,
                                  stderr=subprocess.DEVNULL)
            self.assertEqual(done.returncode, 4, closed)
            self.assertEqual(self.read("closed.json"), self.read("s.json"))


class Places(Folder):
    BAKE = ("bake", "shape:sphere:2", "--samples", "40", "--out")

    def test_input_through_a_pipe(self):
        run("shapes", "torus", "--resolution", "24", "--out", self.path("torus.obj"))
        pipe = self.path("pipe.obj")
        os.mkfifo(pipe)

        def feed():
            with open(pipe, "wb") as file:
                file.write(self.read("torus.obj"))

        feeder = threading.Thread(target=feed)
        feeder.start()
        told = json.loads(run("info", pipe, "--json").stdout)
        feeder.join()
        self.assertEqual(told["faces"], json.loads(run("info", "shape:torus:24", "--json").stdout)
                         ["faces"])

    def test_inputs_and_outputs_that_are_no_files(self):
        os.mkdir(self.path("folder.obj"))
        self.assertIn("folder.obj", run("info", self.path("folder.obj"), expect=4).stderr)
        os.mkfifo(self.path("pipe"))
        for place, word in (("folder.obj", "irectory"), ("pipe", "reader"), ("no/such", "check")):
            done = run(*self.BAKE, self.path(place), expect=4)
            self.assertIn(self.path(place), done.stderr)
            self.assertIn(word, done.stderr)
        self.assertIn("/dev/full", run(*self.BAKE, "/dev/full", expect=4).stderr)
        run(*self.BAKE, "/dev/null")
        self.assertEqual(sorted(os.listdir(self.folder.name)), ["cache", "folder.obj", "pipe"])

    def test_cache_that_is_no_file(self):
        run(*self.BAKE, self.path("a.mimicry"))
        [name] = os.listdir(self.path("cache"))
        kept = self.path("cache", name)
        for make in (lambda: os.mkfifo(kept), lambda: os.mkdir(kept),
                     lambda: os.symlink("/dev/zero", kept)):
            shutil.rmtree(self.path("cache"))
            os.mkdir(self.path("cache"))
            make()
            done = run(*self.BAKE, self.path("b.mimicry"), expect=4)
            self.assertIn(kept, done.stderr)
            self.assertIn("--no-cache", done.stderr)
            run(*self.BAKE, self.path("b.mimicry"), "--no-cache")
        shutil.rmtree(self.path("cache"))
        os.mkfifo(self.path("cache"))
        self.assertIn("no folder", run(*self.BAKE, self.path("b.mimicry"), expect=4).stderr)

    def test_pipes_in_folders(self):
        run("simulate", "shape:torus:24", "--rate", "20", "--out", self.path("s.json"))
        replay = ("replay", "--strokes", self.path("s.json"), "--mesh", "shape:torus:24", "-t",
                  "snap", "--out", self.path("out"))
        for name in ("rows.journal", "rows.csv", "rows.jsonl"):
            run(*replay)
            os.remove(self.path("out", name))
            os.mkfifo(self.path("out", name))
            done = run(*replay, expect=4)
            self.assertIn(name, done.stderr)
            self.assertIn("pipe", done.stderr)
            shutil.rmtree(self.path("out"))
        os.mkdir(self.path("p00"))
        os.mkfifo(self.path("p00", "study_sequence.json"))
        done = run("replay", "--strokes", self.path("p00"), "-t", "snap", "--out", self.path("out"),
                   expect=3)
        self.assertIn("pipe", done.stderr)

    def test_limit_on_the_size_of_files(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (10000, 10000))

        done = run("simulate", "shape:torus:24", "--out", self.path("s.json"), preexec_fn=limit,
                   expect=4)
        self.assertIn(self.path("s.json"), done.stderr)
        self.assertEqual(os.listdir(self.folder.name), [])


class Locks(Folder):
    def setUp(self):
        super().setUp()
        self.strokes = self.path("s.json")
        run("simulate", "shape:torus:24", "--rate", "20", "--out", self.strokes)

    def held(self, path, flags):
        file = os.open(path, flags)
        self.addCleanup(os.close, file)
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return file

    def test_folder_that_another_program_writes_to(self):
        os.mkdir(self.path("out"))
        file = self.held(self.path("out"), os.O_RDONLY)
        with open(self.strokes, encoding="utf-8") as strokes:
            curves = [stroke["intended"] for stroke in json.load(strokes)["strokes"][:2]]
        targets = self.write("t.json", json.dumps({"shapes": [{
            "name": "torus", "scale": 0.4,
            "curves": [{"face": c["face"], "bary": c["bary"]} for c in curves]}]}))
        os.mkdir(self.path("shapes"))
        run("shapes", "torus", "--resolution", "24", "--out", self.path("shapes", "torus.obj"))
        commands = (
            ("project", "shape:torus:24", self.strokes, "-t", "spraycan"),
            ("replay", "--strokes", self.strokes, "--mesh", "shape:torus:24", "-t", "snap"),
            ("participants", "--shapes", self.path("shapes"), "--targets", targets, "--count", "1",
             "-t", "snap", "--rate", "20"))
        for command in commands:
            done = run(*command, "--out", self.path("out"), expect=4)
            self.assertIn(self.path("out"), done.stderr)
            self.assertIn("another program", done.stderr)
            self.assertEqual(os.listdir(self.path("out")), [], command)
        fcntl.flock(file, fcntl.LOCK_UN)
        run(*commands[0], "--out", self.path("out"))

    def test_file_that_another_program_writes(self):
        lock = self.write(".a.lock", b"")
        file = self.held(lock, os.O_RDWR)
        for command in (("simulate", "shape:torus:24", "--out", self.path("a")),
                        ("bake", "shape:torus:24", "--out", self.path("a")),
                        ("targets", "shape:torus:24", "--out", self.path("a"))):
            done = run(*command, expect=4)
            self.assertIn(self.path("a") + ": another program", done.stderr)
        self.assertTrue(os.path.exists(lock))  # it is the other's
        fcntl.flock(file, fcntl.LOCK_UN)
        run("simulate", "shape:torus:24", "--rate", "20", "--out", self.path("a"))
        self.assertFalse(os.path.exists(lock))

    def test_two_runs(self):
        """The first waits for a pipe's writer; its end, whatever it is, frees the folder."""
        pipe = self.path("pipe.json")
        os.mkfifo(pipe)

        def replay(strokes):
            return [PROGRAM, "replay", "--strokes", strokes, "--mesh", "shape:torus:24", "-t",
                    "snap", "--out", self.path("out")]

        first = subprocess.Popen(replay(pipe), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        writer = os.open(pipe, os.O_WRONLY)  # waits until the first run reads, with the lock
        second = subprocess.run(replay(self.strokes), capture_output=True, timeout=1800)
        self.assertEqual(second.returncode, 4)
        self.assertIn(b"another program", second.stderr)
        first.send_signal(signal.SIGKILL)
        first.wait(timeout=1800)
        os.close(writer)
        shutil.rmtree(self.path("out"))
        run(*replay(self.strokes)[1:])

    def test_many_at_once_on_one_file(self):
        """Whole, whoever is last; and no lock is left."""
        run("simulate", "shape:torus:24", "--rate", "20", "--out", self.path("whole"))
        together = [subprocess.Popen([PROGRAM, "simulate", "shape:torus:24", "--rate", "20", "--out",
                                      self.path("a")], stdout=subprocess.DEVNULL,
                                     stderr=subprocess.DEVNULL) for _ in range(12)]
        codes = [p.wait(timeout=1800) for p in together]
        self.assertIn(0, codes)
        self.assertLessEqual(set(codes), {0, 4})
        self.assertEqual(self.read("a"), self.read("whole"))
        self.assertEqual(sorted(os.listdir(self.folder.name)), ["a", "s.json", "whole"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
