"""Loads of the blades on the hub at N_b per revolution in axes that do not turn, as terms of the trim's equations.

x aft, y to starboard, z up. Each blade leaves on the hub its air loads less mass times acceleration. With the static
moments of the displaced blade X = ∫ m u dr, Y = ∫ m v dr, Z = ∫ m w dr, u = −½ ∫ (w'² + v'²) dr, and f_z = Σ F_z − Z'',

    F_x: F_r cos ψ + F_x sin ψ − (X cos ψ − Y sin ψ)''        M_x: m_f sin ψ + y0 f_z cos ψ
    F_y: F_r sin ψ − F_x cos ψ − (X sin ψ + Y cos ψ)''        M_y: −m_f cos ψ + y0 f_z sin ψ

m_f is e f_z at an articulated root, where the hinge has no moment, and Σ r F_z − ∫ m r (w'' + w) dr at a hingeless one.
The moment about the blade's axis goes into its pitch link and the swashplate, and is not among these. Summed over the
blades only multiples of N_b remain, N_b times those of one blade.
"""

import numpy as np

from rotor.aero.bending import HARMONICS, BladeBending
from rotor.aero.bent_section import E
from rotor.aero.section import FR, FX, FZ
from rotor.arrays import Array
from rotor.columns.coordinates import OFFSET, coordinate
from rotor.engine.terms import ONE, Structure, Terms
from rotor.engine.waves import COS, SIN, STEADY, harmonic_of, times_wave, wave_number

LOADS = ("fx", "fy", "fz", "mx", "my")
"""Each with its cosine and its sine at N_b ψ."""
OUTBOARD = "mass outboard"
"""∫_r^R m dr, by which E has X."""


def has_hub_loads(blades: int) -> bool:
    """Whether the harmonics of bending reach those that N_b/rev at the hub comes from."""
    return blades + 1 <= HARMONICS


class HubLoadTerms:
    """The terms of a blade; or only their measures, which a structure needs before it is finished."""

    def __init__(self, s: Structure, blades: int, hingeless: bool, bending: BladeBending | None = None) -> None:
        self._s, self._blades, self._hingeless, self._bending = s, blades, hingeless, bending
        self.rows = list[tuple[int, int, int, int, float]]()
        for row in range(2 * len(LOADS)):
            wave = wave_number(blades, sine=row % 2 == 1)
            load = LOADS[row // 2]
            if load == "fz":
                self._vertical(row, wave, STEADY, 1.0)
            elif load in ("fx", "fy"):
                along, across, sign = (COS, SIN, 1.0) if load == "fx" else (SIN, COS, -1.0)
                self._in_plane(row, wave, along, across, sign)
            else:
                about, beside, sign = (SIN, COS, 1.0) if load == "mx" else (COS, SIN, -1.0)
                self._moment(row, wave, about, beside, sign)

    def _measured(
        self, row: int, waves: tuple[int, int], force: int, shape: str, factor: float, atom: int = ONE
    ) -> None:
        for product, share in times_wave(*waves):
            self.rows.append((row, self._s.measure(force, shape, product), atom, ONE, 2.0 * factor * share))

    def _moving(
        self, row: int, waves: tuple[int, int], shapes: Array, lever: str, factor: float, atom: int = ONE
    ) -> None:
        """factor · atom · Σ_k shapes_k q_k, or minus its second derivative, or minus what both add up to."""
        bending = self._bending
        if bending is None:
            return
        for product, share in times_wave(*waves):
            squared = harmonic_of(product) ** 2
            gain = {"at rest": 1.0, "inertia": squared, "moment of inertia": squared - 1.0}[lever]
            for k, own in enumerate(shapes.tolist()):
                place = coordinate(self._s, bending.first, k, product)
                self.rows.append((row, 0, place, atom, factor * share * gain * own))

    def _static(self, which: int, arm: bool = False) -> Array:
        """∫ m (r) W_k dr or ∫ m V_k dr, (modes,)."""
        bending = self._bending
        return np.zeros(0) if bending is None else bending.along[which] @ (bending.strips * (bending.r if arm else 1.0))

    def _vertical(self, row: int, wave: int, times: int, factor: float, atom: int = ONE) -> None:
        """f_z"""
        self._measured(row, (wave, times), FZ, "one", factor, atom)
        self._moving(row, (wave, times), self._static(0), "inertia", factor, atom)

    def _in_plane(self, row: int, wave: int, along: int, across: int, sign: float) -> None:
        square = float(self._blades**2)
        self._measured(row, (wave, along), FR, "one", 1.0)
        self._measured(row, (wave, across), FX, "one", sign)
        self._measured(row, (wave, along), self._s.forces + E, OUTBOARD, -0.5 * square)
        self._moving(row, (wave, across), self._static(3), "at rest", -sign * square)

    def _moment(self, row: int, wave: int, about: int, beside: int, sign: float) -> None:
        if self._hingeless:
            self._measured(row, (wave, about), FZ, "r", sign)
            self._moving(row, (wave, about), self._static(0, arm=True), "moment of inertia", sign)
        else:
            hinge = 1.0 if self._bending is None else float(self._bending.r[0])
            self._vertical(row, wave, about, sign * hinge)
        if OFFSET in self._s.states:
            self._vertical(row, wave, beside, 1.0, self._s.states[OFFSET])


def hub_load_terms(s: Structure, blades: int, bending: BladeBending) -> Terms:
    """Cosine and sine of each of `LOADS` in turn, over ρA(ΩR)² and for moments R."""
    return Terms.of(HubLoadTerms(s, blades, bending.modes.beam.hingeless, bending).rows, 2 * len(LOADS))
