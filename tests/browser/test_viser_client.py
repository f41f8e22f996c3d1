"""What `explorer/web/viser.js` changes in viser's client; when one of these fails, the pin may not move."""

import re
import time
from dataclasses import replace

import pytest
from chromium import DRAW_NOTHING
from playwright.sync_api import Browser
from watched import Watched

from explorer.app import App
from rotor.aero.switches import SWITCHES

SIZE = (1500, 940)
AS_LEFT = True


def test_the_docks_stay_in_a_narrow_window(watched: Watched):
    """The client asks for 36em, and gets no for an answer at any width; other questions are answered."""
    watched.page.set_viewport_size({"width": 420, "height": 800})
    assert watched.page.evaluate("matchMedia('(max-width: 36em)').matches") is False
    assert watched.page.evaluate("matchMedia('(max-width: 700px)').matches") is True
    assert watched.page.locator("[data-dock-region=right]").count() == 1
    watched.page.set_viewport_size({"width": 1500, "height": 940})


def test_the_client_says_when_it_can_send(watched: Watched):
    """It replaces `sendMessage` by a function that says "not connected" while it is not."""
    heard = """() => {
        const client = window.__viserMutable, heard = [];
        const hear = event => heard.push(event.detail);
        addEventListener('rx-connection', hear);
        client.sendMessage = () => console.debug('not connected');
        client.sendMessage = () => {};
        removeEventListener('rx-connection', hear);
        return heard;
    }"""
    assert watched.page.evaluate(heard) == [False, True]
    watched.page.wait_for_function("() => !document.querySelector('#rx-gone')")
    watched.page.reload()  # The client has its own function again.
    watched.ready()


def test_no_edit_is_lost_to_one_that_follows_at_once(watched: Watched, app: App):
    """The client has one place for what it keeps back: of three widgets that change within 50 ms it lost the second."""
    titles = {name: switch.title for name, switch in SWITCHES.items()}
    watched.page.get_by_text("Model", exact=True).click()
    # One title may begin with another: *Stall delay*, *Stall*.
    labels = [
        watched.page.locator("label", has_text=re.compile(rf"^{re.escape(title)}\s*$")).first
        for title in titles.values()
    ]
    rows = [
        label.locator("xpath=ancestor::div[contains(@class,'Flex-root')][1]") for label in labels
    ]
    boxes = [row.locator("input[type=checkbox]") for row in rows]
    boxes[-1].wait_for()

    def held() -> list[bool]:
        inputs = app.sessions[-1].page.context.controls.inputs()
        return [getattr(inputs, name) for name in titles]

    before = held()
    for _ in range(2):
        watched.page.evaluate(
            "boxes => boxes.forEach(box => box.click())", [box.element_handle() for box in boxes]
        )
        watched.answered()
        before = [not one for one in before]
        assert held() == before == [box.is_checked() for box in boxes]


def test_an_edit_that_waits_goes_when_the_one_before_is_answered(watched: Watched):
    sent = """() => {
        const client = window.__viserMutable, own = client.sendMessage, heard = [];
        const edit = value => client.sendMessage({type: 'GuiUpdateMessage', uuid: 'none', updates: {value}});
        const now = () => heard.map(message => message.updates.value).join();
        client.sendMessage = message => heard.push(message);
        edit(1);
        edit(2);
        edit(3);
        const before = now();
        dispatchEvent(new Event('rx-answered'));
        const after = now();
        client.sendMessage = own;
        return [before, after];
    }"""
    assert watched.page.evaluate(sent) == ["1", "1,3"]
    watched.page.reload()  # The client has its own function again.
    watched.ready()


def test_a_page_that_is_seen_has_the_focus(watched: Watched):
    """Only such a page tries to connect again."""
    assert watched.page.evaluate("document.hasFocus() && document.visibilityState === 'visible'")
    heard = """() => new Promise(done => {
        addEventListener('focus', () => done(true), {once: true});
        document.dispatchEvent(new Event('visibilitychange'));
    })"""
    assert watched.page.evaluate(heard)


def test_messages_are_handled_on_arrival_and_drawn_once(watched: Watched):
    """viser's client handles messages for the scene in its next frame, then draws for 250 ms. In software it now draws
    when asked, and again when all has settled."""
    told = """() => new Promise(done => {
        const client = window.__viserMutable, {scene} = client, own = scene.onAfterRender;
        let drawn = 0;
        scene.onAfterRender = (...all) => { drawn += 1; own.apply(scene, all); };
        client.messageQueue.push({type: 'SetPositionMessage', name: '/nothing', position: [1, 2, 3]});
        client.requestRender();
        const taken = client.messageQueue.length === 0 && client.nodePoseData['/nothing']?.position.join() === '1,2,3';
        setTimeout(() => { scene.onAfterRender = own; done([taken, drawn]); }, 700);
    })"""
    watched.answered(wholly=True)
    times = [watched.page.evaluate(told) for _ in range(5)]
    assert all(taken for taken, _ in times)
    # The client's own frame, once in some seconds, may fall among them; a busy machine may draw the second later.
    assert 2 in [drawn for _, drawn in times], times


def test_the_picture_shrinks_while_something_is_dragged(watched: Watched):
    """In software a smaller picture keeps up with the hand; let go it is sharp again."""
    page, width = watched.page, "() => __viserMutable.canvas.width"
    sharp = watched.at_rest(lambda: page.evaluate(width))
    x, y = watched.thumb("Adv. ratio")
    watched.hold(x, y)
    page.mouse.move(x + 2, y)
    assert page.evaluate(width) == sharp  # No drag yet.
    page.mouse.move(x + 7, y)
    page.wait_for_function(f"most => ({width})() <= most", arg=sharp / 2 + 1)
    page.mouse.up()
    page.wait_for_function(f"sharp => ({width})() === sharp", arg=sharp)


@pytest.mark.slow
def test_a_still_page_is_hardly_drawn_in_software(watched: Watched):
    """The client draws every second, which keeps a processor busy there: every fifth time is enough; no rotor turns."""
    counted = """() => new Promise(done => {
        const {scene} = __viserMutable, own = scene.onAfterRender;
        let drawn = 0;
        scene.onAfterRender = (...all) => { drawn += 1; own.apply(scene, all); };
        setTimeout(() => { scene.onAfterRender = own; done(drawn); }, 10000);
    })"""
    watched.mode("actuate")
    watched.answered()
    drawn = [watched.page.evaluate(counted)]
    while drawn[-1] > 4 and len(drawn) < 12:  # Until answers of the background have come.
        drawn.append(watched.page.evaluate(counted))
    assert 1 <= drawn[-1] <= 4, drawn
    # It turns when the server says so, goes on at that rate for a moment, and then rests again.
    turn = """async () => {
        const at = rotorScene.psi + 1;
        rotorScene.turn(at - 0.3);
        await new Promise(done => setTimeout(done, 300));
        rotorScene.turn(at);
        return at;
    }"""
    turned = watched.page.evaluate(turn)
    watched.page.wait_for_function("at => rotorScene.psi > at - 0.01", arg=turned)
    watched.page.wait_for_timeout(3000)
    assert watched.page.evaluate(counted) <= 5
    watched.mode("explore")


def test_a_hidden_tab_computes_nothing_until_it_is_seen(watched: Watched, app: App):
    """What moves meanwhile, as a rotor that plays, is one update when it is seen."""
    page, session = watched.page, app.sessions[-1]
    see = """hidden => {
        Object.defineProperty(document, 'hidden', {configurable: true, value: hidden});
        document.dispatchEvent(new Event('visibilitychange'));
    }"""
    watched.answered(wholly=True)
    updates, update = list[float](), session._worker._update
    session._worker._update = lambda: updates.append(time.monotonic()) or update()
    page.evaluate("() => RX.send('play')")
    watched.until(lambda: len(updates) > 5)
    page.evaluate(see, True)
    watched.until(lambda: session._worker._held and session._worker._state == "idle")
    before, power = len(updates), watched.text("total-power")
    session.page.context.drag_to(replace(session.page.context.inputs(), advance_ratio=0.3))
    session._wake()
    page.wait_for_timeout(500)
    assert len(updates) == before
    page.evaluate("() => RX.send('play')")
    page.evaluate(see, False)
    watched.until_changed(lambda: watched.text("total-power"), power)
    watched.answered(wholly=True)
    assert before < len(updates) < before + 6


def test_a_language_that_is_none_leaves_the_page_its_controls(browser: Browser, app: App):
    """WebKitGTK's C."""
    unnamed = (
        "Object.defineProperties(navigator, {language: {value: 'C'}, languages: {value: ['C']}})"
    )
    page = browser.new_page()
    try:
        for script in (DRAW_NOTHING, unnamed.replace("value:", "configurable: true, value:")):
            page.add_init_script(script)
        watched = Watched(page)
        watched.open(app.address)
        watched.row("Adv. ratio").get_by_role("slider").wait_for()
        assert watched.complaints == []
    finally:
        page.close()
