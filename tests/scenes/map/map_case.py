"""Scenes of type map from files that the tests write."""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from map_file import LATITUDE, LONGITUDE, MapFile

PROGRAM, SOURCE = sys.argv[1:3]
PLANE = f"+proj=tmerc +lat_0={LATITUDE} +lon_0={LONGITUDE} +k=1 +ellps=WGS84 +units=m"
FEATURES = subprocess.run([PROGRAM, "--version", "--features"], capture_output=True, text=True, check=True).stdout
HAS_MAPS = re.search(r"yes +maps from OpenStreetMap", FEATURES) is not None
HAS_TERRAIN = re.search(r"yes +terrain of maps", FEATURES) is not None
HAS_TOOLS = all(shutil.which(tool) for tool in ("ogr2ogr", "gdal_translate", "gdallocationinfo"))


def village():
    """Buildings of every shape, two streets and a tree."""
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


class MapCase(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def written(self, file, name="village.osm"):
        """Writes a map. @return its path."""
        path = self.folder / name
        if name.endswith(".pbf"):
            file.write_pbf(path)
        else:
            file.write(path)
        return path

    def render(self, scene, *, north=0.0, east=0.0, altitude=60.0, camera="down", what="depth_m", image="image.tiff"):
        """Renders a scene from a place. @return the process."""
        scene = {key: str(value) if isinstance(value, pathlib.Path) else value for key, value in scene.items()}
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

    def remarks(self, scene):
        """The lines on standard error of a scene that must be drawn."""
        done = self.render(scene)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr.splitlines()

    def refusal(self, scene):
        """The one line on standard error of a scene that must be refused."""
        done = self.render(scene)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        return done.stderr.strip()

    def altitude_below(self, scene, north, east, altitude):
        """The altitude of the surface below a place, from the middle of a depth image."""
        done = self.render(scene, north=north, east=east, altitude=altitude)
        self.assertEqual(done.returncode, 0, done.stderr)
        values = subprocess.run(["gdallocationinfo", "-valonly", self.folder / "image.tiff", "16", "16"],
                                capture_output=True, text=True, check=True).stdout
        return altitude - float(values)

    def elevation(self, name, height_at, spacing_deg=2e-4, side=81, options=("-a_srs", "EPSG:4326"), longitude=LONGITUDE):
        """Writes heights over degrees north and east of the origin as a GeoTIFF; -9999 is no data."""
        grid = self.folder / "grid.asc"
        low = (side - 1) / 2
        rows = [" ".join(f"{height_at((low - row) * spacing_deg, (column - low) * spacing_deg):.6f}" for column in range(side))
                for row in range(side)]
        grid.write_text(f"ncols {side}\nnrows {side}\nxllcenter {longitude - low * spacing_deg}\nyllcenter {LATITUDE - low * spacing_deg}\n"
                        f"cellsize {spacing_deg}\nNODATA_value -9999\n" + "\n".join(rows) + "\n")
        file = self.folder / name
        subprocess.run(["gdal_translate", "-q", "-ot", "Float64", *options, grid, file], check=True, stdout=subprocess.DEVNULL)
        return file
