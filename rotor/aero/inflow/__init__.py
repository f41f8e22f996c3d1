"""Inflow models of forward flight behind one interface, by name."""

from rotor.aero.inflow import lifting_line, linear, local_momentum
from rotor.aero.inflow.interface import DiskFlow as DiskFlow
from rotor.aero.inflow.interface import InflowModel as InflowModel
from rotor.support.user_input import check_known

MODELS: tuple[InflowModel, ...] = (*linear.MODELS, *local_momentum.MODELS, *lifting_line.MODELS)
"""From the simplest to the most detailed."""
INFLOW_MODELS = {model.name: model for model in MODELS}
"""Forward-flight inflow models by name."""


def inflow_model(name: str) -> InflowModel:
    """The model of that name; ValueError lists the names for any other."""
    check_known("inflow model", name, INFLOW_MODELS)
    return INFLOW_MODELS[name]
