"""Time and memory of log exports of a flight with five cameras (docs/logs.md), on one core.

An export simulates the flight again, so its time has two parts: the simulation, whose time is that of the flight without video
and report, and the writing of the log, which must take less time than the simulation. The peak memory is that of exports of one
and of five minutes: the difference is the growth with the length of the flight.
"""

import os
import shutil
import subprocess
import time

SCENARIO, SEED = "garratt2009_city_0_light", 1101
MINUTE_S, LONG_S = 60, 300
FORMATS = ("mcap", "rosbag2", "ulog")
OVERRIDES = ["checks=[]", "may_collide=true"]


def measured(command):
    """Runs a command on one core. Returns its wall time, s, CPU time, s, and peak memory, MB."""
    begin = time.monotonic()
    process = subprocess.Popen(["taskset", "-c", "0", *map(str, command)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if os.waitstatus_to_exitcode(status) > 1:  # 1: the flight misses its goal
        raise SystemExit(f"failed: {' '.join(map(str, command))}")
    return time.monotonic() - begin, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def fly(root, hedgehop, seconds):
    out = root / f"out/bench/logged-{seconds}"
    shutil.rmtree(out, ignore_errors=True)
    overrides = [word for text in [*OVERRIDES, f"duration={seconds}"] for word in ("--set", text)]
    return out, measured([hedgehop, "run", root / f"configs/{SCENARIO}.yaml", "--seed", SEED, *overrides, "--no-video", "--no-report",
                          "--out", out])


def run(root, hedgehop):
    print(f"{'export of one minute, five cameras':40} {'wall s':>9} {'CPU s':>9} {'beyond flight':>14} {'peak MB':>9} {'file MB':>9}")
    runs = {seconds: fly(root, hedgehop, seconds) for seconds in (MINUTE_S, LONG_S)}
    out, (wall_s, cpu_s, peak_mb) = runs[MINUTE_S]
    print(f"{'the flight':40} {wall_s:9.1f} {cpu_s:9.1f} {'-':>14} {peak_mb:9.0f} {'-':>9}", flush=True)
    for name in FORMATS:
        wall, cpu, peak = measured([hedgehop, "export", out, "--format", name])
        size_mb = sum(file.stat().st_size for file in (out / name).iterdir()) / 1e6
        print(f"{name:40} {wall:9.1f} {cpu:9.1f} {cpu - cpu_s:14.1f} {peak:9.0f} {size_mb:9.1f}", flush=True)
        long_out, _ = runs[LONG_S]
        _, _, long_peak = measured([hedgehop, "export", long_out, "--format", name])
        print(f"{name + ', five minutes: peak MB':40} {'':>9} {'':>9} {'':>14} {long_peak:9.0f}", flush=True)
