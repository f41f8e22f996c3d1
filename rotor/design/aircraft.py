"""An aircraft as far as its rotor needs it: main rotor, tail rotor, drag area, mass. The contents of a rotor file."""

from dataclasses import dataclass
from typing import Any, Literal

from rotor.design.blade import Rotor
from rotor.design.flight import Fuselage
from rotor.design.twist import TwistLaw

FIXED_SHARE = 0.05
"""Tail-rotor power over main-rotor power in the document, at every flight condition (thesis §3.2, p. 25)."""


@dataclass(frozen=True)
class TailRotor:
    """A tail rotor in edgewise flow."""

    radius: float
    """[m]"""
    angular_speed: float
    """[rad/s]"""
    chord: float
    """[m]"""
    blades: int
    arm: float
    """Distance from the main-rotor shaft [m]."""
    cant: float
    """Tilt of the thrust out of the horizontal [rad]; only the horizontal part balances torque."""
    tip_loss: float
    """Effective radius factor B."""
    drag_polar: tuple[float, float, float]
    """c_d = δ0 + δ1 α + δ2 α² with α [rad]."""
    lift_slope: float
    """[1/rad]"""


Hub = Literal["articulated", "teetering", "teetering-with-coning-hinges"]
HUBS: tuple[Hub, ...] = ("articulated", "teetering", "teetering-with-coning-hinges")


@dataclass(frozen=True)
class Stated:
    """The rotor as the source document states it, where it differs from the aircraft's."""

    rotor: Rotor
    twist: TwistLaw


@dataclass(frozen=True)
class RotorFiles:
    """The text of the files of a user's rotor, so that a saved design is complete."""

    main: str
    """Name of the rotor file."""
    texts: tuple[tuple[str, str], ...]
    """(name, text) of the rotor file and of every file it names."""


@dataclass(frozen=True, repr=False)
class Aircraft:
    """One aircraft, without arrays, so that it can be compared, hashed and sent to other processes."""

    name: str
    """Display name, for example UH-60A."""
    rotor: Rotor
    """The rotor as built, with its built-in twist."""
    fuselage: Fuselage
    mass: float
    """Reference mass [kg]."""
    tail_rotor: TailRotor | None = None
    """None: no tail rotor, or an unknown one; five per cent of main-rotor power is used instead."""
    hub: Hub = "articulated"
    stated: Stated | None = None
    key: str = ""
    """Name of a shipped aircraft, as for `--rotor`; empty for a user's own."""
    files: RotorFiles | None = None
    """Files of a user's own aircraft; None for a shipped one."""
    remarks: tuple[str, ...] = ()
    """Assumptions made when the files were read, in sentences."""

    def __repr__(self) -> str:
        return f"Aircraft({self.name}, {self.mass:.0f} kg, drag area {self.fuselage.drag_area:.3g} m², {self.rotor})"

    def record(self) -> Any:
        """For a design file: the name of a shipped rotor, or all files of a user's own, line by line."""
        if self.files is None:
            return self.key
        return {
            "main": self.files.main,
            "files": {name: text.splitlines() for name, text in self.files.texts},
        }

    def rotor_for(self, preset: str) -> Rotor:
        """The rotor of a preset: `thesis` takes the document's where there is one, else the rotor as built."""
        return self.stated.rotor if preset == "thesis" and self.stated else self.rotor

    def twist_for(self, preset: str) -> TwistLaw:
        """The baseline twist of a preset: `thesis` takes the document's where there is one, else the built-in twist."""
        return self.stated.twist if preset == "thesis" and self.stated else self.rotor.builtin_twist

    def twist_title(self, preset: str) -> str:
        """The name of the baseline twist for the user."""
        if preset == "thesis" and self.stated:
            return self.stated.twist.spec().replace("linear:-", "linear −") + "°"
        return f"{self.name} as built"
