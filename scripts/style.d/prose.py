"""The prose of a file: pages without code, comments, string literals and test names, each passage with its line."""

import io
import re
import tokenize

from tree import CODE

PAGES = {".md"}
HASH_COMMENTS = {".yaml", ".yml", ".cmake", ".sh", ".txt", ".toml"}
PROSE_FILES = CODE | PAGES | HASH_COMMENTS | {".py", ".js", ".html", ".css", "CMakeLists.txt"}

# In a C++ or JavaScript source: comments, then literals. Raw strings and templates may span lines.
C_TOKENS = re.compile(
    r'//(?P<line>[^\n]*)|/\*(?P<block>.*?)\*/|R"(?P<mark>[^\s()\\]{0,16})\((?P<raw>.*?)\)(?P=mark)"'
    r'|"(?P<string>(?:[^"\\\n]|\\.)*)"|\'(?P<char>(?:[^\'\\\n]|\\.)*)\'|`(?P<template>(?:[^`\\]|\\.)*)`', re.S)
TEST_NAME = re.compile(r"^\s*(?:TYPED_)?TEST(?:_F|_P)?\(\s*\w+\s*,\s*(\w+)\s*\)", re.M)
PYTHON_TEST = re.compile(r"^\s*def test_(\w+)\(", re.M)


def line_of(text, place):
    return text.count("\n", 0, place) + 1


def join_neighbors(passages):
    """Joins comments of successive lines, and literals of successive lines, into one passage each."""
    joined = []
    for kind, line, end, text in passages:
        if joined and joined[-1][0] == kind and kind in ("comment", "string") and line <= joined[-1][2] + 1:
            last = joined[-1]
            joined[-1] = (kind, last[1], end, last[3] + "\n" * max(1, line - last[2]) + text)
        else:
            joined.append((kind, line, end, text))
    return [(line, text) for _, line, _, text in joined]


def split_name(name):
    """"DepthIsMetric" and "depth_is_metric" as words."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])|_", " ", name)


def of_c(text):
    passages = []
    for found in C_TOKENS.finditer(text):
        kind = "comment" if found.lastgroup in ("line", "block") else "string"
        if found.group("line") is not None:
            words = found.group("line").lstrip("/<! ")
        else:
            words = next((found.group(g) for g in ("block", "raw", "string", "template") if found.group(g) is not None), "")
        first = line_of(text, found.start())
        if re.match(r"\s*#\s*include", text[text.rfind("\n", 0, found.start()) + 1: found.start()]):
            continue
        words = "\n".join(line.strip() for line in words.replace("\\n", " ").replace('\\"', '"').split("\n"))
        passages.append((kind, first, line_of(text, found.end()), words))
    names = [(line_of(text, found.start()), split_name(found.group(1))) for found in TEST_NAME.finditer(text)]
    return join_neighbors(passages) + names


def of_python(text):
    passages = []
    try:
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            if token.type == tokenize.COMMENT:
                passages.append(("comment", token.start[0], token.end[0], token.string.lstrip("#! ")))
            elif token.type == tokenize.STRING:
                passages.append(("string", token.start[0], token.end[0], token.string.strip("rRbBfFuU").strip("\"'")))
    except (tokenize.TokenError, IndentationError, SyntaxError):
        return []
    names = [(line_of(text, found.start()), split_name(found.group(1))) for found in PYTHON_TEST.finditer(text)]
    return join_neighbors(passages) + names


def of_hash_comments(text):
    """Comments from '#' on, and quoted texts of messages."""
    passages = []
    for number, line in enumerate(text.splitlines(), 1):
        found = re.search(r"(?:^|\s)#+\s?([^!{].*)$", line)
        code = line[: found.start()] if found else line
        if found:
            passages.append(("comment", number, number, found.group(1)))
        for quoted in re.finditer(r'"((?:[^"\\]|\\.)*)"', code):
            passages.append(("quoted", number, number, quoted.group(1)))
    return join_neighbors(passages)


def of_page(text):
    """Markdown: code blocks, inline code, links' targets and HTML tags are left out; a table cell is a passage."""
    def blank(found):
        return re.sub(r"[^\n]", " ", found.group())
    text = re.sub(r"(?ms)^ *```.*?^ *```", blank, text)
    text = re.sub(r"(?s)<!--.*?-->", blank, text)
    text = re.sub(r"(?m)^ {4,}(?![-*] |\d+\. ).*$", blank, text)
    text = re.sub(r"`[^`\n]*`", "X", text)
    text = re.sub(r"\]\([^)\s]*\)", "]", text)
    text = re.sub(r"<[^>\n]+>", "", text)
    passages = []
    block, first = [], 0
    for number, line in enumerate(text.splitlines() + [""], 1):
        row = line.lstrip().startswith("|")
        starts = re.match(r"\s*([-*]|\d+\.|#+|>)\s", line)
        if block and (row or starts or not line.strip()):
            passages.append((first, "\n".join(block)))
            block = []
        if row:
            passages += [(number, cell.strip()) for cell in line.strip().strip("|").split("|") if re.search("[a-z]", cell)]
        elif line.strip():
            if not block:
                first = number
            block.append(re.sub(r"^\s*([-*]|\d+\.|#+|>)\s", "", line).strip())
            if line.lstrip().startswith("#"):
                passages.append((first, "\n".join(block)))
                block = []
    return passages


def of_html(text):
    scripts = re.sub(r"(?s)<(script|style)\b.*?</\1>", lambda found: re.sub(r"[^\n]", " ", found.group()), text)
    return [(line_of(scripts, found.start()), found.group(1)) for found in re.finditer(r">([^<>]*[a-z][^<>]*)<", scripts)]


def passages(path, text):
    """[(line, text)] of all prose in a file of the given path."""
    if path.suffix in CODE | {".js", ".css"}:
        return of_c(text)
    if path.suffix == ".py" or text.startswith("#!/usr/bin/env python3"):
        return of_python(text)
    if path.suffix in PAGES:
        return of_page(text)
    if path.suffix == ".html":
        return of_html(text)
    return of_hash_comments(text)


ABBREVIATION = re.compile(r"\b(?:e\.g|i\.e|eq|eqs|sec|secs|fig|figs|vs|cf|p|pp|ch|app|al|approx|Dr|No|par|alg)\.$")


def sentences(text):
    """The sentences of a passage, each with the offset of its first character."""
    start = 0
    for found in re.finditer(r"[.!?:;](?=[\s\"')\]*]|$)", text):
        piece = text[start: found.end()]
        if ABBREVIATION.search(piece):
            continue
        if piece.strip():
            yield start + len(piece) - len(piece.lstrip()), piece.strip()
        start = found.end()
    if text[start:].strip():
        piece = text[start:]
        yield start + len(piece) - len(piece.lstrip()), piece.strip()
