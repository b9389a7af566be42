"""mimicry paint: paint_test.py PROGRAM."""

import json
import os
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

PROGRAM = sys.argv[1]


def run(*args, expect=0):
    done = subprocess.run([PROGRAM, *args], capture_output=True, text=True, timeout=1800)
    assert done.returncode == expect, (args, done.returncode, done.stdout, done.stderr)
    return done


def read_png(data):
    """Width and rows of RGB bytes of an 8-bit PNG."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", body[:10])
            assert (depth, color) == (8, 2)
        if kind == b"IDAT":
            packed += body
        at += 12 + size
    raw, rows = zlib.decompress(packed), []
    before = bytearray(3 * width)
    for y in range(height):
        start = y * (3 * width + 1)
        kind, line = raw[start], bytearray(raw[start + 1:start + 1 + 3 * width])
        for i in range(3 * width):
            a, b = (line[i - 3] if i >= 3 else 0), before[i]
            c = before[i - 3] if i >= 3 else 0
            p = a + b - c
            paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            line[i] = (line[i] + (0, a, b, (a + b) // 2, paeth)[kind]) & 255
        rows.append(bytes(line))
        before = line
    return width, rows


def write_png(path, width, height, pixel):
    """An RGBA picture; pixel(x, y) is four bytes."""
    raw = b"".join(b"\0" + b"".join(bytes(pixel(x, y)) for x in range(width)) for y in range(height))
    chunks = (b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)), \
        (b"IDAT", zlib.compress(raw)), (b"IEND", b"")
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for kind, body in chunks:
            file.write(struct.pack(">I", len(body)) + kind + body +
                       struct.pack(">I", zlib.crc32(kind + body)))


class Paint(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.mesh = cls.path("torus.ply")
        run("shapes", "torus", "--resolution", "12", "--out", cls.mesh)
        run("simulate", cls.mesh, "--shape", "torus", "--rate", "30", "-o", cls.path("s.json"))
        run("project", cls.mesh, cls.path("s.json"), "-t", "snap", "--formats", "json", "-o",
            cls.path("out"))
        cls.curves = cls.path("out", "curves.json")

    @classmethod
    def path(cls, *names):
        return os.path.join(cls.folder.name, *names)

    def paint(self, *args, expect=0):
        for name, value in (("--size", "256"), ("--radius", "0.02")):
            if name not in args:
                args += (name, value)
        return run("paint", self.mesh, self.curves, *args, expect=expect)

    def test_glb_holds_the_texture_and_its_coordinates(self):
        summary = json.loads(self.paint("-o", self.path("a.glb"), "--png", self.path("a.png"),
                                        "--color", "#0000ff", "--hardness", "1", "--json").stdout)
        self.assertGreater(summary["texels_painted"], 1000)
        with open(self.path("a.glb"), "rb") as file:
            data = file.read()
        size = struct.unpack("<I", data[12:16])[0]
        gltf, binary = json.loads(data[20:20 + size]), data[28 + size:]
        view = gltf["bufferViews"][gltf["images"][0]["bufferView"]]
        with open(self.path("a.png"), "rb") as file:
            png = file.read()
        self.assertEqual(binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]], png)
        primitive = gltf["meshes"][0]["primitives"][0]
        material = gltf["materials"][primitive["material"]]["pbrMetallicRoughness"]
        self.assertEqual(material["baseColorTexture"]["index"], 0)
        self.assertIn("NORMAL", primitive["attributes"])
        uv = gltf["accessors"][primitive["attributes"]["TEXCOORD_0"]]
        self.assertEqual(uv["count"], 3 * summary["faces"])

        # What is blue in the picture lies where the curves run: at a curve's points, by the
        # coordinates of their faces.
        width, rows = read_png(png)
        start = gltf["bufferViews"][uv["bufferView"]]["byteOffset"]
        places = struct.unpack(f"<{2 * uv['count']}f", binary[start:start + 8 * uv["count"]])
        start = gltf["bufferViews"][gltf["accessors"][primitive["indices"]]["bufferView"]]["byteOffset"]
        corners = struct.unpack(f"<{uv['count']}I", binary[start:start + 4 * uv["count"]])
        with open(self.curves, encoding="utf-8") as file:
            curve = json.load(file)["curves"][0]
        seen = 0
        for point in curve["points"]:
            face, bary = point["face"], point["bary"]
            u, v = (sum(b * places[2 * corners[3 * face + k] + i] for k, b in enumerate(bary))
                    for i in (0, 1))
            x, y = round(u * width - 0.5), round(v * width - 0.5)
            self.assertEqual(tuple(rows[y][3 * x:3 * x + 3]), (0, 0, 255), point)
            seen += 1
        self.assertGreater(seen, 20)
        self.assertIn(bytes((255, 255, 255)), [row[:3] for row in rows])

    def test_obj_names_its_material_and_image(self):
        self.paint("-o", self.path("b.obj"))
        with open(self.path("b.obj"), encoding="utf-8") as file:
            lines = file.read().split("\n")
        self.assertEqual(lines[0], "mtllib b.mtl")
        self.assertIn("usemtl paint", lines)
        with open(self.path("b.mtl"), encoding="utf-8") as file:
            self.assertIn("map_Kd b.png", file.read())
        with open(self.path("b.png"), "rb") as file:
            self.assertEqual(read_png(file.read())[0], 256)
        # The file's own coordinates can be painted on again.
        again = run("paint", self.path("b.obj"), self.curves, "--atlas", "mesh", "--size", "256",
                    "--radius", "0.02", "-o", self.path("c.glb"), "--json")
        self.assertGreater(json.loads(again.stdout)["texels_painted"], 1000)

    def test_ply_has_a_colour_a_vertex(self):
        self.paint("-o", self.path("d.ply"), "--color", "#ff0000")
        info = json.loads(run("info", self.path("d.ply"), "--json").stdout)
        self.assertGreater(info["attributes"]["colors"], 1)
        # Colours of a mesh are what paint is laid on.
        out = run("paint", self.path("d.ply"), self.curves, "--opacity", "0", "--size", "256",
                  "--radius", "0.02", "--png", self.path("e.png"), "--json")
        self.assertEqual(json.loads(out.stdout)["texels_painted"], 0)
        with open(self.path("e.png"), "rb") as file:
            rows = read_png(file.read())[1]
        self.assertTrue(any(row[3 * x] > 200 and row[3 * x + 1] < 60 for row in rows
                            for x in range(256)))

    def test_faces_without_texels_give_no_colours(self):
        # Two triangles after faces that repeat a corner, which have no texture coordinates.
        corners = ("0 0", "1 0", "1 1", "0 1")
        lines = [f"v {c} 0" for c in corners] + [f"vt {c}" for c in corners]
        lines += [f"f {k} {k} {k % 4 + 1}" for k in range(1, 5)]
        lines += ["f 1/1 2/2 3/3", "f 1/1 3/3 4/4"]
        with open(self.path("repeats.obj"), "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")
        with open(self.curves, encoding="utf-8") as file:
            curves = json.load(file)
        curve = curves["curves"][0]
        curve["points"], curve["pieces"] = curve["points"][:1], []
        curve["points"][0].update({"face": 4, "bary": [0, 0, 1], "position": [1, 1, 0]})
        curves["curves"], curves["target"] = [curve], {"name": "repeats", "vertices": 4, "faces": 6}
        with open(self.path("dab.json"), "w", encoding="utf-8") as file:
            json.dump(curves, file)
        for atlas in ("cells", "mesh"):
            for name in ("repeats.ply", "repeats.glb"):
                run("paint", self.path("repeats.obj"), self.path("dab.json"), "--atlas", atlas,
                    "--size", "256", "--radius", "0.3", "--model-units", "--base", "#00ff00",
                    "--color", "#ff0000", "-o", self.path(name))
            with open(self.path("repeats.ply"), "rb") as file:
                data = file.read()
            self.assertEqual(data.count(bytes((255, 0, 0, 255))), 1)  # the vertex under the brush
            self.assertEqual(data.count(bytes((0, 255, 0, 255))), 3)

    def test_bad_input_is_refused_and_leaves_nothing(self):
        out = self.path("bad.glb")
        for arguments, why in (
                (["--radius", "0"], "radius is not above 0"),
                (["--radius", "nan"], "radius is not above 0"),
                (["--hardness", "2"], "hardness is out of range; give 0 to 1"),
                (["--size", "0"], "give 256 to 8192"),
                (["--size", "1000000"], "give 256 to 8192"),
                (["--color", "red"], "write #rrggbb"),
                (["--atlas", "mesh"], "take the atlas 'cells'")):
            done = self.paint("-o", out, *arguments, expect=3)
            self.assertIn(why, done.stderr)
        done = run("paint", "shape:cube", self.curves, "-o", out, expect=3)
        self.assertIn("was drawn on a mesh of", done.stderr)
        with open(self.curves, encoding="utf-8") as file:
            moved = json.load(file)
        moved["curves"][0]["points"][3]["position"][0] += 0.5
        with open(self.path("moved.json"), "w", encoding="utf-8") as file:
            json.dump(moved, file)
        done = run("paint", self.mesh, self.path("moved.json"), "-o", out, expect=3)
        self.assertIn("curve 0: point 3 lies elsewhere", done.stderr)
        self.paint("-o", self.path("bad.stl"), expect=2)
        self.paint("-o", out, "--png", out, expect=2)
        self.paint(expect=2)
        self.assertFalse(any(name.startswith("bad") for name in os.listdir(self.folder.name)))

    def test_stamps_and_ribbons_are_images(self):
        image = self.path("image.png")
        write_png(image, 16, 8, lambda x, y: (0, 255, 0, 255) if x < 8 else (0, 0, 255, 255))
        for option in (["--stamp", image, "--align", "fixed", "--rotation", "30"],
                       ["--stamp", image, "--size-jitter", "0.3", "--seed", "4"],
                       ["--ribbon", image]):
            self.paint("--png", self.path("i.png"), *option)
            with open(self.path("i.png"), "rb") as file:
                rows = read_png(file.read())[1]
            pixels = {row[3 * x:3 * x + 3] for row in rows for x in range(256)}
            self.assertTrue({b"\0\xff\0", b"\0\0\xff"} <= pixels, option)
        self.paint("--png", self.path("i.png"), "--stamp", image, "--ribbon", image, expect=2)
        with open(image, "rb") as file:
            whole = file.read()
        with open(image, "wb") as file:
            file.write(whole[:50])
        done = self.paint("--png", self.path("bad.png"), "--stamp", image, expect=3)
        self.assertIn("image.png: cannot be read as PNG", done.stderr)
        with open(image, "wb") as file:  # a header that claims too much
            head = whole[:16] + struct.pack(">II", 20000, 8) + whole[24:29]
            file.write(head + struct.pack(">I", zlib.crc32(head[12:])) + whole[33:])
        done = self.paint("--png", self.path("bad.png"), "--ribbon", image, expect=3)
        self.assertIn("20000 x 8 pixels; give at most 16384 a side", done.stderr)
        self.assertFalse(os.path.exists(self.path("bad.png")))

    def test_same_input_same_bits_and_any_radius(self):
        for name in ("f.glb", "g.glb"):
            self.paint("-o", self.path(name), "--radius", "1e9", "--blend", "max")
        with open(self.path("f.glb"), "rb") as one, open(self.path("g.glb"), "rb") as two:
            self.assertEqual(one.read(), two.read())

    def test_too_few_texels_are_told(self):
        run("shapes", "torus", "--resolution", "60", "--out", self.path("fine.ply"))
        with open(self.curves, encoding="utf-8") as file:
            curves = json.load(file)
        curves["curves"], curves["target"] = [], {"name": "fine", "vertices": 10800, "faces": 21600}
        with open(self.path("none.json"), "w", encoding="utf-8") as file:
            json.dump(curves, file)
        done = run("paint", self.path("fine.ply"), self.path("none.json"), "--size", "256", "--png",
                   self.path("h.png"))
        self.assertIn("give --size 512 for more", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
