"""An aircraft as far as its rotor needs it: main rotor, tail rotor, drag area, mass. The contents of a rotor file."""

from dataclasses import dataclass
from typing import Literal

from rotor.design.blade import Rotor
from rotor.design.flight import Fuselage
from rotor.design.twist import TwistLaw

FIXED_SHARE = 0.05
"""Tail rotor over main rotor power as the document has it in every flight state (thesis §3.2, p. 25)."""


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
    """The rotor as the source document states it, where it differs from the one that flies."""

    rotor: Rotor
    twist: TwistLaw


@dataclass(frozen=True)
class RotorFiles:
    """The files a user's rotor was read from, word for word, so that a saved design is complete."""

    main: str
    """Name of the rotor file itself."""
    texts: tuple[tuple[str, str], ...]
    """(name, text) of it and of every file it names."""


@dataclass(frozen=True, repr=False)
class Aircraft:
    """One aircraft, without arrays: equality, hashing and travel to other processes come free."""

    name: str
    """As people write it, for example UH-60A."""
    rotor: Rotor
    """As it flies, with its built-in twist."""
    fuselage: Fuselage
    mass: float
    """Reference mass [kg]."""
    tail_rotor: TailRotor | None = None
    """None: another way to balance the torque, or an unknown one; the document's five per cent stand for it."""
    hub: Hub = "articulated"
    stated: Stated | None = None
    key: str = ""
    """Name of a shipped one, as `--rotor` takes it; empty for a user's own."""
    files: RotorFiles | None = None
    """Of a user's own; None for a shipped one."""
    remarks: tuple[str, ...] = ()
    """What had to be assumed when its files were read, in sentences."""

    def __repr__(self) -> str:
        return f"Aircraft({self.name}, {self.mass:.0f} kg, drag area {self.fuselage.drag_area:.3g} m², {self.rotor})"

    def rotor_for(self, preset: str) -> Rotor:
        """The rotor that a preset computes: as the document states it (`thesis`, where it does), else as it flies."""
        return self.stated.rotor if preset == "thesis" and self.stated else self.rotor

    def twist_for(self, preset: str) -> TwistLaw:
        """The twist that changes count from: the document's (`thesis`, where it has one), else the built-in."""
        return self.stated.twist if preset == "thesis" and self.stated else self.rotor.builtin_twist

    def twist_title(self, preset: str) -> str:
        """A name for that twist, as the page shows it."""
        if preset == "thesis" and self.stated:
            return self.stated.twist.spec().replace("linear:-", "linear −") + "°"
        return f"{self.name} as built"
