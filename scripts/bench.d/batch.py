"""Flights per hour of a batch with two workers over one, and a batch's own processor time, each beside its floor.

The floor of the first is what two copies of a loop that touches no memory gain over one copy: cores that share one core's
units, or are lent to others, gain less than twice, and no batch can do better. All four kinds of runs take turns, so that
what else the machine does affects them alike; it prints medians, and the share of the machine that others took.
"""

import os
import pathlib
import shutil
import statistics
import subprocess
import time

ROUNDS = 5
FLIGHTS = 6
LOOP = """
int main(int, char** words) {
  unsigned long x = 1, n = 0;
  for (const char* c = words[1]; *c; ++c) n = 10 * n + (*c - '0');
  for (; n > 0; --n) x = x * 6364136223846793005ul + 1442695040888963407ul;
  return x == 0;
}
"""


def cpu_s(who):
    times = os.times()
    return times.children_user + times.children_system if who == "children" else times.user + times.system


def machine_s():
    """Processor time of all processes together, and idle time, s."""
    ticks = [int(word) for word in pathlib.Path("/proc/stat").read_text().split("\n")[0].split()[1:9]]
    hertz = os.sysconf("SC_CLK_TCK")
    return (sum(ticks) - ticks[3] - ticks[4]) / hertz


def own_and_flights_s(command):
    """Runs a batch; returns its own processor time and its workers', s, as the kernel counted them."""
    batch = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.waitid(os.P_PID, batch.pid, os.WEXITED | os.WNOWAIT)  # leaves its counts readable
    fields = pathlib.Path(f"/proc/{batch.pid}/stat").read_text().rsplit(")", 1)[1].split()
    status = batch.wait()
    if status > 1:  # 1: a check fails, as it does where a flight is cut short
        raise SystemExit(f"{' '.join(map(str, command))}: exit status {status}")
    hertz = os.sysconf("SC_CLK_TCK")
    return (int(fields[11]) + int(fields[12])) / hertz, (int(fields[13]) + int(fields[14])) / hertz


class Shares:
    """Wall times of turns, and how much of the machine others had meanwhile."""

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


def run(root, hedgehop):
    out = root / "out" / "bench" / "batch"
    loop = loop_program(out)
    counts = []

    def batch(workers):
        command = [hedgehop, "batch", root / "configs/garratt2009_city_0_light.yaml", "--seeds", f"1:{FLIGHTS}", "--set",
                   "duration=10", "-j", str(workers), "--out", out / "flights"]
        counts.append(own_and_flights_s(command))
        shutil.rmtree(out / "flights")

    shares = Shares()
    for _ in range(ROUNDS):
        shares.take("batch 1", lambda: batch(1))
        shares.take("loop 1", lambda: subprocess.run(loop, check=True))
        shares.take("batch 2", lambda: batch(2))
        shares.take("loop 2", lambda: both(loop))
    gain, floor = shares.median("batch 1") / shares.median("batch 2"), 2.0 * shares.median("loop 1") / shares.median("loop 2")
    own = statistics.median(own / flights for own, flights in counts)
    print(f"\n{FLIGHTS} flights of 10 s, medians of {ROUNDS} turns; others took {statistics.median(shares.others):.0%} of the "
          f"machine, {max(shares.others):.0%} at most")
    print(f"{'figure':52} {'here':>10} {'floor':>10} {'ratio':>7}")
    print(f"{'flights per hour, 2 workers over 1':52} {gain:10.2f} {floor:10.2f} {gain / floor:7.2f}")
    print(f"{'own processor time over the flights':52} {own:10.2%} {0:10.0%} {'-':>7}", flush=True)
