"""Rules for JUnit files: those of the XSD of Jenkins' xunit plugin, and those of this project.

usage: junit_rules.py FILE      prints the violations; exit status 1 if there are any
"""

import re
import sys
import xml.etree.ElementTree as ElementTree

CHILDREN = {
    "testsuites": {"testsuite"},
    "testsuite": {"testsuite", "properties", "testcase", "system-out", "system-err"},
    "properties": {"property"},
    "testcase": {"skipped", "error", "failure", "system-out", "system-err"},
}
ATTRIBUTES = {
    "testsuites": {"name", "time", "tests", "failures", "errors"},
    "testsuite": {"name", "tests", "failures", "errors", "group", "time", "skipped", "timestamp", "hostname", "id",
                  "package", "file", "log", "url"},
    "testcase": {"name", "time", "classname", "group"},
    "property": {"name", "value"},
    "failure": {"type", "message"},
    "error": {"type", "message"},
    "skipped": {"type", "message"},
}
REQUIRED = {
    "testsuite": {"name", "tests", "failures", "errors", "timestamp", "hostname"},
    "testcase": {"name", "classname"},
    "property": {"name", "value"},
    "failure": {"type", "message"},
    "error": {"type", "message"},
    "skipped": {"type", "message"},
}
TIME = re.compile(r"[0-9]+(\.[0-9]{0,3})?")  # no exponent, at most three decimals
TIMESTAMP = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d")


def element_faults(element):
    tag = element.tag
    for child in element:
        if child.tag not in CHILDREN.get(tag, set()):
            yield f"{tag} contains {child.tag}"
    for name in sorted(set(element.keys()) - ATTRIBUTES.get(tag, set())):
        yield f"{tag} has the attribute {name}"
    for name in sorted(REQUIRED.get(tag, set()) - set(element.keys())):
        yield f"{tag} lacks the attribute {name}"
    if not TIME.fullmatch(element.get("time", "0")):
        yield f"{tag} has the time {element.get('time')}"
    if tag == "testsuite" and not TIMESTAMP.fullmatch(element.get("timestamp", "")):
        yield f"testsuite has the timestamp {element.get('timestamp')}"
    if tag in ("failure", "error", "skipped") and not (element.text or "").strip():
        yield f"{tag} has no text"
    if tag == "testsuite":
        counts = {"tests": len(element.findall("testcase"))}
        counts |= {f"{kind}s" if kind != "skipped" else kind: len(element.findall(f"testcase/{kind}"))
                   for kind in ("failure", "error", "skipped")}
        for name, count in counts.items():
            if element.get(name) != str(count):
                yield f"testsuite {element.get('name')}: {name} is {element.get(name)}, not {count}"


def faults(text):
    """The violations of a JUnit file, one line each. Raises ElementTree.ParseError if it is not XML."""
    root = ElementTree.fromstring(text)
    found = [] if root.tag == "testsuites" else [f"the root is {root.tag}"]
    for element in root.iter():
        found += element_faults(element)
    names = [(case.get("classname"), case.get("name")) for case in root.iter("testcase")]
    found += [f"two cases have the name {name}" for name in sorted({n for n in names if names.count(n) > 1})]
    return found


if __name__ == "__main__":
    with open(sys.argv[1], "rb") as file:
        lines = faults(file.read())
    print("\n".join(lines))
    sys.exit(bool(lines))
