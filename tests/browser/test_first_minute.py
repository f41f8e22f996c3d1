"""A stranger's first minute, as a person would play it: each step is seen before the next begins."""

from watched import Visit

SIZE = (1280, 720)


def test_open_grab_undo_reload_link_disk_hover_optimise_apply(visit: Visit):
    watched = visit(size=SIZE)
    page = watched.page

    def kilowatts() -> float:
        return float(
            watched.text("total-power").split("kW")[0].replace("\u2009", "").replace(" ", "")
        )

    def grabbed(down: float) -> None:
        """Take the blade by its tip and pull it down so many pixels."""
        x, y = watched.grab_tip()
        for step in range(1, 9):
            page.mouse.move(x, y + 12 + down * step / 8)
            page.wait_for_timeout(60)
        page.wait_for_function("() => RX.state.hand?.power")
        page.mouse.up()
        page.wait_for_function("() => RX.state.hand === null && RX.state.twisting === null")
        watched.answered()

    # Open: a trimmed rotor, its power, and where to begin.
    as_built = kilowatts()
    assert page.locator(".rxf-prompt").inner_text().strip() == "Drag the blade tip up or down"
    # Grab and twist: power answers and says since when; undo takes the whole drag back, redo brings it again.
    grabbed(30.0)
    twisted = kilowatts()
    assert twisted != as_built
    watched.reads("line", "kW (more|less) than as built")
    page.get_by_role("button", name="Undo").click()
    watched.until(lambda: kilowatts() == as_built)
    page.get_by_role("button", name="Redo").click()
    watched.until(lambda: kilowatts() == twisted)
    watched.answered()
    page.wait_for_function("() => location.search.includes('segments')")
    # Reload, and the link in another window: the same design.
    page.reload()
    watched.ready()
    watched.until(lambda: kilowatts() == twisted)
    guest = visit(query="?" + page.url.partition("?")[2], size=SIZE)
    watched.until(lambda: guest.text("total-power") == watched.text("total-power"))
    # Disk: what the section does below the pointer.
    page.get_by_role("button", name="Disk", exact=True).click()
    page.wait_for_function("() => RX.state.plan?.values")
    circle = watched.box(page.locator(".rxf-plan svg circle").first)
    page.mouse.move(circle["x"] + 0.8 * circle["width"], circle["y"] + 0.5 * circle["height"])
    watched.until(lambda: "R · ψ" in page.locator(".rxf-reading").first.inner_text())
    page.get_by_role("button", name="Aircraft").click()
    # Hover flight and back.
    watched.press("Adv. ratio", "Home")
    watched.until(lambda: kilowatts() > 1.3 * twisted)
    page.get_by_role("button", name="Undo").click()
    watched.until(lambda: kilowatts() == twisted)
    watched.answered()
    # Optimise, watch, keep: less power than as built, and the address has it.
    before = page.url
    page.get_by_role("button", name="Optimise this blade").click()
    page.wait_for_function(
        "() => RX.state.notice?.text.startsWith('Previewing optimum')", timeout=180_000
    )
    page.get_by_role("button", name="Apply").first.click()
    page.wait_for_function("() => RX.state.notice === null")
    watched.answered()
    assert kilowatts() < as_built
    page.wait_for_function("before => location.href !== before", arg=before)
