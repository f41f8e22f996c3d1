"""Helicopter main-rotor aerodynamics: trim, power and twist. The UH-60A is the default rotor.

    design = rotor.make_design(twist="linear:-12", mu=0.2)
    solution = rotor.solve(design)
    solution.power.total
    rotor.sweep(design, mu=[0.1, 0.2, 0.3])
    rotor.optimise(design, concept="two-segment").twist
    rotor.schedule(design, mu=[0.0, 0.2, 0.3]).in_flight_gain("linear")
    rotor.actuator.try_actuator("MFC_P1", design, mu=(0.0, 0.3)).net_saving

Conventions:

- SI units and radians. A name that ends in `_deg`, `_kw`, `_kt`, `_kg` or `_m` has that unit.
- ψ = 0 over the tail, counter-clockwise seen from above, advancing side ψ = 90°. r = y/R.
- Arrays over the disk are (radius, azimuth): elements first, azimuths second.
- Velocities are over ΩR. λ is positive down through the disk, U_P likewise. β up, θ nose-up.
- β = β0 + β1c cos ψ + β1s sin ψ (flap-back: β1c < 0). θ = θ0 + θ1c cos ψ + θ1s sin ψ + θ_tw(r), θ_tw(0.75) = 0.
- Shaft tilt α is positive forward: µ_x = µ cos α, µ_z = µ sin α; µ = V/(ΩR) is the *advance ratio*.
- Coefficients are of ρA(ΩR)², ρA(ΩR)³. Solidity is 0.0821 for the UH-60A, with the chord 0.5273 m.

Equation numbers in docstrings are those of M. Lonoce, Helicopter Blade Twist Optimization in Forward Flight, MSc
thesis, Instituto Superior Técnico, 2016 ("the document"), whose misprints are named where they occur.
"""

from rotor.terminal import stop_while_read  # Before what takes half a second to read.

stop_while_read()

from rotor import actuator
from rotor.actuator import failure
from rotor.aero.elements import TrimState
from rotor.assets import package_version
from rotor.columns.blade import Freedom
from rotor.design.aircraft import Aircraft, FlightCondition
from rotor.design.blade import Rotor
from rotor.design.design import Design, Models
from rotor.design.twist import parse_twist
from rotor.files.design_file import load_design
from rotor.files.make_design import make_design
from rotor.files.rotor_file import load_rotor
from rotor.optimisation.limits import Limits
from rotor.optimisation.results import Optimum
from rotor.optimisation.search import optimise
from rotor.optimisation.vibration import t_matrix, vibration_front
from rotor.study.envelope import envelope
from rotor.study.run import run_study
from rotor.study.series import SweepTable, plot_power, schedule, sweep
from rotor.trim.distribution import Distribution, distribution
from rotor.trim.doubt import doubt
from rotor.trim.hub_loads import hub_loads
from rotor.trim.power import PowerBudget
from rotor.trim.solution import Caveat, Solution, Status
from rotor.trim.solve import solve
from rotor.trim.stability import Stability, stability

__version__ = package_version()

__all__ = (
    "Aircraft",
    "Caveat",
    "Design",
    "Distribution",
    "FlightCondition",
    "Freedom",
    "Limits",
    "Models",
    "Optimum",
    "PowerBudget",
    "Rotor",
    "Solution",
    "Stability",
    "Status",
    "SweepTable",
    "TrimState",
    "__version__",
    "actuator",
    "distribution",
    "doubt",
    "envelope",
    "failure",
    "hub_loads",
    "load_design",
    "load_rotor",
    "make_design",
    "optimise",
    "parse_twist",
    "plot_power",
    "run_study",
    "schedule",
    "solve",
    "stability",
    "sweep",
    "t_matrix",
    "vibration_front",
)


def __dir__() -> list[str]:
    return list(__all__)
