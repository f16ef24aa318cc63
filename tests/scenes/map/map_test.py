"""Maps compared with GDAL's tools: footprints with ogr2ogr, heights with gdallocationinfo.

usage: map_test.py PROGRAM SOURCE
"""

import json
import math
import re
import subprocess
import sys
import unittest

from map_case import HAS_MAPS, HAS_TERRAIN, HAS_TOOLS, LATITUDE, LONGITUDE, PLANE, MapCase, village
from map_file import EAST_PER_DEG, NORTH_PER_DEG, MapFile


def ring_area(ring):
    return 0.5 * sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:]))


def quarter():
    """Hundreds of buildings with three to nine corners, courtyards and several outlines, all over the radius."""
    file = MapFile()
    for k in range(300):
        north, east = 60.0 * (k // 20 - 7), 60.0 * (k % 20 - 10)
        corners = [(north + (8 + 3 * math.sin(7 * k + i)) * math.cos(2 * math.pi * i / (3 + k % 7)),
                    east + (8 + 3 * math.sin(7 * k + i)) * math.sin(2 * math.pi * i / (3 + k % 7))) for i in range(3 + k % 7)]
        if k % 11 == 0:  # a multipolygon with a courtyard and a second outline
            outer = file.outline([(north - 12, east - 12), (north + 12, east - 12), (north + 12, east + 12), (north - 12, east + 12)])
            second = file.outline([(north + 15, east), (north + 22, east), (north + 22, east + 9)])
            file.relation([(file.outline(corners), "inner"), (outer, "outer"), (second, "outer")], {"building": "yes"})
        else:
            file.outline(corners, {"building": "yes", "building:levels": str(1 + k % 5)})
    return file


@unittest.skipUnless(HAS_MAPS and HAS_TOOLS, "needs libosmium and gdal-bin (scripts/packages maps)")
class Footprints(MapCase):
    def layer(self, osm, name, where):
        """The coordinates of the features of a layer in the plan, by ogr2ogr."""
        file = self.folder / f"{name}.json"
        subprocess.run(["ogr2ogr", "-f", "GeoJSON", "-t_srs", PLANE, "-lco", "RFC7946=NO", "-lco", "COORDINATE_PRECISION=6", "-where", where,
                        file, osm, name], check=True, capture_output=True)
        return [feature["geometry"]["coordinates"] for feature in json.loads(file.read_text())["features"]]

    def summary(self, osm):
        """Counts and sums of the line that precedes the remarks."""
        lines = self.remarks({"osm": osm})
        self.assertEqual(len(lines), 1, lines)
        found = re.fullmatch(r"'.*': (\d+) buildings on ([\d.]+) m2, (\d+) streets of ([\d.]+) m, (\d+) trees", lines[0])
        self.assertIsNotNone(found, lines[0])
        return [float(number) for number in found.groups()]

    def compare(self, osm):
        buildings, area, streets, length, _ = self.summary(osm)
        areas = [sum(abs(ring_area(polygon[0])) - sum(abs(ring_area(hole)) for hole in polygon[1:]) for polygon in shape)
                 for shape in self.layer(osm, "multipolygons", "building IS NOT NULL")]
        lines = self.layer(osm, "lines", "highway IS NOT NULL")
        self.assertEqual(buildings, len(areas))
        self.assertAlmostEqual(area, sum(areas), delta=0.06)  # printed to 0.1 m2
        self.assertEqual(streets, len(lines))
        self.assertAlmostEqual(length, sum(math.dist(a, b) for line in lines for a, b in zip(line, line[1:])), delta=0.06)

    def test_counts_and_areas_equal_those_of_ogr2ogr(self):
        self.compare(self.written(village()))
        self.compare(self.written(village(), "village.osm.pbf"))

    def test_counts_and_areas_of_many_shapes_equal_those_of_ogr2ogr(self):
        self.compare(self.written(quarter(), "quarter.osm.pbf"))

    def test_both_formats_have_the_same_objects(self):
        self.assertEqual(self.summary(self.written(quarter())), self.summary(self.written(quarter(), "quarter.osm.pbf")))

    def test_roofs_have_the_altitudes_of_their_tags(self):
        scene = {"osm": self.written(village())}
        for north, east, altitude in ((50, 0, 9.0), (90, 0, 14.0), (90, -5, 13.0), (42, 38, 6.0), (86, 50, 12.5), (98, 48, 0.0)):
            self.assertAlmostEqual(self.altitude_below(scene, north, east, 60.0), altitude, delta=0.1, msg=(north, east))


@unittest.skipUnless(HAS_MAPS and HAS_TERRAIN and HAS_TOOLS, "needs libosmium, GDAL and gdal-bin (scripts/packages maps)")
class Terrain(MapCase):
    def place(self, latitude, longitude):
        """North and east of a place, m, by gdaltransform. @param latitude, longitude  from the origin, degrees."""
        done = subprocess.run(["gdaltransform", "-s_srs", "EPSG:4326", "-t_srs", PLANE, "-output_xy"], check=True, capture_output=True, text=True,
                              input=f"{LONGITUDE + longitude} {LATITUDE + latitude}")
        east, north = map(float, done.stdout.split())
        return north, east

    def test_the_terrain_has_the_heights_of_the_model(self):
        tif = self.elevation("hills.tif", lambda north, east: 430 + 6e5 * north * east + 15 * math.sin(900 * north) + 8e3 * east)
        scene = {"osm": self.written(village()), "terrain": tif}

        def model(north, east):
            """The height of the sample that is nearest to a place, and the place of that sample."""
            column, row = round(east / EAST_PER_DEG / 2e-4) + 40, 40 - round(north / NORTH_PER_DEG / 2e-4)
            value = subprocess.run(["gdallocationinfo", "-valonly", tif, str(column), str(row)], capture_output=True, text=True, check=True).stdout
            return float(value), self.place((40 - row) * 2e-4, (column - 40) * 2e-4)

        origin = model(0, 0)[0]
        for near in ((-60, -90), (150, 40), (-200, 100)):
            height, (north, east) = model(*near)
            self.assertAlmostEqual(self.altitude_below(scene, north, east, 120.0), height - origin, delta=0.1, msg=near)

    def test_buildings_have_their_heights_above_their_lowest_corner(self):
        def plane(north, east):  # degrees from the origin
            return 430 + 9e3 * north - 5e3 * east

        tif = self.elevation("slope.tif", plane)
        scene = {"osm": self.written(village()), "terrain": tif}
        for corners, inside, height in (([(40, -10), (60, -10), (60, 10), (40, 10)], (50, 0), 9.0),
                                        ([(80, 30), (120, 32), (118, 70), (82, 66)], (86, 50), 12.5)):
            foot = min(plane(north / NORTH_PER_DEG, east / EAST_PER_DEG) for north, east in corners) - plane(0, 0)
            self.assertAlmostEqual(self.altitude_below(scene, *inside, 120.0), foot + height, delta=0.1)

    def test_projected_models_in_feet_have_the_same_heights(self):
        tif = self.elevation("hills.tif", lambda north, east: 430 + 4e3 * north - 3e3 * east)
        projected = self.folder / "projected.tif"
        subprocess.run(["gdalwarp", "-q", "-t_srs", "EPSG:32632", "-tr", "15", "15", "-r", "bilinear", tif, projected], check=True)
        feet = self.folder / "feet.tif"
        subprocess.run(["gdal_translate", "-q", "-a_scale", f"{1 / 0.3048}", projected, feet], check=True)
        in_feet = feet.with_suffix(".vrt")
        subprocess.run(["gdal_translate", "-q", "-of", "VRT", feet, in_feet], check=True)
        in_feet.write_text(in_feet.read_text().replace("<ColorInterp>", "<UnitType>ft</UnitType>\n    <ColorInterp>"))
        osm = self.written(village())
        for north, east in ((-60, -90), (150, 40)):
            expected = self.altitude_below({"osm": osm, "terrain": tif}, north, east, 120.0)
            self.assertAlmostEqual(self.altitude_below({"osm": osm, "terrain": in_feet}, north, east, 120.0), expected, delta=0.1)

    def test_a_model_with_too_many_samples_states_how_far_it_is_from_the_others(self):
        tif = self.elevation("fine.tif", lambda north, east: 430 + 3 * math.sin(2 * math.pi * north / 1e-4), spacing_deg=1e-5, side=701)
        lines = self.remarks({"osm": self.written(village()), "terrain": tif})
        self.assertEqual(len(lines), 2, lines)
        found = re.search(r"fine.tif': every 2. sample is used; the others are up to ([\d.]+) m from the surface", lines[1])
        self.assertIsNotNone(found, lines)
        # The sine has 10 samples per period. Halfway between two kept ones, it differs by its value times 1 - cos(2 pi / 10).
        self.assertAlmostEqual(float(found[1]), 3 * math.sin(0.6 * math.pi) * (1 - math.cos(math.pi / 5)), delta=0.02)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
