"""The files of cmake/ in folders with special characters, and the package for projects outside the tree.

usage: cmake_files_test.py SOURCE CMAKE
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SOURCE, CMAKE = pathlib.Path(sys.argv[1]) / "cmake", sys.argv[2]
FOLDERS = ["scenes", "vision", "dynamics", "avoidance", "sim", "cmake"]
# A stand-in of cpack's program: one argument per line.
SHLIBDEPS = '#!/bin/sh\nprintf "%s\\n" "$@" > "$ARGUMENTS"\necho "shlibs:Depends=libc6"\n'
PACKAGE = """cmake_minimum_required(VERSION 3.25)
project(hedgehop VERSION 1.2.3 LANGUAGES NONE)
set(CMAKE_INSTALL_LIBDIR lib)
include(GNUInstallDirs)
add_executable(hedgehop IMPORTED GLOBAL)
set_target_properties(hedgehop PROPERTIES IMPORTED_LOCATION "${PROJECT_BINARY_DIR}/hedgehop")
foreach(name opencv film network)
  add_library(hedgehop_${name} SHARED IMPORTED GLOBAL)
  set_target_properties(hedgehop_${name} PROPERTIES IMPORTED_LOCATION "${PROJECT_BINARY_DIR}/lib${name}.so")
endforeach()
include("@SOURCE@/HedgehopPackage.cmake")
include("@SOURCE@/HedgehopBuilt.cmake")
"""
USER = """cmake_minimum_required(VERSION 3.25)
project(user LANGUAGES NONE)
find_package(hedgehop REQUIRED)
get_target_property(options hedgehop::vision INTERFACE_LINK_OPTIONS)
message(STATUS "options ${options}")
"""


class CMakeFiles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def cmake(self, *arguments, status=0, **environment):
        done = subprocess.run([CMAKE, *arguments], capture_output=True, text=True, env={**os.environ, **environment})
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def write(self, path, text):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def tree(self, name):
        for folder in FOLDERS:
            self.write(self.folder / name / folder / "a.cpp", f"int {folder};\n")
        for file in ("CMakeLists.txt", "CMakePresets.json"):
            self.write(self.folder / name / file, "")
        return self.folder / name

    def identity(self, tree, status=0):
        header = self.folder / "identity.h"
        text = self.cmake(f"-DSOURCE_DIR={tree}", f"-DHEADER={header}", "-DVERSION=1", "-DCOMPILER=c", "-DFLAGS=f", "-P",
                          SOURCE / "write_identity.cmake", status=status)
        return re.search(r'HEDGEHOP_BUILD "(\w{16})"', header.read_text())[1] if status == 0 else text

    def test_the_identity_depends_on_the_sources_and_not_on_their_folder(self):
        plain = self.identity(self.tree("plain"))
        for name in ("with [1] part", "with *?", "[unbalanced"):
            with self.subTest(name):
                tree = self.tree(name)
                self.assertEqual(self.identity(tree), plain)
                self.write(tree / "sim/loop/b.h", "")
                self.assertNotEqual(self.identity(tree), plain)

    def test_files_of_editors_and_of_python_do_not_change_the_identity(self):
        tree = self.tree("plain")
        before = self.identity(tree)
        for name in (".a.cpp.swp", ".#a.cpp", "a.cpp~", "#a.cpp#", "__pycache__/a.cpython-311.pyc", ".cache/index.json", "web/node_modules/three.js"):
            self.write(tree / "sim" / name, "x")
        self.assertEqual(self.identity(tree), before)
        self.write(tree / "sim/web/.npmrc", "x")  # a source of the pages
        self.assertNotEqual(self.identity(tree), before)

    def test_commands_and_pages_which_no_other_folder_includes_do_not_change_the_identity(self):
        tree = self.tree("plain")
        before = self.identity(tree)
        table = re.search(r"set\(HEDGEHOP_LAYERS(.*?)\)", (SOURCE.parent / "CMakeLists.txt").read_text(), re.S)[1]
        layers = dict(re.findall(r'"(\S+):(.*?)"', table))
        free = []
        for folder in layers:
            file = self.write(tree / folder / "b.h", "")
            if self.identity(tree) == before:
                free.append(folder)
            file.unlink()
        self.assertIn("sim/pages", free)
        for folder, below in layers.items():
            if folder not in free:
                self.assertFalse(set(below.split()) & set(free), folder)

    def test_a_folder_without_sources_is_an_error(self):
        tree = self.tree("plain")
        (tree / "scenes/a.cpp").unlink()
        self.assertIn("scenes has no sources", self.identity(tree, status=1))

    def package(self):
        source, build = self.folder / "a tree [1]", self.folder / "a tree [1]/the build"
        self.write(source / "CMakeLists.txt", PACKAGE.replace("@SOURCE@", str(SOURCE)))
        self.cmake("-S", source, "-B", build, "-G", "Ninja", "-Wno-dev")
        return build

    def test_dependencies_are_those_of_each_file_of_a_folder_with_a_space(self):
        build, tools = self.package(), self.folder / "tools"
        self.write(tools / "dpkg-shlibdeps", SHLIBDEPS).chmod(0o755)
        self.cmake("-DCPACK_GENERATOR=DEB", "-P", build / "HedgehopPackageDepends.cmake", PATH=f"{tools}:{os.environ['PATH']}",
                   ARGUMENTS=str(self.folder / "arguments"))
        self.assertEqual((self.folder / "arguments").read_text().splitlines(),
                         ["-O", "-dDepends", f"{build}/hedgehop", f"{build}/libopencv.so", "-dRecommends", f"{build}/libfilm.so", f"{build}/libnetwork.so"])

    def test_installing_finds_the_built_files_of_a_folder_with_a_space(self):
        build = self.package()
        install = (build / "cmake_install.cmake").read_text()
        begin = install.index("foreach(file IN ITEMS")
        check = self.write(self.folder / "check.cmake", install[begin:install.index("endforeach()", begin)] + "endforeach()\n")
        self.assertIn("the build/hedgehop is not built", re.sub(r"\s+", " ", self.cmake("-P", check, status=1)))
        self.write(build / "hedgehop", "")
        self.write(build / "manual/man/hedgehop.1", "")
        self.cmake("-P", check)

    def test_run_paths_are_those_of_hedgehop_though_other_packages_set_the_same_variable(self):
        config = self.folder / "installed/lib/cmake/hedgehop"
        self.write(self.folder / "make/CMakeLists.txt", "cmake_minimum_required(VERSION 3.25)\nproject(make LANGUAGES NONE)\n"
                   "include(CMakePackageConfigHelpers)\nset(CMAKE_INSTALL_LIBDIR lib)\n"
                   f'configure_package_config_file("{SOURCE}/hedgehopConfig.cmake.in" "{config}/hedgehopConfig.cmake"\n'
                   f'  INSTALL_DESTINATION lib/cmake/hedgehop INSTALL_PREFIX "{self.folder}/installed")\n')
        self.cmake("-S", self.folder / "make", "-B", self.folder / "make/build", "-G", "Ninja")
        for name in ("HedgehopOpenCV", "HedgehopSleef"):
            self.write(config / f"{name}.cmake", "")
        self.write(config / "hedgehopTargets.cmake", "add_library(hedgehop::vision INTERFACE IMPORTED)\n")
        self.write(self.folder / "eigen/Eigen3Config.cmake", "set(PACKAGE_PREFIX_DIR /elsewhere)\n")
        self.write(self.folder / "eigen/Eigen3ConfigVersion.cmake", "set(PACKAGE_VERSION 3.4)\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n")
        self.write(self.folder / "user/CMakeLists.txt", USER)
        text = self.cmake("-S", self.folder / "user", "-B", self.folder / "user/build", "-G", "Ninja", f"-Dhedgehop_DIR={config}",
                          f"-DEigen3_DIR={self.folder}/eigen")
        self.assertIn(f"options LINKER:-rpath,{self.folder}/installed/lib/hedgehop\n", text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
