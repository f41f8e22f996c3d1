"""Inflow in forward flight: one file a model, one name in `models`, one seam for all."""

from rotor.inflow.models import INFLOW_MODELS as INFLOW_MODELS
from rotor.inflow.models import inflow_model as inflow_model
from rotor.inflow.seam import InflowModel as InflowModel
from rotor.inflow.wake import Wake as Wake
