"""A synthetic town in the format of OpenStreetMap, for measurements: blocks of houses, streets and trees on a square.

usage: town.py FILE.osm [SIDE_M]   the side of the square, m, default 5000; the middle is 47 N, 8 E
"""

import math
import random
import sys

LATITUDE, LONGITUDE = 47.0, 8.0
SQUARE_ECCENTRICITY = 0.00669437999014
W2 = 1.0 - SQUARE_ECCENTRICITY * math.sin(math.radians(LATITUDE)) ** 2
NORTH_PER_DEG = math.radians(6378137.0 * (1.0 - SQUARE_ECCENTRICITY) / W2**1.5)
EAST_PER_DEG = math.radians(6378137.0 / math.sqrt(W2) * math.cos(math.radians(LATITUDE)))
BLOCK_M, LOT_M, STREET_M = 120.0, 24.0, 10.0


class Town:
    def __init__(self, seed):
        self.random, self.lines, self.ways, self.next_id = random.Random(seed), [], [], 1

    def tags(self, tags):
        return "".join(f'<tag k="{key}" v="{value}"/>' for key, value in tags.items())

    def node(self, north, east, tags=None):
        self.lines.append(f'<node id="{self.next_id}" version="1" lat="{LATITUDE + north / NORTH_PER_DEG:.7f}" '
                          f'lon="{LONGITUDE + east / EAST_PER_DEG:.7f}">{self.tags(tags or {})}</node>')
        self.next_id += 1
        return self.next_id - 1

    def way(self, points, tags, closed=False):
        nodes = [self.node(*point) for point in points]
        nodes += nodes[:1] * closed
        refs = "".join(f'<nd ref="{node}"/>' for node in nodes)
        self.ways.append(f'<way id="{len(self.ways) + 1}" version="1">{refs}{self.tags(tags)}</way>')

    def house(self, north, east):
        """A house turned by a few degrees; one of five is L-shaped."""
        length, width = self.random.uniform(9, 16), self.random.uniform(7, 11)
        turn = math.radians(self.random.uniform(-12, 12))
        corners = [(0, 0), (length, 0), (length, width), (0, width)]
        shape = self.random.choice(["flat", "gabled", "gabled", "hipped"])
        if self.random.random() < 0.2:
            corners = [(0, 0), (length, 0), (length, 0.5 * width), (0.5 * length, 0.5 * width), (0.5 * length, width), (0, width)]
            shape = "flat"
        outline = [(north + x * math.cos(turn) - y * math.sin(turn), east + x * math.sin(turn) + y * math.cos(turn))
                   for x, y in corners]
        self.way(outline, {"building": "yes", "building:levels": self.random.randint(1, 5), "roof:shape": shape}, closed=True)

    def build(self, side):
        blocks = int(side / BLOCK_M)
        low = -0.5 * blocks * BLOCK_M
        for k in range(blocks + 1):
            line = [low + i * BLOCK_M for i in range(blocks + 1)]
            self.way([(low + k * BLOCK_M, at) for at in line], {"highway": "residential", "width": STREET_M})
            self.way([(at, low + k * BLOCK_M) for at in line], {"highway": "residential", "width": STREET_M})
        lots = int((BLOCK_M - STREET_M) / LOT_M)
        for row in range(blocks):
            for column in range(blocks):
                north, east = low + row * BLOCK_M + STREET_M, low + column * BLOCK_M + STREET_M
                for i in range(lots):
                    for k in range(lots):
                        if 0 < i < lots - 1 and 0 < k < lots - 1:  # the middle of a block: gardens
                            self.node(north + (i + 0.5) * LOT_M, east + (k + 0.5) * LOT_M, {"natural": "tree"})
                        else:
                            self.house(north + i * LOT_M + 3, east + k * LOT_M + 3)


def main():
    town = Town(1)
    town.build(float(sys.argv[2]) if len(sys.argv) > 2 else 5000.0)
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write('<?xml version="1.0" encoding="UTF-8"?>\n<osm version="0.6">\n')
        file.writelines(f"{line}\n" for line in town.lines + town.ways)
        file.write("</osm>\n")


if __name__ == "__main__":
    main()
