"""A wake whose inflow is a sum of shapes along the blade times waves around the disk, as columns and a closure.

    λ_i = Σ c_t Φ_t(r) w_t(ψ),    c = T(µ_x, µ_z, λ0) Q,    Q_t = mean of Σ Ψ_t w_t dC_T/dr Δr

The coefficients c are states, the closure their equations.
"""

from collections.abc import Hashable, Sequence
from functools import lru_cache
from typing import Protocol

import numpy as np

from rotor.aero.inflow.interface import PLAIN, Followed, Wake
from rotor.aero.section import FZ, UP
from rotor.arrays import Array, Integers
from rotor.engine.linearise import Closure
from rotor.engine.terms import Shape, Structure
from rotor.engine.waves import STEADY


class WakeTheory(Protocol):
    """What differs between wakes of this kind."""

    @property
    def key(self) -> Hashable:
        """The same for the same terms."""
        ...

    @property
    def shapes(self) -> Sequence[Array]:
        """Functions along the blade of the inflow, (elements,) each."""
        ...

    @property
    def gathering(self) -> Sequence[Array]:
        """Those by which the load is summed."""
        ...

    @property
    def names(self) -> tuple[tuple[int, int], ...]:
        """Which of the functions, and which wave each term has."""
        ...

    @property
    def least_azimuths(self) -> int:
        """As `InflowTerms`."""
        ...

    @property
    def factor(self) -> bool:
        """Whether the inflow is divided by a factor that follows the axial flow."""
        ...

    def over_factor(self, wake: Wake) -> tuple[Array, Array]:
        """1/F and its slope by µ_z + λ0, (elements,)."""
        ...

    def answer(self, means: Array, wake: Wake) -> Array:
        """T Q, (terms,)."""
        ...

    def linear(self, means: Array, wake: Wake) -> tuple[Array, Array]:
        """T, (terms, terms), and ∂(T Q) by (µ_x, µ_z, λ0), (terms, 3)."""
        ...

    def nearest(self, field: Array) -> Array:
        """Coefficients of the sum of terms that is nearest to a field, (terms,)."""
        ...


class WakeClosure:
    """c = T(µ_x, µ_z, λ0) Q of one structure."""

    def __init__(self, theory: WakeTheory, structure: Structure) -> None:
        self.rows, self.measures = structure.equations_of("inflow"), _measures_of(structure, theory.names)
        made, states = structure.made, structure.states
        self.atoms = np.array([made["wake_x"], made["wake_z"], states["lambda0"]], dtype=np.int64)
        self._theory = theory

    def value(self, z: Array, q: Array) -> Array:
        """T Q"""
        return self._theory.answer(q[self.measures], Wake(*z[self.atoms].tolist()))

    def linear(self, z: Array, q: Array) -> tuple[Array, Array]:
        """T and ∂(T Q)/∂(µ_x, µ_z, λ0)."""
        return self._theory.linear(q[self.measures], Wake(*z[self.atoms].tolist()))


@lru_cache(maxsize=64)
def _measures_of(structure: Structure, names: tuple[tuple[int, int], ...]) -> Integers:
    """The measures of loads by (shape, wave), (terms,)."""
    return np.array([structure.measure(FZ, ("load", k), wave) for k, wave in names], dtype=np.int64)


class WakeTerms:
    """Such a wake on a disk."""

    def __init__(self, theory: WakeTheory, elements: int, dr: float) -> None:
        self.key: Hashable = ("terms", theory.key)
        self.theory, self._elements, self._dr = theory, elements, dr
        self.names: Sequence[Shape] = [("inflow", k) for k in range(len(theory.shapes))]
        if theory.factor:
            self.names = [*self.names, *(("by axial", k) for k in range(len(theory.shapes)))]
        self.live: Sequence[tuple[int, Shape]] = ()
        self.interface = PLAIN
        self.least_azimuths = theory.least_azimuths

    def declare(self, structure: Structure) -> None:
        """The coefficients."""
        for t in range(len(self.theory.names)):
            structure.state(("inflow", t))

    def build(self, structure: Structure) -> list[int]:
        """A column for every term; where F follows the wake, one more for its slope, on an atom that is zero."""
        atoms = [structure.states["inflow", t] for t in range(len(self.theory.names))]
        changed = structure.quantity("change of axial flow") if self.theory.factor else None
        for t, atom in enumerate(atoms):
            k, wave = self.theory.names[t]
            structure.column(UP, ("inflow", k), wave, 1.0, atom)
            if changed is not None:
                structure.column(UP, ("by axial", k), wave, 1.0, atom, changed)
            structure.measure(FZ, ("load", k), wave)
            structure.term(structure.equation(("inflow", t)), 1.0, atom)
        return atoms

    def shapes(self) -> dict[Shape, Array]:
        """Those of the inflow, unless F makes them follow the wake, and those that sum the load."""
        out: dict[Shape, Array] = {("load", k): own for k, own in enumerate(self.theory.gathering)}
        if not self.theory.factor:
            out |= {("inflow", k): own for k, own in enumerate(self.theory.shapes)}
        return out

    def follow(self, wake: Wake, mu_z: float, sees_tilt: bool) -> Followed:
        """Shapes over F."""
        del mu_z, sees_tilt
        if not self.theory.factor:
            return Followed({}, {})
        over, slope = self.theory.over_factor(wake)
        zero = np.zeros((3, self._elements))
        live = dict[tuple[int, Shape], tuple[Array, Array]]()
        for k, own in enumerate(self.theory.shapes):
            live[UP, ("inflow", k)] = own * over, zero
            live[UP, ("by axial", k)] = own * slope, zero
        return Followed({"change of axial flow": (0.0, (0.0, 1.0, 1.0))}, live)

    def closures(self, structure: Structure) -> tuple[Closure, ...]:
        """Of the coefficients."""
        return (WakeClosure(self.theory, structure),)

    def peaks(self) -> Array:
        """Largest size of the shape of each term, (terms,)."""
        return np.array([np.abs(own).max() for own in self.theory.shapes])[[k for k, _ in self.theory.names]]

    def nearest(self, field: Array) -> Array:
        """Coefficients nearest to a field."""
        return self.theory.nearest(field)

    def axial(self, wake: Wake) -> Array:
        """Through the steady terms."""
        theory = self.theory
        steady = [t for t, (_, around) in enumerate(theory.names) if around == STEADY]
        made, _ = theory.linear(np.zeros(len(theory.names)), wake)
        own = [theory.names[t][0] for t in steady]
        over = theory.over_factor(wake)[0] if theory.factor else np.ones(self._elements)
        shapes = np.array([theory.shapes[k] for k in own]) * over
        return shapes.T @ made[np.ix_(steady, steady)] @ np.array([theory.gathering[k] for k in own]) * self._dr
