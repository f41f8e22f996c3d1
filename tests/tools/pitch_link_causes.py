"""What was tried on the missing 2/rev of the UH-60A's pitch-link load: rows of its trust page, anew.

`python -m tests.tools.pitch_link_causes` prints the rows of the table in `assets/trust_sets.toml`: amplitude of 2/rev
[kN] and correlation of the curve at µ 0.2, 0.3 and 0.37. Two minutes.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from rotor import solve
from rotor.aero import elastic, problem
from rotor.aero.disk import Disk
from rotor.aero.elastic import BladeTorsion, build_torsion
from rotor.airfoil.c81 import C81Block
from rotor.airfoil.section_table import N_ALPHA, SectionTable, bicubic_coefficients, mach_nodes
from rotor.arrays import Array
from rotor.design.blade import Rotor
from rotor.design.design import Design
from rotor.validation import airloads

Moment = Callable[[Array, Array, Array, Array], Array]
"""By how much C_m is larger: of α [rad] in a column, the Mach number in a row, C_l and C_m there."""
Blade = Callable[[BladeTorsion, Array], BladeTorsion]
"""The changed torsion of a blade, from it and its `tip_mass` with the centre of gravity a chord aft, (elements,)."""

Row = tuple[tuple[float, ...], tuple[float, ...]]
AT = (0.2, 0.3, 0.37)


def _structure(name: str, factor: float) -> Callable[[Design], Design]:
    def change(design: Design) -> Design:
        blade = design.rotor.blade
        value = getattr(blade.structure, name)
        scaled = tuple(factor * x for x in value) if isinstance(value, tuple) else factor * value
        structure = replace(blade.structure, **{name: scaled})  # type: ignore[type-var]
        return replace(design, rotor=replace(design.rotor, blade=replace(blade, structure=structure)))

    return change


def _shaft(degrees: float) -> Callable[[Design], Design]:
    def change(design: Design) -> Design:
        assert design.condition.stand is not None
        stand = replace(design.condition.stand, shaft_tilt=math.radians(degrees))
        return replace(design, condition=replace(design.condition, stand=stand))

    return change


def _flapping(degrees: float) -> Callable[[Design], Design]:
    return lambda design: replace(design, condition=replace(design.condition, flap_1c=math.radians(degrees)))


def _models(**changes: Any) -> Callable[[Design], Design]:
    return lambda design: replace(design, models=replace(design.models, **changes))


DESIGNS: dict[str, Callable[[Design], Design]] = {
    "as computed": _models(),
    "half the control stiffness": _structure("control_stiffness", 0.5),
    "GJ 20 % less": _structure("torsional_stiffness", 0.8),
    "torsional inertia 15 % more": _structure("torsional_inertia", 1.15),
    "EI in lag 30 % less": _structure("lag_stiffness", 0.7),
    "shaft upright": _shaft(0.0),
    "shaft 10° forward": _shaft(10.0),
    "flapping 2° up over the tail": _flapping(2.0),
    "flapping 2° down over the tail": _flapping(-2.0),
    "Pitt–Peters inflow": _models(inflow="pitt-peters"),
    "local-momentum inflow": _models(inflow="local-momentum"),
    "without bending": _models(bending=False),
    "dynamic stall everywhere": _models(dynamic_stall="on"),
    "steady sections": _models(dynamic_stall="off", unsteady="off"),
}
"""Changes of an input of the design."""

_PLAIN = elastic.moment_table


def _fast(mach: Array, start: float = 0.7, end: float = 0.75) -> Array:
    """0 up to one Mach number, 1 from another on."""
    return np.clip((mach - start) / (end - start), 0.0, 1.0)


def _without_tuck(alpha: Array, mach: Array, lift: Array, moment: Array) -> Array:
    at = int(np.argmin(np.abs(mach - 0.7)))
    return np.where(mach > 0.7, moment[:, [at]] - moment, 0.0)


MOMENTS: dict[str, Moment] = {
    "C_m 0.01 more, everywhere": lambda alpha, mach, lift, moment: 0.01 + 0.0 * lift,
    "C_m 0.02 more, everywhere": lambda alpha, mach, lift, moment: 0.02 + 0.0 * lift,
    "C_m 0.01 more above Mach 0.7": lambda alpha, mach, lift, moment: 0.01 * _fast(mach) + 0.0 * lift,
    "C_m of Mach 0.7 above it: no tuck": _without_tuck,
    "C_m 0.03 less at negative lift above Mach 0.7": lambda alpha, mach, lift, moment: (
        -0.03 * _fast(mach) * np.clip(-lift / 0.1, 0.0, 1.0)
    ),
    "aerodynamic centre 3 % chord forward at Mach 0.8": lambda alpha, mach, lift, moment: (
        0.03 * np.interp(mach, (0.7, 0.8), (0.0, 1.0)) * lift
    ),
    "aerodynamic centre 2 % chord forward": lambda alpha, mach, lift, moment: 0.02 * lift,
}
"""By how much C_m is larger."""
BLADES: dict[str, Blade] = {
    "lift of the swept tip on the pitch axis": lambda torsion, _: replace(torsion, lag=0.0 * torsion.lag),
    "centre of gravity 2 % chord aft": lambda torsion, unit: replace(torsion, tip_mass=torsion.tip_mass + 0.02 * unit),
}


def _table(change: Moment) -> Callable[[SectionTable, float | None], Array]:
    def table(section: SectionTable, only_mach: float | None) -> Array:
        degrees, mach = np.linspace(-180.0, 0.5 * N_ALPHA - 180.0, N_ALPHA + 1), mach_nodes()
        alpha = np.deg2rad(degrees)[:, None]
        moment = section.moment(alpha, mach)
        assert moment is not None
        attached = np.abs(degrees)[:, None] < 90.0
        more = np.where(attached, change(alpha, mach, section(alpha, mach).cl, moment), 0.0)
        return _PLAIN(section, only_mach) + bicubic_coefficients(C81Block(mach, degrees, more))

    return table


def _row(at: Sequence[float], change: Callable[[Design], Design]) -> Row:
    """2/rev [kN] and correlation at these advance ratios."""
    found = list[tuple[float, float]]()
    for curve in airloads.measured_curves():
        if curve.case.test == airloads.PITCH_LINK and curve.case.conditions["mu"] in at:
            load = airloads.agreement(curve, solve(change(curve.case.design())).require())
            found.append((1e-3 * load.amplitude(2), load.correlation))
    return tuple(second for second, _ in found), tuple(correlation for _, correlation in found)


def found_with(words: str, at: Sequence[float] = AT) -> Row:
    """A row of the table: 2/rev [kN] and correlation."""
    plain = problem.build_problem.__defaults__
    try:
        if words in MOMENTS:
            elastic.__dict__["moment_table"] = _table(MOMENTS[words])
            _forget()
        elif words in BLADES:
            problem.__dict__["build_torsion"] = _changed(BLADES[words])
        elif words not in DESIGNS:
            problem.build_problem.__defaults__ = (problem.Truncation(torsion=4),)
        return _row(at, DESIGNS.get(words, _models()))
    finally:
        elastic.__dict__["moment_table"], problem.__dict__["build_torsion"] = _PLAIN, build_torsion
        problem.build_problem.__defaults__ = plain
        _forget()


def _forget() -> None:
    for cached in (elastic.__dict__["_at_unit_density"], build_torsion):
        cached.cache_clear()


def _changed(alter: Blade) -> Callable[..., BladeTorsion]:
    def build(rotor: Rotor, disk: Disk, density: float, *args: Any) -> BladeTorsion:
        structure = rotor.blade.structure
        assert structure is not None
        mass = structure.at(disk.r * rotor.radius, structure.mass_per_length)
        arm = mass * rotor.blade.chord(disk.r) * disk.r * rotor.radius**2
        return alter(
            build_torsion(rotor, disk, density, *args), arm * rotor.blades / (np.pi * rotor.radius**5 * density)
        )

    return build


if __name__ == "__main__":
    for words in (*DESIGNS, *MOMENTS, *BLADES, "four torsion modes"):
        second, curve = found_with(words)
        numbers = ", ".join(f'"{value:.2f}"' for value in (*second, *curve))
        print(f'["{words[:1].upper()}{words[1:]}", {numbers}],', flush=True)
