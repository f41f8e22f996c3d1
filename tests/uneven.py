"""Inflow models that are solved on few elements, finer towards the tip, and on few or many azimuths."""

from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.inflow.linear import LinearInflow
from rotor.design.design import Models

ELEMENTS, AZIMUTHS = 24, {"few azimuths": 24, "many azimuths": 120}


class OwnGrid(LinearInflow):
    """Linear inflow on a grid of its own."""

    fine_tip = True

    def grid(self, models: Models, blades: int) -> tuple[int, int]:
        del models, blades
        return ELEMENTS, AZIMUTHS[self.name]


@contextmanager
def uneven_models() -> Iterator[None]:
    """Pitt and Peters' inflow on the two grids, as `few azimuths` and `many azimuths`."""
    like = INFLOW_MODELS["pitt-peters"]
    assert isinstance(like, LinearInflow)
    with pytest.MonkeyPatch.context() as patch:
        for name in AZIMUTHS:
            patch.setitem(INFLOW_MODELS, name, OwnGrid(name, name, "", like.longitudinal, like.lateral))
        yield
