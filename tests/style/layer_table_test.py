"""A dependency outside HEDGEHOP_LAYERS stops the configuration; one inside does not."""

import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]

PROJECT = """
cmake_minimum_required(VERSION 3.25)
project(layers LANGUAGES CXX)
set(HEDGEHOP_LAYERS "vision:" "dynamics:" "avoidance: vision")
list(APPEND CMAKE_MODULE_PATH {modules})
include(HedgehopLibrary)
hedgehop_library(vision HDRS a.h SRCS a.cpp)
{library}
"""


def configure(library):
    """Configures a small project with one more library. Returns CMake's exit status and output."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "a.h").write_text("#pragma once\n")
        (root / "a.cpp").write_text("int a = 1;\n")
        (root / "CMakeLists.txt").write_text(PROJECT.format(modules=ROOT / "cmake", library=library))
        cmake = os.environ.get("CMAKE_COMMAND", "cmake")
        done = subprocess.run([cmake, "-G", "Ninja", "-S", folder, "-B", root / "build"], capture_output=True, text=True)
        return done.returncode, " ".join((done.stdout + done.stderr).split())


class LayerTable(unittest.TestCase):
    def test_a_dependency_of_the_table_is_taken(self):
        status, said = configure("hedgehop_library(avoidance HDRS a.h SRCS a.cpp DEPS vision)")
        self.assertEqual(status, 0, said)

    def test_a_dependency_outside_the_table_stops_the_configuration(self):
        status, said = configure("hedgehop_library(avoidance HDRS a.h SRCS a.cpp DEPS vision dynamics)")
        self.assertNotEqual(status, 0)
        self.assertIn("avoidance may not depend on dynamics; it may use: vision", said)

    def test_a_folder_without_a_row_stops_the_configuration(self):
        status, said = configure("hedgehop_library(newroom HDRS a.h SRCS a.cpp)")
        self.assertNotEqual(status, 0)
        self.assertIn("newroom has no row in HEDGEHOP_LAYERS", said)


if __name__ == "__main__":
    unittest.main()
