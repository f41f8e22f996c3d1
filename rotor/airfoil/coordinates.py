"""Coordinate files of section outlines: the points of a file, whatever their order, as one loop in chord lengths.

Read are files that go round the section once from any point either way (Selig's begin at the trailing edge), and files
with the two sides one after the other from nose or trailing edge (Lednicer's, with or without counts). Lines of words
above the points, below them and between the two sides are left out; of points in space, the two coordinates that change
are the section's.
"""

import numpy as np

from rotor.airfoil.numbers import number_of
from rotor.support.arrays import Array

_FEWEST, _MOST = 20, 2000
_SIDE_GAP = 0.5
"""[chord] between rows that are no neighbours on the section: the other side begins, or the row is no point."""
_SAME_POINT = 1e-6
"""[chord] between two points that are one."""
_LEAST_COUNT = 5
_ZERO_ROW_DETOUR = 0.03
"""[chord] of further way by a last row 0 0 that is no point of the outline."""
_POINT_DETOUR = 0.05
"""[chord] of further way by a point that is none of the section's."""
_TRAILING_EDGE = 0.05
"""[chord] ahead of the last point where a step up is that across a blunt trailing edge."""
_LONGEST_OUTLINE = 3.0
"""[chord] round a section: 2 for a flat plate, 2.4 for an ellipse of 50 %. Points out of order need far more."""
_OFF_PLACE, _OFF_CHORD = 0.05, 0.1
"""[chord] by which nose and length of an outline may differ from 0 and 1 without being moved and scaled."""
_EDGE, _BLUNTER = 0.03, 3.0
"""[chord] from either end; where the rear is so many times thicker than the front, the nose is aft."""
_LEAST_AREA = 0.22
"""Of a section, over thickness times chord: 0.69 for NACA sections, 0.5 for a diamond, 0.25 for Eppler 376, whose tail
is thin; less if lines cross."""
_ORDER = "list the points from the trailing edge over the upper side to the nose and back along the lower side"
_NOT_ROUND = f"does not go around a section exactly once: {_ORDER}"


def read_coordinates(text: str, name: str) -> tuple[Array, str]:
    """The outline in `text`, (n, 2): from the upper trailing edge forward around the nose, x aft and y up [chord].

    Repeated points are dropped; a sharp trailing edge is both first and last. An outline elsewhere, of another length
    or with its nose aft is brought to x 0 to 1; beside the outline stands what was done, as words. Raises ValueError
    with one sentence that names the line of `name` and the remedy.
    """
    points, lines, words = _rows(text, name)
    counts, left = points[0], len(points) - 1
    if (
        np.all(counts >= _LEAST_COUNT)
        and not np.any(counts % 1.0)
        and abs(counts.sum() - left) < 0.1 * left
    ):
        points[0] = np.inf  # Lednicer's: no point of the outline, whatever its unit.
    # The first or the last row may be a heading of two numbers, or a stray 0 0.
    chord = float(np.ptp(points[1:-1, 0]))
    if not chord > 0.0:
        raise ValueError(
            f"{name}: x is {points[1, 0]:g} in all rows: give `x y` of an outline, one point per line"
        )
    runs = np.split(
        np.arange(len(points)),
        1 + np.flatnonzero(np.hypot(*np.diff(points, axis=0).T) > _SIDE_GAP * chord),
    )
    starts = {int(run[0]) for run in runs}
    for at, number in words.items():
        if at not in starts:
            raise ValueError(
                f"{name}, line {number}: text interrupts the points of one side: remove the line"
            )
    runs = [run for k, run in enumerate(runs) if len(run) > 1 or 0 < k < len(runs) - 1]
    if len(runs) > 2:
        line = lines[int(min(runs[1:], key=len)[0])]
        raise ValueError(
            f"{name}, line {line}: the outline jumps to this point: correct it, or {_ORDER}"
        )
    order = np.concatenate((runs[0][::-1], runs[1])) if len(runs) == 2 else runs[0]
    if not points[order[-1]].any() and _detours(points[order])[-1] > _ZERO_ROW_DETOUR * chord:
        order = order[:-1]
    if len(runs) == 1 and np.hypot(*(points[order[0]] - points[order[-1]])) > _SIDE_GAP * chord:
        raise ValueError(f"{name} {_NOT_ROUND}")
    closed = _once(points[order], chord)
    loop = _from_trailing_edge(closed, chord)
    off = _detours(loop) > _POINT_DETOUR * chord
    # A coarse outline turns back at nose and trailing edge.
    off[0] = off[-1] = off[int(np.argmin(loop[:, 0]))] = False
    if off.any():
        line = lines[int(np.argmin(np.hypot(*(points - loop[np.argmax(off)]).T)))]
        raise ValueError(
            f"{name}, line {line}: the outline jumps to this point and back: correct it, or {_ORDER}"
        )
    loop, moved = _placed(loop, closed)
    if np.hypot(*np.diff(loop, axis=0).T).sum() > _LONGEST_OUTLINE or _area(
        loop
    ) < _LEAST_AREA * _thickest(loop):
        raise ValueError(f"{name} {_NOT_ROUND}")
    return loop, moved


def _placed(loop: Array, closed: Array) -> tuple[Array, str]:
    """An outline, opened and closed, with its nose at x 0 and its trailing edge at 1, and what was done to it."""
    chord, begin, moved = float(np.ptp(loop[:, 0])), float(loop[:, 0].min()), list[str]()
    unit = (loop - [begin, 0.0]) / chord
    if _across(unit, 1.0 - _EDGE) > _BLUNTER * _across(unit, _EDGE):
        loop = _from_trailing_edge(_once(closed * [-1.0, 1.0], chord), chord)
        chord, begin, moved = float(np.ptp(loop[:, 0])), float(loop[:, 0].min()), ["turned round"]
    if abs(begin) > _OFF_PLACE * chord:
        loop, moved = loop - [begin, 0.0], [*moved, f"moved by {-begin:.3g}"]
    if abs(chord - 1.0) > _OFF_CHORD:
        loop, moved = loop / chord, [*moved, f"divided by its chord of {chord:.4g}"]
    return loop, " and ".join(moved)


def _across(loop: Array, place: float) -> float:
    """Thickness of an opened loop of chord 1 that begins at x 0."""
    nose = int(np.argmin(loop[:, 0]))
    sides = (side[np.argsort(side[:, 0])] for side in (loop[: nose + 1], loop[nose:]))
    return float(np.ptp([np.interp(place, side[:, 0], side[:, 1]) for side in sides]))


def _rows(text: str, name: str) -> tuple[Array, list[int], dict[int, int]]:
    """The rows of two numbers, the line of each, and the lines of words by the row that follows."""
    rows: list[list[float]] = []
    lines: list[int] = []
    between: dict[int, int] = {}
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.partition("#")[0].replace(";", " ").replace(", ", " ").split()
        if len(words) == 1:
            words = words[0].split(",")
        values = [
            value for word in words if (value := number_of(word.removesuffix(","))) is not None
        ]
        if len(words) == len(values) and len(words) in ({2, 3} if not rows else {len(rows[0])}):
            rows.append(values)
            lines.append(number)
        elif words and rows:
            if len(values) == len(words) or (
                values and len(words) == 2 and not words[0][0].isalpha()
            ):
                raise ValueError(
                    f"{name}, line {number}: {line!r} is not `x y`: give two numbers per line"
                )
            between.setdefault(len(rows), number)
        if len(rows) > _MOST + 2:
            break
    if not _FEWEST <= len(rows) <= _MOST:
        count = f"more than {_MOST}" if len(rows) > _MOST else len(rows)
        raise ValueError(f"{name} has {count} points: a section outline needs {_FEWEST} to {_MOST}")
    between.pop(len(rows), None)
    points = np.array(rows, dtype=np.float64)
    if points.shape[1] == 3:
        flat = np.flatnonzero(np.ptp(points, axis=0) <= _SAME_POINT * np.ptp(points))
        if len(flat) != 1:
            raise ValueError(
                f"{name} has three numbers a line, x y z, of no flat section: give `x y`"
            )
        points = np.delete(points, flat, axis=1)
    return points, lines, between


def _detours(loop: Array) -> Array:
    """By how much each point makes a closed line longer."""
    before, after = np.roll(loop, 1, axis=0), np.roll(loop, -1, axis=0)
    return (
        np.hypot(*(loop - before).T) + np.hypot(*(after - loop).T) - np.hypot(*(after - before).T)
    )


def _once(loop: Array, chord: float) -> Array:
    """Without points that repeat the one before, or the first at the end; counter-clockwise with y up."""
    steps = np.hypot(*(loop - np.roll(loop, 1, axis=0)).T)
    loop = loop[steps > _SAME_POINT * chord]
    return loop if _area(loop) > 0.0 else loop[::-1]


def _from_trailing_edge(loop: Array, chord: float) -> Array:
    """A counter-clockwise loop opened at its trailing edge: without the points on a blunt one, at the last x of a sharp
    one, which becomes first and last."""
    x, step = loop[:, 0], np.roll(loop, -1, axis=0) - loop
    tail = x > x.max() - _TRAILING_EDGE * chord
    # From this point to the next.
    across = tail & np.roll(tail, -1) & (step[:, 1] > np.abs(step[:, 0]))
    if not across.any():
        loop = np.roll(loop, -int(np.argmax(x)), axis=0)
        return np.concatenate((loop, loop[:1]))
    longest = int(np.argmax(np.where(across, step[:, 1], 0.0)))
    first, last = (longest + 1) % len(loop), longest
    while across[first] and first != last:
        first = (first + 1) % len(loop)
    while across[last - 1] and last != first:
        last = (last - 1) % len(loop)
    return np.roll(loop, -first, axis=0)[: (last - first) % len(loop) + 1]


def _area(loop: Array) -> float:
    """Enclosed by a closed line, positive counter-clockwise."""
    x, y = loop.T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def _thickest(loop: Array) -> float:
    """Largest distance across x between the sides before and behind the nose of an opened loop of chord 1."""
    nose = int(np.argmin(loop[:, 0]))
    place = np.linspace(float(loop[nose, 0]), float(loop[:, 0].max()), 201)
    upper, lower = (side[np.argsort(side[:, 0])] for side in (loop[: nose + 1], loop[nose:]))
    return float(
        np.abs(
            np.interp(place, upper[:, 0], upper[:, 1]) - np.interp(place, lower[:, 0], lower[:, 1])
        ).max()
    )
