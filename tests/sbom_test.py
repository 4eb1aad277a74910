"""Holds the list of what raylane's binaries are made of to SPDX 2.3 and to the binaries.

usage: sbom_test.py SBOM READELF BUILD_FOLDER NAME=BINARY...

Which shared libraries each binary needs is what readelf says, whose headers are compiled in what ninja
wrote down when it compiled (not asked where another generator did).
"""

import json
import re
import subprocess
import sys
from pathlib import Path

failures = []


def expect(holds, message):
    if not holds:
        failures.append(message)


LICENCE = r"[A-Za-z0-9.+-]+( WITH [A-Za-z0-9.-]+)?"
EXPRESSION = re.compile(rf"\(*{LICENCE}\)*( (AND|OR) \(*{LICENCE}\)*)*")
TYPES = {"DESCRIBES", "DYNAMIC_LINK", "STATIC_LINK"}


def check_form(document):
    """What SPDX 2.3's JSON schema and its chapters on documents, packages and relationships ask for."""
    expect(document["spdxVersion"] == "SPDX-2.3", "spdxVersion")
    expect(document["dataLicense"] == "CC0-1.0", "dataLicense")
    expect(document["SPDXID"] == "SPDXRef-DOCUMENT", "SPDXID")
    expect(re.fullmatch(r"[a-z]+:[^#\s]+", document["documentNamespace"]), "documentNamespace")
    created = document["creationInfo"]["created"]
    expect(re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", created), "created")
    creators = document["creationInfo"]["creators"]
    expect(creators and all(re.match("(Tool|Organization|Person): .", each) for each in creators), "creators")
    ids = [package["SPDXID"] for package in document["packages"]]
    expect(len(set(ids)) == len(ids), "an SPDXID is there twice")
    for package in document["packages"]:
        name = package["SPDXID"]
        expect(re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", name), f"{name}: SPDXID")
        expect(package["name"], f"{name}: name")
        expect(re.fullmatch(r"[0-9][0-9a-z.]*", package["versionInfo"]), f"{name}: versionInfo")
        expect(package["filesAnalyzed"] is False, f"{name}: filesAnalyzed")
        expect(re.fullmatch(r"NOASSERTION|https://\S+", package["downloadLocation"]), f"{name}: downloadLocation")
        for key in ("licenseConcluded", "licenseDeclared"):
            expect(EXPRESSION.fullmatch(package[key]) and package[key] != "NOASSERTION", f"{name}: {key}")
            expect(package[key].count("(") == package[key].count(")"), f"{name}: {key}")
        expect(package["copyrightText"], f"{name}: copyrightText")
        for reference in package.get("externalRefs", []):
            expect(reference["referenceType"] == "purl", f"{name}: referenceType")
            expect(re.fullmatch(r"pkg:[a-z]+/\S+@[0-9][0-9a-z.]*", reference["referenceLocator"]), f"{name}: purl")
    for each in document["relationships"]:
        expect(each["relationshipType"] in TYPES, f"relationship {each['relationshipType']}")
        for key in ("spdxElementId", "relatedSpdxElement"):
            expect(each[key] in ids + ["SPDXRef-DOCUMENT"], f"relationship to {each[key]}, which is not there")


def related(document, name, relationship):
    """IDs that NAME is related to, with the comment on it."""
    return {
        each["relatedSpdxElement"].removeprefix("SPDXRef-"): each["comment"]
        for each in document["relationships"]
        if each["spdxElementId"] == f"SPDXRef-{name}" and each["relationshipType"] == relationship
    }


def check_links(document, readelf, name, binary):
    """Each library that BINARY needs is one of a component's, and none is listed that it does not need."""
    said = [library for libraries in related(document, name, "DYNAMIC_LINK").values() for library in libraries.split()]
    needed = []
    if not binary.endswith(".a"):
        dynamic = subprocess.run([readelf, "-dW", binary], check=True, capture_output=True, text=True).stdout
        needed = re.findall(r"NEEDED.*\[(.*)\]", dynamic)
        expect("libc.so.6" in needed, f"{name}: readelf tells of no libc")
    expect(sorted(said) == sorted(needed), f"{name} is linked with {sorted(needed)}, and listed with {sorted(said)}")


OWNERS = [  # of what is included from, by the first that fits
    (r"/c\+\+/|/lib/(gcc|llvm|clang)[/-]", "GCC-runtime"),
    (r"/include/(oneapi|tbb)/", "oneTBB"),
    (r"/include/xsimd/", "xsimd"),
    (r"/include/glm/", "GLM"),
    (r"/include/nlohmann/", "nlohmann-json"),
    (r"/include/CLI/", "CLI11"),
    (r"/stb_image_write\.h$", "stb-image-write"),
    (r"/xxh(ash|3)\.h$", "xxHash"),
    (r"/include/gemmi/", "gemmi"),
    (r"/include/tao/", "PEGTL"),
    (r"/include/OpenEXR/", "OpenEXR"),
    (r"/include/Imath/", "Imath"),
    (r"/include/([a-z0-9_-]+/)?SDL2/", "SDL2"),
    (r"/openmpi/", "OpenMPI"),
    (r"/png(conf|libconf)?\.h$", "libpng"),
    (r"/(zlib|zconf)\.h$", "zlib"),
    (r"/include/([a-z0-9_]+-linux-gnu/)?((bits|sys|gnu|asm|asm-generic|linux)/.*|[a-z0-9-]+\.h)$", "glibc"),
]
PARTS = {  # objects of which binaries
    "core/": ["raylane", "libraylane"],
    "simd/": ["raylane", "libraylane"],
    "scenes/CMakeFiles/raylane_scenes": ["raylane", "libraylane"],
    "scenes/CMakeFiles/raylane_pictures": ["raylane"],
    "scenes/library/": ["libraylane"],
    "scenes/tool/CMakeFiles/raylane.dir/": ["raylane"],
    "scenes/tool/CMakeFiles/raylane_journal.dir/": ["raylane"],
    "scenes/tool/CMakeFiles/raylane_ranks.dir/": ["raylane"],
    "scenes/tool/CMakeFiles/raylane-mpi.dir/": ["raylane-mpi"],
    "scenes/tool/CMakeFiles/raylane-window.dir/": ["raylane-window"],
}


def check_headers(document, build, binaries):
    """Whose headers are compiled in is listed, and nobody else's."""
    if not (Path(build) / ".ninja_deps").exists():
        print("(no ninja: nobody knows whose headers were read)")
        return
    lines = subprocess.run(["ninja", "-C", build, "-t", "deps"], check=True, capture_output=True, text=True).stdout
    included = {name: set() for name in binaries}
    parts = []
    for line in lines.splitlines():
        if not line.startswith(" "):
            parts = [part for prefix, names in PARTS.items() if line.startswith(prefix) for part in names]
        elif line.strip().startswith("/usr"):
            for part in parts:
                included.setdefault(part, set()).add(line.strip())
    # Of kernels that are another build's (RAYLANE_KERNELS) it knows nothing.
    elsewhere = set() if "raylane_simd-" in lines else {"xsimd"}
    for name in binaries:
        owners = set()
        for header in included[name]:
            owner = next((owner for pattern, owner in OWNERS if re.search(pattern, header)), None)
            expect(owner, f"{name} has {header}, which is nobody's")
            owners.add(owner)
        said = set(related(document, name, "STATIC_LINK")) - elsewhere
        expect(owners and owners == said, f"{name} has headers of {owners - said}, and is listed with {said - owners}")


def main():
    sbom, readelf, build, *binaries = sys.argv[1:]
    document = json.loads(Path(sbom).read_text(encoding="utf-8"))
    files = dict(each.split("=", 1) for each in binaries)
    check_form(document)
    expect(set(related(document, "DOCUMENT", "DESCRIBES")) == set(files), "other binaries are described")
    for name, file in files.items():
        check_links(document, readelf, name, file)
    check_headers(document, build, files)
    print("\n".join(failures) or f"{len(document['packages'])} packages, as they are")
    sys.exit(bool(failures))


main()
