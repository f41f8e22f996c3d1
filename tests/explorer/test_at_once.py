"""Pages that drag, bend, climb, search and compute gradients at once: each ends at the answer of its design alone."""

import asyncio
import time

import pytest

from explorer.app import App
from explorer.session import Session
from rotor.trim.analysis import power_gradient
from rotor.trim.solve import solve
from tests.explorer.test_leaving import searching
from tests.tools.visitor import Visitor, ran

PATIENCE = 900.0
"""[s]"""
SAME = 1e-7
"""Largest relative difference of a power from that of a solve alone, which starts elsewhere."""


def query(k: int) -> str:
    """The flight of a page: every second one bends, all have another height and speed."""
    bends = ";bending=true" if k % 2 else ""
    return f"?d=1;linear:-{4 + 0.5 * k:g};mu={0.14 + 0.012 * k:g};mass={7000 + 90 * k};alt={150 * k}{bends}"


async def work(visitor: Visitor, app: App, k: int, seconds: float) -> None:
    """Drag, and now and then search, or open what the doubt consists of, which needs the gradient."""
    await visitor.open(app.address)
    await visitor.until(lambda: visitor.text("status") == "converged", PATIENCE)
    await visitor.press("more", "on")
    await visitor.until(lambda: visitor.shows("Altitude [m]"), PATIENCE)
    end, step = time.monotonic() + seconds, 0
    while step == 0 or time.monotonic() < end:
        if step % 40 == 0 and k % 5 == 0:
            await searching(visitor, PATIENCE)
            await visitor.press("halt")
            await visitor.press("discard")
        elif step % 40 == 0 and k % 5 == 1:
            await visitor.press("drawer", "trust")
        await visitor.move("Altitude [m]", 50.0 * ((7 * k + 11 * step) % 60))
        await visitor.move("Adv. ratio µ", round(0.12 + 0.01 * ((5 * k + 3 * step) % 18), 3))
        await asyncio.sleep(0.15)
        step += 1
    await visitor.idle(PATIENCE, wholly=False)


def answers(session: Session) -> tuple[float, float]:
    """Relative difference of the page's power and of its gradient from those of the same design solved alone."""
    state = session._state
    alone = solve(state.solution.design).require()
    here, there = power_gradient(state.solution).by_element, power_gradient(alone).by_element
    power = abs(state.solution.power.total / alone.power.total - 1.0)
    return power, float(abs(here - there).max() / abs(there).max())


@pytest.mark.slow
@pytest.mark.parametrize(("pages", "seconds"), [(4, 1.0), pytest.param(20, 600.0, marks=pytest.mark.nightly)])
def test_pages_at_once_end_at_the_answers_of_each_alone(app: App, pages: int, seconds: float):
    async def visit() -> tuple[list[str], list[Session]]:
        visitors = [Visitor(query=query(k)) for k in range(pages)]
        await asyncio.gather(*(work(visitor, app, k, seconds) for k, visitor in enumerate(visitors)))
        sessions, notices = list(app.sessions), [notice for visitor in visitors for notice in visitor.notices]
        for visitor in visitors:
            await visitor.close()
        return notices, sessions

    notices, sessions = ran(visit, seconds + 4.0 * PATIENCE)
    assert notices == []
    assert len(sessions) == pages
    designs = {session._state.solution.design for session in sessions if session._state is not None}
    assert len(designs) == pages
    assert sum(design.models.bending for design in designs) == pages // 2
    for session in sessions:
        power, gradient = answers(session)
        assert power < SAME
        assert gradient < 1e-5
