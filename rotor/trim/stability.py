"""Stability of the trimmed blade: damping and frequency of its modes, and how far it is from flutter and divergence.

The equations are those of `rotor.trim.blade_system`: constant in hover, periodic in forward flight, where
`rotor.dynamics.periodic` finds the exponents by Hill's matrix. An exponent λ = s + iν [per radian of ψ] is a motion
e^{sψ} of frequency ν [per rev] with the damping ratio ζ = −s/√(s² + ν²).

Margins are those of flap and torsion together, lag held. The blade diverges where the stiffness of torsion with its
flapping, K_φφ − K_φw K_ww⁻¹ K_wφ of the mean over azimuth, is no longer positive. It flutters where an exponent crosses
the imaginary axis as GJ and the stiffness of the control system get less, or as the centre of gravity moves aft all
along the lifting blade. The trim is held as they change: so is the twist with which the blade flies.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from scipy.linalg import eigvals
from scipy.linalg import solve as solve_linear
from scipy.optimize import brentq, linear_sum_assignment

from rotor.design.design import Design
from rotor.dynamics.periodic import Exponents, exponents, growth
from rotor.support.arrays import Array
from rotor.support.assets import package_version
from rotor.trim.analysis import Analysis, analysed
from rotor.trim.blade_system import BladeSystem, blade_system
from rotor.trim.newton import LinearisedTrim
from rotor.trim.solution import Solution
from rotor.trim.solve import analyse

Air = Literal["quasi-steady", "unsteady"]
"""Whether lift follows at once, or with the lag of the vorticity that the section sheds."""
AIRS: tuple[Air, ...] = ("quasi-steady", "unsteady")
HARMONICS = 8
"""Harmonics of Hill's matrix in forward flight: within 0.004 of Floquet's theorem at µ 0.35 (tested)."""
_FEWER = 6
"""For margins, where some sixty matrices are solved, and with states of shed vorticity, whose margins are those of the
mean over azimuth."""
LEAST_STIFFNESS = 0.01
"""Part of the stiffness in torsion below which margins are not searched."""
LARGEST_OFFSET = 0.25
"""[chords]"""
_ALIKE = 1e-2
"""[per rev]"""
_STEP = 0.85
_OFFSETS = 26


@dataclass(frozen=True)
class DampedMode:
    """One mode of the blade in its axes, which turn with the rotor."""

    name: str
    """By what moves most: flap 1, lag 1, torsion 1, … in the order of frequencies in vacuum."""
    frequency: float
    """[per rev]"""
    growth: float
    """Real part of the exponent, per radian of azimuth; negative: it dies away."""

    @property
    def damping_ratio(self) -> float:
        """ζ; 1 of a motion that dies away without oscillating, −1 of one that diverges."""
        size = float(np.hypot(self.growth, self.frequency))
        return -self.growth / size if size else 0.0

    @property
    def stable(self) -> bool:
        return self.growth < 0.0


@dataclass(frozen=True)
class PitchFlapMargins:
    """How far a blade is from flutter and divergence in pitch and flap."""

    instability_stiffness: float
    """The largest part of its stiffness in torsion at which it flutters or diverges; above 1 as it is, 0 where not even
    at `LEAST_STIFFNESS`."""
    divergence_stiffness: float
    """The part at which it diverges; 0 where it never does."""
    offset: float | None
    """How far aft its centre of gravity may move before it flutters or diverges [chords]; 0 where it does as it is,
    None where not even at `LARGEST_OFFSET`."""

    def record(self) -> dict[str, Any]:
        """For `stability --json`."""
        return {
            "instability_stiffness_percent": 100.0 * self.instability_stiffness,
            "divergence_stiffness_percent": 100.0 * self.divergence_stiffness,
            "cg_offset_percent_chord": None if self.offset is None else 100.0 * self.offset,
        }

    @property
    def sentence(self) -> str:
        """For tables and limits."""
        least, offset = self.instability_stiffness, self.offset
        if least >= 1.0:
            return f"It is unstable in pitch and flap: it needs {100.0 * least:.0f} % of its torsional stiffness."
        kind = "diverges" if self.divergence_stiffness >= 0.98 * least else "flutters"
        soft = (
            f"stable down to {100.0 * least:.0f} % of its torsional stiffness, where it {kind}"
            if least > 0.0
            else f"stable at {100.0 * LEAST_STIFFNESS:.0f} % of its torsional stiffness"
        )
        aft = (
            f"with its centre of gravity up to {100.0 * offset:.1f} % of the chord farther aft"
            if offset is not None
            else f"with its centre of gravity {100.0 * LARGEST_OFFSET:.0f} % of the chord farther aft"
        )
        return f"In pitch and flap it is {soft}, and {aft}."


@dataclass(frozen=True)
class Stability:
    """The stability of a trimmed blade."""

    design: Design
    air: Air
    offset: float
    """How far aft of where it is the centre of gravity was moved [chords]."""
    modes: tuple[DampedMode, ...]
    margins: PitchFlapMargins | None
    """None for a blade that is rigid in torsion, and where they were not asked for."""
    stable: bool
    """Whether every exponent dies away, those of shed vorticity too."""

    def mode(self, name: str) -> DampedMode:
        """The mode of a name; KeyError with the names that there are."""
        mode_of_name = next((mode for mode in self.modes if mode.name == name), None)
        if mode_of_name is None:
            raise KeyError(f"no mode {name!r}: there are {', '.join(mode.name for mode in self.modes)}")
        return mode_of_name

    def to_dict(self) -> dict[str, Any]:
        """The record that `rotor stability --json` prints."""
        return {
            "schema": "rotor-explorer stability 1",
            "version": package_version(),
            "rotor": self.design.rotor.name,
            "mu": self.design.condition.advance_ratio,
            "mass_kg": self.design.condition.mass,
            "twist": self.design.twist.spec(),
            "air": self.air,
            "cg_offset_percent_chord": 100.0 * self.offset,
            "stable": self.stable,
            "modes": [
                {
                    "name": mode.name,
                    "frequency_per_rev": mode.frequency,
                    "damping_ratio": mode.damping_ratio,
                    "growth_per_rad": mode.growth,
                }
                for mode in self.modes
            ],
            "margins": None if self.margins is None else self.margins.record(),
        }

    def table(self) -> str:
        """The modes as text, and the margins."""
        lines = [f"{'mode':<11}{'per rev':>8}{'damping':>10}"]
        lines += [f"{m.name:<11}{m.frequency:8.3f}{100.0 * m.damping_ratio:8.1f} %" for m in self.modes]
        if self.margins is not None:
            lines.append(self.margins.sentence)
        return "\n".join(lines)


def stability(
    given: Design | Solution | Analysis,
    *,
    air: Air = "quasi-steady",
    offset: float = 0.0,
    with_margins: bool = True,
    harmonics: int = HARMONICS,
) -> Stability:
    """Modes of the trimmed blade, and its margins to flutter and divergence.

    Parameters:
        given: a design, a solution, or its `rotor.trim.Analysis`.
        air: `quasi-steady`: lift follows at once; `unsteady`: with the lag of the shed vorticity.
        offset: how far the centre of gravity is moved aft along the whole lifting blade [chords], −0.5 to 0.5.
        with_margins: whether to search for the margins, which takes most of the time.
        harmonics: harmonics of Hill's matrix in forward flight.

    Returns:
        Frequencies per revolution, growth per radian of azimuth, and margins where the blade twists elastically.

    Raises:
        RuntimeError: the design does not trim.
        ValueError: the offset or `air` cannot be used, or the blade is rigid.
    """
    if air not in AIRS:
        raise ValueError(f"air {air!r} is not known: use {' or '.join(AIRS)}")
    if not abs(offset) <= 0.5:
        raise ValueError(f"offset {offset:g} of the centre of gravity is outside −0.5…0.5 chords: give less")
    linear = linearised(given)
    design, system = linear.problem.design, blade_system(linear, shed=air == "unsteady")
    harmonics = 0 if design.hovering else harmonics
    elastic = any(name.startswith("torsion") for name in system.names)
    shed = system.lags is not None
    result = exponents(system.at(offset=offset), min(harmonics, _FEWER) if shed else harmonics)
    less = 0 if shed else min(harmonics, _FEWER)
    left = pitch_flap_margins(system, offset, less) if elastic and with_margins else None
    return Stability(design, air, offset, damped_modes(system, result), left, bool(result.values.real.max() < 0.0))


def margins(given: Design | Solution | Analysis) -> PitchFlapMargins:
    """Margins to flutter and divergence with the air's slopes averaged around the azimuth.

    Raises ValueError for a blade that is rigid in torsion, RuntimeError when the design does not trim.
    """
    system = blade_system(linearised(given))
    if not any(name.startswith("torsion") for name in system.names):
        raise ValueError("this blade is rigid in torsion and has no flutter: give its structure in the rotor file")
    return pitch_flap_margins(system)


def linearised(given: Design | Solution | Analysis) -> LinearisedTrim:
    """The equations of a trim. RuntimeError when the design does not trim."""
    return (analyse(given) if isinstance(given, Design) else analysed(given)).adjoint.trim


def damped_modes(system: BladeSystem, result: Exponents) -> tuple[DampedMode, ...]:
    """Exponents as modes, two of them to each mode of the blade in vacuum by which of these moves most."""
    n = len(system.names)
    moved = np.abs(result.motion[:n]) * np.sqrt(system.scale)[:, None]
    shares = moved / np.linalg.norm(result.motion, axis=0)
    rows, places = linear_sum_assignment(np.repeat(shares, 2, axis=0), maximize=True)
    modes: list[DampedMode] = []
    for k, name in enumerate(system.names):
        pair = places[rows // 2 == k]
        first, second = result.values[pair[np.argsort(-shares[k, pair])]]
        both_alike = abs(abs(first.imag) - abs(second.imag)) < _ALIKE  # Conjugates, or two that do not oscillate.
        worst = second if both_alike and second.real > first.real else first
        modes.append(DampedMode(name, abs(float(worst.imag)), float(worst.real)))
    kinds = ("flap", "lag", "torsion")
    return tuple(sorted(modes, key=lambda mode: (kinds.index(mode.name.split()[0]), mode.name)))


def pitch_flap_margins(system: BladeSystem, offset: float = 0.0, harmonics: int = 0) -> PitchFlapMargins:
    """Margins of a blade with modes of torsion, its centre of gravity moved aft by an offset [chords]."""
    held = system.only(("flap", "torsion"))

    def by_stiffness(log: float) -> float:
        return growth(held.at(float(np.exp(log)), offset), harmonics)

    def by_offset(more: float) -> float:
        return growth(held.at(1.0, offset + more), harmonics)

    return PitchFlapMargins(
        instability_stiffness=_least_stiffness(by_stiffness),
        divergence_stiffness=divergence_stiffness(held, offset),
        offset=_crossing(by_offset, np.linspace(0.0, LARGEST_OFFSET, _OFFSETS)),
    )


def _least_stiffness(rate: Callable[[float], float]) -> float:
    """The factor at which a growth crosses zero, down from 1, or up where it is positive there."""
    if rate(0.0) < 0.0:
        down = np.arange(0.0, np.log(LEAST_STIFFNESS) + np.log(_STEP), np.log(_STEP))
        log = _crossing(rate, down)
        return 0.0 if log is None else float(np.exp(log))
    log = _crossing(lambda log: -rate(log), np.arange(0.0, 6.0, -np.log(_STEP)))
    return float("inf") if log is None else float(np.exp(log))


def _crossing(rate: Callable[[float], float], places: Array) -> float | None:
    """The first of ascending or descending places at which a growth becomes positive; None where at none."""
    before = float(places[0])
    if rate(before) >= 0.0:
        return before
    for place in places[1:].tolist():
        if rate(place) >= 0.0:
            return float(brentq(rate, before, place, xtol=1e-5))  # pyright: ignore[reportArgumentType]
        before = place
    return None


def divergence_stiffness(system: BladeSystem, offset: float = 0.0) -> float:
    """The largest factor on stiffness in torsion at which the mean stiffness is singular; 0 where there is none."""
    mean = system.stiffness.mean(axis=0) + offset * system.offset[2].mean(axis=0)
    twisting = np.array([name.startswith("torsion") for name in system.names])
    a, b = ~twisting, twisting
    rest: Array = mean - system.elastic
    followed: Array = solve_linear(rest[np.ix_(a, a)], rest[np.ix_(a, b)])
    condensed: Array = rest[np.ix_(b, b)] - rest[np.ix_(b, a)] @ followed
    factors = -eigvals(condensed, system.elastic[np.ix_(b, b)])
    real = factors.real[np.abs(factors.imag) < 1e-9 * np.abs(factors).max()]
    return max(float(real.max(initial=0.0)), 0.0)


@dataclass(frozen=True)
class BoundaryPoint:
    """Where a blade with one offset of its centre of gravity becomes unstable."""

    offset: float
    """Aft of where it is [chords]."""
    instability_stiffness: float
    """As in `PitchFlapMargins`."""
    divergence_stiffness: float


def stability_boundary(
    given: Design | Solution | Analysis, offsets: tuple[float, ...], *, air: Air = "quasi-steady"
) -> tuple[BoundaryPoint, ...]:
    """The stiffness in torsion that the blade needs in pitch and flap, over offsets of its centre of gravity [chords].

    Empty for a blade that is rigid in torsion. Errors as of `stability`.
    """
    linear = linearised(given)
    system = blade_system(linear, shed=air == "unsteady")
    if not any(name.startswith("torsion") for name in system.names):
        return ()
    constant = linear.problem.design.hovering or system.lags is not None
    held, harmonics = system.only(("flap", "torsion")), 0 if constant else _FEWER
    return tuple(
        BoundaryPoint(
            offset,
            _least_stiffness(lambda log, at=offset: growth(held.at(float(np.exp(log)), at), harmonics)),
            divergence_stiffness(held, offset),
        )
        for offset in offsets
    )
