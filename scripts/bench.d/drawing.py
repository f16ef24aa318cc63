"""What drawing costs, as render_bench measures it: one table, contexts side by side, each row beside its floor.

Times are those of one thread's CPU, ms an image; a ratio is that of the contexts' times. A goal is asked of the ratio, or
of what tiles has in the row's unit.
"""

import json
import subprocess

HEADS = ("drawing", "unit", "floor", "OSMesa", "tiles", "OSMesa / tiles", "goal")
FORMATS = {"ms": "{:.3f}", "1/s": "{:,.0f}", "x": "{:.2f}", "levels": "{:.3f}", "share": "{:.6f}", "MiB": "{:.0f}"}
LINE = "{:54} {:>6} {:>9} {:>9} {:>9} {:>14}  {}"


def rows(program, quick):
    """The program's rows, each as soon as it is measured."""
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
        print(LINE.format(row["what"], row["unit"], *figures, ratio, goal_text(row)).rstrip(), flush=True)
