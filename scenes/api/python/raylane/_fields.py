"""Base class of objects that accept only the attributes of their class."""

from __future__ import annotations

import difflib
from typing import TYPE_CHECKING, Any, ClassVar, FrozenSet, Iterable


def suggestion(name: str, known: Iterable[str]) -> str:
    """Returns the end of a message, with the known name that is most like a wrong one."""
    near = difflib.get_close_matches(name, sorted(known), 1)
    return f', did you mean "{near[0]}"?' if near else ""


class Fields:
    """Raises AttributeError if an attribute that the class does not declare is set.

    Otherwise a misspelled attribute would be set and ignored. Classes that users derive accept any attribute.
    """

    _fields_of_class: ClassVar[FrozenSet[str]]

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        names = (name for base in cls.__mro__ for name in getattr(base, "__annotations__", ()))
        cls._fields_of_class = frozenset(name for name in names if not name.startswith("_"))

    if not TYPE_CHECKING:  # type checkers would accept any attribute

        def __setattr__(self, name: str, value: Any) -> None:
            kind = type(self)
            is_ours = kind.__module__.startswith("raylane.")
            if is_ours and name not in kind._fields_of_class and not name.startswith("_") and not hasattr(kind, name):
                meant = suggestion(name, kind._fields_of_class)
                raise AttributeError(f'{kind.__name__} has no attribute "{name}"{meant}')
            super().__setattr__(name, value)
