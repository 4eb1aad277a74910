"""Scenes from atoms of ASE, MDAnalysis and mdtraj, in the style of scenes from files of atoms."""

from __future__ import annotations

import io
from numbers import Integral
from typing import Any, Callable, Iterator, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _raylane
from ._atom_options import looks, read_atoms
from ._errors import InvalidValue
from ._scene import Scene, _warn


_LIMIT = 1e30  # maximum magnitude of a coordinate, as in all scenes


def _numbers(values: ArrayLike, shape: Tuple[int, ...], field: str) -> NDArray[np.float64]:
    """Returns coordinates as an array of float64. Raises InvalidValue for another shape or invalid numbers."""
    if isinstance(values, np.ma.MaskedArray) and np.any(values.mask):
        raise InvalidValue(
            field, "must have no masked values: omit them, or fill them by numpy.ma.filled()"
        )
    try:
        array = np.asarray(values)
    except (TypeError, ValueError):
        raise InvalidValue(field, "must be an array of numbers") from None
    if array.dtype.kind not in "biuf":
        raise InvalidValue(field, f"must be an array of numbers, got one of {array.dtype}")
    if array.shape != shape:
        raise InvalidValue(field, f"must have the shape {shape}, got {array.shape}")
    numbers = array.astype(np.float64)
    wrong = np.argwhere(~(np.abs(numbers) <= _LIMIT))  # true for NaN as well
    if len(wrong) > 0:
        row, column = wrong[0].tolist()
        got = float(numbers[row, column])
        raise InvalidValue(f"{field}/{row}/{column}", f"must be a number from -1e30 to 1e30, got {got!r}")
    return numbers


_SYMBOLS = dict.fromkeys(
    "X H He Li Be B C N O F Ne Na Mg Al Si P S Cl Ar K Ca Sc Ti V Cr Mn Fe Co Ni Cu Zn Ga Ge As Se Br Kr Rb Sr Y Zr Nb Mo"
    " Tc Ru Rh Pd Ag Cd In Sn Sb Te I Xe Cs Ba La Ce Pr Nd Pm Sm Eu Gd Tb Dy Ho Er Tm Yb Lu Hf Ta W Re Os Ir Pt Au Hg Tl"
    " Pb Bi Po At Rn Fr Ra Ac Th Pa U Np Pu Am Cm Bk Cf Es Fm Md No Lr Rf Db Sg Bh Hs Mt Ds Rg Cn Nh Fl Mc Lv Ts Og"
    " D T".split()
)
"""Symbols of an unknown element, of all elements by number, and of hydrogen's isotopes."""


def _symbol(symbol: Any, index: int) -> str:
    """Returns an element's symbol or number as one word of an XYZ file. Raises InvalidValue for anything else."""
    if isinstance(symbol, Integral) and 0 <= int(symbol) <= 118:
        return str(int(symbol))
    if not isinstance(symbol, str):
        got = repr(symbol) if not isinstance(symbol, Integral) or abs(int(symbol)) < 10**9 else "a larger number"
        raise InvalidValue(f"symbols/{index}", f"must be an element's symbol, or number up to 118, got {got}")
    if not symbol or " " in symbol or not symbol.isprintable():
        raise InvalidValue(f"symbols/{index}", f"must be an element's symbol, without spaces, got {symbol[:40]!r}")
    if symbol.capitalize() not in _SYMBOLS and not (symbol.isascii() and symbol.isdigit() and len(symbol) <= 3):
        raise InvalidValue(f"symbols/{index}", f"must be an element's symbol, or X if it is unknown, got {symbol[:40]!r}")
    return symbol


def _words(values: Sequence[Any], count: int, field: str) -> List[str]:
    """Returns one word of an XYZ file for each atom, "_" for an empty one. Raises InvalidValue for other values."""
    words = [str(value).strip() or "_" for value in values]
    if len(words) != count:
        raise InvalidValue(field, f"must have {count} values, one for each atom, got {len(words)}")
    for index, word in enumerate(words):
        if any(c.isspace() for c in word) or not word.isprintable():
            raise InvalidValue(f"{field}/{index}", f"must be a word without spaces, got {word[:40]!r}")
    return words


def _column(values: Any, count: int, name: str) -> Tuple[str, List[str]]:
    """Returns a property of an XYZ file and its values."""
    field = f"properties/{name}"
    if not name.isidentifier():
        raise InvalidValue("properties", f"must have names of letters, digits and _, got {name[:40]!r}")
    numbers = np.asarray(values)
    if numbers.shape != (count,) or numbers.dtype.kind not in "biuf":
        raise InvalidValue(field, f"must be {count} numbers, one for each atom")
    return f"{name}:R:1", [repr(x) for x in numbers.astype(np.float64).tolist()]


def from_atoms(
    symbols: Sequence[Union[str, int]],
    positions: ArrayLike,
    cell: Optional[ArrayLike] = None,
    *,
    style: Optional[str] = None,
    representations: Optional[Sequence[str]] = None,
    names: Optional[Sequence[str]] = None,
    residue_names: Optional[Sequence[str]] = None,
    residue_numbers: Optional[Sequence[int]] = None,
    chains: Optional[Sequence[str]] = None,
    properties: Optional[Mapping[str, ArrayLike]] = None,
    periodic: Union[bool, Sequence[bool]] = True,
    on_remark: Callable[[str], object] = _warn,
    **options: Any,
) -> Scene:
    """Returns a scene of atoms, in the style of a scene from an XYZ file.

    ``symbols``: n symbols or numbers (0 to 118) of elements, X or 0 for an unknown one. ``positions``: (n, 3), in
    angstrom. ``cell``: (3, 3), with the cell's vectors as rows, in angstrom; the scene includes its edges unless a vector
    is zero, or ``cell_edges`` is False. ``periodic``: whether the cell repeats along its vectors, or along each.
    Coordinates are finite, from -1e30 to 1e30.

    ``style``: the look of all atoms, such as ``"sticks"`` or ``"cartoon rainbow"``. Cartoons, tubes and traces need
    names and residues. ``representations``: texts such as ``"ligand: sticks carbons orange"`` or ``"protein: spheres
    white opacity 0.3 + sticks"``, in the words of the option ``--show`` of ``raylane render``. Only the atoms that they
    select are visible. Later ones replace earlier ones of the same atoms. Default: all atoms in one look.

    The others, each of length n, are for selections and colours: the atoms' ``names``, the names and numbers of their
    residues, their ``chains``, and ``properties``, which maps names such as ``"charge"`` to numbers.

    Other options have the names of the options of ``raylane render``, with ``_`` for ``-``, and their words as a text, a
    number, True, or a list: ``color``, ``palette``, ``range``, ``radius``, ``scale``, ``select``, ``hide``, ``opacity``,
    ``repeat`` (``(2, 2, 1)``), ``axes``, ``boundary``, ``whole``, ``polyhedra`` (``"Ti opacity 0.6"``),
    ``hydrogen_bonds``, ``view`` (also ``"best"``, ``"a"``, ``"b"``, ``"c"``), ``up``, ``zoom``, ``depth_cue``,
    ``perspective``, ``orthographic``, ``look``, ``background`` and ``slab`` (``(-2, 2)``). ``cut``: ``"z<middle"``,
    numbers ``(a, b, c, d)`` for a x + b y + c z <= d, or a list of these. Outlines of a ``look`` are as thick on a larger
    image. Files with displacements have ``ellipsoids``, ``ellipses``, ``octants`` and ``probability``, too.

    Annotations are options, too. Images of the scene have them, or an SVG file (``annotations`` of :func:`render`).
    ``labels``: texts such as ``"resn LIG: {resi}"``. ``distances``: texts such as ``"index 1: index 5"``. ``legend`` and
    ``legend_title``. ``scale_bar``: True for a round length, or a length in angstrom. ``triad``: ``"xyz"``, ``"abc"``, or
    True for the axes of the cell, if there is one. ``font``, and ``font_size`` in points at 300 pixels per inch; default:
    1/32 of the image's height, at least 10 pixels. Scenes of :meth:`Scene.seen_by` keep annotations, but pickled scenes
    and those of :meth:`Scene.with_positions` do not.

    Calls ``on_remark`` for names that select nothing; default: a warning. Raises :class:`InvalidValue`, fields
    ``"symbols/0"``, ``"positions/0/2"``, ``"cell/0/2"``, ``"names/0"``, ..., and :class:`BadInput` for a malformed
    representation, with its column, and for an unknown option.
    """
    if "frame" in options:
        raise InvalidValue("frame", "goes with load")
    if isinstance(symbols, (str, bytes)):  # the characters of "H2O" would count as elements, 2 as helium
        raise InvalidValue("symbols", f"must be a list of symbols or numbers, got {symbols[:40]!r}")
    words = [_symbol(symbol, index) for index, symbol in enumerate(symbols)]
    if not words:
        raise InvalidValue("symbols", "must have at least one atom, got none")
    count = len(words)
    places = _numbers(positions, (count, 3), "positions")
    columns = [("species:S:1", words), ("pos:R:3", [f"{x!r} {y!r} {z!r}" for x, y, z in places.tolist()])]
    for column, values, field in (
        ("name:S:1", names, "names"),
        ("resname:S:1", residue_names, "residue_names"),
        ("resid:I:1", None if residue_numbers is None else [int(n) for n in residue_numbers], "residue_numbers"),
        ("chain:S:1", chains, "chains"),
    ):
        if values is not None:
            columns.append((column, _words(values, count, field)))
    columns += [_column(values, count, name) for name, values in (properties or {}).items()]
    comment = "Properties=" + ":".join(column for column, _ in columns)
    edges_shown = False
    if cell is not None:
        edges = _numbers(cell, (3, 3), "cell")
        vectors = " ".join(repr(x) for x in edges.ravel().tolist())
        flags = " ".join("T" if flag else "F" for flag in np.broadcast_to(np.asarray(periodic, dtype=bool), 3))
        comment = f'Lattice="{vectors}" pbc="{flags}" {comment}'
        edges_shown = bool(edges.astype(np.float32).any(axis=1).all())
    text = io.StringIO()
    text.write(f"{count}\n{comment}\n")
    for row in zip(*(values for _, values in columns)):
        text.write(" ".join(row) + "\n")
    data = text.getvalue().encode()
    return read_atoms(
        lambda texts, remarks: Scene(_raylane.parse_atoms(data, "atoms", texts, remarks), "look" in options),
        style,
        representations,
        {"cell_edges": edges_shown or None, **options},
        on_remark,
    )


def from_ase(
    atoms: Any, representations: Optional[Sequence[str]] = None, *, style: Optional[str] = None, **options: Any
) -> Scene:
    """Returns a scene of ``ase.Atoms``, with their cell if they have one.

    ``representations``, ``style`` and other options: as in :func:`from_atoms`. Selections know the names, residues and
    numbers that ASE reads from PDB files, and arrays of one number per atom.
    """
    representations = looks(representations, style)
    cell = np.asarray(atoms.get_cell())
    arrays = atoms.arrays if representations is not None or options else {}
    known = ("numbers", "positions", "atomtypes", "residuenames", "residuenumbers")
    properties = {
        "b_factor" if name == "bfactor" else name: values
        for name, values in arrays.items()
        if name not in known and name.isidentifier() and values.ndim == 1 and values.dtype.kind in "biuf"
    }
    return from_atoms(
        atoms.get_chemical_symbols(),
        atoms.get_positions(),
        cell if np.any(cell) else None,
        periodic=atoms.get_pbc(),
        representations=representations,
        names=arrays.get("atomtypes"),
        residue_names=arrays.get("residuenames"),
        residue_numbers=arrays.get("residuenumbers"),
        properties=properties,
        **options,
    )


def _element(name: str) -> str:
    """Returns the element of an atom that has only a name, such as "CA" or "1HB": the first letter."""
    letter = "".join(c for c in name if c.isalpha())[:1].upper()
    return letter if letter in _SYMBOLS else "X"


def from_mdanalysis(
    atoms: Any, representations: Optional[Sequence[str]] = None, *, style: Optional[str] = None, **options: Any
) -> Scene:
    """Returns a scene of an ``AtomGroup`` or ``Universe`` of MDAnalysis, in its current frame.

    ``representations``, ``style`` and other options: as in :func:`from_atoms`. Selections and colours know names,
    residues, chains (``chainIDs``, or ``segids`` without them), ``b_factor`` (``tempfactors``), ``occupancy`` and ``charge``.
    """
    representations = looks(representations, style)
    group = atoms.atoms
    if hasattr(group, "elements"):
        elements = [str(element).strip().capitalize() for element in group.elements]
        symbols = [e if e in _SYMBOLS else _element(str(name)) for e, name in zip(elements, group.names)]
    else:
        symbols = [_element(str(name)) for name in group.names]
    if representations is None and not options:
        return from_atoms(symbols, group.positions)
    chains = getattr(group, "chainIDs", None)
    if chains is None or not any(chains):
        chains = getattr(group, "segids", None)
    numbers = {"b_factor": "tempfactors", "occupancy": "occupancies", "charge": "charges"}
    return from_atoms(
        symbols,
        group.positions,
        representations=representations,
        names=getattr(group, "names", None),
        residue_names=getattr(group, "resnames", None),
        residue_numbers=getattr(group, "resids", None),
        chains=chains,
        properties={name: getattr(group, of) for name, of in numbers.items() if hasattr(group, of)},
        **options,
    )


def from_mdtraj(
    trajectory: Any,
    frame: int = 0,
    representations: Optional[Sequence[str]] = None,
    *,
    style: Optional[str] = None,
    **options: Any,
) -> Scene:
    """Returns a scene of one frame of a ``Trajectory`` of mdtraj. Converts nanometres to angstrom.

    ``representations``, ``style`` and other options: as in :func:`from_atoms`. Selections know names, residues, and
    chains by their letters, or by their numbers from 0 if the letters are unknown.
    """
    representations = looks(representations, style)
    atoms = list(trajectory.topology.atoms)
    elements = [atom.element.symbol.capitalize() if atom.element is not None else "" for atom in atoms]
    symbols = [e if e in _SYMBOLS else _element(atom.name) for e, atom in zip(elements, atoms)]
    positions = 10.0 * trajectory.xyz[frame].astype(np.float64)
    if representations is None and not options:
        return from_atoms(symbols, positions)
    residues = [atom.residue for atom in atoms]
    return from_atoms(
        symbols,
        positions,
        representations=representations,
        names=[atom.name for atom in atoms],
        residue_names=[residue.name for residue in residues],
        residue_numbers=[residue.resSeq for residue in residues],
        chains=[getattr(residue.chain, "chain_id", None) or str(residue.chain.index) for residue in residues],
        **options,
    )


def frames(
    trajectory: Any, representations: Optional[Sequence[str]] = None, **options: Any
) -> Iterator[Scene]:
    """Yields a scene for each frame: of mdtraj's trajectory, MDAnalysis' universe or atoms, or ASE's list of atoms.

    ``representations`` and other options: as in :func:`from_atoms`.
    """
    if hasattr(trajectory, "xyz"):
        for frame in range(len(trajectory.xyz)):
            yield from_mdtraj(trajectory, frame, representations, **options)
    elif hasattr(trajectory, "universe"):
        for _ in trajectory.universe.trajectory:
            yield from_mdanalysis(trajectory, representations, **options)
    else:
        for atoms in trajectory:
            yield from_ase(atoms, representations, **options)
