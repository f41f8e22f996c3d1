"""What the page itself does for the scene: gloss of surfaces, and turning the rotor smoothly at the screen's own rate.

Tip vortices turn with the rotor: the page moves their points, by the formula of `explorer.picture.wake`.

`explorer/web/scene.js` does it. It leans on private names of viser's client (`__viserMutable`: nodeRefFromName,
nodePoseData, requestRender); each has a browser test.
"""

import math
from dataclasses import asdict
from typing import Any

import viser

from explorer.hosting.browser import call
from explorer.picture.poses import pitch_series
from explorer.picture.wake import tip_vortex_path
from explorer.scene.overlays import VORTICES
from explorer.scene.scene import COMPARED, ROTOR
from rotor import Solution

TURN_RATES = {"slow": math.radians(18.0), "normal": math.radians(54.0), "fast": math.radians(162.0)}
"""[rad/s] at which a played rotor turns; at the normal one flapping and pitching of one blade can be followed."""
SURFACES = {
    f"{ROTOR}/blade_0": {"roughness": 0.55},
    **{f"{ROTOR}/blade_{k}": {"roughness": 0.42} for k in range(1, 8)},
    f"{ROTOR}/head": {"roughness": 0.38, "metalness": 0.55},
    "/airframe/glass": {"roughness": 0.12, "metalness": 0.2},
    **{name: {"flat": True} for name in ("/shadow", f"{ROTOR}/disk/words", f"{ROTOR}/disk/field")},
    **{name: {"flat": True} for name in ("/compared/disk/words", "/compared/disk/field", "/letter_A", "/letter_B")},
}
"""Materials by node: how rough and metallic, or a flat picture, which must not hide what lies behind its corners."""


def motion_of(solution: Solution, root: str = ROTOR) -> dict[str, Any]:
    """What `rotorScene.move` needs: how blades flap and pitch, and where the tip vortices go."""
    rotor, controls = solution.design.rotor, solution.controls
    return {
        "root": root,
        "blades": rotor.blades,
        "hinge": rotor.blade.flap_hinge * rotor.radius,
        "flap": [controls.coning, controls.flap_1c, controls.flap_1s],
        "pitch": pitch_series(controls, solution.design),
        "radius": rotor.radius,
        "vortices": VORTICES,
        "path": asdict(tip_vortex_path(solution)),
    }


def tie(client: viser.ClientHandle, *nodes: str) -> None:
    """Let the page turn these nodes about the shaft with the reference blade while the rotor plays, and no others."""
    call(client, "rotorScene.tie", nodes)


class PageScene:
    def __init__(self, client: viser.ClientHandle) -> None:
        self._client = client
        self._played = self._spun = False
        self._motion: Solution | None = None
        call(client, "rotorScene.dress", SURFACES)

    def move(self, solution: Solution) -> None:
        """How the blades flap and pitch from now on; sent at once only while the rotor turns."""
        self._motion = solution
        if self.playing:
            self._send(solution)

    def compare(self, solution: Solution | None) -> None:
        """How the blades of A move, where it is at the same place."""
        motion = None if solution is None else motion_of(solution, COMPARED)
        call(self._client, "rotorScene.compare", motion)

    def turn(self, azimuth: float) -> None:
        """The reference blade is at ψ [rad] now; the page goes on from here until the next message."""
        if self.playing:
            call(self._client, "rotorScene.turn", round(azimuth, 4))

    @property
    def playing(self) -> bool:
        return self._motion is not None and (self._played or self._spun)

    def play(self, playing: bool) -> None:
        """Let the page move the blades as it is told to, or leave them to the scene again."""
        self._switch(playing, self._spun)

    def spin(self, spinning: bool) -> None:
        """Let the page turn the rotor by itself where nothing else does, or no more."""
        if spinning != self._spun:
            call(self._client, "rotorScene.spin", TURN_RATES["fast"] if spinning else 0.0)
        self._switch(self._played, spinning)

    def _switch(self, played: bool, spun: bool) -> None:
        before = self.playing
        self._played, self._spun = played, spun
        if self.playing and not before and self._motion is not None:
            self._send(self._motion)
        elif before and not self.playing:
            call(self._client, "rotorScene.stop")

    def _send(self, solution: Solution) -> None:
        call(self._client, "rotorScene.move", motion_of(solution))
