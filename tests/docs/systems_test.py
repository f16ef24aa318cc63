"""The package names of the supported systems, the workflow that tests them, and the recipe of conda-forge.

usage: systems_test.py SOURCE
"""

import pathlib
import re
import subprocess
import sys
import unittest

import yaml

SOURCE = pathlib.Path(sys.argv[1])
# The keys of conda-build's recipes that ours may use (conda_build/metadata.py, FIELDS).
KEYS = {"package": {"name", "version"}, "source": {"path", "url", "sha256"}, "build": {"number", "skip", "script"},
        "requirements": {"build", "host", "run"}, "test": {"imports", "commands", "requires", "source_files"},
        "about": {"home", "summary", "description", "license", "license_file"}, "extra": {"recipe-maintainers"}}


def names(*arguments):
    return subprocess.run([SOURCE / "scripts/packages", "--names", *arguments], capture_output=True, text=True)


class Packages(unittest.TestCase):
    def test_every_system_has_names(self):
        for system in ("debian", "ubuntu", "fedora"):
            listed = names(system).stdout.splitlines()
            self.assertGreater(len(listed), 40, system)
            self.assertEqual(len(set(listed)), len(listed), system)
            for name in listed:
                self.assertRegex(name, r"^[A-Za-z0-9][A-Za-z0-9+.-]+$", system)
            self.assertLess(set(names(system, "fly", "python").stdout.splitlines()), set(listed), system)
        self.assertIn("libavformat-free-devel", names("fedora").stdout.splitlines())
        self.assertNotIn("-dev\n", names("fedora").stdout)

    def test_an_unknown_system_is_bad_usage(self):
        for arguments in (["plan9"], [], ["debian", "all"]):
            self.assertEqual(names(*arguments).returncode, 2)


class Workflow(unittest.TestCase):
    def setUp(self):
        self.workflow = yaml.safe_load((SOURCE / ".github/workflows/systems.yml").read_text())

    def test_its_matrix_has_the_supported_systems_and_interpreters(self):
        jobs = self.workflow["jobs"]
        self.assertEqual([system.split(":")[0] for system in jobs["suite"]["strategy"]["matrix"]["system"]],
                         ["debian", "debian", "ubuntu", "ubuntu", "fedora"])
        oldest = re.search(r'requires-python = ">=(3\.9)"', (SOURCE / "pyproject.toml").read_text())[1]
        self.assertEqual(jobs["python"]["strategy"]["matrix"]["python"], [oldest, "3.10", "3.11", "3.12", "3.13", "3.14"])

    def test_warnings_are_errors_with_the_compiler_of_development(self):
        steps = self.workflow["jobs"]["suite"]["steps"]
        strict = next(i for i, step in enumerate(steps) if "-DHEDGEHOP_WERROR=ON" in step.get("run", ""))
        first_build = next(i for i, step in enumerate(steps) if step.get("run") == "scripts/quickstart")
        self.assertLess(strict, first_build)  # a folder that quickstart configures first has no such errors
        self.assertEqual(steps[strict]["if"], "matrix.system == 'debian:12'")

    def test_its_commands_are_shell_and_their_scripts_exist(self):
        for job in self.workflow["jobs"].values():
            for step in job["steps"]:
                self.assertEqual(("uses" in step) + ("run" in step), 1, step)
                script = re.sub(r"\$\{\{.*?\}\}", "", step.get("run", ""))
                checked = subprocess.run(["bash", "-n"], input=script, capture_output=True, text=True)
                self.assertEqual((checked.returncode, checked.stderr), (0, ""), script)
                for name in re.findall(r"(?<!\S)scripts/\w+", script):
                    self.assertTrue((SOURCE / name).exists(), name)


class Recipe(unittest.TestCase):
    def setUp(self):
        text = (SOURCE / "scripts/conda/meta.yaml").read_text()
        self.variables = dict(re.findall(r'^\{% set (\w+) = "([^"]*)" %\}$', text, re.M))
        text = re.sub(r"^\{%.*%\}$", "", text, flags=re.M)
        text = re.sub(r"\{\{ (compiler|stdlib)\('(\w+)'\) \}\}", r"\1_\2", text)
        self.recipe = yaml.safe_load(re.sub(r"\{\{ (\w+) \}\}", lambda found: self.variables[found[1]], text))

    def test_its_keys_are_those_of_conda_build(self):
        for section, keys in self.recipe.items():
            self.assertLessEqual(keys.keys(), KEYS[section], section)

    def test_its_version_and_files_are_those_of_the_tree(self):
        self.assertIn(f"project(hedgehop VERSION {self.recipe['package']['version']} ", (SOURCE / "CMakeLists.txt").read_text())
        self.assertEqual((SOURCE / "scripts/conda" / self.recipe["source"]["path"]).resolve(), SOURCE.resolve())
        self.assertTrue((SOURCE / self.recipe["about"]["license_file"][0]).exists())
        for command in self.recipe["test"]["commands"]:
            for scenario in re.findall(r"\$\{PREFIX\}/share/hedgehop/(\S+)", command):
                self.assertTrue((SOURCE / scenario).exists(), scenario)

    def test_linked_packages_are_host_packages(self):
        host = {requirement.split()[0] for requirement in self.recipe["requirements"]["host"]}
        for package in re.findall(r"^find_package\(([\w-]+)", (SOURCE / "cmake/HedgehopDependencies.cmake").read_text(), re.M):
            known = {"Eigen3": "eigen", "CLI11": "cli11", "OpenSSL": "openssl", "GTest": None, "benchmark": None}.get(package, package)
            if known:
                self.assertIn(known, host)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
