"""Reads PLY, STL and OFF with Python alone, as the independent reader of the writers' tests.

Usage: independent_reader.py FORMAT FILE. Prints one line per vertex, 'v' and three hexadecimal
floats, and one per face, 'f' and its vertices from 0. STL has one vertex per corner.
"""

import struct
import sys


def read_ply(data):
    head, body = data.split(b"end_header\n", 1)
    lines = head.decode("ascii").split("\n")
    binary = lines[1] == "format binary_little_endian 1.0"
    assert lines[0] == "ply" and (binary or lines[1] == "format ascii 1.0"), lines[:2]
    counts = {l.split()[1]: int(l.split()[2]) for l in lines if l.startswith("element")}
    properties = [l for l in lines if l.startswith("property")]
    assert properties == ["property double " + c for c in "xyz"] + [
        "property list uchar int vertex_indices"], properties
    if binary:
        nv, nf = counts["vertex"], counts["face"]
        assert len(body) == 24 * nv + 13 * nf, len(body)
        vertices = [struct.unpack_from("<3d", body, 24 * k) for k in range(nv)]
        faces = [struct.unpack_from("<B3i", body, 24 * nv + 13 * k) for k in range(nf)]
        assert all(f[0] == 3 for f in faces)
        return vertices, [f[1:] for f in faces]
    words = iter(body.split())
    vertices = [tuple(float(next(words)) for _ in "xyz") for _ in range(counts["vertex"])]
    faces = [tuple(int(next(words)) for _ in range(int(next(words)))) for _ in
             range(counts["face"])]
    assert next(words, None) is None
    return vertices, faces


def check_normal(normal, corners):
    a, b, c = corners
    u = [b[k] - a[k] for k in range(3)]
    v = [c[k] - a[k] for k in range(3)]
    n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    length = sum(x * x for x in n) ** 0.5
    assert all(abs(normal[k] - n[k] / length) < 1e-6 for k in range(3)), (normal, n)


def read_stl(data):
    vertices = []
    if data.startswith(b"solid"):
        lines = data.decode("ascii").split("\n")
        assert lines[-1] == "" and lines[-2].startswith("endsolid")
        assert (len(lines) - 3) % 7 == 0
        for at in range(1, len(lines) - 2, 7):
            facet = [line.split() for line in lines[at:at + 7]]
            assert facet[0][:2] == ["facet", "normal"] and facet[1] == ["outer", "loop"]
            assert facet[5] == ["endloop"] and facet[6] == ["endfacet"]
            corners = [tuple(map(float, words[1:])) for words in facet[2:5]]
            check_normal(list(map(float, facet[0][2:])), corners)
            vertices += corners
    else:
        count, = struct.unpack_from("<I", data, 80)
        assert len(data) == 84 + 50 * count
        for f in range(count):
            values = struct.unpack_from("<12f", data, 84 + 50 * f)
            corners = [values[3:6], values[6:9], values[9:12]]
            check_normal(values[:3], corners)
            vertices += corners
    return vertices, [(k, k + 1, k + 2) for k in range(0, len(vertices), 3)]


def read_off(data):
    lines = data.decode("ascii").split("\n")
    assert lines[0] == "OFF" and lines[-1] == ""
    nv, nf, _ = map(int, lines[1].split())
    assert len(lines) == 3 + nv + nf
    vertices = [tuple(map(float, line.split())) for line in lines[2:2 + nv]]
    faces = [tuple(map(int, line.split())) for line in lines[2 + nv:-1]]
    assert all(f[0] == 3 and len(f) == 4 for f in faces)
    return vertices, [f[1:] for f in faces]


def main():
    with open(sys.argv[2], "rb") as file:
        vertices, faces = {"ply": read_ply, "stl": read_stl, "off": read_off}[sys.argv[1]](
            file.read())
    for vertex in vertices:
        print("v", *(x.hex() for x in vertex))
    for face in faces:
        print("f", *face)


main()
