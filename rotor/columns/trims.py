"""The equations of equilibrium in forward flight and on test stands.

A trim is a list of quantities that are solved for and, one for each, the equations that have to be met. With
T = Σ F_z, H = Σ (F_x sin ψ + F_r cos ψ − β F_z cos ψ) and the flap moments M = Σ (r − e) F_z, all in units of C_T (a
blade that flaps leans its lift inboard),

    vertical     T cos α + H sin α = C_W            carries the weight
    forward      T sin α − H cos α = D              pulls the airframe's drag
    thrust       T = √(C_W² + D²)                   the resultant, or the thrust given on a test stand
    torque       Σ r F_x = 0                        the air turns the rotor
    coning       M_0 = (ν² β0 + weight − preload)/Γ
    flapping     2 M_1c = (ν² − 1) β1c/Γ,  2 M_1s = (ν² − 1) β1s/Γ
    hub moments  Σ r F_z sin ψ, −Σ r F_z cos ψ = those given on a test stand, roll and pitch
    momentum     2 λ0 V = T,  V = √(µ_x² + (µ_z + λ0)²)     (2.30) with the axial flow of the tilted disk

`propulsive` (flight preset): collective, cyclic, shaft tilt and coning; first-harmonic flapping has its given value.
`thrust` (thesis preset): collective and free flapping; no cyclic. Rigid blades have neither flapping nor cyclic among
their unknowns, and the hub carries the moments. On a test stand no force is balanced. `wind-tunnel`: the collective
gives the thrust, or is given. `free-rotor`: the shaft tilt takes the torque away. `controls`: flapping and inflow are
all that remain. With hub moments given, cyclic gives them and the blades flap as they like. A hub that fixes the coning
leaves it out of the unknowns.
"""

import math
from dataclasses import dataclass, replace

from rotor.aero.elements import TrimState, Unknown
from rotor.aero.problem import Problem
from rotor.aero.section import FZ
from rotor.columns.bending import FLAPPING_STATES, bends
from rotor.design.design import Design
from rotor.design.quantities import Flapping
from rotor.engine.terms import Structure, Sum
from rotor.engine.waves import COS, SIN, STEADY


@dataclass(frozen=True)
class Trim:
    """A way to trim: as many equations as unknowns."""

    unknowns: tuple[Unknown, ...]
    """The quantities solved for; all others keep their given values."""
    equations: tuple[str, ...]


_FORCES: dict[str, list[tuple[Unknown, str]]] = {
    "propulsive": [("collective", "vertical"), ("shaft_tilt", "forward")],
    "thrust": [("collective", "thrust")],
    "wind-tunnel": [("collective", "thrust")],
    "free-rotor": [("shaft_tilt", "torque"), ("collective", "thrust")],
    "controls": [],
}
"""Unknowns and equations of each trim beside flapping and inflow; with the collective given it is no unknown."""


def trim_of(design: Design) -> Trim:
    """The unknowns and equations that a design solves."""
    models, stand = design.models, design.condition.stand
    pairs = list(_FORCES[models.trim])
    if stand is not None and stand.collective is not None:
        pairs = [pair for pair in pairs if pair[0] != "collective"]
    if design.flaps:  # Rigid blades do not flap, and no cyclic keeps the rotor from rolling.
        if design.rotor.precone is None:
            pairs.append(("coning", "coning"))
        if _flapping(design) == "trimmed":
            pairs += [("cyclic_1c", "flap_1c"), ("cyclic_1s", "flap_1s")]
        else:
            pairs += [("flap_1c", "flap_1c"), ("flap_1s", "flap_1s")]
        if _flapping(design) == "hub-moments":
            pairs += [("cyclic_1c", "pitching"), ("cyclic_1s", "rolling")]
    unknowns, equations = zip(*pairs, ("lambda0", "momentum"), strict=True)
    return Trim(unknowns, equations)


def _flapping(design: Design) -> Flapping:
    """What cyclic does to blades that flap, as `Stand.flapping` names it."""
    if design.condition.stand is not None:
        return design.condition.stand.flapping
    return "trimmed" if design.models.trim == "propulsive" else "free"


def with_given_values(problem: Problem, start: TrimState) -> TrimState:
    """The start with every quantity that is not solved for at its given value."""
    design = problem.design
    condition, models, stand = design.condition, design.models, design.condition.stand
    given: dict[str, float] = {}
    if not design.flaps:
        cyclic = {"cyclic_1c": stand.cyclic_1c, "cyclic_1s": stand.cyclic_1s} if stand else {}
        given |= {
            "coning": 0.0,
            "cyclic_1c": 0.0,
            "cyclic_1s": 0.0,
            "flap_1c": 0.0,
            "flap_1s": 0.0,
        } | cyclic
    elif _flapping(design) == "trimmed":
        given |= {"flap_1c": condition.flap_1c, "flap_1s": condition.flap_1s}
    elif _flapping(design) == "free":
        given |= {
            "cyclic_1c": stand.cyclic_1c if stand else 0.0,
            "cyclic_1s": stand.cyclic_1s if stand else 0.0,
        }
    if models.flapping and design.rotor.precone is not None:
        given["coning"] = design.rotor.precone
    if models.trim == "thrust":
        given["shaft_tilt"] = math.atan2(problem.drag, problem.weight)
    if stand is not None:
        if models.trim != "free-rotor":
            given["shaft_tilt"] = stand.tilt
        if stand.collective is not None:
            given["collective"] = stand.collective
    return replace(start, **given)


def trim_numbers(problem: Problem) -> dict[str, float]:
    """Values of the numbers in these equations."""
    flap, design = problem.flap, problem.design
    stand, unit = design.condition.stand, design.thrust_unit * design.rotor.radius
    return {
        "weight": problem.weight,
        "drag": problem.drag,
        "resultant": math.hypot(problem.weight, problem.drag),
        "coning stiffness": flap.frequency_squared / flap.load_gain,
        "flap stiffness": (flap.frequency_squared - 1.0) / flap.load_gain,
        "blade weight": flap.droop / flap.load_gain,
        "hub roll": (stand.hub_roll if stand else 0.0) / unit,
        "hub pitch": (stand.hub_pitch if stand else 0.0) / unit,
    }


def declare_equations(s: Structure, trim: Trim) -> None:
    """The equations of a trim, without terms, but for those of flapping in the place of which a blade bends."""
    for name in trim.equations:
        if not (name in FLAPPING_STATES and bends(s)):
            s.equation(name)


def add_equations(s: Structure, trim: Trim, drag: Sum, torque: Sum) -> None:
    """Add the terms of the equations in the head of this file; H and C_Q: of `power_of_air`."""
    z, q = {**s.numbers, **s.states, **s.derived}, s.measure
    thrust = q(FZ, "one", STEADY)
    for name in trim.equations:
        if name not in s.equations:
            continue
        row = s.equations[name]
        match name:
            case "vertical" | "forward":
                by_thrust, by_drag, sign, load = (
                    (z["cos"], z["sin"], 1.0, "weight")
                    if name == "vertical"
                    else (z["sin"], z["cos"], -1.0, "drag")
                )
                s.term(row, 1.0, by_thrust, q=thrust)
                for share, atom, _, measure in drag:
                    s.term(row, sign * share, by_drag, atom, measure)
                s.term(row, -1.0, z[load])
            case "thrust":
                s.term(row, 1.0, q=thrust)
                s.term(row, -1.0, z["resultant"])
            case "torque":
                for share, i, j, measure in torque:
                    s.term(row, share, i, j, measure)
            case "coning":
                s.term(row, 1.0, q=q(FZ, "arm", STEADY))
                s.term(row, -1.0, z["coning stiffness"], z["coning"])
                s.term(row, -1.0, z["blade weight"])
            case "pitching" | "rolling":
                sign, wave, given = (
                    (-1.0, COS, "hub pitch") if name == "pitching" else (1.0, SIN, "hub roll")
                )
                s.term(row, sign, q=q(FZ, "r", wave))
                s.term(row, -1.0, z[given])
            case "flap_1c" | "flap_1s":
                s.term(row, 2.0, q=q(FZ, "arm", COS if name == "flap_1c" else SIN))
                s.term(row, -1.0, z["flap stiffness"], z[name])
            case _:
                s.term(row, 2.0, z["lambda0"], z["speed"])
                s.term(row, -1.0, q=thrust)
