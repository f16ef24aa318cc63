"""Flights of the attack tests: scenarios as JSON, flown by the program, and read back from its files."""

import csv
import json
import os
import pathlib
import subprocess
import tempfile

PROGRAM, SOURCE = os.environ["HEDGEHOP_PROGRAM"], os.environ["HEDGEHOP_SOURCE"]
KNOWN_M = 50.0  # distances are known up to here


def cases(usual):
    """Returns the number of cases: `usual`, times an environment variable if it is set (scripts/soak)."""
    return usual * int(os.environ.get("HEDGEHOP_ATTACKS", 1))


def scenario(**changes):
    """Returns a hexacopter on a plane without cameras that flies straight to a goal; `changes` replaces keys."""
    return {"name": "attacked", "duration": 3, "physics_rate": 500, "control_rate": 50,
            "vehicle": {"use": f"{SOURCE}/configs/vehicles/s900.yaml"},
            "scene": {"type": "park", "extent": 60, "trees": 0, "bushes": 0, "rocks": 0, "vehicles": 0, "texture_size": 64},
            "drawing": {"renderer": "tiles"}, "rig": {"cameras": []}, "velocimeter": {"enabled": False},
            "avoidance": {"module": "go_to_goal", "speed": 3}, "film": {"enabled": False},
            "start": {"north": 0, "east": 0, "altitude": 5, "heading": 0},
            "goal": {"north": 4, "east": 1, "altitude": 5, "radius": 1}, "checks": [], **changes}


class Flight:
    """A flown scenario: exit status, standard output, result.json, and the rows of its tables as texts."""

    def __init__(self, folder, done):
        self.folder, self.status, self.out, self.err = folder, done.returncode, done.stdout, done.stderr
        self.result = json.loads((folder / "result.json").read_text())
        self.rows = [{key: float(text) if text else None for key, text in row.items()} for row in table(folder / "trajectory.csv")]
        self.decisions = table(folder / "decisions.csv")


def table(file):
    with open(file, newline="") as text:
        return list(csv.DictReader(line for line in text if not line.startswith("#")))


class Flights:
    """A temporary folder with scenarios and their flights."""

    def __init__(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.scratch.name)

    def write(self, name, values):
        file = self.folder / f"{name}.yaml"
        file.write_text(json.dumps({**values, "name": name}))
        return file

    def hedgehop(self, *words):
        return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, cwd=self.folder)

    def fly(self, name, values, *options):
        self.write(name, values)
        options = options or ("--no-report",)
        return Flight(self.folder / "runs" / name,
                      self.hedgehop("run", f"{name}.yaml", "--no-video", *options, "--out", f"runs/{name}"))
