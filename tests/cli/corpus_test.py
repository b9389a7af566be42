"""Other people's test models: corpus_test.py PROGRAM [FOLDER].

`mimicry info` must open at least nine in ten of the models that another reader (Debian's assimp-utils) finds faces
in, with as many faces. FOLDER is that of Debian's assimp-testmodels where none is given; skips where they are not
installed: apt-get install assimp-testmodels assimp-utils"""

import json
import os
import re
import shutil
import subprocess
import sys

PROGRAM = sys.argv[1]
FOLDER = sys.argv[2] if len(sys.argv) > 2 else "/usr/share/assimp/models"
ENDINGS = (".obj", ".ply", ".stl", ".off", ".glb", ".gltf")
# glTF 1.0 and files that are damaged on purpose.
EXOTIC = ("/glTF/", "/invalid/", "/SchemaFailures/", "/wrongTypes/", "/IndexOutOfRange/", "/MissingBin/",
          "/RecursiveNodes/")
LEAST_SHARE = 0.9


def elsewhere(path):
    """Whether assimp finds faces, and how many triangles; None for those where its number is another thing: of
    polygons, with lines and points, or of meshes that several nodes show."""
    done = subprocess.run(["assimp", "info", path, "-r", "-s"], capture_output=True, text=True, timeout=1800,
                          check=False)
    kinds = re.search(r"^Primitive Types:\s*(\S+)", done.stdout, re.MULTILINE)
    if not kinds or not re.search("triangles|polygons", kinds.group(1)):
        return False, None
    if kinds.group(1) != "triangles" or path.lower().endswith((".glb", ".gltf")):
        return True, None
    return True, int(re.search(r"^Faces:\s*(\d+)", done.stdout, re.MULTILINE).group(1))


def main():
    if not os.path.isdir(FOLDER) or not shutil.which("assimp"):
        print("no models in", FOLDER, "or no assimp - skipped")
        return 77
    opened, compared, other, refused, differ = 0, 0, 0, [], []
    for folder, _, names in sorted(os.walk(FOLDER)):
        for name in sorted(names):
            path = os.path.join(folder, name)
            if not name.lower().endswith(ENDINGS) or any(word in path for word in EXOTIC):
                continue
            done = subprocess.run([PROGRAM, "info", path, "--json"], capture_output=True, text=True, timeout=1800,
                                  check=False)
            assert done.returncode in (0, 3, 4), (path, done.returncode, done.stderr)
            has_faces, expected = elsewhere(path)
            if not has_faces:
                other += 1
                continue
            try:
                faces = json.loads(done.stdout)["faces"]
            except json.JSONDecodeError:
                refused.append((path, done.stderr.strip().splitlines()[-1]))
                continue
            opened += 1
            compared += expected is not None
            if expected not in (None, faces):
                differ.append((path, faces, expected))
    for path, why in refused:
        print("refused:", path, "-", why)
    for path, faces, expected in differ:
        print("differs:", path, "-", faces, "faces, elsewhere", expected)
    total = opened + len(refused)
    print(f"{opened} of {total} models opened; {compared} counts of faces compared, {len(differ)} differ; "
          f"{other} models without faces elsewhere")
    assert total >= 20 and compared >= 10, "too few models to tell"
    return 0 if opened >= LEAST_SHARE * total and not differ else 1


sys.exit(main())
