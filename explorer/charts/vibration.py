"""Charts of blades that bend: the vibration index over speed, and the fan plot, blade frequencies over rotor speed.

Both are computed while the page rests, given up for newer input, and taken up again where they were left.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from explorer.charts.plots import SWEEP, Range, held_range
from explorer.charts.strip import Role, now_dot, role_line
from explorer.model.units import number
from rotor import Design, Rotor, Solution, solve
from rotor.aero.bending import BladeFrequencies, blade_frequencies
from rotor.arrays import Array
from rotor.chart import Axis, Chart, Line, Points, Rule
from rotor.design import TwistLaw
from rotor.trim import DEFAULT_OPTIONS, Guess, hub_loads, why_no_hub_loads
from rotor.trim.hub_loads import SLOWEST

SPEEDS = tuple(mu for mu in SWEEP if mu >= SLOWEST)
"""Advance ratios of the index over speed."""
_KEPT = 50
"""Curves and fan plots remembered per session."""

Superseded = Callable[[], bool]


def stopping(superseded: Superseded) -> Callable[[Design, Solution | Guess | None], Solution]:
    """`rotor.trim.solve.solve` that ends without a trim once newer input waits."""
    options = replace(DEFAULT_OPTIONS, stop=superseded)
    return lambda design, start: solve(design, start, options)


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
            loads = hub_loads(point, stopping(superseded), band=False) if point.converged else None
            known[mu] = math.nan if loads is None else loads.index
            if loads is None:  # Faster flight does not trim either, and each failed trim takes long.
                known.update(dict.fromkeys([later for later in SPEEDS if later > mu], math.nan))
                break
            start = replace(point.start, factors=None)
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
        value=f"{left} speeds to go" if left else "" if index is None else f"{number(index, 1)} %",
        note=f"Vibration index at the hub. None below µ {SLOWEST:g}: there it is that of the wake model.",
    )


def index_unit(design: Design) -> str:
    """What the index is a part of: a rotor on a test stand carries no weight."""
    return "% of weight" if design.condition.stand is None else "% of thrust"


FAN_SPEEDS = (0.03, *(round(0.1 * k, 1) for k in range(1, 13)))
"""Rotor speeds of the fan plot over the rated one."""
_TOP = 9.0
"""Highest frequency of the plot over the rated speed."""
_KINDS = {
    "flap": ("var(--rx-induced)", ""),
    "lag": ("var(--rx-profile)", ""),
    "torsion": ("var(--rx-tail)", "5 3"),
}


@dataclass(frozen=True)
class FanKey:
    """What the frequencies depend on."""

    rotor: Rotor
    twist: TwistLaw
    collective_deg: int
    """Pitch at 0.75 R to the degree: by less the frequencies hardly change."""

    @classmethod
    def of(cls, solution: Solution) -> "FanKey":
        design = solution.design
        return cls(design.rotor, design.twist, round(math.degrees(solution.controls.collective)))

    def at(self, speed: float) -> BladeFrequencies | None:
        """At a rotor speed over the rated one [per rev of the rated one]."""
        rotor = replace(self.rotor, angular_speed=speed * self.rotor.angular_speed)
        frequencies = blade_frequencies(rotor, self.twist, math.radians(self.collective_deg))
        if frequencies is None:
            return None
        parts = (frequencies.flap, frequencies.lag, frequencies.torsion)
        return BladeFrequencies(*(tuple(speed * per_rev for per_rev in part) for part in parts))


class FanPlots:
    def __init__(self) -> None:
        self._found: dict[FanKey, dict[float, BladeFrequencies]] = {}

    def known(self, key: FanKey) -> dict[float, BladeFrequencies]:
        """By rotor speed over the rated one, as far as they are known."""
        return self._found.get(key, {})

    def solve(self, key: FanKey, superseded: Superseded) -> bool:
        """Compute what is missing, unless newer input comes; whether all is known."""
        if len(self._found) >= _KEPT and key not in self._found:
            self._found.clear()
        known = self._found.setdefault(key, {})
        for speed in FAN_SPEEDS:
            if speed not in known:
                if superseded():
                    return False
                frequencies = key.at(speed)
                if frequencies is None:
                    return False
                known[speed] = frequencies
        return True


def fan_chart(known: dict[float, BladeFrequencies], collective_deg: int) -> Chart:
    """Coupled flap-lag and torsion frequencies over rotor speed, with the rays of n/rev."""
    speeds, rated = sorted(known), known[1.0]
    percent = [100.0 * speed for speed in speeds]
    rays = [(n, min(FAN_SPEEDS[-1], _TOP / n)) for n in range(1, int(_TOP) + 1)]
    lines = [Line("", (0.0, 100.0 * end), (0.0, n * end), "var(--rx-faint)", width=0.8) for n, end in rays]
    modes = zip(*(_sorted(known[speed]) for speed in speeds), strict=False)
    named: set[str] = set()
    for mode in modes:
        kind = mode[-1][0]
        shown = ", ".join(number(value, 2) for value in getattr(rated, kind) if value <= _TOP) or "above 9"
        label = "" if kind in named else f"{kind} {shown}"
        named.add(kind)
        colour, dashes = _KINDS[kind]
        lines.append(Line(label, percent, [value for _, value in mode], colour, dashes))
    dots = [
        Points("", (100.0,), (value,), _KINDS[kind][0], size=3.2, words=(f"{kind} {number(value, 2)} per rev",))
        for kind, value in _sorted(rated)
        if value <= _TOP
    ]
    return Chart(
        "Blade frequencies",
        Axis("rotor speed [% of rated]", (0.0, 100.0 * FAN_SPEEDS[-1]), (0.0, 25.0, 50.0, 75.0, 100.0)),
        Axis("per rev; thin: n/rev", (0.0, _TOP), (0.0, 2.0, 4.0, 6.0, 8.0)),
        (*lines, *dots),
        (Rule(100.0, dashes="2 3"),),
        note="Per rev of the rated speed, at the dashed line; modes couple flap and lag and are named by what moves "
        f"most. Pitch {collective_deg}° at 0.75 R.",
    )


def _sorted(frequencies: BladeFrequencies) -> list[tuple[str, float]]:
    """Bending in ascending order, with its kind, then torsion."""
    bending = sorted([(value, "flap") for value in frequencies.flap] + [(value, "lag") for value in frequencies.lag])
    return [(kind, value) for value, kind in bending] + [("torsion", value) for value in frequencies.torsion]
