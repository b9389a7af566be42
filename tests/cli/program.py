"""What tests of the program share: a folder of their own, and runs that cannot hang."""

import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv[1]


def run(*args, expect=0, **options):
    options.setdefault("timeout", 1800)
    done = subprocess.run([PROGRAM, *args], capture_output=True, **options)
    said = done.stdout.decode("utf-8", "replace"), done.stderr.decode("utf-8", "replace")
    assert expect is None or done.returncode == expect, (args, done.returncode, *said)
    done.stdout, done.stderr = said
    return done


class Folder(unittest.TestCase):
    """A new folder, gone at the end, and in it the cache of bakes."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        os.environ["MIMICRY_CACHE"] = self.path("cache")

    def path(self, *names):
        return os.path.join(self.folder.name, *names)

    def write(self, name, content):
        if isinstance(content, str):
            content = content.encode()
        with open(self.path(name), "wb") as file:
            file.write(content)
        return self.path(name)

    def read(self, *names):
        with open(self.path(*names), "rb") as file:
            return file.read()

    def files(self, *names):
        """Every file below, by its name there, with its content."""
        top = self.path(*names)
        found = {}
        for folder, _, inside in os.walk(top):
            for name in inside:
                path = os.path.join(folder, name)
                with open(path, "rb") as file:
                    found[os.path.relpath(path, top)] = file.read()
        return found
