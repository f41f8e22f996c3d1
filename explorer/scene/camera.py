"""The camera of one client: fits the rotor into the canvas and follows its size until the user takes over."""

import math
import threading
import time
from collections.abc import Callable
from dataclasses import astuple
from functools import partial
from typing import cast

import numpy as np
import viser

from explorer.hosting.browser import call
from explorer.hosting.viser_compat import aim
from explorer.picture.camera_views import (
    FIELD_OF_VIEW,
    USUAL_COVER,
    Camera,
    Covered,
    View,
    between_cards,
    fit,
)

_MOST_COVERED = 0.75
"""Along two edges that face each other. On a smaller canvas the scene goes on behind the cards."""
_LEAST_COVER = 1e-3
"""A smaller change of what cards cover does not move the camera."""
_LEAST_TILT = math.radians(0.2)
"""A smaller change of the shaft tilt does not move the camera."""
_LONGEST_FLIGHT_S = 1.0
"""A flight of the camera takes no longer [s]."""
_ASPECT_CHANGE = 0.01
"""A smaller change of width over height is none: the page draws fewer pixels while something is dragged."""


def _bounded(one: float, other: float) -> tuple[float, float]:
    """Fractions that two facing edges are covered, smaller where nothing would be left between them."""
    one, other = max(one, 0.0), max(other, 0.0)
    share = min(1.0, _MOST_COVERED / max(one + other, _MOST_COVERED))
    return share * one, share * other


def _near(radius: float) -> float:
    """Distance of the near plane [m]: as far as a rotor of this radius [m] allows, which keeps the depth resolution
    that words on the disk need."""
    return min(2.0, 0.25 * radius)


class FittedCamera:
    """Aims once the canvas is known, again whenever its size changes, and when a view is asked for."""

    def __init__(self, client: viser.ClientHandle, radius: float) -> None:
        self._client = client
        self._lock = threading.Lock()
        """Presses, and the browser's messages of its canvas, come on several threads: what is sent last must be fitted
        to what is known last."""
        self.radius = radius
        """Radius of the rotor that is shown [m]."""
        self.subject: Callable[[float], Camera] | None = None
        """What `aim_with` was given; None while the rotor is looked at."""
        self._view: View | None = "3d"
        """None while something else than the rotor is looked at."""
        self._azimuth = 0.0
        self._tilt = math.radians(3.0)
        self._cover = USUAL_COVER
        self._fit: Callable[[float], Camera] = partial(self._fitted, "3d")
        self._following = True
        self._held = False
        self._arrives = 0.0
        """When a flight of the camera ends."""
        self._put: float | None = None
        """Width over height of the canvas that it was aimed for last."""
        client.camera.fov = FIELD_OF_VIEW
        client.camera.near = _near(radius)
        client.camera.on_update(self._moved)

    def aim(self, view: View) -> None:
        """Show the rotor, and go on doing so when the canvas changes."""
        self._view, self.subject = view, None
        self._aim(partial(self._fitted, view))

    def let_go(self) -> None:
        """The user has turned it: follow nothing any more, until it is aimed again."""
        self._following = self._following and self._held

    def come_back(self) -> None:
        """The user has turned it: show the subject again."""
        self._aim(eased=True)

    def _fitted(self, view: View, aspect: float) -> Camera:
        return fit(view, self.radius, aspect, self._azimuth, self._tilt, self._cover)

    def resize(self, radius: float) -> None:
        """The rotor is of another radius [m] now: fit it anew, unless something else is looked at."""
        if radius == self.radius:
            return
        self.radius = radius
        self._client.camera.near = _near(radius)
        if self._view is not None:
            self._aim()

    def ride(self, azimuth: float) -> None:
        """The reference blade is at ψ [rad]: a camera that looks along it goes with it, until the user takes over."""
        if azimuth == self._azimuth:
            return
        self._azimuth = azimuth
        if self._view == "blade" and self._following:
            self._aim()

    def follow(self, tilt: float) -> None:
        """Go with the shaft tilt [rad], until the user takes over."""
        if abs(tilt - self._tilt) < _LEAST_TILT:
            return
        self._tilt = tilt
        if self._view not in (None, "blade") and self._following and not self._held:
            self._aim()

    def composed(self, aspect: float, cover: Covered) -> Camera:
        """Framed anew for a picture of this width over height: from where the user looks, if they turned the view."""
        camera, towards = self._client.camera, None
        if not self._following:
            towards = camera.position - camera.look_at
            towards /= np.linalg.norm(towards)
        if self._view is not None:
            return fit(self._view, self.radius, aspect, self._azimuth, self._tilt, cover, towards)
        subject = cast(Callable[[float], Camera], self.subject)(cover.free_aspect(aspect))
        if towards is not None:
            distance = np.linalg.norm(subject.position - subject.look_at)
            subject = Camera(subject.look_at + distance * towards, subject.look_at)
        return between_cards(subject, cover, aspect)

    def leave_free(self, above: float, below: float, left: float = 0.0, right: float = 0.0) -> None:
        """Cards cover these fractions of the canvas along its edges; follow, until the user takes over."""
        cover = Covered(*_bounded(above, below), *_bounded(left, right))
        edges = zip(astuple(cover), astuple(self._cover), strict=True)
        if sum(abs(new - old) for new, old in edges) < _LEAST_COVER:
            return
        self._cover = cover
        if self._following and self._put is not None and not self._held:
            self._aim(eased=time.monotonic() < self._arrives)

    def hold(self, held: bool) -> None:
        """Stand still while the blade is in the user's hand; then fit what tilt, canvas and cards are by now."""
        self._held = held
        if not held and self._following:
            self._aim()

    def aim_with(self, fitted: Callable[[float], Camera], eased: bool = False) -> None:
        """Aim at another subject: `fitted` finds the camera for a width over height without cards."""
        self._view, self.subject = None, fitted
        self._aim(
            lambda aspect: between_cards(
                fitted(self._cover.free_aspect(aspect)), self._cover, aspect
            ),
            eased,
        )

    def _aim(self, fitted: Callable[[float], Camera] | None = None, eased: bool = False) -> None:
        """Look as `fitted` says, from now on; None: as before."""
        camera = self._client.camera
        with self._lock:
            self._fit, self._following = fitted or self._fit, True
            if self._reshaped:
                self._put = camera.aspect
            target = self._fit(self._put or camera.aspect)
            self._arrives = time.monotonic() + _LONGEST_FLIGHT_S if eased else 0.0
            if eased:
                call(
                    self._client,
                    "rotorScene.look",
                    target.position.tolist(),
                    target.look_at.tolist(),
                )
                return
            with self._client.atomic():
                aim(camera, target.position, target.look_at)

    @property
    def _reshaped(self) -> bool:
        """Whether the canvas has another shape than it was aimed for."""
        return (
            self._put is None or abs(self._client.camera.aspect / self._put - 1.0) > _ASPECT_CHANGE
        )

    def _moved(self, camera: viser.CameraHandle) -> None:
        if self._following and not self._held and self._reshaped:
            self._aim()
