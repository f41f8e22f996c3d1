"""Figures 4.9 and 4.11: planform and twist of the blade as it is flown."""

import numpy as np

from rotor.airfoil.sections import load_installed
from rotor.files.make_design import uh60a_rotor, uh60a_twist
from rotor.reproduce.optimum_twist import UNKNOWN
from rotor.reproduce.report import Curve, Panel, Report, Verdict, curve, judged, table


def figure_4_9() -> Report:
    """The blade's planform."""
    rotor = uh60a_rotor("flight")
    blade = rotor.blade
    curves: list[Curve] = []
    rows: list[tuple[str | float, ...]] = []
    for span in blade.spans:
        ratio = load_installed(span.section).chord_ratio
        chord = float(blade.chord(0.5 * (span.start + span.end))) * ratio / rotor.radius
        rows.append((span.section, span.start, span.end, chord * rotor.radius))
        x = (span.start, span.end, span.end, span.start, span.start)
        front, back = 0.25 * chord, -0.75 * chord
        colour = 0 if span.section == "sc1095" else 1
        label = span.section.upper() if span.section not in [str(row[0]) for row in rows[:-1]] else ""
        curves.append(curve(label, x, (front, front, back, back, front), colour=colour))
    shares = {name: sum(float(r[2]) - float(r[1]) for r in rows if r[0] == name) for name in ("sc1095", "sc1094r8")}
    return Report(
        number="4.9",
        kind="figure",
        caption="Planform of the UH-60A blade as the flight preset has it: sections, chord, root cut-out; the 20° "
        "sweep of the tip and the trailing-edge tab are not modelled.",
        statement=UNKNOWN,
        ours=f"SC1095 over {100 * shares['sc1095']:.0f} % of the radius, SC1094 R8 over "
        f"{100 * shares['sc1094r8']:.0f} %, "
        "blended between.",
        verdict=Verdict.ALONE,
        because="Numbers and sources stand in assets/uh60a.toml.",
        tables=(table("spans", ("section", "start_r", "end_r", "chord_m"), rows),),
        panels=(Panel("r/R", "from the quarter chord, over R", tuple(curves), equal=True),),
        numbers=shares,
    )


def figure_4_11() -> Report:
    """The flown twist beside −16°."""
    law = uh60a_twist()
    r = np.linspace(0.2, 1.0, 321)
    angle = np.degrees(law(r))
    plain = float(np.polyfit(r, angle, 1)[0])
    weighted = float(np.polyfit(r, angle, 1, w=r)[0])  # polyfit squares its weights: r² here.
    return Report(
        number="4.11",
        kind="figure",
        caption="Built-in twist of the UH-60A and the linear twist that stands for it.",
        statement="The nonlinear twist is approximated by a linear −16° (p. 25).",
        ours=f"Straight line through it from 0.2 R to the tip: {plain:.1f}° unweighted, {weighted:.1f}° weighted by "
        "r².",
        verdict=judged(min(abs(plain + 16.0), abs(weighted + 16.0)) < 0.5),
        because="−16° is its linear equivalent; the often quoted −18° is a nominal value.",
        tables=(
            table("twist", ("r", "uh60a_deg", "linear_16_deg"), zip(r, angle, -16.0 * (r - 0.75), strict=True)),
        ),
        panels=(
            Panel(
                "r/R", "twist, zero at 0.75 R [°]",
                (curve("UH-60A", r, angle), curve("linear −16°", r, -16.0 * (r - 0.75), "dashed")),
            ),
        ),
        numbers={"unweighted": plain, "weighted": weighted},
    )  # fmt: skip
