"""What several tests of the solver share."""

import pytest

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
