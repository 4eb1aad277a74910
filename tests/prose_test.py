#!/usr/bin/env python3
"""Checks that comments, pages, docstrings, messages and names of tests are in plain words, and subjects of commits imperative.

    prose_test.py SOURCE            every folder is within its limit of flagged lines; lists them otherwise
    prose_test.py SOURCE FILE...    lists the flagged lines of files

It flags patterns of sentences that have to be read twice (see CONTRIBUTING.md). A flagged line may be good: limits leave
room for those.
"""

import ast
import pathlib
import re
import subprocess
import sys

# Flagged lines that a folder may have. Everything outside of these folders may have none.
LIMITS = {"bench": 5, "core": 10, "scenes": 45, "simd": 16, "tests": 30}
NONE = ("scenes/api/cpp/raylane/",)  # public headers
WHATS = 2.0  # the word "what", in 1,000 words
WORDS = 32  # of a sentence
COMMITS = 20  # the last ones
SUBJECT = 72  # characters

FAULTS = {
    "a clause with \"what\" in place of a noun": r"\bwhat (?!follows\b|if\b|to do\b)",
    "a fragment that opens with Of, By, As, Where or What":
        r"(?:^|[.;] )(?:Of|By|As|Where|What|Whose) (?!soon as\b|of\b|default\b|a result\b|noted\b)\w",
    "\"is none\"": r"\b(?:is|are|was|were) none\b|\bof none\b|\bnone of (?:its|their|his)\b",
    "\"as X has it\"": r"\bas [\w' ]{1,20} (?:has|have) (?:it|them)\b",
    "\"is said\", \"is told\", \"is asked\"": r"\b(?:is|are|was|were|be) (?:said|told|asked)\b",
    "an old word": r"\b(?:nor|whoever|aslant|in vain|by and by|thereof|wherein|lest|save for|anew|nought)\b",
    "\"else\" for \"otherwise\"": r"(?:,|;|\bor) else\b",
    "\"for want of\"": r"\bfor (?:want|the sake) of\b",
    "an owner without a name": r"\b(?:stranger'?s?|nobody|somebody|anybody)\b",
    "\"of its own\"": r"\bof (?:its|their|his) own\b",
    "\"there is no\"": r"\bthere (?:is|are|was|were) (?:none|no)\b",
}
FAULTS = {name: re.compile(pattern, re.IGNORECASE if "what" in name else 0) for name, pattern in FAULTS.items()}
NOT_IMPERATIVE = re.compile(r"(?:The|A|An|What|Of|By|As|In|It|Its|This|That|There|Where|Each|All|No|\w+'s|\w+ing|\w+s)\b")

C_LIKE = {".cpp", ".hpp", ".h", ".c", ".js", ".mjs"}
HASHES = {".py", ".sh", ".cmake", ".txt"}
PAGES = {".md", ".rst"}


def without_code(text):
    return re.sub(r"`[^`]*`", "X", text)


def docstrings(source):
    """Yields the number and the text of each line of a Python file's docstrings, those of fields among them."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str):
            for number, line in enumerate(node.value.value.split("\n"), node.lineno):
                yield number, re.sub(r"``[^`]*``", "X", without_code(line))


def prose_of(path):
    """Yields the number and the prose of each line that has any: comments, docstrings, text of pages, descriptions in
    the schema, and longer strings."""
    fenced, source = False, path.read_text(encoding="utf-8")
    if path.suffix == ".py":
        yield from docstrings(source)
    for number, line in enumerate(source.split("\n"), 1):
        if path.suffix in PAGES:
            if line.lstrip().startswith("```"):
                fenced = not fenced
            elif not fenced:
                yield number, without_code(re.sub(r"\]\([^)]*\)", "]", line))
        elif path.suffix in C_LIKE:
            if comment := re.search(r"(?:^|\s)//[/!<]*\s?(.*)", line) or re.match(r"\s*/?\*+/?\s?(.*)", line):
                yield number, without_code(comment[1])
            for string in re.findall(r'"((?:[^"\\]|\\.)*)"', line):
                if string.count(" ") >= 3:
                    yield number, string
        elif path.suffix == ".json":
            if description := re.search(r'"description": "((?:[^"\\]|\\.)*)"', line):
                yield number, description[1]
        elif path.suffix in HASHES and (comment := re.search(r"(?:^|\s)#\s?(.*)", line)):
            yield number, comment[1]


def long_sentences(lines):
    """Yields the first line of each paragraph with a sentence that is too long."""
    paragraph, first, last = [], 0, -1
    for number, text in [*lines, (-1, "")]:
        if text.strip() and number == last + 1:
            paragraph.append(text.strip())
        else:
            for sentence in re.split(r"(?<=[.:;?!])\s+", " ".join(paragraph)):
                if "|" not in sentence and len(re.findall(r"[A-Za-z]{2,}", sentence)) > WORDS:
                    yield first
            paragraph, first = ([text.strip()] if text.strip() else []), number
        last = number


def flagged(path):
    """Returns the flagged lines of a file as pairs of number and fault, with the numbers of words and of "what"."""
    lines = list(prose_of(path))
    found = {(number, fault) for number, text in lines for fault, pattern in FAULTS.items() if pattern.search(text)}
    found |= {(number, "a long sentence") for number in long_sentences(lines)}
    words = sum(len(text.split()) for _, text in lines)
    whats = sum(len(re.findall(r"\bwhat\b", text, re.IGNORECASE)) for _, text in lines)
    return sorted(found), words, whats


def git(source, *arguments):
    return subprocess.run(["git", "-C", str(source), *arguments], capture_output=True, text=True, check=True).stdout


def wrong_subjects(source):
    for subject in git(source, "log", f"-{COMMITS}", "--no-merges", "--format=%s").splitlines():
        if len(subject) > SUBJECT or ";" in subject or NOT_IMPERATIVE.match(subject):
            yield subject


def main():
    source, names = pathlib.Path(sys.argv[1]), sys.argv[2:]
    is_whole = not names
    try:
        names = names or git(source, "ls-files").split("\n")
    except (OSError, subprocess.CalledProcessError):
        print("skipped: the sources are not in a repository")
        return 77
    listed, counts, words, whats = {}, {}, 0, 0
    for name in names:
        path = source / name
        is_prose = path.suffix in C_LIKE | HASHES | PAGES or name.endswith(".schema.json")
        if not is_prose or name == "tests/prose_test.py" or not path.is_file():
            continue
        found, of_words, of_whats = flagged(path)
        words, whats = words + of_words, whats + of_whats
        top = name if name.startswith(NONE) or name.split("/")[0] not in LIMITS else name.split("/")[0]
        counts[top] = counts.get(top, 0) + len({number for number, _ in found})
        listed.setdefault(top, []).extend(f"{name}:{number}: {fault}" for number, fault in found)
    if not is_whole:
        print("\n".join(line for lines in listed.values() for line in lines))
        return 0
    failed = False
    for top, count in counts.items():
        if count > LIMITS.get(top, 0):
            print("\n".join(listed[top]), f"{top}: {count} flagged lines, at most {LIMITS.get(top, 0)} are allowed", sep="\n")
            failed = True
    if 1000 * whats > WHATS * words:
        print(f"\"what\" stands {1000 * whats / words:.1f} times in 1,000 words, at most {WHATS} are allowed")
        failed = True
    for subject in wrong_subjects(source):
        print(f"subject of a commit: must be imperative, one change and at most {SUBJECT} characters: {subject}")
        failed = True
    return failed


sys.exit(main())
