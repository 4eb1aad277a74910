"""Builds the compiled module by CMake from the whole source tree. RAYLANE_BUILD: folder of an existing build to use.

Everything that is built is in a temporary folder: nothing is written to the source.
"""

import atexit
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parents[3]
WORK = tempfile.mkdtemp(prefix="raylane-wheel-")
atexit.register(shutil.rmtree, WORK, ignore_errors=True)
HEADER = (ROOT / "scenes/api/cpp/raylane/version.h").read_text()


class Build(build_ext):
    def build_extension(self, ext: Extension) -> None:
        build = pathlib.Path(os.environ.get("RAYLANE_BUILD") or self.build_temp).resolve()
        if "RAYLANE_BUILD" not in os.environ:
            options = [f"-DRAYLANE_{part}=OFF" for part in ("TOOL", "TESTS", "BENCHMARKS", "INSTALL")]
            options += ["-DRAYLANE_PYTHON=REQUIRED", "-DCMAKE_BUILD_TYPE=Release", f"-DPython3_EXECUTABLE={sys.executable}"]
            subprocess.run(["cmake", "-S", ROOT, "-B", build, *options], check=True)
        jobs = str(os.cpu_count() or 1)
        subprocess.run(["cmake", "--build", build, "--target", "raylane_python", "--parallel", jobs], check=True)
        to = pathlib.Path(self.get_ext_fullpath(ext.name))
        to.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(build / "python" / "raylane" / to.name, to)
        annotation = build / "python" / "raylane" / "raylane-annotation.so"
        if annotation.exists():  # raylane was built with Pango
            shutil.copy(annotation, to.parent)


setup(
    version=re.search(r'RAYLANE_VERSION "([^"]+)"', HEADER).group(1),
    ext_modules=[Extension("raylane._raylane", [])],
    cmdclass={"build_ext": Build},
    options={"build": {"build_base": WORK}, "egg_info": {"egg_base": WORK}},
)
