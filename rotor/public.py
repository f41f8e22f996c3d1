"""What `rotor` offers. It is slow to read, so `rotor` reads it with the first name that is asked for."""

from rotor import actuator
from rotor.actuator import failure, with_actuator
from rotor.aero.elements import TrimState
from rotor.columns.blade import Freedom
from rotor.design.aircraft import Aircraft, FlightCondition
from rotor.design.blade import Rotor
from rotor.design.design import Design, Models
from rotor.design.gust import Gust
from rotor.design.twist import parse_twist
from rotor.files.design_file import load_design
from rotor.files.make_design import make_design
from rotor.files.rotor_file import load_rotor
from rotor.optimisation.limits import Limits
from rotor.optimisation.results import Optimum
from rotor.optimisation.search import optimise
from rotor.optimisation.vibration import t_matrix, vibration_front
from rotor.study.run import run_study
from rotor.study.series import SweepTable, plot_power, schedule, sweep
from rotor.trim.adjoint import PitchGradient
from rotor.trim.analysis import power_gradient
from rotor.trim.distribution import Distribution, distribution
from rotor.trim.doubt import doubt
from rotor.trim.export import plot_field, save_solution, solution_record
from rotor.trim.hub_loads import hub_loads
from rotor.trim.many import solve_many
from rotor.trim.power import PowerBudget
from rotor.trim.solution import Caveat, Solution, Status
from rotor.trim.solve import solve

__all__ = (
    "Aircraft", "Caveat", "Design", "Distribution", "FlightCondition", "Freedom", "Gust", "Limits", "Models",
    "Optimum", "PitchGradient", "PowerBudget", "Rotor", "Solution", "Status", "SweepTable", "TrimState", "actuator",
    "distribution", "doubt", "failure", "hub_loads", "load_design", "load_rotor", "make_design", "optimise",
    "parse_twist", "plot_field", "plot_power", "power_gradient", "run_study", "save_solution", "schedule",
    "solution_record", "solve", "solve_many", "sweep", "t_matrix", "vibration_front", "with_actuator",
)  # fmt: skip
