"""A file includes the headers of all its names, so that it compiles alone, without the precompiled headers."""

import functools
import re

from tree import CODE, Fault, files, line_of, read

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)
CONTAINERS = ("array", "deque", "list", "map", "set", "span", "string", "vector")

# (a name, the headers of which one must be included). Only names of precompiled headers: the build finds all others.
NAMES = [(re.compile(pattern), headers) for pattern, headers in (
    (r"\bstd::(?:string|to_string|getline)\b", ("string",)),
    (r"\bstd::string_view\b", ("string_view", "string")),
    (r"\bstd::vector\b", ("vector",)),
    (r"\bstd::array\b", ("array",)),
    (r"\bstd::span\b", ("span",)),
    (r"\bstd::(?:multi)?map\b", ("map",)),
    (r"\bstd::optional\b|\bstd::nullopt\b", ("optional",)),
    (r"\bstd::(?:variant|visit|get_if|holds_alternative|monostate)\b", ("variant",)),
    (r"\bstd::function\b", ("functional",)),
    (r"\bstd::(?:unique_ptr|shared_ptr|weak_ptr|make_unique|make_shared)\b", ("memory",)),
    (r"\bstd::filesystem\b", ("filesystem",)),
    (r"\bstd::numeric_limits\b", ("limits",)),
    (r"\bstd::numbers\b", ("numbers",)),
    (r"\bstd::o?stringstream\b", ("sstream",)),
    (r"\bstd::(?:runtime_error|invalid_argument|logic_error|out_of_range)\b", ("stdexcept",)),
    (r"\bstd::(?:mt19937(?:_64)?|uniform_\w+_distribution|normal_distribution)\b", ("random",)),
    (r"\bstd::(?:sin|cos|tan|asin|acos|atan2?|sqrt|hypot|pow|exp|log|floor|ceil|l?l?round|isfinite|isnan|fmod)\b", ("cmath", "Eigen/")),
    (r"\bstd::(?:min|max|clamp|sort|fill|copy|find|any_of|all_of|min_element|max_element)\b|\bstd::ranges::", ("algorithm",)),
    (r"\bu?int(?:8|16|32|64)_t\b", ("cstdint",)),
    (r"\bstd::(?:pair|move|swap|exchange|forward|index_sequence)\b", ("utility", "optional", "memory", "variant", "functional", *CONTAINERS)),
    (r"\bEigen::", ("Eigen/",)),
    (r"\bcv::", ("opencv2/",)),
    (r"\bfmt::", ("fmt/",)),
    (r"\bnlohmann::", ("nlohmann/",)),
)]


def check_includes(root):
    """A file, with the headers of the project that it includes, includes the headers of its names."""
    @functools.cache
    def included(path):
        """The package headers that `path` includes itself or through headers of the project."""
        if not (root / path).exists():  # the rule `layers` reports it; generated headers use no package
            return frozenset()
        found = set()
        for quote, target in INCLUDE.findall(read(root, path)):
            found |= included(target) if quote == '"' else {target}
        return frozenset(found)

    faults = []
    for path in files(root, CODE):
        if path.parts[0] in ("tests", "scripts", "docs"):
            continue
        text = read(root, path)
        headers = included(str(path))
        code = re.sub(r"//.*", "", text)
        for name, needed in NAMES:
            use = name.search(code)
            if use and not any(header.startswith(start) for header in headers for start in needed):
                faults.append(Fault(path, line_of(code, use.start()), f"{use[0]} needs #include <{needed[0]}>"))
    return faults
