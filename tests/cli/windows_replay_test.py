"""The same recorded strokes through the native program and the one for Windows:
windows_replay_test.py PROGRAM NATIVE WINE... Curves are equal to the last bit where nothing but arithmetic
and square roots is involved; elsewhere (vertex normals and tangents are weighted with the platform's arc
tangents and cosines) faces are equal and positions within 1e-9 of the diagonal."""

import json
import math
import os
import subprocess
import sys
import tempfile

PROGRAM, NATIVE, *WINE = sys.argv[1:]
EXACT = {"occlude", "spraycan", "head-centric", "snap", "anchored-closest", "mimicry-planar",
         "anchored-ray-plane", "anchored-ray-transport"}
DIAGONAL = 1.0  # not less than the model's

if not os.path.exists(NATIVE):
    print(f"skipped: {NATIVE} is not built; cmake --build --preset release --target mimicry_cli")
    sys.exit(77)


def without_normals(curve):
    points = [{key: value for key, value in p.items() if key != "normal"} for p in curve["points"]]
    return {**curve, "points": points}


def compare(got, expected):
    """The largest distance between two curves' points; 0 where they are equal to the last bit."""
    label = expected["technique"], expected.get("stroke")
    assert (got["technique"], got.get("stroke")) == label
    if without_normals(got) == without_normals(expected):
        return 0.0
    assert len(got["points"]) == len(expected["points"]), label
    largest = 0.0
    for p, q in zip(got["points"], expected["points"]):
        largest = max(largest, math.dist(p["position"], q["position"]))
        # On an edge either face will do.
        assert p["face"] == q["face"] or min(p["bary"]) <= 1e-9, (label, p, q)
    assert largest <= 1e-9 * DIAGONAL, (label, largest)
    return max(largest, 5e-324)


with tempfile.TemporaryDirectory() as folder:
    environment = {**os.environ, "MIMICRY_CACHE": ""}

    def run(*command):
        subprocess.run(command, check=True, cwd=folder, env=environment, stdout=subprocess.DEVNULL)

    # Files, as shapes are made with sines of the platform's.
    run(NATIVE, "shapes", "hand", "--out", "hand.obj")
    run(NATIVE, "simulate", "hand.obj", "--shape", "hand", "--out", "strokes.json")
    run(NATIVE, "bake", "hand.obj", "--samples", "200", "--out", "hand.mimicry")
    project = ("project", "hand.obj", "strokes.json", "--embedding", "hand.mimicry", "--formats", "json")
    run(NATIVE, *project, "--out", "native")
    run(*WINE, PROGRAM, *project, "--out", "windows")
    curves = {}
    for name in ("native", "windows"):
        with open(os.path.join(folder, name, "curves.json"), encoding="utf-8") as file:
            curves[name] = json.load(file)["curves"]

assert curves["native"] and len(curves["native"]) == len(curves["windows"])
furthest = {}
for got, expected in zip(curves["windows"], curves["native"]):
    name = expected["technique"]
    furthest[name] = max(furthest.get(name, 0.0), compare(got, expected))
for name, distance in furthest.items():
    print(f"{name}: {'the same bits' if distance == 0 else f'within {distance:g}'}")
    assert distance == 0 or name not in EXACT, name
assert EXACT <= set(furthest)
