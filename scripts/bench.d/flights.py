"""CPU time of whole flights with `tiles`, in multiples of real time, and the time and size of the page of a long flight.

The start of a flight (process, scene, first image) is subtracted: it is that of a flight of 0.1 s. The medians of the stages
are printed, too.
"""

import json
import re
import resource
import shutil
import subprocess
import sys
import time

SEED, SECONDS, START_SECONDS = 1101, 20, 0.1
NOISE_FREE = ["--set", "rig.sensor={}"]
FLIGHTS = [("city, five cameras of 400 px at 50 Hz, day noise", "garratt2009_city_0", []),
           ("the same, noise-free", "garratt2009_city_0", NOISE_FREE),
           ("city light, five cameras of 200 px at 25 Hz", "garratt2009_city_0_light", []),
           ("room, five cameras of 400 px at 50 Hz", "garratt2009_room_0", []),
           ("andert 320", "andert2007_tree_320", []),
           ("perez light", "perez2018_route_light", []),
           ("zingg 2m5", "zingg2010_corridor_2m5", []),
           ("shah avoid", "shah2009_avoid", []),
           ("local_map city", "local_map_city", [])]
TOWN = "town of 5 km, the cameras of city light"


def cpu_s():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def fly(root, hedgehop, scenario, seconds, options):
    """Returns the CPU time, s, and the result of the flight."""
    out = root / "out/bench/flight"
    before = cpu_s()
    done = subprocess.run([hedgehop, "run", root / f"configs/{scenario}.yaml", "--seed", str(SEED), "--renderer", "tiles", "--set",
                           f"duration={seconds}", "--set", "checks=[]", "--no-video", "--no-report", "--out", out, *options],
                          capture_output=True, text=True)
    if done.returncode > 1:  # 1: the flight collides
        raise SystemExit(f"{scenario}: {done.stderr.strip()}")
    return cpu_s() - before, json.loads((out / "result.json").read_text())


def flight_in_town(root, hedgehop):
    """The flight along a street of a generated map; none if this build reads no maps."""
    features = subprocess.run([hedgehop, "--version", "--features"], capture_output=True, text=True, check=True).stdout
    if not re.search(r"yes +maps from OpenStreetMap", features):
        return []
    file = root / "out/bench/town.osm"
    file.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run([sys.executable, root / "scripts/bench.d/town.py", file], check=True)
    return [(TOWN, "garratt2009_city_0_light",
             ["--set", f"scene={{type: map, osm: {file}, origin: {{latitude: 47, longitude: 8}}, vehicles: 10}}",
              "--set", "start={north: -130, east: 60, altitude: 10, heading: 0}"])]


def long_flight(root, hedgehop):
    """Flies for five minutes. Returns the folder and the time flown, s."""
    out = root / "out/bench/page"
    shutil.rmtree(out, ignore_errors=True)
    subprocess.run([hedgehop, "run", root / "configs/garratt2009_room_0_light.yaml", "--renderer", "tiles", "--set", "duration=300", "--set",
                    "checks=[]", "--no-video", "--out", out], stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    return out, json.loads((out / "result.json").read_text())["flight_time_s"]


def print_page(root, hedgehop):
    """The report of a flight of five minutes."""
    out, flown = long_flight(root, hedgehop)
    begin = time.monotonic()
    subprocess.run([hedgehop, "report", out], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    seconds = time.monotonic() - begin
    print(f"page of a flight of {flown:.0f} s: {seconds:.2f} s, {(out / 'report.html').stat().st_size / 1e6:.2f} MB", flush=True)


def run(root, hedgehop, wanted):
    chosen = [flight for flight in FLIGHTS if any(word in flight[1] or word == "flights" for word in wanted or [""])]
    if any(word in TOWN or word == "flights" for word in wanted or [""]):
        chosen += flight_in_town(root, hedgehop)
    if not chosen:
        return False
    print(f"\n{'flight with tiles, one core':52} {'x real time':>11} {'render ms':>10} {'decision ms':>12}")
    for label, scenario, options in chosen:
        start_s, _ = fly(root, hedgehop, scenario, START_SECONDS, options)
        whole_s, result = fly(root, hedgehop, scenario, SECONDS, options)
        flown_s = result["flight_time_s"] - START_SECONDS
        render_ms, decision_ms = result["render_ms"]["median"], result["decision_ms"]["median"]
        print(f"{label:52} {flown_s / (whole_s - start_s):11.2f} {render_ms:10.2f} {decision_ms:12.2f}", flush=True)
    if "flights" in wanted or not wanted:
        print_page(root, hedgehop)
    return True
