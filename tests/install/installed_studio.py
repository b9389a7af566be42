#!/usr/bin/env python3
"""installed_studio.py PROGRAM PAGE: `PROGRAM serve` hands out PAGE from the folder that was installed with it,
not from the source tree."""
import pathlib
import re
import subprocess
import sys
import tempfile
import urllib.request

program, page = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
studio = program.parent.parent / "share" / "mimicry" / "studio"
installed = studio / "index.html"
assert installed.read_bytes() == page.read_bytes(), f"{installed} is not {page}"
# What only the installed folder has.
(studio / "installed.txt").write_text("here\n")

with tempfile.TemporaryDirectory() as data:
    server = subprocess.Popen([program, "serve", "--port", "0", "--data", data], stdout=subprocess.PIPE, text=True)
    try:
        address = re.search(r"http://\S+", server.stdout.readline()).group().rstrip("/")
        for name in "", "installed.txt":
            request = urllib.request.urlopen(f"{address}/{name}", timeout=30)
            assert request.status == 200, f"{name}: {request.status}"
            if name:
                assert request.read() == b"here\n"
    finally:
        server.terminate()
        server.wait()
