"""What an actuator weighs: plies or tubes, leads, the nose weight that restores chordwise balance, electronics."""

from dataclasses import dataclass

from rotor.actuator.catalogue import Actuator, ExtensionTwist, PiezoPly
from rotor.actuator.placement import Placement
from rotor.dynamics.structure import BladeStructure, structure_data
from rotor.dynamics.torsion_beam import Addition


@dataclass(frozen=True)
class MassBill:
    """Added mass [kg]."""

    actuator: float
    """Per blade."""
    wiring: float
    """Per blade."""
    balance: float
    """Per blade."""
    electronics: float
    """Per aircraft."""
    blades: int

    @property
    def blade(self) -> float:
        """On one blade."""
        return self.actuator + self.wiring + self.balance

    @property
    def aircraft(self) -> float:
        return self.blades * self.blade + self.electronics


def balance_mass(mass: float, centre: float) -> float:
    """Nose weight [kg] for a mass with its centre at x/c: Δm = m (x − 0.25)/(0.25 − 0.02), none when it is forward."""
    limits = structure_data()["limits"]
    axis, nose = float(limits["balance_axis_c"]), float(limits["nose_weight_c"])
    return max(0.0, mass * (centre - axis) / (axis - nose))


def mass_bill(actuator: Actuator, placement: Placement, blades: int, skin_area: float) -> MassBill:
    """The bill for one placement; `skin_area` [m²] is what one layer covers on one blade, both skins."""
    limits = structure_data()["limits"]
    wiring, electronics = float(limits["wiring_share"]), float(limits["electronics_share"])
    if isinstance(actuator, ExtensionTwist):
        return MassBill(0.0, 0.0, 0.0, 0.0, blades)
    if isinstance(actuator, PiezoPly):
        own = actuator.material.density * actuator.thickness * placement.plies * skin_area
        nose = balance_mass((1.0 + wiring) * own, 0.5 * sum(placement.chord))
        return MassBill(own, wiring * own, nose, electronics * own * blades, blades)
    own = actuator.mass * placement.plies * len(placement.segments)
    return MassBill(own, wiring * own, 0.0, electronics * own * blades, blades)


def addition(
    bill: MassBill, placement: Placement, structure: BladeStructure, stiffness: float, *, balance: bool = True
) -> Addition:
    """The bill as running mass, torsional inertia about the balance axis, and stiffness, over the active span."""
    limits = structure_data()["limits"]
    axis, nose = float(limits["balance_axis_c"]), float(limits["nose_weight_c"])
    low, high = (structure.radius * end for end in placement.span)
    front, rear = placement.chord
    plies = (bill.actuator + bill.wiring if balance else bill.actuator) / (high - low)
    weight = (bill.balance if balance else 0.0) / (high - low)
    arm = 0.5 * (front + rear) - axis
    spread = plies * (arm**2 + (rear - front) ** 2 / 12.0) + weight * (axis - nose) ** 2
    return Addition((low, high), plies + weight, spread * structure.chord**2, stiffness)
