#!/usr/bin/env python3
"""part.py PART/PARTS SCRIPT [ARGUMENTS...]: runs that part of a script's test cases (1/3: the first, fourth, ...
of each class), so that they are tests of their own that end in time and run side by side."""
import runpy
import sys
import unittest

part, parts = (int(n) for n in sys.argv[1].split("/"))
script = sys.argv[2]
sys.argv = sys.argv[2:]
all_names = unittest.TestLoader.getTestCaseNames


def names_of_part(loader, test_case):
    names = all_names(loader, test_case)
    return names if parts == 1 else names[part - 1::parts]


unittest.TestLoader.getTestCaseNames = names_of_part
sys.path.insert(0, script.rpartition("/")[0])
runpy.run_path(script, run_name="__main__")
