"""The Actuator tab in a real browser: voltage twists the blades, another actuator gets another verdict."""

from collections.abc import Iterator

import pytest
from watched import WAIT, Watched

pytestmark = pytest.mark.browser
VERDICT = 4 * WAIT
"""[ms]; four optima and their trims, in a process of low priority."""


@pytest.fixture
def watched(shared: Watched) -> Iterator[Watched]:
    shared.reset()
    shared.mode("actuate")
    shared.page.wait_for_function(
        """() => document.querySelector('[data-explorer="actuator-now"]')?.innerText.includes('at rest')"""
    )
    shared.answered()
    yield shared
    assert shared.complaints == []


def seen(watched: Watched, name: str) -> bool:
    return watched.page.evaluate("name => window.__viserMutable.nodeRefFromName[name].visible", name)


def test_the_first_verdict_comes_by_itself(watched: Watched):
    """Nobody has moved anything: worked out in another process once the page was still."""
    watched.page.wait_for_selector('[data-explorer="verdict"][data-kind="ready"]', timeout=VERDICT)
    assert "Macro fibre composite P1" in watched.text("verdict")


def test_electrodes_follow_actuator_and_voltage(watched: Watched):
    watched.page.get_by_text("Electrodes", exact=True).click()
    watched.page.wait_for_selector('[data-explorer="electrodes"]', state="visible")
    assert "+3.00 kV/mm" not in watched.text("field-now")
    watched.press("Voltage", "End")
    watched.reads("field-now", r"\+3\.00 kV/mm")
    kinds = watched.text("electrodes")
    assert kinds.index("interdigitated") < kinds.index("continuous")
    watched.choose("Actuator", "MFC P2: d31 sheet")
    kinds = watched.until_changed(lambda: watched.text("electrodes"), kinds)
    assert kinds.index("continuous") < kinds.index("interdigitated")
    watched.choose("Actuator", "SMA tube: heated tube")  # Has none.
    watched.page.wait_for_selector('[data-explorer="electrodes"]', state="detached")
    watched.choose("Actuator", "MFC P1: d33 fibres")


def test_voltage_twists_the_blades_and_moves_power(watched: Watched):
    blade = watched.node("/rotor/blade_0")
    watched.press("Voltage", "End")
    watched.reads("actuator-now", r"\+\d\.\d\d°")
    watched.reads("actuator-now", r"[−+]\d+\.\d kW of power")
    watched.until_changed(lambda: watched.node("/rotor/blade_0"), blade)
    watched.until(lambda: watched.text("change") != "0.0 %")


@pytest.mark.slow
def test_another_actuator_gets_another_verdict(watched: Watched):
    watched.press("Derating", "ArrowLeft")
    watched.page.wait_for_selector('[data-explorer="verdict"][data-kind="ready"]', timeout=VERDICT)
    before = watched.text("verdict")
    assert "Macro fibre composite P1" in before
    watched.choose("Actuator", "AFC: d33 fibres")
    watched.page.wait_for_function(
        """() => document.querySelector('[data-explorer="verdict"][data-kind="ready"]')
            ?.innerText.includes('Active fibre composite')""",
        timeout=VERDICT,
    )
    watched.until(lambda: "recalled" in watched.text("limits"))
    watched.choose("Actuator", "MFC P1: d33 fibres")


def test_the_cut_takes_the_place_of_the_rotor_and_follows_the_voltage(watched: Watched):
    watched.until(lambda: not seen(watched, "/rotor"))
    watched.page.wait_for_function("() => window.__viserSceneTree.getState()['/cut/part_0'] !== undefined")
    labels = watched.page.locator('[data-explorer="labels"]')
    labels.get_by_text("spar web").wait_for(timeout=VERDICT)
    skin, now = watched.node("/cut/part_0"), watched.text("actuator-now")
    watched.press("Voltage", "End")
    watched.until_changed(lambda: watched.text("actuator-now"), now)
    watched.until_changed(lambda: watched.node("/cut/part_0"), skin)
    watched.page.locator("[data-do=view][data-value=disk]").click()
    watched.until_changed(lambda: seen(watched, "/rotor"), False)
    watched.until_changed(lambda: seen(watched, "/cut"), True)
    watched.page.wait_for_function("() => RX.state.cut_labels.length === 0", timeout=VERDICT)
    watched.until(lambda: labels.inner_text() == "")


@pytest.mark.slow
def test_the_sweep_of_the_harmonic_follows_its_sliders(watched: Watched):
    """Power over amplitude and phase, with the limit; the sentence follows the phase at once."""
    watched.mode("explore")
    watched.type("Adv. ratio", 0.3)
    watched.mode("actuate")
    watched.choose("Harmonic", "2/rev")
    watched.page.wait_for_function(
        """() => document.querySelector('[data-explorer="swept"]')?.innerText.includes('At this phase')""",
        timeout=VERDICT,
    )
    watched.reads("swept", r"Least power: \d+ % at \d+°: −\d")
    assert "At this phase more twist saves more" not in watched.text("swept")
    watched.type("Phase", 180)
    watched.reads("swept", "At this phase more twist saves more")
    watched.until(lambda: "flown, with the elastic twist" in watched.text("actuator-now"))
    watched.choose("Harmonic", "Off")


def test_pitch_at_three_per_rev_moves_power_curve_link_and_blades(watched: Watched):
    """By the sliders of Actuate; undone in one step, and again on a page that opens its link."""
    power, blade = watched.text("total-power"), watched.node("/rotor/blade_0")
    watched.type("Pitch ampl.", 2.0)
    watched.reads("per-rev", "Root pitch of 2.00° at 3/rev")
    power = watched.until_changed(lambda: watched.text("total-power"), power)
    watched.until_changed(lambda: watched.node("/rotor/blade_0"), blade)
    watched.type("Pitch phase", 180)
    watched.until_changed(lambda: watched.text("total-power"), power)
    watched.until(lambda: "pitch_per_rev=3:2:180" in watched.page.url)
    watched.choose("Twist harmonic", "2/rev")
    watched.type("Twist ampl.", 1.0)
    watched.reads("per-rev", "Active twist of 1.00° at 2/rev .phase 0°. and root pitch of 2.00° at 3/rev .phase 180°")
    watched.until(lambda: "twist_per_rev=2:1:0" in watched.page.url)
    watched.page.keyboard.press("Escape")
    watched.page.keyboard.press("Control+z")
    watched.reads("per-rev", "^Root pitch of 2.00° at 3/rev .phase 180°.\\.$")
