"""The interpreter of the program has the version of the build, and the packages of the active virtual environment."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

from flights import CITY, SHORT, VERSION, run_program

PREFIX = "import sys\n\n\nclass Prefix:\n    def __init__(self):\n        raise ValueError(sys.prefix)\n"


class Interpreter(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "prefix.py").write_text(PREFIX)
        self.values = {**SHORT, "avoidance": {"python": str(self.folder / "prefix.py"), "class": "Prefix"}}

    def refusal(self, active):
        """Returns the error of a module in Python with VIRTUAL_ENV=active."""
        status, result, said = run_program(CITY, self.values, self.folder / "out", environment={"VIRTUAL_ENV": str(active)})
        self.assertEqual((status, result), (2, None))
        return said

    def test_its_packages_are_those_of_the_active_virtual_environment(self):
        active = self.folder / "venv"
        subprocess.run([sys.executable, "-m", "venv", "--without-pip", "--system-site-packages", active], check=True)
        self.assertIn(f"ValueError: {active} ", self.refusal(active))
        self.assertIn(f"ValueError: {sys.base_prefix} ", self.refusal(""))

    def test_a_virtual_environment_of_another_version_is_bad_input(self):
        for name, folders, found in (("other", ["lib/python3.6/site-packages", f"lib/python{VERSION}t/site-packages"],
                                      f"Python {VERSION}t and 3.6"), ("none", ["bin"], "no Python")):
            active = self.folder / name
            for folder in folders:
                (active / folder).mkdir(parents=True)
            said = self.refusal(active)
            self.assertIn(f"built for Python {VERSION}; the virtual environment {active} (VIRTUAL_ENV) has {found}.", said)
            self.assertEqual(said.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
