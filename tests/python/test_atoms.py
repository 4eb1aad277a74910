"""Atoms of other packages are rendered like the same atoms in files."""

import importlib
import json
import sys

import numpy as np
import pytest
import raylane


def colors_and_places(scene):
    """Returns the visible properties of a scene, to compare: its bounds, its shapes' colours and its camera."""
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


CELL = 8 + 12  # its corners and edges


def test_the_cell_is_drawn():
    bare = raylane.from_atoms(*WATER)
    cell = [[6, 0, 0], [1, 6, 0], [0, 1, 6]]
    scene = raylane.from_atoms(*WATER, cell=cell, periodic=False)
    assert scene.shape_count == bare.shape_count + CELL
    assert np.allclose(scene.bounds[1], [7.02, 7.02, 6.02], atol=0.01)
    hidden = raylane.from_atoms(*WATER, cell=cell, periodic=False, cell_edges=False)
    assert hidden.shape_count == bare.shape_count
    middles = []  # of its edges
    for k, edge in enumerate(np.array(cell, float)):
        a, b = (np.array(cell[i], float) for i in range(3) if i != k)
        middles += [corner + edge / 2 for corner in (0 * a, a, b, a + b)]
    inside = raylane.Tracer(scene).contains(np.array(middles))
    assert (inside.counts() > 0).all() and (raylane.Tracer(bare).contains(np.array(middles)).counts() == 0).sum() >= 9
    for none in (np.zeros((3, 3)), [[6, 0, 0], [0, 6, 0], [0, 0, 0]], [[6, 0, 0], [0, 6, 0], [0, 0, 1e-60]]):
        assert raylane.from_atoms(*WATER, cell=none, periodic=False).shape_count == bare.shape_count


def test_what_no_atoms_are_says_where():
    places = [[0.0, 0, 0]]
    for call, text in (
        (lambda: raylane.from_atoms(["C 5"], places), "symbols/0: must be an element's symbol, without spaces, got 'C 5'"),
        (lambda: raylane.from_atoms(["C", ""], places * 2), "symbols/1: must be an element's symbol, without spaces, got ''"),
        (lambda: raylane.from_atoms(["C\n"], places), "symbols/0: must be an element's symbol, without spaces, got 'C\\n'"),
        (lambda: raylane.from_atoms(["Cx"], places), "symbols/0: must be an element's symbol, or X if it is unknown, got 'Cx'"),
        (lambda: raylane.from_atoms(["CA1"], places), "symbols/0: must be an element's symbol, or X if it is unknown, got 'CA1'"),
        (lambda: raylane.from_atoms([None], places), "symbols/0: must be an element's symbol, or number up to 118, got None"),
        (lambda: raylane.from_atoms([119], places), "symbols/0: must be an element's symbol, or number up to 118, got 119"),
        (lambda: raylane.from_atoms([10**5000], places), "symbols/0: must be an element's symbol, or number up to 118, got a larger number"),
        (lambda: raylane.from_atoms("H2O", places * 3), "symbols: must be a list of symbols or numbers, got 'H2O'"),
        (lambda: raylane.from_atoms([], np.zeros((0, 3))), "symbols: must have at least one atom, got none"),
        (lambda: raylane.from_atoms(["C"], [[0, np.nan, 0]]), "positions/0/1: must be a number from -1e30 to 1e30, got nan"),
        (lambda: raylane.from_atoms(["C"], [[0, 0, -2e30]]), "positions/0/2: must be a number from -1e30 to 1e30, got -2e+30"),
        (lambda: raylane.from_atoms(["C"], "abc"), "positions: must be an array of numbers, got one of <U3"),
        (lambda: raylane.from_atoms(["C"], [[0, 0, 1j]]), "positions: must be an array of numbers, got one of complex128"),
        (lambda: raylane.from_atoms(["C"], [[0, 0], [1]]), "positions: must be an array of numbers"),
        (lambda: raylane.from_atoms(["C"], [0, 0, 0]), "positions: must have the shape (1, 3), got (3,)"),
        (lambda: raylane.from_atoms(["C"], places, cell=[1, 2, 3]), "cell: must have the shape (3, 3), got (3,)"),
        (lambda: raylane.from_atoms(["C"], places, cell=np.full((3, 3), np.inf)), "cell/0/0: must be a number from -1e30 to 1e30, got inf"),
    ):
        with pytest.raises(raylane.InvalidValue) as error:
            call()
        assert str(error.value) == text
    carbon = raylane.from_atoms(["C"], places)
    assert colors_and_places(raylane.from_atoms(np.array([6]), places)) == colors_and_places(carbon)


def names_of(scene):
    """Returns the opacities and colours of a scene's shapes, in order."""
    materials = [scene.material(int(m)) for m in scene.material_of(np.arange(scene.shape_count))]
    return [(m.opacity, tuple(np.round(m.color, 3))) for m in materials]


def test_representations():
    white, orange = (1.0, 1.0, 1.0), (1.0, 0.376, 0.0)
    places = [[0.0, 0, 0], [9, 0, 0], [18, 0, 0]]
    known = dict(
        names=["CA", "C1", "O"],
        residue_names=["ALA", "XK2", "HOH"],
        residue_numbers=[1, 2, 3],
        chains=["A", "", ""],
        properties={"charge": [0.5, 0, -1]},
    )
    scene = raylane.from_atoms(
        "C C O".split(),
        places,
        representations=["all: spheres white opacity 0.5", "ligand: spheres carbons orange", "charge < -0.5: points white"],
        **known,
    )
    assert sorted(names_of(scene)) == [(0.5, white), (1.0, orange), (1.0, white)]
    assert raylane.from_atoms("C C O".split(), places, representations=["resn ALA"], **known).shape_count == 1
    with pytest.warns(UserWarning, match='representations/0: column 18: "B" matches no chain'):
        raylane.from_atoms("C C O".split(), places, representations=["chain A or chain B"], **known)


def test_malformed_representations_say_where():
    places = [[0.0, 0, 0]]
    for representations, text in (
        (["all: stiks"], "representations/0: must be a style, element or a colour such as red or #ff8000, got \"stiks\""),
        (["all", "al: sticks"], "representations/1: column 1: must be one of all"),
        (["all: opacity 2"], "representations/0: column 14: opacity must be above 0 and at most 1"),
    ):
        with pytest.raises(raylane.BadInput) as error:
            raylane.from_atoms(["C"], places, representations=representations)
        assert str(error.value).startswith(text)
    for keys, text in (
        (dict(representations="all"), "representations: must be a list of texts, got one text"),
        (dict(representations=[1]), "representations/0: must be a text, got 1"),
        (dict(names=["A", "B"]), "names: must have 1 values, one for each atom, got 2"),
        (dict(names=["A B"]), "names/0: must be a word without spaces, got 'A B'"),
        (dict(properties={"a b": [1]}), "properties: must have names of letters, digits and _, got 'a b'"),
        (dict(properties={"a": [1, 2]}), "properties/a: must be 1 numbers, one for each atom"),
    ):
        with pytest.raises(raylane.InvalidValue) as error:
            raylane.from_atoms(["C"], places, **keys)
        assert str(error.value) == text


class Atoms:
    """The attributes of an AtomGroup of MDAnalysis that raylane reads."""

    elements = names = ["C", "C"]
    positions = np.array([[0.0, 0, 0], [9, 0, 0]])
    resnames, resids, chainIDs, segids, charges = ["ALA", "LIG"], [1, 2], ["", ""], ["P", "L"], [0.0, 1.0]

    @property
    def atoms(self):
        return self


def test_names_of_mdanalysis_are_known_to_representations():
    for select in ("ligand", "resn LIG", "resi 2", "chain L", "charge > 0.5"):
        assert raylane.from_mdanalysis(Atoms(), [select + ": spheres red"]).bounds[0][0] > 7
    assert raylane.from_mdanalysis(Atoms()).shape_count == 2


def test_ase(monkeypatch):
    ase = pytest.importorskip("ase")
    import ase.build
    import ase.visualize

    atoms = ase.Atoms(*WATER)
    scene = raylane.from_ase(atoms)
    assert colors_and_places(scene) == colors_and_places(raylane.from_atoms(*WATER))
    salt = ase.build.bulk("NaCl", "rocksalt", a=5.64, cubic=True)
    symbols, places = salt.get_chemical_symbols(), salt.get_positions()
    as_given = raylane.from_ase(salt, boundary=False, whole=False)
    assert as_given.shape_count == raylane.from_atoms(symbols, places).shape_count + CELL
    assert raylane.from_ase(salt).shape_count == 27 + 2 * 54 + CELL  # atoms, halves of bonds
    slab = ase.Atoms(*WATER, cell=[[6, 0, 0], [0, 6, 0], [0, 0, 0]])
    assert raylane.from_ase(slab).shape_count == scene.shape_count  # a cell of two vectors is not drawn
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
    importlib.import_module("raylane")  # as if it were imported after ASE
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


def test_style_draws_chains():
    chain = dict(names=["CA"] * 6, residue_names=["ALA"] * 6, residue_numbers=range(1, 7), chains=["A"] * 6)
    places = [[3.8 * i, 0, 0] for i in range(6)]
    trace = raylane.from_atoms(["C"] * 6, places, style="trace", **chain)
    assert (len(trace.spheres()), trace.shape_count) == (11, 21)
    cartoon = raylane.from_atoms(["C"] * 6, places, style="cartoon rainbow", **chain)
    assert cartoon.shape_count > 100 and cartoon.material_count == 6
    none = "style: must be a style of atoms here: the selection has no proteins or nucleic acids of two residues"
    with pytest.raises(raylane.BadInput) as error:
        raylane.from_atoms(["C"], [[0, 0, 0]], style="cartoon")
    assert str(error.value) == none and error.value.errors[0].file == "style"
    with pytest.raises(raylane.BadInput) as error:
        raylane.from_atoms(["C"], [[0, 0, 0]], representations=["all: sticks", "all: cartoon"])
    assert str(error.value) == none.replace("style:", "representations/1:", 1)
    with pytest.raises(raylane.InvalidValue, match="must not be given with representations"):
        raylane.from_atoms(["C"], [[0, 0, 0]], style="sticks", representations=["all"])


def test_each_symbol_is_its_number():
    *symbols, deuterium, tritium = raylane._atoms._SYMBOLS
    assert len(symbols) == 119
    places = [[9.0 * i, 0, 0] for i in range(121)]
    by_number = raylane.from_atoms([*range(119), 1, 1], places, style="spheres")
    by_symbol = raylane.from_atoms([*map(str.lower, symbols), deuterium, tritium], places, style="spheres")
    assert colors_and_places(by_symbol) == colors_and_places(by_number)
    assert np.array_equal(by_symbol.spheres().radius, by_number.spheres().radius)


def test_a_file_in_a_style(tmp_path):
    path = tmp_path / "water.xyz"
    path.write_text("3\nwater\n" + "".join(f"{s} {x} {y} {z}\n" for s, (x, y, z) in zip(*WATER)))
    assert colors_and_places(raylane.load(path, style="licorice")) == colors_and_places(raylane.from_atoms(*WATER, style="licorice"))
    assert raylane.load(path, representations=["element O: spheres"]).shape_count == 1
    for looks, text in (
        (dict(style="stiks"), "style: must be a style, element or a colour such as red or #ff8000, got"),
        (dict(style="opacity 2"), "style: column 9: opacity must be above 0 and at most 1"),
        (dict(representations=["al: sticks"]), "representations/0: column 1: must be one of all"),
    ):
        for call in (lambda: raylane.load(path, **looks), lambda: raylane.from_atoms(*WATER, **looks)):
            with pytest.raises(raylane.BadInput) as error:
                call()
            assert str(error.value).startswith(text)
    with pytest.raises(raylane.InvalidValue, match="representations: must be a list of texts, got one text"):
        raylane.load(path, representations="all")
    scene = tmp_path / "a.json"
    raylane.load(path).save(scene)
    for looks in (dict(style="sticks"), dict(representations=["all"])):
        with pytest.raises(raylane.BadInput, match=f"^{next(iter(looks))}: goes with a file of atoms, but .*a.json is a scene$"):
            raylane.load(scene, **looks)


def test_a_palette_without_a_number_is_reported():
    for looks, text in (
        (dict(style="sticks palette magma"), "the palette or range of style is ignored"),
        (dict(representations=["all", "all: red range 0 1"]), "the palette or range of representations/1 is ignored"),
    ):
        with pytest.warns(UserWarning, match=f"^{text}, because no colour stands for a number: the atoms have none$"):
            raylane.from_atoms(*WATER, **looks)
    raylane.from_atoms(*WATER, style="spheres charge palette magma", properties={"charge": [0, 1, 2]})  # no warning


PEROVSKITE = (
    ["Sr", "Ti", "O", "O", "O"],
    [[0, 0, 0], [1.95, 1.95, 1.95], [1.95, 1.95, 0], [1.95, 0, 1.95], [0, 1.95, 1.95]],
    3.9 * np.eye(3),
)


def test_options_have_the_words_of_the_command_line(tmp_path):
    count = lambda **options: raylane.from_atoms(*PEROVSKITE, cell_edges=False, style="spheres", **options).shape_count
    assert count() == 8 + 1 + 6
    assert count(boundary=False) == count(boundary="off") == 5
    assert count(boundary=False, repeat=(2, 2, 1)) == 20
    assert count(periodic=False) == 5
    assert count(periodic=(True, True, False)) == 4 + 1 + 1 + 4
    assert count(axes=True) == 15 + 7
    assert count(select="element Ti") == 1
    assert count(hide=["element O", "element Sr"]) == 1
    octahedron = 8 + 12 + 6  # faces, edges, corners
    assert count(polyhedra="Ti") == 15 + octahedron
    scene = raylane.from_atoms(*PEROVSKITE, polyhedra=["Ti opacity 0.5", "Sr"], view=(1, -1, -0.5), perspective=True)
    assert scene.shape_count > 15 + octahedron
    path = tmp_path / "a.xyz"
    lattice = " ".join(map(str, PEROVSKITE[2].ravel()))
    lines = [f"{s} {x} {y} {z}" for s, (x, y, z) in zip(*PEROVSKITE[:2])]
    path.write_text(f'5\nLattice="{lattice}"\n' + "\n".join(lines) + "\n")
    scene = raylane.load(path, cell=True, polyhedra="Ti opacity 0.5", view="corner", color="gray")
    assert colors_and_places(scene) == colors_and_places(
        raylane.from_atoms(*PEROVSKITE, polyhedra="Ti opacity 0.5", view="corner", color="gray")
    )
    assert raylane.load(path, style="spheres", boundary=False).shape_count == 5


def test_the_camera_and_the_frame_have_the_words_of_the_command_line(tmp_path):
    path = tmp_path / "walk.xyz"
    path.write_text("".join(f"2\n\nO {frame} 0 0\nC 0 {frame} 2\n" for frame in range(3)))
    scene = lambda **options: raylane.load(path, **options)
    assert [scene(frame=frame).spheres().center[0, 0] for frame in (0, 1, 2, -1, -3)] == [0, 1, 2, 2, 0]
    with pytest.raises(raylane.BadInput, match="^frame: must select some of the 3 frames that .* has"):
        scene(frame=3)
    assert scene(up="x").camera.up == scene(up=(1, 0, 0)).camera.up == scene(up=np.array([1, 0, 0])).camera.up == (1, 0, 0)
    with pytest.raises(raylane.BadInput, match="^up: must not be parallel to the direction of view$"):
        scene(view="front", up="z")
    once, twice = scene(orthographic=True), scene(orthographic=True, zoom=2)
    assert twice.camera.height == pytest.approx(once.camera.height / 2)
    assert scene(depth_cue=0).fog.kind == "none" != scene().fog.kind
    assert scene(depth_cue=0.6).fog.end < scene().fog.end
    with pytest.raises(raylane.BadInput, match="^depth_cue: must be a number from 0 to 0.99, got"):
        scene(depth_cue=1)
    with pytest.raises(raylane.BadInput, match="^zoom: must be a number from 0.01 to 1000, got"):
        scene(zoom=0)
    # Paler atoms have the colours of other values, unless this is requested.
    values = lambda **options: raylane.from_atoms(*WATER, color="charge", properties={"charge": [0, 1, 2]}, **options)
    assert values().fog.kind == "none" != values(depth_cue=0.3).fog.kind


def test_looks_cuts_backgrounds_and_views_have_the_words_of_the_command_line(tmp_path):
    atoms = lambda **options: raylane.from_atoms(*PEROVSKITE, cell_edges=False, style="spheres", **options)
    assert atoms(cut="z<-1").shape_count == 6  # four Sr, an O, and a face
    cuts = ["z<-1", "x < -1"]
    counts = {atoms(cut=cut).shape_count for cut in (cuts, tuple(cuts), [(0, 0, 1, -1), (1, 0, 0, -1)])}
    assert len(counts) == 1 and 0 not in counts
    planes = ((0, 0, 1, -1), [0, 0, 1, -1], np.array([0, 0, 1, -1.0]), "0,0,1,-1")
    assert {atoms(cut=plane).shape_count for plane in planes} == {6}
    slabs = ((-1, 1), [-1, 1], np.array([-1, 1]), "-1:1", "-1 1", "-1,1")
    assert len({atoms(view="c", slab=slab).shape_count for slab in slabs}) == 1
    for background in ((0.25, 0.5, 1), [0.25, 0.5, 1.0], np.array([0.25, 0.5, 1]), "0.25,0.5,1"):
        assert atoms(background=background).background == (0.25, 0.5, 1)
    atoms(view="c", look="flat", background="#204060").save(tmp_path / "a.json")
    scene = json.loads((tmp_path / "a.json").read_text())
    assert scene["camera"]["view"] == [0, 0, -1]
    assert scene["background"] == pytest.approx([0.0144, 0.0513, 0.117], abs=1e-3)
    assert all(material["diffuse"] == 0 for material in scene["materials"].values())
    with pytest.raises(raylane.BadInput, match="^cut: must leave a part of the atoms, got none") as caught:
        atoms(cut="z<-9")
    assert caught.value.errors[0].file == "cut"
    with pytest.raises(raylane.BadInput, match='^hydrogen_bonds: must be on or off, got "maybe"'):
        atoms(hydrogen_bonds="maybe")
    with pytest.raises(raylane.BadInput, match="^cut and slab: must leave a part"):
        atoms(cut="z<1", view="z", slab=(1, 3), radius=0.1)


def test_unknown_options_are_refused(tmp_path):
    for options in (dict(size="8.5cm"), dict(transparent_shadows=False)):
        with pytest.raises(raylane.InvalidValue, match=f"^{next(iter(options))}: is an argument of render$"):
            raylane.from_atoms(*WATER, **options)
    for options, text in (
        (dict(polyhedron="Ti"), 'polyhedron: must be the name of an option, did you mean "polyhedra"?'),
        (dict(boundary="yes"), 'boundary: must be on or off, got "yes"'),
        (dict(repeat=(2, 2)), "repeat: must be the number of cells along each edge"),
        (dict(probability=100), "probability: must be a number from 1 to 99"),
        (dict(probability=50), "probability: goes with ellipsoids, ellipses or octants"),
        (dict(axes=True), "axes: must have a cell whose edges they show"),
    ):
        with pytest.raises(raylane.BadInput) as error:
            raylane.from_atoms(*WATER, **options)
        assert str(error.value).startswith(text)
    with pytest.raises(raylane.InvalidValue, match="color: must be a text, a number, True or False, got {}"):
        raylane.from_atoms(*WATER, color={})
    path = tmp_path / "a.json"
    path.write_text("{}")
    with pytest.raises(raylane.BadInput, match="cell: goes with a file of atoms"):
        raylane.load(path, cell=True)
