"""Pieces of drawings that stand alone, in reports and pictures: words of any size, pictures, long lines; as SVG."""

import base64
from collections.abc import Sequence
from html import escape

import numpy as np

from rotor.arrays import Array


def text(
    x: float, y: float, words: str, size: float, *, anchor: str = "start", weight: int = 400, opacity: float = 1.0
) -> str:
    """Words whose baseline starts, is centred or ends at a point."""
    look = f'font-size="{size:g}" text-anchor="{anchor}"'
    look += f' font-weight="{weight}"' if weight != 400 else ""
    look += f' opacity="{opacity:g}"' if opacity < 1.0 else ""
    return f'<text x="{x:.1f}" y="{y:.1f}" fill="currentColor" {look}>{escape(words)}</text>'


def image(x: float, y: float, wide: float, high: float, png: bytes) -> str:
    """A PNG inside the drawing."""
    data = base64.b64encode(png).decode("ascii")
    return (
        f'<image x="{x:.2f}" y="{y:.2f}" width="{wide:.2f}" height="{high:.2f}" href="data:image/png;base64,{data}"/>'
    )


def polylines(lines: Sequence[Array], digits: int = 1) -> str:
    """The `d` of a path through lines of points (n, 2); a line that ends where it began is closed."""
    parts = []
    for line in lines:
        points = [f"{x:.{digits}f},{y:.{digits}f}" for x, y in line]
        closed = len(points) > 2 and points[0] == points[-1]
        parts.append("M" + "L".join(points[:-1] if closed else points) + ("Z" if closed else ""))
    return "".join(parts)


def joined(segments: Array, tolerance: float = 1e-6) -> list[Array]:
    """Segments (n, 2, 2) as lines: those that share an end are one line."""
    keys = [tuple(map(tuple, np.rint(segment / tolerance).astype(int))) for segment in segments]
    at: dict[tuple[int, ...], list[int]] = {}
    for k, ends in enumerate(keys):
        for end in ends:
            at.setdefault(end, []).append(k)
    left, lines = set(range(len(keys))), []
    for first in range(len(keys)):
        if first not in left:
            continue
        left.discard(first)
        line = [segments[first][0], segments[first][1]]
        for forward in (True, False):
            end = keys[first][1 if forward else 0]
            while (k := next((k for k in at[end] if k in left), None)) is not None:
                left.discard(k)
                ahead = 1 if keys[k][0] == end else 0
                end = keys[k][ahead]
                line.insert(len(line) if forward else 0, segments[k][ahead])
        lines.append(np.array(line))
    return lines
