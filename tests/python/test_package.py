"""Types, and the wheel."""

import os
import pathlib
import shutil
import subprocess
import sys
import zipfile

import pytest
import raylane

SOURCE = pathlib.Path(__file__).parents[2] / "scenes" / "api" / "python"


def run(*command, **options):
    done = subprocess.run([sys.executable, *map(str, command)], capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_types(tmp_path):
    pytest.importorskip("mypy")
    config = ["--config-file", SOURCE / "pyproject.toml", "--cache-dir", tmp_path]
    run("-m", "mypy", *config, SOURCE / "raylane")
    user = tmp_path / "user.py"
    user.write_text(
        "import raylane\n"
        "builder = raylane.SceneBuilder()\n"
        "ids: range = builder.add_spheres([0, 0, 0], 1.0, material=builder.add_material())\n"
        "hits = raylane.Tracer(builder.build()).intersect([0, 0, 5], [0, 0, -1])\n"
        "reveal_type(hits.t)\n"
    )
    environment = {**os.environ, "MYPYPATH": str(SOURCE)}
    assert "floating" in run("-m", "mypy", *config, user, env=environment)
    user.write_text("import raylane\nraylane.Material(reflection='hm')\n")
    wrong = subprocess.run(
        [sys.executable, "-m", "mypy", *map(str, config), user], capture_output=True, text=True, env=environment
    )
    assert wrong.returncode == 1 and "reflection" in wrong.stdout


def test_stub(tmp_path):
    """The stub matches the compiled module."""
    pytest.importorskip("mypy")
    allowed = tmp_path / "allowed"
    classes = "Builder|Group|Scene|Solid|Texture|Tracer|Transform"
    allowed.write_text(f"raylane._raylane.({classes})\nraylane._raylane.({classes}).__init__\n")  # pybind11's metaclass
    run("-m", "mypy.stubtest", "raylane._raylane", "--allowlist", allowed, "--ignore-unused-allowlist", cwd=tmp_path)


def test_wheel(tmp_path):
    """A wheel of an existing build renders after it is installed in a separate folder, and nothing is written to the source."""
    pytest.importorskip("pip")
    pytest.importorskip("wheel")
    if not os.environ.get("RAYLANE_BUILD"):
        pytest.skip("RAYLANE_BUILD does not say which build")
    # Other tests may write to the source meanwhile, but not to a copy of the files that make a wheel.
    source = tmp_path / "source"
    for part in ("python", "cpp/raylane"):
        shutil.copytree(SOURCE.parent / part, source / "scenes/api" / part, ignore=shutil.ignore_patterns("__pycache__"))
    before = sorted(source.rglob("*"))
    package = source / "scenes/api/python"
    run("-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation", "--wheel-dir", tmp_path, package)
    assert sorted(source.rglob("*")) == before
    [wheel] = tmp_path.glob("raylane-*.whl")
    assert raylane.__version__ in wheel.name
    names = zipfile.ZipFile(wheel).namelist()
    assert "raylane/py.typed" in names and "raylane/_raylane.pyi" in names and "raylane/ase_viewer.py" in names
    folder = tmp_path / "installed"
    run("-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--target", folder, wheel)
    code = "import raylane; print(raylane.__file__); print(raylane.from_atoms(['C'], [[0, 0, 0]]).render(width=8, height=8))"
    told = run("-c", code, env={**os.environ, "PYTHONPATH": str(folder)}, cwd=tmp_path)
    assert str(folder) in told and "8 x 8" in told
    entries = (next(folder.glob("raylane-*.dist-info")) / "entry_points.txt").read_text()
    assert "[ase.visualize]" in entries and "raylane.ase_viewer:VIEWER_ENTRYPOINT" in entries
