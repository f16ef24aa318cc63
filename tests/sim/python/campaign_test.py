"""Batches and sweeps from Python have the contents of the files of the program."""

import contextlib
import csv
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import warnings

import numpy as np

import hedgehop
from flights import CITY, SHORT
from hedgehop.results import read_table


class Campaigns(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.out = pathlib.Path(self.scratch.name) / "out"

    def test_a_batch_is_a_record_array_of_its_table(self):
        table = hedgehop.batch(CITY, self.out, seeds="1:3", set={**SHORT, "duration": 0.4}, jobs=2)
        rows = list(csv.DictReader((self.out / "batch.csv").read_text().splitlines()))
        self.assertEqual(len(table), 3)
        self.assertEqual(list(table.seed), [1, 2, 3])
        np.testing.assert_array_equal(table.flight_time_s, [float(row["flight_time_s"]) for row in rows])
        self.assertEqual(list(hedgehop.load(self.out).trajectory_hash), list(table.trajectory_hash))

    def test_a_batch_shows_its_progress_on_standard_error(self):
        for progress, expected in ((True, 3), (False, 0)):  # two flights and their sum
            shown = io.StringIO()
            with contextlib.redirect_stderr(shown), warnings.catch_warnings():
                warnings.simplefilter("ignore")  # a build without npm writes no page and warns
                hedgehop.batch(CITY, self.out, seeds="1:2", set={**SHORT, "duration": 0.2}, jobs=1, progress=progress)
            self.assertEqual(len(shown.getvalue().splitlines()), expected, shown.getvalue())

    def test_a_warning_of_the_program_is_a_warning_of_python(self):
        unchecked = {**SHORT, "duration": 0.2, "checks": []}
        with self.assertWarnsRegex(UserWarning, "1 of 1 flights timed out before the goal"):
            hedgehop.batch(CITY, self.out, set=unchecked, jobs=1, progress=False)

    def test_each_notice_of_the_program_is_a_warning_of_python(self):
        folder = pathlib.Path(self.scratch.name) / "scenarios"
        folder.mkdir()
        (folder / "notes.txt").write_text("no scenario\n")
        (folder / "city.yaml").write_text(f"name: city\nuse: {CITY}\n")
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            hedgehop.batch(folder, self.out, set={**SHORT, "duration": 0.2}, jobs=1, progress=False)
        texts = [str(warning.message) for warning in caught]
        self.assertIn(f"{folder}: left out: notes.txt (not .yaml or .yml)", texts)
        self.assertFalse([text for text in texts if not text or text.startswith("1/1")], texts)

    def test_tables_are_read_as_utf_8_in_any_locale(self):
        scenario = pathlib.Path(self.scratch.name) / "café.yaml"
        scenario.write_text(f"name: cafe\nuse: {CITY}\nduration: 0.2\nfilm: {{enabled: false}}\ndrawing: {{renderer: tiles}}\n", encoding="utf-8")
        hedgehop.batch(scenario, self.out, jobs=1, progress=False)
        read = subprocess.run([sys.executable, "-c", "import hedgehop, sys; print(ascii(hedgehop.load(sys.argv[1]).scenario[0][-9:]))", self.out],
                              env={**os.environ, "LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"}, capture_output=True, text=True)
        self.assertEqual(read.stdout, "'caf\\xe9.yaml'\n", read.stderr)

    def test_seeds_keep_their_64_bits_and_hashes_their_letters(self):
        table = read_table("seed,trajectory_hash,build\n18446744073709551615,1234567890123456,12345678901234e5\n")
        self.assertEqual(int(table.seed[0]), 2**64 - 1)
        self.assertEqual((table.trajectory_hash[0], table.build[0]), ("1234567890123456", "12345678901234e5"))
        self.assertEqual(hedgehop.Simulation(CITY, seed=table.seed[0], set=SHORT).seed, 2**64 - 1)

    def test_a_sweep_is_a_record_array_of_its_table(self):
        sweep = pathlib.Path(self.scratch.name) / "sweep.yaml"
        sweep.write_text(f"description: short\nscenario: {CITY}\nset: [duration=0.4, drawing.renderer=tiles]\nseeds: 1:2\ntuned_on: 1:2000\n"
                         "design: {type: grid}\nparameters: [{path: avoidance.speed, values: [1.0, 2.0]}]\n")
        table = hedgehop.sweep(sweep, self.out, jobs=2)
        self.assertEqual(len(table), 4)
        self.assertEqual(sorted(table["avoidance.speed"]), [1, 1, 2, 2])

    def test_bad_input_has_the_message_of_the_program(self):
        with self.assertRaisesRegex(hedgehop.InputError, "duraton"):
            hedgehop.batch(CITY, self.out, set={"duraton": 1})
        with self.assertRaisesRegex(FileNotFoundError, "no result.json, batch.csv or sweep.csv"):
            hedgehop.load(self.scratch.name)
        cut = pathlib.Path(self.scratch.name) / "cut"
        cut.mkdir()
        (cut / "result.json").write_text("{\n")
        with self.assertRaisesRegex(ValueError, r"cut/result.json:\d:\d: is not complete JSON$"):
            hedgehop.load(cut)

    def test_a_table_keeps_texts_numbers_and_gaps(self):
        table = read_table('a,b,c\n1,"x, y",\n2,z,3e-1\n')
        self.assertEqual(table.a.tolist(), [1, 2])
        self.assertEqual(table.b.tolist(), ["x, y", "z"])
        self.assertTrue(np.isnan(table.c[0]) and table.c[1] == 0.3)
        self.assertEqual(len(read_table("a,b\n")), 0)

    def test_a_frame_of_pandas_has_the_records_columns(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("needs python3-pandas")
        table = read_table('seed,outcome,min_m\n1,reached,0.5\n2,collided,\n')
        frame = hedgehop.to_frame(table)
        expected = pandas.read_csv(io.StringIO('seed,outcome,min_m\n1,reached,0.5\n2,collided,\n'))
        pandas.testing.assert_frame_equal(frame, expected, check_dtype=False)


if __name__ == "__main__":
    unittest.main()
