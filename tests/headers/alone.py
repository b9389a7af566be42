#!/usr/bin/env python3
"""alone.py COMPILER STANDARD INCLUDE FOLDER HEADER...: each header under INCLUDE compiles alone, without a warning,
with g++ or clang++ and -std=STANDARD. Eigen, where a header leads to it, is compiled once (FOLDER): that half of a
second is most of what a header takes."""
import os
import pathlib
import re
import subprocess
import sys

COMPILER, STANDARD = sys.argv[1:3]
INCLUDE, FOLDER = pathlib.Path(sys.argv[3]), pathlib.Path(sys.argv[4])
HEADERS = sys.argv[5:]
FLAGS = ["-Wall", "-Wextra", "-Wconversion", "-Werror", "-I", str(INCLUDE), *os.environ["MIMICRY_EIGEN"].split()]
EIGEN = "#include <Eigen/Core>\n#include <Eigen/Geometry>\n"


def needs(name, seen):
    """Everything that a header leads to, by the text of its includes."""
    if name in seen or not (INCLUDE / name).is_file():
        return seen | {name}
    seen = seen | {name}
    for include in re.findall(r"^#include <([^>]+)>", (INCLUDE / name).read_text(), re.M):
        seen = needs(include, seen)
    return seen


def compile_(arguments):
    done = subprocess.run(arguments, capture_output=True, text=True)
    return done.stderr if done.returncode else ""


def precompiled():
    """Options that take Eigen from a precompiled header."""
    header = FOLDER / "eigen.h"
    header.write_text(EIGEN)
    result = f"{header}.{'pch' if COMPILER == 'clang++' else 'gch'}"
    trouble = compile_([COMPILER, f"-std={STANDARD}", *FLAGS, "-x", "c++-header", str(header), "-o", result])
    if trouble:
        sys.exit(trouble)
    return ["-include-pch", result] if COMPILER == "clang++" else ["-Winvalid-pch", "-include", str(header)]


def check(header, eigen):
    file = FOLDER / (header.replace("/", "_") + ".cpp")
    # Twice: it guards itself.
    file.write_text(f"#include <{header}>\n#include <{header}>\n")
    trouble = compile_([COMPILER, f"-std={STANDARD}", *FLAGS, *eigen, "-fsyntax-only", str(file)])
    return f"{header} alone, {COMPILER} -std={STANDARD}:\n{trouble}" if trouble else ""


def main():
    assert HEADERS, "no headers are given"
    FOLDER.mkdir(parents=True, exist_ok=True)
    eigen = precompiled()
    faults = []
    for header in HEADERS:
        leads_to_eigen = any(name.startswith("Eigen/") for name in needs(header, frozenset()))
        faults.append(check(header, eigen if leads_to_eigen else []))
    faults = [fault for fault in faults if fault]
    print(f"{len(HEADERS)} headers, {len(faults)} faults")
    sys.exit("\n".join(faults) if faults else 0)


main()
