"""Numbers and slider positions on the way from one state to another, for playback."""

from dataclasses import replace

from explorer.pinned import FLIGHT
from explorer.state import LAWS, Inputs


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
