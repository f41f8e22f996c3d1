"""Laminates and thin-walled sections: closed forms, limits, an independent worked example."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.actuator.catalogue import actuators_of_kind
from rotor.actuator.ply import PiezoPly, active_section
from rotor.actuator.section import (
    HostBlade,
    Placement,
    SectionSpec,
    default_placement,
    panels,
    passive_wall,
    section_spec,
)
from rotor.dynamics.structure import uh60a_structure
from rotor.dynamics.thin_wall import (
    Layer,
    Material,
    WallPanel,
    WallSection,
    build_section,
    free_strain_in_wall_axes,
    induced_twist_rate,
    reduced_stiffness,
    respond,
    rotated_stiffness,
    torsional_stiffness,
    wall_of,
)

METAL = Material("metal", 70e9, 70e9, 0.3, 70e9 / 2.6, 2700.0)
DIAGONAL = math.pi / 4.0


def blocked_shear_flow(layer: Layer) -> float:
    """Shear flow of a blocked sheet [N/m]; at 45° ½t[(Q11 − Q12)Λ1 − (Q22 − Q12)Λ2], zero for an isotropic one."""
    blocked = rotated_stiffness(layer.material, layer.angle) @ free_strain_in_wall_axes(layer)
    return layer.thickness * float(blocked[2])


def actuation_moment(section: WallSection) -> float:
    """M_a = GJ θ'_a: the end moment that twists the passive section by the same rate [N m]."""
    return torsional_stiffness(section) * induced_twist_rate(section)


def axial_stiffness(section: WallSection) -> float:
    """EA [N], bendings and twist free: of a force at the tension centre, where ε_x is the least over all points."""
    base = respond(section, force=1.0)
    by_y, by_z = respond(section, moments=(1.0, 0.0)), respond(section, moments=(0.0, 1.0))
    compliance = np.array(
        [[e.extension, e.curvature_y, e.curvature_z] for e in (base, by_y, by_z)]
    ).T
    return float(
        1.0
        / (
            compliance[0, 0]
            - compliance[0, 1:] @ np.linalg.solve(compliance[1:, 1:], compliance[1:, 0])
        )
    )


def ply(id: str) -> PiezoPly:
    return actuators_of_kind(PiezoPly)[id]


# Laminate


def test_rotated_stiffness_agrees_with_the_textbook():
    """Q̄16, Q̄26, Q̄66 written out (Jones, eq. 2.85), at an angle of no symmetry."""
    q, angle = reduced_stiffness(ply("MFC_P1").material), 0.4
    (q11, q12, _), (_, q22, _), (_, _, q66) = q
    c, s = math.cos(angle), math.sin(angle)
    bar = rotated_stiffness(ply("MFC_P1").material, angle)
    assert_allclose(
        bar[0, 2], (q11 - q12 - 2 * q66) * s * c**3 + (q12 - q22 + 2 * q66) * s**3 * c, rtol=1e-12
    )
    assert_allclose(
        bar[1, 2], (q11 - q12 - 2 * q66) * s**3 * c + (q12 - q22 + 2 * q66) * s * c**3, rtol=1e-12
    )
    assert_allclose(
        bar[2, 2], (q11 + q22 - 2 * q12 - 2 * q66) * s**2 * c**2 + q66 * (s**4 + c**4), rtol=1e-12
    )


@pytest.mark.parametrize(
    ("id", "expected"),
    [("MFC_P1", 8.5e3), ("MFC_P2", -1.3e3), ("AFC", 1.2e3), ("PZT5H_strips", -1.3e3)],
)
def test_blocked_shear_flow_of_one_ply(id: str, expected: float):
    """½t[(Q11 − Q12)Λ1 − (Q22 − Q12)Λ2] at 45°, and the independently tabulated values [N/m]."""
    sheet = ply(id)
    q = reduced_stiffness(sheet.material)
    along, across = sheet.swing
    by_hand = 0.5 * sheet.thickness * ((q[0, 0] - q[0, 1]) * along - (q[1, 1] - q[0, 1]) * across)
    flow = blocked_shear_flow(sheet.layer(1, DIAGONAL))
    assert_allclose(flow, by_hand, rtol=1e-12)
    assert_allclose(flow, expected, rtol=0.05)
    assert_allclose(blocked_shear_flow(sheet.layer(1, -DIAGONAL)), -flow, rtol=1e-12)


def test_a_free_wall_has_its_free_strain():
    """A free wall of one layer has the free strain of the layer: stiffness · strain = actuation."""
    layer = ply("MFC_P1").layer(2, 0.6)
    wall = wall_of((layer,))
    free = free_strain_in_wall_axes(layer)
    assert_allclose(wall.stiffness @ free[[0, 2]], wall.actuation, rtol=1e-12)


# Thin-walled sections


def ring(panel_points: np.ndarray, layers: tuple[Layer, ...]) -> WallSection:
    return build_section(
        (WallPanel(np.concatenate([panel_points, panel_points[:1]]), layers, (1,)),)
    )


def rectangle(width: float, height: float) -> np.ndarray:
    corners = np.array([[width, height], [0.0, height], [0.0, 0.0], [width, 0.0]])
    return np.concatenate(
        [
            a + np.linspace(0, 1, 41)[:-1, None] * (b - a)
            for a, b in zip(corners, np.roll(corners, -1, 0), strict=True)
        ]
    )


def test_bredt_one_cell():
    """GJ = 4A²/∮ds/(Gt), EA = E t s, θ'_a = ∮γ0 ds/2A for pure shear γ0 in the wall (worked by hand)."""
    width, height, t, strain = 0.3, 0.05, 0.002, 5e-4
    section = ring(rectangle(width, height), (Layer(METAL, t, DIAGONAL, (strain, -strain)),))
    area, perimeter = width * height, 2.0 * (width + height)
    assert_allclose(
        torsional_stiffness(section), 4 * area**2 * METAL.g12 * t / perimeter, rtol=1e-9
    )
    assert_allclose(axial_stiffness(section), METAL.e1 * t * perimeter, rtol=1e-9)
    assert_allclose(induced_twist_rate(section), 2 * strain * perimeter / (2 * area), rtol=1e-9)


def test_batho_two_cells_by_hand():
    """0.2 and 0.1 m by 0.05 m, 2 mm walls: δ1 = 250, δ2 = 150, δ12 = 25; 2A1 = 0.02 m², 2A2 = 0.01 m²."""
    t, first, second, height = 0.002, 0.2, 0.1, 0.05
    d1, d2, d12 = 2 * (first + height) / t, 2 * (second + height) / t, height / t
    a1, a2 = 2 * first * height, 2 * second * height
    q = np.linalg.solve([[d1, -d12], [-d12, d2]], [a1, a2])
    layer, whole = (Layer(METAL, t, 0.0),), first + second
    section = build_section(
        (
            WallPanel(
                np.array([(first, height), (0.0, height), (0.0, 0.0), (first, 0.0)]), layer, (1,)
            ),
            WallPanel(
                np.array([(first, 0.0), (whole, 0.0), (whole, height), (first, height)]),
                layer,
                (2,),
            ),
            WallPanel(np.array([(first, 0.0), (first, height)]), layer, (1, -2)),
        )
    )
    assert_allclose(torsional_stiffness(section), METAL.g12 * (a1 * q[0] + a2 * q[1]), rtol=1e-9)


def test_reciprocity():
    """Maxwell: the extension due to a torque equals the twist due to a force."""
    section = active_section(
        section_spec(uh60a_structure(), HostBlade()), ply("MFC_P1"), default_placement(4)
    )
    by_torque, by_force = respond(section, torque=1.0), respond(section, force=1.0)
    assert_allclose(by_torque.extension, by_force.twist_rate, rtol=1e-6)
    assert_allclose(
        by_torque.curvature_y, respond(section, moments=(1.0, 0.0)).twist_rate, rtol=1e-6
    )


# Blade sections


def blade(kind: str, share: float) -> SectionSpec:
    return section_spec(
        uh60a_structure(), HostBlade("retrofit" if kind == "retrofit" else "new", share)
    )


def test_contour_and_calibration():
    """Enclosed area and perimeter from the ordinates (0.01841 m², 1.076 m); GJ 69.76 kN·m²; a titanium wall of 2 mm."""
    spec = blade("retrofit", 1.0)
    section = build_section(panels(spec, passive_wall(spec), None, None))
    assert_allclose(section.areas.sum(), 0.01841, rtol=0.005)
    assert_allclose(section.areas[0], 0.00939, rtol=0.005)
    assert_allclose(torsional_stiffness(section), 69760.0, rtol=1e-5)
    assert_allclose(axial_stiffness(section), 1.33e8, rtol=0.15)


WHOLE = (0.05, 0.80)
# Kind, GJ share, sheet, plies, chord, then GJ [N m²] and M_a [N m] of an independent laminate model of the same blade.
WORKED = [
    ("retrofit", 1.0, "MFC_P1", 1, WHOLE, 72357.0, 214.05),
    ("retrofit", 1.0, "MFC_P1", 4, WHOLE, 78827.4, 721.97),
    ("retrofit", 1.0, "MFC_P2", 1, WHOLE, 72357.0, -31.49),
    ("retrofit", 1.0, "PZT5H_strips", 1, WHOLE, 74883.9, -32.34),
    ("retrofit", 1.0, "AFC", 1, WHOLE, 70847.6, 32.76),
    # An isotropic sheet induces no shear at any angle.
    (
        "retrofit",
        1.0,
        "PZT5H",
        1,
        WHOLE,
        74883.9,
        0.0,
    ),
    ("new", 1.0, "MFC_P1", 4, WHOLE, 69760.0, 973.11),
    ("new", 0.5, "MFC_P1", 4, WHOLE, 34880.0, 904.96),
    ("new", 0.25, "MFC_P1", 2, WHOLE, 17440.0, 454.01),
    ("new", 0.5, "MFC_P1", 2, (0.05, 0.45), 34880.0, 239.34),
    ("new", 0.5, "MFC_P1", 2, (0.40, 0.80), 34880.0, 240.83),
]


@pytest.mark.parametrize(("kind", "share", "id", "plies", "chord", "stiffness", "moment"), WORKED)
def test_worked_example(
    kind: str,
    share: float,
    id: str,
    plies: int,
    chord: tuple[float, float],
    stiffness: float,
    moment: float,
):
    """Indicative, 5 %: an independent code with its own assumptions for the passive walls."""
    section = active_section(blade(kind, share), ply(id), Placement(chord=chord, plies=plies))
    assert_allclose(torsional_stiffness(section), stiffness, rtol=0.01)
    assert_allclose(actuation_moment(section), moment, rtol=0.05, atol=1e-6)
    assert_allclose(induced_twist_rate(section), moment / stiffness, rtol=0.05, atol=1e-9)


def test_twist_is_nearly_proportional_to_sin_2phi():
    """45° twists most; 20° and 70° clearly less; mirrored angles twist the other way."""

    def moment(angle: float) -> float:
        return actuation_moment(
            active_section(blade("retrofit", 1.0), ply("MFC_P1"), Placement(angle=angle))
        )

    best = moment(DIAGONAL)
    assert 0.4 * best < moment(math.radians(20.0)) < 0.9 * best
    assert 0.4 * best < moment(math.radians(70.0)) < 0.9 * best
    assert_allclose(moment(-DIAGONAL), -best, rtol=1e-9)


def test_plies_stiffer_than_the_blade_are_refused():
    with pytest.raises(ValueError, match="plies are stiffer"):
        active_section(blade("new", 0.1), ply("MFC_P1"), Placement(chord=(0.0, 0.8), plies=12))
