"""Viewer for ASE: ``ase.visualize.view(atoms, viewer="raylane")``.

ASE from 3.23 on finds the viewer by its entry point. An older ASE knows it once this module is imported, or
``raylane`` is imported after ``ase``.
"""

from __future__ import annotations

from typing import Any, Optional, Tuple

from ._atoms import from_ase


def view_raylane(atoms: Any, *, repeat: Optional[Tuple[int, int, int]] = None, **_: Any) -> None:
    """Renders and shows atoms; of a list, the last. ``repeat``: number of copies along each vector of the cell."""
    last = atoms[-1] if isinstance(atoms, (list, tuple)) else atoms
    from_ase(last if repeat is None else last.repeat(repeat)).show()


class _Viewer:
    """Viewer in the interface of ASE before 3.23."""

    name = "raylane"

    def view(self, atoms: Any, data: Any = None, repeat: Optional[Tuple[int, int, int]] = None) -> None:
        view_raylane(atoms, repeat=repeat)


def _register() -> None:
    try:
        from ase.visualize.external import viewers
    except ImportError:
        return
    viewers.setdefault("raylane", _Viewer())


def __getattr__(name: str) -> Any:
    """Creates the object of the entry point on access, because older versions of ASE lack its class."""
    if name != "VIEWER_ENTRYPOINT":
        raise AttributeError(name)
    from ase.utils.plugins import ExternalViewer

    return ExternalViewer(desc="Images by raylane", module="raylane.ase_viewer")


_register()
