"""The UH-60A beside what is public: hover points, a model's curve over speed, section data, constants of the blade, and
loads of the pitch link in the tunnel. One file, for all of it is about one rotor.

Of those loads the figure states neither unit nor sign: pound-force is taken by its size, and positive where the blade's
moment is nose up, for so measured pitch-link loads at high speed are described: nose up in the first quadrant, nose
down in the second (An Examination of the Aerodynamic Moment on Rotor Blade Tips, DTIC ADA529954).
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from rotor.airfoil.public_points import agreement, public_points
from rotor.airfoil.sections import load_section
from rotor.design.design import with_models
from rotor.dynamics.flapping import lock_number
from rotor.files.make_design import make_design, uh60a_rotor
from rotor.support.arrays import Array
from rotor.support.assets import toml_asset
from rotor.support.chart import Axis, Chart, Line, Points, Series
from rotor.support.units import KNOT
from rotor.trim.solve import solve
from rotor.validation import airloads
from rotor.validation.trust import TrustRow, TrustSet, description, rms

HORSEPOWER_KW = 0.745700
"""[kW], mechanical"""
SLOWEST = 0.075
"""µ from which the model's curve is compared."""
LIFT_SLOPE = {"sc1095": 6.15, "sc1094r8": 6.30}
"""[1/rad] over 0–8° at Mach 0.3, section decks of NASA CR-166309 (Howlett 1981)."""
FLAP_FREQUENCY, LOCK_NUMBER = 1.04, 8.19
"""First flap frequency over Ω, digitised fan plot of the UH-60A blade; Lock number of NASA TM-85890 (Hilbert 1984)."""

LOAD_HARMONICS = (1, 2, 3, 4)
"""Harmonics of the pitch-link load that are shown."""


def public_data() -> dict[str, Any]:
    """The parsed `assets/comparison.toml`."""
    return toml_asset("comparison.toml")


@cache
def model_curve_comparison(preset: str) -> tuple[list[float], list[float], list[float]]:
    """Advance ratios, the public model curve and the computed one, main-rotor power [kW]."""
    curve = public_data()["forward"]
    tip_speed = make_design().rotor.tip_speed
    speeds = [knots * KNOT / tip_speed for knots in curve["speed_kt"]]
    designs = (
        make_design(preset=preset, mu=mu, mass_kg=curve["mass_kg"], altitude_m=curve["altitude_m"])
        for mu in speeds
    )
    computed = [solve(design).require().power.main_rotor / 1e3 for design in designs]
    return speeds, [HORSEPOWER_KW * power for power in curve["main_rotor_hp"]], computed


def model_curve_errors(preset: str = "flight") -> tuple[float, float]:
    """Root mean square and mean of a preset over the model's curve, less one, above `SLOWEST`."""
    speeds, theirs, computed = map(np.array, model_curve_comparison(preset))
    errors = (computed / theirs - 1.0)[speeds > SLOWEST]
    return rms(errors), float(errors.mean())


def forward_set() -> TrustSet:
    """Power over speed beside another model's."""
    words, (speeds, theirs, computed) = (
        description("uh60a-forward"),
        model_curve_comparison("flight"),
    )
    size, mean = model_curve_errors()
    rows = (
        words.share(
            "Main-rotor power in forward flight, rms over seven speeds", size, 3e-3, note="rms"
        ),
        words.share("Main-rotor power in forward flight, mean of seven speeds", mean, 3e-3),
    )
    series = (
        Points("public model curve", speeds, theirs),
        Line("computed", speeds, computed, 1, dots=True),
    )
    return words.page(
        f"rms {100 * size:.1f} %, mean {100 * mean:+.1f} %",
        rows,
        (Chart(words.title, Axis("advance ratio µ"), Axis("main-rotor power [kW]"), series),),
        points=(("µ", "Model curve [kW]", "Computed [kW]", "Error [%]"),
                *((f"{mu:.3f}", f"{a:.0f}", f"{b:.0f}", f"{100 * (b / a - 1):+.1f}")
                  for mu, a, b in zip(speeds, theirs, computed, strict=True))),
    )  # fmt: skip


def section_set() -> TrustSet:
    """SC1095 against the public data that no constant was read off."""
    words, rms = description("sc1095"), agreement("sc1095")
    divergence = "Drag-divergence Mach number at 0, 2, 4°, largest difference"
    apart = max(map(abs, rms.divergence))
    what = "SC1095: largest C_d difference, attached, to Mach 0.5"
    rows = [
        words.row("SC1095: C_l rms to Mach 0.7", f"{rms.cl_rms:.3f}", rms.cl_rms, 0.002),
        words.row(
            "SC1095: Largest C_m difference to Mach 0.7",
            f"{rms.cm_largest:.4f}",
            rms.cm_largest,
            0.0005,
        ),
        words.row(f"SC1095: {divergence}", f"{apart:.3f}", apart, 0.001),
        words.share(what, rms.cd_largest, 3e-3, note="drag"),
    ]
    charts = _over_angle("cl", "C_l"), _over_angle("cd", "C_d"), _drag_rise()
    return words.page(f"C_l rms {rows[0].shown}, C_d {rows[-1].shown}", rows, charts)


def _over_angle(name: str, label: str) -> Chart:
    mach = 0.4
    table, aside = (
        load_section("sc1095"),
        [p for p in public_points("sc1095") if p.kept_aside and p.mach == mach],
    )
    alpha = np.arange(-5.0, 9.1, 0.25)
    computed = getattr(table(np.radians(alpha), mach), name)
    series = (
        Points(
            "RANS, held out",
            [math.degrees(p.alpha) for p in aside],
            [getattr(p, name) for p in aside],
        ),
        Line("section table", alpha, computed, 1),
    )
    return Chart(
        f"{label} of SC1095 at Mach {mach:g}",
        Axis("angle of attack [°]"),
        Axis(f"{label}, Mach {mach:g}"),
        series,
    )


def _drag_rise() -> Chart:
    table, alpha = load_section("sc1095"), math.radians(2.0)
    aside = sorted(
        (p.mach, p.cd)
        for p in public_points("sc1095")
        if p.kept_aside and abs(p.alpha - alpha) < 1e-6
    )
    mach, drag = zip(*aside, strict=True)
    fine = np.arange(mach[0], mach[-1], 0.01)
    series = (
        Points("RANS and network, held out", mach, drag),
        Line("section table", fine, table(alpha, fine).cd, 1),
    )
    return Chart("Drag rise of SC1095 at 2°", Axis("Mach number"), Axis("C_d at 2°"), series)


def constants_set() -> TrustSet:
    """Published constants of sections and blade."""
    words, rows = description("uh60a-constants"), list[TrustRow]()
    for name, published in LIFT_SLOPE.items():
        table = load_section(name)
        slope = float(table(math.radians(8.0), 0.3).cl - table(0.0, 0.3).cl) / math.radians(8.0)
        rows.append(
            words.share(
                f"Lift slope of {name.upper()} over 0–8°, Mach 0.3", slope / published - 1.0, 3e-3, note="slope",
                against="flight-simulation deck of NASA CR-166309",
                test="rotor/validation/test_validation.py::test_rows_of_the_trust_page",
            )
        )  # fmt: skip
    rotor = uh60a_rotor("flight")
    frequency = math.sqrt(rotor.flap_frequency_squared) / FLAP_FREQUENCY - 1.0
    lock = lock_number(rotor, 1.225, 5.73) / LOCK_NUMBER - 1.0
    source = "1.04/rev, digitised fan plot of the UH-60A blade"
    rows += [
        words.share("Rotating flap frequency", frequency, 2e-3, against=source),
        words.share("Lock number, lift slope 5.73", lock, 2e-3, against="8.19 of NASA TM-85890"),
    ]
    errors = [100.0 * (row.error or 0.0) for row in rows]
    names = ("lift slope, SC1095", "lift slope, SC1094 R8", "flap frequency", "Lock number")
    chart = Chart(
        "Computed over published",
        Axis("difference [%]"),
        Axis(names=names),
        (Points("", errors, range(4), 1),),
    )
    return words.page(f"{min(errors):+.1f} to {max(errors):+.1f} %", rows, (chart,))


@dataclass(frozen=True, eq=False)
class PitchLinkLoad:
    """Measured and computed pitch-link load at one advance ratio."""

    mu: float
    measured: airloads.MeasuredCurve
    psi: Array
    """[rad], (azimuths,)"""
    computed: Array
    """[N], (azimuths,)"""
    torsion_alone: Array
    """Computed of a blade that twists but does not bend."""
    agreement: airloads.CurveAgreement

    @property
    def half_peaks(self) -> tuple[float, float, float]:
        """Half peak to peak [N]: measured, computed, computed without bending."""
        measured, computed, rigid = (
            0.5 * float(np.ptp(of))
            for of in (self.measured.values, self.computed, self.torsion_alone)
        )
        return measured, computed, rigid


def pitch_link_loads() -> Iterator[PitchLinkLoad]:
    """All measured advance ratios; RuntimeError where the rotor does not trim."""
    for measured in airloads.measured_curves():
        if measured.case.test == airloads.PITCH_LINK:
            design = measured.case.design()
            solution = solve(design).require()
            rigid = solve(with_models(design, bending=False)).require()
            psi, computed = airloads.computed_curve(measured, solution)
            yield PitchLinkLoad(
                design.condition.advance_ratio, measured, psi, computed, airloads.computed_curve(measured, rigid)[1],
                airloads.agreement(measured, solution),
            )  # fmt: skip


def pitch_link_set() -> TrustSet:
    """The set of the trust page: pitch-link loads of the UH-60A."""
    loads = list(pitch_link_loads())
    errors = [
        computed / measured - 1.0 for measured, computed, _ in (load.half_peaks for load in loads)
    ]
    return description(airloads.PITCH_LINK).page(
        f"half peak to peak {100 * min(errors):+.0f} to {100 * max(errors):+.0f} %",
        _load_rows(loads),
        (_peak_chart(loads), _amplitude_chart(loads), *map(_load_chart, loads)),
        points=_load_points(loads),
    )


def _load_rows(loads: Sequence[PitchLinkLoad]) -> Iterator[TrustRow]:
    words = description(airloads.PITCH_LINK)
    for load in loads:
        measured, computed, _ = load.half_peaks
        yield words.share(
            f"Half peak to peak, µ {load.mu:g}", computed / measured - 1.0, 0.02, digits=0
        )
    for n in (1, 2):
        late = [load.agreement.late_deg(n) for load in loads]
        mean = float(np.mean([load.agreement.ratio(n) for load in loads]))
        shown = f"{100 * mean:+.0f} %, phase {min(late):+.0f} to {max(late):+.0f}°"
        yield words.row(f"{n}/rev, mean of six speeds", shown, mean, 0.02)


def _peak_chart(loads: Sequence[PitchLinkLoad]) -> Chart:
    mu = [load.mu for load in loads]
    measured, computed, rigid = 1e-3 * np.array([load.half_peaks for load in loads]).T
    series = (
        Points("measured", mu, measured),
        Line("computed", mu, computed, 1, dots=True),
        Line("without bending", mu, rigid, 2, dashes=True),
    )
    title = "Half peak to peak of the pitch-link load"
    return Chart(title, Axis("advance ratio µ"), Axis("half peak to peak [kN]"), series)


def _amplitude_chart(loads: Sequence[PitchLinkLoad]) -> Chart:
    mu = [load.mu for load in loads]
    series: list[Series] = []
    for n in LOAD_HARMONICS:
        measured, computed = (
            [1e-3 * load.agreement.amplitude(n, measured=of) for load in loads]
            for of in (True, False)
        )
        series.append(Points(f"{n}/rev, measured", mu, measured, n))
        series.append(Line("computed", mu, computed, n))
    return Chart(
        "Harmonics of the pitch-link load",
        Axis("advance ratio µ"),
        Axis("amplitude [kN]"),
        tuple(series),
    )


def _load_chart(load: PitchLinkLoad) -> Chart:
    title = f"Pitch-link load, µ {load.mu:g}"
    series = (
        Points("measured", np.degrees(load.measured.psi), 1e-3 * load.measured.values),
        Line("computed", *airloads.closed_around(load.psi, 1e-3 * load.computed), 1),
        Line(
            "without bending",
            *airloads.closed_around(load.psi, 1e-3 * load.torsion_alone),
            2,
            dashes=True,
        ),
    )
    return airloads.azimuth_chart(title, f"{title} [kN]", series)


def _load_points(loads: Sequence[PitchLinkLoad]) -> tuple[tuple[str, ...], ...]:
    rows: list[tuple[str, ...]] = [
        (
            "µ",
            "Quantity",
            "Measured [kN]",
            "Measured φ [°]",
            "Computed [kN]",
            "Computed φ [°]",
            "Without bending [kN]",
        )
    ]
    for load in loads:
        measured, computed, rigid = (f"{1e-3 * value:.2f}" for value in load.half_peaks)
        rows.append((f"{load.mu:g}", "half peak to peak", measured, "", computed, "", rigid))
        for n in LOAD_HARMONICS:
            fit = load.agreement
            pairs = (
                (fit.amplitude(n, measured=of), fit.phase_deg(n, measured=of))
                for of in (True, False)
            )
            waves = (
                text for size, phase in pairs for text in (f"{1e-3 * size:.2f}", f"{phase:.0f}")
            )
            rows.append((f"{load.mu:g}", f"{n}/rev", *waves, ""))
    return tuple(rows)
