"""Maps compared with GDAL's tools: footprints with ogr2ogr, heights with gdallocationinfo; and the errors of a build without them.

usage: map_test.py PROGRAM SOURCE
"""

import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = sys.argv[1:3]
LATITUDE, LONGITUDE = 47.0, 8.0
PLANE = f"+proj=tmerc +lat_0={LATITUDE} +lon_0={LONGITUDE} +k=1 +ellps=WGS84 +units=m"
FEATURES = subprocess.run([PROGRAM, "--version", "--features"], capture_output=True, text=True, check=True).stdout
HAS_MAPS = re.search(r"yes +maps from OpenStreetMap", FEATURES) is not None
HAS_TERRAIN = re.search(r"yes +terrain of maps", FEATURES) is not None
HAS_TOOLS = all(shutil.which(tool) for tool in ("ogr2ogr", "gdal_translate", "gdallocationinfo"))
NORTH_PER_DEG, EAST_PER_DEG = 111166.0, 76056.0  # near 47 N, for the layout only


class MapFile:
    """Writes a file of OpenStreetMap from positions in the plan."""

    def __init__(self):
        self.nodes, self.ways, self.relations = [], [], []

    @staticmethod
    def tags(tags):
        return "".join(f'<tag k="{key}" v="{value}"/>' for key, value in tags.items())

    def node(self, north, east, tags=()):
        self.nodes.append(f'<node id="{len(self.nodes) + 1}" version="1" lat="{LATITUDE + north / NORTH_PER_DEG:.7f}" '
                          f'lon="{LONGITUDE + east / EAST_PER_DEG:.7f}">{self.tags(dict(tags))}</node>')
        return len(self.nodes)

    def way(self, nodes, tags=()):
        refs = "".join(f'<nd ref="{node}"/>' for node in nodes)
        self.ways.append(f'<way id="{len(self.ways) + 101}" version="1">{refs}{self.tags(dict(tags))}</way>')
        return len(self.ways) + 100

    def outline(self, points, tags=()):
        nodes = [self.node(*point) for point in points]
        return self.way(nodes + nodes[:1], tags)

    def box(self, north, east, length, width, tags):
        corners = [(north, east), (north + length, east), (north + length, east + width), (north, east + width)]
        return self.outline(corners, {"building": "yes", **tags})

    def relation(self, members, tags):
        refs = "".join(f'<member type="way" ref="{way}" role="{role}"/>' for way, role in members)
        self.relations.append(f'<relation id="{len(self.relations) + 901}" version="1">{refs}'
                              f'{self.tags({"type": "multipolygon", **tags})}</relation>')

    def write(self, path):
        path.write_text('<?xml version="1.0"?>\n<osm version="0.6">\n' + "\n".join(self.nodes + self.ways + self.relations) + "\n</osm>\n")


def village():
    """Buildings of every shape, two streets and trees."""
    file = MapFile()
    file.box(40, -10, 20, 20, {"height": "9"})
    file.box(80, -10, 24, 20, {"building:levels": "4", "roof:shape": "gabled", "roof:height": "2"})
    file.outline([(40, 30), (60, 30), (60, 34), (46, 34), (46, 42), (40, 42)], {"building": "school"})
    yard = file.outline([(80, 30), (120, 32), (118, 70), (82, 66)])
    hole = file.outline([(92, 42), (106, 43), (104, 56), (93, 54)])
    file.relation([(yard, "outer"), (hole, "inner")], {"building": "yes", "height": "12.5 m"})
    file.way([file.node(-100, 3), file.node(0, 3), file.node(200, 5)], {"highway": "residential"})
    file.way([file.node(20, -50), file.node(20, 80)], {"highway": "footway"})
    file.node(10, 10, {"natural": "tree", "height": "7"})
    return file


def ring_area(ring):
    return 0.5 * sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:]))


class Maps(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = pathlib.Path(self.scratch.name)

    def hedgehop(self, scene, *, north=0.0, east=0.0, altitude=60.0, camera="down", what="depth_m", image="image.tiff"):
        """Renders a scene from a place. @return the process."""
        scenario = {"name": "map", "duration": 1, "scene": {"type": "map", "origin": {"latitude": LATITUDE, "longitude": LONGITUDE}, **scene},
                    "vehicle": {"use": f"{SOURCE}/configs/vehicles/s900.yaml"},
                    "rig": {"cameras": [{"role": "front", "width": 160, "height": 120, "fov": 75, "rate": 10},
                                        {"role": "down", "width": 33, "height": 33, "fov": 10, "rate": 50, "pitch": -90}]},
                    "start": {"north": north, "east": east, "altitude": altitude}, "goal": {"north": north + 5, "east": east, "altitude": altitude},
                    "avoidance": {"module": "go_to_goal"}, "drawing": {"renderer": "tiles"}}
        file = self.folder / "map.yaml"
        file.write_text(json.dumps(scenario))
        return subprocess.run([PROGRAM, "render", file, "--camera", camera, "--what", what, "-o", self.folder / image],
                              capture_output=True, text=True)

    def altitude_below(self, scene, north, east, altitude):
        """The altitude of the surface below a place, from the middle of a depth image."""
        done = self.hedgehop(scene, north=north, east=east, altitude=altitude)
        self.assertEqual(done.returncode, 0, done.stderr)
        values = subprocess.run(["gdallocationinfo", "-valonly", self.folder / "image.tiff", "16", "16"],
                                capture_output=True, text=True, check=True).stdout
        return altitude - float(values)

    def elevation(self, name, height_at, spacing_deg=2e-4, side=81, system="EPSG:4326"):
        """Writes heights over degrees as a GeoTIFF."""
        grid = self.folder / "grid.asc"
        low = (side - 1) / 2
        rows = [" ".join(f"{height_at((low - row) * spacing_deg, (column - low) * spacing_deg):.6f}" for column in range(side))
                for row in range(side)]
        grid.write_text(f"ncols {side}\nnrows {side}\nxllcenter {LONGITUDE - low * spacing_deg}\nyllcenter {LATITUDE - low * spacing_deg}\n"
                        f"cellsize {spacing_deg}\nNODATA_value -9999\n" + "\n".join(rows) + "\n")
        file = self.folder / name
        subprocess.run(["gdal_translate", "-q", "-ot", "Float64", "-a_srs", system, grid, file], check=True, stdout=subprocess.DEVNULL)
        return file

    @unittest.skipUnless(HAS_MAPS and HAS_TOOLS, "needs libosmium and gdal-bin (scripts/packages maps)")
    def test_counts_and_areas_equal_those_of_ogr2ogr(self):
        osm = self.folder / "village.osm"
        village().write(osm)
        done = self.hedgehop({"osm": str(osm)})
        self.assertEqual(done.returncode, 0, done.stderr)
        found = re.match(rf"'{re.escape(str(osm))}': (\d+) buildings on ([\d.]+) m2, (\d+) streets of ([\d.]+) m, (\d+) trees\n$", done.stderr)
        self.assertIsNotNone(found, done.stderr)

        def layer(name, where):
            file = self.folder / f"{name}.json"
            subprocess.run(["ogr2ogr", "-f", "GeoJSON", "-t_srs", PLANE, "-lco", "RFC7946=NO", "-lco", "COORDINATE_PRECISION=6", "-where", where,
                            file, osm, name], check=True, capture_output=True)
            return [feature["geometry"]["coordinates"] for feature in json.loads(file.read_text())["features"]]

        areas = [sum(abs(ring_area(polygon[0])) - sum(abs(ring_area(hole)) for hole in polygon[1:]) for polygon in shape)
                 for shape in layer("multipolygons", "building IS NOT NULL")]
        lines = layer("lines", "highway IS NOT NULL")
        self.assertEqual(int(found[1]), len(areas))
        self.assertAlmostEqual(float(found[2]), sum(areas), delta=0.06)  # printed to 0.1 m2
        self.assertEqual(int(found[3]), len(lines))
        self.assertAlmostEqual(float(found[4]), sum(math.dist(a, b) for line in lines for a, b in zip(line, line[1:])), delta=0.06)
        self.assertEqual(int(found[5]), 1)

    @unittest.skipUnless(HAS_MAPS and HAS_TOOLS, "needs libosmium and gdal-bin (scripts/packages maps)")
    def test_roofs_have_the_altitudes_of_their_tags(self):
        osm = self.folder / "village.osm"
        village().write(osm)
        scene = {"osm": str(osm)}
        for north, east, altitude in ((50, 0, 9.0), (90, 0, 14.0), (90, -5, 13.0), (42, 38, 6.0), (86, 50, 12.5), (98, 48, 0.0)):
            self.assertAlmostEqual(self.altitude_below(scene, north, east, 60.0), altitude, delta=0.1, msg=(north, east))

    @unittest.skipUnless(HAS_MAPS and HAS_TERRAIN and HAS_TOOLS, "needs libosmium, GDAL and gdal-bin (scripts/packages maps)")
    def test_the_terrain_and_buildings_have_the_heights_of_the_model(self):
        osm = self.folder / "village.osm"
        village().write(osm)
        tif = self.elevation("hills.tif", lambda north, east: 430 + 6e5 * north * east + 15 * math.sin(900 * north) + 8e3 * east)
        scene = {"osm": str(osm), "terrain": str(tif)}

        def model(north, east):
            """The height of the sample that is nearest to a place, and that place."""
            column, row = round(east / EAST_PER_DEG / 2e-4) + 40, 40 - round(north / NORTH_PER_DEG / 2e-4)
            value = subprocess.run(["gdallocationinfo", "-valonly", tif, str(column), str(row)], capture_output=True, text=True, check=True).stdout
            return float(value), (40 - row) * 2e-4, (column - 40) * 2e-4

        origin = model(0, 0)[0]
        for north, east in ((-60, -90), (150, 40), (-200, 100)):
            height, latitude, longitude = model(north, east)
            place = subprocess.run(["gdaltransform", "-s_srs", "EPSG:4326", "-t_srs", PLANE, "-output_xy"], check=True, capture_output=True, text=True,
                                   input=f"{LONGITUDE + longitude} {LATITUDE + latitude}").stdout.split()
            found = self.altitude_below(scene, float(place[1]), float(place[0]), 120.0)
            self.assertAlmostEqual(found, height - origin, delta=0.1, msg=(north, east))

    @unittest.skipUnless(HAS_MAPS, "needs libosmium (scripts/packages maps)")
    def test_each_object_that_cannot_be_read_has_a_line_with_its_id(self):
        file = village()
        file.outline([(-80, 10), (-90, 20), (-90, 10), (-80, 20)], {"building": "yes"})  # crosses itself
        file.way([file.node(-100, 20), file.node(-110, 20), file.node(-110, 30), file.node(-100, 30)], {"building": "yes"})  # open
        file.way([file.node(-120, 20), 77777, file.node(-130, 20), file.node(-120, 30)], {"building": "yes"})
        file.relation([(99999, "outer")], {"building": "yes"})
        file.box(-60, 30, 10, 10, {"height": "tall"})
        file.node(-60, 60, {"building": "yes"})
        osm = self.folder / "faulty.osm"
        file.write(osm)
        done = self.hedgehop({"osm": str(osm)})
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = done.stderr.splitlines()[1:]
        self.assertEqual(sorted(line.split(":")[0] for line in lines),
                         ["node " + str(len(file.nodes)), "relation 902", "way 108", "way 109", "way 110", "way 111"], done.stderr)

    @unittest.skipUnless(HAS_MAPS, "needs libosmium (scripts/packages maps)")
    def test_bad_files_are_one_line(self):
        wrong = self.folder / "wrong.osm"
        wrong.write_text("<osm><node")
        for osm, reason in (("absent.osm", "there is no such file"), (str(wrong), ""), (__file__, "neither .osm nor .osm.pbf")):
            done = self.hedgehop({"osm": osm})
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn(reason, done.stderr)

    @unittest.skipIf(HAS_MAPS, "for a build without libosmium")
    def test_a_build_without_libosmium_names_the_package(self):
        osm = self.folder / "village.osm"
        village().write(osm)
        done = self.hedgehop({"osm": str(osm)})
        self.assertEqual(done.returncode, 2)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn("install libosmium2-dev", done.stderr)

    @unittest.skipUnless(HAS_MAPS and not HAS_TERRAIN, "for a build with libosmium and without GDAL")
    def test_a_build_without_gdal_names_the_package(self):
        osm = self.folder / "village.osm"
        village().write(osm)
        done = self.hedgehop({"osm": str(osm), "terrain": __file__})
        self.assertEqual(done.returncode, 2)
        self.assertIn("install libgdal-dev", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
