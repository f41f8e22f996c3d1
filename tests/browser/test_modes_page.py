"""Every mode after every other on the real page: what is seen is one number, that of the design on the sliders."""

import pytest
from watched import LARGE, Visit, Watched

from explorer.app import App
from explorer.story.steps import STEPS
from tests.explorer.test_modes import WALK, design_of, kilowatts

SEEN = """() => [...document.querySelectorAll('[data-explorer="total-power"]')]
    .filter(one => one.checkVisibility()).map(one => [one.dataset.explorer, one.innerText])"""
"""Total power, wherever it stands."""


def go(watched: Watched, place: str) -> None:
    page = watched.page
    if place in ("explore", "optimise"):
        watched.mode(place)
    elif place == "lecture":
        page.evaluate("() => document.activeElement?.blur()")
        page.keyboard.press("t")
        page.wait_for_selector('[data-explorer="lecture"][data-step="1"]')
        page.evaluate("k => RX.send('story', k)", len(STEPS) - 1)
        page.wait_for_selector(f'[data-explorer="lecture"][data-step="{len(STEPS)}"]')
        page.get_by_role("button", name="Fly it").click()
        page.wait_for_selector('[data-explorer="lecture"]', state="hidden")
    else:
        watched.mode("actuate")
        page.get_by_role(
            "button", name={"rotor": "Aircraft", "actuator": "Actuator"}[place], exact=True
        ).click()


@pytest.mark.slow
def test_one_number_is_seen_and_it_is_of_the_design(visit: Visit, app: App):
    watched = visit(size=LARGE)
    page, server = watched.page, app.sessions[-1].page
    for k, place in enumerate(WALK):
        go(watched, place)
        page.evaluate("mu => RX.send('slide', ['advance_ratio', mu])", 0.1 + 0.01 * k)
        watched.until(
            lambda k=k: (
                server.context.controls.inputs().advance_ratio == pytest.approx(0.1 + 0.01 * k)
            )
        )
        watched.until(lambda: [name for name, _ in page.evaluate(SEEN)] == ["total-power"])
        kw = kilowatts(design_of(server))
        watched.until(
            lambda kw=kw: (
                abs(float(page.evaluate(SEEN)[0][1].split(" kW")[0].replace("\u2009", "")) - kw)
                < 0.51
            )
        )
