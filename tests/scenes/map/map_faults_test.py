"""Faulty maps and elevation models: one line for each faulty object, one line for each faulty file, and no crash.

usage: map_faults_test.py PROGRAM SOURCE
"""

import pathlib
import random
import re
import subprocess
import sys
import unittest

from map_case import HAS_MAPS, HAS_TERRAIN, HAS_TOOLS, MapCase, village
from map_file import LATITUDE, LONGITUDE

BUILDING = {"building": "yes"}


@unittest.skipUnless(HAS_MAPS, "needs libosmium (scripts/packages maps)")
class Objects(MapCase):
    def expect(self, file, names, name="faulty.osm"):
        """Checks that each of the named objects has one line, and all others none."""
        lines = self.remarks({"osm": self.written(file, name)})
        self.assertRegex(lines[0], r"^'.*': \d+ buildings on ")
        self.assertEqual(sorted(line.split(":")[0] for line in lines[1:]), sorted(names), lines)
        return lines

    def test_outlines(self):
        file = village()
        bad = [file.outline([(-80, 10), (-90, 20), (-90, 10), (-80, 20)], BUILDING),  # crosses itself
               file.way([file.node(-100, 20), file.node(-110, 20), file.node(-110, 30), file.node(-100, 30)], BUILDING),  # open
               file.way([file.node(-120, 20), 77777, file.node(-130, 20), file.node(-120, 30)], BUILDING),  # lacks a node
               file.way([], BUILDING),
               file.way([file.node(-140, 20)], BUILDING),
               file.way([1, 2, 1], BUILDING),
               file.outline([(-150, 0), (-150, 10), (-150, 20)], BUILDING),  # no area
               file.outline([(-160, 0)] * 4, BUILDING),
               file.box(-170, 0, 5, 5, {"area": "no"}),
               file.outline([(-180, 0), (-185, 0), (-185, 5)], {"building:part": "yes"})]
        triangle = file.way([file.node(-100, 40), file.node(-110, 40), file.node(-110, 50)], BUILDING)  # open
        bad.append(triangle)
        beyond = file.node_at(95.0, 8.0)
        bad.append(file.way([1, beyond, 3, 1], BUILDING))
        names = [f"way {number}" for number in bad] + [f"node {file.node(-60, 60, BUILDING)}"]
        for path in ("faulty.osm", "faulty.osm.pbf"):
            lines = self.expect(file, names, path)
            self.assertIn(": 4 buildings on ", lines[0])
            self.assertIn(f"way {triangle}: its outline is open", lines)

    def test_relations(self):
        file = village()
        outer = file.outline([(-80, 0), (-120, 0), (-120, 40), (-80, 40)])
        half = file.way([file.node(-130, 0), file.node(-140, 0), file.node(-140, 20)])
        tagged = file.box(-180, 0, 20, 20)
        inner = file.outline([(-175, 5), (-170, 5), (-170, 10)])
        bad = [file.relation([(99999, "outer")], BUILDING),
               file.relation([(outer, "outer"), (88888, "inner")], BUILDING),
               file.relation([], BUILDING),
               file.relation([(half, "outer")], BUILDING),
               file.relation([(outer, "outer"), (outer, "outer"), (half, "inner")], BUILDING),
               file.relation([(outer, "outer")], {**BUILDING, "type": "site"}),
               file.relation([(outer, "outer")], {"building:part": "yes"}),
               file.relation([(tagged, "outer"), (inner, "inner")])]  # the tags are on the outer way
        for path in ("faulty.osm", "faulty.osm.pbf"):
            self.expect(file, [f"relation {number}" for number in bad], path)

    def test_tags(self):
        file = village()
        bad = [file.box(-60 - 10 * k, 30, 5, 5, {key: value}) for k, (key, value) in enumerate([
            ("height", "tall"), ("height", "-3"), ("height", "nan"), ("height", "inf"), ("height", "1e999"), ("height", "9999"), ("height", "0"),
            ("height", ""), ("height", "1\n2"), ("height", "9" * 255), ("building:levels", "-1"), ("building:levels", "5000"),
            ("min_height", "20"), ("building:min_level", "nan"), ("roof:shape", "onion"), ("roof:height", "-1"), ("roof:direction", "up")])]
        bad.append(file.box(-60, 60, 5, 5, {"height": "tall", "roof:shape": "onion", "min_height": "-1"}))  # three faults
        self.expect(file, [f"way {number}" for number in bad])

    def test_cars_without_a_street(self):
        lines = self.remarks({"osm": self.written(village()), "vehicles": 3})
        self.assertEqual(lines[1:], ["1 of 3 cars: no further straight piece of a street is 40 m long"])
        self.assertEqual(len(self.remarks({"osm": self.written(village()), "vehicles": 1})), 1)

    def test_streets_and_trees(self):
        file = village()
        ways = [file.way([file.node(0, 0)], {"highway": "residential"}),
                file.way([], {"highway": "residential"}),
                file.way([1, 1, 1], {"highway": "residential"}),
                file.way([1, 77777, 2], {"highway": "residential"}),
                file.way([1, 2], {"highway": "canal"}),
                file.way([1, 2, 3], {"highway": "residential", "width": "-4"}),
                file.way([1, 2, 3, 1], {"highway": "pedestrian", "area": "yes"}),
                file.way([1], {"natural": "tree_row"}),
                file.way([1, 2], {"natural": "tree_row", "height": "high"})]
        nodes = [file.node_at(None, None, {"natural": "tree"}), file.node_at(95.0, 8.0, {"natural": "tree"}),
                 file.node_at(47.0, -190.0, {"natural": "tree"}), file.node(0, 30, {"natural": "tree", "height": "1e9"}),
                 file.node(0, 40, {"natural": "tree", "diameter_crown": "wide"})]
        self.expect(file, [f"way {number}" for number in ways] + [f"node {number}" for number in nodes])

    def test_repeated_ids_keep_the_first_object(self):
        file = village()
        for objects, again in ((file.nodes, 3), (file.ways, 0), (file.relations, 0)):
            objects.append(objects[again])
        file.ways.append(next(way for way in file.ways if way[0] == 104))  # a member of the relation
        names = [f"node {file.nodes[3][0]}", "way 101", "way 104", "relation 901"]
        self.assertEqual(self.expect(file, names)[0].split(":")[1], self.remarks({"osm": self.written(village(), "faulty.osm")})[0].split(":")[1])

    def test_objects_far_away_are_left_out(self):
        file = village()
        for place in ((47.5, 8.0), (-47.0, -172.0), (0.0, 0.0), (90.0, 0.0), (-90.0, 180.0)):
            file.node_at(*place, {"natural": "tree"})
        lines = self.expect(file, [])
        self.assertTrue(lines[0].endswith("1 trees; 5 objects outside scene.radius"), lines)

    def test_an_origin_far_from_all_objects_is_refused(self):
        scene = {"osm": self.written(village()), "origin": {"latitude": LONGITUDE, "longitude": LATITUDE}}
        self.assertRegex(self.refusal(scene), rf"'scene.origin': .*all objects are outside scene.radius; the first is at latitude {LATITUDE:.4g}")

    def test_faults_of_objects_far_away_are_not_reported(self):
        def add_faults(file, north):
            """Adds a building, a street that is drawn, one that is not, a tree and a row of two trees. @return their names."""
            start, end = file.node(north, 300), file.node(north + 10, 300)
            ways = [file.box(north, 200, 5, 5, {"height": "tall"}),
                    file.way([start, end], {"highway": "residential", "width": "-4"}),
                    file.way([start, end], {"highway": "canal"}),
                    file.way([start, end], {"natural": "tree_row", "height": "high"})]
            return [f"way {number}" for number in ways] + [f"node {file.node(north, 250, {'natural': 'tree', 'height': '1e9'})}"]

        file = village()
        add_faults(file, 20e3)
        names = add_faults(file, 500)
        lines = self.expect(file, names)
        self.assertTrue(lines[0].endswith("; 5 objects outside scene.radius"), lines)


@unittest.skipUnless(HAS_MAPS, "needs libosmium (scripts/packages maps)")
class Files(MapCase):
    def test_bad_files_are_one_line(self):
        wrong = self.folder / "wrong.osm"
        for content in ("", "<osm><node", "<gpx/>", '<osm version="0.5"/>', '<osm version="0.6"><node id="1" lat="x" lon="8"/></osm>',
                        '<osm version="0.6"><node id="one" lat="47" lon="8"/></osm>'):
            wrong.write_text(content)
            self.assertIn("wrong.osm", self.refusal({"osm": wrong}))
        for osm, reason in ((self.folder / "absent.osm", "there is no such file"), (self.folder, "not a regular file"),
                            (pathlib.Path(__file__), "neither .osm nor .osm.pbf")):
            self.assertIn(reason, self.refusal({"osm": osm}))

    def test_a_file_that_is_not_sorted_names_the_order(self):
        file = village()
        file.ways[0], file.ways[5] = file.ways[5], file.ways[0]
        self.assertIn("each sorted by id", self.refusal({"osm": self.written(file)}))
        ways_first = self.written(village())
        nodes, ways = (re.findall(rf"<{kind} .*", ways_first.read_text()) for kind in ("node", "way"))
        ways_first.write_text("\n".join(['<osm version="0.6">', *ways, *nodes, "</osm>"]))
        self.assertIn("each sorted by id", self.refusal({"osm": ways_first}))

    def test_a_truncated_pbf_is_one_line(self):
        whole = self.written(village(), "whole.osm.pbf").read_bytes()
        part = self.folder / "part.osm.pbf"
        for share in (0.02, 0.1, 0.3, 0.6, 0.9, 0.999):
            part.write_bytes(whole[:int(share * len(whole))])
            self.assertIn("part.osm.pbf", self.refusal({"osm": part}))

    def test_changed_bytes_do_not_crash(self):
        generator = random.Random(3)
        for name in ("village.osm", "village.osm.pbf"):
            whole = self.written(village(), name).read_bytes()
            for _ in range(10):
                changed = bytearray(whole)
                for _ in range(generator.randint(1, 5)):
                    changed[generator.randrange(len(changed))] = generator.randrange(256)
                file = self.folder / ("changed" + name[7:])
                file.write_bytes(changed)
                done = self.render({"osm": file})
                self.assertIn(done.returncode, (0, 2), done.stderr)


@unittest.skipUnless(HAS_MAPS and HAS_TERRAIN and HAS_TOOLS, "needs libosmium, GDAL and gdal-bin (scripts/packages maps)")
class Elevations(MapCase):
    def setUp(self):
        super().setUp()
        self.osm = self.written(village())

    def test_bad_models_are_one_line(self):
        level = (lambda north, east: 430.0)
        picture = self.folder / "picture.pgm"
        picture.write_bytes(b"P5 90 90 255\n" + bytes(8100))
        bare = self.folder / "bare.tif"
        subprocess.run(["gdal_translate", "-q", picture, bare], check=True, capture_output=True)
        whole = self.elevation("whole.tif", level).read_bytes()
        cut, text, huge = self.folder / "cut.tif", self.folder / "text.tif", self.folder / "huge.vrt"
        cut.write_bytes(whole[:len(whole) // 3])
        text.write_text("no raster")
        huge.write_text('<VRTDataset rasterXSize="2000000000" rasterYSize="2000000000"><SRS>EPSG:4326</SRS>'
                        '<GeoTransform>7, 1e-9, 0, 48, 0, -1e-9</GeoTransform><VRTRasterBand dataType="Float32" band="1"/></VRTDataset>')
        for file, reason in ((bare, "no georeference"), (self.elevation("placeless.tif", level, options=()), "coordinate system is unknown"),
                             (self.elevation("away.tif", level, longitude=18.0), "does not cover the map"),
                             (self.elevation("void.tif", lambda north, east: -9999), "no height at the origin"),
                             (huge, "valid: at most 100000"), (text, "text.tif"), (cut, "cut.tif"), (self.folder / "absent.tif", "no such file")):
            self.assertIn(reason, self.refusal({"osm": self.osm, "terrain": file}))

    def test_objects_on_holes_are_reported(self):
        holes = self.elevation("holes.tif", lambda north, east: -9999 if north > 7e-4 else 430.0)
        lines = self.remarks({"osm": self.osm, "terrain": holes})
        self.assertEqual([line.split(":")[0] for line in lines[1:]], ["way 106", "way 102", "relation 901"], lines)

    def test_objects_outside_the_model_are_reported(self):
        small = self.elevation("small.tif", lambda north, east: 430.0, side=5)
        lines = self.remarks({"osm": self.osm, "terrain": small})
        self.assertEqual(len(lines), 1 + 6, lines)  # four buildings and two streets

    def test_heights_that_do_not_exist_are_holes(self):
        tif = self.elevation("absurd.tif", lambda north, east: 1e30 if north > 35e-4 and east > 35e-4 else 430.0)
        lines = self.remarks({"osm": self.osm, "terrain": tif})
        self.assertRegex(lines[1], r"absurd.tif': \d+ samples have heights that do not exist on Earth; they are holes")
        self.assertEqual(len(lines), 2)


class WithoutPackages(MapCase):
    @unittest.skipIf(HAS_MAPS, "for a build without libosmium")
    def test_a_build_without_libosmium_names_the_package(self):
        self.assertIn("install libosmium2-dev", self.refusal({"osm": self.written(village())}))

    @unittest.skipUnless(HAS_MAPS and not HAS_TERRAIN, "for a build with libosmium and without GDAL")
    def test_a_build_without_gdal_names_the_package(self):
        self.assertIn("install libgdal-dev", self.refusal({"osm": self.written(village()), "terrain": pathlib.Path(__file__)}))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
