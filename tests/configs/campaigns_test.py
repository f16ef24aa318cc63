"""Campaign files and paper files name their renderer, because renderers give different images: campaigns_test.py SOURCE."""

import pathlib
import re
import sys
import unittest

import yaml

CONFIGS = pathlib.Path(sys.argv[1]) / "configs"


class Campaigns(unittest.TestCase):
    def test_every_entry_names_its_renderer(self):
        checked = 0
        for file in sorted([*CONFIGS.glob("campaigns/*.yaml"), *CONFIGS.glob("papers/*.yaml")]):
            text = yaml.safe_load(file.read_text())
            board = text.get("leaderboard", {"modules": [], "worlds": []})
            grounded = {gap["module"] for gap in board.get("not_flown", []) if len(gap["worlds"]) == len(board["worlds"])}
            entries = text.get("flights", []) + [module for module in board["modules"] if module["name"] not in grounded]
            self.assertTrue(entries, file)
            for entry in entries:
                self.assertTrue([item for item in entry.get("set", []) if item.startswith("drawing.renderer=")], f"{file}: {entry}")
                checked += 1
        self.assertGreater(checked, 100)

    def test_the_number_of_seeds_in_a_heading_is_flown(self):
        for file in CONFIGS.glob("campaigns/*.yaml"):
            text = file.read_text()
            flown = {int(last) - int(first) + 1 for first, last in re.findall(r"seeds: (\d+):(\d+)[,}]", text)}
            heading = "".join(re.findall(r"^# .*\n", text, re.M)).replace(" or ", " seeds ")
            stated = {int(count) for count in re.findall(r"\b(\d+) seeds", heading)}
            self.assertLessEqual(stated, flown, file)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
