"""Batches and sweeps. Each flight has its own process."""

import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import warnings

from ._native import InputError
from .results import load
from .simulation import overrides

# As in "3/10, 1 failed: city_seed3 reached; about 20 s left".
_PROGRESS = re.compile(r"\d+/\d+[:, ]|checking \d+ points before the flights")

_WARNING = "warning: "


def program():
    """Returns the path of the program `hedgehop`: that of this wheel, build folder or installation, else that in PATH."""
    package = pathlib.Path(__file__).resolve().parent
    for candidate in (package / "bin/hedgehop", package / "../../sim/cli/hedgehop", package / "../../../../bin/hedgehop"):
        if candidate.exists():
            return str(candidate.resolve())
    found = shutil.which("hedgehop")
    if not found:
        raise FileNotFoundError("the program hedgehop is neither next to this package nor in PATH")
    return found


def main():
    """Runs the program, for wheels."""
    os.execv(program(), ["hedgehop", *sys.argv[1:]])


def _show(line):
    """Shows a line of progress; on a terminal it replaces the line before."""
    if sys.stderr.isatty():
        sys.stderr.write("\r\033[K" + line[: shutil.get_terminal_size().columns - 1])
    else:
        sys.stderr.write(line + "\n")
    sys.stderr.flush()


def _fly(command, progress):
    """Runs the program. Ctrl-C stops it; completed flights are kept, and `resume` continues."""
    lines = []
    with subprocess.Popen([program(), *command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                          encoding="utf-8", errors="replace", start_new_session=True) as running:
        try:
            for line in running.stderr:
                lines.append(line.rstrip("\n"))
                if progress and _PROGRESS.match(line):
                    _show(lines[-1])
            running.wait()
        except KeyboardInterrupt:
            running.send_signal(signal.SIGINT)
            running.wait()
            raise
        finally:
            if progress and sys.stderr.isatty() and any(map(_PROGRESS.match, lines)):
                sys.stderr.write("\n")
    errors = "\n".join(line for line in lines if not _PROGRESS.match(line)).strip()
    if running.returncode == 2:
        raise InputError(errors)
    if running.returncode not in (0, 1):
        raise RuntimeError(errors or f"hedgehop ended with status {running.returncode}")
    for line in lines:
        if line.strip() and not _PROGRESS.match(line):
            warnings.warn(line.removeprefix(_WARNING), stacklevel=3)


def batch(files, out, *, seeds=None, set=None, jobs=None, resume=False, progress=True):
    """Flies scenarios or campaigns. Returns a record array with one record per flight.

    files   a file or a list of files.
    seeds   such as "1:10" or [1, 2, 3].
    set     values by key path.
    jobs    number of parallel flights; default: the cores that this process may use.
    resume  whether to reuse results in `out` of the same scenario and build.
    progress  whether to show on standard error how many flights have ended, and the remaining time.
    """
    files = [files] if isinstance(files, (str, os.PathLike)) else files
    command = ["batch", *(os.fspath(file) for file in files), "--out", os.fspath(out)]
    if seeds is not None:
        command += ["--seeds", seeds if isinstance(seeds, str) else ",".join(str(seed) for seed in seeds)]
    for text in overrides(set):
        command += ["--set", text]
    if jobs is not None:
        command += ["--jobs", str(jobs)]
    if resume:
        command.append("--resume")
    _fly(command, progress)
    return load(out)


def sweep(file, out, *, jobs=None, progress=True):
    """Flies a sweep and reuses its completed flights. Returns a record array with one record per flight.
    progress  as in batch().
    """
    command = ["sweep", os.fspath(file), "--out", os.fspath(out)]
    if jobs is not None:
        command += ["--jobs", str(jobs)]
    _fly(command, progress)
    return load(out)
