"""Atoms of ASE, MDAnalysis and mdtraj, drawn as raylane draws files of atoms."""

from __future__ import annotations

import io
from typing import Any, Iterator, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike

from ._errors import InvalidValue
from ._scene import Scene, parse


def from_atoms(symbols: Sequence[str], positions: ArrayLike, cell: Optional[ArrayLike] = None) -> Scene:
    """Atoms by the symbols of their elements and positions (n, 3) in angstrom, as an XYZ file of them is drawn.

    ``cell``: (3, 3), vectors as rows; it is drawn, too.
    """
    places = np.asarray(positions, dtype=np.float64)
    if places.ndim != 2 or places.shape[1] != 3 or len(places) != len(symbols):
        raise InvalidValue("positions", f"must have the shape ({len(symbols)}, 3), got {places.shape}")
    comment = "Properties=species:S:1:pos:R:3"
    if cell is not None:
        vectors = " ".join(repr(float(x)) for x in np.asarray(cell, dtype=np.float64).reshape(9))
        comment = f'Lattice="{vectors}" {comment}'
    text = io.StringIO()
    text.write(f"{len(symbols)}\n{comment}\n")
    for symbol, (x, y, z) in zip(symbols, places.tolist()):
        text.write(f"{symbol} {x!r} {y!r} {z!r}\n")
    return parse(text.getvalue(), "atoms.xyz")


def from_ase(atoms: Any) -> Scene:
    """Of ``ase.Atoms``, with their cell if they have one."""
    cell = np.asarray(atoms.get_cell())
    return from_atoms(atoms.get_chemical_symbols(), atoms.get_positions(), cell if np.any(cell) else None)


def _element(name: str) -> str:
    """Of an atom that only has a name, as "CA" or "1HB": its first letter."""
    letters = "".join(c for c in name if c.isalpha())
    return letters[:1].upper() or "X"


def from_mdanalysis(atoms: Any) -> Scene:
    """Of MDAnalysis' ``AtomGroup`` or ``Universe``, as they are in its current frame."""
    group = atoms.atoms
    if hasattr(group, "elements"):
        symbols = [str(e).capitalize() or _element(n) for e, n in zip(group.elements, group.names)]
    else:
        symbols = [_element(str(name)) for name in group.names]
    return from_atoms(symbols, group.positions)


def from_mdtraj(trajectory: Any, frame: int = 0) -> Scene:
    """Of a frame of mdtraj's ``Trajectory``, whose nanometres become angstroms."""
    symbols = [
        atom.element.symbol if atom.element is not None else _element(atom.name) for atom in trajectory.topology.atoms
    ]
    return from_atoms(symbols, 10.0 * trajectory.xyz[frame].astype(np.float64))


def frames(trajectory: Any) -> Iterator[Scene]:
    """Scenes of a trajectory, one after the other: ASE's list of atoms, MDAnalysis' universe or atoms, or mdtraj's."""
    if hasattr(trajectory, "xyz"):
        for frame in range(len(trajectory.xyz)):
            yield from_mdtraj(trajectory, frame)
    elif hasattr(trajectory, "universe"):
        for _ in trajectory.universe.trajectory:
            yield from_mdanalysis(trajectory)
    else:
        for atoms in trajectory:
            yield from_ase(atoms)
