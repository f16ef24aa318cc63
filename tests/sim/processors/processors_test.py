"""A short flight of each module has the bits of flights.csv on every processor. Other processors are simulated by the
instruction sets that the C library, OpenCV and Mesa select.

With the tiles renderer, they are equal on Debian 12 and 13, although the compiler and all libraries have other versions.

    processors_test.py PROGRAM tiles|osmesa|symbols    the test; exit status 77: skipped, because OSMesa is not installed
    processors_test.py PROGRAM --renew                 flies and rewrites flights.csv

With osmesa, flights depend on Mesa. With other versions than in flights.csv, they are compared only with each other.
"""

import csv
import ctypes
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[3]
TABLE = pathlib.Path(__file__).with_name("flights.csv")
PROGRAM = pathlib.Path(sys.argv[1])

NO_AVX2 = "glibc.cpu.hwcaps=-AVX2,-AVX,-FMA,-FMA4,-AVX512F"
PROCESSORS = {
    "tiles": {
        "this": {},
        "no FMA": {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA4"},
        "no AVX-512": {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX512F", "OPENCV_CPU_DISABLE": "AVX512-SKX", "HEDGEHOP_TILES": "avx2"},
        "no AVX2": {"GLIBC_TUNABLES": NO_AVX2, "OPENCV_CPU_DISABLE": "AVX512-SKX,AVX2", "HEDGEHOP_TILES": "plain"},
        "SSE3 only": {"GLIBC_TUNABLES": NO_AVX2 + ",-SSE4_1,-SSE4_2,-SSSE3", "HEDGEHOP_TILES": "plain",
                      "OPENCV_CPU_DISABLE": "AVX512-SKX,AVX2,AVX,FP16,SSE4.2,SSE4.1"},
    },
    "osmesa": {
        "this": {},
        "vectors of 256 bits": {"LP_NATIVE_VECTOR_WIDTH": "256"},
        "vectors of 128 bits, no AVX2": {"LP_NATIVE_VECTOR_WIDTH": "128", "GLIBC_TUNABLES": NO_AVX2,
                                         "OPENCV_CPU_DISABLE": "AVX512-SKX,AVX2"},
    },
}

# Functions of libm whose results are exact or rounded once in every implementation ...
EXACT = {"ceil", "copysign", "fabs", "floor", "fma", "fmax", "fmin", "fmod", "frexp", "ldexp", "llround", "lrint", "lround", "modf", "nearbyint",
         "remainder", "rint", "round", "scalbn", "sqrt", "trunc"}
# ... and those that flights do not call: statistics of campaigns.
STATISTICS = {"erfc", "lgamma"}
if "avx512f" not in pathlib.Path("/proc/cpuinfo").read_text():
    del PROCESSORS["tiles"]["no AVX-512"]  # this processor has none


def has_osmesa():
    try:
        ctypes.CDLL("libOSMesa.so.8")
        return True
    except OSError:
        return False


def versions(libraries):
    """Versions of the libraries that determine a flight; empty for tiles, whose flights are equal with those of every release."""
    mesa = re.findall(r"LLVM [\d.]+|Mesa [\d.]+$", libraries["renderer"])
    return ", ".join([libraries["images"], libraries["functions"], *mesa]) if mesa else ""


def fly(row, processor):
    """(trajectory hash, versions) of a row's flight."""
    environment = {name: value for name, value in os.environ.items() if name not in ("GLIBC_TUNABLES", "OPENCV_CPU_DISABLE")}
    with tempfile.TemporaryDirectory() as out:
        settings = [word for value in row["set"].split() for word in ("--set", value)]
        done = subprocess.run([PROGRAM, "run", SOURCE / row["scenario"], "--renderer", row["renderer"], "--seed", "1101", *settings,
                               "--no-video", "--no-report", "--json", "--out", out],
                              capture_output=True, text=True, env={**environment, **processor})
        if done.returncode not in (0, 1):
            raise AssertionError(f"{row['scenario']}: exit status {done.returncode}\n{done.stderr}")
        result = json.loads(done.stdout)
    return result["trajectory_hash"], versions(result["libraries"])


def rows():
    with TABLE.open(newline="") as file:
        return list(csv.DictReader(file))


class Flights(unittest.TestCase):
    def test_every_processor_gives_the_recorded_flights(self):
        for row in rows():
            if row["renderer"] != sys.argv[2]:
                continue
            flown = {}
            for name, processor in PROCESSORS[row["renderer"]].items():
                flown[name], libraries = fly(row, processor)
            with self.subTest(row["scenario"]):
                self.assertEqual(flown, dict.fromkeys(flown, flown["this"]))
                if libraries == row["libraries"]:
                    self.assertEqual(flown["this"], row["trajectory_hash"])


class Symbols(unittest.TestCase):
    def test_the_program_calls_no_function_of_libm_that_may_round_by_processor(self):
        linked = subprocess.run(["ldd", PROGRAM], capture_output=True, text=True, check=True).stdout
        libm = re.search(r"libm\.so\.6 => (\S+)", linked).group(1)
        names = [set(re.findall(rf" {kind} (\w+)@", subprocess.run(["nm", "-D", file], capture_output=True, text=True, check=True).stdout))
                 for file, kind in ((libm, "[TWi]"), (PROGRAM, "U"))]
        called = {name for name in names[0] & names[1] if name.rstrip("fl") not in EXACT and name not in EXACT | STATISTICS}
        self.assertEqual(called, set())
        self.assertIn("remainder", names[0] & names[1])  # the list of names is valid


def renew():
    table = rows()
    for row in table:
        row["trajectory_hash"], row["libraries"] = fly(row, {})
    with TABLE.open("w", newline="") as file:
        writer = csv.DictWriter(file, table[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(table)


if __name__ == "__main__":
    if sys.argv[2:] == ["--renew"]:
        renew()
    elif sys.argv[2] == "osmesa" and not has_osmesa():
        print("skipped: OSMesa is not installed (Debian: apt install libosmesa6)")
        sys.exit(77)
    else:
        unittest.main(argv=sys.argv[:1], defaultTest="Symbols" if sys.argv[2] == "symbols" else "Flights")
