"""Progress and result of a search, as values without arrays: they pickle and compare."""

from dataclasses import dataclass
from enum import Enum
from typing import Literal

from rotor.design.design import Design
from rotor.design.twist import TwistLaw
from rotor.support.units import power_text
from rotor.trim.doubt import Doubt

Phase = Literal["baseline", "search", "band"]


class SearchStatus(Enum):
    """How a search ended."""

    CONVERGED = "converged"
    STOPPED = "stopped"
    NOT_CONVERGED = "not-converged"


@dataclass(frozen=True)
class Progress:
    """Progress after one evaluation."""

    phase: Phase
    start: int
    """Index of the start, from 0."""
    starts: int
    evaluation: int
    """Running number, from 1."""
    parameters: tuple[float, ...]
    """SI, in the order of the concept."""
    twist: str
    """SPEC"""
    power: float | None
    """[W]; None when the design does not trim."""
    feasible: bool
    """Whether it trims and keeps all limits."""
    best_parameters: tuple[float, ...] | None
    best_power: float | None
    """Least power of a feasible design so far [W]; None before the first."""
    elapsed: float
    """[s]"""
    best_index: float | None = None
    """Vibration index of the best design so far [%] where objective or limits ask for it."""


@dataclass(frozen=True)
class Minimum:
    """A local minimum."""

    parameters: tuple[float, ...]
    power: float
    """[W]"""
    twist: str
    """SPEC"""
    starts: tuple[int, ...]
    """The starts that lead here; none where only the gradients at other points did."""
    active: tuple[str, ...]
    """Active bounds and limits, for example `division high` or `area past the static angle`."""
    index: float | None = None
    """Vibration index [%], the mean over the conditions, where objective or limits ask for it."""


@dataclass(frozen=True)
class ParameterBand:
    """Range of one parameter: the others re-optimised, within BAND of the least power or index; or by doubt."""

    parameter: str
    low: float
    high: float
    causes: tuple[tuple[str, float], ...] = ()
    """Uncertain inputs that move it most, in words, and by how much where they are larger by their size."""


@dataclass(frozen=True, repr=False)
class Optimum:
    """The result of `rotor.optimise`: powers [W], parameters [rad], [rad/R] or r/R, shares in per cent.

    Without a trim `best` is None, and `message` says why.
    """

    status: SearchStatus
    message: str
    """Why it stopped, in one sentence."""
    concept: str
    design: Design
    """The design with the best twist, or the given design where nothing was found."""
    best: Minimum | None
    minima: tuple[Minimum, ...]
    """All local minima found, the best first."""
    band: tuple[ParameterBand, ...]
    """One per parameter, within 0.1 % of the least power or index; empty when not requested, or not found."""
    baseline_power: float | None
    """Power of the design given, by the same objective [W]; None when it does not trim."""
    evaluations: int
    starts: int
    seed: int
    elapsed: float
    """[s]"""
    baseline_index: float | None = None
    """Vibration index of the design given [%] where objective or limits ask for it."""
    doubt: Doubt | None = None
    """How sure the saving is; None where the band was not requested."""
    doubt_band: tuple[ParameterBand, ...] = ()
    """Where each parameter may lie by what is uncertain; empty where that is not known."""
    doubt_cost: float | None = None
    """Power that the best twist is expected to need above the least, because the least may lie elsewhere [W]."""

    def __repr__(self) -> str:
        head = f"Optimum({self.concept}, {self.status.value}"
        if self.best is None:
            return f"{head}: {self.message})"
        saving = f", {self.saving_words}" if self.saving_words else ""
        index = "" if self.best.index is None else f", index {self.best.index:.2f} %"
        return f"{head}, twist {self.best.twist}, {power_text(self.best.power, 1)}{saving}{index})"

    @property
    def twist(self) -> TwistLaw:
        """The best twist; that of the design given where nothing was found."""
        return self.design.twist

    @property
    def saving_words(self) -> str:
        """`saves 1.8 ± 0.7 %: sure`, without the band where that is not known; empty without a saving."""
        if self.doubt is not None:
            return self.doubt.saving_words
        saving = self.saving_percent
        return (
            "" if saving is None else f"{'saves' if saving >= 0.0 else 'costs'} {abs(saving):.2f} %"
        )

    @property
    def saving_percent(self) -> float | None:
        """Saving of the best twist in per cent of the baseline power; None without a saving."""
        return None if self.saving is None else 100.0 * self.saving

    @property
    def saving(self) -> float | None:
        """Saving of the best twist as a part of the baseline power [-]; None without a saving."""
        if self.best is None or self.baseline_power is None:
            return None
        return 1.0 - self.best.power / self.baseline_power


@dataclass(frozen=True)
class TwistRange:
    """Where the best linear twist lies over a range of what it depends on."""

    cause: str
    """`flat`, `doubt`, `mass`, `drag area` or `wake`."""
    rates: tuple[float, float]
    """At the lower and the upper end [rad/R]."""
    ends: tuple[float, float] | None = None
    """Mass [kg] or drag area [m²]; None for the others."""

    @property
    def width(self) -> float:
        """Difference of the rates [rad/R]."""
        return abs(self.rates[1] - self.rates[0])


@dataclass(frozen=True)
class BestTwist:
    """The best linear twist of a design at its own flight condition."""

    rate: float
    """[rad/R]"""
    ranges: tuple[TwistRange, ...]
    """Without those where one end has no trim."""
    cost: float | None = None
    """`Optimum.doubt_cost`."""
