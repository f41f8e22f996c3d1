"""Twist laws as people write them: SPECs such as `segments:-12,-4@0.5` (DESIGN §8), and two-column tables."""

import math
import re
from collections.abc import Callable
from pathlib import Path

from rotor.assets import SHIPPED_ROTORS
from rotor.design.twist import (
    IdealTwist,
    LinearTwist,
    PiecewiseLinearTwist,
    QuadraticTwist,
    SplineTwist,
    SumTwist,
    TableTwist,
    TwistLaw,
)

_LAWS = ("linear", "quadratic", "segments", "spline", "points", "ideal", "builtin", "table", *SHIPPED_ROTORS)
_PLUS = re.compile(rf"\+(?=(?:{'|'.join(_LAWS)})\b)")
"""Between the laws of a sum; a plus sign in a number or in a file's name is none."""


def _no_name(name: str) -> TwistLaw | None:
    del name
    return None


def parse_twist(
    spec: str,
    *,
    builtin: TwistLaw,
    ideal_tip_pitch: float,
    named: Callable[[str], TwistLaw | None] = _no_name,
) -> TwistLaw:
    """Read a twist SPEC (DESIGN §8), degrees at this edge only.

    `linear:-8` · `quadratic:A,D` · `segments:-12,-4@0.5` · `spline:9,6,0,-5@0.13,0.4,0.75,1` ·
    `points:9,6,0,-5@0.13,0.4,0.75,1` (straight lines between) · `ideal` or `ideal:6.4` · `builtin`, the rotor's own ·
    `uh60a` and the like, a shipped rotor's · `table:FILE`; `builtin+linear:-2` adds one to another. `named` knows the
    shipped rotors' twists; `ideal_tip_pitch` [rad] serves `ideal` without a number.
    Raises ValueError with one sentence that names the value and the remedy.
    """
    first, *others = _PLUS.split(spec.strip())
    if others:
        law = parse_twist(first, builtin=builtin, ideal_tip_pitch=ideal_tip_pitch, named=named)
        for other in others:
            added = parse_twist(other, builtin=builtin, ideal_tip_pitch=ideal_tip_pitch, named=named)
            law = SumTwist(law, added)
        return law
    kind, _, rest = spec.strip().partition(":")
    if not rest and kind in ("builtin", builtin.spec()):
        return builtin
    known = named(kind) if not rest else None
    if known is not None:
        return known
    if kind == "ideal":
        return IdealTwist(math.radians(_number(rest, spec)) if rest else ideal_tip_pitch)
    if kind == "linear":
        return LinearTwist(math.radians(_number(rest, spec)))
    if kind == "quadratic":
        values = [_number(item, spec) for item in rest.split(",")]
        if len(values) != 2:
            raise ValueError(f"twist {spec!r} needs two numbers: write quadratic:A,D, for example quadratic:6,-14")
        return QuadraticTwist(math.radians(values[0]), math.radians(values[1]))
    if kind == "segments":
        rates, _, breaks = rest.partition("@")
        return PiecewiseLinearTwist(
            tuple(math.radians(_number(item, spec)) for item in rates.split(",")),
            tuple(_number(item, spec) for item in breaks.split(",")) if breaks else (),
        )
    if kind == "spline":
        angles, _, stations = rest.partition("@")
        return SplineTwist(
            tuple(_number(item, spec) for item in stations.split(",")) if stations else (),
            tuple(math.radians(_number(item, spec)) for item in angles.split(",")),
        )
    if kind == "points":
        angles, _, stations = rest.partition("@")
        return TableTwist(
            tuple(_number(item, spec) for item in stations.split(",")) if stations else (),
            tuple(math.radians(_number(item, spec)) for item in angles.split(",")),
            name=spec.strip(),
        )
    if kind == "table" and rest:
        return read_twist_table(Path(rest))
    raise ValueError(
        f"twist {spec!r} is not known: "
        "use linear:RATE, quadratic:A,D, segments:RATES@BREAKS, spline:ANGLES@STATIONS, "
        "points:ANGLES@STATIONS, ideal, builtin, uh60a or table:FILE"
    )


def inline_spec(law: TwistLaw) -> str:
    """The SPEC of a law as any other machine can read it: the rows of a table file in place of its name."""
    match law:
        case TableTwist(stations, angles, name) if name.startswith("table"):
            degrees = ",".join(f"{round(math.degrees(angle), 6):.10g}" for angle in angles)
            return f"points:{degrees}@{','.join(f'{station:.10g}' for station in stations)}"
        case SumTwist(base, change):
            return f"{inline_spec(base)}+{inline_spec(change)}"
        case _:
            return law.spec()


def read_twist_table(path: Path) -> TableTwist:
    """Read a two-column text table, r/R and twist in degrees; `#` starts a comment, commas or blanks separate."""
    if not path.is_file():
        raise ValueError(f"twist table {str(path)!r} does not exist: give the path of a two-column file (r/R, degrees)")
    rows: list[tuple[float, float]] = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        items = line.partition("#")[0].replace(",", " ").split()
        if not items:
            continue
        try:
            r, angle = (float(item) for item in items)
        except ValueError:
            if not rows and not items[0].replace(".", "").lstrip("+-").isdigit():
                continue  # a heading row
            raise ValueError(
                f"twist table {str(path)!r} line {number} reads {line.strip()!r}: write two numbers, r/R and degrees"
            ) from None
        if not (0.0 <= r <= 1.0 and math.isfinite(angle) and abs(angle) <= 60.0):
            raise ValueError(
                f"twist table {str(path)!r} line {number} has r/R {r:g} and {angle:g}°: keep r/R in 0…1, twist in ±60°"
            )
        rows.append((r, math.radians(angle)))
    return TableTwist(tuple(r for r, _ in rows), tuple(a for _, a in rows), name=f"table:{path}")


def _number(text: str, spec: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value) or abs(value) > 100.0:
        raise ValueError(f"twist {spec!r} holds {text!r}, not a number in −100…100: write for example linear:-8")
    return value
