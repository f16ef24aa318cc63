"""`pip install .` packs the build for the interpreter that runs it. The compilation is a stand-in: scripts/build and cmake
record their arguments and link the package of this build.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import unittest
import zipfile

import hedgehop
from flights import PROGRAM, SOURCE, VERSION
from interpreter_test import PREFIX

PACKAGE = pathlib.Path(hedgehop.__file__).parent
NATIVE = f"_native{sysconfig.get_config_var('EXT_SUFFIX')}"
SCRIPTS_BUILD = f"""#!/bin/sh
echo scripts/build "$@" >> arguments
mkdir -p build/release/python build/release/sim/cli build/release/lib
ln -sfn "$PACKAGE" build/release/python/hedgehop
ln -sf "{PROGRAM}" build/release/sim/cli/hedgehop
"""
CMAKE = """#!/bin/sh
echo cmake "$@" >> arguments
[ "$1" = --build ] || exit 0
mkdir -p "$2/python" && ln -s "$PACKAGE" "$2/python/hedgehop"
"""


class Wheel(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.tree = self.folder / "a tree"
        (self.tree / "scripts").mkdir(parents=True)
        for file in ("setup.py", "pyproject.toml"):
            shutil.copy(SOURCE / file, self.tree)
        for file, text in ((self.tree / "scripts/build", SCRIPTS_BUILD), (self.folder / "cmake", CMAKE)):
            file.write_text(text)
            file.chmod(0o755)

    def package_with(self, native):
        folder = self.folder / "hedgehop"
        folder.mkdir()
        (folder / native).touch()
        return folder

    def environment(self, *options):
        folder = self.folder / "venv"
        subprocess.run([sys.executable, "-m", "venv", "--without-pip", "--system-site-packages", *options, folder], check=True)
        return folder

    def pack(self, python, package=PACKAGE):
        """Returns the process, the commands that it ran, and the wheel or None."""
        done = subprocess.run([python, "setup.py", "-q", "bdist_wheel"], cwd=self.tree, capture_output=True, text=True,
                              env={**os.environ, "PACKAGE": str(package), "PATH": f"{self.folder}:{os.environ['PATH']}"})
        return done, (self.tree / "arguments").read_text().splitlines(), next(self.tree.glob("dist/*.whl"), None)

    def test_a_wheel_of_the_systems_python_is_that_of_build_release(self):
        environment = self.environment()
        done, commands, wheel = self.pack(environment / "bin/python3")
        self.assertIsNotNone(wheel, done.stderr)
        self.assertEqual(commands, ["scripts/build hedgehop_package"])
        tag = "cp" + VERSION.replace(".", "")
        self.assertRegex(wheel.name, rf"^hedgehop-[0-9.]+-{tag}-{tag}-linux_\w+\.whl$")
        packages = environment / f"lib/python{VERSION}/site-packages"
        with zipfile.ZipFile(wheel) as opened:
            opened.extractall(packages)
        imported = subprocess.run([environment / "bin/python3", "-c", "import hedgehop; print(hedgehop.__file__, hedgehop.build)"],
                                  capture_output=True, text=True, env={**os.environ, "PYTHONPATH": ""})
        self.assertEqual(imported.stdout, f"{packages}/hedgehop/__init__.py {hedgehop.build}\n", imported.stderr)
        # Modules in Python run in the interpreter of this environment, although another one is active.
        program = packages / "hedgehop/bin/hedgehop"
        program.chmod(0o755)  # zipfile does not keep modes
        module = self.folder / "prefix.py"
        module.write_text(PREFIX)
        said = subprocess.run([program, "run", SOURCE / "configs/quickstart.yaml", "--renderer", "tiles", "--no-video", "--out", self.folder / "out", "--set",
                               f"avoidance={{python: {module}, class: Prefix}}"], capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": "", "VIRTUAL_ENV": "/absent"})
        self.assertEqual(said.returncode, 2)
        self.assertIn(f"ValueError: {environment}", said.stderr)

    def test_another_python_gets_a_package_of_its_own(self):
        python = self.environment("--copies") / "bin/python3"  # not the file of the system's Python
        done, commands, wheel = self.pack(python, self.package_with(NATIVE))
        self.assertIsNotNone(wheel, done.stderr)
        configured = next(command for command in commands if " -S sim/python/other_interpreter " in command)
        self.assertIn(f" -B {self.tree}/build/python{VERSION} ", configured)
        self.assertIn(f" -DPython3_EXECUTABLE={python}", configured)
        self.assertEqual(commands[-1], f"cmake --build {self.tree}/build/python{VERSION}")

    def test_a_build_for_another_version_is_refused_with_both_names(self):
        python = self.environment() / "bin/python3"
        done, _, wheel = self.pack(python, self.package_with("_native.cpython-36m-x86_64-linux-gnu.so"))
        self.assertIsNone(wheel)
        self.assertIn(f"has no {NATIVE}, the module for {python}", done.stderr)


if __name__ == "__main__":
    unittest.main()
