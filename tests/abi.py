"""Says in lines, which diff compares, what binaries see of the shared library: `abidw`'s XML from standard input,
`nm -DC --defined-only` in the file that is named.

symbol NAME; struct NAME SIZE; member STRUCT OFFSET NAME TYPE (in bytes); value ENUMERATION NAME NUMBER.
Of types those of the public headers: in the namespace raylane itself, and C's.
"""

import re
import sys
import xml.etree.ElementTree as ElementTree

INSIDE = {"core", "simd", "scenes", "library", "detail"}  # what headers only name
lines = set()
types = {}  # of an id: a function that makes its name


def qualified(scope, name):
    return "::".join(scope + [name])


def name_of(identifier):
    make = types.get(identifier)
    return make() if make else "?"


def learn(element, scope):
    """Remembers the names of all types."""
    for child in element:
        tag, identifier = child.tag, child.get("id")
        name = child.get("name", "")
        inner = scope
        if tag == "namespace-decl":
            inner = scope + [name]
        elif tag in ("class-decl", "union-decl", "enum-decl", "typedef-decl", "type-decl"):
            types[identifier] = lambda name=qualified(scope, name): name
            inner = scope + [name]
        elif tag in ("pointer-type-def", "reference-type-def"):
            mark = "*" if tag.startswith("pointer") else "&"
            types[identifier] = lambda to=child.get("type-id"), mark=mark: name_of(to) + mark
        elif tag == "qualified-type-def":
            const = "const " if child.get("const") == "yes" else ""
            types[identifier] = lambda to=child.get("type-id"), const=const: const + name_of(to)
        elif tag == "array-type-def":
            length = child.find("subrange").get("length")
            types[identifier] = lambda to=child.get("type-id"), n=length: f"{name_of(to)}[{n}]"
        elif tag == "function-type":
            parts = [part.get("type-id") for part in child]
            types[identifier] = lambda parts=parts: (
                f"{name_of(parts[-1])}({', '.join(name_of(part) for part in parts[:-1])})")
        learn(child, inner)


def is_public(scope, name):
    if scope:
        return scope[0] == "raylane" and not INSIDE & set(scope)
    return name.startswith("raylane_")


def describe(element, scope):
    for child in element:
        tag, name = child.tag, child.get("name", "")
        inner = scope
        if tag == "namespace-decl":
            inner = scope + [name]
        elif tag == "class-decl":
            inner = scope + [name]
            if is_public(scope, name) and not child.get("is-declaration-only"):
                describe_struct(child, qualified(scope, name))
        elif tag == "enum-decl" and is_public(scope, name):
            for value in child.findall("enumerator"):
                lines.add(f"value {qualified(scope, name)} {value.get('name')} {value.get('value')}")
        describe(child, inner)


def describe_struct(struct, name):
    lines.add(f"struct {name} {int(struct.get('size-in-bits', 0)) // 8}")
    for base in struct.findall("base-class"):
        offset = int(base.get("layout-offset-in-bits", 0)) // 8
        lines.add(f"member {name} {offset} (base) {name_of(base.get('type-id'))}")
    for member in struct.findall("data-member"):
        if member.get("layout-offset-in-bits") is None:
            continue  # a static one
        offset = int(member.get("layout-offset-in-bits")) // 8
        variable = member.find("var-decl")
        lines.add(f"member {name} {offset} {variable.get('name')} {name_of(variable.get('type-id'))}")


def brief(line):
    """Without what the standard library's templates have by default."""
    line = re.sub(r", 18446744073709551615(?:ul)?>", ">", line)
    while (shorter := re.sub(r", std::(?:allocator|less|char_traits)<[^<>]*> ?>", ">", line)) != line:
        line = shorter
    return line


def main():
    corpus = ElementTree.parse(sys.stdin).getroot()
    for unit in corpus.iter("abi-instr"):
        learn(unit, [])
    for unit in corpus.iter("abi-instr"):
        describe(unit, [])
    with open(sys.argv[1], encoding="utf-8") as symbols:
        for line in symbols:
            lines.add("symbol " + re.match(r"[0-9a-f]+ \w (.*)", line).group(1))
    print("\n".join(sorted(brief(line) for line in lines)))


main()
