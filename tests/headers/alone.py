#!/usr/bin/env python3
"""alone.py INCLUDE FOLDER HEADER...: each header under INCLUDE compiles alone, without a warning, under g++ and
clang++ as C++20, and all of them together as C++23: what one lacks it lacks in either standard. Eigen, where a header
leads to it, is compiled once for each compiler (FOLDER): that half of a second is most of what a header takes."""
import os
import pathlib
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

INCLUDE, FOLDER = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
HEADERS = sys.argv[3:]
COMPILERS = {  # with the names that they have for the two standards, and of a precompiled header
    "g++": (["c++20", "c++23"], "gch"),
    "clang++": (["c++20", "c++2b"], "pch"),
}
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


def precompiled(compiler, standard):
    """Options that take Eigen from a precompiled header."""
    folder = FOLDER / f"{compiler}-{standard}"
    folder.mkdir(parents=True, exist_ok=True)
    header = folder / "eigen.h"
    header.write_text(EIGEN)
    result = f"{header}.{COMPILERS[compiler][1]}"
    trouble = compile_([compiler, f"-std={standard}", *FLAGS, "-x", "c++-header", str(header), "-o", result])
    if trouble:
        sys.exit(trouble)
    return ["-include-pch", result] if compiler == "clang++" else ["-Winvalid-pch", "-include", str(header)]


def check(task):
    compiler, standard, header, eigen = task
    file = FOLDER / f"{compiler}-{standard}" / (header.replace("/", "_") + ".cpp")
    # Twice: it guards itself.
    file.write_text(f"#include <{header}>\n#include <{header}>\n")
    trouble = compile_([compiler, f"-std={standard}", *FLAGS, *eigen, "-fsyntax-only", str(file)])
    return f"{header} alone, {compiler} -std={standard}:\n{trouble}" if trouble else ""


def check_together(task):
    compiler, standard = task
    file = FOLDER / f"{compiler}-{standard}.cpp"
    file.write_text("".join(f"#include <{header}>\n" for header in HEADERS))
    trouble = compile_([compiler, f"-std={standard}", *FLAGS, "-fsyntax-only", str(file)])
    return f"all headers, {compiler} -std={standard}:\n{trouble}" if trouble else ""


def main():
    assert HEADERS, "no headers are given"
    leads_to_eigen = {h: any(n.startswith("Eigen/") for n in needs(h, frozenset())) for h in HEADERS}
    FOLDER.mkdir(parents=True, exist_ok=True)
    tasks, together = [], []
    for compiler, ((first, later), _) in COMPILERS.items():
        eigen = precompiled(compiler, first)
        tasks += [(compiler, first, h, eigen if leads_to_eigen[h] else []) for h in HEADERS]
        together.append((compiler, later))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        faults = [*pool.map(check_together, together), *pool.map(check, tasks)]
    faults = [fault for fault in faults if fault]
    print(f"{len(HEADERS)} headers, {len(tasks) + len(together)} compilations, {len(faults)} faults")
    sys.exit("\n".join(faults) if faults else 0)


main()
