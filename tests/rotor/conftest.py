"""What several tests of the solver share."""

from collections.abc import Iterator

import pytest
from patched import Patch, patching

from rotor.engine.linearise import Point
from rotor.engine.newton import Factors


@pytest.fixture
def evaluated(monkeypatch: pytest.MonkeyPatch) -> list[Factors]:
    """Every evaluation of derivatives from here on."""
    made, of = list[Factors](), Factors.of

    def counted(point: Point) -> Factors:
        made.append(of(point))
        return made[-1]

    monkeypatch.setattr(Factors, "of", counted)
    return made


@pytest.fixture
def patch() -> Iterator[Patch]:
    """For what cached functions read: every cache is emptied with each change, and at the end."""
    with patching() as patch:
        yield patch
