"""Short flights for several tests."""

import json
import os
import pathlib
import subprocess
import sys

SOURCE = pathlib.Path(os.environ["HEDGEHOP_SOURCE"])
PROGRAM = os.environ["HEDGEHOP_PROGRAM"]
VERSION = f"{sys.version_info.major}.{sys.version_info.minor}"  # of Python
CITY = SOURCE / "configs/garratt2009_city_0_light.yaml"
TREE = SOURCE / "configs/andert2007_tree_160.yaml"
SHORT = {"duration": 1, "film.enabled": False, "drawing.renderer": "tiles"}
STRAIGHT = {**SHORT, "duration": 2, "avoidance": {"module": "go_to_goal", "speed": 3.0}}


def set_options(values):
    return [word for key, value in values.items() for word in ("--set", f"{key}={json.dumps(value)}")]


def run_program(scenario, values, out, seed=1, environment=()):
    """Flies with the program. Returns its exit status, result.json or None, and the text on standard error."""
    done = subprocess.run([PROGRAM, "run", str(scenario), "--seed", str(seed), *set_options(values), "--no-video",
                           "--no-report", "--out", str(out)], capture_output=True, text=True,
                          env={**os.environ, **dict(environment)})
    file = pathlib.Path(out) / "result.json"
    return done.returncode, json.loads(file.read_text()) if file.exists() else None, done.stderr


def steady(result):
    """Returns a result without the values that may differ between runs."""
    kept = {key: value for key, value in result.items()
            if not key.endswith("_ms") and key not in ("wall_s", "realtime_factor", "command_line")}
    return kept
