"""What a page without a server computes from: polynomials about one design, by the sliders of its twist.

Least squares over trims, of total and induced power with their exact gradients, to fourth order, of all else to second.
Their error is measured at other trims. Sliders reach as far as the error of power is small.
"""

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from scipy.optimize import minimize
from scipy.stats import qmc

from explorer.colours import PARTS
from explorer.model.actuator_inputs import inputs_from_spec
from explorer.model.inputs import LAWS, ROWS, inputs_of
from explorer.model.sliders import limits
from rotor import Design, Solution, solve
from rotor.actuator.optimum import STATIONS, twisted
from rotor.design.quantity import Slider
from rotor.design.twist import REFERENCE_RADIUS, TwistLaw
from rotor.support.arrays import Array
from rotor.trim.analysis import Analysis, analysed, power_gradient
from rotor.trim.blade_distance import twist_difference
from rotor.trim.doubt import HOVER_BLADE, DoubtRow, doubt
from rotor.trim.many import analyse_many
from rotor.trim.newton import SolverOptions

MOST_HANDLES = 5
TOLERANCE = 0.002
"""Largest error of power over the power."""
_REACH = {"": 0.15, "°/R": 8.0, "°": 8.0, "°/R²": 16.0}
"""How far a slider goes to either side at first, by its unit; the first is of r/R."""
_SHARES = 1.0, 0.75, 0.55, 0.4, 0.3, 0.2, 0.1
"""Of that reach, until the error is small enough; with many sliders the first are too large."""
_TRIMS_PER_TERM, _DOUBTS_PER_TERM = 2.2, 1.5
"""Trims, and of these those with a band, over the terms of second order. Our choice: more lower the error little."""
_NEAR_CORNERS = 0.9
"""Where trims near the corners lie, over the distance of the corners, at which the error is measured. Our choice."""
_HELD = 30.0
"""Weight of the design that is shared."""
_MARGIN = 1.5
"""What is stated over the largest error measured: elsewhere it may be larger."""
_LEAST_DIRECTION = 1e-3
"""Least size of a direction of twist beside the largest that a band has."""
_DRAWN = 32
"""Trims at random twists at which the error is measured, beside those at the corners."""


@dataclass(frozen=True, eq=False)
class FittedSlider:
    """A slider, in its unit: `form` ends where the polynomials do."""

    name: str
    form: Slider
    value: float
    """Of the design that is shared."""

    @property
    def centre(self) -> float:
        return 0.5 * (self.form.low + self.form.high)

    @property
    def half(self) -> float:
        return 0.5 * (self.form.high - self.form.low)


@dataclass(frozen=True, eq=False)
class Family:
    """The designs about one of them that its sliders reach: of its twist law, or of the drive of its actuator."""

    shared: Design
    title: str
    handles: tuple[FittedSlider, ...]
    twist: Callable[[Sequence[float]], TwistLaw]
    """Of the numbers of the sliders."""
    by_number: Callable[[Sequence[float], Array], Array]
    """∂θ_tw(r) by these numbers [rad], (sliders, stations)."""
    breaks: tuple[int, ...] = ()
    """Sliders that are r/R where straight pieces meet."""
    base: TwistLaw | None = None
    """What the pieces are added to."""

    @property
    def here(self) -> Array:
        """Scaled sliders of the design that is shared."""
        return self.scaled([one.value for one in self.handles])

    def scaled(self, numbers: Sequence[float]) -> Array:
        """−1…1 over the sliders."""
        return np.array(
            [
                (number - one.centre) / one.half
                for number, one in zip(numbers, self.handles, strict=True)
            ]
        )

    def numbers(self, x: Array) -> list[float]:
        """Positions of the sliders, in their units, from scaled values −1…1."""
        return [one.centre + one.half * float(at) for at, one in zip(x, self.handles, strict=True)]

    def design(self, x: Array) -> Design:
        return replace(self.shared, twist=self.twist(self.numbers(x)))

    def slopes(self, x: Array, r: Array) -> Array:
        """∂θ_tw(r)/∂x, (sliders, stations)."""
        return self.by_number(self.numbers(x), r) * np.array([[one.half] for one in self.handles])


@dataclass(frozen=True, eq=False)
class Fitted:
    """A design and what its polynomials are made from and tested with."""

    family: Family
    solution: Solution
    x: Array
    """Scaled sliders of the trims that are fitted, (trims, sliders)."""
    trims: Sequence[Analysis]
    tested_x: Array
    tested: Sequence[Analysis]
    power: dict[str, Array]
    """Coefficients of each part [W], the total last."""

    @cached_property
    def exponents(self) -> Array:
        """Exponents of each term, in the order of every vector of coefficients, (terms, sliders)."""
        return _exponents(self.x.shape[1], 4)

    def fit(self, values: Callable[[Solution], Any]) -> Array:
        """Coefficients to second order of values of any shape, (terms, …)."""
        return self.fit_to(np.array([values(trim.solution) for trim in self.trims]))

    def fit_to(self, made: Array) -> Array:
        """`fit`, of values known at the trims, (trims, …)."""
        terms = _terms(self.x, _exponents(self.x.shape[1], 2))
        return _solved(terms, made.reshape(len(made), -1)).reshape(-1, *made.shape[1:])

    def at(self, coefficients: Array, x: Array) -> Array:
        """Values of a polynomial at scaled sliders, (points, …)."""
        return np.tensordot(_terms(x, self.exponents[: len(coefficients)]), coefficients, 1)

    @cached_property
    def errors(self) -> Array:
        """Errors of total power at the tested twists [W]."""
        return np.abs(self.at(self.power["total"], self.tested_x) - _totals(self.tested))

    @property
    def error(self) -> float:
        """Bound of the error of total power [W]: the largest of `errors`, with a margin."""
        return _MARGIN * float(self.errors.max())

    @cached_property
    def best(self) -> tuple[list[float], Solution]:
        """The twist of least power within the sliders, as their numbers, and its trim."""
        n, total = self.x.shape[1], self.power["total"]
        starts = (self.family.here, np.zeros(n), self.x[np.argmin(_totals(self.trims))])
        found = [
            minimize(lambda x: float(self.at(total, x[None])[0]), x0, bounds=[(-1.0, 1.0)] * n)
            for x0 in starts
        ]
        x = min(found, key=lambda one: one.fun).x
        values = [
            round(v, one.form.digits)
            for v, one in zip(self.family.numbers(x), self.family.handles, strict=True)
        ]
        return values, solve(self.family.design(self.family.scaled(values)), self.solution)

    @cached_property
    def doubts(self) -> tuple[Array, Array]:
        """How each uncertain input changes power and the change from the design that is shared [W]: coefficients,
        (terms, inputs) each; of the distance of the blades in hover, some in place of one."""
        shared = analysed(self.solution)
        n = math.ceil(_DOUBTS_PER_TERM * len(_exponents(self.x.shape[1], 2)))
        rows = [
            {row.name: row for row in doubt(trim, shared).rows}
            for trim in (*self.trims[:n], shared)
        ]
        names = [name for name in dict.fromkeys(itertools.chain(*rows)) if name != HOVER_BLADE]
        power, change = (
            np.array(
                [[getattr(row.get(name), kind, None) or 0.0 for name in names] for row in rows]
            )
            for kind in ("power", "change")
        )
        blades = [
            _along_twist(trim.solution.design, shared.solution.design, row.get(HOVER_BLADE))
            for trim, row in zip((*self.trims[:n], shared), rows, strict=True)
        ]
        change = np.hstack((change, _main_parts(np.array(blades))))
        terms = _terms(np.vstack((self.x[:n], self.family.here)), _exponents(self.x.shape[1], 2))
        of_power, of_change = (_solved(terms, values) for values in (power, change))
        # No change where nothing is changed.
        of_change[0] -= self.at(of_change, self.family.here[None])[0]
        return of_power, of_change


def _along_twist(design: Design, shared: Design, row: DoubtRow | None) -> Array:
    """The change by the distance of two blades [W], in parts along the span, (radii,).

    Its size has a kink at the twist that is shared, which no polynomial follows. Its parts grow evenly with the twist,
    and their root sum of squares is that size.
    """
    twist = twist_difference(design, shared)
    if row is None or not row.change:
        return np.zeros_like(twist)
    return row.change * twist / float(np.linalg.norm(twist))


def _main_parts(rows: Array) -> Array:
    """The rows turned to their main directions, (trims, directions): lengths stay, and directions without any go."""
    _, sizes, directions = np.linalg.svd(rows, full_matrices=False)
    return np.asarray(rows @ directions[sizes > _LEAST_DIRECTION * sizes[0]].T)


def fitted(solution: Solution) -> Fitted:
    """The polynomials about a trimmed design; ValueError with one sentence where there are none."""
    if not solution.converged:
        raise ValueError(
            f"The design is not trimmed, so no page can be made from it: {solution.message}"
        )
    design = solution.design
    if design.models.trim == "free-rotor":
        raise ValueError("A free rotor takes no power, so no twist lowers it: choose another trim.")
    of = _of_law if design.rotor.blade.carried is None else _of_drive
    count, error = len(of(design, 1.0).handles), math.inf
    if not 0 < count <= MOST_HANDLES:
        raise ValueError(
            f"The twist has {count or 'no'} sliders, and a travelling page has 1 to {MOST_HANDLES}: choose another "
            "law, for example linear or two segments."
        )
    for share in _SHARES[max(0, count - 3) :]:
        made = _made(of(design, share), solution)
        if made is None:
            continue
        error = made.error
        if error <= TOLERANCE * abs(solution.power.total):
            return made
    off = f"near its twist the power would be {error / 1e3:.1f} kW off"
    why = "with twists near its own it does not trim" if math.isinf(error) else off
    raise ValueError(
        f"No page can be made from this design: {why}. Choose a design farther from its limits."
    )


def _of_law(design: Design, share: float) -> Family:
    """share: of the reach of each slider."""
    inputs = inputs_of(design)
    law = replace(
        LAWS[inputs.law], base=design.rotor.builtin_twist if inputs.law == "builtin" else None
    )
    handles = list[FittedSlider]()
    for name, one in zip(law.inputs, law.parameters, strict=True):
        form = ROWS[name].slider
        assert form is not None
        reach, ends = (
            share * _REACH[one.shown_unit if one.angular else ""],
            limits(name, inputs.aircraft),
        )
        handles.append(_handle(name, form, getattr(inputs, name), reach, ends))

    def values(numbers: Sequence[float]) -> list[float]:
        return [one.from_shown(number) for number, one in zip(numbers, law.parameters, strict=True)]

    size = np.array([[one.from_shown(1.0)] for one in law.parameters])
    return Family(
        design,
        law.title,
        tuple(handles),
        lambda numbers: law.twist(values(numbers)),
        lambda numbers, r: law.slopes(values(numbers), r) * size,
        tuple(k for k, one in enumerate(law.parameters) if not one.angular),
        law.base,
    )


def _of_drive(design: Design, share: float) -> Family:
    """Of an actuator on board: the drive of each segment. share: of its range."""
    carried, bare = design.rotor.blade.carried, design.bare
    assert carried is not None
    inputs = inputs_from_spec(carried.spec)
    installed = inputs.installed(bare.rotor)
    actuator = installed.actuator
    sign = -1.0 if inputs.crossed and "crossed" in actuator.settings else 1.0
    shapes = np.array(
        [np.interp(STATIONS, installed.r, each) for each in installed.shapes_in(bare)]
    )
    shapes *= sign / actuator.drive_swing
    low, high = actuator.drive_range
    step = 10.0 ** math.floor(math.log10(0.01 * (high - low)))
    word, drives = "Voltage" if actuator.drive_unit == "V" else "Drive", inputs.driven_at(installed)
    handles = list[FittedSlider]()
    for k, value in enumerate(drives):
        name = f"{word} of segment {k + 1}" if len(drives) > 1 else word
        form = Slider(f"{name} [{actuator.drive_unit}]", low, high, step)
        handles.append(_handle(name, form, value, share * (high - low), (low, high)))
    zero = np.array([np.interp(REFERENCE_RADIUS, STATIONS, shape) for shape in shapes])
    return Family(
        design,
        carried.name.partition(" at ")[0],
        tuple(handles),
        lambda numbers: twisted(design.jig, np.array(numbers) @ shapes, carried.name),
        lambda _, r: np.array([np.interp(r, STATIONS, shape) for shape in shapes]) - zero[:, None],
    )


def _handle(
    name: str, form: Slider, value: float, reach: float, ends: tuple[float, float]
) -> FittedSlider:
    """A slider that goes as far as its reach and its ends let it, in whole steps."""
    room = value - ends[0], ends[1] - value
    down, up = (
        math.floor(min(reach, max(each, 0.0)) / form.step + 1e-9) * form.step for each in room
    )
    return FittedSlider(
        name, replace(form, low=round(value - down, 9), high=round(value + up, 9)), value
    )


def _made(family: Family, solution: Solution) -> Fitted | None:
    """None where a twist does not trim."""
    n = len(family.handles)
    count = math.ceil(_TRIMS_PER_TERM * len(_exponents(n, 2))) + 2
    corners = np.array(list(itertools.product((-1.0, 1.0), repeat=n)))
    # Denser towards the ends, where a polynomial errs most.
    between = qmc.Halton(n, scramble=False).random(max(count - len(corners), n) + 1)[1:]
    fit_x = np.vstack((np.sin(math.pi * (between - 0.5)), _NEAR_CORNERS * corners))
    tested_x = np.vstack(
        (corners, np.clip(np.random.default_rng(1).uniform(-1.2, 1.2, (_DRAWN, n)), -1.0, 1.0))
    )
    trims = list[Analysis]()
    for some in (corners, fit_x, tested_x[len(corners) :]):
        found = analyse_many(
            [family.design(x) for x in some], [solution] * len(some), SolverOptions(remedy=False)
        )
        if not all(trim.solution.converged for trim in found):
            return None
        trims += found
    m = len(corners)
    fit_trims, tested = trims[m : m + len(fit_x)], trims[:m] + trims[m + len(fit_x) :]
    return Fitted(
        family,
        solution,
        fit_x,
        fit_trims,
        tested_x,
        tested,
        _power(family, solution, fit_x, fit_trims),
    )


def _power(
    family: Family, solution: Solution, x: Array, trims: Sequence[Analysis]
) -> dict[str, Array]:
    """Coefficients of each part, exact at the design itself; profile power, with what dampers take, is what is left of
    the total."""
    n = x.shape[1]
    quartic = _exponents(n, 4)
    slopes = [
        _terms(x, np.maximum(quartic - row, 0)) * quartic[:, k]
        for k, row in enumerate(np.eye(n, dtype=int))
    ]
    here, exact = _HELD * _terms(family.here[None], quartic), solution.power
    rows = np.vstack((_terms(x, quartic), *slopes, here))
    along = [
        family.slopes(at, trim.linear.problem.disk.r) for at, trim in zip(x, trims, strict=True)
    ]
    found = dict[str, Array]()
    for name in ("induced", "total"):
        values = [getattr(trim.solution.power, name) for trim in trims]
        by = [
            power_gradient(trim, name).along(each) for trim, each in zip(trims, along, strict=True)
        ]
        found[name] = _solved(
            rows, np.concatenate((values, np.array(by).T.ravel(), [_HELD * getattr(exact, name)]))
        )
    few = _terms(x, _exponents(n, 2))
    for name in ("parasite", "climb"):
        quadratic = _solved(few, [getattr(trim.solution.power, name) for trim in trims])
        found[name] = np.pad(quadratic, (0, len(quartic) - len(quadratic)))
    # The tail rotor's power follows the total.
    slope, offset = np.polyfit(_totals(trims), [trim.solution.power.tail for trim in trims], 1)
    found["tail"] = slope * found["total"]
    found["tail"][0] += offset
    for name, coefficients in found.items():
        coefficients[0] += getattr(exact, name) - float(here[0] @ coefficients) / _HELD
    total = found.pop("total")
    found["profile"] = total - sum(found.values())
    return {name: found[name] for name in PARTS} | {"total": total}


def _solved(terms: Array, values: Any) -> Array:
    """Coefficients by least squares."""
    return np.asarray(np.linalg.lstsq(terms, values)[0], dtype=np.float64)


def _totals(trims: Sequence[Analysis]) -> Array:
    return np.array([trim.solution.power.total for trim in trims])


def _exponents(n: int, degree: int) -> Array:
    """Of all terms up to a degree, those of low degree first, (terms, n)."""
    orders = (
        itertools.combinations_with_replacement(range(n), order) for order in range(1, degree + 1)
    )
    return np.array(
        [np.zeros(n, int), *(np.bincount(ks, minlength=n) for ks in itertools.chain(*orders))]
    )


def _terms(x: Array, exponents: Array) -> Array:
    """(points, terms)"""
    return np.prod(x[:, None, :] ** exponents, axis=2)
