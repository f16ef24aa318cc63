"""Every command of one page (README.md, CONTRIBUTING.md or one of docs/) is right, or, for `tables`, every table has commands.

Commands of `hedgehop` and of the shell run as written, on scenarios cut to a fifth of a second. Commands that build or
measure are only looked up: the script, the test program and its tests, the preset must exist. A flight that several
pages have is flown by the first of them only.

usage: commands_test.py SOURCE BUILD PROGRAM PAGE|tables [NAME=VALUE, of the environment of Python ...]
"""

import json
import os
import pathlib
import random
import re
import shlex
import shutil
import socket
import subprocess
import sys
import tempfile
import unittest

SOURCE, BUILD, PROGRAM = (pathlib.Path(argument) for argument in sys.argv[1:4])
SHARE = sys.argv[4]
FOR_PYTHON = dict(argument.split("=", 1) for argument in sys.argv[5:])
SHORT_S = 0.2
# A flight is cut short, so its checks may fail, and one seed leaves a claim undecided; anything worse means that the text
# is wrong.
ALLOWED = (0, 1, 4)
LOOKED_UP = re.compile(r"(scripts/|\./scripts/|build/\w+/tests/|ctest |gdb |cmake --preset|bash \.ci/|[A-Z]+=\S+ scripts/)")
START = r"(?:hedgehop |build/|ctest |gdb |cmake |bash \.ci/|(?:[A-Z]+=\S+ )?(?:\./)?scripts/\w)"

# Commands that leave the folders that a page reads.
PREPARATION = {"docs/commands.md": ["hedgehop batch configs/garratt2009_room_0_light.yaml --out out/before"]}


def commands(text):
    """Commands in fenced blocks of shell, in indented lines, and whole commands in table cells; comments cut off."""
    for block in re.findall(r"^```sh\n(.*?)^```", text, re.S | re.M):
        yield from (line for line in block.splitlines() if line.strip())
    for line in re.findall(rf"^    ({START}.*)$", text, re.M):
        yield re.split(r"\s{2,}", line)[0]
    for row in re.findall(r"^\|.*\|$", text, re.M):
        yield from re.findall(r"\| `(hedgehop (?!list scenes`)[^`]*|(?:build|scripts)/[^`]* [^`]*|scripts/[^`]+)`(?= \|)", row)


# Per type of link, the ports of the autopilots N: kind, port of 0, step from one to the next.
PORTS = {"ardupilot_json": [(socket.SOCK_DGRAM, 9002, 10), (socket.SOCK_STREAM, 5760, 10)],
         "px4": [(socket.SOCK_STREAM, 4560, 1), (socket.SOCK_DGRAM, 14540, 1), (socket.SOCK_DGRAM, 14580, 1)]}


def free_instance(link):
    """The number of an autopilot whose ports, and those of the next three, no other process uses: pages are tested in parallel."""
    numbers = range(0, 40, 4) if link == "px4" else range(0, 92, 4)  # PX4's UDP ports are only 40 apart
    for instance in random.Random(os.getpid()).sample(numbers, len(numbers)):
        try:
            for number in range(instance, instance + 4):
                for kind, first, step in PORTS[link]:
                    with socket.socket(socket.AF_INET, kind) as probe:
                        probe.bind(("127.0.0.1", first + step * number))
            return instance
        except OSError:
            continue
    raise RuntimeError(f"no free ports for an autopilot of type {link}")


def shortened_file(text):
    text = re.sub(rf"^  type: ({'|'.join(PORTS)})$", lambda link: f"{link[0]}\n  instance: {free_instance(link[1])}", text, flags=re.M)
    text = re.sub(r"^(duration): .*$", rf"\1: {SHORT_S}", text, flags=re.M)
    text = re.sub(r"before: [0-9.]+", f"before: {SHORT_S}", text)
    text = re.sub(r"\bduration=[0-9.]+", f"duration={SHORT_S}", text)
    text = re.sub(r"\bat: [0-9.]+, until: [0-9.]+", f"at: {SHORT_S / 4}, until: {SHORT_S / 2}", text)
    text = re.sub(r"points: [0-9]+", "points: 2", text)
    text = re.sub(r", shrinking: [0-9]+", "", text)
    text = re.sub(r"budget: [0-9]+", "budget: 2, shrinking: 2", text)
    if re.search(r"^duration:", text, re.M) and not re.search(r"^drawing:", text, re.M):
        text += "\ndrawing: {renderer: tiles}\n"  # the fastest renderer
    return re.sub(r"(seeds|quick): ([0-9]+)(:[0-9]+)?(,[0-9:]+)*", r"\1: \2", text)


def shortened_command(line):
    """The command with shorter flights and fewer seeds."""
    if line.startswith("hedgehop"):
        line = re.sub(r"duration=[0-9.]+", f"duration={SHORT_S}", line)
        line = re.sub(r"--seeds [0-9:,]+", "--seeds 1", line)
        line = re.sub(r"takeover\.at=[0-9.]+", f"takeover.at={SHORT_S / 2}", line)
        line = re.sub(r"--min-success [0-9.]+", "--min-success 0.1", line)  # one seed cannot show a higher rate
    if line.startswith("hedgehop bless") and "--force" not in line:
        line += " --force"  # a shortened flight does not reach its goal
    if line.startswith("hedgehop falsify"):
        line = re.sub(r"budget=[0-9]+", "budget=2", line)
    if line.startswith("hedgehop branch"):
        line = re.sub(r"--at [0-9.]+", f"--at {SHORT_S / 2}", line)
    if line.startswith("hedgehop reproduce") and "--quick" not in line:
        line = re.sub(r" --write \S+", "", line) + " --quick"  # reuses the flights of getting-started.md
    if line.startswith("hedgehop batch configs/campaigns/") and "--resume" not in line:
        line = re.sub(r"\s*(#.*)?$", " --resume", line, count=1)  # reuses the flights of other pages
    if line.startswith("hedgehop render"):
        line = re.sub(r"--time [0-9.]+", f"--time {SHORT_S / 2}", line)
    if "--on slurm" in line and "--dry-run" not in line:
        line = line.replace("--on slurm", "--on slurm --dry-run")
    return line


def pages():
    """The pages that have commands, in the order in which they are searched for equal flights."""
    names = ["CONTRIBUTING.md", "README.md", *(f"docs/{file.name}" for file in (SOURCE / "docs").glob("*.md"))]
    return sorted(names, key=lambda name: (name != "docs/getting-started.md", name))  # first the one that flies every paper


def single_commands(page):
    """The commands of a page, each once, in its order; `a; b` are two."""
    lines = (part for line in commands((SOURCE / page).read_text())
             for part in (re.split(r"; (?=hedgehop )", line) if line.startswith("hedgehop ") else [line]))
    return list(dict.fromkeys(lines))


def flights(line, text):
    """The flights of a command, as texts that are equal if they fly alike; none if the text of the page may read their results."""
    words = shortened_command(line).split("  ")[0].split(" ")
    if words[:1] != ["hedgehop"] or words[1] not in ("batch", "compare", "reproduce", "run", "sweep") or "--out" in words:
        return set()
    if any(f"out/{pathlib.Path(word).stem}" in text for word in words if word.endswith(".yaml")):
        return set()
    settings = re.sub(r" (-j [0-9]+|--resume|--seeds 1)(?= |$)", "", " " + " ".join(words[2:])).strip()
    if words[1] != "reproduce":
        return {f"{words[1]} {settings}"}
    papers = [word for word in settings.split() if word != "--quick"]
    return {f"reproduce {name}" for name in papers or [file.stem for file in (SOURCE / "configs/papers").glob("*.yaml")]}


class Commands(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        folder = cls.folder = pathlib.Path(cls.scratch.name)
        shutil.copytree(SOURCE / "configs", folder / "configs")
        for example in ("flights", "keep_left", "loops"):
            shutil.copytree(SOURCE / "docs" / example, folder / "docs" / example)
        for file in (folder / "configs").rglob("*.yaml"):
            file.write_text(shortened_file(file.read_text()))
        if SHARE != "tables":  # files that the page writes
            for name, text in re.findall(r"^```yaml\n# (configs/\S+)\n(.*?)^```", (SOURCE / SHARE).read_text(), re.S | re.M):
                (folder / name).write_text(shortened_file(text))
        (folder / "build").mkdir()
        (folder / "build" / "release").symlink_to(BUILD)
        (folder / "out").mkdir()
        # Scripted peers fly instead of ArduPilot and PX4.
        (folder / "bin").mkdir()
        for name, peer in (("arducopter", "scripted_peer.py"), ("arducopter-heli", "scripted_peer.py"), ("px4", "px4_peer.py")):
            autopilot = folder / "bin" / name
            autopilot.write_text(f'#!/bin/sh\nexec "{sys.executable}" "{SOURCE}/tests/sim/link/{peer}" "$@"\n')
            autopilot.chmod(0o755)
        cls.environment = {**os.environ, "PATH": f"{PROGRAM.parent}:{folder}/bin:{os.environ['PATH']}"}

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def setUp(self):
        self.lacks_osmesa = False

    def shell(self, line, allowed=ALLOWED, **more_environment):
        done = subprocess.run(["bash", "-c", line], cwd=self.folder, env={**self.environment, **more_environment},
                              capture_output=True, text=True, timeout=600)
        if done.returncode == 2 and "osmesa: not available: " in done.stderr:
            self.lacks_osmesa = True
            self.skipTest("the page's commands need OSMesa (Debian: apt install libosmesa6)")
        if done.returncode == 2 and "this build reads no maps" in done.stderr:  # an optional feature
            return ""
        self.assertIn(done.returncode, allowed, f"{line}\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
        return done.stdout

    def look_up(self, line):
        """Checks that the scripts, presets, test programs and test filters of a command exist."""
        words = [word for word in shlex.split(line) if not re.match(r"[A-Z]+=", word)]
        for script in (word for word in words if re.match(r"(\./)?(scripts|\.ci)/", word)):
            self.assertTrue(os.access(SOURCE / script, os.R_OK), script)
        presets = json.loads((SOURCE / "CMakePresets.json").read_text())["configurePresets"]
        for preset in re.findall(r"--preset (\w+)", line):
            self.assertIn(preset, [known["name"] for known in presets])
        for program in (word for word in words if re.match(r"build/\w+/tests/", word)):
            listed = BUILD / pathlib.Path(*pathlib.Path(program).parts[2:])
            self.assertTrue(listed.exists(), f"{listed} is not built")
            filters = [word for word in words if word.startswith("--gtest_filter")]
            self.assertIn("\n  ", self.shell(" ".join(shlex.quote(w) for w in [str(listed), "--gtest_list_tests", *filters])), line)
        if words[0] == "ctest":
            pattern = words[words.index("-R") + 1]
            self.assertNotIn("Total Tests: 0", self.shell(f"ctest --test-dir {BUILD} -N -R {shlex.quote(pattern)}"), line)

    def run_line(self, line, counts_sweeps=False):
        """@param counts_sweeps  whether a sweep only counts its missing flights."""
        if LOOKED_UP.match(line):
            self.look_up(line)
        elif counts_sweeps and line.startswith("hedgehop sweep"):
            self.shell(line + " --missing", (0,))
        else:
            self.shell(shortened_command(line), (0,) if line.startswith("cmake ") else ALLOWED)

    def blocks_of_python(self, page):
        """The Python blocks of a page: {file name: text} of blocks that begin with a file name, and one program of all others."""
        files, program = {}, []
        for block in re.findall(r"^```python\n(.*?)^```", (SOURCE / page).read_text(), re.S | re.M):
            named = re.match(r"# (\w+\.py)\n", block)
            if named:
                files[named[1]] = block
            else:
                program.append(block)
        return files, "".join(program)

    def test_every_command_runs_as_written(self):
        page = SHARE
        files, program = self.blocks_of_python(page)
        for name, text in files.items():
            (self.folder / name).write_text(text)
        for line in PREPARATION.get(page, []):
            self.run_line(line)
        flown = {flight for earlier in pages()[:pages().index(page)] for line in single_commands(earlier)
                 for flight in flights(line, (SOURCE / earlier).read_text())}
        for line in single_commands(page):
            here = flights(line, (SOURCE / page).read_text())
            if here and here <= flown:
                continue
            flown |= here
            with self.subTest(line=line):
                self.run_line(line, counts_sweeps=page == "docs/verification.md")
            if self.lacks_osmesa:  # later commands read its files
                return
        if program:  # may read the results of the commands
            (self.folder / "page.py").write_text(program)
            self.shell("/usr/bin/python3 page.py", (0,), PYTHONPATH=f"{BUILD}/python", **FOR_PYTHON)


class Tables(unittest.TestCase):
    def test_every_page_with_figures_has_commands(self):
        for page in ("README.md", "CONTRIBUTING.md", "docs/results.md", "docs/verification.md", "docs/performance.md",
                     "docs/known-failures.md"):
            self.assertGreater(len(list(commands((SOURCE / page).read_text()))), 0, page)

    def test_every_row_of_results_and_measurements_has_a_command(self):
        """A row has its own command, that of the row above (an empty cell or `the same`), or that of a block before the table."""
        text = "\n".join((SOURCE / "docs" / page).read_text() for page in ("results.md", "verification.md", "performance.md", "bring-your-own.md"))
        for heads, rows in re.findall(r"^\|(.*)\|\n\|[-|]+\|\n((?:\|.*\|\n?)+)", text, re.M):
            if heads.split("|")[-1].strip() != "command":
                continue
            last = ""
            for row in rows.splitlines():
                cell = row.rstrip("|").rsplit("|", 1)[-1].strip()
                last = last if cell in ("", "the same") else cell
                self.assertRegex(last, r"^`.*`$", row)

    def test_reference_of_commands_is_up_to_date(self):
        page = (SOURCE / "docs/commands.md").read_text()
        generated = subprocess.run([PROGRAM, "manual", "markdown"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(page, generated, "regenerate it: hedgehop manual markdown > docs/commands.md")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], defaultTest="Tables" if SHARE == "tables" else "Commands")
