"""Solutions and searches that several figures share, computed once."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import lru_cache, update_wrapper
from typing import Any, Generic, ParamSpec, TypeVar

from rotor.aero.inflow import INFLOW_MODELS
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.optimisation.processes import Workers
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
"""A cached function and its arguments."""


def compute_ahead(
    groups: Sequence[Sequence[Call]],
    processes: int,
    advance: Callable[[str], None] | None = None,
    stop: Callable[[], bool] | None = None,
) -> bool:
    """Make the calls, each group in one process, one after the other; True when stopped before the end.

    The longest groups come first. `advance` is called after every call.
    """
    waiting = [tuple(call for call in group if call[1] not in call[0].known) for group in groups]
    seen: set[tuple[str, tuple[Any, ...]]] = set()

    def take(answered: tuple[Call, Any]) -> None:
        (function, args), answer = answered
        function.known[args] = answer
        if advance is not None and (function.name, args) not in seen:
            seen.add((function.name, args))
            advance(str(args[0]))

    with Workers(processes, take, stop) as workers:
        return workers.run([(_work, (group,)) for group in waiting if group])


def _work(calls: tuple[Call, ...], stop: Callable[[], bool] | None) -> Iterator[tuple[Call, Any]]:
    for function, args in calls:
        if stop is not None and stop():
            return
        yield (function, args), function(*args)


PRESETS = ("thesis", "flight")
FIVE_RATES = (0, -4, -8, -12, -16)
"""The linear twists of the thesis [degrees per radius] (thesis §3.3)."""

THESIS_WAKE = "thesis-wake"
"""The `thesis` preset with the dynamic wake for its linear inflow: the least change that lets twist act on induced
power."""
FLIGHT_LINEAR = "flight-linear"
"""The `flight` preset with linear (Pitt–Peters) inflow."""

THESIS_TRIMMED = "thesis-trimmed"
"""The `thesis` preset's blade and section with the dynamic wake and the `flight` preset's trim: cyclic, and µ sin α
in U_P."""

VARIANTS = ("thesis", THESIS_WAKE, "flight", FLIGHT_LINEAR)
"""Those that have a picture of their own: each preset with an inflow model that responds to loading, and with one that
does not."""
VARIANT_TITLES = {
    "thesis": "thesis preset (linear inflow as printed)",
    THESIS_WAKE: "thesis preset with the dynamic wake",
    "flight": "flight preset (dynamic wake)",
    FLIGHT_LINEAR: "flight preset with linear inflow",
}
_INFLOW = {
    "thesis": "pitt-peters-15pi/23",
    THESIS_WAKE: "dynamic-wake",
    THESIS_TRIMMED: "dynamic-wake",
    "flight": "dynamic-wake",
    FLIGHT_LINEAR: "pitt-peters",
}
"""Inflow model of the variants that have a name."""


def with_inflow(preset: str, inflow: str) -> str:
    """The variant of a preset with any inflow model: its name where it has one, else `preset:inflow`."""
    own = (name for name in VARIANTS if choices(name) == (preset, inflow))
    return next(own, f"{preset}:{inflow}")


def choices(name: str) -> tuple[str, str]:
    """Preset and inflow model of a variant."""
    preset, _, inflow = name.partition(":")
    return preset.partition("-")[0], inflow or _INFLOW[name]


EVERY_VARIANT = tuple(with_inflow(preset, inflow) for preset in PRESETS for inflow in INFLOW_MODELS)
"""Both presets with every inflow model."""


def variant(name: str, *, twist: str | None = None, mu: float = 0.2, mass: float | None = None) -> Design:
    """A preset, or a preset with its inflow exchanged."""
    preset, inflow = choices(name)
    design = make_design(preset=preset, twist=twist, mu=mu, mass_kg=mass)
    models = replace(design.models, inflow=inflow)
    if name == THESIS_TRIMMED:
        models = replace(models, trim="propulsive", disk_axial_flow=True)
    return replace(design, models=models)


@lru_cache(maxsize=4096)
def solved(name: str, twist: str, mu: float, mass: float | None = None) -> Solution:
    """The solution of a variant; converged or not."""
    return solve(variant(name, twist=twist, mu=mu, mass=mass))


def main_rotor_kw(name: str, rate: float, mu: float, mass: float | None = None) -> float:
    """Main-rotor power of a linear twist [kW]; RuntimeError with the sentence where it does not trim."""
    return solved(name, f"linear:{rate:g}", mu, mass).require().power.main_rotor / 1e3
