"""The sweeps of both laws over Garratt and Cheung's city: the table of docs/published-laws.md, and its figure."""

import collections
import csv

SWEEPS = ("published", "modified", "control")
HEADINGS_DEG = (0.0, 22.5, 45.0)
CELL_W, CELL_H, GAP, LEFT, TOP = 62, 40, 26, 172, 46  # px; LEFT and TOP leave room for labels
BLUES = ("#f3f7fb", "#d3e3f1", "#a9cbe4", "#74abd3", "#3f86bd", "#14538c")  # from 0 to all flights


def cells_of(folder):
    """{(heading, pitch, width): flights of one sweep}; empty if a flight is missing or faulty."""
    table = folder / "sweep.csv"
    rows = list(csv.DictReader(table.read_text().splitlines())) if table.exists() else []
    cells = collections.defaultdict(list)
    for row in rows:
        if row["status"] != "flown" or row["outcome"] == "fault":
            return {}
        cells[tuple(float(row.get(name, 0.0)) for name in ("start.heading", "scene.pitch", "scene.street_min_width"))].append(row)
    return dict(cells)


def counts(rows):
    """(flights, goal reached, center met a wall, hull met a wall)"""
    return (len(rows), sum(row["outcome"] == "reached" for row in rows),
            *(sum(float(row[f"metric.{part}_collision"]) > 0 for row in rows) for part in ("center", "hull")))


def all_sweeps(out):
    """{law: cells} of the sweeps, or {} if one is incomplete."""
    sweeps = {law: cells_of(out / f"city_{law}") for law in SWEEPS}
    return sweeps if all(sweeps.values()) else {}


def origin(sweeps):
    """The line above the table."""
    rows = [row for law in SWEEPS for flown in sweeps[law].values() for row in flown]
    builds, renderers = (", ".join(f"`{value}`" for value in sorted({row[name] for row in rows})) for name in ("build", "renderer"))
    seeds = sorted({int(row["seed"]) for row in rows})
    return (f"Renderer {renderers}, seeds {seeds[0]} to {seeds[-1]}, build {builds}, {len(seeds)} flights per cell. "
            "Each cell: flights that reach the goal (center meets a wall, hull meets a wall).\n\n")


def lines_of(sweeps, columns):
    """Lines of a table: a cell of the city per row, a law and heading per column; then the totals."""
    places = sorted({key[1:] for key in sweeps[columns[0][0]]})
    lines = ["| pitch, m | minimum street width, m | " + " | ".join(f"{law}, {heading:g} degrees" for law, heading in columns) + " |",
             "|---|---|" + "---|" * len(columns)]
    totals = [[0] * 4 for _ in columns]
    for pitch, width in places:
        found = [counts(sweeps[law][heading, pitch, width]) for law, heading in columns]
        totals = [[a + b for a, b in zip(*pair)] for pair in zip(totals, found)]
        lines.append(f"| {pitch:g} | {width:g} | " + " | ".join(f"{reached} ({center}, {hull})" for _, reached, center, hull in found) + " |")
    lines.append("| all | all | " + " | ".join(f"{reached} of {flown} ({center}, {hull})" for flown, reached, center, hull in totals) + " |")
    return "\n".join(lines)


def table(sweeps):
    """Goals reached and contacts per cell of the city: both laws and the control."""
    laws = [(law, heading) for law in ("published", "modified") for heading in HEADINGS_DEG] + [("control", 0.0)]
    return origin(sweeps) + lines_of(sweeps, laws)


def panel(cells, heading, x, y):
    """SVG of one law at one heading: pitch to the right, width upwards."""
    pitches, widths = (sorted({key[i] for key in cells}) for i in (1, 2))
    parts = []
    for column, pitch in enumerate(pitches):
        for row, width in enumerate(reversed(widths)):
            flown, reached, _, _ = counts(cells[heading, pitch, width])
            shade = round(reached / flown * (len(BLUES) - 1))
            left, top = x + column * CELL_W, y + row * CELL_H
            parts.append(f'<rect x="{left}" y="{top}" width="{CELL_W}" height="{CELL_H}" fill="{BLUES[shade]}" stroke="#fff"/>'
                         f'<text x="{left + CELL_W / 2}" y="{top + CELL_H / 2 + 4}" fill="{"#fff" if shade > 3 else "#1b2a38"}" '
                         f'text-anchor="middle">{reached} of {flown}</text>')
    parts += [f'<text x="{x + (column + 0.5) * CELL_W}" y="{y + len(widths) * CELL_H + 15}" text-anchor="middle">{pitch:g}</text>'
              for column, pitch in enumerate(pitches)]
    if heading == HEADINGS_DEG[0]:
        parts += [f'<text x="{x - 8}" y="{y + (row + 0.5) * CELL_H + 4}" text-anchor="end">{width:g}</text>'
                  for row, width in enumerate(reversed(widths))]
    return "".join(parts)


def figure(sweeps):
    """SVG: flights that reach the goal, a row of panels per law, a column per heading."""
    panel_w, panel_h = 3 * CELL_W, 3 * CELL_H
    width, height = LEFT + 3 * (panel_w + GAP), TOP + 2 * (panel_h + GAP + 14) + 22
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
             'font-family="sans-serif" font-size="12" fill="#1b2a38">', '<rect width="100%" height="100%" fill="#fff"/>']
    for column, heading in enumerate(HEADINGS_DEG):
        x = LEFT + column * (panel_w + GAP)
        parts.append(f'<text x="{x + panel_w / 2}" y="{TOP - 12}" text-anchor="middle" font-weight="bold">heading {heading:g} degrees</text>')
        for row, law in enumerate(("published", "modified")):
            parts.append(panel(sweeps[law], heading, x, TOP + row * (panel_h + GAP + 14)))
        parts.append(f'<text x="{x + panel_w / 2}" y="{height - 10}" text-anchor="middle">grid pitch, m</text>')
    for row, law in enumerate(("published", "modified")):
        middle = TOP + row * (panel_h + GAP + 14) + panel_h / 2
        parts.append(f'<text x="12" y="{middle}" font-weight="bold">{law} law</text>'
                     f'<text transform="translate({LEFT - 34} {middle}) rotate(-90)" text-anchor="middle">minimum street width, m</text>')
    return "\n".join(parts) + "\n</svg>\n"
