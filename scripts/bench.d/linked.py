"""Overhead of a link: wall time of a linked flight without the autopilot's own time, next to an unlinked one."""

import json
import pathlib
import subprocess
import sys
import tempfile

SCENARIO = "configs/links/hover_quad.yaml"
REPEATS = 3


def wall_s(root, program, folder, settings):
    """Median wall time of a flight without waiting for the autopilot, per second of physics, in s."""
    times = []
    for repeat in range(REPEATS):
        out = pathlib.Path(folder) / str(repeat)
        words = [word for setting in settings for word in ("--set", setting)]
        subprocess.run([program, "run", root / SCENARIO, "--renderer", "tiles", "--no-video", "--no-report", "--out", out, *words],
                       check=True, capture_output=True)
        result = json.loads((out / "result.json").read_text())
        link = result.get("link")
        steps_s = link["frames"] / result["physics_rate_hz"] if link else result["flight_time_s"]
        waited_s = result["time"]["link_wait_s"] if link else 0.0
        times.append((result["wall_s"] - waited_s) / steps_s)
    return sorted(times)[REPEATS // 2]


def run(root, program):
    peer = root / "tests/sim/link/scripted_peer.py"
    command = f"link.command=[{sys.executable}, {peer}, -I, '{{instance}}', --defaults, quad_plus.parm]"
    with tempfile.TemporaryDirectory() as folder:
        unlinked = wall_s(root, program, folder, ["link=null", "physics_rate=1000"])
        linked = wall_s(root, program, folder, [command])
    print(f"{'linked flight: wall time per s of physics, ms':52} {1e3 * linked:10.2f} {1e3 * unlinked:10.2f} {linked / unlinked:7.3g}", flush=True)
