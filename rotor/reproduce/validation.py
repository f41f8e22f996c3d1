"""Trust rows against measurement, against models, beside public codes, and what became of the document's statements."""

import math
from collections.abc import Iterable, Iterator

from rotor.airfoil.table import load_section
from rotor.dynamics.flapping import lock_number
from rotor.files.make_design import uh60a_rotor
from rotor.reproduce.aircraft import figure_3_10, tail_rotor
from rotor.reproduce.cross_codes import (
    CCBLADE_DIFFERENCES,
    DYNBEM_DIFFERENCES,
    beside_ccblade,
    beside_dynbem,
    have,
)
from rotor.reproduce.keys import keys_1987
from rotor.reproduce.report import Report
from rotor.reproduce.trust import Kind, TrustRow

LIFT_SLOPE = {"sc1095": 6.15, "sc1094r8": 6.30}
"""[1/rad] over 0–8° at Mach 0.3, section decks of NASA CR-166309 (Howlett 1981)."""
FLAP_FREQUENCY, LOCK_NUMBER = 1.04, 8.19
"""First flap frequency over Ω, digitised fan plot of the UH-60A blade; Lock number of NASA TM-85890 (Hilbert 1984)."""


def validation() -> Iterator[TrustRow]:
    """Against measurement: hover only. Every point counts, whatever the test's own tolerance leaves out."""
    hover = figure_3_10().numbers
    test = "rotor/analysis/test_comparison.py::test_hover_points"
    against = "digitised UH-60 rotor measurements, provenance incomplete"
    yield _row("validation", "Hover C_P, worst of ten points", against, hover["hover_least"], 3e-3, test,
               "C_T/σ 0.022…0.072; whirl tower or wind tunnel is not documented.")  # fmt: skip
    yield _row("validation", "Hover C_P, best of ten points", against, hover["hover_largest"], 3e-3, test,
               "Momentum theory knows no wake contraction and no tip-vortex interference.")  # fmt: skip


def indicative() -> Iterator[TrustRow]:
    """Against models, published constants of models, and other rotors."""
    forward, keys, tail = figure_3_10().numbers, keys_1987().numbers, tail_rotor().numbers
    for name, published in LIFT_SLOPE.items():
        table = load_section(name)
        slope = float(table(math.radians(8.0), 0.3).cl - table(0.0, 0.3).cl) / math.radians(8.0)
        yield _row("indicative", f"Lift slope of {name.upper()} over 0–8°, Mach 0.3",
                   "flight-simulation deck of NASA CR-166309", slope / published - 1.0, 3e-3,
                   "rotor/reproduce/test_trust.py::test_lift_slope_beside_the_public_deck",
                   "XFOIL is steeper than that deck; published RANS agrees with XFOIL.")  # fmt: skip
    rotor = uh60a_rotor("flight")
    frequency = math.sqrt(rotor.flap_frequency_squared) / FLAP_FREQUENCY - 1.0
    test = "rotor/dynamics/test_flapping.py::test_published_flap_frequency_and_lock_number"
    yield _row("indicative", "Rotating flap frequency", "1.04/rev, digitised fan plot of the UH-60A blade", frequency,
               2e-3, test)  # fmt: skip
    lock = lock_number(rotor, 1.225, 5.73) / LOCK_NUMBER - 1.0
    yield _row("indicative", "Lock number, lift slope 5.73", "8.19 of NASA TM-85890", lock, 2e-3, test)
    test = "rotor/reproduce/test_chapter_3.py::test_figure_3_10"
    yield _row("indicative", "Main-rotor power in forward flight, rms over seven speeds",
               "public model curve of the UH-60A", forward["rms_to_model_curve"], 3e-3, test,
               "A model, said to agree with flight test above 50 kt.")  # fmt: skip
    yield _row("indicative", "Main-rotor power in forward flight, mean of seven speeds",
               "public model curve of the UH-60A", forward["mean_to_model_curve"], 3e-3, test)  # fmt: skip
    for name in ("thesis-wake", "flight"):
        for key, words, published in (("hover", "hover", -0.024), ("fast", "330 km/h", 0.05)):
            gap = keys[f"{name}_{key}"] - published
            yield _row("indicative", f"Power of −17.3° over −11.5°, {words}, {name}",
                       f"{100 * published:+.1f} % (Keys et al. 1987, another rotor)", gap, 3e-3,
                       "rotor/reproduce/test_chapter_3.py::test_keys_1987", unit="points")  # fmt: skip
    yield _row("indicative", "Tail rotor over main-rotor power, mean of four speeds", "5 % (the document)",
               tail["mean"] - 0.05, 3e-3,
               "rotor/reproduce/test_chapter_3.py::test_tail_rotor", unit="points")  # fmt: skip


def public_codes() -> Iterator[TrustRow]:
    """Beside dynbem and CCBlade; only those that are installed."""
    test = "rotor/reproduce/test_cross_codes.py::test_dynbem_pitt_peters_forward_flight"
    for one in beside_dynbem() if have("dynbem") else ():
        note = f"Thrust {100 * one.thrust:+.2f} %. {one.detail}. {DYNBEM_DIFFERENCES}"
        what = f"Torque, {one.condition}"
        yield _row("public code", what, "dynbem 0.8, Pitt–Peters", one.power, 5e-4, test, note, digits=2)
    test = "rotor/reproduce/test_cross_codes.py::test_ccblade_hover"
    for one in beside_ccblade() if have("wisdem") else ():
        note = f"Thrust {100 * one.thrust:+.2f} %, {one.detail}. {CCBLADE_DIFFERENCES}"
        what = f"Power, {one.condition}"
        yield _row("public code", what, "CCBlade of WISDEM 4.2, axial", one.power, 5e-4, test, note, digits=2)


def statements(reports: Iterable[Report]) -> Iterator[TrustRow]:
    """What became of each statement of the document."""
    for one in reports:
        chapter = one.number[0] if one.number[0].isdigit() else "3"
        test = (
            f"rotor/reproduce/test_chapter_{chapter}.py::test_{one.title.lower().replace(' ', '_').replace('.', '_')}"
        )
        yield TrustRow("document", one.title, one.statement, one.verdict.value, None, 0.0, test, one.ours)


def _row(
    kind: Kind, what: str, against: str, error: float, allowed: float, test: str, note: str = "", *,
    unit: str = "%", digits: int = 1,
) -> TrustRow:  # fmt: skip
    """An error that is a part of something, shown in per cent or in points of per cent."""
    return TrustRow(kind, what, against, f"{100 * error:+.{digits}f} {unit}", error, allowed, test, note)
