"""Rules about text and names: citations, constants, frames, words."""

import re

from tree import CODE, Fault, below, files, line_of, read

# A citation names its place in the source: [Garratt2009] eq. (4), sec. 3.1, fig. 4, p. 12; where nothing is numbered,
# sec. "A title", sec. on a subject, table of a subject. Mere credit for an idea goes without: after [Srinivasan1994].
CITATION = re.compile(r"\[([A-Z][A-Za-z]*[0-9]{4}[A-Za-z]?)\]")
KIND = r"(?:eqs?\.|secs?\.|figs?\.|tables?|ch\.|app\.|pp?\.|alg\.|par\.)"
BREAK = r"(?:\s|//+<?|#)*"
PLACE = re.compile(BREAK + KIND + BREAK + r'(?:\(?[0-9A-Z]|"|o[nf]\b)')

# Numbered places of one citation: "eq. (4)", "fig. 4.4 and fig. 4.5", "eq. (12) to (14) and table 1".
NUMBER = r"\(?(\d+(?:\.\d+)?)\)?"
JOIN = BREAK + r"(?:,|and|to|-)" + BREAK
NUMBERED = re.compile(rf"{BREAK}({KIND}){BREAK}((?:{NUMBER})(?:{JOIN}{NUMBER})*)(?:{JOIN}(?={KIND}))?")
COUNTED = {"eq": "equations", "fig": "figures", "table": "tables"}

# Names with frames: p_WB, v_WB_B, X_WC_next, draw_p_WB. Two letters at most before the second underscore.
FRAMED = re.compile(r"(?<![A-Za-z0-9.\"])(?:[a-z]+_)*([pRXvwq])_((?:[A-Z][a-z]*){1,2})(?:_([A-Z][a-z]*))?(?=_[a-z]|(?![A-Za-z0-9_]))")
STRING = re.compile(r'"(?:[^"\\\n]|\\.)*"')

BAD_CONSTANT = re.compile(r"(?<![A-Za-z0-9_])k[A-Z][A-Za-z0-9]*_\w+")

# Words that the field does not use, and what to write instead.
WORDS = {
    r"pictures?": "image, or frame when it has a time",
    r"anew": "again, re-simulate or regenerate",
    r"nearness": "inverse range or inverse depth",
    r"astray": "outlier",
    r"h[au]ngs? on": "depends on",
    r"of no use": "ineffective",
    r"believe[sd]?": "estimate, or 1-sigma uncertainty",
    r"spoil(?:s|ed|t)?": "apply a frame fault",
}
WORD = re.compile(rf"(?<![A-Za-z])(?:{'|'.join(WORDS)})(?![A-Za-z])", re.I)


def number_table(references):
    """{key: {"equations": highest numbers, ...}} of the table in REFERENCES.md; numbers as tuples, (4,) or (4, 24)."""
    table = {}
    for row in re.findall(r"^\| *([A-Za-z]+\d{4}) *\|([^|]*)\|([^|]*)\|([^|]*)\|", references, re.M):
        highest = [[tuple(int(part) for part in number.split(".")) for number in re.findall(r"[\d.]+", cell)] for cell in row[1:]]
        table[row[0]] = dict(zip(COUNTED.values(), highest))
    return table


def exists(number, highest):
    """Whether a paper has this number: 3 of "7"; 4.5 where "4.24" is the highest of chapter 4."""
    wanted = tuple(int(part) for part in number.split("."))
    return wanted[-1] > 0 and any(wanted[:-1] == last[:-1] and wanted[-1] <= last[-1] for last in highest)


def false_numbers(text, place, counts):
    """The equations, figures and tables cited from `place` on that the paper does not have."""
    found = NUMBERED.match(text, place)
    while found:
        kind = COUNTED.get(found.group(1).rstrip("s."), COUNTED.get(found.group(1).rstrip(".")))
        for number in re.findall(r"\d+(?:\.\d+)?", found.group(2)):
            if kind and not exists(number, counts[kind]):
                yield f"{found.group(1)} {number}", kind, ", ".join(".".join(map(str, n)) for n in counts[kind]) or "none"
        found = NUMBERED.match(text, found.end())


def check_citations(root):
    """Every [Key] is listed in REFERENCES.md and names its place; the paper has that equation, figure or table."""
    faults = []
    references = read(root, "REFERENCES.md")
    keys = re.findall(r"^\W*\[([A-Za-z0-9]+)\]", references, re.M)
    counts = number_table(references)
    for key in sorted({k for k in keys if keys.count(k) > 1}):
        faults.append(Fault("REFERENCES.md", 1, f"[{key}] is listed twice"))
    for path in files(root, CODE | {".yaml", ".cmake", ".md", "CMakeLists.txt"}):
        if str(path) == "REFERENCES.md":
            continue
        text = read(root, path)
        for citation in CITATION.finditer(text):
            line = line_of(text, citation.start())
            if citation.group(1) not in keys:
                faults.append(Fault(path, line, f"{citation.group()} is not in REFERENCES.md"))
            elif (path.suffix != ".md" and not PLACE.match(text, citation.end())
                  and not text[: citation.start()].endswith(" after ")):
                faults.append(Fault(path, line, f"{citation.group()} needs its place: eq., sec., fig., table ..."))
            elif citation.group(1) in counts:
                for place, kind, highest in false_numbers(text, citation.end(), counts[citation.group(1)]):
                    faults.append(Fault(path, line, f"{citation.group()} has no {place}; its highest of {kind}: {highest}"))
    return faults


def check_constants(root):
    """A constant is kNameUnit, such as kGravityMps2: nothing follows an underscore."""
    return [Fault(path, number, f"{name} is no name of a constant; write it as kGravityMps2, without underscore")
            for path in files(root, CODE) for number, line in enumerate(read(root, path).splitlines(), 1)
            for name in BAD_CONSTANT.findall(STRING.sub('""', line))]


def declared_frames(root):
    """{name: (is a point, folders it is restricted to)} from the table of frames in CONTRIBUTING.md."""
    section = re.search(r"^## Frames$(.*?)(?=^## |\Z)", read(root, "CONTRIBUTING.md"), re.M | re.S)
    rows = re.findall(r"^\| *`([A-Za-z]+)` *\| *(frame|point) *\|[^|]*\|([^|]*)\|", section.group(1) if section else "", re.M)
    return {name: (kind == "point", re.findall(r"`([^`]+)`", where)) for name, kind, where in rows}


def frames_of(name, first, last, declared):
    """The frames and points in a name: NE and Cr are single ones where they are declared so."""
    parts = [first] if first in declared else re.findall(r"[A-Z][a-z]*", first)
    return parts + ([last] if last else [])


def check_frames(root):
    """The letters in names such as p_WB, v_WB_B and X_WC are declared in CONTRIBUTING.md, each with one meaning."""
    declared = declared_frames(root)
    faults = []
    for path in files(root, CODE):
        seen = set()
        for number, line in enumerate(read(root, path).splitlines(), 1):
            for found in FRAMED.finditer(STRING.sub('""', line)):
                prefix, first, last = found.groups()
                for letter in frames_of(found.group(), first, last, declared):
                    if (found.group(), letter) in seen:
                        continue
                    seen.add((found.group(), letter))
                    point, where = declared.get(letter, (False, []))
                    if letter not in declared:
                        faults.append(Fault(path, number, f"{found.group()}: frame {letter} is not declared in CONTRIBUTING.md"))
                    elif where and not any(below(path, folder) for folder in where):
                        faults.append(Fault(path, number, f"{found.group()}: {letter} has its meaning only in {', '.join(where)}"))
                    elif point and prefix not in "pv":
                        faults.append(Fault(path, number, f"{found.group()}: {letter} is a point and has no axes"))
    return faults


def check_paths(root):
    """Files and folders that documents name in backticks exist."""
    faults = []
    for path in files(root, {".md"}):
        text = read(root, path)
        for named in re.finditer(r"`((?:scenes|dynamics|vision|avoidance|sim|configs|scripts|tests|docs|cmake)/[\w./{},*-]+)`", text):
            stem, _, ends = named.group(1).partition("{")
            names = [stem + end for end in ends.rstrip("}").split(",")] if ends else [stem]
            faults += [Fault(path, line_of(text, named.start()), f"`{name}` does not exist")
                       for name in names if not any(root.glob(name.rstrip("/")))]
    return faults


def check_words(root):
    """Text and names use the field's words: image, again, depends on, estimate ..."""
    faults = []
    for path in files(root, CODE | {".md", ".yaml", ".js", ".html"}):
        text = read(root, path)
        for found in WORD.finditer(text):
            better = next(good for bad, good in WORDS.items() if re.fullmatch(bad, found.group(), re.I))
            faults.append(Fault(path, line_of(text, found.start()), f'"{found.group()}": write {better}'))
    return faults


GENERATED_PAGES = {"docs/results.md", "docs/results-0.3.md"}
GENERATED_TABLE = re.compile(r"^<!-- figures: \w+ -->$.*?^<!-- end -->$", re.M | re.S)
BUILD_HASH = re.compile(r"(?<![0-9A-Za-z])(?=[0-9]*[a-f])[0-9a-f]{16}(?![0-9A-Za-z])")


def check_hashes(root):
    """Pages name releases: build hashes occur in generated tables only."""
    faults = []
    for path in files(root, {".md"}):
        if str(path) in GENERATED_PAGES:
            continue
        text = GENERATED_TABLE.sub(lambda table: "\n" * table.group().count("\n"), read(root, path))
        faults += [Fault(path, line_of(text, found.start()), f"build hash {found.group()}: name a release or 'an earlier build'")
                   for found in BUILD_HASH.finditer(text)]
    return faults
