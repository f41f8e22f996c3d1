"""How far and how hard a trim is solved."""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class SolverOptions:
    """Tolerances and limits of the solvers. The defaults serve every design; a test may tighten them."""

    residual_tolerance: float = 1e-10
    """Largest residual of the trim equations, as a fraction of C_W; it keeps the energy identity to 1e-9."""
    inflow_tolerance: float = 1e-8
    """Largest difference of λ_i from the model's response to the loads, as a fraction of λ0."""
    torsion_tolerance: float = 1e-10
    """Largest residual of the torsion equations [rad]."""
    accepted_residual: float = 1e-7
    accepted_inflow: float = 1e-3
    """The same two where Newton's method makes no more progress: the slopes of stall data jump from one table cell to
    the next, and a root element on such a jump can keep the last digits of its own inflow from settling. Power still
    closes to 1e-6."""
    max_passes: int = 40
    """Evaluations of the blade elements in one run of Newton's method."""
    most_old_steps: float = 4.0
    """Derivatives are evaluated again when more steps than this are to be expected with the old ones: derivatives cost
    as much as two to four, and one or two steps follow them. Our choice."""
    most_old_steps_of_start: float = 2.0
    """The same where a trim is solved on few azimuths to start from: derivatives serve all later steps. Our choice."""
    kept_ratio: float = 0.03
    """Derivatives are kept for the next trim where the last step left less than this part of the residual."""
    angle_step: float = 0.08
    """Largest Newton step of an angle [rad]: beyond it the section slopes no longer hold."""
    inflow_step: float = 0.02
    """Largest Newton step of λ0, over ΩR."""
    hover_tolerance: float = 1e-12
    """Difference of C_T from C_W in hover at which the iteration ends, as a fraction of C_W."""
    accepted_hover: float = 1e-10
    """Difference at which hover counts as converged, as a fraction of C_W."""
    continuation_steps: int = 40
    """Most steps of continuation from an easier condition."""
    most_passes: int = 400
    """Evaluations of the blade elements in one solve, after which continuation gives up."""
    stop: Callable[[], bool] | None = None
    """Asked between two runs of Newton's method; True ends a solve that has not converged."""
    pause: Callable[[], object] | None = None
    """Called before each evaluation of derivatives, which takes longest; it returns after others have computed."""
    smallest_continuation_step: float = 1.0 / 128.0
    """Step, as a part of the whole way, below which continuation gives up."""
    preview: bool = False
    """Whether a hovering rotor with a free wake may end after one Newton step from `start`, with the derivatives kept
    from there; the solution then says that it is not settled."""

    @property
    def asked_to_stop(self) -> bool:
        return self.stop is not None and self.stop()


DEFAULT_OPTIONS = SolverOptions()
