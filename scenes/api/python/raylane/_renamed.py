"""Old names, which work for one version with a DeprecationWarning."""

from __future__ import annotations

import functools
import warnings
from typing import TYPE_CHECKING, Any, Callable, Dict, Tuple, TypeVar

import numpy as np
from numpy.typing import NDArray

AnyClass = TypeVar("AnyClass", bound=type)


def _warn(old: str, new: str, level: int = 3) -> None:
    warnings.warn(f"{old} is now {new}", DeprecationWarning, stacklevel=level)


def renamed(old: str, new: str) -> Callable[[AnyClass], AnyClass]:
    """Returns a decorator of a class that keeps the old name of an attribute, also as a keyword of the constructor."""

    def keep(kind: AnyClass) -> AnyClass:
        create = getattr(kind, "__init__")

        @functools.wraps(create)
        def create_by_either(self: Any, *values: Any, **named: Any) -> None:
            if old in named:
                _warn(f"{kind.__name__}({old}=...)", f"{kind.__name__}({new}=...)")
                named[new] = named.pop(old)
            create(self, *values, **named)

        def get(self: Any) -> Any:
            _warn(f"{kind.__name__}.{old}", new)
            return getattr(self, new)

        def put(self: Any, value: Any) -> None:
            _warn(f"{kind.__name__}.{old}", new)
            setattr(self, new, value)

        setattr(kind, "__init__", create_by_either)
        setattr(kind, old, property(get, put))
        return kind

    return keep


def renamed_class(old: str, kind: AnyClass) -> AnyClass:
    """Returns the class, for the attribute ``old`` of the module, and warns."""
    _warn(old, kind.__name__)
    return kind


def take_renamed(named: Dict[str, Any], old: str, new: str, default: Any) -> Any:
    """Removes the argument of the old name from ``named``, and returns its value, or the default."""
    if old not in named:
        return default
    _warn(f"{old}=...", f"{new}=...")
    return named.pop(old)


class ShapeOfHits(Tuple[int, ...]):
    """The shape of the arrays of hits, at the name that the ids of the hits had.

    It is a tuple. Indexing by arrays, comparisons with numbers or arrays, ``tolist`` and ``astype`` act on the ids.
    """

    _ids: NDArray[np.uint32]

    def ids(self, level: int = 4) -> NDArray[np.uint32]:
        """Returns the ids, and warns. ``level``: that of the user in the stack."""
        _warn("Hits.shape is the shape of the arrays: their array of ids", "Hits.shape_id", level)
        return self._ids

    if not TYPE_CHECKING:

        def __getitem__(self, key):
            return tuple.__getitem__(self, key) if isinstance(key, (int, slice, np.integer)) else self.ids()[key]

        def __eq__(self, other):
            return self.ids() == other if isinstance(other, _OF_IDS) else tuple.__eq__(self, other)

        def __ne__(self, other):
            return self.ids() != other if isinstance(other, _OF_IDS) else tuple.__ne__(self, other)

        __hash__ = tuple.__hash__

        def tolist(self):
            return self.ids().tolist()

        def astype(self, *values, **named):
            return self.ids().astype(*values, **named)


_OF_IDS = (int, np.integer, np.ndarray)


def ids_in(shapes: Any, level: int = 5) -> Any:
    """Returns the ids if an argument is the shape of hits, and any other argument unchanged."""
    return shapes.ids(level) if isinstance(shapes, ShapeOfHits) else shapes
