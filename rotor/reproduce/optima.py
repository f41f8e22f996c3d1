"""Chapter 4: the twist of least power for every concept, over speed, in both presets and with every inflow model.

The thesis' own numbers of chapter 4 are not known to us, so nothing here is compared with them. What is said of
each optimum: parameters, the band within 0.1 % of its power, the power, and the saving against the thesis'
baseline, a fixed linear twist of −16°.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from rotor.design.blade import with_airfoils
from rotor.design.twist import parse_twist
from rotor.optimisation.concepts import Concept, find_concept, nearest
from rotor.optimisation.objective import Objective, WeightedCondition
from rotor.optimisation.search import Band, Optimum, Search, SearchStatus, run_search
from rotor.reproduce.runs import CachedFunction, Call, choices, variant

BASELINE = "linear:-16"
"""The fixed blade of Table 4.1 (thesis §3.2: the UH-60A simplified)."""
DIVISIONS = (0.4, 0.5, 0.6, 0.7)
"""Figs. 4.4–4.7: 40–60, 50–50, 60–40, 70–30, inner part first."""


@dataclass(frozen=True)
class Scope:
    """How much of chapter 4 to compute."""

    speeds: tuple[float, ...]
    starts: int
    """Starts of the first condition; the others begin from their neighbour too."""


FULL = Scope((0.0, 0.10, 0.15, 0.20, 0.25, 0.30, 0.35), 3)
QUICK = Scope((0.0, 0.15, 0.30), 2)
"""For tests."""


@dataclass(frozen=True)
class ConceptOptimum:
    """One optimum."""

    variant: str
    concept: str
    mu: float
    converged: bool
    message: str
    names: tuple[str, ...]
    """Parameters as people read them, for example rate_deg."""
    values: tuple[float, ...]
    """In degrees where angular."""
    band: tuple[tuple[float, float], ...]
    """Low and high of each within 0.1 % of the least power, the others following; degrees where angular. NaN where the
    search did not find it."""
    twist: str
    """SPEC"""
    power_kw: float
    """Total power."""
    baseline_kw: float
    """Total power of `BASELINE` on the preset's own airfoils."""
    minima: int
    """Local minima found."""

    @property
    def saving(self) -> float:
        """Part of the baseline's power."""
        return 1.0 - self.power_kw / self.baseline_kw


CONCEPTS: dict[str, tuple[str, Callable[[], Concept]]] = {
    "linear": ("one section, linear twist", lambda: find_concept("linear")),
    "quadratic": ("quadratic twist", lambda: find_concept("quadratic")),
    **{
        f"two {100 * d:.0f}-{100 * (1 - d):.0f}": (
            f"two sections, linear twist, divided {100 * d:.0f} – {100 * (1 - d):.0f}",
            lambda d=d: find_concept("two-segment", (d,)),
        )
        for d in DIVISIONS
    },
    "two airfoils": ("two sections, two airfoils, 50 – 50", lambda: find_concept("two-segment-two-airfoils", (0.5,))),
    "three": ("three linear sections", lambda: find_concept("three-segment")),
}
"""The thesis' concepts: title, and the concept."""


@CachedFunction
def best(name: str, concept: str, mu: float, scope: Scope) -> ConceptOptimum:
    """The optimum of a concept at a speed, started from the slower neighbour's and from the linear one's."""
    preset = choices(name)[0]
    if mu == 0.0 and name != preset:  # Hover balances its annuli, whatever the model of forward flight.
        return replace(best(preset, concept, mu, scope), variant=name)
    family = CONCEPTS[concept][1]()
    design = variant(name, twist=BASELINE, mu=mu)
    if concept == "two airfoils" and design.preset == "thesis":
        # The R8 exists as a deck only; its baseline is then the SC1095 deck, so that sections are compared, not polars.
        # Hover by eq. (3.3) knows one lift curve for the whole blade, so the annulus balance takes its place.
        models = replace(design.models, hover_inflow="annulus")
        design = replace(design, rotor=with_airfoils(design.rotor, ("sc1095",), ()), models=models)
    guesses: list[tuple[float, ...]] = []
    speeds = scope.speeds
    place = speeds.index(mu) if mu in speeds else 0
    neighbour = [speeds[place - 1]] if place > 0 else []
    near = [best(name, concept, slower, scope).twist for slower in neighbour]
    if concept != "linear":
        near.append(best(name, "linear", mu, scope).twist)
    for spec in near:
        guesses.append(nearest(family, parse_twist(spec, builtin=design.twist)))
    # One start more than the guesses: begun right at the optimum, a search sees too little to measure its band.
    starts = max(scope.starts if not neighbour else 1, len(guesses) + 1)
    found = run_search(Search(design, family, starts=starts, guesses=tuple(guesses)))
    return _record(name, concept, mu, family, found)


@dataclass(frozen=True)
class FixedBlade:
    """The linear blade of least mean power over all speeds, each flown equally long."""

    rate_deg: float
    """[°/R]"""
    power_kw: float
    """Mean total power."""
    baseline_kw: float
    """Mean total power of `BASELINE`."""


@CachedFunction
def best_fixed(name: str, scope: Scope) -> FixedBlade:
    """The fixed blade that a moving one has to beat, started from the mean of the moving ones."""
    family = CONCEPTS["linear"][1]()
    design = variant(name, twist=BASELINE, mu=scope.speeds[0])
    conditions = tuple(WeightedCondition(replace(design.condition, advance_ratio=mu)) for mu in scope.speeds)
    middle = sum(best(name, "linear", mu, scope).values[0] for mu in scope.speeds) / len(scope.speeds)
    guess = (math.radians(middle),)
    found = run_search(Search(design, family, Objective("total", conditions), starts=1, guesses=(guess,), band=False))
    assert found.best is not None, f"{name}: {found.message}"
    assert found.baseline_power is not None, f"{name}: the baseline blade does not trim at every speed"
    return FixedBlade(math.degrees(found.best.parameters[0]), found.best.power / 1e3, found.baseline_power / 1e3)


def searches(concepts: Sequence[str], name: str, scope: Scope) -> list[Call]:
    """The calls of `best` for these concepts, in the order that lets each start from its neighbours."""
    wanted = dict.fromkeys(("linear", *concepts))
    return [(best, (name, concept, mu, scope)) for concept in wanted for mu in scope.speeds]


def _record(name: str, concept: str, mu: float, family: Concept, found: Optimum) -> ConceptOptimum:
    assert found.baseline_power is not None, f"{name}, µ {mu:g}: the baseline blade does not trim"
    bands: dict[str, Band] = {one.parameter: one for one in found.band}
    parameters = family.parameters
    least = found.best
    values = least.parameters if least is not None else (float("nan"),) * len(parameters)
    # A band without width was not found, whatever the search says: no smooth optimum is that sharp.
    found_band = {name: (one.low, one.high) for name, one in bands.items() if one.high > one.low}
    edges = [found_band.get(p.name, (math.nan, math.nan)) for p in parameters]
    return ConceptOptimum(
        variant=name,
        concept=concept,
        mu=mu,
        converged=found.status is SearchStatus.CONVERGED,
        message=found.message,
        names=tuple(p.label for p in parameters),
        values=tuple(p.shown(value) for p, value in zip(parameters, values, strict=True)),
        band=tuple((p.shown(low), p.shown(high)) for p, (low, high) in zip(parameters, edges, strict=True)),
        twist=least.twist if least is not None else found.design.twist.spec(),
        power_kw=(least.power if least is not None else found.baseline_power) / 1e3,
        baseline_kw=found.baseline_power / 1e3,
        minima=len(found.minima),
    )
