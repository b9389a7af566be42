#!/usr/bin/env python3
"""run_all.py PROGRAM...: runs the examples' programs and checks what they print and write. The program `draw` is
the README's, word for word, where this stands in the source tree."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
MESH, STROKES = str(HERE / "data" / "torus.obj"), str(HERE / "data" / "strokes.json")
FRAMES = {s["id"]: len(s["frames"]) for s in json.loads(pathlib.Path(STROKES).read_text())["strokes"]}


def run(program, *arguments, status=0):
    done = subprocess.run([program, *arguments], capture_output=True, text=True)
    assert done.returncode == status, f"{program}: {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def draw(program, folder):
    curves = folder / "curves.json"
    printed = run(program, MESH, STROKES, str(curves))
    counts = [int(n) for n in re.findall(r"^(\d+) points, [\d.]+ long$", printed, re.M)]
    assert counts == list(FRAMES.values()), printed
    drawn = json.loads(curves.read_text())
    assert [c["stroke"] for c in drawn["curves"]] == list(FRAMES), drawn["curves"]
    assert {c["technique"] for c in drawn["curves"]} == {"mimicry"}
    # The mesh was baked once.
    kept = list((folder / "cache").glob("*.mimicry"))
    assert len(kept) == 1, kept
    when = kept[0].stat().st_ino
    assert run(program, MESH, STROKES, str(folder / "again.json")) == printed
    assert (folder / "again.json").read_bytes() == curves.read_bytes()
    assert [f.stat().st_ino for f in (folder / "cache").glob("*.mimicry")] == [when], "baked anew"
    for ending, part in ((".obj", b"\nl "), (".csv", b"stroke"), (".glb", b"glTF"), (".ply", b"ply")):
        run(program, MESH, STROKES, str(folder / f"curves{ending}"))
        assert part in (folder / f"curves{ending}").read_bytes()[:100_000], ending
    assert "curves.dwg" in run(program, MESH, STROKES, str(folder / "curves.dwg"), status=1)
    assert "nowhere.obj" in run(program, "nowhere.obj", STROKES, str(curves), status=1)
    assert "usage" in run(program, status=2)


def replay(program, folder):
    rows = [line.split() for line in run(program, MESH, STROKES, "snap", "mimicry").splitlines()[1:]]
    assert [(r[0], r[1]) for r in rows] == [(s, t) for t in ("snap", "mimicry") for s in FRAMES], rows
    for stroke, _, points, missed, length in rows:
        assert int(points) + int(missed) == FRAMES[stroke] and float(length) > 10, rows
    assert "teapot" in run(program, MESH, STROKES, "teapot", status=1)


def measure(program, folder):
    # The hand is held 50 mm above the curve that it means, and strays from there by some millimetres: so does the
    # closest point. What copies the hand's motion keeps its drift, and must still come closer than half of the 50.
    for technique, bound in (("snap", 5), ("mimicry-live", 25)):
        printed = run(program, MESH, STROKES, technique)
        headings = [line for line in printed.splitlines() if not line.startswith(" ")]
        assert headings == [f"{stroke}, {technique}" for stroke in FRAMES], printed
        far = [float(x) for x in re.findall(r"closest points +([\d.]+) mm", printed)]
        assert len(far) == len(FRAMES) and all(0 < x < bound for x in far), printed
    assert "nowhere.json" in run(program, MESH, "nowhere.json", "snap", status=1)


def deforming_target(program, folder):
    numbers = [float(x) for x in re.findall(r"\d\.\d{3}", run(program))]
    length, away, grown_length, grown_away = numbers
    assert abs(grown_length / length - 1.05) < 0.002, numbers
    assert abs(away - 0.1) < 0.005 and abs(grown_away - 0.05) < 0.006, numbers


STEADY = {}  # what own_technique's programs drew


def own_technique(program, folder):
    STEADY[program] = re.search(r"steady-snap: 90 points, [0-9.]+ long", run(program)).group()
    assert len(set(STEADY.values())) == 1, f"the same technique draws other curves: {STEADY}"


def readme_agrees():
    readme = HERE.parent / "README.md"
    if not readme.is_file() or not (HERE.parent / "CMakeLists.txt").is_file():
        return
    shown = re.search(r"^```cpp\n(.*?)^```$", readme.read_text(), re.M | re.S).group(1)
    program = (HERE / "draw" / "main.cpp").read_text()
    assert shown == program, "README.md and examples/draw/main.cpp differ"
    assert len(program.splitlines()) < 25


def main():
    programs = sys.argv[1:]
    assert programs, "no programs are given"
    readme_agrees()
    for program in programs:
        name = pathlib.Path(program).stem.removeprefix("example_")
        with tempfile.TemporaryDirectory() as folder:
            os.environ["MIMICRY_CACHE"] = str(pathlib.Path(folder) / "cache")
            globals()[name.removesuffix("_c")](program, pathlib.Path(folder))
        print(f"{name}: as expected")
    assert len(STEADY) in (0, 2), f"own_technique is run in C++ and in C, or not at all: {STEADY}"


main()
