"""The twist of least power: concepts, objective, limits, search, schedule."""

from rotor.optimisation.concepts import CONCEPTS, Concept, Parameter, find_concept, nearest
from rotor.optimisation.limits import even_change_limit
from rotor.optimisation.objective import (
    Objective,
    WeightedCondition,
    at_condition,
    hover_and_cruise,
    measure,
    measure_many,
)
from rotor.optimisation.results import Progress
from rotor.optimisation.schedule import Cell, Plan, Schedule, run_plan
from rotor.optimisation.search import Search, optimise, run_search

__all__ = (
    "CONCEPTS",
    "Cell",
    "Concept",
    "Objective",
    "Parameter",
    "Plan",
    "Progress",
    "Schedule",
    "Search",
    "WeightedCondition",
    "at_condition",
    "even_change_limit",
    "find_concept",
    "hover_and_cruise",
    "measure",
    "measure_many",
    "nearest",
    "optimise",
    "run_plan",
    "run_search",
)
