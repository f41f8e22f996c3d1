"""The camera of a client, without one."""

from types import SimpleNamespace
from typing import Any, cast

import pytest

from explorer.picture.camera_views import fit
from explorer.scene.camera import FittedCamera


@pytest.mark.parametrize("radius", [0.1, 0.36, 1.1, 3.8, 9.5])
def test_the_near_plane_is_before_every_rotor(radius: float, monkeypatch: pytest.MonkeyPatch):
    """It was 2 m for all, so a rotor of 0.7 m stood before it and was not drawn."""
    monkeypatch.setattr(FittedCamera, "aim", lambda *_: None)
    camera = SimpleNamespace(on_update=lambda _: None)
    fitted = FittedCamera(cast(Any, SimpleNamespace(camera=camera)), 8.2)
    assert camera.near == 2.0
    fitted.resize(radius)
    away = float(sum(fit("3d", radius, 1.5).position ** 2) ** 0.5)
    assert camera.near < away - 2.0 * radius
