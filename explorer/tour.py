"""A tour of one minute: six stops made of the lecture's parts, in which the sliders move by themselves."""

from dataclasses import dataclass, replace
from itertools import accumulate

from explorer.pinned import FLIGHT
from explorer.state import LAWS, Inputs, ViewState

_REST = 0.25
"""Part of a stop at its beginning, and again at its end, in which nothing moves, so that the caption can be read."""


@dataclass(frozen=True)
class TourStop:
    """One stop: the sliders move from one state to another under one caption."""

    seconds: float
    caption: str
    start: Inputs
    end: Inputs
    field: str = "Angle of attack"
    """Quantity on the disk."""
    exaggeration: float = 4.0
    """Twist exaggeration of the drawn blades."""


@dataclass(frozen=True)
class TourInstant:
    """What the page shows at one time of the tour."""

    stop: int
    caption: str
    inputs: Inputs
    field: str
    exaggeration: float
    reference: Inputs
    """What the change of power is counted from: the start of the stop."""

    def view(self, view: ViewState) -> ViewState:
        """The visitor's view with what the stop shows."""
        return replace(view, field=self.field, exaggeration=self.exaggeration, difference=False)


_BUILT = Inputs(law="builtin")
_LINEAR = Inputs(law="linear", linear=-8.0)
_TWO = Inputs(law="two", two_inner=-10.6, two_outer=-10.6, two_division=0.7, advance_ratio=0.3)

STOPS: tuple[TourStop, ...] = (
    TourStop(
        10.0,
        "A UH-60A rotor, trimmed at every instant. As speed rises, induced power falls and parasite power climbs.",
        replace(_BUILT, advance_ratio=0.1),
        replace(_BUILT, advance_ratio=0.28),
    ),
    TourStop(
        10.0,
        "Twist in hover: the tip turns nose-down, lift moves inboard, and induced power falls.",
        replace(_LINEAR, linear=0.0, advance_ratio=0.0),
        replace(_LINEAR, linear=-16.0, advance_ratio=0.0),
        "Induced inflow λi",
    ),
    TourStop(
        10.0,
        "Forward flight has its optimum near −10° of jig twist, and it is flat: 4° more cost less than one per cent.",
        replace(_LINEAR, linear=-10.5, advance_ratio=0.25),
        replace(_LINEAR, linear=-14.5, advance_ratio=0.25),
        "Induced inflow λi",
    ),
    TourStop(
        10.0,
        "Faster still: reverse flow grows on the retreating side, drag divergence on the advancing tip.",
        replace(_BUILT, advance_ratio=0.25),
        replace(_BUILT, advance_ratio=0.38),
    ),
    TourStop(
        10.0,
        "Two segments can do better than one: Optimise finds their rates and where they meet.",
        _TWO,
        replace(_TWO, two_inner=-4.0, two_outer=-15.6),
        "Thrust dT/dr",
    ),
    TourStop(
        10.0,
        "Your turn: drag the twist, and watch the power.",
        _BUILT,
        _BUILT,
    ),
)
SECONDS = sum(stop.seconds for stop in STOPS)
"""[s] the whole tour takes."""
_ENDS = tuple(accumulate(stop.seconds for stop in STOPS))


def tour_at(time: float) -> TourInstant | None:
    """What is shown `time` [s] after the start; None once the tour has ended."""
    if time >= SECONDS:
        return None
    time = max(time, 0.0)
    k = next(k for k, end in enumerate(_ENDS) if time < end)
    stop = STOPS[k]
    passed = (time - (_ENDS[k] - stop.seconds)) / stop.seconds
    part = (passed - _REST) / (1.0 - 2.0 * _REST)
    inputs = stop.start if part <= 0.0 else inputs_between(stop.start, stop.end, part)
    return TourInstant(k, stop.caption, inputs, stop.field, stop.exaggeration, stop.start)


def stop_begins(stop: int) -> float:
    """Time [s] at which a stop begins, to go back and forth."""
    return _ENDS[stop] - STOPS[stop].seconds


def eased(part: float) -> float:
    """0…1 with rest at both ends: 3t² − 2t³, clamped."""
    t = min(max(part, 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


def blend(before: float, after: float, weight: float) -> float:
    """Linear interpolation that is exact at both ends."""
    return after if weight >= 1.0 else before + weight * (after - before)


def inputs_between(before: Inputs, after: Inputs, part: float) -> Inputs:
    """Slider positions on the way from `before` to `after`; `part` 0…1, eased at both ends.

    The numbers of the flight condition and, within one twist law, those of the law move. Everything else is that of
    `after` at once, and so is the speed where either of the two hovers, because hover is another model.
    """
    if part >= 1.0:
        return after
    names: set[str] = set(FLIGHT)
    if before.advance_ratio == 0.0 or after.advance_ratio == 0.0:
        names.discard("advance_ratio")
    if before.law == after.law:
        names.update(LAWS[after.law].inputs)
    weight = eased(part)
    return replace(after, **{name: blend(getattr(before, name), getattr(after, name), weight) for name in names})
