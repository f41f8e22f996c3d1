"""Figures 2.6–2.8: velocities, inflow and thrust over the disk, in hover and in forward flight."""

import math
from dataclasses import replace

import numpy as np

from rotor.files.make_design import make_design
from rotor.reproduce.report import Curve, DiskPanel, PlotPanel, Report, curve, floats, judged, table
from rotor.reproduce.runs import solved
from rotor.trim.solution import DiskFields
from rotor.trim.solve import solve

FINE = 200
"""Elements of fig. 2.7: enough to see the load fall within the last per cent of the blade."""
FAST = 0.30
"""Advance ratio of fig. 2.8; the thesis states none."""


def figure_2_6() -> Report:
    """Velocities in hover."""
    disk = solved("thesis", "linear:-16", 0.0).require().disk
    spread = float(np.ptp(disk.u_t, axis=1).max())
    slope = float(np.polyfit(disk.r, disk.u_t[:, 0], 1)[0])
    return Report(
        number="2.6",
        kind="figure",
        caption="Velocity normal to the leading edge over the hovering disk, over ΩR.",
        statement="In hover the velocity distribution is the same at every azimuth (p. 13).",
        ours=f"Largest difference over azimuth {spread:.1e}; U_T/ΩR = {slope:.6f} r.",
        verdict=judged(spread < 1e-12 and abs(slope - 1.0) < 1e-9),
        because="The hovering rotor is solved annulus by annulus: U_T = Ωy.",
        tables=(table("u_t", ("r", "u_t"), zip(disk.r, disk.u_t[:, 0], strict=True)),),
        panels=(_disk(disk, disk.u_t, "U_T / ΩR", "hover"),),
        numbers={"spread_over_azimuth": spread, "slope": slope},
    )


def figure_2_7() -> Report:
    """Inflow and thrust in hover."""
    rows: list[tuple[float | str, ...]] = []
    inflow: list[Curve] = []
    thrust: list[Curve] = []
    numbers: dict[str, float] = {}
    for k, (preset, twist) in enumerate((("thesis", "linear:-16"), ("flight", "uh60a"))):
        design = make_design(preset=preset, twist=twist, mu=0.0)
        disk = solve(replace(design, models=replace(design.models, elements=FINE, azimuths=8))).require().disk
        lift = disk.dct[:, 0]
        inner, outer = _share(disk.r, disk.dr, lift, 0.5, 0.9), _share(disk.r, disk.dr, lift, 0.9, 1.0)
        at_peak = float(disk.r[int(lift.argmax())])
        at_tip = float(lift[-1] / lift.max())
        numbers |= {
            f"{preset}_share": inner, f"{preset}_tip_share": outer,
            f"{preset}_peak": at_peak, f"{preset}_tip_over_peak": at_tip,
        }  # fmt: skip
        rows += [(preset, r, v, f) for r, v, f in zip(disk.r, disk.induced[:, 0], lift, strict=True)]
        inflow.append(curve(f"{preset}, {twist}", disk.r, disk.induced[:, 0], colour=k))
        thrust.append(curve(f"{preset}, {twist}", disk.r, lift, colour=k))
    good = all(numbers[f"{p}_share"] > 0.5 and numbers[f"{p}_tip_over_peak"] < 2 / 3 for p in ("thesis", "flight"))
    return Report(
        number="2.7",
        kind="figure",
        caption="Induced velocity and thrust along the hovering blade.",
        statement="Both depend on the radius only; most thrust is made between 50 % and 90 % of the blade, little near "
        "the hub, and it falls fast at the tip by the tip loss (p. 13–14).",
        ours="; ".join(
            f"{p}: {100 * numbers[f'{p}_share']:.0f} % of the thrust between 0.5 R and 0.9 R, the most at "
            f"{numbers[f'{p}_peak']:.2f} R, the last element at {100 * numbers[f'{p}_tip_over_peak']:.0f} % of it"
            for p in ("thesis", "flight")
        )
        + ".",
        verdict=judged(good),
        because="Prandtl's factor unloads the blade tip; the built-in twist of the UH-60A turns up again there and "
        "keeps the load further outboard.",
        tables=(table("blade", ("preset", "r", "lambda_i", "dct_dr"), rows),),
        panels=(
            PlotPanel("r/R", "λ_i", tuple(inflow), title="Induced velocity / ΩR"),
            PlotPanel("r/R", "dC_T/dr", tuple(thrust), title="Thrust, the whole rotor as if smeared"),
        ),
        numbers=numbers,
    )


def figure_2_8() -> Report:
    """Velocities in forward flight, with the reverse-flow region."""
    solution = solved("flight", "uh60a", FAST).require()
    disk = solution.disk
    mu_x = FAST * math.cos(solution.controls.shaft_tilt)
    expected = _reverse_area(mu_x, float(disk.r[0] - 0.5 * disk.dr))
    ours = solution.reverse_flow_area
    top, low = float(disk.u_t.max()), float(disk.u_t.min())
    # One cell is 1/40 of the blade by 1/120 of the turn: the border of the region cuts through about 60 of them.
    good = abs(ours - expected) < 0.1 * expected and abs(top - (disk.r[-1] + mu_x)) < 1e-9
    return Report(
        number="2.8",
        kind="figure",
        caption=f"Velocity normal to the leading edge in forward flight, µ {FAST:.2f} (ours; the thesis states none).",
        statement="At ψ = 90° the blade meets ΩR + V; on the retreating side there is a region where air comes from "
        "the trailing edge (p. 14).",
        ours=f"From {low:.3f} to {top:.3f} ΩR. Reverse flow over {100 * ours:.2f} % of the disk; the circle "
        f"r = −µ sin ψ outside the root cut-out has {100 * expected:.2f} %.",
        verdict=judged(good),
        because="The region is the circle of diameter µ on the retreating side, counted in whole cells.",
        tables=(
            table(
                "u_t",
                ("r", "psi_deg", "u_t"),
                [
                    (disk.r[i], math.degrees(disk.psi[j]), disk.u_t[i, j])
                    for i in range(len(disk.r))
                    for j in range(0, len(disk.psi), 4)
                ],
            ),
        ),
        panels=(_disk(disk, disk.u_t, "U_T / ΩR", f"µ = {FAST:.2f}; the line is U_T = 0", zero_line=True),),
        numbers={"reverse_area": ours, "circle_area": expected, "largest": top},
    )


def _share(r: np.ndarray, dr: float, lift: np.ndarray, low: float, high: float) -> float:
    """Part of the thrust between two radii; elements cut by them count by the part inside."""
    inside = np.clip(np.minimum(r + 0.5 * dr, high) - np.maximum(r - 0.5 * dr, low), 0.0, dr)
    return float((inside * lift).sum() / (dr * lift.sum()))


def _reverse_area(mu: float, root: float) -> float:
    """Area of r < −µ sin ψ outside r = root, over πR²: ½∫(µ² sin²ψ − root²)dψ where µ|sin ψ| > root."""
    if mu <= root:
        return 0.0
    edge = math.asin(root / mu)
    span = math.pi - 2.0 * edge
    return (0.5 * mu**2 * (0.5 * span + 0.5 * math.sin(2.0 * edge)) - 0.5 * root**2 * span) / math.pi


def _disk(disk: DiskFields, values: np.ndarray, label: str, title: str, *, zero_line: bool = False) -> DiskPanel:
    return DiskPanel(
        label=label,
        r=floats(disk.r),
        dr=disk.dr,
        psi=floats(disk.psi),
        values=tuple(floats(row) for row in values),
        title=title,
        zero_line=zero_line,
    )
