"""Obstacle fields of other programs, as Hedgehop flies them: import_test.py HEDGEHOP SCENARIO.

The test writes small fields in the formats and reads them again with PyYAML, csv and xml.etree. Counts, poses and sizes of
the obstacles of `hedgehop import --solids` must be equal.
"""

import csv
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import yaml

HEDGEHOP, SCENARIO = sys.argv[1:3]
SAME = 1e-9
TURN = math.radians(30.0)

AERIALIST = """
drone: {mission_file: case_studies/mission1.plan, params: {MIS_TAKEOFF_ALT: 1.0}}
simulation:
  headless: true
  obstacles:
  - {position: {r: 0, x: -13.75, y: 11.36, z: 0}, size: {h: 10, l: 19.67, w: 2.29}}
  - position: {r: 35.5, x: 0.476, y: 17.38, z: 0}
    size: {h: 25, l: 13.36, w: 4.86}
test: {commands: []}
"""
STATIC = """rpg_box01, 2.5, 8.75, 1.5, 0.5, 0.5, -0.5, 0.5, 2.8, 2.8, 2.8
rpg_box01, 20.25, -0.5, 9.75, 0.8, 0.0, 0.0, 0.6, 1.25, 1.25, 1.25"""
DYNAMIC = """N: 2
Object1: {csvtraj: straight, loop: false, position: [3, 1, 2], prefab: rpg_box01, rotation: [1, 0, 0, 0], scale: [1.5, 1.5, 1.5]}
Object2: {csvtraj: turning, loop: true, position: [0, 0, 0], prefab: rpg_box01, rotation: [1, 0, 0, 0], scale: [2, 3, 4]}
"""
WORLD = """<sdf version='1.6'><world name='default'>
<model name='ground_plane'><static>1</static><link name='link'><collision name='c'><geometry><plane><normal>0 0 1</normal>
<size>9 9</size></plane></geometry></collision></link></model>
{}</world></sdf>"""
CYLINDER = """<model name='cylinder_{0}'><pose>{1} {2} 0.5 0 0 0</pose><static>1</static><link name='link'>
<collision name='c'><geometry><cylinder><radius>0.075</radius><length>1</length></cylinder></geometry></collision>
<visual name='v'><geometry><cylinder><radius>0.075</radius><length>1</length></cylinder></geometry></visual></link></model>
"""


def turning_row(t_s):
    """A row of a box that rises at 1 m/s and turns about the vertical, counter-clockwise seen from above."""
    half = 0.5 * TURN * t_s
    return [t_s, 4.0, -2.0, 1.0 + t_s, math.cos(half), 0.0, 0.0, math.sin(half)]


def matrix(w, x, y, z):
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def corners(rotation, center, size):
    """The eight corners of a box, sorted."""
    points = []
    for signs in range(8):
        corner = [(0.5 if signs >> axis & 1 else -0.5) * size[axis] for axis in range(3)]
        points.append(tuple(center[row] + sum(rotation[row][axis] * corner[axis] for axis in range(3)) for row in range(3)))
    return sorted(tuple(round(value, 6) for value in point) for point in points)


def ned(point):
    """From axes north, west, up."""
    return (point[0], -point[1], -point[2])


class Fields(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        file = self.folder / name
        file.parent.mkdir(exist_ok=True)
        file.write_text(text)
        return file

    def write_rows(self, name, rows):
        self.write(name, "# header\n" + "".join(",".join(f"{value:.18e}" for value in row) + "\n" for row in rows))

    def run_import(self, *arguments):
        return subprocess.run([HEDGEHOP, "import", *map(str, arguments)], capture_output=True, text=True, cwd=self.folder, check=False)

    def solids(self, *arguments):
        table = self.folder / "solids.csv"
        done = self.run_import(*arguments, "-o", self.folder / "scene.yaml", "--solids", table)
        self.assertEqual(done.returncode, 0, done.stderr)
        with table.open() as rows:
            return list(csv.DictReader(rows))

    def assert_box(self, row, expected):
        numbers = {key: float(value) for key, value in row.items() if key not in ("name", "shape")}
        found = corners(matrix(*(numbers[key] for key in ("qw", "qx", "qy", "qz"))),
                        [numbers[key] for key in ("north_m", "east_m", "down_m")], [numbers[f"size_{axis}_m"] for axis in "xyz"])
        self.assertEqual(row["shape"], "box")
        for one, other in zip(found, sorted(expected)):
            for a, b in zip(one, other):
                self.assertAlmostEqual(a, b, delta=2e-6)

    def test_aerialist_boxes_have_their_corners(self):
        file = self.write("test.yaml", AERIALIST)
        rows = self.solids("aerialist", file)
        obstacles = yaml.safe_load(AERIALIST)["simulation"]["obstacles"]
        self.assertEqual(len(rows), len(obstacles))
        for row, obstacle in zip(rows, obstacles):
            place, size, turn = obstacle["position"], obstacle["size"], math.radians(obstacle["position"]["r"])
            points = []
            for along, across, high in [(a, b, c) for a in (-0.5, 0.5) for b in (-0.5, 0.5) for c in (0, 1)]:
                x, y = along * size["l"], across * size["w"]
                points.append((place["x"] + x * math.cos(turn) - y * math.sin(turn), place["y"] + x * math.sin(turn) + y * math.cos(turn),
                               -place["z"] - high * size["h"]))
            self.assert_box(row, [tuple(round(value, 6) for value in point) for point in points])

    def test_flightmare_static_boxes_have_their_corners(self):
        rows = self.solids("flightmare", self.write("static_obstacles.csv", STATIC))
        expected = [[float(cell) for cell in row[1:]] for row in csv.reader(STATIC.splitlines())]
        self.assertEqual(len(rows), len(expected))
        for row, cells in zip(rows, expected):
            self.assert_box(row, sorted(tuple(round(v, 6) for v in ned(p)) for p in corners(matrix(*cells[3:7]), cells[:3], cells[7:])))

    def moving_rows(self, t_s):
        self.write_rows("csvtrajs/straight.csv", [[0.02 * i, 3.0 - 0.1 * i, 1.0, 2.0, 1.0, 0.0, 0.0, 0.0] for i in range(51)])
        self.write_rows("csvtrajs/turning.csv", [turning_row(0.02 * i) for i in range(101)])
        file = self.write("dynamic_obstacles.yaml", DYNAMIC)
        return self.solids("flightmare", file, "--time", t_s)

    def test_flightmare_movers_follow_their_tables(self):
        for t_s in (0.0, 0.3, 0.77, 1.0):
            straight, turning = self.moving_rows(t_s)
            self.assertAlmostEqual(float(straight["north_m"]), 3.0 - 5.0 * t_s, delta=SAME)
            cells = turning_row(t_s)
            expected = corners(matrix(*cells[4:]), cells[1:4], [2, 3, 4])
            self.assert_box(turning, sorted(tuple(round(v, 6) for v in ned(p)) for p in expected))

    def test_flightmare_movers_go_back_and_forth_or_restart(self):
        straight, turning = self.moving_rows(2.5)
        self.assertAlmostEqual(float(straight["north_m"]), 3.0 - 5.0 * 0.5, delta=SAME)  # 1 s there, 1 s back, 0.5 s there
        self.assertAlmostEqual(float(turning["down_m"]), -1.5, delta=SAME)  # 2 s, then again from the start
        capital = self.write("capital.yaml", DYNAMIC.replace("true", "True").replace("false", "False"))
        self.assertEqual(self.solids("flightmare", capital, "--time", 2.5), [straight, turning])

    def test_sdf_cylinders_are_scaled(self):
        places = [(-4.5, 3.25), (0.125, 7.5), (2.0, -1.0)]
        text = WORLD.format("".join(CYLINDER.format(i, *place) for i, place in enumerate(places)))
        rows = self.solids("sdf", self.write("world_0.world", text), "--scale", 8)
        models = [model for model in ElementTree.fromstring(text).iter("model") if model.find(".//cylinder") is not None]
        self.assertEqual(len(rows), len(models))
        for row, model in zip(rows, models):
            x, y, z = (8 * float(value) for value in model.find("pose").text.split()[:3])
            radius, length = (8 * float(model.find(f".//{key}").text) for key in ("radius", "length"))
            self.assertEqual((row["name"], row["shape"]), (model.get("name"), "cylinder"))
            found = [float(row[key]) for key in ("north_m", "east_m", "down_m", "size_x_m", "size_z_m")]
            for a, b in zip(found, [y, x, -z, 2 * radius, length]):
                self.assertAlmostEqual(a, b, delta=SAME)

    def test_faults_name_the_place_and_the_valid_values(self):
        self.write_rows("csvtrajs/straight.csv", [turning_row(0.02 * i) for i in range(3)])
        self.write("csvtrajs/turning.csv", "0,0,0,0,1,0,0\n")
        cases = [
            (("aerialist", self.write("a.yaml", "simulation: {obstacles: [{position: {x: 1, y: 2, z: 0, r: 0}}]}\n")), "a.yaml:1:26: missing key 'size'"),
            (("flightmare", self.write("b.csv", STATIC + "\nrpg_box01, 1, 2\n")), "b.csv:3: expected 11 values"),
            (("flightmare", self.write("c.csv", STATIC.replace("rpg_box01", "rpg_gate"))), "prefab 'rpg_gate' is unknown; valid: rpg_box01"),
            (("flightmare", self.write("d.yaml", DYNAMIC.replace("N: 2", "N: 3"))), "N is 3, but the file has 2 objects"),
            (("flightmare", self.write("f.yaml", DYNAMIC.replace("true", "yes"))), "f.yaml:3:35: expected true or false, got 'yes'"),
            (("sdf", self.write("s.yaml", STATIC)), "s.yaml: the suffix is unknown; valid: .sdf, .world\n"),
            (("sdf", self.folder / "none.world"), "none.world: there is no such file\n"),
            (("flightmare", self.write("e.yaml", DYNAMIC)), "turning.csv': line 1: expected 8 values"),
        ]
        for arguments, fault in cases:
            done = self.run_import(*arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(fault, done.stderr)

    def test_a_scenario_flies_the_written_scene(self):
        self.moving_rows(0.0)
        scene = f"scene.use={self.folder / 'scene.yaml'}"
        done = subprocess.run([HEDGEHOP, "run", SCENARIO, "--renderer", "tiles", "--set", scene, "--set", "duration=0.2", "--no-video",
                               "--no-report", "--out", self.folder / "out"], capture_output=True, text=True, check=False)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        flown = yaml.safe_load((self.folder / "out" / "scenario.yaml").read_text())["scene"]
        self.assertTrue(pathlib.Path(flown["movers"][1]["motion"]["file"]).samefile(self.folder / "csvtrajs/turning.csv"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
