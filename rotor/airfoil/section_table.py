"""Section coefficients at run time: a smooth table over angle of attack and Mach number.

Bicubic Hermite cells on one uniform grid that all sections share. The slopes at the deck's knots are monotone (PCHIP),
and every knot is a node of the grid, so the piecewise cubics keep their shape on it: C1 everywhere, periodic in alpha,
without overshoot, through every deck value, with exact derivatives for Newton's method and the adjoint.

The stall angle is the first angle outward from zero lift at which the lift slope has fallen to a quarter of its
attached value: at high Mach the lift reaches a plateau without a maximum. On curves with a peak this is 0.3 to 1.5 deg
before it.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from rotor.airfoil.c81 import C81Block, C81Deck
from rotor.support.arrays import Array

N_ALPHA = 720
N_MACH = 20
ALPHA_STEP = np.pi / 360.0  # rad, half a degree
MACH_STEP = 0.05

SLOPE_FRACTION = 0.25
DRAG_DIVERGENCE = 0.1
"""∂C_d/∂M that marks drag divergence."""
_LEAST_SLOPE = 0.5
"""[1/rad] of lift about zero lift. A flat plate has 6.3, and transonic data have 2 or more."""
_ZERO_LIFT = np.deg2rad(6.0)
"""Largest step of Newton's method; zero lift itself is searched within twice this angle."""
# From zero lift: 2 deg, where flow is attached, to 30 deg.
SEARCH_OUTWARD = np.deg2rad(np.arange(20, 301) / 10.0)


# Monomial coefficients of a cubic on [0, 1] from (value, value, slope, slope) at its ends.
_HERMITE = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [-3, 3, -2, -1], [2, -2, 1, 1]], dtype=np.float64)


def mach_nodes() -> Array:
    """The grid's Mach numbers, shape (N_MACH + 1,)."""
    return np.arange(N_MACH + 1) / N_MACH


def _nodes_along_alpha(block: C81Block) -> tuple[Array, Array]:
    """Values and alpha-slopes (per cell) at the uniform alpha nodes, shape (N_ALPHA + 1, Machs)."""
    knots, values = block.alpha_deg, block.values
    if (
        abs(knots[0] + 180.0) > 1e-9
        or abs(knots[-1] - 180.0) > 1e-9
        or np.any(np.abs(values[0] - values[-1]) > 1e-9)
    ):
        raise ValueError(
            "the angles must run from -180 to 180 deg with equal ends: add the missing angles"
        )
    if np.any(np.abs(knots * 2.0 - np.round(knots * 2.0)) > 1e-9):
        raise ValueError(
            "an angle is not a multiple of 0.5 deg, the step of the run-time grid: move it to one"
        )
    # Two knots of the next turn on each side make the slopes at +-180 deg periodic.
    longer = np.concatenate((knots[-3:-1] - 360.0, knots, knots[1:3] + 360.0))
    curve = scipy.interpolate.PchipInterpolator(
        longer, np.concatenate((values[-3:-1], values, values[1:3])), axis=0
    )
    nodes = np.arange(N_ALPHA + 1) * 0.5 - 180.0
    slope: Callable[[Array], Array] = curve.derivative()
    return np.asarray(curve(nodes)), np.asarray(slope(nodes)) * 0.5


def _along_mach(mach: Array, values: Array) -> tuple[Array, Array]:
    """Values and Mach-slopes (per cell) at the uniform Mach nodes, shape (rows, N_MACH + 1), constant outside."""
    nodes = mach_nodes()
    inside = np.clip(nodes, mach[0], mach[-1])
    slopes = np.asarray(
        scipy.interpolate.PchipInterpolator(mach, values, axis=1).derivative()(mach)
    )
    # Constant beyond the data, so the slope at its end is zero: C1 across the limit.
    slopes[:, -1] = 0.0
    slopes[:, 0] = 0.0
    curve = scipy.interpolate.CubicHermiteSpline(mach, values, slopes, axis=1)
    slope: Callable[[Array], Array] = curve.derivative()
    flat = (nodes > mach[0]) & (nodes < mach[-1])
    return np.asarray(curve(inside)), np.asarray(slope(inside)) * MACH_STEP * flat


def bicubic_coefficients(block: C81Block) -> Array:
    """Cell polynomials (N_ALPHA, N_MACH, 4, 4) of the C1 surface through the deck values of `block`.

    Raises ValueError when a knot is not on the uniform grid, or when the angles do not cover the full circle.
    """
    steps = block.mach / MACH_STEP
    if np.any(np.abs(steps - np.round(steps)) > 1e-9) or block.mach[-1] > 1.0 + 1e-9:
        raise ValueError(
            "a Mach number is not a multiple of 0.05 within 0..1: move it to the run-time grid"
        )
    f, f_u = _nodes_along_alpha(block)
    f, f_v = _along_mach(block.mach, f)
    f_u, f_uv = _along_mach(block.mach, f_u)
    return _cells(f, f_u, f_v, f_uv)


def _cells(f: Array, f_u: Array, f_v: Array, f_uv: Array) -> Array:
    """Cell polynomials of the surface with these values and slopes per cell at its nodes, (α nodes, Mach nodes, …)."""
    corners = np.empty((N_ALPHA, N_MACH, *f.shape[2:], 4, 4))
    for row, (of_value, of_slope) in enumerate(((f, f_v), (f, f_v), (f_u, f_uv), (f_u, f_uv))):
        # Rows: values at i, at i + 1, slopes at i, at i + 1; columns the same along Mach.
        upper = row % 2
        rows = slice(upper, upper + N_ALPHA)
        corners[..., row, 0], corners[..., row, 1] = of_value[rows, :-1], of_value[rows, 1:]
        corners[..., row, 2], corners[..., row, 3] = of_slope[rows, :-1], of_slope[rows, 1:]
    return np.matmul(np.matmul(_HERMITE, corners), _HERMITE.T)


def _nodes(cells: Array) -> Array:
    """Values and slopes per cell at the nodes of cells (N_ALPHA, N_MACH, …, 4, 4): (α, Mach, …, by α, by Mach)."""
    last = cells[:, -1]  # Its end is where the Mach number is 1.
    at_end = np.stack([last.sum(axis=-1), last @ np.arange(4.0)], axis=-1)
    nodes = np.concatenate([cells[..., :2], at_end[:, None]], axis=1)[..., :2, :]
    return np.concatenate([nodes, nodes[:1]])


def with_nodes(cells: Array, where: NDArray[np.bool_], block: C81Block) -> Array:
    """Cells of one coefficient with the values and slopes of `block` at the nodes `where`, (α nodes, Mach nodes)."""
    f, f_u = _nodes_along_alpha(block)
    (f, f_v), (f_u, f_uv) = _along_mach(block.mach, f), _along_mach(block.mach, f_u)
    own = _nodes(cells)
    pairs = (
        (f, own[..., 0, 0]),
        (f_u, own[..., 1, 0]),
        (f_v, own[..., 0, 1]),
        (f_uv, own[..., 1, 1]),
    )
    return _cells(*(np.where(where, new, old) for new, old in pairs))


def held_beyond_peak(coefficients: Array) -> Array:
    """Lift and drag that keep, beyond the largest lift, what they have there; in the layout of `SectionTable`.

    From 0 outwards on both sides they go on only where lift exceeds all before (below 0: falls below it). So lift never
    falls as the angle grows, and up to its first peak nothing changes.
    """
    nodes = _nodes(coefficients)
    lift, zero = nodes[:, :, 0, 0, 0], N_ALPHA // 2
    place = np.empty(lift.shape, dtype=np.int64)
    place[zero:] = zero + _last_record(lift[zero:])
    place[zero::-1] = zero - _last_record(-lift[zero::-1])
    held = np.take_along_axis(nodes, place[:, :, None, None, None], axis=0)
    at_peak = place == np.arange(N_ALPHA + 1)[:, None]
    # Constant from end to end.
    held[~(at_peak & np.roll(at_peak, 1, axis=0) & np.roll(at_peak, -1, axis=0)), :, 1] = 0.0
    return np.ascontiguousarray(
        _cells(held[..., 0, 0], held[..., 1, 0], held[..., 0, 1], held[..., 1, 1])
    )


def attached_lift(table: "SectionTable") -> Array:
    """Cells of C_lα sin(α − α0), the lift of a plate in potential flow with the slope and zero of a section's own."""
    mach, alpha = mach_nodes(), np.linspace(-180.0, 180.0, N_ALPHA + 1)
    lift = table.lift_slope(mach) * np.sin(np.deg2rad(alpha)[:, None] - table.zero_lift_alpha(mach))
    return bicubic_coefficients(C81Block(mach, alpha, lift))


def _last_record(values: Array) -> NDArray[np.int64]:
    """For every row, the last one up to it that exceeds all before, column by column."""
    best = np.maximum.accumulate(values, axis=0)
    new = np.concatenate([np.full((1, values.shape[1]), True), values[1:] > best[:-1]])
    return np.maximum.accumulate(np.where(new, np.arange(len(values))[:, None], 0), axis=0)


def first_quarter_slope(slope: Array, attached: Array) -> Array:
    """Distance from zero lift [rad] at which `slope` first is SLOPE_FRACTION of `attached`, both [1/rad].

    `slope`, shape (curves, SEARCH_OUTWARD.size), is dcl/dalpha of each curve outward from its zero lift, and
    `attached`, shape (curves,), its attached value. Linear between steps of 0.1 deg; 30 deg where the slope
    stays above that fraction.
    """
    excess = slope - SLOPE_FRACTION * attached[:, None]
    low = excess <= 0.0
    low[:, -1] = True
    after = np.maximum(np.argmax(low, axis=1), 1)
    curve = np.arange(after.size, dtype=np.intp)
    before_value, after_value = excess[curve, after - 1], np.minimum(excess[curve, after], 0.0)
    share = np.where(
        excess[curve, after] > 0.0,
        1.0,
        before_value / np.maximum(before_value - after_value, 1e-12),
    )
    start = SEARCH_OUTWARD[after - 1]
    return start + np.clip(share, 0.0, 1.0) * (SEARCH_OUTWARD[after] - start)


@dataclass(frozen=True, eq=False)
class SectionCoefficients:
    """Lift and drag coefficient and their derivatives [-, 1/rad], each of the shape of the query."""

    cl: Array
    cd: Array
    cl_alpha: Array
    cd_alpha: Array
    cl_mach: Array
    cd_mach: Array


@dataclass(frozen=True, eq=False)
class SectionTable:
    """One section's lift and drag over -pi..pi and Mach 0..1, as bicubic polynomials on a uniform grid.

    `coefficients` has shape (N_ALPHA, N_MACH, 2, 4, 4), C-contiguous: in cell (i, j)
    value[k] = sum_ab c[i, j, k, a, b] u^a v^b with u = (alpha + pi) / ALPHA_STEP - i and
    v = mach / MACH_STEP - j in [0, 1]; k = 0 is cl, k = 1 is cd. Beyond `mach_limit`, the last Mach of
    the data, values are constant. `alpha_stall_positive`, `alpha_stall_negative` [rad], shape (N_MACH + 1,), are
    the stall angles at the grid's Machs, as `rotor.airfoil.section_table` defines them. `fit_range` [rad] is where a
    polynomial section was fitted and None for a deck. `moment_coefficients`, shape (N_ALPHA, N_MACH, 4, 4), is the
    moment about the quarter chord in the same form, None where the source has none. Compares and hashes by identity.
    """

    name: str
    source: str
    mach_limit: float
    coefficients: Array
    alpha_stall_positive: Array
    alpha_stall_negative: Array
    fit_range: tuple[float, float] | None = None
    moment_coefficients: Array | None = None

    def __post_init__(self) -> None:
        assert self.coefficients.shape == (N_ALPHA, N_MACH, 2, 4, 4)
        assert self.coefficients.flags.c_contiguous
        assert self.alpha_stall_positive.shape == self.alpha_stall_negative.shape == (N_MACH + 1,)

    def __call__(self, alpha: ArrayLike, mach: ArrayLike) -> SectionCoefficients:
        """Coefficients at `alpha` [rad, any turn] and `mach` (held outside 0..mach_limit), broadcast together."""
        i, j, u, v, inside = self._cells(alpha, mach)
        cell = self.coefficients[i, j]  # (..., 2, 4, 4)
        us, vs = _powers(u), _powers(v)
        du, dv = _slopes_of_powers(u) / ALPHA_STEP, _slopes_of_powers(v) / MACH_STEP
        along = np.einsum("...kab,...b->...ka", cell, vs)
        value = np.einsum("...ka,...a->...k", along, us)
        by_alpha = np.einsum("...ka,...a->...k", along, du)
        by_mach = np.einsum("...kab,...a,...b->...k", cell, us, dv) * inside[..., None]
        return SectionCoefficients(
            value[..., 0],
            value[..., 1],
            by_alpha[..., 0],
            by_alpha[..., 1],
            by_mach[..., 0],
            by_mach[..., 1],
        )

    def moment(self, alpha: ArrayLike, mach: ArrayLike) -> Array | None:
        """C_m about the quarter chord, nose-up positive, at the same arguments; None where the source has no moment."""
        if self.moment_coefficients is None:
            return None
        i, j, u, v, _ = self._cells(alpha, mach)
        return np.asarray(
            np.einsum(
                "...ab,...a,...b->...", self.moment_coefficients[i, j], _powers(u), _powers(v)
            )
        )

    def _cells(
        self, alpha: ArrayLike, mach: ArrayLike
    ) -> tuple[NDArray[np.intp], NDArray[np.intp], Array, Array, NDArray[np.bool_]]:
        """Cell indices, places within the cell, and whether the Mach number is inside the data."""
        a, m = np.broadcast_arrays(
            np.asarray(alpha, dtype=np.float64), np.asarray(mach, dtype=np.float64)
        )
        turn = np.mod((a + np.pi) / ALPHA_STEP, N_ALPHA)
        i = np.minimum(turn.astype(np.intp), N_ALPHA - 1)
        inside = (m >= 0.0) & (m <= self.mach_limit)
        place = np.clip(m, 0.0, self.mach_limit) / MACH_STEP
        j = np.minimum(place.astype(np.intp), N_MACH - 1)
        return i, j, turn - i, place - j, inside

    def held_at(self, mach: float) -> "SectionTable":
        """The coefficients of one Mach number (0 to below 1) at every Mach number: zero Mach slope, no Mach limit."""
        place = min(mach, self.mach_limit) / MACH_STEP
        j = min(int(place), N_MACH - 1)

        def flat(cells: Array) -> Array:
            out = np.zeros_like(cells)
            out[..., 0] = (cells[:, j] @ (place - j) ** np.arange(4))[:, None]
            return out

        moment = self.moment_coefficients
        negative, positive = (np.full(N_MACH + 1, float(angle)) for angle in self.stall_alpha(mach))
        return replace(
            self,
            coefficients=flat(self.coefficients),
            mach_limit=np.inf,
            alpha_stall_negative=negative,
            alpha_stall_positive=positive,
            moment_coefficients=None if moment is None else flat(moment),
        )

    def stall_alpha(self, mach: ArrayLike) -> tuple[Array, Array]:
        """Stall angles (negative, positive) [rad] at `mach`, linear between the grid's Machs, constant outside."""
        m = np.asarray(mach, dtype=np.float64)
        negative = np.interp(m, mach_nodes(), self.alpha_stall_negative)
        return np.asarray(negative), np.asarray(
            np.interp(m, mach_nodes(), self.alpha_stall_positive)
        )

    def zero_lift_alpha(self, mach: ArrayLike) -> Array:
        """Zero-lift angle of attack [rad] at `mach`, within -12..12 deg: Newton's method from the sampled crossing."""
        m = np.asarray(mach, dtype=np.float64)
        sample = np.deg2rad(np.linspace(-6.0, 6.0, 25))
        # Of a body without lift: no angle.
        nearest = np.abs(self(sample, m[..., None]).cl) + 1e-9 * np.abs(sample)
        alpha = sample[np.argmin(nearest, axis=-1)]
        for _ in range(4):
            here = self(alpha, m)
            # The slope is zero at a peak.
            step = here.cl / np.where(here.cl_alpha > _LEAST_SLOPE, here.cl_alpha, np.inf)
            alpha = np.clip(
                alpha - np.clip(step, -_ZERO_LIFT, _ZERO_LIFT), -2.0 * _ZERO_LIFT, 2.0 * _ZERO_LIFT
            )
        return np.asarray(alpha)

    @property
    def lifts(self) -> bool:
        """Whether the section has lift at any angle; a round shank has none and never stalls."""
        return bool(self.coefficients[:, :, 0].any())

    def lift_slope(self, mach: ArrayLike) -> Array:
        """Mean lift slope [1/rad] within 2 deg of the zero-lift angle, at `mach`."""
        m = np.asarray(mach, dtype=np.float64)
        zero, span = self.zero_lift_alpha(m), np.deg2rad(2.0)
        return np.asarray((self(zero + span, m).cl - self(zero - span, m).cl) / (2.0 * span))

    def drag_divergence_mach(self, alpha: ArrayLike) -> Array:
        """Lowest Mach at drag divergence at `alpha` [rad]; `mach_limit` where that slope is not reached."""
        a = np.asarray(alpha, dtype=np.float64)
        mach = np.arange(0.3, self.mach_limit + 1e-9, 0.002)
        slope = self(a[..., None], mach).cd_mach
        over = slope >= DRAG_DIVERGENCE
        first = np.argmax(over, axis=-1)
        return np.where(over.any(axis=-1), mach[first], self.mach_limit)


def _powers(x: Array) -> Array:
    """1, x, x², x³ along a new last axis."""
    return np.stack((np.ones_like(x), x, x * x, x * x * x), axis=-1)


def _slopes_of_powers(x: Array) -> Array:
    return np.stack((np.zeros_like(x), np.ones_like(x), 2.0 * x, 3.0 * x * x), axis=-1)


def make_table(
    name: str,
    source: str,
    coefficients: Array,
    mach_limit: float,
    fit_range: tuple[float, float] | None = None,
) -> SectionTable:
    """A `SectionTable` with the stall angles found on its own curves at the grid's Machs."""
    unknown = np.zeros(N_MACH + 1)
    bare = SectionTable(name, source, mach_limit, coefficients, unknown, unknown, fit_range)
    mach = mach_nodes()
    if not bare.lifts:
        none = np.full(N_MACH + 1, np.pi)
        return replace(bare, alpha_stall_negative=-none, alpha_stall_positive=none)
    zero, attached = bare.zero_lift_alpha(mach), bare.lift_slope(mach)
    onsets = [
        zero
        + side
        * first_quarter_slope(
            bare(zero[:, None] + side * SEARCH_OUTWARD, mach[:, None]).cl_alpha, attached
        )
        for side in (-1.0, 1.0)
    ]
    return replace(bare, alpha_stall_negative=onsets[0], alpha_stall_positive=onsets[1])


def between(first: SectionTable, second: SectionTable, share: float) -> SectionTable:
    """A table interpolated between two; `share` is the weight of the second."""
    limit = min(first.mach_limit, second.mach_limit)
    coefficients = (1.0 - share) * first.coefficients + share * second.coefficients
    made = make_table(first.name, first.source, coefficients, limit)
    if first.moment_coefficients is None or second.moment_coefficients is None:
        return made
    moment = (1.0 - share) * first.moment_coefficients + share * second.moment_coefficients
    return replace(made, moment_coefficients=moment)


def _check_lift(table: SectionTable) -> None:
    """ValueError with one sentence for lift that does not rise through zero near zero angle of attack."""
    if not table.lifts:
        return
    mach = mach_nodes()[mach_nodes() <= table.mach_limit + 1e-9]
    zero, slope = table.zero_lift_alpha(mach), table.lift_slope(mach)
    lift = table(zero, mach).cl
    bad = ~((slope >= _LEAST_SLOPE) & (np.abs(lift) < 1e-3))
    if bad.any():
        at = int(np.argmax(bad))
        raise ValueError(
            f"{table.name}: at Mach {mach[at]:g} the lift does not rise through zero within ±12 deg "
            f"(cl {lift[at]:.3g}, slope {slope[at]:.3g} per rad at {np.rad2deg(zero[at]):.1f} deg): check it"
        )


def table_from_deck(name: str, source: str, deck: C81Deck) -> SectionTable:
    """The run-time table of `deck`; constant beyond the lower of its two last Machs (lift, drag)."""
    coefficients = np.stack([bicubic_coefficients(block) for block in (deck.cl, deck.cd)], axis=2)
    table = make_table(name, source, coefficients, float(min(deck.cl.mach[-1], deck.cd.mach[-1])))
    _check_lift(table)
    return (
        table
        if deck.cm is None
        else replace(table, moment_coefficients=bicubic_coefficients(deck.cm))
    )
