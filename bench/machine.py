"""Describes the machine and the program versions of a measurement, for the small print of figures.

    machine.py BUILD    prints the value of --benchmark_context for raylane-bench of this build
"""

import datetime
import pathlib
import platform
import re
import subprocess
import sys

ISA_NAMES = {"avx512": "AVX-512", "avx2": "AVX2", "sse4.2": "SSE4.2", "neon": "NEON", "portable": "portable"}
VERSIONS = ("raylane", "Embree", "POV-Ray", "Tachyon")


def output_of(*command):
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=20)
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return done.stdout.decode(errors="replace")


def found(pattern, text):
    match = re.search(pattern, text, re.MULTILINE)
    return match[1].strip() if match else ""


def processor():
    try:
        name = found(r"^model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    except OSError:
        name = ""
    return name or found(r"^Model name:\s*(.*)", output_of("lscpu")) or platform.machine()


def versions_of(build):
    """Returns the versions of raylane, of its compiler and of Embree in a build folder, as far as CMake knows them."""
    build = pathlib.Path(build)
    try:
        cache = (build / "CMakeCache.txt").read_text()
    except OSError:
        cache = ""
    compilers = sorted(build.glob("CMakeFiles/*/CMakeCXXCompiler.cmake"))
    compiler = compilers[-1].read_text() if compilers else ""
    versions = {
        "raylane": found(r"^CMAKE_PROJECT_VERSION:STATIC=(.*)", cache),
        "Embree": found(r"^embree_DIR:PATH=.*embree-([\d.]*\d)", cache),
        "compiler": " ".join(found(f'CMAKE_CXX_COMPILER_{key} "(.*)"', compiler) for key in ("ID", "VERSION")).strip(),
    }
    return {name: version for name, version in versions.items() if version}


def versions_of_peers():
    """Returns the versions of the other installed renderers."""
    versions = {
        "POV-Ray": found(r"^POV-Ray (\d[\d.]*\d)", output_of("povray", "--version")),
        "Tachyon": found(r"^(?:.*Version\s+)?(\d[\w.]*)", output_of("tachyon", "-version")),
    }
    return {name: version for name, version in versions.items() if version}


def described(build):
    """Returns the description that measurements keep as "machine"."""
    return {
        "processor": processor(),
        "date": datetime.date.today().isoformat(),
        **versions_of(build),
    }


def small_print(document, isas=(), versions=VERSIONS):
    """Returns one line from measurements: processor, instruction sets, versions and date, as far as they are known."""
    machine = document.get("machine") or document.get("context") or {}
    parts = [
        machine.get("processor"),
        " and ".join(ISA_NAMES.get(isa, isa) for isa in isas),
        ", ".join(f"{name} {machine[name]}" for name in versions if name in machine),
        machine.get("compiler"),
        machine.get("date", "")[:10],
    ]
    return "; ".join(part for part in parts if part)


if __name__ == "__main__":
    # The separators of --benchmark_context are not allowed in its values.
    entries = {name: re.sub("[,=]", " ", value) for name, value in described(sys.argv[1]).items() if name != "date"}
    print(",".join(f"{name}={value}" for name, value in entries.items()))
