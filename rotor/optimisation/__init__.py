"""The twist of least power: concepts, objective, limits, search, schedule."""

from rotor.optimisation.concepts import CONCEPTS, Concept, Parameter, find_concept, nearest
from rotor.optimisation.limits import even_change_limit
from rotor.optimisation.mission import (
    FlightLeg,
    Mission,
    mission_at,
    mission_from,
    standard_flight,
    standard_mission,
)
from rotor.optimisation.objective import (
    Objective,
    WeightedCondition,
    at_condition,
    evaluate_objective,
    evaluate_objectives,
    hover_and_cruise,
)
from rotor.optimisation.results import Progress
from rotor.optimisation.schedule import Schedule, ScheduleOptimum, SchedulePlan, run_plan
from rotor.optimisation.search import Search, optimise, run_search

__all__ = (
    "CONCEPTS", "Concept", "FlightLeg", "Mission", "Objective", "Parameter", "Progress", "Schedule",
    "ScheduleOptimum", "SchedulePlan", "Search", "WeightedCondition", "at_condition", "evaluate_objective",
    "evaluate_objectives", "even_change_limit", "find_concept", "hover_and_cruise", "mission_at", "mission_from",
    "nearest", "optimise", "run_plan", "run_search", "standard_flight", "standard_mission",
)  # fmt: skip
