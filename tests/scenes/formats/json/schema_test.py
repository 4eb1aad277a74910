"""Checks the JSON Schema against every shipped scene and against the corpus that tests the reader, too.

usage: schema_test.py SOURCE_DIRECTORY
Exit code 77 where python3-jsonschema is missing.
"""

import json
import pathlib
import re
import sys

try:
    import jsonschema
except ImportError:
    print("skipped: there is no python3-jsonschema")
    sys.exit(77)

# Strings are matched first, so that text like a comment inside of a string stays.
STRING_OR_COMMENT = re.compile(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/', re.DOTALL)


def without_comments(text):
    return STRING_OR_COMMENT.sub(lambda match: match.group(1) or " ", text)


def scene_of(base, entry):
    """Returns the base with the entry's keys in place of its keys. null removes a key."""
    return {key: value for key, value in {**base, **entry}.items() if value is not None}


def strings_in(value):
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for child in value.values():
            yield from strings_in(child)
    elif isinstance(value, list):
        for child in value:
            yield from strings_in(child)


def words_of_schema(value):
    """Yields all strings that the schema knows as values."""
    if isinstance(value, dict):
        yield from (word for word in value.get("enum", []) if isinstance(word, str))
        yield from (word for word in [value.get("const")] if isinstance(word, str))
        for child in value.values():
            yield from words_of_schema(child)
    elif isinstance(value, list):
        for child in value:
            yield from words_of_schema(child)


def main():
    source = pathlib.Path(sys.argv[1])
    schema_path = source / "scenes" / "raylane-scene.schema.json"
    schema = json.loads(schema_path.read_text(encoding="utf-8"))
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    failures = []

    def expect(scene, good, name):
        error = jsonschema.exceptions.best_match(validator.iter_errors(scene))
        if good and error is not None:
            failures.append(f"{name}: {error.message} at /{'/'.join(map(str, error.absolute_path))}")
        if not good and error is None:
            failures.append(f"{name}: must be refused, but is not")

    shipped = [path for path in sorted((source / "scenes").glob("*.json")) if path != schema_path]
    for path in shipped:
        expect(json.loads(without_comments(path.read_text(encoding="utf-8"))), True, path.name)

    corpus_path = source / "tests" / "scenes" / "formats" / "json" / "schema_corpus.json"
    corpus = json.loads(corpus_path.read_text(encoding="utf-8"))
    for verdict, good in (("good", True), ("bad", False), ("bad, but not to a schema", True)):
        for entry in corpus[verdict]:
            expect(scene_of(corpus["base"], entry), good, f"{verdict} {json.dumps(entry)}")

    unused = set(words_of_schema(schema)) - set(strings_in(corpus["good"]))
    if unused:
        failures.append(f"no good scene of the corpus has {sorted(unused)}")

    print("\n".join(failures) or f"{len(shipped)} shipped scenes and the corpus are as they should be")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
