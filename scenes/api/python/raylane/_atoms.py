"""Scenes from atoms of ASE, MDAnalysis and mdtraj, in the style of scenes from files of atoms."""

from __future__ import annotations

import io
from numbers import Integral
from typing import Any, Iterator, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _raylane
from ._errors import InvalidValue
from ._scene import Scene


_MOST = 1e30  # maximum magnitude of a coordinate, as in all scenes


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
    wrong = np.argwhere(~(np.abs(numbers) <= _MOST))  # true for NaN as well
    if len(wrong) > 0:
        row, column = wrong[0].tolist()
        got = float(numbers[row, column])
        raise InvalidValue(f"{field}/{row}/{column}", f"must be a number from -1e30 to 1e30, got {got!r}")
    return numbers


def _symbol(symbol: Any, index: int) -> str:
    """Returns an element's symbol or number as one word of an XYZ file. Raises InvalidValue for anything else."""
    if isinstance(symbol, Integral) and 0 <= int(symbol) <= 118:
        return str(int(symbol))
    if not isinstance(symbol, str):
        got = repr(symbol) if not isinstance(symbol, Integral) or abs(int(symbol)) < 10**9 else "a larger number"
        raise InvalidValue(f"symbols/{index}", f"must be an element's symbol, or number up to 118, got {got}")
    if not symbol or " " in symbol or not symbol.isprintable():
        raise InvalidValue(f"symbols/{index}", f"must be an element's symbol, without spaces, got {symbol[:40]!r}")
    return symbol


def from_atoms(
    symbols: Sequence[Union[str, int]], positions: ArrayLike, cell: Optional[ArrayLike] = None
) -> Scene:
    """Returns a scene of atoms, in the style of a scene from an XYZ file.

    ``symbols``: n symbols or numbers (0 to 118) of elements. ``positions``: (n, 3), in angstrom. ``cell``: (3, 3), with
    the cell's vectors as rows, in angstrom; the scene includes its edges unless a vector is zero. Coordinates are
    finite, from -1e30 to 1e30. Raises :class:`InvalidValue`, fields ``"symbols/0"``, ``"positions/0/2"``,
    ``"cell/0/2"``, ...
    """
    if isinstance(symbols, (str, bytes)):  # the characters of "H2O" would count as elements, 2 as helium
        raise InvalidValue("symbols", f"must be a list of symbols or numbers, got {symbols[:40]!r}")
    words = [_symbol(symbol, index) for index, symbol in enumerate(symbols)]
    if not words:
        raise InvalidValue("symbols", "must have at least one atom, got none")
    places = _numbers(positions, (len(words), 3), "positions")
    comment = "Properties=species:S:1:pos:R:3"
    show_cell = False
    if cell is not None:
        edges = _numbers(cell, (3, 3), "cell")
        vectors = " ".join(repr(x) for x in edges.ravel().tolist())
        comment = f'Lattice="{vectors}" {comment}'
        show_cell = bool(edges.astype(np.float32).any(axis=1).all())
    text = io.StringIO()
    text.write(f"{len(words)}\n{comment}\n")
    for word, (x, y, z) in zip(words, places.tolist()):
        text.write(f"{word} {x!r} {y!r} {z!r}\n")
    return Scene(_raylane.parse_atoms(text.getvalue().encode(), "atoms.xyz", show_cell))


def from_ase(atoms: Any) -> Scene:
    """Returns a scene of ``ase.Atoms``, with their cell if they have one."""
    cell = np.asarray(atoms.get_cell())
    return from_atoms(atoms.get_chemical_symbols(), atoms.get_positions(), cell if np.any(cell) else None)


def _element(name: str) -> str:
    """Returns the element of an atom that has only a name, such as "CA" or "1HB": the first letter."""
    letters = "".join(c for c in name if c.isalpha())
    return letters[:1].upper() or "X"


def from_mdanalysis(atoms: Any) -> Scene:
    """Returns a scene of an ``AtomGroup`` or ``Universe`` of MDAnalysis, in its current frame."""
    group = atoms.atoms
    if hasattr(group, "elements"):
        symbols = [str(e).strip().capitalize() or _element(n) for e, n in zip(group.elements, group.names)]
    else:
        symbols = [_element(str(name)) for name in group.names]
    return from_atoms(symbols, group.positions)


def from_mdtraj(trajectory: Any, frame: int = 0) -> Scene:
    """Returns a scene of one frame of a ``Trajectory`` of mdtraj. Converts nanometres to angstrom."""
    symbols = [
        atom.element.symbol if atom.element is not None else _element(atom.name) for atom in trajectory.topology.atoms
    ]
    return from_atoms(symbols, 10.0 * trajectory.xyz[frame].astype(np.float64))


def frames(trajectory: Any) -> Iterator[Scene]:
    """Yields a scene for each frame: of mdtraj's trajectory, MDAnalysis' universe or atoms, or ASE's list of atoms."""
    if hasattr(trajectory, "xyz"):
        for frame in range(len(trajectory.xyz)):
            yield from_mdtraj(trajectory, frame)
    elif hasattr(trajectory, "universe"):
        for _ in trajectory.universe.trajectory:
            yield from_mdanalysis(trajectory)
    else:
        for atoms in trajectory:
            yield from_ase(atoms)
