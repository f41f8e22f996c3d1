"""Solutions, searches and optima that several figures share, computed once.

Chapter 4 needs the twist of least power for every concept, over speed, in both presets. Its own numbers are not known
to us, so nothing here is compared with them.
"""

import math
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, replace
from functools import lru_cache, update_wrapper
from typing import Any, Generic, ParamSpec, TypeVar

from rotor.design.blade import with_airfoils
from rotor.design.design import Design, with_models
from rotor.design.twist import parse_twist
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import Concept, find_concept, nearest
from rotor.optimisation.results import SearchStatus
from rotor.optimisation.search import Search, run_search
from rotor.support.processes import Processes, run_tasks
from rotor.support.worker_process import Stop, Tell
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

P = ParamSpec("P")
R = TypeVar("R")


class CachedFunction(Generic[P, R]):
    """A function of hashable arguments that keeps its results. It pickles by name."""

    def __init__(self, function: Callable[P, R]) -> None:
        self.name = function.__qualname__
        self.known: dict[tuple[object, ...], R] = {}
        self._function = function
        update_wrapper(self, function)

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R:
        assert not kwargs, "pass arguments by position"
        if args not in self.known:
            self.known[args] = self._function(*args, **kwargs)
        return self.known[args]

    def __reduce__(self) -> str:
        return self.name


Call = tuple[CachedFunction[..., Any], tuple[Any, ...]]


def compute_ahead(
    groups: Sequence[Sequence[Call]],
    processes: int,
    advance: Tell | None = None,
    stop: Stop | None = None,
) -> bool:
    """Make the calls, each group in one process, one after the other; True when stopped before the end.

    The longest groups come first. `advance` is called after every call.
    """
    waiting = [tuple(call for call in group if call[1] not in call[0].known) for group in groups]
    seen: set[tuple[str, tuple[Any, ...]]] = set()

    def keep(answered: tuple[Call, Any]) -> None:
        (function, args), answer = answered
        function.known[args] = answer
        # In one process it is known before.
        if advance is not None and (function.name, args) not in seen:
            seen.add((function.name, args))
            advance(str(args[0]))

    with Processes(processes) if processes > 1 else nullcontext() as pool:
        return run_tasks(pool, [(_work, (group,)) for group in waiting if group], keep, stop)


def _work(calls: tuple[Call, ...], stop: Stop | None) -> Iterator[tuple[Call, Any]]:
    for function, args in calls:
        if stop is not None and stop():
            return
        yield (function, args), function(*args)


FIVE_RATES = (0, -4, -8, -12, -16)
"""The linear twists of the thesis [degrees per radius] (thesis §3.3)."""

THESIS_WAKE = "thesis-wake"
"""The `thesis` preset with the lifting line for its linear inflow: the least change that lets twist act on induced
power."""
FLIGHT_LINEAR = "flight-linear"
"""The `flight` preset with linear (Pitt–Peters) inflow."""

VARIANTS = ("thesis", "flight")
"""Variants whose optima chapter 4 shows."""
VARIANT_TITLES = {
    "thesis": "thesis preset (linear inflow as printed)",
    THESIS_WAKE: "thesis preset with the lifting line",
    "flight": "flight preset (lifting line)",
    FLIGHT_LINEAR: "flight preset with linear inflow",
}
_INFLOW = {THESIS_WAKE: "lifting-line", FLIGHT_LINEAR: "pitt-peters"}
"""Inflow model of the variants that do not have their preset's own."""


def variant(
    name: str, *, twist: str | None = None, mu: float = 0.2, mass: float | None = None
) -> Design:
    """A preset, or a preset with its inflow exchanged; mass [kg]."""
    design = make_design(preset=name.partition("-")[0], twist=twist, mu=mu, mass_kg=mass)
    return with_models(design, inflow=_INFLOW.get(name, design.models.inflow))


@lru_cache(maxsize=4096)
def solve_variant(name: str, twist: str, mu: float, mass: float | None = None) -> Solution:
    """The solution of a variant; converged or not."""
    return solve(variant(name, twist=twist, mu=mu, mass=mass))


def main_rotor_kw(name: str, rate: float, mu: float) -> float:
    """Main-rotor power of a linear twist [kW]; RuntimeError with the sentence where it does not trim."""
    return solve_variant(name, f"linear:{rate:g}", mu).require().power.main_rotor / 1e3


BASELINE = "linear:-16"
"""The fixed blade of Table 4.1 (thesis §3.2: the UH-60A simplified)."""
DIVISIONS = (0.4, 0.5, 0.6, 0.7)
"""Figs. 4.4–4.7: 40–60, 50–50, 60–40, 70–30, inner part first."""


FULL = (0.0, 0.10, 0.15, 0.20, 0.25, 0.30, 0.35)
"""Advance ratios of chapter 4."""


@dataclass(frozen=True)
class ConceptOptimum:
    """The twist of least power of one concept at one speed."""

    mu: float
    converged: bool
    names: tuple[str, ...]
    """Parameters as people read them, for example rate_deg."""
    values: tuple[float, ...]
    """In degrees where angular."""
    band: tuple[tuple[float, float], ...]
    """Low and high of each within 0.1 % of the least power, the others following; degrees where angular. NaN where it
    was not measured."""
    twist: str
    """SPEC"""
    power_kw: float
    baseline_kw: float
    """Total power of `BASELINE` on the preset's own airfoils."""

    @property
    def saving(self) -> float:
        """Saving as a fraction of the baseline's power."""
        return 1.0 - self.power_kw / self.baseline_kw


CONCEPTS: dict[str, tuple[str, Concept]] = {
    "linear": ("one section, linear twist", find_concept("linear")),
    "quadratic": ("quadratic twist", find_concept("quadratic")),
    **{
        f"two {100 * d:.0f}-{100 * (1 - d):.0f}": (
            f"two sections, linear twist, divided {100 * d:.0f} – {100 * (1 - d):.0f}",
            find_concept("two-segment", (d,)),
        )
        for d in DIVISIONS
    },
    "two airfoils": (
        "two sections, two airfoils, 50 – 50",
        find_concept("two-segment-two-airfoils", (0.5,)),
    ),
    "three": ("three linear sections", find_concept("three-segment")),
}
"""The thesis' concepts: title, and the concept."""
SC1095_DECKS = "two 50-50, SC1095 deck"
"""The two-segment blade beside which the `thesis` preset sees two airfoils: the R8 exists as a deck only."""


@CachedFunction
def best(preset: str, concept: str, mu: float, speeds: tuple[float, ...]) -> ConceptOptimum:
    """The optimum of a concept at one of the speeds, started from the slower neighbour's and from the linear one's."""
    family = (
        find_concept("two-segment", (0.5,)) if concept == SC1095_DECKS else CONCEPTS[concept][1]
    )
    design = variant(preset, twist=BASELINE, mu=mu)
    if preset == "thesis" and concept in ("two airfoils", SC1095_DECKS):
        # The R8 exists as a deck only; its baseline is then the SC1095 deck, so that sections are compared, not polars,
        # both at Mach 0.3, because the thesis leaves compressibility out (p. 23). Hover by eq. (3.3) has one lift curve
        # for the whole blade, so the annulus balance takes its place.
        models = replace(design.models, hover_inflow="annulus", compressibility=False)
        design = replace(design, rotor=with_airfoils(design.rotor, ("sc1095",), ()), models=models)
    place = speeds.index(mu)
    near = [best(preset, concept, speeds[place - 1], speeds).twist] if place > 0 else []
    if concept != "linear":
        near.append(best(preset, "linear", mu, speeds).twist)
    guesses = tuple(nearest(family, parse_twist(spec, builtin=design.twist)) for spec in near)
    # Two starts at least: begun right at the optimum, a search sees too little to measure its band.
    optimum = run_search(
        Search(design, family, starts=max(2 if place > 0 else 3, len(guesses)), guesses=guesses)
    )
    least, parameters = optimum.best, family.parameters
    assert least is not None, f"{preset}, µ {mu:g}: {optimum.message}"
    assert optimum.baseline_power is not None, (
        f"{preset}, µ {mu:g}: the baseline blade does not trim"
    )
    # A band without width was not found, whatever the search says: no smooth optimum is that sharp.
    bands = {band.parameter: (band.low, band.high) for band in optimum.band if band.high > band.low}
    edges = [bands.get(p.name, (math.nan, math.nan)) for p in parameters]
    return ConceptOptimum(
        mu=mu,
        converged=optimum.status is SearchStatus.CONVERGED,
        names=tuple(p.label for p in parameters),
        values=tuple(p.shown(value) for p, value in zip(parameters, least.parameters, strict=True)),
        band=tuple(
            (p.shown(low), p.shown(high)) for p, (low, high) in zip(parameters, edges, strict=True)
        ),
        twist=least.twist,
        power_kw=least.power / 1e3,
        baseline_kw=optimum.baseline_power / 1e3,
    )


def comparable_kw(preset: str, concept: str, mu: float, speeds: tuple[float, ...]) -> float:
    """Total power of a concept on the baseline and section data of all others [kW].

    In the `thesis` preset two airfoils are computed with decks. What the second airfoil gains there, as a part of
    power, is taken off the two-segment blade with the document's polynomials.
    """
    optimum = best(preset, concept, mu, speeds)
    if concept != "two airfoils" or preset != "thesis":
        return optimum.power_kw
    decks, polynomials = (
        best(preset, SC1095_DECKS, mu, speeds),
        best(preset, "two 50-50", mu, speeds),
    )
    return polynomials.power_kw * optimum.power_kw / decks.power_kw


def searches(concepts: Collection[str]) -> list[Call]:
    """The calls of `best` for these concepts in both presets, in the order that lets each start from its neighbours."""
    wanted = {preset: dict.fromkeys(("linear", *concepts)) for preset in VARIANTS}
    if {"two airfoils", "two 50-50"} <= wanted["thesis"].keys():
        wanted["thesis"][SC1095_DECKS] = None
    return [
        (best, (preset, concept, mu, FULL))
        for preset in VARIANTS
        for concept in wanted[preset]
        for mu in FULL
    ]
