"""Rendering times measured by render_bench: one table with all renderers, each row next to its floor.

Times are CPU times of one thread, ms per image. The ratio is that of the renderers' times. A goal applies to the ratio, or to
the value of the tiles renderer in the row's unit.
"""

import json
import subprocess

HEADS = ("scene", "unit", "floor", "OSMesa", "tiles", "OSMesa / tiles", "goal")
FORMATS = {"ms": "{:.3f}", "1/s": "{:,.0f}", "x": "{:.2f}", "levels": "{:.3f}", "share": "{:.6f}", "MiB": "{:.0f}"}
LINE = "{:54} {:>6} {:>9} {:>9} {:>9} {:>14}  {}"


def rows(program, quick):
    """The rows of the program, each as soon as it is measured."""
    with subprocess.Popen([program] + ["--quick"] * quick, stdout=subprocess.PIPE, text=True) as running:
        for line in running.stdout:
            yield json.loads(line)
    if running.returncode != 0:
        raise subprocess.CalledProcessError(running.returncode, program)


def goal_text(row):
    goal = row["goal"]
    if not goal:
        return ""
    sign, bound = (">=", goal["at_least"]) if "at_least" in goal else ("<=", goal["at_most"])
    missed = "" if row["met"] else "   MISSED"
    return f"{'tiles ' if goal['of'] == 'tiles' else ''}{sign} {bound:,g}{missed}"


def print_table(program, quick):
    print("\n" + LINE.format(*HEADS))
    for row in rows(program, quick):
        figures = [FORMATS[row["unit"]].format(row[key]) if row[key] is not None else "-" for key in ("floor", "osmesa", "tiles")]
        ratio = f"{row['ratio']:.2f}" if row["ratio"] is not None else "-"
        print(LINE.format(row["scene"], row["unit"], *figures, ratio, goal_text(row)).rstrip(), flush=True)
