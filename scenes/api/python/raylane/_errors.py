"""Exceptions of the package. All except ``SystemRefused`` are ``ValueError``."""

from __future__ import annotations

from typing import Any, List, NamedTuple, Tuple


class InvalidValue(ValueError):
    """Raised for an invalid value in a scene or an invalid argument."""

    field: str
    """Name of the value, such as ``"3/radius"``; may be empty."""
    expectation: str
    """The valid values, such as ``"must be positive, got -1"``."""

    def __init__(self, field: str, expectation: str) -> None:
        super().__init__(f"{field}: {expectation}" if field else expectation)
        self.field = field
        self.expectation = expectation

    def __reduce__(self) -> Tuple[Any, ...]:
        return InvalidValue, (self.field, self.expectation)


class InputError(NamedTuple):
    """One mistake in a file."""

    file: str
    line: int
    """From 1; 0 if the mistake has no position in the text."""
    column: int
    place: str
    """JSON pointer of the value, such as ``"/objects/3/radius"``; may be empty."""
    message: str


class BadInput(ValueError):
    """Raised for malformed input, an unknown format or a missing file.

    The message gives the file, the place in it and the expected value. ``errors``: one entry per mistake.
    """

    errors: List[InputError]

    def __init__(self, text: str, errors: List[InputError]) -> None:
        super().__init__(text)
        self.errors = errors

    def __reduce__(self) -> Tuple[Any, ...]:
        return BadInput, (str(self), self.errors)


class SystemRefused(OSError):
    """Raised if the system fails to read or write a file."""
