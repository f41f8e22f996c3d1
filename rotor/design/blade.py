"""The rotor as built: blade structure, planform, sections along the span, mass, hub."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from rotor.airfoil.sections import OwnSection, Section, install_own, load_installed
from rotor.design.twist import TwistLaw
from rotor.support.arrays import Array


@dataclass(frozen=True)
class BladeStructure:
    """Stiffness, inertia and mass along one blade; linear between stations and constant beyond."""

    radius: float
    """Radius of the tip [m]."""
    stations: tuple[float, ...]
    """Radii [m], ascending."""
    torsional_stiffness: tuple[float, ...]
    """GJ [N m²]"""
    mass_per_length: tuple[float, ...]
    """[kg/m]"""
    torsional_inertia: tuple[float, ...]
    """I_θ about the pitch axis [kg m]."""
    tension_gyration: float
    """k_A² [m²], the square of the polar radius of gyration of the part that carries the tension."""
    clamp: float
    """Radius of the pitch bearing [m], where the control system holds the blade."""
    control_stiffness: float
    """K_θ of pitch link, swashplate and their supports, as a moment per pitch of one blade [N m/rad]."""
    pitch_horn: float
    """Distance of the pitch link from the pitch axis [m]."""
    flap_stiffness: tuple[float, ...] = ()
    """EI in flap [N m²]; empty where it is not known, as the next."""
    lag_stiffness: tuple[float, ...] = ()
    """EI in lag [N m²]"""
    lag_damper: float = 0.0
    """Rate of a linear damper at the lag hinge [N m s/rad]."""
    lag_spring: float | None = None
    """Spring rate of the root in lag [N m/rad]; None: a hinge is free, a hingeless root is held."""

    def __post_init__(self) -> None:
        bending = tuple(
            stiffness for stiffness in (self.flap_stiffness, self.lag_stiffness) if stiffness
        )
        columns = (self.torsional_stiffness, self.mass_per_length, self.torsional_inertia, *bending)
        if len(self.stations) < 2 or any(len(column) != len(self.stations) for column in columns):
            raise ValueError(
                f"a blade structure has {len(self.stations)} stations: give two or more, with one stiffness, mass and "
                "inertia each"
            )
        if any(low >= high for low, high in pairwise(self.stations)):
            raise ValueError(
                f"blade structure stations {list(self.stations)} must ascend: sort them"
            )
        smallest = min(min(column) for column in columns)
        if (
            min(smallest, self.control_stiffness, self.pitch_horn) <= 0.0
            or self.tension_gyration < 0.0
        ):
            raise ValueError(
                "stiffness, mass, inertia and pitch horn of a blade structure must be positive: check the rotor file"
            )
        if len(bending) == 1:
            raise ValueError(
                "a blade structure has only one of flap and lag stiffness: give both, or neither"
            )

    @property
    def bends(self) -> bool:
        """Whether the bending stiffness of the blade is known."""
        return bool(self.flap_stiffness)

    def at(self, r: ArrayLike, values: tuple[float, ...]) -> Array:
        """A distribution, given by its `values` at `stations`, at the radii r [m]; same shape as r."""
        return np.interp(np.asarray(r, dtype=float), self.stations, values)

    def centrifugal_force(self, r: ArrayLike, angular_speed: float, steps: int = 400) -> Array:
        """F_c(r) = Ω² ∫_r^R m ρ dρ [N] at r [m]."""
        grid = np.linspace(0.0, self.radius, steps + 1)
        pull = self.at(grid, self.mass_per_length) * grid
        strips = 0.5 * (pull[1:] + pull[:-1]) * np.diff(grid)
        outward = np.concatenate((np.cumsum(strips[::-1])[::-1], [0.0]))
        return angular_speed**2 * np.interp(np.asarray(r, dtype=float), grid, outward)


@dataclass(frozen=True)
class Span:
    """A stretch of blade with one section; the gap to the next span is blended linearly."""

    start: float
    """r/R of the inner end."""
    end: float
    """r/R of the outer end."""
    section: str
    """Name of the section data, for example sc1095."""

    def __post_init__(self) -> None:
        if not 0.0 <= self.start < self.end <= 1.0:
            raise ValueError(
                f"span of {self.section} runs {self.start:g}…{self.end:g}: give 0 ≤ start < end ≤ 1"
            )


@dataclass(frozen=True)
class Carried:
    """An actuator on the blades, by what it adds to them and to the aircraft: enough to fly it without its own data."""

    name: str
    """With its drive, in words: `MFC P1 at 1 155 V`."""
    spec: str
    """As `rotor.actuator.with_actuator` reads it."""
    aircraft_kg: float
    """On board, within the mass of the flight condition."""
    blade_kg: float
    span_m: tuple[float, float]
    """Ends of the active span."""
    inertia_kg_m: float
    """Torsional inertia per length."""
    added_gj_nm2: float
    gj_factor: float
    """GJ of the blade before it is added, over that of the blade as built."""
    sourced: bool = False
    """Whether all its values have a source."""


@dataclass(frozen=True)
class Blade:
    """A blade: planform, sections, hinges and mass; lengths in metres, stations r = y/R."""

    root_cutout: float
    """r/R where the lifting blade begins."""
    chord_stations: tuple[float, ...]
    """r/R, ascending."""
    chords: tuple[float, ...]
    """Reference chord [m] at those stations, linear between; a section's own chord ratio multiplies it."""
    spans: tuple[Span, ...]
    """Sections, root to tip."""
    flap_hinge: float
    """Hinge offset e/R."""
    flap_inertia: float
    """Second mass moment about the flap hinge [kg m²]."""
    flap_static_moment: float
    """First mass moment about the flap hinge [kg m]."""
    mass: float
    """[kg]"""
    flap_spring: float = 0.0
    """K of the spring at the flap hinge [N m/rad]."""
    flap_rest: float = 0.0
    """Coning angle at which that spring is free of load [rad]: the built-in precone."""
    hingeless: bool = False
    """Whether hinge and spring stand for an elastic root, and the blade is rigid without spring; one that bends is then
    held at its clamp."""
    tip_sweep: float = 0.0
    """Sweep of the tip [rad], positive aft."""
    tip_sweep_start: float = 1.0
    """r/R where the swept tip begins."""
    surface_drag: float = 1.0
    """Drag of the real surface over that of the section data [-]."""
    own_sections: tuple[OwnSection, ...] = ()
    """Section data supplied by the user, which spans may name as well as the bundled ones."""
    structure: BladeStructure | None = None
    """Torsional stiffness, inertia and mass; None where unknown: the blade is then rigid in torsion."""
    carried: Carried | None = None
    """The actuator on it, whose mass and stiffness are in the numbers above."""

    def __post_init__(self) -> None:
        if len(self.chord_stations) != len(self.chords) or not self.chords:
            raise ValueError(
                f"{len(self.chord_stations)} chord stations but {len(self.chords)} chords: give one chord per station"
            )
        if not self.spans:
            raise ValueError(
                "a blade needs at least one section span: add one with start, end and section"
            )
        if not 0.0 < self.root_cutout < 0.9:
            raise ValueError(
                f"root cut-out {self.root_cutout:g} is outside 0…0.9: give it as a fraction of the radius"
            )
        if not (abs(self.tip_sweep) <= 1.05 and 0.3 <= self.tip_sweep_start <= 1.0):
            raise ValueError(
                f"tip sweep {math.degrees(self.tip_sweep):g}° from {self.tip_sweep_start:g} R: give ±60° from 0.3…1 R"
            )
        if min(self.flap_inertia, self.mass, *self.chords) <= 0.0:
            raise ValueError(
                "blade chord, mass and flap inertia must be positive: check the rotor file"
            )

    @property
    def rigid(self) -> bool:
        """Whether the blade cannot flap: it is fixed to the hub and has no elastic root."""
        return self.hingeless and not self.flap_spring

    def chord(self, r: ArrayLike) -> Array:
        """Reference chord [m] at r = y/R."""
        return np.interp(np.asarray(r, dtype=float), self.chord_stations, self.chords)

    def sweep(self, r: ArrayLike, radius: float) -> Array:
        """Sweep of the quarter chord [rad] as the flow sees it: over one chord, centred on the kink, it grows smoothly.

        Isobars do not kink with the planform. `radius` is R [m].
        """
        width = float(self.chord(self.tip_sweep_start)) / radius
        t = np.clip((np.asarray(r, dtype=float) - self.tip_sweep_start) / width + 0.5, 0.0, 1.0)
        return self.tip_sweep * t * t * (3.0 - 2.0 * t)

    def installed(self, name: str) -> Section:
        """The section `name` with table and outline, the user's or a bundled one; ValueError for an unknown name."""
        supplied = next((section for section in self.own_sections if section.name == name), None)
        return install_own(supplied) if supplied else load_installed(name)

    @property
    def follows_reynolds(self) -> bool:
        """Whether a section has data of several Reynolds numbers."""
        return any(section.decks for section in self.own_sections)

    def reynolds(self, section: Section, r: ArrayLike, per_metre: float) -> Array:
        """Reynolds number of a section's chord at Ωr, its mean around the azimuth at any advance ratio; r = y/R.

        per_metre: ΩR over the kinematic viscosity [1/m]. The mean of U_T = Ω(r + µ sin ψ) leaves out reverse flow.
        """
        return per_metre * np.asarray(r, dtype=float) * self.chord(r) * section.chord_ratio

    def mixture(self, r: float, per_metre: float) -> tuple[tuple[Section, float], ...]:
        """Sections at r = y/R with their shares, each with the table of one Reynolds number; per_metre as above."""
        inner, outer, weight = self.section_at(r)
        parts = list[tuple[Section, float]]()
        for name, share in ((inner, 1.0 - weight), (outer, weight)):
            if share > 0.0:
                section = self.installed(name)
                at = section.at(float(self.reynolds(section, r, per_metre)))
                parts += [(each, share * part) for each, part in at]
        return tuple(parts)

    def section_at(self, r: float) -> tuple[str, str, float]:
        """Inner section, outer section and the weight of the outer one (0 within a span) at r = y/R."""
        for inner, outer in zip(self.spans, self.spans[1:], strict=False):
            if r <= inner.end:
                return inner.section, inner.section, 0.0
            if r < outer.start:
                return inner.section, outer.section, (r - inner.end) / (outer.start - inner.end)
        return self.spans[-1].section, self.spans[-1].section, 0.0


@dataclass(frozen=True, repr=False)
class Rotor:
    """A main rotor: its blades, its hub and the speed at which it turns, in SI units and radians; no arrays."""

    name: str
    blade: Blade
    blades: int
    radius: float
    """R [m]"""
    angular_speed: float
    """Ω [rad/s]"""
    reference_chord: float
    """Chord [m] on which the quoted solidity is based."""
    builtin_twist: TwistLaw
    precone: float | None = None
    """Coning angle that the hub fixes [rad], as a gimbal or a teetering bar does; None: the blades cone freely."""

    own_speed: float | None = field(default=None, repr=False)
    """Ω as built [rad/s] where the rotor turns at another; None where it turns as built."""

    def __post_init__(self) -> None:
        if self.blades < 2 or self.radius <= 0.0 or self.angular_speed <= 0.0:
            raise ValueError(
                f"rotor {self.name!r} has {self.blades} blades, radius {self.radius:g} m, "
                f"{self.angular_speed:g} rad/s: "
                "give two or more blades and positive values"
            )

    def __repr__(self) -> str:
        size = f"{self.blades} blades, R {self.radius:.4g} m, tip speed {self.tip_speed:.4g} m/s"
        return f"Rotor({self.name}, {size}, twist {self.builtin_twist.spec()})"

    def at_speed(self, percent: float) -> "Rotor":
        """This rotor at a percentage of its nominal speed; 100 returns the rotor itself."""
        speed = self.angular_speed if self.own_speed is None else self.own_speed
        if percent == 100.0:
            return (
                self
                if self.own_speed is None
                else replace(self, angular_speed=speed, own_speed=None)
            )
        return replace(self, angular_speed=speed * (percent / 100.0), own_speed=speed)

    @property
    def tip_speed(self) -> float:
        """ΩR [m/s]"""
        return self.angular_speed * self.radius

    @property
    def disk_area(self) -> float:
        """πR² [m²]"""
        return math.pi * self.radius**2

    @property
    def solidity(self) -> float:
        """σ = N_b c/(πR), eq. (2.19), with the reference chord (0.0821 for the UH-60A with c = 0.5273 m)."""
        return self.blades * self.reference_chord / (math.pi * self.radius)

    @property
    def flap_frequency_squared(self) -> float:
        """ν² = 1 + e S/I + K/(I Ω²), the rotating flap frequency over Ω, squared."""
        blade = self.blade
        offset = blade.flap_hinge * self.radius * blade.flap_static_moment / blade.flap_inertia
        return 1.0 + offset + self.flap_spring_ratio

    @property
    def flap_spring_ratio(self) -> float:
        """K/(I Ω²) [-], the contribution of the hinge spring to ν²."""
        return self.blade.flap_spring / (self.blade.flap_inertia * self.angular_speed**2)


def with_airfoils(rotor: Rotor, sections: Sequence[str], breaks: Sequence[float]) -> Rotor:
    """The rotor with other sections, root to tip, that change at `breaks` (r/R) without a blend; else ValueError."""
    ends = (rotor.blade.root_cutout, *breaks, 1.0)
    if len(breaks) != len(sections) - 1 or any(low >= high for low, high in pairwise(ends)):
        given = ", ".join(f"{place:g}" for place in breaks)
        raise ValueError(
            f"{len(sections)} airfoils with {f'changes at {given}' if breaks else 'no change'}: give one ascending r/R "
            f"between each two, beyond the root cut-out {rotor.blade.root_cutout:g}, for example "
            "sc1094r8,sc1095@0.5"
        )
    spans = tuple(
        Span(low, high, name) for (low, high), name in zip(pairwise(ends), sections, strict=True)
    )
    return replace(rotor, blade=replace(rotor.blade, spans=spans))


def airfoils_spec(rotor: Rotor) -> str | None:
    """The SPEC of the sections for `change_airfoils`; None where neighbouring sections are blended."""
    spans = rotor.blade.spans
    if any(inner.end != outer.start for inner, outer in pairwise(spans)):
        return None
    names = ",".join(span.section for span in spans)
    return names + (
        f"@{','.join(f'{span.end:.10g}' for span in spans[:-1])}" if len(spans) > 1 else ""
    )
