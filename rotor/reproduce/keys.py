"""Published effects of twist beside ours: Keys et al. 1987, −17.3° against −11.5° (thesis §3.3)."""

import numpy as np

from rotor.files.make_design import make_design
from rotor.reproduce.report import Panel, Report, Verdict, curve, table
from rotor.reproduce.runs import THESIS_WAKE, main_rotor_kw

STRONG, WEAK = -17.3, -11.5
HOVER, FAST, FAST_KMH = -0.024, 0.05, 330.0
"""Published: power of −17.3° over −11.5° in hover and at 330 km/h."""
NAMES = ("thesis", THESIS_WAKE, "flight")
SPEEDS_KMH = (0.0, 80.0, 120.0, 160.0, 200.0, 240.0, 260.0, 280.0, 290.0, 300.0)


def keys_1987() -> Report:
    """Two twists, hover to fast flight."""
    tip_speed = make_design().rotor.tip_speed
    ratios: dict[str, list[float]] = {}
    fastest: dict[str, float] = {}
    for name in NAMES:
        ratios[name] = []
        for speed in (*SPEEDS_KMH, FAST_KMH):
            mu = speed / 3.6 / tip_speed
            try:
                ratio = main_rotor_kw(name, STRONG, mu) / main_rotor_kw(name, WEAK, mu) - 1.0
                fastest[name] = speed
            except RuntimeError:  # Neither rotor need trim this fast; the place stays empty.
                ratio = float("nan")
            ratios[name].append(ratio)
    speeds = (*SPEEDS_KMH, FAST_KMH)
    last = {name: ratios[name][speeds.index(fastest[name])] for name in NAMES}
    hover = {name: ratios[name][0] for name in NAMES}
    slower = {name: _equal_power_kmh(name, fastest[name]) for name in NAMES}
    helps = [name for name in NAMES if hover[name] < 0.0]
    costs = [name for name in NAMES if last[name] > 0.0]
    percent = {name: [100.0 * value for value in ratios[name]] for name in NAMES}
    return Report(
        number="Keys 1987",
        kind="claim",
        caption="Power of linear twist −17.3° over that of −11.5°, beside the published wind-tunnel result of another "
        "rotor (quoted by the document).",
        statement="Keys et al.: −2.4 % in hover, +5 % at 330 km/h; 7.5 km/h slower for the same power (p. 26, 28).",
        ours="Hover: "
        + ", ".join(f"{100 * hover[name]:+.1f} % ({name})" for name in NAMES)
        + ". Fast: "
        + ", ".join(f"{100 * last[name]:+.1f} % at {fastest[name]:.0f} km/h ({name})" for name in NAMES)
        + ". Speed for equal power: "
        + ", ".join(f"{slower[name]:+.1f} km/h ({name})" for name in NAMES)
        + ".",
        verdict=Verdict.INDICATIVE,
        because=f"The sign in hover is theirs in {_among(helps)}, the sign at speed in {_among(costs)}. Another rotor "
        "(Mach-scaled, other sections and loading), so the numbers are not ours to meet.",
        tables=(
            table(
                "strong_over_weak_percent", ("speed_kmh", "mu", *NAMES, "published"),
                [
                    (
                        speed, speed / 3.6 / tip_speed, *(percent[name][k] for name in NAMES),
                        100.0 * HOVER if speed == 0.0 else 100.0 * FAST if speed == FAST_KMH else "",
                    )
                    for k, speed in enumerate(speeds)
                ],
            ),
        ),
        panels=(
            Panel(
                "speed [km/h]", "power of −17.3° over −11.5° [%]",
                (
                    *(curve(name, speeds, percent[name], "both", colour=k) for k, name in enumerate(NAMES)),
                    curve("Keys et al. 1987", (0.0, FAST_KMH), (100 * HOVER, 100 * FAST), "points", colour=7),
                ),
            ),
        ),
        numbers={
            **{f"{name}_hover": value for name, value in hover.items()},
            **{f"{name}_fast": value for name, value in last.items()},
            **{f"{name}_fastest_kmh": value for name, value in fastest.items()},
            **{f"{name}_slower_kmh": value for name, value in slower.items()},
            "finite": float(np.isfinite(ratios["flight"]).sum()),
        },
    )  # fmt: skip


def _equal_power_kmh(name: str, speed_kmh: float) -> float:
    """How much faster (negative: slower) the strong twist flies on the weak one's power at a speed [km/h]."""
    tip_speed = make_design().rotor.tip_speed
    around = speed_kmh + np.array([-20.0, -10.0, 0.0])
    powers = [main_rotor_kw(name, STRONG, float(speed) / 3.6 / tip_speed) for speed in around]
    wanted = main_rotor_kw(name, WEAK, speed_kmh / 3.6 / tip_speed)
    # Power over speed is a smooth curve: a parabola through three points, solved by its inverse.
    return float(np.polyval(np.polyfit(np.array(powers) - wanted, around, 2), 0.0)) - speed_kmh


def _among(names: list[str]) -> str:
    return f"{len(names)} of {len(NAMES)}" + (f" ({', '.join(names)})" if names else "")
