"""Helicopter main-rotor aerodynamics: trim, power and twist. The UH-60A is the default rotor.

    design = rotor.make_design(twist="linear:-12", mu=0.2)
    solution = rotor.solve(design)
    solution.power.total
    rotor.sweep(design, mu=[0.1, 0.2, 0.3])
    rotor.optimise(design, concept="two-segment").twist
    rotor.schedule(design, mu=[0.0, 0.2, 0.3]).in_flight_gain("linear")
    rotor.actuator.try_actuator("MFC_P1", design, mu=(0.0, 0.3)).net_saving

Conventions:

- SI units and radians. A name that ends in `_deg`, `_w`, `_kt`, `_kg` or `_m` has that unit.
- ψ = 0 over the tail, counter-clockwise seen from above, advancing side ψ = 90°. r = y/R.
- Arrays over the disk are (radius, azimuth): elements first, azimuths second.
- Velocities are over ΩR. λ is positive down through the disk, U_P likewise. β up, θ nose-up.
- β = β0 + β1c cos ψ + β1s sin ψ (flap-back: β1c < 0). θ = θ0 + θ1c cos ψ + θ1s sin ψ + θ_tw(r), θ_tw(0.75) = 0.
- Shaft tilt α is positive forward: µ_x = µ cos α, µ_z = µ sin α; µ = V/(ΩR) is the *advance ratio*.
- Coefficients are of ρA(ΩR)², ρA(ΩR)³. Solidity is 0.0821 for the UH-60A, with the chord 0.5273 m.

Equation numbers in docstrings are those of M. Lonoce, Helicopter Blade Twist Optimization in Forward Flight, MSc
thesis, Instituto Superior Técnico, 2016 ("the document"), whose misprints are named where they occur.
"""

from rotor.support.terminal import stop_while_read  # Before the large modules are imported.

stop_while_read()

from importlib import import_module
from typing import TYPE_CHECKING

from rotor.support.assets import package_version

if TYPE_CHECKING:
    from rotor.public import *  # noqa: F403

__version__ = package_version()


def __getattr__(name: str) -> object:
    if name.startswith("_") and name != "__all__":
        raise AttributeError(f"module 'rotor' has no attribute {name!r}")
    try:
        value = globals()[name] = getattr(import_module("rotor.public"), name)
    except AttributeError:
        from rotor.support.user_input import did_you_mean

        hint = did_you_mean(name, __dir__())
        raise AttributeError(f"module 'rotor' has no attribute {name!r}{hint}", name=name) from None
    return value


def __dir__() -> list[str]:
    return list(import_module("rotor.public").__all__)
