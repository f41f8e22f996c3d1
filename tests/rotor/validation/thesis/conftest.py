"""Reports are made once for all tests of this folder."""

from collections.abc import Callable
from functools import cache

import pytest

from rotor.validation.thesis.catalogue import find_entry
from rotor.validation.thesis.report import Report


@cache
def _made(number: str) -> Report:
    return find_entry(number).make()


@pytest.fixture(scope="session")
def report() -> Callable[[str], Report]:
    """A report by its number; the same object every time."""
    return _made
