"""Files of OpenStreetMap for tests, in XML and in PBF, written without libraries that read them."""

import struct
import zlib
from xml.sax.saxutils import quoteattr

LATITUDE, LONGITUDE = 47.0, 8.0
NORTH_PER_DEG, EAST_PER_DEG = 111166.0, 76056.0  # near 47 N, for the layout only


class MapFile:
    """Objects from positions in the plan: north and east of the origin, m. Ids of nodes begin at 1, of ways at 101, of relations at 901."""

    def __init__(self):
        self.nodes, self.ways, self.relations = [], [], []

    def node(self, north, east, tags=()):
        return self.node_at(LATITUDE + north / NORTH_PER_DEG, LONGITUDE + east / EAST_PER_DEG, tags)

    def node_at(self, latitude, longitude, tags=()):
        """@param latitude, longitude  degrees; None: the node has no coordinates."""
        self.nodes.append((len(self.nodes) + 1, latitude, longitude, dict(tags)))
        return len(self.nodes)

    def way(self, nodes, tags=()):
        self.ways.append((len(self.ways) + 101, list(nodes), dict(tags)))
        return self.ways[-1][0]

    def outline(self, points, tags=()):
        nodes = [self.node(*point) for point in points]
        return self.way(nodes + nodes[:1], tags)

    def box(self, north, east, length, width, tags=()):
        corners = [(north, east), (north + length, east), (north + length, east + width), (north, east + width)]
        return self.outline(corners, {"building": "yes", **dict(tags)})

    def relation(self, members, tags=()):
        """@param members  id of a way and its role."""
        self.relations.append((len(self.relations) + 901, list(members), {"type": "multipolygon", **dict(tags)}))
        return self.relations[-1][0]

    def write(self, path):
        def tags(values):
            return "".join(f"<tag k={quoteattr(key)} v={quoteattr(str(value))}/>" for key, value in values.items())

        lines = ['<?xml version="1.0"?>', '<osm version="0.6">']
        for number, latitude, longitude, own in self.nodes:
            place = "" if latitude is None else f' lat="{latitude:.7f}" lon="{longitude:.7f}"'
            lines.append(f'<node id="{number}" version="1"{place}>{tags(own)}</node>')
        for number, nodes, own in self.ways:
            refs = "".join(f'<nd ref="{node}"/>' for node in nodes)
            lines.append(f'<way id="{number}" version="1">{refs}{tags(own)}</way>')
        for number, members, own in self.relations:
            refs = "".join(f'<member type="way" ref="{way}" role="{role}"/>' for way, role in members)
            lines.append(f'<relation id="{number}" version="1">{refs}{tags(own)}</relation>')
        path.write_text("\n".join(lines) + "\n</osm>\n", encoding="utf-8")

    def write_pbf(self, path):
        path.write_bytes(blob("OSMHeader", text(4, "OsmSchema-V0.6")) + blob("OSMData", PrimitiveBlock(self).encoded()))


# Protocol buffers: a number is 7 bits per byte from the lowest, signed ones alternate 0, -1, 1, -2, ...


def varint(value):
    value &= (1 << 64) - 1
    encoded = bytearray()
    while value > 0x7F:
        encoded.append(0x80 | value & 0x7F)
        value >>= 7
    return bytes(encoded) + bytes([value])


def zigzag(value):
    return varint(value << 1 ^ value >> 63)


def number(field, encoded):
    return varint(field << 3) + encoded


def data(field, content):
    return varint(field << 3 | 2) + varint(len(content)) + content


def text(field, content):
    return data(field, content.encode())


def packed(field, encoded):
    return data(field, b"".join(encoded))


def deltas(values):
    return [zigzag(value - before) for before, value in zip([0] + values, values)]


def blob(kind, content):
    body = number(2, varint(len(content))) + data(3, zlib.compress(content))
    header = text(1, kind) + number(3, varint(len(body)))
    return struct.pack(">I", len(header)) + header + body


class PrimitiveBlock:
    """All objects of a file in one block."""

    def __init__(self, file):
        self.file, self.strings = file, [""]

    def string(self, content):
        if content not in self.strings:
            self.strings.append(content)
        return varint(self.strings.index(content))

    def tags(self, tags):
        if not tags:
            return b""
        return packed(2, map(self.string, tags)) + packed(3, (self.string(str(value)) for value in tags.values()))

    def encoded(self):
        def units(degrees):
            return zigzag(round(degrees * 1e7))

        nodes = [number(1, zigzag(own)) + self.tags(tags) + number(8, units(latitude)) + number(9, units(longitude))
                 for own, latitude, longitude, tags in self.file.nodes]
        ways = [number(1, varint(own)) + self.tags(tags) + packed(8, deltas(refs)) for own, refs, tags in self.file.ways]
        relations = [number(1, varint(own)) + self.tags(tags) + packed(8, (self.string(role) for _, role in members)) +
                     packed(9, deltas([way for way, _ in members])) + packed(10, [varint(1)] * len(members))
                     for own, members, tags in self.file.relations]
        groups = [b"".join(data(field, item) for item in items) for field, items in ((1, nodes), (3, ways), (4, relations)) if items]
        strings = data(1, b"".join(text(1, content) for content in self.strings))
        return strings + b"".join(data(2, group) for group in groups)
