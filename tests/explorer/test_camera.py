"""The camera of a client, without one."""

import threading
from contextlib import nullcontext
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from explorer.picture.camera_views import Camera, fit
from explorer.scene.camera import FittedCamera


def camera_of(radius: float) -> tuple[FittedCamera, SimpleNamespace]:
    """A fitted camera, and what the browser would be told."""
    connection = SimpleNamespace(queue_message=lambda _: None)
    state = SimpleNamespace(
        position=np.zeros(3),
        look_at=np.zeros(3),
        client=SimpleNamespace(_websock_connection=connection),
    )
    camera = SimpleNamespace(on_update=lambda _: None, aspect=1.5, _state=state)
    return FittedCamera(
        cast(Any, SimpleNamespace(camera=camera, atomic=nullcontext)), radius
    ), camera


@pytest.mark.parametrize("radius", [0.1, 0.36, 1.1, 3.8, 9.5])
def test_the_near_plane_is_before_every_rotor(radius: float):
    """It was 2 m for all, so a rotor of 0.7 m stood before it and was not drawn."""
    fitted, camera = camera_of(8.2)
    assert camera.near == 2.0
    fitted.resize(radius)
    away = float(sum(fit("3d", radius, 1.5).position ** 2) ** 0.5)
    assert camera.near < away - 2.0 * radius


def test_what_is_sent_last_is_fitted_to_what_is_known_last(monkeypatch: pytest.MonkeyPatch):
    """While the camera is fitted on one thread, another learns what cards cover: the first must not send last."""
    fitted, camera = camera_of(8.2)
    fitting, covered = threading.Event(), threading.Event()

    def slow(*known: Any) -> Camera:
        if not fitting.is_set():
            fitting.set()
            covered.wait(0.2)  # The other thread may get no further before this one has sent.
        return fit(*known)

    monkeypatch.setattr("explorer.scene.camera.fit", slow)
    first = threading.Thread(target=fitted.aim, args=("3d",))
    first.start()
    fitting.wait()
    fitted.leave_free(0.4, 0.2)
    covered.set()
    first.join()
    last = camera._state.position
    fitted.aim("3d")
    assert (last == camera._state.position).all()
