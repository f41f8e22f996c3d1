"""Real browsers among the visitors: Chromium pages that press the slider's keys and watch their own scene."""

import asyncio
import time
from typing import Any

from tests.chromium import DRAW_NOTHING, LAUNCH_ARGUMENTS, find_chromium
from tests.tools.soak.drag import SLIDER
from tests.tools.soak.figures import Visit

_PATIENCE = 30_000.0
"""[ms] after which a frame that has not come is lost."""
_PAUSE = 100.0
"""[ms] between two keys: the page keeps an edit back that follows another within 50."""

_READY = "() => document.querySelector('[data-explorer=status]')?.dataset.kind === 'converged'"
_BLADE = "window.__viserSceneTree.getState()['/rotor/blade_0'].message.props.vertices"
_CHANGED = f"""() => new Promise((done, lost) => {{
    const before = window.__before, begun = performance.now();
    const look = () => {_BLADE} !== before ? done(performance.now() - begun)
        : performance.now() - begun > {_PATIENCE} ? lost(new Error('no frame')) : requestAnimationFrame(look);
    look();
}})"""


async def visit(address: str, pages: int, begin: float, end: float) -> list[Visit]:
    """So many pages press keys from `begin` to `end` (`time.monotonic`). RuntimeError where there is no browser."""
    try:
        from playwright.async_api import async_playwright
    except ImportError:
        raise RuntimeError("Real browsers need playwright: pip install 'rotor-explorer[test]'.") from None
    path = await asyncio.to_thread(find_chromium)  # Which may ask Playwright in its other way, not for a loop.
    async with async_playwright() as playwright:
        browser = await playwright.chromium.launch(executable_path=path, args=list(LAUNCH_ARGUMENTS))
        visits = [_press(browser, f"page {k + 1}", address, begin, end) for k in range(pages)]
        seen = await asyncio.gather(*visits)
        await browser.close()
    return list(seen)


async def _press(browser: Any, name: str, address: str, begin: float, end: float) -> Visit:
    delays: list[float] = []
    lost: list[str] = []
    complaints: list[str] = []
    context = await browser.new_context(viewport={"width": 1280, "height": 720})
    await context.add_init_script(DRAW_NOTHING)
    page = await context.new_page()
    page.on("pageerror", lambda error: complaints.append(f"{name}: {error}"))
    try:
        await page.goto(address)
        await page.wait_for_function(_READY, timeout=2.0 * _PATIENCE)
        label = page.locator("label", has_text=SLIDER).first
        slider = label.locator("xpath=ancestor::div[contains(@class,'Flex-root')][1]").get_by_role("slider")
        await asyncio.sleep(max(begin - time.monotonic(), 0.0))
        presses = 0
        while time.monotonic() < end:
            await slider.focus()
            await page.evaluate(f"window.__before = {_BLADE}")
            await page.keyboard.press("ArrowRight" if presses // 20 % 2 == 0 else "ArrowLeft")
            presses += 1
            try:
                delays.append(await page.evaluate(_CHANGED))
            except Exception:  # The page's own error: no frame came.
                lost.append(f"{name}: key {presses} brought no frame")
            await page.wait_for_timeout(_PAUSE)
    except Exception as error:  # A page that fails is a finding, not the end of the soak.
        complaints.append(f"{name}: {error}")
    await context.close()
    return Visit(len(delays) + len(lost), tuple(delays), 0, tuple(lost), len(delays), 0.0, tuple(complaints))
