"""Every command of README.md and docs/ runs as written, on scenarios cut to a fifth of a second.

usage: commands_test.py SOURCE BUILD PROGRAM
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE, BUILD, PROGRAM = (pathlib.Path(argument) for argument in sys.argv[1:4])
SHORT_S = 0.2
# A flight is cut short, so its checks may fail; anything worse means that the text is wrong.
ALLOWED = (0, 1)


def fenced_commands(text):
    """Lines of the fenced blocks of shell."""
    for block in re.findall(r"^```sh\n(.*?)^```", text, re.S | re.M):
        yield from (line for line in block.splitlines() if line.strip())


def indented_commands(text):
    """Lines that are indented and call the program, without what is said of them behind #."""
    for line in re.findall(r"^    (hedgehop .*)$", text, re.M):
        yield line


def shortened(text):
    text = re.sub(r"^(duration): .*$", rf"\1: {SHORT_S}", text, flags=re.M)
    text = re.sub(r"before: [0-9.]+", f"before: {SHORT_S}", text)
    text = re.sub(r"points: [0-9]+", "points: 2", text)
    return re.sub(r"(seeds|quick): [0-9]+(:[0-9]+)?(,[0-9:]+)*", r"\1: 1", text)


class Commands(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        folder = cls.folder = pathlib.Path(cls.scratch.name)
        shutil.copytree(SOURCE / "configs", folder / "configs")
        shutil.copytree(SOURCE / "docs" / "keep_left", folder / "docs" / "keep_left")
        for file in (folder / "configs").rglob("*.yaml"):
            file.write_text(shortened(file.read_text()))
        (folder / "build").mkdir()
        (folder / "build" / "release").symlink_to(BUILD)
        (folder / "out").mkdir()
        cls.environment = {**os.environ, "PATH": f"{PROGRAM.parent}:{os.environ['PATH']}"}

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def run_line(self, line):
        if "--on slurm" in line and "--dry-run" not in line:
            line = re.sub(r"--on slurm", "--on slurm --dry-run", line)
        if line.startswith("hedgehop render") and "--time" in line:
            line = re.sub(r"--time [0-9.]+", f"--time {SHORT_S / 2}", line)
        done = subprocess.run(["bash", "-c", line], cwd=self.folder, env=self.environment, capture_output=True,
                              text=True, timeout=600)
        self.assertIn(done.returncode, ALLOWED, f"{line}\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")

    def run_page(self, page, commands):
        lines = list(commands((SOURCE / page).read_text()))
        self.assertGreater(len(lines), 0, page)
        for line in lines:
            with self.subTest(page=page, line=line):
                self.run_line(line)

    def test_pages_keep_their_commands_where_this_looks(self):
        pages = [path for path in (SOURCE / "docs").glob("*.md") if path.name != "results.md"]
        self.assertGreater(len(pages), 5)
        for page in pages:
            self.assertEqual(list(indented_commands(page.read_text())), [], page)

    def test_readme(self):
        # What README's commands look at lies in out/ once its quickstart and its batch have been run.
        self.run_line("hedgehop run configs/garratt2009_city_0.yaml --out out/quickstart")
        self.run_line("hedgehop batch configs/garratt2009_room_0_light.yaml --out out/before")
        self.run_page("README.md", indented_commands)


def page_test(page):
    return lambda self: self.run_page(page, fenced_commands)


# results.md tells commands of hours, and of programs that only developers build.
for _path in sorted((SOURCE / "docs").glob("*.md")):
    if _path.name != "results.md" and "```sh" in _path.read_text():
        setattr(Commands, "test_" + _path.stem.replace("-", "_"), page_test(f"docs/{_path.name}"))

if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
