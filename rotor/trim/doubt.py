"""How sure a power is, and how much surer a difference between two designs.

What is uncertain and by how much: `rotor.design.uncertain`; what it does: `rotor.trim.power_changes`.
An input is as wrong for one design as for another, so the change of a *difference* is the difference of the changes.
Inputs are wrong independently of one another, so their changes are summed as squares.

The model's own errors are shares of induced and profile power, fitted to measured powers (`rotor.validation.doubt`).
They say little about how induced power differs between two designs. For that inflow models are compared. In hover,
where measured powers of pairs of rotors are known, a share of power is added that grows with the distance of the blades
(`rotor.trim.blade_distance`): it is not a share of the change, so that the sign of a small change can be unclear.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Literal, NamedTuple

import numpy as np

from rotor.aero.inflow import INFLOW_MODELS
from rotor.design.design import Design
from rotor.design.uncertain import Uncertain, uncertain_inputs
from rotor.support.arrays import Array
from rotor.support.markup import tag
from rotor.support.table import LEFT, CellValue, Column, Table, table
from rotor.support.units import power_unit
from rotor.trim.analysis import Analysis, analysed
from rotor.trim.blade_distance import blade_distance
from rotor.trim.forward import SLOWEST
from rotor.trim.low_speed import hover_share
from rotor.trim.newton import FEW_DIGITS, Guess
from rotor.trim.power_changes import PARTS, by_part
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

SURE, LIKELY = 2.0, 1.0
"""A change this many times its band is sure, or likely; the sign of a smaller one is unclear."""
LEAST_REPORTED = 0.01
"""[%] of power: a change and a band that are both smaller are none, and no band is said to be smaller."""
ESTIMATED = "from estimated data"
"""Why the change that an actuator makes is at most `likely`."""
MOST_DECIMALS, MOST_OF_SMALL = 2, 3
"""Of a printed change and its band; and where the first digit of the band is behind those."""
COMPARED_INFLOWS = ("lifting-line", "pitt-peters")
"""Inflow models whose disagreement about a difference is taken as its error."""

HOVER_BLADE = "hover_blade_percent"
"""Uncertain input of a difference between two blades in hover: a share of power, not of the change."""


@dataclass(frozen=True)
class DoubtRow(Uncertain):
    """An uncertain input and its effect on the power of one design, or of two."""

    power: float
    """Change of total power where the input is larger by its size [W]."""
    change: float | None = None
    """Change by the input of the power less that of the design compared with [W]; None without one."""
    changes: tuple[float, ...] = ()
    """`change` by `PARTS`; empty without one, and where propulsive power takes the place of parasite power."""

    @property
    def size_words(self) -> str:
        """The uncertainty of the input with its unit, for example `5 %`."""
        return f"{self.size:g} {self.unit}".rstrip()


@dataclass(frozen=True)
class OtherModels:
    """A design, or two, solved with other models."""

    name: str
    """Name of the model, as `inflow pitt-peters`."""
    power: float
    """Total power [W]."""
    change: float | None = None
    """Less that of the design compared with [W]; None without one."""


@dataclass(frozen=True, repr=False)
class Doubt:
    """The uncertainty of a design's power, and of what it saves compared with another design."""

    power: float
    """Total power [W]."""
    rows: tuple[DoubtRow, ...]
    """Largest first."""
    against: float | None = None
    """Total power of the design compared with [W]; None without one."""
    name_of_other: str | None = None
    """SPEC of its twist."""
    models: tuple[OtherModels, ...] = ()
    """Beside the band, not in it."""
    of: Literal["Power", "Induced power", "Drag times speed"] = "Power"
    """What `power` is: of a free rotor the last."""
    sourced: bool = True
    """Whether all that makes the change has a source, as in `sureness`."""

    def __repr__(self) -> str:
        return f"Doubt({self.sentence})"

    @property
    def band(self) -> float:
        """Uncertainty of the power, ± [W]."""
        return math.hypot(*(row.power for row in self.rows))

    @property
    def change(self) -> float | None:
        """Power minus that of the design compared with [W]."""
        return None if self.against is None else self.power - self.against

    @property
    def change_band(self) -> float | None:
        """Uncertainty of `change`, ± [W]; of a change that is one, `LEAST_REPORTED` of the power at least."""
        if self.change is None:
            return None
        band = math.hypot(*(row.change or 0.0 for row in self.rows))
        return band if max(abs(self.change), band) < self._least else max(band, self._least)

    @property
    def part_bands(self) -> Mapping[str, float]:
        """Uncertainty of the change of each part of power, and of `main_rotor`, all but the tail rotor, ± [W]; empty
        without a change, and on a stand."""
        rows = np.array([row.changes for row in self.rows if row.changes])
        if not rows.size:
            return {}
        bands = np.linalg.norm(
            np.column_stack((rows, rows[:, : PARTS.index("tail")].sum(axis=1))), axis=0
        )
        return dict(zip((*PARTS, "main_rotor"), bands.tolist(), strict=True))

    @property
    def _least(self) -> float:
        """Least change or band that is reported [W]."""
        return 0.01 * LEAST_REPORTED * abs(self.against or 0.0)

    @property
    def change_band_percent(self) -> float | None:
        """`change_band` in per cent of the power compared with."""
        return (
            None
            if self.change_band is None or not self.against
            else 100.0 * self.change_band / abs(self.against)
        )

    @property
    def sureness(self) -> str | None:
        """`sure`, `likely` or `unclear`: whether the sign of the change is known; None without a change."""
        change, band = self.change, self.change_band
        if change is None or band is None or max(abs(change), band) < self._least:
            return None
        return sureness(change, band, sourced=self.sourced)

    @property
    def sentence(self) -> str:
        """The bands in words, for example `Power 901 ± 52 kW. It saves 1.8 ± 0.7 %: sure.`"""
        return self.in_words("It")

    def in_words(self, design: str, unit: tuple[str, float] | None = None) -> str:
        """The power, and after `design` what the design saves, as in `sentence`. `unit`: symbol and size [W]."""
        symbol, size = unit or power_unit(self.power, self.band)
        band = self.band / size
        digits = decimals(band)
        words = f"{self.of} {self.power / size:.{digits}f} ± {band:.{digits}f} {symbol}."
        return f"{words} {design} {self.saving_words}." if self.saving_words else words

    @property
    def saving_words(self) -> str:
        """The saving in words, for example `saves 1.8 ± 0.7 %: sure`; empty without a change."""
        change, within = self.change, self.change_band_percent
        if change is None or within is None or not self.against:
            return ""
        if self.sureness is None:
            return "neither saves nor costs"
        size = abs(100.0 * change / self.against)
        return f"{'saves' if change <= 0.0 else 'costs'} {banded(size, within, '%', sourced=self.sourced)}"

    def _repr_html_(self) -> str:
        return tag("p", self.sentence) + doubt_table(self).html()

    def record(self) -> dict[str, object]:
        """The bands as `solve --doubt --json` prints them: powers and bands [W]."""
        return {
            "power_w": self.power,
            "total_w": self.band,
            "against": self.name_of_other,
            "against_w": self.against,
            "change_w": self.change,
            "change_band_w": self.change_band,
            "sureness": self.sureness,
            "rows": [
                {name: getattr(row, name) for name in ("name", "size", "unit", "source")}
                | {"power_w": row.power, "change_w": row.change}
                for row in self.rows
            ],
            "part_bands_w": dict(self.part_bands),
            "models": {
                row.name: {"power_w": row.power, "change_w": row.change} for row in self.models
            },
        }


def doubt_table(doubt: Doubt) -> Table:
    """The contributions to the bands, one row for each uncertain input."""
    symbol, size = power_unit(doubt.power, doubt.band)
    rows: list[tuple[CellValue, ...]] = [
        (row.words, row.size_words, f"{row.power / size:+.2f}", row.change and row.change / size)
        for row in doubt.rows
    ]
    rows += [
        (
            f"with {other.name}",
            None,
            f"{other.power / size:.1f}",
            other.change and other.change / size,
        )
        for other in doubt.models
    ]
    columns = (
        Column("uncertain", LEFT),
        Column("by"),
        Column(f"power {symbol}"),
        Column(f"change {symbol}", "+.2f"),
    )
    return table(columns, rows)


def sureness(change: float, band: float, *, sourced: bool = True) -> str:
    """Whether the sign of a change is known within its band: at most `likely` where a value of the actuator that makes
    the change is recalled or assumed (not `sourced`), for the band does not hold what that may be off by."""
    ratio = math.inf if band == 0.0 else abs(change) / band
    return "sure" if ratio >= SURE and sourced else "likely" if ratio >= LIKELY else "unclear"


def sure_words(change: float, band: float, *, sourced: bool = True) -> str:
    """`sureness`, and why it is not `sure` where the band alone would allow that: `likely, from estimated data`."""
    word = sureness(change, band, sourced=sourced)
    if word == sureness(change, band):
        return word
    return f"{word}, {ESTIMATED}"


def banded(change: float, band: float, unit: str, *, sourced: bool = True) -> str:
    """A change with its band and whether its sign is known, as `1.8 ± 0.7 %: sure`."""
    return f"{pair_text(change, band, unit)}: {sure_words(change, band, sourced=sourced)}"


def pair_text(change: float, band: float, unit: str) -> str:
    """A change with its band, as `1.8 ± 0.7 %`, rounded as `rounded_pair`."""
    pair = rounded_pair(change, band)
    return f"{pair.change:.{pair.decimals}f} ± {pair.band:.{pair.decimals}f} {unit}"


class RoundedPair(NamedTuple):
    """A change and its band as they are printed."""

    change: float
    band: float
    decimals: int
    """Of both."""


def rounded_pair(change: float, band: float) -> RoundedPair:
    """A change and its band rounded for print, so that both have the decimals of the band and the printed pair has the
    `sureness` of the exact one.

    The band has one significant digit, two where it is below 2 and where one would give the pair another word; of a
    band of 100 and more all digits of the integer are kept. Where two would as well, one of the two numbers is rounded
    the other way. So a change has one word in every unit, and no word says more than its numbers.
    """
    word = sureness(change, band)
    small = _decimals_of_digits(band, 1) > MOST_DECIMALS
    most = MOST_OF_SMALL if small else MOST_DECIMALS
    coarse = min(decimals(band), most)
    fine = min(_decimals_of_digits(band, 2), most)
    nearest = [_nearest(change, band, digits) for digits in (coarse, fine)]
    candidates = list(nearest)
    for pair in reversed(nearest):
        step = 10.0**-pair.decimals
        other_band = pair.band + math.copysign(step, band - pair.band)
        other_change = pair.change + math.copysign(step, change - pair.change)
        candidates.append(_nearest(pair.change, other_band, pair.decimals))
        candidates.append(_nearest(other_change, pair.band, pair.decimals))
    for pair in candidates:
        if sureness(pair.change, pair.band) == word and _at_most_two_digits(pair):
            return pair
    return nearest[-1]


def _decimals_of_digits(band: float, digits: int) -> int:
    """Decimals with which a band has so many significant digits, and no more."""
    if not (math.isfinite(band) and band > 0.0):
        return 1
    # Rounded first: of two digits, 9.96 is 10.
    first = math.floor(math.log10(float(f"{band:.{digits - 1}e}")))
    return max(0, digits - 1 - first)


def _nearest(change: float, band: float, digits: int) -> RoundedPair:
    return RoundedPair(round(change, digits), round(band, digits), digits)


def _at_most_two_digits(pair: RoundedPair) -> bool:
    """Whether the band has no third significant digit behind the point."""
    return pair.decimals == 0 or pair.band * 10.0**pair.decimals < 99.5


def decimals(band: float) -> int:
    """Decimals with which a number is worth printing: those of one digit of its band, one more below 2."""
    if not (math.isfinite(band) and band > 0.0):
        return 1
    first = math.floor(math.log10(band))
    return max(0, -first + (band / 10.0**first < 2.0))


def doubt(
    solution: Solution | Analysis,
    against: Solution | Analysis | None = None,
    *,
    models: bool = False,
) -> Doubt:
    """The uncertainty of a design's power, and that of its difference from another design.

    Most causes act on both designs alike, so the difference is more certain than the power. Of a free rotor the power
    is its drag times speed.

    Parameters:
        solution: a converged trim, or its `rotor.trim.Analysis`, which keeps what this computes.
        against: the trim of another twist or of any other design; by default there is no difference.
        models: whether to solve with the other models too, one new trim each.

    Returns:
        Bands [W] of the power and of the difference, each with its parts.

    Raises:
        RuntimeError: a solution is not converged.
        ValueError: two designs of which one is a free rotor, whose drag has no multipliers.

    Example:
        >>> here, built = (rotor.solve(rotor.make_design(mu=0.3, twist=twist)) for twist in ("linear:-12", "builtin"))
        >>> band = rotor.doubt(here, against=built)
        >>> band.change_band < 0.2 * band.band  # [W]
        True
    """
    trim, other = analysed(solution), None if against is None else analysed(against)
    found = mean_doubt((1.0,), (trim,), None if other is None else (other,))
    designs = (each.solution.design for each in (trim, other) if each is not None)
    return replace(found, models=alternative_models(*designs)) if models else found


def mean_doubt(
    shares: Sequence[float],
    here: Sequence[Analysis],
    there: Sequence[Analysis] | None,
    *,
    induced: bool = False,
) -> Doubt:
    """`doubt` of a mean power over conditions, or of induced power alone."""
    first = here[0].solution.design
    if there is not None and (_is_free(first) or _is_free(there[0].solution.design)):
        raise ValueError(
            "A free rotor takes no power from its shaft, so no saving is known: leave against out."
        )
    changes, differences, none = (
        mean_changes(shares, here),
        dict[str, Array](),
        np.zeros(len(PARTS)),
    )
    if there is not None:
        others = mean_changes(shares, there)
        differences = {
            name: changes.get(name, none) - others.get(name, none) for name in {**changes, **others}
        }
        for share, one, other in zip(shares, here, there, strict=True):
            for name, change in _model_differences(one.solution, other.solution).items():
                differences[name] = differences.get(name, none) + share * change
    rows = list[DoubtRow]()
    for row in uncertain_inputs(first):
        if row.name in changes or row.name in differences:
            power, change = (
                float((found.get(row.name, none)[: 1 if induced else None]).sum())
                for found in (changes, differences)
            )
            parts = (
                ()
                if there is None or first.condition.stand
                else tuple(differences[row.name].tolist())
            )
            rows.append(
                DoubtRow(
                    **vars(row),
                    power=power,
                    change=None if there is None else change,
                    changes=parts,
                )
            )
    rows.sort(key=lambda row: -abs(row.power if row.change is None else row.change))
    return Doubt(
        _mean_power(shares, here, induced),
        tuple(rows),
        None if there is None else _mean_power(shares, there, induced),
        None if there is None else there[0].solution.design.twist.spec(),
        of="Induced power" if induced else "Drag times speed" if _is_free(first) else "Power",
        sourced=there is None or _sourced(first, there[0].solution.design),
    )


def _sourced(*designs: Design) -> bool:
    """Whether the actuators that differ have sources."""
    carried = {design.rotor.blade.carried for design in designs}
    return len(carried) < 2 or all(one is None or one.sourced for one in carried)


def mean_changes(shares: Sequence[float], trims: Sequence[Analysis]) -> dict[str, Array]:
    """What every uncertain input does to mean powers over conditions by `PARTS` [W], as `rotor.trim.power_changes`."""
    mean = dict[str, Array]()
    for share, trim in zip(shares, trims, strict=True):
        for name, change in trim.power_changes.items():
            mean[name] = mean.get(name, 0.0) + share * change
    return mean


def _model_differences(here: Solution, there: Solution) -> dict[str, Array]:
    """What the errors of the models do to the difference of two powers by `PARTS` [W], by uncertain input.

    Errors that two inflow models share cancel in a difference of designs; those that they do not share stay. In hover,
    and where the other model has no trim, they are a part of the change of induced power. Hover has another one beside
    it, `blade_differences`. Both fade with hover's share of slow flight.
    """
    designs = here.design, there.design
    size = {row.name: 0.01 * row.size for row in uncertain_inputs(here.design)}
    change = by_part(here.power) - by_part(there.power)
    induced = size["hover_wake_percent"] * change * (1.0, 0.0, 0.0, 0.0)
    if any(design.hovering for design in designs):
        return {"hover_wake_percent": induced} | blade_differences(here, there)
    share = max(map(hover_share, designs))
    first = _powers_with_other_inflow(here)
    second = _powers_with_other_inflow(there)
    found = dict[str, Array]()
    if first is None or second is None:
        found["hover_wake_percent"] = induced
    else:
        found["inflow_model_percent"] = size["inflow_model_percent"] * (change - (first - second))
        if share:
            found["hover_wake_percent"] = share * induced
    if share:
        blades = blade_differences(here, there)
        found |= {name: share * change for name, change in blades.items()}
    return found


def blade_differences(here: Solution, there: Solution) -> dict[str, Array]:
    """What the model's error does in hover to the difference of the powers of two blades by `PARTS` [W].

    It is a share of the mean power of the main rotor times the distance of the blades; empty for equal blades.
    """
    distance = blade_distance(here.design, there.design)
    if not distance:
        return {}
    (size,) = (0.01 * row.size for row in uncertain_inputs(here.design) if row.name == HOVER_BLADE)
    mean = 0.5 * (by_part(here.power) + by_part(there.power))
    return {HOVER_BLADE: size * distance * mean * (1.0, 1.0, 0.0, 0.0)}


def with_other_inflow(design: Design) -> Design:
    """The design with the other of `COMPARED_INFLOWS`."""
    inflow = next(name for name in COMPARED_INFLOWS if name != design.models.inflow)
    return replace(design, models=replace(design.models, inflow=inflow))


@dataclass(frozen=True)
class _OtherTrim:
    design: Design
    start: Guess = field(compare=False)
    """Of the trim of the same design."""


def _powers_with_other_inflow(solution: Solution) -> Array | None:
    """By `PARTS` [W]; None where it does not trim."""
    return _powers(
        _OtherTrim(
            with_other_inflow(solution.design), replace(solution.start, inflow=None, box=None)
        )
    )


@lru_cache(maxsize=64)
def _powers(asked: _OtherTrim) -> Array | None:
    other = solve(asked.design, asked.start, FEW_DIGITS)
    return by_part(other.power) if other.converged else None


def known_power(solution: Solution) -> float:
    """Total power, or of a free rotor, which takes none from its shaft, drag times speed [W]."""
    power = solution.power
    return power.total - power.parasite if _is_free(solution.design) else power.total


def _mean_power(shares: Sequence[float], trims: Sequence[Analysis], induced: bool) -> float:
    powers = (
        trim.solution.power.induced if induced else known_power(trim.solution) for trim in trims
    )
    return sum(share * power for share, power in zip(shares, powers, strict=True))


def _is_free(design: Design) -> bool:
    return design.models.trim == "free-rotor"


def usual_inflows() -> tuple[str, ...]:
    """Names of the inflow models that most rotor codes have, the most detailed first."""
    return tuple(name for name, model in reversed(INFLOW_MODELS.items()) if model.usual)


def alternative_models(design: Design, against: Design | None = None) -> tuple[OtherModels, ...]:
    """A design, or two, solved with one model changed, a new trim each; those that do not trim are left out."""
    rows: list[OtherModels] = []
    for name, changed in other_models(design).items():
        here = solve(changed)
        there = None if against is None else solve(other_models(against).get(name, against))
        if here.converged and (there is None or there.converged):
            change = None if there is None else known_power(here) - known_power(there)
            rows.append(OtherModels(name, known_power(here), change))
    return tuple(rows)


def other_models(design: Design) -> dict[str, Design]:
    """The design with one model changed, by name: another wake, blades that bend or do not, and steady flow.

    In hover the other wake is one that answers the load, at the least speed that it has.
    """
    models, designs = design.models, dict[str, Design]()
    if design.hovering:
        slow, others = (
            design.at(mu=SLOWEST),
            [name for name in usual_inflows() if INFLOW_MODELS[name].load_dependent],
        )
        flown = {
            name: replace(models, inflow=name, low_speed="wake")
            for name in others
            if models.disk_axial_flow
        }
        return {f"inflow {name}": replace(slow, models=one) for name, one in flown.items()}
    for name in usual_inflows():
        if name != models.inflow:
            designs[f"inflow {name}"] = replace(design, models=replace(models, inflow=name))
    structure = design.rotor.blade.structure
    if structure is not None and structure.bends and models.flapping:
        name = "rigid in bending" if models.bending else "bending"
        designs[name] = replace(design, models=replace(models, bending=not models.bending))
    if models.has("unsteady"):
        designs["unsteady flow off"] = replace(design, models=replace(models, unsteady=False))
    return designs
