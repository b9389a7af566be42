#!/usr/bin/env python3
"""installed_studio.py CMAKE BUILD PAGE FOLDER: installs BUILD into FOLDER; `mimicry serve` there hands out PAGE from
the folder that was installed with it, not from the source tree. Skipped (77) where PAGE is not built."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.request

cmake, build, page, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3]), pathlib.Path(sys.argv[4])
if not page.is_file():
    print(f"skipped: {page} is not built (cmake --build --preset wasm)")
    sys.exit(77)
shutil.rmtree(folder, ignore_errors=True)
subprocess.run([cmake, "--install", build, "--prefix", folder], stdout=subprocess.DEVNULL, check=True)
program = folder / "bin" / "mimicry"
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
            request = urllib.request.urlopen(f"{address}/{name}", timeout=300)
            assert request.status == 200, f"{name}: {request.status}"
            if name:
                assert request.read() == b"here\n"
    finally:
        server.terminate()
        server.wait()
