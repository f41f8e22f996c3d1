"""Series of trims of one design: over speed, and with physical effects switched on one by one.

The power of an effect depends on the effects already on, so it is also computed with each effect removed on its own.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Unpack, cast

from rotor.aero.switches import SWITCHES, no_effect, with_switches
from rotor.columns.bending import LOADS
from rotor.design.active_twist import harmonics_text
from rotor.design.aircraft import reported_names
from rotor.design.design import Design, require_design
from rotor.design.quantities import ARGUMENTS, NUMBERS, SWEPT, Flight
from rotor.design.quantity import Quantity, check_names
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.limits import Limits
from rotor.optimisation.objective import Quantity as Objective
from rotor.optimisation.objective import WeightedCondition
from rotor.optimisation.schedule import Schedule, SchedulePlan, run_plan
from rotor.support.arrays import Array
from rotor.support.chart import Axis, Chart, Line
from rotor.support.plots import draw_chart
from rotor.support.table import Column, table
from rotor.support.units import KNOT, unit_of
from rotor.support.user_input import check_suffix, csv_text, extra_module, write_whole
from rotor.trim.assemble import evaluated
from rotor.trim.doubt import Doubt, doubt
from rotor.trim.hub_loads import hub_loads
from rotor.trim.many import solve_many
from rotor.trim.no_hub_loads import why_no_hub_loads
from rotor.trim.power import PowerBudget, power_around
from rotor.trim.solution import Solution, require_solution
from rotor.trim.solve import solve

HUB_COLUMNS = tuple(f"hub_{name}_{'n' if name[0] == 'f' else 'nm'}" for name in LOADS)
_INDICES = ("index_percent", "least_index_percent", "largest_index_percent")
VIBRATION = (*_INDICES, *HUB_COLUMNS, "flap_2_per_rev", "lag_1_per_rev", "torsion_1_per_rev")
"""Columns beside where blades bend: index of the loads on the hub at N_b per revolution, its band over inflow models,
their amplitudes, and frequencies of the blade."""
PARTS = ("induced", "profile", "parasite", "climb", "tail")
"""Parts of the total, as in `PowerBudget`."""
POWERS = ("total", "main_rotor", *PARTS)
_CHANGES = ("change_percent", "change_band_percent", "sureness")
SHARED_COLUMNS = (
    "rotor",
    "twist_deg_per_r",
    "pitch_per_rev",
    "twist_per_rev",
    "mass_kg",
    "altitude_m",
)
"""Columns of a sweep that are the same in all rows of one rotor at one weight and altitude."""


@dataclass(frozen=True, eq=False, repr=False)
class SweepTable:
    """The solutions of a sweep in order, as a sequence of `Solution` and as a table with `columns`."""

    solutions: tuple[Solution, ...]
    over: str = ""
    """What was swept, as the argument of `sweep`; empty where that is not known."""
    reference: str = ""
    """One of `labels`: what `change_percent` is relative to; empty: there is no such column."""

    def __post_init__(self) -> None:
        for solution in self.solutions:
            require_solution(solution)

    def __len__(self) -> int:
        return len(self.solutions)

    def __iter__(self) -> Iterator[Solution]:
        return iter(self.solutions)

    def __getitem__(self, index: int) -> Solution:
        return self.solutions[index]

    def __repr__(self) -> str:
        if not self.solutions:
            return "SweepTable(empty)"
        good = sum(solution.converged for solution in self.solutions)
        speeds = [solution.design.condition.advance_ratio for solution in self.solutions]
        names = ", ".join(dict.fromkeys(self.labels))
        return f"SweepTable({len(self)} rows, {names:.200}, mu {min(speeds):g} to {max(speeds):g}, {good} converged)"

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns, with the unit at the end of the name; without one it is a text or a ratio."""
        columns = sweep_columns([solution.design for solution in self.solutions])
        if not self.reference:
            return columns
        place = columns.index("caveats")
        return (*columns[:place], *_CHANGES, *columns[place:])

    def relative_to(self, name: str) -> "SweepTable":
        """This table with the columns `change_percent`, total power relative to the rows of one design, which
        `plot_power` then draws, and `change_band_percent` and `sureness` as `rotor.doubt` has them.

        name: one of `labels`, or the SPEC of a twist that one of them alone has; ValueError for any other.
        """
        labels = dict(
            zip(
                self.labels,
                (solution.design.twist.spec() for solution in self.solutions),
                strict=True,
            )
        )
        found = [label for label, spec in labels.items() if name in (label, spec)]
        if len(found) != 1:
            listed = "; ".join(labels)
            raise ValueError(
                f"{name!r} is {'several' if found else 'none'} of the designs of this sweep: use {listed}"
            )
        return replace(self, reference=found[0])

    @property
    def changes(self) -> tuple[float | None, ...]:
        """Total power of each row relative to that of `reference` at the same condition [%]; None where one of the two
        is not there."""
        at = _values(self.solutions, self.axis)
        powers = [
            solution.power.total if solution.converged else None for solution in self.solutions
        ]
        rows = list(zip(self.labels, at, powers, strict=True))
        base = {place: power for label, place, power in rows if label == self.reference}
        pairs = ((power, base.get(place)) for _, place, power in rows)
        return tuple(
            100.0 * (power / own - 1.0) if power is not None and own else None
            for power, own in pairs
        )

    @property
    def doubts(self) -> tuple[Doubt | None, ...]:
        """Uncertainty of each of `changes`; None if a row has no change or belongs to `reference`."""
        power = [one.converged and one.design.models.trim != "free-rotor" for one in self.solutions]
        rows = list(
            zip(self.labels, _values(self.solutions, self.axis), power, self.solutions, strict=True)
        )
        base = {place: one for label, place, has, one in rows if has and label == self.reference}
        return tuple(
            doubt(one, base[place]) if has and place in base and label != self.reference else None
            for label, place, has, one in rows
        )

    @property
    def axis(self) -> Quantity:
        """The swept quantity; if it was not recorded, the one that varies."""
        return SWEPT[self.over] if self.over in SWEPT else _swept(self.solutions)

    @property
    def labels(self) -> tuple[str, ...]:
        """Rotor, twist and n/rev of each row, as in "UH-60A, linear:-12"."""
        return tuple(_label(solution.design) for solution in self.solutions)

    @property
    def rows(self) -> tuple[tuple[float | str | None, ...], ...]:
        """One row per solution; None where a solution that did not converge has no power."""
        columns = self.columns
        none = [None] * len(self)
        changes, doubts = (self.changes, self.doubts) if self.reference else (none, none)
        sure = [
            (None, None) if one is None else (one.change_band_percent, one.sureness)
            for one in doubts
        ]
        return tuple(
            tuple(
                map(
                    (
                        _cells(solution, set(columns))
                        | dict(zip(_CHANGES, (change, *two), strict=True))
                    ).get,
                    columns,
                )
            )
            for solution, change, two in zip(self.solutions, changes, sure, strict=True)
        )

    def to_dict(self) -> dict[str, list[float | str | None]]:
        """The columns by name: what `pandas.DataFrame`, `polars.DataFrame` and `pyarrow.table` read as it is."""
        rows = self.rows
        return {name: [row[k] for row in rows] for k, name in enumerate(self.columns)}

    def to_csv(self, path: str | Path) -> None:
        """Write the table to a CSV file, with empty cells for what does not exist; ValueError for another suffix."""
        check_suffix(path, ".csv")
        write_whole(path, csv_text([self.columns, *self.rows]))

    def _repr_html_(self) -> str:
        rows = (
            [format(cell, ".5g") if isinstance(cell, float) else cell for cell in row]
            for row in self.rows
        )
        return table(map(Column, self.columns), rows).html()

    def to_dataframe(self) -> Any:
        """The table as a pandas DataFrame, with the unit of each column that has one in `attrs["units"]`.

        Raises MissingExtra with the remedy where pandas is missing.
        """
        frame = extra_module("pandas", "a data frame").DataFrame(self.to_dict())
        units = (
            (name, ARGUMENTS[name].unit if name in ARGUMENTS else unit_of(name))
            for name in self.columns
        )
        frame.attrs["units"] = {name: unit for name, unit in units if unit}
        return frame


def sweep(
    design: Design | Iterable[Design],
    mu: Iterable[float] | None = None,
    start: Solution | None = None,
    **others: Unpack[Flight[Iterable[float] | None]],
) -> SweepTable:
    """Solve one design, or each of several, over one quantity of the flight condition.

    Each trim starts from the last that converged.

    Parameters:
        design: one design, or several.
        mu: advance ratios. Give this or one other quantity that `make_design` takes as a number, such as `mass_kg`, in
            the unit of its name; everything else stays as in the design.
        start: an earlier solution to begin from, for designs of the same rotor.

    Returns:
        The solutions in order as a table, including those that did not converge.

    Raises:
        TypeError: an argument is not a design, or not exactly one quantity is given. Nothing has been solved then.
        ValueError: a value cannot be used.

    Example:
        >>> table = rotor.sweep(rotor.make_design(inflow="uniform"), mu=[0.1, 0.2, 0.3])
        >>> table.to_dict()["mu"]
        [0.1, 0.2, 0.3]
        >>> [solution.converged for solution in table]
        [True, True, True]
    """
    over_twists = {"twist": "rotor.sweep([design.with_twist(…), …], mu=[…])"}
    check_names(sweep, others, SWEPT, lambda name: over_twists.get(name, ""))
    asked = {"mu": mu, **others}
    axes: dict[str, Any] = {name: asked[name] for name in SWEPT if asked.get(name) is not None}
    if len(axes) != 1:
        raise TypeError(
            f"a sweep over {' and '.join(axes) or 'nothing'}: give one of {', '.join(SWEPT)}"
        )
    ((name, values),) = axes.items()
    if isinstance(values, str) or not hasattr(values, "__iter__"):
        raise TypeError(
            f"{name} is {values!r}: give a list, for example {name}={list(SWEPT[name].examples)}"
        )
    several, steps = hasattr(design, "__iter__") and not isinstance(design, str), list(values)
    designs = [
        require_design(item) for item in cast(Iterable[Design], design if several else (design,))
    ]
    rows = [[design.at(**cast(Any, {name: step})) for step in steps] for design in designs]
    near = [
        start if start and points and start.design.rotor == points[0].rotor else None
        for points in rows
    ]
    first = solve_many(
        [points[0] for points, given in zip(rows, near, strict=True) if points and given is None]
    )
    solutions: list[Solution] = []
    for points, last in zip(rows, near, strict=True):
        for k, point in enumerate(points):
            solution = first.pop(0) if k == 0 and last is None else solve(point, last)
            if solution.converged:
                last = solution
            solutions.append(solution.light())
    return SweepTable(tuple(solutions), name)


def schedule(
    design: Design,
    mu: Iterable[float],
    concepts: Sequence[str] = ("linear",),
    *,
    hours: Sequence[float] | None = None,
    quantity: Objective = "total",
    limits: Limits | None = None,
    starts: int = 4,
    seed: int = 0,
    processes: int = 1,
) -> Schedule:
    """The best twist at each advance ratio, the best fixed twist, and what changing the twist in flight saves beyond
    it.

    Parameters:
        design: the design whose twist is replaced; its own twist is the baseline.
        mu: advance ratios.
        concepts: names in `rotor.optimisation.CONCEPTS`, for example `linear` or `two-segment`.
        hours: time at each advance ratio [h]; by default the same at all.
        quantity: what to minimise, as in `optimise`.
        limits: of each search, as in `optimise`.
        starts: number of descents in each search.
        seed: of their starting points.
        processes: number of processes; the results do not depend on it.

    Returns:
        `Schedule.at(k, concept)` is the optimum at the k-th advance ratio in ascending order, `at(None, concept)` the
        fixed twist, `in_flight_gain(concept)` the gain of changing it in flight.

    Raises:
        TypeError: the design or the advance ratios are of another type.
        ValueError: a concept, a speed or a limit cannot be used.

    Example:
        >>> design = rotor.make_design(inflow="uniform", elements=12, azimuths=24)
        >>> gain = rotor.schedule(design, mu=[0.1, 0.3], starts=1).in_flight_gain("linear")
        >>> gain.moving <= gain.fixed <= gain.baseline  # mean power [W]
        True
    """
    if isinstance(mu, str) or not hasattr(mu, "__iter__"):
        raise TypeError(
            f"mu is {mu!r}: give a list of advance ratios, for example mu={list(SWEPT['mu'].examples)}"
        )
    if isinstance(concepts, str):
        raise TypeError(f"concepts is {concepts!r}: give a list, concepts=[{concepts!r}]")
    design, speeds = require_design(design), list(mu)
    times = [1.0] * len(speeds) if hours is None else list(hours)
    if len(times) != len(speeds):
        raise ValueError(f"{len(times)} hours for {len(speeds)} advance ratios: give one for each")
    weighted = sorted(zip(speeds, times, strict=True))
    flights = [WeightedCondition(design.at(mu=speed).condition, time) for speed, time in weighted]
    blades = tuple(find_concept(name) for name in concepts)
    plan = SchedulePlan(design, blades, tuple(flights), quantity, limits or Limits(), starts, seed)
    return run_plan(plan, processes=processes)


def plot_power(*tables: SweepTable, ax: Any = None) -> Any:
    """Plot power over the swept quantity: its parts for one design, the totals for several, or the change in power for
    a table that is relative to one of its designs. Returns the matplotlib axes.

    Raises TypeError for anything but sweeps.
    """
    if not tables or not all(
        isinstance(table, SweepTable)  # pyright: ignore[reportUnnecessaryIsInstance] - notebooks pass anything
        for table in tables
    ):
        raise TypeError(
            f"plot_power got {', '.join(type(table).__name__ for table in tables) or 'nothing'}: "
            "give what rotor.sweep returns, one table or several"
        )
    solutions = [solution for table in tables for solution in table]
    if len(tables) == 1 and tables[0].reference:
        return draw_chart(_change_chart(tables[0]), ax)
    over = {table.over for table in tables}
    axis = SWEPT[over.pop()] if len(over) == 1 and over <= set(SWEPT) else _swept(solutions)
    curves: dict[str, list[Solution]] = {}
    for solution in solutions:
        curves.setdefault(_label(solution.design), []).append(solution)
    if len(tables) == 1 and len(curves) == 1:
        climbs = any(solution.last_power.climb for solution in solutions)
        shown = [(part, solutions, part) for part in POWERS if climbs or part != "climb"]
    else:
        shown = [(name, curve, "total") for name, curve in curves.items()]
    lines = tuple(
        Line(name, _values(curve, axis), _kilowatts(curve, part), dots=True)
        for name, curve, part in shown
    )
    return draw_chart(Chart("", Axis(axis.axis_title), Axis("Power [kW]"), lines), ax)


def _change_chart(table: SweepTable) -> Chart:
    at = _values(table.solutions, table.axis)
    points = zip(table.labels, at, table.changes, strict=True)
    rows = [
        (label, place, math.nan if change is None else change) for label, place, change in points
    ]
    lines = tuple(
        Line(
            name,
            [x for one, x, _ in rows if one == name],
            [y for one, _, y in rows if one == name],
            dots=True,
        )
        for name in dict.fromkeys(table.labels)
    )
    return Chart(
        "", Axis(table.axis.axis_title), Axis(f"Power relative to {table.reference} [%]"), lines
    )


def _label(design: Design) -> str:
    """Rotor, twist, and what of pitch and twist follows the azimuth."""
    waves = {"pitch": design.pitch_per_rev, "active twist": design.linear_active_twist}
    parts = [
        f"{name} {harmonics_text(harmonics)}" for name, harmonics in waves.items() if harmonics
    ]
    return ", ".join([design.rotor.name, design.twist.spec(), *parts])


def _swept(solutions: Sequence[Solution]) -> Quantity:
    """What varies; the advance ratio where nothing does."""
    rotors: dict[str, list[Solution]] = {}
    for solution in solutions:  # Another rotor has its own mass.
        rotors.setdefault(solution.design.rotor.name, []).append(solution)
    varied = (
        row
        for row in NUMBERS.values()
        if any(len(set(_values(rotor, row))) > 1 for rotor in rotors.values())
    )
    return next(varied, NUMBERS["mu"])


def _values(solutions: Sequence[Solution], row: Quantity) -> list[float]:
    if row.name == "speed_kt":
        return [solution.design.airspeed / KNOT for solution in solutions]
    return [row.of(solution.design) for solution in solutions]


def _kilowatts(solutions: Sequence[Solution], part: str) -> list[float]:
    return [
        getattr(solution.power, part) / 1e3 if solution.converged else math.nan
        for solution in solutions
    ]


def sweep_columns(designs: Sequence[Design]) -> tuple[str, ...]:
    """Columns of a sweep over these designs."""
    names = ("speed_kt", *reported_names(design.unusual for design in designs))
    condition = (name for name in SWEPT if name in names)
    powers = (f"power_{part}_w" for part in POWERS)
    blade = ("rotor", "twist", "twist_deg_per_r", "pitch_per_rev", "twist_per_rev")
    columns = (*blade, *condition, "status", *powers, "caveats", "message")
    return (*columns, *VIBRATION) if any(design.models.bending for design in designs) else columns


def _cells(solution: Solution, columns: set[str]) -> dict[str, float | str | None]:
    """A row of a sweep by column; what is left out has no value."""
    design, power = solution.design, solution.last_power
    reason = why_no_hub_loads(design) if design.models.bending else None
    root = design.rotor.blade.root_cutout
    # Their difference over the radius between is the rate of a linear twist.
    ends = design.twist([root, 1.0])
    return {
        "rotor": design.rotor.name,
        "twist": design.twist.spec(),
        "twist_deg_per_r": round(math.degrees(ends[1] - ends[0]) / (1.0 - root), 9),
        "pitch_per_rev": harmonics_text(design.pitch_per_rev),
        "twist_per_rev": harmonics_text(design.linear_active_twist),
        "speed_kt": design.airspeed / KNOT,
        **design.numbers,
        "status": solution.status.value,
        **(
            {f"power_{part}_w": getattr(power, part) for part in POWERS}
            if solution.converged
            else {}
        ),
        "caveats": ", ".join(caveat.name for caveat in solution.caveats),
        "message": solution.message if reason is None else f"{solution.message} {reason.sentence}",
        **(
            dict(zip(VIBRATION, _vibration(solution), strict=True))
            if VIBRATION[0] in columns
            else {}
        ),
    }


def _vibration(solution: Solution) -> tuple[float | None, ...]:
    """`VIBRATION`; None for what there is not."""
    loads, frequencies = (
        hub_loads(solution) if solution.converged else None,
        solution.blade_frequencies,
    )
    modes = (
        (None,) * 3
        if frequencies is None
        else (frequencies.flap[1], frequencies.lag[0], frequencies.torsion[0])
    )
    if loads is None:
        return (*(None for _ in range(3 + len(LOADS))), *modes)
    return (loads.index, *(loads.band or (None, None)), *loads.amplitudes.values(), *modes)


@dataclass(frozen=True, eq=False)
class WaterfallStep:
    """One trim and its difference from a reference trim, without its fields: a page keeps thirty of them."""

    switch: Quantity | None
    """The switch changed; None at the start."""
    design: Design
    budget: PowerBudget | None
    """Power by parts; None where it did not trim."""
    message: str
    """How the trim ended."""
    hub_moment: float
    """[N m]"""
    against: PowerBudget | None
    """That of the last step before it that trimmed, or of the full model; None at the start."""
    note: str = ""
    """Why this switch has no effect here, as a clause."""
    around: Array | None = None
    """Total power over the azimuth [W], (azimuths,), the first at ψ = 0; None where it did not trim."""
    against_around: Array | None = None
    """The same of `against`."""

    @property
    def title(self) -> str:
        return self.switch.title if self.switch else "All switched off"

    @property
    def power(self) -> float | None:
        """Total power [W]; None if the step did not trim."""
        return None if self.budget is None else self.budget.total

    @property
    def change(self) -> dict[str, float] | None:
        """Change of each part of power by this step [W]; None for the first step and for one that did not trim."""
        if self.against is None or self.budget is None:
            return None
        return {part: getattr(self.budget, part) - getattr(self.against, part) for part in PARTS}

    @property
    def added(self) -> float | None:
        """The sum of `change` [W]."""
        change = self.change
        return None if change is None else sum(change.values())

    @property
    def added_around(self) -> Array | None:
        """`added` over the azimuth [W], (azimuths,), of which it is the mean; None where the two trims have other
        azimuths."""
        if self.around is None or self.against_around is None:
            return None
        if len(self.around) != len(self.against_around):
            return None
        return self.around - self.against_around


def waterfall_steps(
    design: Design, order: Sequence[str] = tuple(SWITCHES)
) -> Iterator[WaterfallStep]:
    """All switches on one after another, then each one off alone, each step trimmed when requested.

    The design's own switches have no effect. A step that does not trim is skipped: the next is compared with the last
    that did.
    """
    left = list(order)
    start = full = solve(with_switches(design, left))
    yield (step := _step(None, full, None))
    last = step
    for name in order:
        left.remove(name)
        full = solve(with_switches(design, left), start if start.converged else None)
        yield (step := _step(name, full, last))
        start, last = (full, step) if full.converged else (start, last)
    for name in order:
        yield _step(name, solve(with_switches(design, (name,)), full), step)


def _step(name: str | None, trim: Solution, against: WaterfallStep | None) -> WaterfallStep:
    switch, note = (None, "") if name is None else (SWITCHES[name], no_effect(trim.design, name))
    budget = trim.power if trim.converged else None
    return WaterfallStep(
        switch=switch,
        design=trim.design,
        budget=budget,
        message=trim.message,
        hub_moment=trim.hub_moment.size,
        against=None if against is None else against.budget,
        note=note,
        around=None if budget is None else power_around(*evaluated(trim), budget),
        against_around=None if against is None else against.around,
    )


@dataclass(frozen=True, eq=False)
class Waterfall:
    steps: tuple[WaterfallStep, ...]
    """All off, then one more on at each step; the last is the full model."""
    alone: tuple[WaterfallStep, ...]
    """Each switch off alone, compared with the full model."""

    @property
    def full(self) -> WaterfallStep:
        return self.steps[-1]

    @property
    def converged(self) -> bool:
        return all(step.budget is not None for step in (*self.steps, *self.alone))


def waterfall(design: Design) -> Waterfall:
    """Trim with the switches on one after another, then with each one alone off."""
    steps, on = tuple(waterfall_steps(design)), 1 + len(SWITCHES)
    return Waterfall(steps[:on], steps[on:])
