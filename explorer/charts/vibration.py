"""The chart of the vibration index of blades that bend over speed.

It is computed while the page rests, given up for newer input, and taken up again where it was left.
"""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from explorer.charts.plots import SWEEP, Range, held_range
from explorer.charts.strip import Role, now_dot, role_line
from explorer.model.units import number
from rotor import Design, Solution, hub_loads
from rotor.support.arrays import Array
from rotor.support.chart import Axis, Chart, Rule
from rotor.trim import DEFAULT_OPTIONS, Analysis, Guess, analyse, why_no_hub_loads
from rotor.trim.no_hub_loads import SLOWEST

SPEEDS = tuple(mu for mu in SWEEP if mu >= SLOWEST)
"""Advance ratios of the index over speed."""
_KEPT = 50
"""Curves remembered per session."""

Superseded = Callable[[], bool]


def stopping(superseded: Superseded) -> Callable[[Design, Solution | Guess | None], Analysis]:
    """`rotor.trim.analyse` that ends without a trim once newer input waits."""
    options = replace(DEFAULT_OPTIONS, stop=superseded)
    return lambda design, start: analyse(design, start, options)


class IndexCurves:
    """Curves of the vibration index of one session; a curve belongs to a design at any speed."""

    def __init__(self) -> None:
        self._curves: dict[Design, dict[float, float]] = {}
        """Index [%] by advance ratio as far as it is known; NaN without a trim."""

    def known(self, design: Design) -> Array:
        """Index [%] at `SPEEDS`; NaN where it is not known."""
        known = self._curves.get(_family(design), {})
        return np.array([known.get(mu, math.nan) for mu in SPEEDS])

    def left(self, design: Design) -> int:
        """How many speeds are still to be computed."""
        return len(SPEEDS) - len(self._curves.get(_family(design), {})) if _has_curve(design) else 0

    def sweep(self, design: Design, superseded: Superseded, shown: Callable[[], None]) -> None:
        """Compute what is missing of a design's curve, unless newer input comes; `shown`: there is more to draw."""
        if not self.left(design):
            return
        if len(self._curves) >= _KEPT:
            self._curves.clear()
        family = _family(design)
        known, start = self._curves.setdefault(family, {}), None
        for mu in SPEEDS:
            if mu in known:
                continue
            point = stopping(superseded)(family.at(mu=mu), start)
            if superseded():
                return
            stop = stopping(superseded)
            loads = hub_loads(point, solve=stop, band=False) if point.solution.converged else None
            known[mu] = math.nan if loads is None else loads.index
            if loads is None:  # Faster flight does not trim either, and each failed trim takes long.
                known.update(dict.fromkeys([later for later in SPEEDS if later > mu], math.nan))
                break
            start = replace(point.solution.start, factors=None)
            shown()
        shown()


def _family(design: Design) -> Design:
    """One design for every speed, with blades that bend."""
    return replace(design.at(mu=SLOWEST), models=replace(design.models, bending=True))


def _has_curve(design: Design) -> bool:
    return why_no_hub_loads(_family(design)) is None


def index_chart(
    curves: IndexCurves,
    solution: Solution,
    reference: Solution,
    index: float | None,
    held: Range | None = None,
    compared: Role = "reference",
) -> Chart | None:
    """Vibration index over µ of a design and its reference; None where no speed has one.

    index: at the present condition [%], None where there is none.
    """
    if not _has_curve(solution.design):
        return None
    indices, other = curves.known(solution.design), curves.known(reference.design)
    seen = [value for value in (*indices, *other, math.nan if index is None else index) if math.isfinite(value)]
    same = reference.design == solution.design
    left = curves.left(solution.design) + (0 if same else curves.left(reference.design))
    mus = np.array(SPEEDS)
    return Chart(
        "Vibration over µ",
        Axis("µ", (0.0, SWEEP[-1])),
        Axis(f"index, {index_unit(solution.design)}", held_range(held, 0.0, max(seen, default=math.nan))),
        (
            *([] if same else [role_line(compared, mus, other)]),
            role_line("saving", mus, indices),
            *([] if index is None else [now_dot(solution.design.condition.advance_ratio, index)]),
        ),
        (Rule(0.0, SLOWEST, f"none below µ {SLOWEST:g}"),),
        value=f"{left} speeds left" if left else "" if index is None else f"{number(index, 1)} %",
        note=f"Vibration index at the hub. It is not shown below µ {SLOWEST:g}, where it depends on the wake model.",
    )


def index_unit(design: Design) -> str:
    """What the index is a part of: a rotor on a test stand carries no weight."""
    return "% of weight" if design.condition.stand is None else "% of thrust"
