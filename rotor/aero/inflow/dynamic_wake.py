"""The Peters–He dynamic wake as an inflow model; its mathematics is in `rotor.wake`."""

from dataclasses import dataclass, replace

from rotor.aero.disk import Disk
from rotor.aero.inflow.interface import LoadLoop
from rotor.aero.inflow.wake_response import DynamicWake, WakeResponse
from rotor.aero.inflow.wake_state import Wake
from rotor.arrays import Array


@dataclass(frozen=True)
class DynamicWakeInflow:
    """Peters–He with the rotor's own blade number, or with infinitely many blades."""

    name: str
    title: str
    explanation: str
    order: int
    infinite_blades: bool = False
    tip: bool = True

    reacts = True

    def without_tip_loss(self) -> "DynamicWakeInflow":
        """Infinitely many blades with F = 1: what a few blades lose at their tips is in the harmonics of their wake."""
        return replace(self, infinite_blades=True, tip=False)

    def laid_out(self, expected: Wake) -> "DynamicWakeInflow":
        """Itself: the wake moves with the trim."""
        del expected
        return self

    def respond(self, disk: Disk, wake: Wake, load: Array) -> "DynamicWakeResponse":
        """λ_i = A d."""
        model = DynamicWake.of(disk.blades, self.order, infinite_blades=self.infinite_blades, tip=self.tip)
        elements, azimuths = disk.shape
        projection = model.on(disk.root, elements, azimuths)
        return DynamicWakeResponse(model.response(projection, wake), load)


class DynamicWakeResponse:
    """A at one wake, with the answer to one load."""

    def __init__(self, response: WakeResponse, load: Array) -> None:
        self._response = response
        self._load = load
        self.induced = response.induced(load)

    @property
    def by_wake(self) -> Array:
        """∂λ_i by (µ_x, µ_z, λ0) at this load."""
        return self._response.induced_by_wake(self._load)

    def drive(self, fields: Array) -> Array:
        """A f."""
        return self._response.induced(fields)

    def drive_transposed(self, field: Array) -> Array:
        """Aᵀ f."""
        return self._response.induced_transposed(field)

    def loop(self, slope: Array) -> LoadLoop:
        """(I − A diag K)⁻¹ through one factorisation of the wake's states."""
        return self._response.loop(slope)


DYNAMIC_WAKES = (
    DynamicWakeInflow(
        "dynamic-wake",
        "Dynamic wake (Peters–He)",
        "Answers to where the lift is, with this rotor's own blades: the disk shows what each blade meets at ψ.",
        order=8,
    ),
    DynamicWakeInflow(
        "dynamic-wake-quick",
        "Dynamic wake, few states",
        "The same theory with fewer shapes: quicker and coarser.",
        order=4,
    ),
    DynamicWakeInflow(
        "dynamic-wake-infinite-blades",
        "Dynamic wake, infinite blades",
        "The time-averaged wake of infinitely many blades with Prandtl's tip factor: compare it with the real number.",
        order=8,
        infinite_blades=True,
    ),
)
