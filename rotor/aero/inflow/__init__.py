"""Inflow models of forward flight behind one interface, by name."""

import pkgutil
from importlib import import_module

from rotor.aero.inflow.interface import DiskFlow as DiskFlow
from rotor.aero.inflow.interface import InflowModel as InflowModel


def shipped() -> dict[str, InflowModel]:
    """`MODELS` of every file in this folder, by name: first what the load does not change, last what lays a wake."""
    files = (import_module(f"{__name__}.{one.name}") for one in pkgutil.iter_modules(__path__))
    models: list[InflowModel] = [model for file in files for model in getattr(file, "MODELS", ())]
    return {m.name: m for m in sorted(models, key=lambda m: (m.load_dependent, m.wake_along is not None))}


INFLOW_MODELS = shipped()
"""Forward-flight inflow models by name, from the simplest to the most detailed."""


def inflow_model(name: str) -> InflowModel:
    """The model of that name; ValueError lists the names for any other."""
    if name not in INFLOW_MODELS:
        raise ValueError(f"inflow model {name!r} is not known: use one of {', '.join(INFLOW_MODELS)}")
    return INFLOW_MODELS[name]
