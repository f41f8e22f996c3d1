"""Inflow in forward flight: one model a file behind one interface, and the mathematics of the wakes."""

from rotor.aero.inflow.interface import InflowModel as InflowModel
from rotor.aero.inflow.models import INFLOW_MODELS as INFLOW_MODELS
from rotor.aero.inflow.models import inflow_model as inflow_model
from rotor.aero.inflow.wake_state import Wake as Wake
