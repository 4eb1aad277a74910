"""Atoms of other packages, drawn as files of them are."""

import importlib
import sys

import numpy as np
import pytest
import raylane


def colors_and_places(scene):
    """What is seen of a scene, to compare: its bounds, its shapes' colours and its camera."""
    colors = [scene.material(int(m)).color for m in scene.material_of(np.arange(scene.shape_count))]
    return scene.bounds, colors, scene.camera


WATER = (["O", "H", "H"], [[0, 0, 0.1], [0, 0.77, -0.46], [0, -0.77, -0.46]])


def test_as_a_file_of_them(tmp_path):
    path = tmp_path / "water.xyz"
    path.write_text("3\nwater\n" + "".join(f"{s} {x} {y} {z}\n" for s, (x, y, z) in zip(*WATER)))
    assert colors_and_places(raylane.from_atoms(*WATER)) == colors_and_places(raylane.load(path))
    for wrong in (np.zeros((2, 3)), np.zeros((3, 2)), np.zeros(9)):
        with pytest.raises(raylane.InvalidValue, match="positions"):
            raylane.from_atoms(WATER[0], wrong)


def test_ase(monkeypatch):
    ase = pytest.importorskip("ase")
    import ase.build
    import ase.visualize

    atoms = ase.Atoms(*WATER)
    scene = raylane.from_ase(atoms)
    assert colors_and_places(scene) == colors_and_places(raylane.from_atoms(*WATER))
    salt = ase.build.bulk("NaCl", "rocksalt", a=5.64, cubic=True)
    assert raylane.from_ase(salt).shape_count > 8  # with its cell
    assert [s.shape_count for s in raylane.frames([atoms, atoms])] == [scene.shape_count] * 2

    importlib.import_module("raylane.ase_viewer")
    shown = []
    monkeypatch.setattr(raylane.Scene, "show", lambda self, **_: shown.append(self.shape_count))
    ase.visualize.view(atoms, viewer="raylane")
    ase.visualize.view(salt, viewer="raylane", repeat=(2, 1, 1))
    assert shown[0] == scene.shape_count and shown[1] > raylane.from_ase(salt).shape_count
    ase.visualize.external.viewers.pop("raylane")
    for name in ("raylane.ase_viewer", "raylane"):
        monkeypatch.delitem(sys.modules, name)
    importlib.import_module("raylane")  # as one who imports it after ASE
    assert "raylane" in ase.visualize.external.viewers


PDB = """\
ATOM      1  N   ALA A   1      11.104   6.134  -6.504  1.00  0.00           N
ATOM      2  CA  ALA A   1      11.639   6.071  -5.147  1.00  0.00           C
ATOM      3  C   ALA A   1      10.526   6.268  -4.121  1.00  0.00           C
ATOM      4  O   ALA A   1      10.781   6.613  -2.969  1.00  0.00           O
ATOM      5  CB  ALA A   1      12.684   7.164  -4.939  1.00  0.00           C
TER
END
"""
SYMBOLS = ["N", "C", "C", "O", "C"]


@pytest.fixture
def pdb(tmp_path):
    path = tmp_path / "a.pdb"
    path.write_text(PDB)
    return path


@pytest.mark.filterwarnings("ignore")
def test_mdanalysis(pdb):
    mda = pytest.importorskip("MDAnalysis")
    universe = mda.Universe(str(pdb))
    expected = raylane.from_atoms(SYMBOLS, universe.atoms.positions)
    assert colors_and_places(raylane.from_mdanalysis(universe)) == colors_and_places(expected)
    some = raylane.from_mdanalysis(universe.select_atoms("name CA CB"))
    assert colors_and_places(some) == colors_and_places(raylane.from_atoms(["C", "C"], universe.atoms.positions[[1, 4]]))
    assert len(list(raylane.frames(universe))) == 1
    bare = mda.Universe.empty(2, trajectory=True)
    bare.add_TopologyAttr("names", ["1HB", "CA"])
    bare.atoms.positions = [[0, 0, 0], [0, 0, 1.1]]
    assert colors_and_places(raylane.from_mdanalysis(bare)) == colors_and_places(raylane.from_atoms(["H", "C"], bare.atoms.positions))


@pytest.mark.filterwarnings("ignore")
def test_mdtraj(pdb):
    mdtraj = pytest.importorskip("mdtraj")
    trajectory = mdtraj.load(str(pdb))
    places = 10.0 * trajectory.xyz[0].astype(np.float64)
    assert np.allclose(places[0], [11.104, 6.134, -6.504], atol=1e-4)
    assert colors_and_places(raylane.from_mdtraj(trajectory)) == colors_and_places(raylane.from_atoms(SYMBOLS, places))
    assert len(list(raylane.frames(trajectory))) == 1
