"""The shell scripts in a copy of scripts/, with stand-ins of the programs that they call: shell_scripts_test.py SOURCE."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv[1])
RECORD = 'echo "$(basename "$0") $*" >> "$RECORD"\n'
PROXIES = {"http_proxy": "http://a:1", "HTTPS_PROXY": "http://b:2", "no_proxy": "localhost"}
# apt before its first update knows no package; in German, the candidate is named otherwise.
APT_CACHE = """[ -e "$LISTS" ] || exit 0
[ -n "$2" ] || { echo " 500 http://mirror.invalid/debian bookworm/main amd64 Packages"; exit; }
[ "$2" != libosmesa6-dev ] || exit 0
if [ "$LC_ALL" = C ]; then echo "  Candidate: 1.2"; else echo "  Installationskandidat: 1.2"; fi
"""
SUDO = RECORD + 'if [ "$1" != -v ]; then exec env -i PATH="$PATH" RECORD="$RECORD" LISTS="$LISTS" "$@"; fi\n'


class ShellScripts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree, self.tools = pathlib.Path(folder.name) / "tree", pathlib.Path(folder.name) / "tools"
        self.record = pathlib.Path(folder.name) / "record"
        shutil.copytree(SOURCE / "scripts", self.tree / "scripts", ignore=shutil.ignore_patterns("*.d", "conda"))
        self.tools.mkdir()

    def stand_in(self, name, text=RECORD):
        """A program in PATH, or a file of the tree if its name has a folder."""
        file = self.tree / name if "/" in name else self.tools / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("#!/bin/bash\n" + text)
        file.chmod(0o755)

    def script(self, *words, status=0, folder=None, **environment):
        """Runs a script of the copy. Returns its text and the recorded calls."""
        self.record.write_text("")
        kept = {name: value for name, value in os.environ.items() if not name.lower().endswith("_proxy") and name != "LC_ALL"}
        done = subprocess.run(words, cwd=folder or self.tree, capture_output=True, text=True, stdin=subprocess.DEVNULL,
                              env={**kept, "PATH": f"{self.tools}:{os.environ['PATH']}", "RECORD": str(self.record), **environment})
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout + done.stderr, self.record.read_text().splitlines()

    def test_packages_are_found_in_every_locale_and_after_the_first_update(self):
        lists = self.tree / "lists"
        # All are installed, except the optional ones.
        self.stand_in("dpkg-query", '[[ ${*: -1} =~ ^(libosmesa6|libosmesa6-dev|chromium)$ ]] || echo installed\n')
        self.stand_in("apt-cache", APT_CACHE)
        self.stand_in("apt-get", RECORD + '[ "$1" != update ] || touch "$LISTS"\necho "proxy $http_proxy $HTTPS_PROXY $no_proxy" >> "$RECORD"\n')
        self.stand_in("sudo", SUDO)
        text, calls = self.script("scripts/packages", LISTS=str(lists), **PROXIES)
        installs = [call for call in calls if call.startswith("apt-get install")]
        self.assertEqual(len(installs), 1, text)
        self.assertIn(" libosmesa6", installs[0])
        self.assertNotIn("libosmesa6-dev", installs[0])
        self.assertIn("this release lacks: libosmesa6-dev", text)
        self.assertEqual({call for call in calls if call.startswith("proxy")}, {"proxy http://a:1 http://b:2 localhost"})
        self.stand_in("dpkg-query", '[ "${*: -1}" = libosmesa6-dev ] || echo installed\n')
        text, calls = self.script("scripts/packages", LISTS=str(lists))
        self.assertEqual((text, calls), ("packages: all packages are installed (this release lacks: libosmesa6-dev)\n", []))

    def test_optional_packages_that_cannot_be_looked_up_are_no_error(self):
        complete = "packages: all required packages are installed; the optional ones cannot be installed: libosmesa6-dev\n"
        self.stand_in("apt-cache", APT_CACHE)
        for fault, sudo, apt in (("no root", "exit 1\n", "exit 100\n"), ("no network", SUDO, "exit 100\n"), ("no lists after an update", SUDO, RECORD)):
            self.stand_in("sudo", sudo)
            self.stand_in("apt-get", apt)
            with self.subTest(fault):
                self.stand_in("dpkg-query", '[ "${*: -1}" = libosmesa6-dev ] || echo installed\n')
                text, _ = self.script("scripts/packages", LISTS=str(self.tree / "lists"))
                self.assertTrue(text.endswith(complete), text)
                self.assertNotIn("failed", text)
        self.stand_in("apt-get", "exit 100\n")
        self.stand_in("dpkg-query", '[[ ${*: -1} =~ ^(libosmesa6-dev|libfmt-dev)$ ]] || echo installed\n')  # fmt is required
        text, _ = self.script("scripts/packages", status=1, LISTS=str(self.tree / "lists"))
        self.assertIn("packages: failed: apt-get update\n", text)

    def test_a_linked_file_is_carried_as_its_target(self):
        (self.tree / "run").mkdir()
        (self.tree / "run/stub.conf").write_text("nameserver 127.0.0.53\n")
        (self.tree / "resolv.conf").symlink_to("run/stub.conf")
        root = self.tree / "root"
        copy = root / str(self.tree / "resolv.conf").lstrip("/")
        copy.parent.mkdir(parents=True)
        copy.symlink_to("/absent/stub.conf")  # an earlier copy of such a link
        functions = "source <(sed -n '/^carry() {/,/^}/p' scripts/bare-debian)"
        self.script("bash", "-euc", f'{functions}; carry "$1" "$2"', "bash", root, self.tree / "resolv.conf")
        self.assertEqual((copy.is_symlink(), copy.read_text()), (False, "nameserver 127.0.0.53\n"))

    @unittest.skipIf(os.geteuid() != 0, "root privileges are required")
    def test_a_bare_system_has_the_proxies_of_this_machine(self):
        (self.tree / "bare/bookworm/system/etc").mkdir(parents=True)
        (self.tree / "bare/bookworm/made").touch()
        for name in ("debootstrap", "git"):
            self.stand_in(name)
        self.stand_in("unshare", '[ "$2" = true ] && exit\nwhile (($#)) && [ "$1" != env ]; do shift; done\nprintf "%s\\n" "$@"\n')
        text, _ = self.script("scripts/bare-debian", "true", BARE_DEBIAN=str(self.tree / "bare"), **PROXIES)
        for name, value in PROXIES.items():
            self.assertIn(f"{name}={value}\n", text.partition("\nchroot\n")[0] + "\n")
        self.assertTrue(text.endswith("/bin/bash\n-c\ncd /hedgehop && true\n"), text)

    def test_no_matching_test_is_an_error(self):
        for name in ("scripts/packages", "scripts/build", "ctest"):
            self.stand_in(name)
        _, calls = self.script("scripts/test", "-R", "Absent")
        self.assertRegex(calls[-1], "^ctest .*--no-tests=error .*-R Absent$")
        (self.tree / "configs").mkdir()
        (self.tree / "configs/a.yaml").write_text("avoidance: {module: go_to_goal}\n")
        # GoogleTest lists its tests below their suites.
        self.stand_in("build/release/tests/sim/disk/sim_disk_test", RECORD + 'echo "Running main()"\n[ "$1" != --gtest_list_tests ] || echo "$LISTED"\n')
        text, _ = self.script("scripts/soak", "kills", status=1, LISTED="")
        self.assertIn("sim_disk_test has no test '*Killed*'", text)
        _, calls = self.script("scripts/soak", "kills", LISTED="Batch.\n  IsKilled")
        self.assertEqual(calls[-1], "sim_disk_test --gtest_filter=*Killed*")

    def test_a_failing_list_of_flights_is_an_error_of_soak(self):
        (self.tree / "configs").mkdir()
        (self.tree / "configs/a.yaml").write_text("avoidance: {module: go_to_goal}\n")
        (self.tree / "build").mkdir()
        for name in ("scripts/build", "valgrind"):
            self.stand_in(name)
        self.stand_in("python3", "exit 3\n")
        self.script("scripts/soak", "memory", status=3)
        self.stand_in("python3", "echo configs/a.yaml,--set speed=1\n")
        _, calls = self.script("scripts/soak", "memory")
        self.assertRegex(calls[-1], "^valgrind .* run configs/a.yaml --seed 1101 --set speed=1 ")

    def test_the_slow_checks_run_every_part_of_soak(self):
        parts = re.search(r"^  case .* in\n    (.*?)\) ", (SOURCE / "scripts/soak").read_text(), re.M)[1].split(" | ")
        self.stand_in("scripts/soak")
        _, calls = self.script("scripts/slow-checks", "tsan", "soak")
        self.assertEqual(sorted(part for call in calls for part in call.split()[1:]), sorted(parts))

    def test_fuzz_takes_a_later_clang_and_returns_1_for_a_failure(self):
        (self.tree / "tests/fuzz/corpus/mesh_obj").mkdir(parents=True)
        self.stand_in("clang++", "echo 17.0.6\n")
        self.stand_in("build/fuzz/tests/fuzz/hedgehop_fuzz", 'echo "Done 5 runs"\nexit "$FAILURE"\n')
        program = (self.tree / "build").rename(self.tree / "made")
        self.stand_in("cmake", RECORD + f'[ -d build ] && cp -r {program}/fuzz build\n')
        text, calls = self.script("scripts/fuzz", FAILURE="0")
        self.assertIn("-DCMAKE_CXX_COMPILER=clang++ ", calls[0])
        self.assertIn("mesh_obj: Done 5 runs, no failure", text)
        text, _ = self.script("scripts/fuzz", status=1, FAILURE="77")
        self.assertIn("mesh_obj: FAILED", text)

    def test_warnings_are_errors_in_builds_with_tests_only(self):
        self.stand_in("cmake")
        for purpose, off in (("fly", True), ("test", False), ("bench", False)):
            with self.subTest(purpose):
                _, calls = self.script("scripts/build", "--for", purpose)
                self.assertEqual("-DHEDGEHOP_WERROR=OFF" in calls[0], off)
        (self.tree / "build/release").mkdir()
        (self.tree / "build/release/CMakeCache.txt").touch()
        _, calls = self.script("scripts/build")
        self.assertNotIn("WERROR", calls[0])  # remains as it was configured
        shutil.rmtree(self.tree / "build")
        _, calls = self.script("scripts/slow-checks", "headers")
        self.assertNotIn("WERROR", calls[0])
        self.assertEqual(calls[1], "cmake --build build/release -- all_verify_interface_header_sets")

    def test_the_container_is_made_from_any_folder(self):
        (self.tree / "bare/bookworm/system").mkdir(parents=True)
        for folder in ("etc", "opt", "usr/share/doc"):
            (self.tree / "bare/bookworm/system" / folder).mkdir(parents=True)
        (self.tree / "scripts/a.deb").touch()
        self.stand_in("scripts/bare-debian")
        self.stand_in("chroot", RECORD + '[ -e "$1$2" ] && [ -e "$1$4" ]\n')
        self.stand_in("unshare")
        out = self.tree / "out"
        _, calls = self.script("./container", "tree", "a.deb", out, folder=self.tree / "scripts", BARE_DEBIAN=str(self.tree / "bare"))
        self.assertEqual(calls[1], f"chroot {out} /opt/container install /opt/a.deb")
        text, _ = self.script("./container", folder=self.tree / "scripts", status=2)
        self.assertIn("scripts/container install DEB", text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
