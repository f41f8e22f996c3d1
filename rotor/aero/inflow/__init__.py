"""Inflow models of forward flight behind one interface, by name."""

from rotor.aero.inflow.interface import DiskFlow as DiskFlow
from rotor.aero.inflow.interface import InflowModel as InflowModel
from rotor.aero.inflow.lifting_line import LiftingLineInflow
from rotor.aero.inflow.linear import LINEAR_MODELS
from rotor.aero.inflow.local_momentum import LocalMomentumInflow

_MODELS: tuple[InflowModel, ...] = (*LINEAR_MODELS, LocalMomentumInflow(), LiftingLineInflow())

INFLOW_MODELS: dict[str, InflowModel] = {model.name: model for model in _MODELS}
"""Forward-flight inflow models by name, from the simplest to the most detailed."""


def inflow_model(name: str) -> InflowModel:
    """The model of that name; ValueError lists the names for any other."""
    if name not in INFLOW_MODELS:
        raise ValueError(f"inflow model {name!r} is not known: use one of {', '.join(INFLOW_MODELS)}")
    return INFLOW_MODELS[name]
