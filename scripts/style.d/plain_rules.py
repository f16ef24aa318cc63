"""Plain technical English: patterns that must not occur in prose, and the length of sentences in pages."""

import fnmatch
import pathlib
import re

import prose
from tree import Fault, files, read

PLACES = (r"place|point|region|area|position|pixel|cell|location|line|column|folder|directory|file|page|table|section|frame|axis|world|"
          r"map|scene|image|side|corner|edge|row|step|equation|voxel|surface|ground|wall|path|interval|range|host|machine|system|"
          r"case|level|height|altitude|distance|direction|instant|moment|tick|node|field|spot|plane|band|window|plot|city|street|gap|"
          r"opening|obstacle|ray|layer|build|platform|cluster|network|branch|shader|texel|facet|tile|block|part|end|beginning|center")
PERSONS = (r"users?|authors?|engineers?|researchers?|readers?|persons?|people|contributors?|maintainers?|those|anyone|someone|developers?|"
           r"customers?|pilots?|designers?|newcomers?|everyone|students?|somebody|operators?|teams?|groups?")
ADVERBS = (r"recent|recently|likely|common|commonly|often|frequent|frequently|probable|probably|significant|specific|restrictive|"
           r"conservative|expensive|dangerous|important|general|relevant|critical|informative|sensitive|influential|accurate|"
           r"convenient|suitable|useful|severe|demanding|difficult|promising|negative|positive|similar|precise|robust|robustly")
UNIT = r"(?:\d[\d.,]*|[a-z]+s|px|Hz|m|rad|degrees|ms|kB|KB|MB|GB|times|once|twice|one|two|three|figure|image|flight)"

# name: (regular expression, replacement by words.md). A question may contain "what", "where" and "who".
PATTERNS = {
    "what": (r"\bwhat(?!-if)\b", "name the thing: a noun, or 'which', 'that'"),
    "where": (rf"(?<!\bto )(?<!\bfrom )(?<!\bof )(?<!\b(?:is|as) )\bwhere\b", "'if' for a condition; 'where' follows a place"),
    "nothing": (r"\b(?:nothing|none of|nowhere)\b", "no X"),
    "stands": (r"\b(?:stands|stood|standing)\b(?! (?:wave|for\b))", "is, remains, is located"),
    "beside": (r"\bbesides?\b", "next to, compared with"),
    "superlative": (rf"(?<!\bat )\bleast\b(?![- ]squares?)|\b(?:greatest|farthest|fewest)\b|"
                    rf"(?<!\bat )\bmost\b(?! of (?:the|these|those|its|them|a|their|our)\b)(?! (?:{ADVERBS})\b)(?<!the most)(?! [a-z]+s\b)|"
                    rf"\bthe most\b(?! (?:{ADVERBS})\b)", "minimum, maximum"),
    "per": (rf"(?<!^)\b(?!takes|lasts|needs|has|is|was|after|within|this|lies|makes|starts|adds|as|its){UNIT} (?:a|an) (?:second|pixel|row|minute|hour)\b"
            rf"(?! \w+(?:th|rd)\b)|\b(?:\d[\d.,]*|px|figure|images|decisions|flights) (?:a|an) (?:image|flight|frame|meter|degree|column|cell|seed)\b",
            "per second, per pixel, per row"),
    "asked": (r"\basked\b", "required, requested"),
    "late": (r"\b(?:is|are|be|was|were|ends?|comes?|came|arrives?|flights?|or|times?) late\b|^late\b", "timed out, times out"),
    "who": (r"\bwho(?:ever|m)?\b", "'which', 'that', or the program's name"),
    "by renderer": (r"\bby (?:images|day|tiles|osmesa|egl)\b", "with images, in daylight, with the tiles renderer"),
    "British": (r"\b(?:colou?rs?(?<=ou.)|colour\w*|centres?|centred|metres?|behaviours?|neighbours?\w*|licences?|analyse[sd]?|(?:initial|normal|optim|minim|maxim|"
                r"recogn|summar|organ|visual|linear|serial|synchron|stabil|general|quant|character|discret|parametr|local|real)is(?:e[sd]?|ing|ation)|"
                r"modell(?:ed|ing)|labell(?:ed|ing)|travell\w+|cancell(?:ed|ing)|favour\w*|artefacts?|programme|honour\w*|catalogue)\b", "American spelling"),
}
COMPILED = {name: re.compile(pattern, re.I | re.M) for name, (pattern, _) in PATTERNS.items()}
AFTER_PLACE = re.compile(rf"\b(?:{PLACES})(?:s|es)?,? where\b|, where (?:[a-zA-Z]|[A-Za-z]_?\w{{0,3}}|the \w+) (?:is|are|=)\b", re.I)
AFTER_PERSON = re.compile(rf"\b(?:{PERSONS}),? who\b", re.I)

LONGEST_SENTENCE_WORDS = 40
MEAN_SENTENCE_WORDS = 20
EXCEPTIONS = "scripts/style.d/plain_exceptions.txt"


def exceptions(root):
    """[(path pattern, phrase)] of the file of exceptions: `path | phrase | reason`, a line each."""
    path = pathlib.Path(EXCEPTIONS)
    rows = []
    if not (root / path).exists():
        return rows
    for number, line in enumerate(read(root, path).splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        parts = [part.strip() for part in line.split("|")]
        if len(parts) != 3 or not all(parts):
            raise SystemExit(f"{path}:{number}: an exception is `path | phrase | reason`")
        rows.append((parts[0], parts[1].lower()))
    return rows


def found_in(sentence):
    """Yields (pattern, offset, words around it) of one sentence."""
    sentence = sentence.replace("\n", " ")
    question = sentence.rstrip("\"')*").endswith("?")
    for name, pattern in COMPILED.items():
        if question and name in ("what", "where", "who"):
            continue
        for found in pattern.finditer(sentence):
            before = sentence[max(0, found.start() - 40): found.end() + 14]
            if name == "where" and any(hit.end() > min(40, found.start()) for hit in AFTER_PLACE.finditer(before)):
                continue
            if name == "who" and AFTER_PERSON.search(sentence[max(0, found.start() - 20): found.end()]):
                continue
            around = " ".join(sentence[max(0, found.start() - 30): found.end() + 30].split())
            yield name, found.start(), around


def pattern_faults(root):
    """[(pattern, fault)] of all prose."""
    allowed = exceptions(root)
    faults = []
    paths = [p for p in files(root, prose.PROSE_FILES) + scripts_without_suffix(root) if str(p) not in NOT_PROSE and not is_data(p)]
    for path in paths:
        phrases = [phrase for pattern, phrase in allowed if fnmatch.fnmatch(str(path), pattern)]
        for line, passage in prose.passages(path, read(root, path)):
            passage = re.sub(r"`[^`\n]*`|\{[^{}\n]*\}", "X", passage)  # code, and placeholders of a format string
            for offset, sentence in prose.sentences(passage):
                flat = " ".join(sentence.split()).lower()
                for name, place, around in found_in(sentence):
                    if any(phrase in flat for phrase in phrases):
                        continue
                    at = line + passage.count("\n", 0, offset + place)
                    faults.append((name, Fault(path, at, f"{name}: \"...{around}...\": write {PATTERNS[name][1]}")))
    return faults


NOT_PROSE = {"scripts/style.d/plain_rules.py", "scripts/style.d/text_rules.py", "tests/style/plain_words_test.py", "tests/style/style_rules_test.py", EXCEPTIONS, "LICENSE",
             "REFERENCES.md"}


def is_data(path):
    return str(path).startswith(("tests/fuzz/corpus/", "tests/vision/images/"))


def scripts_without_suffix(root):
    """Programs of scripts/ that are named without a suffix."""
    folder = root / "scripts"
    return sorted(p.relative_to(root) for p in folder.iterdir() if p.is_file() and not p.suffix) if folder.is_dir() else []


def length_faults(root):
    """Sentences of pages: no more than 40 words, a mean of at most 20."""
    faults = []
    for path in files(root, prose.PAGES):
        if str(path) in NOT_PROSE:
            continue
        lengths = []
        for line, passage in prose.passages(path, read(root, path)):
            for offset, sentence in prose.sentences(passage):
                words = len(sentence.split())
                lengths += [words] if words >= 4 else []
                if words > LONGEST_SENTENCE_WORDS:
                    at = line + passage.count("\n", 0, offset)
                    faults.append(Fault(path, at, f"a sentence of {words} words; at most {LONGEST_SENTENCE_WORDS}"))
        if lengths and sum(lengths) / len(lengths) > MEAN_SENTENCE_WORDS:
            faults.append(Fault(path, 1, f"sentences have {sum(lengths) / len(lengths):.1f} words in the mean; at most {MEAN_SENTENCE_WORDS}"))
    return faults


def check_plain(root):
    """Prose is plain technical English: none of the patterns of plain_rules.py, and short sentences in pages."""
    return [fault for _, fault in pattern_faults(root)] + length_faults(root)


def counts(root):
    """The table of counts, docs and code: one row per pattern."""
    rows = ["| pattern | docs | code |", "|---|---|---|"]
    faults = pattern_faults(root)
    for name in PATTERNS:
        docs = sum(1 for found, fault in faults if found == name and pathlib.Path(fault.path).suffix == ".md")
        code = sum(1 for found, fault in faults if found == name and pathlib.Path(fault.path).suffix != ".md")
        rows.append(f"| {name} | {docs} | {code} |")
    return "\n".join(rows)
