"""Tables that scripts write into pages, between <!-- KIND: NAME --> and <!-- end -->; and the intervals of their shares."""

import math
import pathlib
import re
import sys

END = "<!-- end -->"


def wilson(count, total, z=1.959964):
    """Bounds (low, high) of a share at 95 % [Wilson1927] p. 212, per cent. total  > 0."""
    center = (count / total + z * z / (2 * total)) / (1 + z * z / total)
    half = z * math.sqrt(count / total * (1 - count / total) / total + z * z / (4 * total * total)) / (1 + z * z / total)
    return 100 * (center - half), 100 * (center + half)


def with_table(text, page, kind, name, table):
    """Returns a page's text with one table replaced.

    page  its path below the root, for the message. The program ends with one line if the table's markers are not there once,
    the end after the beginning and before the next table.
    """
    begin = f"<!-- {kind}: {name} -->\n"
    head, _, tail = text.partition(begin)
    old, end, rest = tail.partition(END)
    if text.count(begin) != 1 or not end or re.search(r"<!-- \w+: ", old):
        raise SystemExit(f"scripts/{pathlib.Path(sys.argv[0]).name}: {page} must contain '{begin.strip()}' exactly once, followed by '{END}'")
    return f"{head}{begin}{table}\n{END}{rest}"
