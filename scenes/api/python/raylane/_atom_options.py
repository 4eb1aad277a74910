"""Options for the look of atoms, as texts in the words of the command line."""

from __future__ import annotations

import dataclasses
import re
from numbers import Real
from typing import Any, Callable, List, Mapping, Optional, Sequence, Tuple, TypeVar

import numpy as np

from ._errors import BadInput, InvalidValue
from ._values import Settings

_T = TypeVar("_T")

# options of which several values are meant
_LISTS = ("show", "hide", "polyhedra", "cut", "label", "labels", "distance", "distances")
_SEPARATORS = {"repeat": "x", "view": ",", "up": ",", "cut": ",", "background": ","}


def _is_numbers(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(isinstance(x, Real) for x in value)


def _text(name: str, value: Any) -> str:
    """Returns the words of one value: of a text, a number, a flag, or a list of numbers."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, Real):
        return repr(value)
    if _is_numbers(value):
        return _SEPARATORS.get(name, " ").join(repr(x) for x in value)
    raise InvalidValue(name, f"must be a text, a number, True or False, got {value!r:.40}")


def _texts(representations: Sequence[str]) -> List[str]:
    if isinstance(representations, str):
        raise InvalidValue("representations", "must be a list of texts, got one text")
    if not isinstance(representations, (list, tuple)):
        raise InvalidValue("representations", f"must be a list of texts, got {representations!r:.40}")
    for index, text in enumerate(representations):
        if not isinstance(text, str):
            raise InvalidValue(f"representations/{index}", f"must be a text, got {text!r:.40}")
    return list(representations)


def looks(representations: Optional[Sequence[str]], style: Optional[str]) -> Optional[Sequence[str]]:
    """Returns the representations, or those of a style."""
    if style is None:
        return representations
    if representations is not None:
        raise InvalidValue("style", "must not be given with representations, which have styles of their own")
    if not isinstance(style, str):
        raise InvalidValue("style", f"must be a text, got {style!r:.40}")
    return [f"all: {style}"]


def atom_options(
    style: Optional[str], representations: Optional[Sequence[str]], options: Mapping[str, Any]
) -> List[Tuple[str, str]]:
    """Returns names and texts of options. Raises InvalidValue for a value that has no text."""
    shown = looks(representations, style)
    texts = [("representations", text) for text in _texts([] if shown is None else shown)]
    of_render = {field.name for field in dataclasses.fields(Settings)} | {"camera", "crop", "dpi", "size"}
    for name, value in options.items():
        if name in of_render:
            raise InvalidValue(name, "is an argument of render")
        if value is None:
            continue
        if isinstance(value, (np.ndarray, np.generic)):
            value = value.tolist()
        several = name in _LISTS and isinstance(value, (list, tuple)) and not _is_numbers(value)
        texts += [(name, _text(name, one)) for one in (value if several else [value])]
    return texts


def _in_python(message: str) -> str:
    """Returns a message with the names of options in Python: hydrogen_bonds in place of --hydrogen-bonds."""
    message = message.replace("--frames", "--frame")
    suggestion = re.search(r'must be the name of an option, did you mean "(.*)"', message)
    if suggestion:
        message = message.replace(suggestion[1], suggestion[1].replace("-", "_"))
    return re.sub(r"(?<![\w-])--([a-z][a-z-]*)", lambda name: name[1].replace("-", "_"), message)


def _of_style(message: str) -> str:
    """Returns a message about the representation of a style as one about the style."""
    column = re.match(r"representations/0: column (\d+)", message)
    if column:
        return f"style: column {int(column[1]) - len('all: ')}{message[column.end():]}"
    return message.replace("representations/0", "style").replace("representations: ", "style: ")


def read_atoms(
    read: Callable[[List[Tuple[str, str]], Callable[[str], object]], _T],
    style: Optional[str],
    representations: Optional[Sequence[str]],
    options: Mapping[str, Any],
    on_remark: Callable[[str], object],
) -> _T:
    """Returns ``read(texts, on_remark)`` for options. Messages name the style if there is one."""
    texts = atom_options(style, representations, options)

    def named(message: str) -> str:
        return _in_python(message if style is None else _of_style(message))

    try:
        return read(texts, lambda remark: on_remark(named(remark)))
    except BadInput as error:
        mistakes = [each._replace(file=named(each.file), message=named(each.message)) for each in error.errors]
        raise BadInput(named(str(error)), mistakes) from None
