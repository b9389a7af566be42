"""Reads curve files with Python alone, as the independent reader of the writers' tests.

Usage: curve_reader.py FORMAT FILE [MESH_OBJ]. Prints a line for each curve: how many parts and vertices
it has, and its length as a hexadecimal float. The JSON form is measured from barycentrics and crossings on
the mesh, as a program would that was given the file and the mesh only.
"""

import csv
import json
import math
import sys


def measure(parts):
    length = sum(math.dist(a, b) for part in parts for a, b in zip(part, part[1:]))
    print(len(parts), sum(len(part) for part in parts), length.hex())


def read_obj(path):
    vertices, curves = [], []
    for line in open(path, encoding="utf-8"):
        words = line.split()
        if words[:1] == ["o"]:
            curves.append([])
        elif words[:1] == ["v"]:
            vertices.append(tuple(map(float, words[1:])))
        elif words[:1] == ["l"]:
            curves[-1].append([vertices[int(w) - 1] for w in words[1:]])
    return curves


def read_csv(path):
    curves = {}
    for row in csv.DictReader(open(path, encoding="utf-8", newline="")):
        parts = curves.setdefault(int(row["curve"]), {})
        point = tuple(float(row[c]) for c in "xyz")
        parts.setdefault(int(row["part"]), []).append(point)
        assert row["kind"] in ("point", "crossing")
        assert abs(sum(float(row[c]) for c in ("b0", "b1", "b2")) - 1) < 1e-12
    return [list(parts.values()) for _, parts in sorted(curves.items())]


def read_ply(path):
    text = open(path, encoding="ascii").read()
    head, body = text.split("end_header\n", 1)
    counts = {l.split()[1]: int(l.split()[2]) for l in head.split("\n") if l.startswith("element")}
    rows = [line.split() for line in body.strip().split("\n")]
    assert len(rows) == counts["vertex"] + counts["edge"], (len(rows), counts)
    vertices = [(tuple(map(float, r[:3])), int(r[6])) for r in rows[: counts["vertex"]]]
    curves = {}
    for r in rows[counts["vertex"]:]:
        a, b = vertices[int(r[0])], vertices[int(r[1])]
        assert a[1] == b[1], "an edge joins two curves"
        parts = curves.setdefault(a[1], [])
        if parts and parts[-1][-1] == a[0]:
            parts[-1].append(b[0])
        else:
            parts.append([a[0], b[0]])
    return [parts for _, parts in sorted(curves.items())]


def read_json(path, mesh_path):
    vertices, faces = [], []
    for line in open(mesh_path, encoding="utf-8"):
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append(tuple(map(float, words[1:])))
        elif words[:1] == ["f"]:
            faces.append([int(w) - 1 for w in words[1:]])

    def mix(terms):
        return tuple(sum(w * x[k] for w, x in terms) for k in range(3))

    document = json.load(open(path, encoding="utf-8"))
    assert document["format"] == "mimicry-curves" and document["version"] == 1
    assert document["target"]["faces"] == len(faces)
    curves = []
    for curve in document["curves"]:
        parts = []
        for i, point in enumerate(curve["points"]):
            piece = curve["pieces"][i - 1] if i else {"kind": "gap", "crossings": []}
            if piece["kind"] == "gap":
                parts.append([])
            for c in piece["crossings"]:
                face, corner = divmod(c["half_edge"], 3)
                a, b = faces[face][corner], faces[face][(corner + 1) % 3]
                assert c["edge"] == [a, b]
                parts[-1].append(mix([(1 - c["t"], vertices[a]), (c["t"], vertices[b])]))
            corners = [vertices[v] for v in faces[point["face"]]]
            place = mix(list(zip(point["bary"], corners)))
            assert math.dist(place, point["position"]) < 1e-12
            parts[-1].append(place)
        curves.append(parts)
    return curves


readers = {"obj": read_obj, "csv": read_csv, "ply": read_ply, "json": read_json}
for curve in readers[sys.argv[1]](*sys.argv[2:]):
    measure(curve)
