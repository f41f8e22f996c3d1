"""The 3D scene in a real browser: the blade twisted by hand, the turning rotor, the gloss of its surfaces."""

import math
from collections.abc import Iterator
from io import BytesIO
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Browser
from watched import Watched

from explorer.app import App
from explorer.model.inputs import Inputs
from explorer.picture.fields import FIELDS
from explorer.picture.picture import disk_png
from explorer.picture.wake import tip_vortices
from rotor.trim.solve import solve

START = Inputs(law="two", two_inner=-14.0, two_outer=-8.0, two_division=0.5)
SIZE = (1280, 720)
VORTEX = """() => {
    let first = null;
    window.__viserMutable.nodeRefFromName['/rotor/vortices']?.traverse(part => {
        const data = part.visible && part.geometry?.attributes?.instanceStart?.data;
        if (data) first = Array.from(data.array.slice(0, 3));
    });
    return first;
}"""
"""Where the first tip vortex begins [m]."""
PIXELS = """places => {
    const {scene, camera} = __viserMutable, {gl} = scene.__r3f.root.getState(), context = gl.getContext();
    const mesh = Common.node('/rotor/disk/field').getObjectByProperty('isMesh', true), hidden = [];
    scene.traverse(part => { if (part.isMesh && part !== mesh && part.visible) hidden.push(part); });
    for (const part of hidden) part.visible = false;
    const {uniforms, numbers} = mesh.material.userData.disk, {width, height} = gl.domElement;
    const radius = mesh.geometry.parameters.width / 2 / numbers.grid[3], pixel = new Uint8Array(4);
    uniforms.rxOpacity.value = new Float32Array([1, 1]);
    gl.render(scene, camera);
    const colours = places.map(([starboard, aft]) => {
        const at = camera.position.clone().set(starboard * radius, -aft * radius, 0);
        const {x, y} = at.applyMatrix4(mesh.matrixWorld).project(camera);
        context.readPixels((x + 1) / 2 * width, (y + 1) / 2 * height, 1, 1, context.RGBA, context.UNSIGNED_BYTE, pixel);
        return Array.from(pixel.slice(0, 3));
    });
    for (const part of hidden) part.visible = true;
    return colours;
}"""
"""Colours of places on the disk, in radii to starboard and aft, drawn alone and as opaque as can be."""
AZIMUTH = """() => {
    const hinge = window.__viserMutable.nodeRefFromName['/rotor/blade_0'].position;
    return Math.atan2(hinge.y, hinge.x);
}"""


@pytest.fixture
def watched(shared: Watched) -> Iterator[Watched]:
    shared.reset()
    begun = [-14.0, -8.0, 0.5]
    shared.until(
        lambda: [shared.number(label) for label in ("Inboard", "Outboard", "Break point")] == begun
    )
    shared.at_rest(
        lambda: shared.page.evaluate("() => window.__viserMutable.camera.position.toArray()")
    )
    yield shared
    assert shared.complaints == []


# Height [px] of the held trailing edge, where the blade is seen from the tip.
EDGE = "() => Number(RX.part('twisting').querySelector('circle').getAttribute('cy'))"
# Boxes of the live disk, of the blade with its words, and of the card of power.
BOXES = """() => {
    const blade = RX.part('twisting').querySelectorAll('path[fill]:not([fill=none])');
    const disk = RX.part('plan').querySelector('[data-colours]');
    return [disk, ...blade, document.querySelector('.rxf-power')].map(one => {
        const box = one.getBoundingClientRect();
        return [box.left, box.top, box.right, box.bottom];
    });
}"""


def test_the_tip_follows_the_hand_and_one_undo_takes_it_back(watched: Watched):
    page = watched.page
    camera: Any = page.evaluate("() => window.__viserMutable.camera.position.toArray()")
    x, y = watched.grab_tip()
    # Before it begins to come to the hand, the blade rests as well.
    page.wait_for_function("() => RX.part('twisting').style.getPropertyValue('--rx-shown') === '1'")
    edge = watched.at_rest(lambda: page.evaluate(EDGE))
    for step in range(1, 11):
        page.mouse.move(x, y + 12 + 4 * step)
        page.wait_for_timeout(60)
    page.wait_for_function("() => RX.state.hand?.place.startsWith('tip') && RX.state.hand.best")
    # The trailing edge went down with the pointer; nose up, away from the optimum at more washout.
    assert watched.at_rest(lambda: page.evaluate(EDGE)) - edge == pytest.approx(40.0, abs=8.0)
    # The live disk stands left of the blade, both below the card of power; power now, before, and its least are told.
    disk, *blade, card = page.evaluate(BOXES)
    assert disk[2] <= min(box[0] for box in blade) + 1.0
    assert min(box[1] for box in (disk, *blade)) >= card[3] - 1.0
    assert page.evaluate("() => RX.state.plan.regions.some(one => one.before.length)")
    told = page.evaluate("() => RX.part('twisting').textContent")
    assert all(word in told for word in ("kW", "before ", "least "))
    assert page.evaluate("() => RX.state.hand.best.theta") < -2.0  # It began at −2°.
    assert page.evaluate("() => window.__viserMutable.camera.position.toArray()") == pytest.approx(
        camera, abs=1e-6
    )
    page.mouse.up()
    page.wait_for_function("() => RX.state.hand === null && RX.state.twisting === null")
    page.wait_for_function("() => !document.documentElement.hasAttribute('data-twisting')")
    outer = watched.at_rest(lambda: watched.number("Outboard"))
    assert outer > -7.0
    assert watched.number("Inboard") == -14.0
    # Released, the camera follows the shaft tilt; an orbit would have moved it by metres.
    assert page.evaluate("() => window.__viserMutable.camera.position.toArray()") == pytest.approx(
        camera, abs=0.4
    )
    page.evaluate("() => RX.send('undo', '')")
    watched.until_changed(lambda: watched.number("Outboard"), outer)
    assert watched.at_rest(lambda: watched.number("Outboard")) == -8.0


def test_twisting_by_key_and_escape_leaves_the_blade_as_it_was(watched: Watched):
    page = watched.page
    undo = page.evaluate("() => RX.state.bar.undo")
    page.keyboard.press("g")
    page.wait_for_function("() => RX.state.twisting?.by === 'key'")
    watched.drawn()  # Keys are heard from the frame on that shows it.
    for _ in range(3):
        page.keyboard.press("Shift+ArrowUp")
    watched.until(lambda: watched.number("Outboard") > -3.0)
    for _ in range(20):
        page.keyboard.press("Shift+ArrowUp")
    page.wait_for_function("() => RX.part('twisting').textContent.includes('limit of Outboard')")
    watched.until(lambda: watched.number("Outboard") == 10.0)
    page.keyboard.press("Escape")
    watched.until(lambda: watched.number("Outboard") == -8.0)
    page.wait_for_function("() => RX.state.twisting === null")
    watched.answered()
    assert page.evaluate("() => RX.state.bar.undo") is undo


@pytest.mark.slow
def test_play_turns_the_blades_smoothly_and_they_come_to_rest_where_the_view_has_them(
    watched: Watched,
):
    page = watched.page
    still = page.evaluate(AZIMUTH)
    page.evaluate("() => RX.send('play', '')")
    page.wait_for_function(f"still => Math.abs(({AZIMUTH})() - still) > 0.3", arg=still)

    def smooth() -> bool:
        """Nearly every frame moves it on, not 20 a second, and never back."""
        seen = page.evaluate(
            f"""async () => {{
                const seen = [];
                for (let k = 0; k < 40; k++) {{
                    await new Promise(requestAnimationFrame);
                    seen.push(({AZIMUTH})());
                }}
                return seen;
            }}"""
        )
        steps = [math.remainder(b - a, 2 * math.pi) for a, b in pairwise(seen)]
        return sum(step > 0.0 for step in steps) > 20 and min(steps) > -0.05

    watched.until(smooth)
    # Tip vortices turn with it: each begins at the tip of its blade.
    page.wait_for_function(f"() => ({VORTEX})()")
    tip, turned = page.evaluate(f"() => [({VORTEX})(), rotorScene.psi]")
    solution = solve(START.design())
    expected = tip_vortices(solution, [turned])[0][0, 0]
    np.testing.assert_allclose(tip, expected, atol=0.02)
    page.evaluate("() => RX.send('play', '')")
    page.wait_for_function("() => !RX.state.turn.playing")

    def off() -> float:
        """From where the view has the blades to where they are drawn [rad]: late on a machine that draws slowly."""
        shown, stands = page.evaluate(f"() => [({AZIMUTH})(), RX.state.turn.psi]")
        return abs(math.remainder(shown - math.radians(float(stands)), 2 * math.pi))

    watched.until(lambda: off() < 0.02)
    assert watched.at_rest(lambda: round(off(), 3)) < 0.02


PLAN_PIXELS = """places => {
    const canvas = document.querySelector('[data-colours]').shadowRoot.firstChild, half = canvas.width / 2;
    const pixel = ([x, y]) => canvas.getContext('2d').getImageData(half + half * x, half + half * y, 1, 1);
    return places.map(place => [...pixel(place).data]);
}"""


@pytest.mark.slow
def test_disk_and_plan_have_the_colours_that_files_have(browser: Browser, app: App):
    """What shader and plan draw, at full opacity and without marks, against the picture of an export.

    Not at 0.93 R, where the sweep of the tip begins and the Mach number jumps.
    """
    page = browser.new_page(viewport={"width": 1400, "height": 940})
    at = [
        (r * math.sin(psi), r * math.cos(psi))
        for r in (0.45, 0.7, 0.9)
        for psi in np.radians([40, 100, 200, 320])
    ]
    try:
        watched = Watched(page)
        watched.open(app.address)
        page.evaluate(
            """() => ['stall', 'past_static', 'reverse_flow', 'drag_divergence']
                .forEach(mark => RX.send('region', mark))"""
        )
        watched.show("Mach number")
        watched.answered(wholly=True)
        seen = page.evaluate(PIXELS, at)
        page.evaluate("() => RX.send('view', 'disk')")
        page.wait_for_function("() => RX.state.plan?.values")
        watched.answered(wholly=True)
        plan = page.evaluate(PLAN_PIXELS, at)
    finally:
        page.close()
    field = FIELDS["Mach number"]
    png = disk_png(solve(START.design()), field, (field.low, field.high), size=960)
    image = np.asarray(Image.open(BytesIO(png)).convert("RGBA"))[..., :3].astype(int)
    for (x, y), colour, (*flat, alpha) in zip(at, seen, plan, strict=True):
        there = image[int(480 + 479 * y), int(480 + 479 * x)]
        # The plan is read where it is asked; a pixel of the others lies up to half a pixel beside.
        np.testing.assert_allclose(colour, flat, atol=6.0, err_msg=f"{x}, {y}")
        np.testing.assert_allclose(flat, there, atol=4.0, err_msg=f"{x}, {y}")
        assert alpha == 255
