"""Twist laws as people write them: SPECs such as `segments:-12,-4@0.5` and two-column tables."""

import math
import re
import tomllib
from functools import cache
from pathlib import Path
from typing import Any

from rotor.assets import SHIPPED_ROTORS, asset_path
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
"""Between the laws of a sum, not the plus sign of a number or of a file's name."""
_NUMBER = re.compile(r"([-+−]?\d*\.?\d+)\s*°?")


def parse_twist(spec: str, *, builtin: TwistLaw | None = None, ideal_tip_pitch: float | None = None) -> TwistLaw:
    """The twist law of a SPEC. Angles in the SPEC are degrees, stations are r/R; the law returns radians.

    `linear:-8` · `quadratic:A,D` · `segments:-12,-4@0.5` · `spline:9,6,0,-5@0.13,0.4,0.75,1` ·
    `points:9,6,0,-5@0.13,0.4,0.75,1` (straight lines between the points) · `ideal:6.4` · `uh60a`, `r22` or `s61`, the
    built-in twist of a shipped rotor · `table:FILE`. A plus sign adds laws: `uh60a+linear:-2`.
    `builtin` is the law that the SPEC `builtin` stands for, `ideal_tip_pitch` [rad] the angle of `ideal` without a
    number; `make_design` and `Design.with_twist` supply both.
    Raises TypeError or ValueError with one sentence that names the value and the remedy.
    """
    if not isinstance(spec, str):  # pyright: ignore[reportUnnecessaryIsInstance] - notebooks pass numbers
        remedy = f'write "linear:{spec}"' if isinstance(spec, int | float) else 'write a text such as "linear:-12"'
        raise TypeError(f"twist {spec!r} is not a twist: {remedy} (degrees per radius), or pass a twist law")
    first, *others = _PLUS.split(spec.strip())
    if others:
        law = parse_twist(first, builtin=builtin, ideal_tip_pitch=ideal_tip_pitch)
        for other in others:
            law = SumTwist(law, parse_twist(other, builtin=builtin, ideal_tip_pitch=ideal_tip_pitch))
        return law
    kind, _, rest = spec.strip().partition(":")
    if not rest and builtin is not None and kind in ("builtin", builtin.spec()):
        return builtin
    if not rest and kind in SHIPPED_ROTORS:
        return shipped_twist(kind)
    if kind == "builtin":
        raise ValueError(
            f"twist {spec!r} needs a rotor: pass it to make_design, or name one of {', '.join(SHIPPED_ROTORS)}"
        )
    if kind == "ideal":
        if not rest and ideal_tip_pitch is None:
            raise ValueError(f"twist {spec!r} needs a rotor and a weight: pass it to make_design, or write ideal:6.4")
        return IdealTwist(math.radians(_number(rest, spec)) if rest or ideal_tip_pitch is None else ideal_tip_pitch)
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
    number = _NUMBER.fullmatch(spec.strip())
    bare = f"write linear:{number[1].replace('−', '-')} for a linear twist, or " if number else ""
    raise ValueError(
        f"twist {spec!r} is not known: {bare}"
        "use linear:RATE, quadratic:A,D, segments:RATES@BREAKS, spline:ANGLES@STATIONS, "
        "points:ANGLES@STATIONS, ideal, builtin, uh60a or table:FILE"
    )


@cache
def shipped_twist(name: str) -> TwistLaw:
    """The built-in twist of a shipped rotor as it flies, from its file in `assets/`."""
    main: dict[str, Any] = tomllib.loads(asset_path(f"{name}.toml").read_text(encoding="utf-8"))["main_rotor"]
    given = main.get("flown", main)
    if "linear_twist_deg" in given:
        return LinearTwist(math.radians(given["linear_twist_deg"]))
    return TableTwist(tuple(given["twist_r"]), tuple(math.radians(angle) for angle in given["twist_deg"]), name=name)


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
