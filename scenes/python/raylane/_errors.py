"""What can go wrong. All but ``SystemRefused`` are ``ValueError``."""

from __future__ import annotations

from typing import Any, List, NamedTuple, Tuple


class InvalidValue(ValueError):
    """A value that no scene may hold, or that no function may be called with."""

    field: str
    """Which, as ``"3/radius"``; it may be empty."""
    expectation: str
    """What it must be."""

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
    """From 1; 0 where the mistake has no place in the text."""
    column: int
    place: str
    """The JSON pointer of a value; it may be empty."""
    message: str


class BadInput(ValueError):
    """A file that cannot be meant. The text names the file, the place in it and what was expected there."""

    errors: List[InputError]

    def __init__(self, text: str, errors: List[InputError]) -> None:
        super().__init__(text)
        self.errors = errors

    def __reduce__(self) -> Tuple[Any, ...]:
        return BadInput, (str(self), self.errors)


class SystemRefused(OSError):
    """The system would not read or write."""
