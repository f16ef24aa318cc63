"""Renderers are loaded when they are requested, and no renderer replaces another one.

    renderers_test.py PROGRAM LIBRARIES    the program, and the folder of the libraries that it loads when it needs them

A library counts as missing if an empty file of its name comes first in the search path of the dynamic linker. The oracle of
the loaded libraries is the log of the dynamic linker (LD_DEBUG=files).
"""

import ctypes
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM, LIBRARIES = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
SCENARIO = pathlib.Path(__file__).resolve().parents[3] / "configs/garratt2009_room_0_light.yaml"
SHORT = ["--set", "duration=0.1", "--set", "checks=[]", "--set", "scene.texture_size=64"]
FILES = {"osmesa": "libOSMesa.so.8", "egl": "libEGL.so.1"}
GL = re.compile(r"lib(OSMesa|GL|OpenGL|EGL|GLES\w*|glapi|gallium|LLVM)\b")
MESA = re.compile(r"lib(OSMesa|\w+_mesa|EGL|glapi|gallium|LLVM)\b")


def is_installed(renderer):
    """Whether the dynamic linker finds the library of a renderer."""
    try:
        ctypes.CDLL(FILES[renderer])
    except OSError:
        return False
    return True


class Renderers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def hedgehop(self, *words, missing=(), **environment):
        """Runs the program in the test's folder. missing: renderers whose libraries cannot be loaded."""
        if missing:
            hidden = self.folder / "hidden"
            hidden.mkdir(exist_ok=True)
            for renderer in missing:
                (hidden / FILES[renderer]).touch()
            environment["LD_LIBRARY_PATH"] = str(hidden)
        return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, cwd=self.folder, env={**os.environ, **environment})

    def require_refused(self, done, renderer):
        self.assertEqual(done.returncode, 2, done.stderr)
        line = done.stderr.splitlines()[0]
        self.assertIn(f"{renderer}: not available: ", line)
        self.assertIn(FILES[renderer], line)  # the reason
        self.assertIn("--renderer tiles", line)
        self.assertEqual(list(self.folder.rglob("*.png")) + list(self.folder.rglob("result.json")), [])

    def test_a_missing_library_is_an_error_that_names_tiles(self):
        for renderer in FILES:
            with self.subTest(renderer):
                image = ["render", SCENARIO, *SHORT, "--camera", "front", "--renderer", renderer, "-o", "front.png"]
                self.require_refused(self.hedgehop(*image, missing=[renderer]), renderer)
                flight = ["run", SCENARIO, *SHORT, "--renderer", renderer, "--no-video", "--no-report", "--out", "flight"]
                done = self.hedgehop(*flight, missing=[renderer])
                self.require_refused(done, renderer)
                self.assertEqual(len(done.stderr.splitlines()), 1)
                self.assertIn(f"{FILES[renderer]} cannot be loaded: ", done.stderr)  # an empty file is not absent
                self.assertNotIn("; install ", done.stderr)

    def test_the_default_renderer_is_never_replaced(self):
        self.require_refused(self.hedgehop("run", SCENARIO, *SHORT, "--no-video", "--out", "flight", missing=["osmesa"]), "osmesa")

    def test_a_library_that_is_not_mesa_is_an_error(self):
        hidden = self.folder / "hidden"
        hidden.mkdir()
        zlib = re.search(r"libz\.so\S* => (\S+)", subprocess.run(["ldd", PROGRAM], capture_output=True, text=True, check=True).stdout)
        (hidden / FILES["osmesa"]).symlink_to(zlib.group(1))
        done = self.hedgehop("render", "--info", "--renderer", "osmesa", LD_LIBRARY_PATH=str(hidden))
        self.assertEqual(done.returncode, 2)
        self.assertIn("osmesa: not available: libOSMesa.so.8 has no OSMesa", done.stderr)

    def test_info_lists_all_renderers_with_reasons(self):
        done = self.hedgehop("render", "--info", missing=FILES)
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = done.stdout.splitlines()
        self.assertEqual([line.split(":")[0] for line in lines], ["osmesa", "egl", "tiles"])
        for line, file in zip(lines, FILES.values()):
            self.assertIn("not available: ", line)
            self.assertIn(file, line)
        self.assertTrue(lines[2].startswith("tiles: Hedgehop; "), lines[2])

    def test_tiles_flies_without_the_libraries_of_mesa(self):
        done = self.hedgehop("run", SCENARIO, *SHORT, "--renderer", "tiles", "--no-video", "--no-report", "--json", "--out", "flight", missing=FILES)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(json.loads(done.stdout)["libraries"]["renderer"], "^tiles: Hedgehop; ")

    def test_installed_renderers_are_available(self):
        for renderer in FILES:
            with self.subTest(renderer):
                done = self.hedgehop("render", "--info", "--renderer", renderer)
                self.assertEqual(done.returncode == 0, is_installed(renderer), done.stderr)

    def test_each_renderer_loads_its_own_library_alone_and_the_result_names_it(self):
        for renderer in ["tiles", *filter(is_installed, FILES)]:
            with self.subTest(renderer):
                log = self.folder / renderer
                done = self.hedgehop("run", SCENARIO, *SHORT, "--renderer", renderer, "--no-video", "--no-report", "--json", "--out", "flight",
                                     LD_DEBUG="files", LD_DEBUG_OUTPUT=str(log))
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(json.loads(done.stdout)["libraries"]["renderer"].split(":")[0], renderer)
                loaded = set(re.findall(r"file=(\S+) \[0\];  dynamically loaded", next(self.folder.glob(f"{renderer}.*")).read_text()))
                own = [loads for loads in FILES.values() if loads in loaded]
                self.assertEqual(own, [FILES[renderer]] if renderer in FILES else [])

    def test_no_library_of_opengl_is_linked(self):
        built = [PROGRAM, *LIBRARIES.glob("libhedgehop_*.so")]
        self.assertGreater(len(built), 1)
        for file in built:
            dynamic = subprocess.run(["readelf", "-d", file], capture_output=True, text=True, check=True).stdout
            needed = re.findall(r"NEEDED.*\[(.*)\]", dynamic)
            self.assertIn("libstdc++.so.6", needed)
            self.assertEqual(list(filter(GL.match, needed)), [], file)
        loaded = re.findall(r"(\S+) => ", subprocess.run(["ldd", PROGRAM], capture_output=True, text=True, check=True).stdout)
        self.assertLess(len(loaded), 60)
        self.assertEqual(list(filter(MESA.match, loaded)), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
