"""CPU times of builds, wall times of the test suite, and the start of the program; not part of `scripts/bench` without a name,
because it builds everything from scratch (about half an hour on two cores).

The floor of a build is the compilation of one empty source with the project's precompiled header, times the number of
compilations. The floor of the program's start is /bin/true.
"""

import json
import resource
import shutil
import statistics
import subprocess
import time

RUNS = 5


def cpu_s():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def timed(command, **options):
    """Runs a command; returns its CPU and wall time, s."""
    cpu, begin = cpu_s(), time.monotonic()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, **options)
    return cpu_s() - cpu, time.monotonic() - begin


def row(name, value, unit, floor=None):
    print(f"{name:60} {value:10.3f} {unit:6} {'-' if floor is None else f'{floor:.3f}':>10}", flush=True)


def configure(root, folder, preset, *options):
    subprocess.run(["cmake", "-S", root, "-B", folder, "--preset", preset, "-DHEDGEHOP_BENCH=OFF",
                    "-DCMAKE_CXX_COMPILER_LAUNCHER=", *options], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=root)


def build(folder, *targets):
    return timed(["cmake", "--build", folder, *(["--target", *targets] if targets else [])])


def compilations(folder):
    return sum("-c" in entry["command"] for entry in json.loads((folder / "compile_commands.json").read_text()))


def empty_source_s(folder):
    """CPU time of the compilation of an empty source with the precompiled header of the libraries."""
    entry = next(entry for entry in json.loads((folder / "compile_commands.json").read_text()) if "dynamics/" in entry["file"])
    empty = folder / "empty.cpp"
    empty.write_text("int hedgehop_empty;\n")
    words = entry["command"].replace(entry["file"], str(empty)).split(" -o ")
    command = words[0] + " -o /dev/null " + words[1].partition(" ")[2]
    return statistics.median(timed(["sh", "-c", command], cwd=entry["directory"])[0] for _ in range(RUNS))


def rebuilt(folder, source, *targets):
    """Wall time of a build after a change of one file, s."""
    source.touch()
    return build(folder, *targets)[1]


def run(root, quick):
    out = root / "out" / "bench" / "builds"
    shutil.rmtree(out, ignore_errors=True)
    print(f"\n{'figure':60} {'here':>10} {'unit':6} {'floor':>10}")
    program = root / "build/release/sim/cli/hedgehop"
    starts = [timed([program, "--version"])[1] for _ in range(RUNS)]
    floors = [timed(["/bin/true"])[1] for _ in range(RUNS)]
    row("start of the program", statistics.median(starts), "s", statistics.median(floors))
    libraries = subprocess.run(["ldd", program], check=True, capture_output=True, text=True).stdout.count("=>")
    row("libraries that it loads", libraries, "")
    for label in ("unit", ""):
        command = ["ctest", "--test-dir", root / "build/release", "--parallel", "2", *(["-L", label] if label else [])]
        begin = time.monotonic()
        status = subprocess.run(command, stdout=subprocess.DEVNULL).returncode
        row(f"test suite{' -L ' + label if label else ''}{'' if status == 0 else ', with failures'}", time.monotonic() - begin, "s")
    if quick:
        return
    folder = out / "release"
    configure(root, folder, "release", "-DHEDGEHOP_TESTS=OFF")
    program_s = build(folder, "hedgehop")[0]
    empty_s = empty_source_s(folder)
    row("build of hedgehop from scratch", program_s, "CPU s", compilations(folder) * empty_s)
    module_s = rebuilt(folder, root / "avoidance/module.h", "hedgehop")
    row("rebuild after a change of avoidance/module.h", module_s, "s")
    configure(root, folder, "release", "-DHEDGEHOP_TESTS=ON")
    row("build of hedgehop and all tests from scratch", program_s + build(folder)[0], "CPU s", compilations(folder) * empty_s)
    debug = out / "debug"
    configure(root, debug, "debug", "-DHEDGEHOP_TESTS=OFF")
    build(debug, "hedgehop")
    row("rebuild after a change of one .cpp file, debug preset", rebuilt(debug, root / "sim/verdict/assessment.cpp", "hedgehop"), "s")
    shutil.rmtree(out)
