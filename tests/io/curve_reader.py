"""Reads curve files with Python alone, as the independent reader of the writers' tests.

Usage: curve_reader.py FORMAT FILE [MESH_OBJ]. Prints a line for each curve: how many parts and vertices
it has, and its length (ply-tubes: volume) as a hexadecimal float. The JSON form is measured from barycentrics and crossings on
the mesh, as a program would that was given the file and the mesh only.
"""

import csv
import json
import math
import struct
import sys


def measure(parts):
    length = sum(math.dist(a, b) for part in parts for a, b in zip(part, part[1:]))
    print(len(parts), sum(len(part) for part in parts), length.hex())


def joined(segments):
    """Polylines of segments that follow each other."""
    parts = []
    for a, b in segments:
        if parts and parts[-1][-1] == a:
            parts[-1].append(b)
        else:
            parts.append([a, b])
    return parts


def read_obj(path):
    """Lines of two vertices or of many."""
    vertices, curves = [], []
    for line in open(path, encoding="utf-8"):
        words = line.split()
        if words[:1] == ["o"]:
            curves.append([])
        elif words[:1] == ["v"]:
            vertices.append(tuple(map(float, words[1:])))
        elif words[:1] == ["l"]:
            numbers = [int(w) - 1 for w in words[1:]]
            curves[-1] += zip(numbers, numbers[1:])
    return [[[vertices[v] for v in part] for part in joined(segments)] for segments in curves]


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
        curves.setdefault(a[1], []).append((a[0], b[0]))
    return [joined(segments) for _, segments in sorted(curves.items())]


def read_tubes(path):
    """Binary PLY of closed surfaces: how many, their vertices and their volume, for each curve."""
    head, body = open(path, "rb").read().split(b"end_header\n", 1)
    lines = head.decode("utf-8").split("\n")
    assert lines[:2] == ["ply", "format binary_little_endian 1.0"], lines
    counts = {l.split()[1]: int(l.split()[2]) for l in lines if l.startswith("element")}
    assert [l.split(" ", 1)[1] for l in lines if l.startswith("property")] == [
        "double x", "double y", "double z", "float nx", "float ny", "float nz", "uchar red",
        "uchar green", "uchar blue", "int curve", "list uchar int vertex_indices"]
    vertex, face = struct.Struct("<3d3f3Bi"), struct.Struct("<B3i")
    assert len(body) == vertex.size * counts["vertex"] + face.size * counts["face"]
    vertices = list(vertex.iter_unpack(body[: vertex.size * counts["vertex"]]))
    faces = [f[1:] for f in face.iter_unpack(body[vertex.size * counts["vertex"]:]) if f[0] == 3]
    assert len(faces) == counts["face"]
    group = list(range(len(vertices)))

    def root(v):
        while group[v] != v:
            group[v] = group[group[v]]
            v = group[v]
        return v

    edges, volume = {}, {}
    for f in faces:
        curve, = {vertices[v][9] for v in f}
        a, b, c = (vertices[v][:3] for v in f)
        volume[curve] = volume.get(curve, 0) + (
            a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
        for k in range(3):
            edge = f[k], f[(k + 1) % 3]
            assert edge not in edges, "two faces run along an edge the same way"
            edges[edge] = True
            group[root(edge[0])] = root(edge[1])
    assert all((b, a) in edges for a, b in edges), "an edge has one face"
    for curve in sorted(volume):
        mine = [v for v in range(len(vertices)) if vertices[v][9] == curve]
        print(len({root(v) for v in mine}), len(mine), volume[curve].hex())


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


if sys.argv[1] == "ply-tubes":
    read_tubes(sys.argv[2])
    sys.exit()
readers = {"obj": read_obj, "csv": read_csv, "ply": read_ply, "json": read_json}
for curve in readers[sys.argv[1]](*sys.argv[2:]):
    measure(curve)
