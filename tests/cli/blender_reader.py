"""Runs inside Blender: blender --background --python blender_reader.py -- RESULT FILE...

Imports each file as a user would, with the importer's defaults, and writes to RESULT as JSON what is there: of
each mesh object its vertices, edges and faces, the length of all edges, how many edges have another number of
faces than two, and the names of its colours.
"""

import json
import os
import sys

import bpy
import numpy

# Blender 3.4's glTF importer uses a name that numpy has dropped since; where the two meet, it fails on any file.
if not hasattr(numpy, "bool"):
    numpy.bool = bool

# The first that this Blender has.
IMPORTERS = {
    ".obj": (("wm", "obj_import"), ("import_scene", "obj")),
    ".ply": (("wm", "ply_import"), ("import_mesh", "ply")),
    ".glb": (("import_scene", "gltf"),),
}


def importer(path):
    for group, name in IMPORTERS[os.path.splitext(path)[1]]:
        if name in dir(getattr(bpy.ops, group)):
            return getattr(getattr(bpy.ops, group), name)
    raise RuntimeError("this Blender imports no " + path)


def look(item):
    mesh = item.data
    faces = {}
    for polygon in mesh.polygons:
        for key in polygon.edge_keys:
            faces[key] = faces.get(key, 0) + 1
    length = sum((mesh.vertices[a].co - mesh.vertices[b].co).length for a, b in
                 (edge.vertices for edge in mesh.edges))
    return {"vertices": len(mesh.vertices), "edges": len(mesh.edges), "faces": len(mesh.polygons),
            "length": length, "odd_edges": sum(faces.get(e.key, 0) != 2 for e in mesh.edges),
            "colors": [c.name for c in getattr(mesh, "color_attributes", mesh.vertex_colors)],
            "materials": [m.name for m in mesh.materials if m]}


result, *paths = sys.argv[sys.argv.index("--") + 1:]
found = {}
for path in paths:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    importer(path)(filepath=path)
    found[path] = {item.name: look(item) for item in bpy.data.objects if item.type == "MESH"}
with open(result, "w", encoding="utf-8") as file:
    json.dump({"version": bpy.app.version_string, "files": found}, file)
