"""Overhead of a link: wall time of a linked flight without the autopilot's own time, next to an unlinked one."""

import json
import pathlib
import subprocess
import sys
import tempfile

# Scenario, parameter file, settings of both flights. The first has stereo images and all messages, the second no images.
FLIGHTS = {"stereo images and local_map": ("wall_hexa", "hexa_x.parm", ["duration=8", "checks=[]", "avoidance.speed=0.2"]),
           "no images": ("hover_quad", "quad_plus.parm", [])}
REPEATS = 3


def wall_s(root, program, folder, scenario, settings):
    """Median wall time of a flight without waiting for the autopilot, per second of physics, in s."""
    times = []
    for repeat in range(REPEATS):
        out = pathlib.Path(folder) / str(repeat)
        words = [word for setting in settings for word in ("--set", setting)]
        subprocess.run([program, "run", root / f"configs/links/{scenario}.yaml", "--renderer", "tiles", "--no-video", "--no-report", "--out", out, *words],
                       check=True, capture_output=True)
        result = json.loads((out / "result.json").read_text())
        link = result.get("link")
        steps_s = link["frames"] / result["physics_rate_hz"] if link else result["flight_time_s"]
        waited_s = result["time"]["link_wait_s"] if link else 0.0
        times.append((result["wall_s"] - waited_s) / steps_s)
    return sorted(times)[REPEATS // 2]


def run(root, program):
    peer = root / "tests/sim/link/scripted_peer.py"
    for name, (scenario, parameters, settings) in FLIGHTS.items():
        command = f"link.command=[{sys.executable}, {peer}, -I, '{{instance}}', --defaults, {parameters}]"
        with tempfile.TemporaryDirectory() as folder:
            unlinked = wall_s(root, program, folder, scenario, ["link=null", "physics_rate=1000", *settings])
            linked = wall_s(root, program, folder, scenario, [command, *settings])
        print(f"{'linked flight, ' + name + ': wall ms per s of physics':60} {1e3 * linked:8.1f} {1e3 * unlinked:8.1f} {linked / unlinked:6.3g}",
              flush=True)
