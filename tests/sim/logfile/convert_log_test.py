"""`scripts/convert-log` on files that this test writes byte by byte.

usage: convert_log_test.py SOURCE
"""

import csv
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv[1])
DEBIAN_PYTHON = shutil.which("python3", path="/usr/bin") or sys.executable


def message(kind, body):
    return struct.pack("<HB", len(body), ord(kind)) + body


def ulog(flags=b"\0" * 16, offsets=(0, 0, 0)):
    """A file with a nested type, an array, padding at the end, and two instances of one topic."""
    data = b"ULog\x01\x12\x35\x01" + struct.pack("<Q", 0)
    data += message("B", flags + struct.pack("<3Q", *offsets))
    data += message("F", b"point:float x;int16_t y;uint8_t[2] _padding0;")
    data += message("F", b"attitude:uint64_t timestamp;float[4] q;")
    data += message("F", b"track:uint64_t timestamp;point place;bool valid;uint8_t[7] _padding0;")
    data += message("A", struct.pack("<BH", 0, 5) + b"attitude") + message("A", struct.pack("<BH", 0, 6) + b"track")
    data += message("A", struct.pack("<BH", 1, 7) + b"track")
    return data


def attitude(t_us, *q):
    return message("D", struct.pack("<HQ4f", 5, t_us, *q))


def track(number, t_us, x, y, valid=True):
    return message("D", struct.pack("<HQfhBB?", number, t_us, x, y, 0, 0, valid))


class ConvertLog(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def convert(self, name, data, *arguments, environment=None):
        file, out = self.folder / name, self.folder / "log.csv"
        if data is not None:
            file.write_bytes(data)
        done = subprocess.run([DEBIAN_PYTHON, SOURCE / "scripts/convert-log", file, "-o", out, *arguments],
                              capture_output=True, text=True, env={**os.environ, **(environment or {})})
        if done.returncode != 0 or not out.exists():
            return done, []
        with out.open(encoding="utf-8") as written:
            return done, list(csv.DictReader(written))

    def test_a_ulog_gives_one_row_per_sample_of_the_base_topic(self):
        data = ulog() + track(6, 900, 7.5, -3) + attitude(1000, 1, 0, 0, 0) + track(7, 1500, 2.5, 4, False)
        data += attitude(2000, 0, 1, 0, 0) + track(6, 2000, 8.5, -4) + b"\x20\x00D\x05"  # the last message is cut off
        done, rows = self.convert("flight.ulg", data, "--base", "attitude")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([float(row["t_s"]) for row in rows], [0.001, 0.002])
        self.assertEqual([float(row["attitude.q[1]"]) for row in rows], [0.0, 1.0])
        self.assertEqual([float(row["track.place.x"]) for row in rows], [7.5, 8.5])
        self.assertEqual([float(row["track.place.y"]) for row in rows], [-3.0, -4.0])
        self.assertEqual([row["track.1.place.x"] for row in rows], ["", "2.5"])
        self.assertEqual(rows[1]["track.1.valid"], "0.0")
        self.assertFalse([name for name in rows[0] if "padding" in name])

    def test_data_appended_after_a_crash_are_read(self):
        begin = ulog() + attitude(1000, 1, 0, 0, 0) + b"\x50"  # a message that the crash cut off
        flags = b"\0" * 8 + b"\1" + b"\0" * 7
        data = ulog(flags, (len(begin), 0, 0)) + begin[len(ulog()):] + attitude(3000, 0, 0, 1, 0)
        done, rows = self.convert("flight.ulg", data, "--base", "attitude")
        self.assertEqual([float(row["t_s"]) for row in rows], [0.001, 0.003], done.stderr)

    def test_the_time_is_scaled_and_a_column_integrated(self):
        data = ulog() + b"".join(attitude(10000 * i, 2.0, 0, 0, 0) for i in range(11))
        done, rows = self.convert("flight.ulg", data, "--base", "attitude", "--time-scale", "0.5", "--integral",
                                  "angle=attitude.q[0]", "--until", "0.04")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(float(rows[-1]["t_s"]), 0.04, 12)
        self.assertAlmostEqual(float(rows[-1]["angle"]), 0.08, 12)

    def test_a_filter_keeps_slow_motion_without_lag_and_removes_fast_motion(self):
        values = [0.1 * i + (1.0 if i % 2 else -1.0) for i in range(400)]
        data = ulog() + b"".join(attitude(10000 * i, v, 0, 0, 0) for i, v in enumerate(values))
        _, rows = self.convert("flight.ulg", data, "--base", "attitude", "--low-pass", "attitude.q[0]=2")
        self.assertTrue(all(abs(float(rows[i]["attitude.q[0]"]) - 0.1 * i) < 0.1 for i in range(100, 300)))

    def test_matrices_of_matlab_become_columns(self):
        made = subprocess.run([DEBIAN_PYTHON, "-c", "import sys, numpy, scipy.io\n"
                               "scipy.io.savemat(sys.argv[1], {'a': numpy.arange(6.0).reshape(3, 2), 'b': [[1.5], [2.5], [3.5]], "
                               "'text': 'x'})", self.folder / "flight.mat"], capture_output=True, text=True)
        if made.returncode != 0:
            self.skipTest("no SciPy (python3-scipy)")
        done, rows = self.convert("flight.mat", None, "--rate", "50", "--rename", "a=state")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([float(row["t_s"]) for row in rows], [0.0, 0.02, 0.04])
        self.assertEqual([float(row["state_1"]) for row in rows], [1.0, 3.0, 5.0])
        self.assertEqual([float(row["b_0"]) for row in rows], [1.5, 2.5, 3.5])

    def test_rows_of_a_csv_file_are_left_out_by_a_column(self):
        done, rows = self.convert("flight.csv", b"time,height\n5.0,0.1\n5.1,0.4\n5.2,0.5\n5.3,0.2\n", "--time", "time",
                                  "--within", "height=0.3:2")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([row["height"] for row in rows], ["0.4", "0.5"])
        self.assertAlmostEqual(float(rows[0]["t_s"]), 0.1, 9)

    def test_the_time_of_a_csv_file_starts_at_0(self):
        for name in ("t_s", "time"):
            done, rows = self.convert("flight.csv", f"{name},x\n5.0,1\n5.5,2\n".encode(), "--time", name)
            self.assertEqual([row["t_s"] for row in rows], ["0.0", "0.5"], done.stderr)
        done, rows = self.convert("flight.csv", b"t_s,time\n7,5.0\n8,5.5\n", "--time", "time")  # not the time of another column
        self.assertEqual([(row["t_s"], row["time"]) for row in rows], [("0.0", "5.0"), ("0.5", "5.5")], done.stderr)

    def test_a_csv_file_is_utf_8_with_or_without_a_byte_order_mark(self):
        for mark in (b"", b"\xef\xbb\xbf"):
            done, _ = self.convert("flight.csv", mark + "t_s,Höhe\n0,1\n".encode(), environment={"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"})
            self.assertEqual((self.folder / "log.csv").read_bytes(), "t_s,Höhe\r\n0.0,1.0\r\n".encode(), done.stderr)
        for data in (b"t_s,x\n0,\xff\n", "t_s,x\n0,1\n".encode("utf-16"), b"t_s,x\n0,\"" + 200000 * b"1" + b"\"\n"):
            self.refused("is no CSV in UTF-8", "flight.csv", data)

    def test_a_csv_is_written_into_a_pipe(self):
        (self.folder / "flight.csv").write_text("t_s,x\n0,1\n")
        done, _ = self.convert("flight.csv", None, "-o", "/dev/stdout")
        self.assertEqual(done.stdout, "t_s,x\n0.0,1.0\n")
        self.assertEqual((done.returncode, done.stderr), (0, "/dev/stdout: 1 rows, 2 columns\n"))

    def test_a_list_into_a_closed_pipe_ends_without_a_message(self):
        (self.folder / "flight.csv").write_text("t_s,x\n0,1\n")
        reader, writer = os.pipe()
        os.close(reader)
        done = subprocess.run([DEBIAN_PYTHON, SOURCE / "scripts/convert-log", self.folder / "flight.csv", "--list"],
                              stdout=writer, stderr=subprocess.PIPE, text=True)
        os.close(writer)
        self.assertEqual(done.stderr, "")

    def refused(self, words, name, data, *arguments):
        done, _ = self.convert(name, data, *arguments)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(words, done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)

    def test_a_row_of_another_length_is_refused_with_its_line(self):
        self.refused("has 1 fields in line 4; its first line has 2", "flight.csv", b"t_s,x\n0,1\n1,2\n2\n")
        self.refused("has 3 fields in line 2; its first line has 2", "flight.csv", b"t_s,x\n0,1,2\n1,2\n")
        done, rows = self.convert("flight.csv", b"t_s,x\n0,1\n1,2\n\n")  # an empty line at the end
        self.assertEqual([row["x"] for row in rows], ["1.0", "2.0"], done.stderr)

    def test_tables_without_rows_or_with_text_are_refused(self):
        self.refused("has no rows", "flight.csv", b"t_s,x\n")
        self.refused("has text that is no number in line 2: could not convert string to float: 'abc'", "flight.csv", b"t_s,x\n0,abc\n")
        self.refused("has text that is no number in line 3", "flight.csv", b"t_s,x\n0,1\n1,abc\n")

    def test_formats_that_contain_themselves_or_are_too_large_are_refused(self):
        for words, *formats in (("contains itself", b"a:a inner;"), ("contains itself", b"a:b x;", b"b:a[2] y;"),
                                ("nested more than", *(f"{'a' * k}:{'a' * (k + 1)} x;".encode() for k in range(1, 2000))),
                                ("more than 65535 fields", b"a:b[999] x;", b"b:float[999] y;"),
                                ("unknown type 'float[x]'", b"a:float[x] y;"), ("unknown type 'b'", b"a:b y;")):
            data = ulog()[:16] + message("B", b"\0" * 40) + b"".join(message("F", text) for text in formats)
            with self.subTest(words):
                self.refused(words, "flight.ulg", data + message("A", b"\0\1\0a"))

    def test_options_with_bad_numbers_are_refused(self):
        for arguments, words in ((["--low-pass", "x=abc"], "'abc' is no number"), (["--low-pass", "x=0"], "HZ must be above 0"), (["--rate", "0"], "--rate must be above 0"),
                                 (["--within", "x=1"], "expected COLUMN=LOW:HIGH"), (["--integral", "x"], "expected NAME=COLUMN")):
            with self.subTest(arguments):
                self.refused(words, "flight.csv", b"t_s,x\n0,1\n1,2\n", *arguments)
        self.refused("has falling times", "flight.csv", b"t_s,x\n0,1\n-1,2\n", "--low-pass", "x=1")

    def test_a_log_is_replaced_as_a_whole_or_not_at_all(self):
        (self.folder / "log.csv").mkdir()
        self.refused("log.csv cannot be written", "flight.csv", b"t_s,x\n0,1\n", "-o", self.folder / "absent/log.csv")
        self.assertEqual(sorted(os.listdir(self.folder)), ["flight.csv", "log.csv"])
        (self.folder / "log.csv").rmdir()
        before = self.folder / "before.csv"
        before.write_text("whole")
        os.link(before, self.folder / "log.csv")
        done, _ = self.convert("flight.csv", b"t_s,x\n0,1\n")
        self.assertEqual(before.read_text(), "whole", done.stderr)  # the earlier file was not written into
        self.assertEqual(sorted(os.listdir(self.folder)), ["before.csv", "flight.csv", "log.csv"])

    def test_files_that_cannot_be_read_are_one_line(self):
        for name, data, words in (("flight.ulg", b"PK\3\4", "is no ULog file"), ("flight.bin", b"", "another ending"),
                                  ("flight.ulg", ulog(), "has no data"), ("absent.ulg", None, "is not a file"),
                                  ("flight.ulg", ulog() + attitude(0, 1, 0, 0, 0), "--base takes one of attitude")):
            done, _ = self.convert(name, data)
            self.assertEqual(done.returncode, 2, name)
            self.assertIn(words, done.stderr)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
