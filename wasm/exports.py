#!/usr/bin/env python3
"""From include/mimicry/mimicry.h: the functions that the WebAssembly modules export, and their types.

exports.py types HEADER OUT.ts    an interface with every function
exports.py list HEADER MODULE     the names for emscripten, of `core` or `bake`
"""
import re
import sys

# Numbers all: 64-bit integers do not occur in the header.
FUNCTION = re.compile(r"MIMICRY_API\s+([\w\s*]+?)\s*\b(mimicry_\w+)\(([^)]*)\);")
BAKE_ONLY = {"mimicry_bake", "mimicry_default_bake_options"}
# What the facade does not reach stays out of the module: a study's tools, callbacks and structures that are returned (the core has
# functions of its own in their place, CORE_TOO), and other programs' coordinates, as those of a page are the library's.
NOT_HERE = re.compile(r"mimicry_(target_curves_\w+|strokes_simulate|default_s\w+_options|measure|keypoints|technique_register"
                      r"|path_finder_\w+|exponential_map_\w+|convention\w*|mesh_(texcoords|colors)"
                      r"|(frames|placement|positions|axes|mesh)_(in|out)|curve_follow)$")
CORE_TOO = {"mimicry_wasm_technique_register": "row: Pointer): number", "mimicry_wasm_mesh_texcoords": "mesh: Pointer, out: Pointer): void",
            "mimicry_wasm_mesh_colors": "mesh: Pointer, out: Pointer): void"}
BAKE_TOO = re.compile(r"mimicry_(last_error|bytes_\w+|mesh_create|mesh_destroy)$")


def functions(header):
    text = re.sub(r"/\*.*?\*/", "", open(header, encoding="utf-8").read(), flags=re.S)
    for result, name, arguments in FUNCTION.findall(text):
        if NOT_HERE.match(name):
            continue
        arguments = [] if arguments.strip() == "void" else arguments.split(",")
        yield name, ts_type(result), [(re.search(r"(\w+)(\[\d+\])?$", a.strip())[1], ts_type(a)) for a in arguments]


def ts_type(c):
    if c.strip() == "void":
        return "void"
    return "Pointer" if "*" in c or "[" in c or "mimicry_progress" in c else "number"


def types(header, out):
    lines = ["// Made by exports.py from include/mimicry/mimicry.h.", "",
             "/** An address in the module's memory; 0 is none. */", "export type Pointer = number;", "",
             "/** The C functions; what a module does not export is missing. */", "export interface Exports {"]
    for name, result, arguments in functions(header):
        if name not in BAKE_ONLY:
            lines.append(f"  _{name}({', '.join(f'{n}: {t}' for n, t in arguments)}): {result};")
    lines += [f"  _{name}({signature};" for name, signature in CORE_TOO.items()]
    lines += ["  _mimicry_wasm_bake(mesh: Pointer, options: Pointer, out: Pointer): number;",
              "  _mimicry_wasm_default_bake_options(options: Pointer): void;", "}", ""]
    with open(out, "w", encoding="utf-8") as file:
        file.write("\n".join(lines))


def names(header, module):
    found = [name for name, _, _ in functions(header)]
    if module == "core":
        found = [name for name in found if name not in BAKE_ONLY] + list(CORE_TOO)
    else:
        found = [name for name in found if BAKE_TOO.match(name)]
        found += ["mimicry_wasm_bake", "mimicry_wasm_default_bake_options"]
    print(",".join("_" + name for name in found + ["malloc", "free"]))


if __name__ == "__main__":
    {"types": types, "list": names}[sys.argv[1]](*sys.argv[2:])
