"""Speedup of a batch with two workers, the CPU time of batches themselves and of the start of a flight, next to their floors.

The floor of the speedup is that of two copies of a loop without memory traffic. If two cores share execution units or are
used by other processes, their speedup is below 2, and a batch cannot exceed it. The four kinds of runs are interleaved, so
that other load affects all of them equally. The program prints medians and the share of the machine that other processes used.

The floor of the start of a flight is `hedgehop --version`, which only loads the libraries.
"""

import os
import pathlib
import shutil
import statistics
import subprocess
import time

ROUNDS = 5
FLIGHTS = 6
CITY, CONTROL = "configs/garratt2009_city_0_light.yaml", "configs/andert2007_control.yaml"
OWN = {"12 city flights of 10 s": (CITY, 10, 12), "60 control flights of 0.1 s": (CONTROL, 0.1, 60)}  # scenario, s, flights
LOOP = """
int main(int, char** words) {
  unsigned long x = 1, n = 0;
  for (const char* c = words[1]; *c; ++c) n = 10 * n + (*c - '0');
  for (; n > 0; --n) x = x * 6364136223846793005ul + 1442695040888963407ul;
  return x == 0;
}
"""


def cpu_s(processes):
    times = os.times()
    return times.children_user + times.children_system if processes == "children" else times.user + times.system


def machine_s():
    """CPU time of all processes, s."""
    ticks = [int(word) for word in pathlib.Path("/proc/stat").read_text().split("\n")[0].split()[1:9]]
    hertz = os.sysconf("SC_CLK_TCK")
    return (sum(ticks) - ticks[3] - ticks[4]) / hertz


def own_and_flights_s(command):
    """Runs a batch. Returns the CPU times of the batch process and of its workers, s, as counted by the kernel."""
    batch = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.waitid(os.P_PID, batch.pid, os.WEXITED | os.WNOWAIT)  # keeps the counters readable
    fields = pathlib.Path(f"/proc/{batch.pid}/stat").read_text().rsplit(")", 1)[1].split()
    status = batch.wait()
    if status > 1:  # 1: a check fails, as expected if the flight is cut short
        raise SystemExit(f"{' '.join(map(str, command))}: exit status {status}")
    hertz = os.sysconf("SC_CLK_TCK")
    return (int(fields[11]) + int(fields[12])) / hertz, (int(fields[13]) + int(fields[14])) / hertz


class Shares:
    """Wall times of the runs, and the share of the machine that other processes used."""

    def __init__(self):
        self.times, self.others = {}, []

    def take(self, kind, run):
        before, mine, begin = machine_s(), cpu_s("children"), time.monotonic()
        run()
        wall = time.monotonic() - begin
        self.times.setdefault(kind, []).append(wall)
        others = machine_s() - before - (cpu_s("children") - mine)
        self.others.append(max(0.0, others) / (wall * os.cpu_count()))

    def median(self, kind):
        return statistics.median(self.times[kind])


def loop_program(folder):
    folder.mkdir(parents=True, exist_ok=True)
    source, program = folder / "loop.cpp", folder / "loop"
    source.write_text(LOOP)
    subprocess.run(["c++", "-O2", source, "-o", program], check=True)
    begin = time.monotonic()
    subprocess.run([program, "200000000"], check=True)
    return [program, str(int(200000000 * 2.0 / (time.monotonic() - begin)))]  # about 2 s


def both(command):
    first, second = subprocess.Popen(command), subprocess.Popen(command)
    first.wait(), second.wait()


def cpu_of_s(command):
    before = cpu_s("children")
    subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return cpu_s("children") - before


def print_row(figure, here, floor, ratio="-"):
    print(f"{figure:52} {here:>10} {floor:>10} {ratio:>7}", flush=True)


def print_starts(root, hedgehop, out):
    """CPU time of the shortest flight of a worker, which is its start, next to that of the program."""
    program = statistics.median(cpu_of_s([hedgehop, "--version"]) for _ in range(ROUNDS))
    for name, scenario, renderer in (("city", CITY, "tiles"), ("city", CITY, "osmesa"), ("control", CONTROL, "tiles")):
        command = [hedgehop, "run", root / scenario, "--renderer", renderer, "--set", "duration=0.1", "--no-video",
                   "--no-report", "--out", out / "start"]
        start = statistics.median(cpu_of_s(command) for _ in range(ROUNDS))
        print_row(f"flight of 0.1 s, {name}, {renderer}: CPU time, ms", f"{1e3 * start:.0f}", f"{1e3 * program:.0f}",
                  f"{start / program:.3g}")


def run(root, hedgehop):
    out = root / "out" / "bench" / "batch"
    loop = loop_program(out)

    def fly(scenario, seconds, flights, workers):
        command = [hedgehop, "batch", root / scenario, "--seeds", f"1:{flights}", "--set", f"duration={seconds}", "-j",
                   str(workers), "--out", out / "flights"]
        own, of_flights = own_and_flights_s(command)
        shutil.rmtree(out / "flights")
        return own / of_flights

    shares = Shares()
    for _ in range(ROUNDS):
        shares.take("batch 1", lambda: fly(CITY, 10, FLIGHTS, 1))
        shares.take("loop 1", lambda: subprocess.run(loop, check=True))
        shares.take("batch 2", lambda: fly(CITY, 10, FLIGHTS, 2))
        shares.take("loop 2", lambda: both(loop))
    gain, floor = shares.median("batch 1") / shares.median("batch 2"), 2.0 * shares.median("loop 1") / shares.median("loop 2")
    print(f"\n{FLIGHTS} flights of 10 s, medians of {ROUNDS} rounds; other processes used {statistics.median(shares.others):.0%} of the "
          f"machine, at most {max(shares.others):.0%}")
    print_row("figure", "here", "floor", "ratio")
    print_row("speedup, 2 workers", f"{gain:.2f}", f"{floor:.2f}", f"{gain / floor:.2f}")
    for name, (scenario, seconds, flights) in OWN.items():
        print_row(f"CPU time of the batch itself: {name}", f"{fly(scenario, seconds, flights, 1):.2%}", "0%")
    print_starts(root, hedgehop, out)
