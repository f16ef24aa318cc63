"""The reader of PX4's ULog files for scripts/convert-log and scripts/validation."""

import re
import struct

FORMATS = {"int8_t": "b", "uint8_t": "B", "int16_t": "h", "uint16_t": "H", "int32_t": "i", "uint32_t": "I",
           "int64_t": "q", "uint64_t": "Q", "float": "f", "double": "d", "bool": "?", "char": "c"}
MAX_NESTING = 16
MAX_FIELDS = 65535  # a message has no more bytes


class Unreadable(Exception):
    """A file of another kind than its name; the text is one line."""


class ULog:
    """The topics of a ULog file, {topic: {field: values}}, with `timestamp` in microseconds.

    Source: PX4's description of the format, https://docs.px4.io/main/en/dev_log/ulog_file_format.html. Several instances
    of a topic are TOPIC, TOPIC.1, TOPIC.2. Parts that a crash left incomplete are left out.
    """

    def __init__(self, data):
        if data[:7] != b"ULog\x01\x12\x35":
            raise Unreadable("is no ULog file")
        self.formats, self.topics, self._layouts, self._names = {}, {}, {}, {}
        self._appended = []
        begin = self._read(data, 16, len(data), only_first=True)
        ends = sorted(offset for offset in self._appended if begin <= offset <= len(data)) + [len(data)]
        for end in ends:
            self._read(data, begin, end)
            begin = end

    def _read(self, data, at, end, only_first=False):
        while at + 3 <= end:
            size, kind = struct.unpack_from("<HB", data, at)
            if at + 3 + size > end:
                break
            body = data[at + 3:at + 3 + size]
            if only_first and kind != ord("B"):
                return at
            if kind == ord("B"):
                self._flags(body)
            elif kind == ord("F"):
                name, _, fields = body.decode("utf-8", "replace").partition(":")
                self.formats[name] = [tuple(field.split(" ", 1)) for field in fields.split(";") if " " in field]
            elif kind == ord("A") and size > 3:
                self._subscribe(body)
            elif kind == ord("D") and size > 2:
                self._data(body)
            at += 3 + size
            if only_first:
                return at
        return at

    def _flags(self, body):
        if len(body) < 40:
            raise Unreadable("has flag bits of the wrong size")
        if body[8] & ~1 or any(body[9:16]):
            raise Unreadable("has parts of an unknown kind (incompatible flag bits)")
        if body[8] & 1:
            self._appended = [offset for offset in struct.unpack_from("<3Q", body, 16) if offset]

    def _fields(self, name, outer=()):
        """[(field, format character)], nested types flattened. outer  the types that contain this one."""
        if name in outer or len(outer) > MAX_NESTING:
            raise Unreadable(f"has a format that contains itself, or is nested more than {MAX_NESTING} times: '{name}'")
        flat = []
        for kind, field in self.formats.get(name, []):
            parts = re.fullmatch(r"([^[]+)(?:\[(\d{1,5})\])?", kind)
            if not parts:
                raise Unreadable(f"has a format with the unknown type '{kind}'")
            base, count = parts[1], int(parts[2] or 1)
            inner = [("", FORMATS[base])] if base in FORMATS else [(f".{label}", code) for label, code in self._fields(base, (*outer, name))]
            if not inner:
                raise Unreadable(f"has a format with the unknown type '{base}'")
            if len(flat) + count * len(inner) > MAX_FIELDS:
                raise Unreadable(f"has a format of more than {MAX_FIELDS} fields: '{name}'")
            for i in range(count):
                label = f"{field}[{i}]" if count > 1 else field
                flat += [(label + suffix, code) for suffix, code in inner]
        return flat

    def _subscribe(self, body):
        instance, number = struct.unpack_from("<BH", body)
        name = body[3:].decode("utf-8", "replace")
        fields = self._fields(name)
        while fields and "_padding" in fields[-1][0]:
            fields.pop()  # padding at the end is not logged
        self._names[number] = name if instance == 0 else f"{name}.{instance}"
        self._layouts[number] = (fields, struct.Struct("<" + "".join(code for _, code in fields)))
        self.topics.setdefault(self._names[number], {label: [] for label, code in fields if code != "c" and "_padding" not in label})

    def _data(self, body):
        number, = struct.unpack_from("<H", body)
        if number not in self._layouts:
            return
        fields, layout = self._layouts[number]
        if len(body) - 2 < layout.size:
            return
        topic = self.topics[self._names[number]]
        for (label, _), value in zip(fields, layout.unpack_from(body, 2)):
            if label in topic:
                topic[label].append(float(value))
