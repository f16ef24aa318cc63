"""Whether a level flight through boxes and cylinders can keep a distance, by brute force on a grid."""

import collections
import math

CELLS_M = (0.25, 0.1)  # the finer one only if the coarser one shows no way
BESIDE_M = 30.0  # searched space around the points of a mission


def axes_of(row):
    """Unit vectors along x, y and z of an obstacle, as (north, east, down)."""
    w, x, y, z = (float(row[key]) for key in ("qw", "qx", "qy", "qz"))
    return ((1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)),
            (2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)),
            (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)))


def distance_m(shape, half, x, y, z):
    """From a position in the axes of a box, or of a cylinder along z, to its surface; 0 inside."""
    if shape == "cylinder":
        return math.hypot(max(0.0, math.hypot(x, y) - half[0]), max(0.0, abs(z) - half[2]))
    return math.hypot(max(0.0, abs(x) - half[0]), max(0.0, abs(y) - half[1]), max(0.0, abs(z) - half[2]))


def blocked_cells(rows, low, size, cell, altitude, distance):
    """Cells that have a point closer than the distance to an obstacle."""
    reach = distance + cell * math.sqrt(0.5)
    blocked = set()
    for row in rows:
        axes, half = axes_of(row), [0.5 * float(row[f"size_{axis}_m"]) for axis in "xyz"]
        center = [float(row[key]) for key in ("north_m", "east_m", "down_m")]
        spans = []
        for k in range(2):
            wide = sum(abs(axis[k]) * extent for axis, extent in zip(axes, half)) + reach
            first, last = (math.floor((center[k] + side * wide - low[k]) / cell) for side in (-1, 1))
            spans.append(range(max(0, first), min(size[k], last + 1)))
        for i in spans[0]:
            for j in spans[1]:
                off = (low[0] + (i + 0.5) * cell - center[0], low[1] + (j + 0.5) * cell - center[1], -altitude - center[2])
                if distance_m(row["shape"], half, *(sum(a * b for a, b in zip(axis, off)) for axis in axes)) < reach:
                    blocked.add((i, j))
    return blocked


def has_way(rows, points, altitude, radius, distance):
    """Whether a way through points, in their order, keeps the distance from all obstacles.

    rows  obstacles as `hedgehop import --solids` writes them. points  (north, east), m. altitude  of the flight, m.
    radius  within which a point after the first one counts as reached, m. distance  from the vehicle's center, m.
    True is certain. False may be an error if the way is less than 0.3 m wider than twice the distance.
    """
    return any(has_way_on_grid(rows, points, cell, altitude, radius, distance) for cell in CELLS_M)


def has_way_on_grid(rows, points, cell, altitude, radius, distance):
    """The same on one grid with a spacing of cell, m: a flood from point to point through cells that are not blocked."""
    low = [min(point[axis] for point in points) - BESIDE_M for axis in range(2)]
    size = [math.ceil((max(point[axis] for point in points) + BESIDE_M - low[axis]) / cell) for axis in range(2)]
    blocked = blocked_cells(rows, low, size, cell, altitude, distance)
    cells = [tuple(math.floor((point[axis] - low[axis]) / cell) for axis in range(2)) for point in points]
    found = {cells[0]} - blocked
    for point in points[1:]:
        open_cells = collections.deque(found)
        while open_cells:
            i, j = open_cells.popleft()
            for step in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)):
                if step not in found and step not in blocked and 0 <= step[0] < size[0] and 0 <= step[1] < size[1]:
                    found.add(step)
                    open_cells.append(step)
        found = {(i, j) for i, j in found
                 if math.hypot(low[0] + (i + 0.5) * cell - point[0], low[1] + (j + 0.5) * cell - point[1]) <= radius}
    return bool(found)
