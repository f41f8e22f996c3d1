"""The dynamic wake's matrices, and with them the exact linear actuator disk."""

import math

import numpy as np
import pytest
from inflow_tables import table
from numpy.testing import assert_allclose

from rotor.aero.inflow.dynamic_wake import DynamicWake
from rotor.aero.inflow.interface import Wake
from rotor.aero.inflow.peters_he import (
    Family,
    families,
    flow_parameters,
    gain,
    highest_modes,
    radial_function,
    radial_functions,
)
from rotor.engine.waves import waves_at


def entry(matrix: np.ndarray, family: Family, r: int, j: int, m: int, n: int) -> float:
    return matrix[family.modes.index((r, j)), family.modes.index((m, n))]


def amplitudes(order: int, wake: Wake, d: np.ndarray, radii: np.ndarray) -> np.ndarray:
    """Cosine and sine amplitudes of λ_i at `radii`, (2, waves, radii), for d, (elements, azimuths)."""
    theory, azimuths = DynamicWake(order=order, harmonics=0).on(0.0, len(d)), d.shape[1]
    own = theory.projection
    around = waves_at(2 * order + 1, 2.0 * np.pi * np.arange(azimuths) / azimuths)[own.waves]
    means = (own.radial[own.order] @ d * around).sum(axis=1) * own.dr / azimuths
    out, g = np.zeros((2, own.wave.max() + 1, len(radii))), radial_functions(highest_modes(order), radii)
    for k, p, sine, x in zip(own.order, own.wave, own.parity, theory.answer(means, wake), strict=True):
        out[sine, p] += x * g[k]
    return out


def cosines(order: int, wake: Wake, load: np.ndarray, radii: np.ndarray, count: int) -> np.ndarray:
    """The first cosine amplitudes for an axisymmetric d(r), (count, radii)."""
    return amplitudes(order, wake, np.repeat(load[:, None], 2 * order + 4, axis=1), radii)[0, :count]


MIDPOINTS = (np.arange(2000) + 0.5) / 2000
ELLIPTIC = 3.0 * MIDPOINTS * np.sqrt(1.0 - MIDPOINTS**2)
"""d of Mangler–Squire type I, C_T = 1."""
HUB_ZERO = 7.5 * MIDPOINTS**3 * np.sqrt(1.0 - MIDPOINTS**2)
"""d of type III, C_T = 1."""


def wake_at(chi_deg: float) -> Wake:
    """Unit speed at a skew angle, light loading (λ0 → 0, where V̄ = V_T)."""
    return Wake(math.sin(math.radians(chi_deg)), math.cos(math.radians(chi_deg)), 0.0)


def test_influence_matches_the_table():
    cosines, sines = families(4)
    for row in table("gdw_L"):
        place = int(row["r"]), int(row["j"]), int(row["m"]), int(row["n"])
        # The table has eight decimals.
        assert_allclose(gain(*place), float(row["Gamma"]), rtol=0, atol=1e-8)
        for skew in ("0.3", "0.8"):
            for family, kind in ((cosines, "Lc"), (sines, "Ls")):
                if row[f"{kind}_X{skew}"]:
                    value, _ = family.influence(float(skew))
                    assert_allclose(entry(value, family, *place), float(row[f"{kind}_X{skew}"]), rtol=0, atol=1e-8)


def test_reverse_flow_theorem():
    """D L(X) = [D L(−X)]ᵀ with D = 2 for m = 0: a flow and its reverse do the same work on each other's loads."""
    for family in families(12):
        weight = np.array([2.0 if m == 0 else 1.0 for m, _ in family.modes])[:, None]
        for skew in (0.2, 0.7, 1.0):
            forward, _ = family.influence(skew)
            backward, _ = family.influence(-skew)
            assert_allclose(weight * forward, (weight * backward).T, rtol=0, atol=1e-12)  # Entries up to 10.


def test_influence_slope():
    for family in families(8):
        for skew in (0.0, 0.4, 0.95):
            _, slope = family.influence(skew)
            step = 1e-6  # Central difference: error 1e-12 × third derivative (up to 16³), rounding 1e-10.
            above, below = family.influence(skew + step)[0], family.influence(skew - step)[0]
            assert_allclose(slope, (above - below) / (2.0 * step), rtol=0, atol=1e-8)


@pytest.mark.parametrize("wake", [(0.0, 0.0, 0.06), (0.2, 0.02, 0.017), (0.35, -0.01, 0.02)])
def test_flow_parameter_slopes(wake: tuple[float, float, float]):
    slopes = flow_parameters(Wake(*wake)).slopes
    for k in range(3):
        step = np.zeros(3)
        step[k] = 1e-6
        ahead, behind = (flow_parameters(Wake(*(np.array(wake) + s * step))) for s in (1, -1))
        for row, name in enumerate(("half_skew", "speed", "mass_flow")):
            difference = (getattr(ahead, name) - getattr(behind, name)) / 2e-6
            assert_allclose(slopes[row, k], difference, rtol=1e-6, atol=1e-6)  # Central difference of slopes up to 20.


def test_flow_parameters_in_hover():
    flow = flow_parameters(Wake(0.0, 0.0, 0.05))
    assert_allclose([flow.half_skew, flow.speed, flow.mass_flow], [0.0, 0.05, 0.1], rtol=1e-15)


@pytest.mark.parametrize(("kind", "load"), [("1", ELLIPTIC), ("3", HUB_ZERO)])
def test_closed_forms_of_the_actuator_disk(kind: str, load: np.ndarray):
    """Mangler & Squire's two loads; harmonics 1 and 3 are polynomials, which the modes hold exactly."""
    rows = [row for row in table("actuator_disc_mangler") if row["type"] == kind]
    assert rows
    for chi in {row["chi_deg"] for row in rows}:
        at = [row for row in rows if row["chi_deg"] == chi]
        radii = np.array([float(row["r"]) for row in at])
        found = cosines(16, wake_at(float(chi)), load, radii, 5)
        expected = np.array([[float(row[f"w{k}"]) for row in at] for k in range(5)])
        assert_allclose(found, expected, rtol=0, atol=2e-3)  # Truncation at S = 16, as measured by the reference.
        assert_allclose(found[1::2], expected[1::2], rtol=0, atol=2e-5)  # Midpoint sum of d at its √ end.


def test_one_state_in_axial_flow_gives_nine_sixteenths():
    """A truncation: the uniform mode alone answers 9/16 C_T/V to any load, momentum theory ½."""
    flow, family = flow_parameters(wake_at(0.0)), families(1)[0]
    influence, _ = family.influence(flow.half_skew)
    phi = radial_function(0, 1, 0.5)
    assert_allclose(phi * 0.5 * influence[0, 0] * 0.5 * phi, 9.0 / 16.0, rtol=1e-15)


@pytest.mark.parametrize("load", [ELLIPTIC, HUB_ZERO])
def test_mean_inflow_in_axial_flow_tends_to_momentum_theory(load: np.ndarray):
    mean = [float((2.0 * MIDPOINTS * cosines(order, wake_at(0.0), load, MIDPOINTS, 1)[0]).mean()) for order in (4, 16)]
    assert_allclose(mean[0], 0.5, rtol=0, atol=0.021)  # Truncation, 0.502 … 0.520 as the reference measured.
    assert_allclose(mean[1], 0.5, rtol=0, atol=0.0036)


def test_pitt_peters_gains():
    """Three states give k_x = 3π/4 X on C_T/2V for the elliptic load; the hub-zero load projects to 15π/32 X."""
    wake = wake_at(60.0)
    skew = math.tan(math.radians(30.0))
    at_tip = np.array([1.0])
    three = cosines(1, wake, ELLIPTIC, at_tip, 2)[1, 0]
    assert_allclose(three / 0.5, 0.75 * math.pi * skew, rtol=1e-5)  # Midpoint sum of d.
    first = cosines(8, wake, HUB_ZERO, MIDPOINTS, 2)[1]
    projected = 4.0 * (first * MIDPOINTS**2).mean()
    assert_allclose(projected / 0.5, 15.0 * math.pi / 32.0 * skew, rtol=5e-5)  # Midpoint sums.


@pytest.mark.parametrize(("m", "sine"), [(1, False), (2, False), (3, False), (1, True), (2, True), (3, True)])
@pytest.mark.parametrize("chi_deg", [pytest.param(45.0, marks=pytest.mark.slow), 75.0])
def test_independent_of_the_fourier_operator_of_the_actuator_disk(m: int, sine: bool, chi_deg: float):
    """The linear disk in the plane of its Fourier transform: ŵ = p̂/[2V (cos χ + i sin χ cos θ_k)].

    Shares nothing with the modes but the linearised equations. Load p = r^m (1 − r²)^(3/2) trig mψ, d = 2 r p.
    """
    box, count = 24.0, 768
    x = (np.arange(count) - count // 2) * box / count
    aft, side = np.meshgrid(x, x, indexing="ij")
    r, psi = np.hypot(aft, side), np.arctan2(side, aft)
    trig = np.sin if sine else np.cos
    pressure = np.where(r < 1.0, r**m * np.clip(1.0 - r**2, 0.0, None) ** 1.5, 0.0) * trig(m * psi)
    wave = 2.0 * np.pi * np.fft.fftfreq(count, box / count)
    along, across = np.meshgrid(wave, wave, indexing="ij")
    size = np.hypot(along, across)
    size[0, 0] = 1.0
    chi = math.radians(chi_deg)
    w = np.fft.ifft2(np.fft.fft2(pressure) / (2.0 * (math.cos(chi) + 1j * math.sin(chi) * along / size))).real

    order, azimuths, elements = 16, 48, 400
    mid = (np.arange(elements) + 0.5) / elements
    angle = 2.0 * np.pi * np.arange(azimuths) / azimuths
    d = 2.0 * mid[:, None] ** (m + 1) * (1.0 - mid[:, None] ** 2) ** 1.5 * trig(m * angle)
    inside = r < 0.95
    even, odd = amplitudes(order, wake_at(chi_deg), d, r[inside])
    turns = np.outer(np.arange(len(even)), psi[inside])
    found = (even * np.cos(turns) + odd * np.sin(turns)).sum(axis=0)
    # Truncation at S = 16 and the box's periodic images; w reaches 0.05 … 0.3.
    assert_allclose(found, w[inside], rtol=0, atol=1.2e-3)
