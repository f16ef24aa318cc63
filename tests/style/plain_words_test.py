"""Feeds the rule `plain` one sentence per pattern that it must refuse, and sentences that it must accept."""

import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "style.d"))
import plain_rules  # noqa: E402

REFUSED = {
    "what": ["It returns what the camera saw.", "What moves is avoided first."],
    "where": ["It is NaN where there is no match.", "Where it fails, the flight ends."],
    "nothing": ["Nothing is drawn.", "It reads none of the files."],
    "stands": ["The wall stands 3 m ahead."],
    "beside": ["The table is beside the plot."],
    "superlative": ["The least clearance is 3 m.", "The greatest speed counts.", "The most that it can climb."],
    "per": ["It flies 14 decisions a second.", "It draws 4 samples a pixel."],
    "asked": ["The rate that was asked is 0.9."],
    "late": ["The flight is late in the city."],
    "who": ["Who draws is chosen by name.", "The program who flies it ends."],
    "by renderer": ["The flight was drawn by tiles."],
    "British": ["The colour of the wall is red."],
}
ACCEPTED = [
    "What does exit status 4 mean?",
    "The pixel where the ray ends is returned.",
    "Thrust is k w^2, where k is the thrust coefficient.",
    "At least 3 m remain, and at most 5 m.",
    "The fit minimizes least squares.",
    "The most recent frame is used, and most users need no other.",
    "A second run gives equal bits.",
    "It rotates by 90 degrees per second.",
    "Users who sweep gains read this page.",
    "Take off from a stand.",
]


def faults(files):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in files.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        return [(name, str(fault)) for name, fault in plain_rules.pattern_faults(root)] + [
            ("length", str(fault)) for fault in plain_rules.length_faults(root)]


class Patterns(unittest.TestCase):
    def test_every_pattern_has_an_example(self):
        self.assertEqual(set(REFUSED), set(plain_rules.PATTERNS))

    def test_each_example_is_refused_in_a_page_a_comment_and_a_string(self):
        for pattern, sentences in REFUSED.items():
            for sentence in sentences:
                for name, text in {"docs/page.md": sentence, "sim/a.h": f"// {sentence}\n", "sim/b.cpp": f'f("{sentence}");\n',
                                   "c.py": f"# {sentence}\n", "d.js": f"f('x'); // {sentence}\n", "e.yaml": f"a: 1  # {sentence}\n"}.items():
                    with self.subTest(sentence=sentence, file=name):
                        self.assertEqual([found for found, _ in faults({name: text})], [pattern])

    def test_correct_uses_are_accepted(self):
        for sentence in ACCEPTED:
            with self.subTest(sentence=sentence):
                self.assertEqual(faults({"docs/page.md": sentence, "sim/a.h": f"// {sentence}\n"}), [])

    def test_code_is_not_prose(self):
        self.assertEqual(faults({"docs/page.md": "```\nwhat stands beside\n```\nRun `what --where`.\n",
                                 "sim/a.cpp": "int what = error.what();\n"}), [])

    def test_a_comment_over_two_lines_is_one_passage_and_the_line_is_that_of_the_word(self):
        found = faults({"sim/a.h": "int x;\n// Takes the color of the pixel\n// where the ray ends, or\n// nothing.\n"})
        self.assertEqual([name for name, _ in found], ["nothing"])
        self.assertTrue(found[0][1].startswith("sim/a.h:4:"), found)

    def test_the_name_of_a_test_is_prose(self):
        self.assertEqual([name for name, _ in faults({"a.cpp": "TEST(Map, NothingStands) {}\n"})], ["nothing", "stands"])

    def test_an_exception_needs_a_reason_and_covers_its_phrase_alone(self):
        page = {"docs/page.md": "He is the least of them.\n\nNothing else.\n"}
        self.assertEqual([n for n, _ in faults({**page, plain_rules.EXCEPTIONS: "docs/*.md | the least of them | a quotation\n"})], ["nothing"])
        with self.assertRaises(SystemExit):
            faults({**page, plain_rules.EXCEPTIONS: "docs/*.md | the least of them |\n"})


class Lengths(unittest.TestCase):
    def test_a_sentence_of_41_words_is_refused_and_one_of_40_is_not(self):
        short = " ".join(["A short sentence of six words."] * 20)
        self.assertEqual(faults({"docs/page.md": short + " " + " ".join(["word"] * 40) + "."}), [])
        self.assertEqual([n for n, _ in faults({"docs/page.md": short + " " + " ".join(["word"] * 41) + "."})], ["length"])

    def test_a_mean_over_20_words_is_refused(self):
        self.assertEqual(faults({"docs/page.md": " ".join(["word"] * 20) + "."}), [])
        self.assertEqual([n for n, _ in faults({"docs/page.md": " ".join(["word"] * 21) + "."})], ["length"])


if __name__ == "__main__":
    unittest.main()
