"""What is asked of one trim more than once, kept by whoever asks and gone with it."""

from collections.abc import Mapping
from functools import cached_property

from rotor.trim.adjoint import Adjoint, PitchGradient, power_along
from rotor.trim.power_changes import power_changes
from rotor.trim.solution import Solution


class Analysis:
    """What is asked of a solution, computed when it is first asked for; the slopes of power share one adjoint.

    The parts raise RuntimeError with the solution's sentence when it is not converged.
    """

    def __init__(self, solution: Solution) -> None:
        self.solution = solution

    @cached_property
    def adjoint(self) -> Adjoint:
        """The linearised trim, with its factors."""
        return Adjoint(self.solution)

    @cached_property
    def gradient(self) -> PitchGradient:
        """∂P/∂θ(r) of total power."""
        return power_along(self.adjoint)

    @cached_property
    def power_changes(self) -> Mapping[str, float]:
        """What every uncertain input does to total power [W], where it is larger by its size.

        RuntimeError for a free rotor.
        """
        return power_changes(self.adjoint)


def analysed(given: Solution | Analysis) -> Analysis:
    """The analysis itself, or that of a solution."""
    return given if isinstance(given, Analysis) else Analysis(given)
