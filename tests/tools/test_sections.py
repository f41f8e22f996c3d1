"""The tool that makes the bundled section data: decks rebuilt from raw polars; runs of XFOIL, and its failures."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.airfoil.c81 import C81Block, C81Deck, read_c81
from rotor.airfoil.contour import load_contour
from rotor.airfoil.polars import PolarSet, read_polars
from rotor.support.assets import asset_path
from tests.tools.sections.recipes import NATIVE_MACHS, RECIPES, TRIP, compare_decks, make_deck
from tests.tools.sections.xfoil import XfoilCase, XfoilError, require_xfoil, run_polar

CASE = XfoilCase(mach=0.3, reynolds=3.681e6, n_crit=9.0, trip=0.05)
FEW = np.arange(-2.0, 5.0)


@pytest.fixture
def real_xfoil() -> None:
    """Skips the test where XFOIL is not installed."""
    try:
        require_xfoil()
    except XfoilError as missing:
        pytest.skip(str(missing))


@pytest.mark.parametrize("name", RECIPES)
def test_deck_rebuilt_from_the_raw_polars_is_the_shipped_deck(name: str) -> None:
    """Its polars are at the Reynolds numbers of its rotor and cover the attached range."""
    recipe = RECIPES[name]
    polars = read_polars(asset_path(f"airfoils/{name}_{recipe.polars}.polars.csv"))
    shipped = read_c81(asset_path(f"airfoils/{name}.c81"))
    rebuilt = make_deck(name, polars)
    found = compare_decks(rebuilt, shipped)
    assert found.cl < 1.1e-4, found  # a unit in the last printed decimal, for other arithmetic
    assert found.cd < 0.003, found
    assert_allclose(rebuilt.blocks[2].values, shipped.blocks[2].values, rtol=0, atol=1.1e-4)
    assert tuple(p.mach for p in polars.polars) == (
        NATIVE_MACHS if recipe.polars == "trip5" else recipe.machs
    )
    for p in polars.polars:
        assert_allclose(p.reynolds or 0.0, recipe.reynolds_per_mach * p.mach, rtol=1e-3)
        assert p.alpha_deg[0] <= max(-8.0, recipe.lowest_alpha_deg)
        assert p.alpha_deg[-1] >= 10.0
        if name in ("sc1095", "sc1094r8", "naca0012", "naca63a015"):
            assert np.count_nonzero((p.alpha_deg >= -5.0) & (p.alpha_deg <= 15.0)) == 41, (
                f"{name} Mach {p.mach}"
            )


@pytest.mark.xfoil
def test_one_real_polar_is_close_to_thin_airfoil_theory(real_xfoil: None) -> None:
    """cl slope of a thin section: 2 pi / beta, plus some 10 % for thickness, less the boundary layer."""
    polar = run_polar(load_contour("sc1095"), CASE, FEW)
    slope = np.polyfit(np.deg2rad(polar.alpha_deg), polar.cl, 1)[0]
    assert_allclose(slope, 2.0 * np.pi / np.sqrt(1.0 - 0.3**2), rtol=0.1)
    assert polar.alpha_deg.size >= 6


def test_verify_detects_a_change() -> None:
    shipped = read_c81(asset_path("airfoils/sc1095.c81"))
    values = shipped.cl.values.copy()
    values[shipped.cl.alpha_deg == 5.0, 4] += 0.02
    changed = C81Deck(
        shipped.title,
        C81Block(shipped.cl.mach, shipped.cl.alpha_deg, values),
        shipped.cd,
        shipped.cm,
    )
    found = compare_decks(changed, shipped)
    assert found.cl == pytest.approx(0.02)
    assert found.cl_at == "5 deg, Mach 0.4"
    with pytest.raises(ValueError, match=r"lack Mach 0\.1"):
        make_deck("sc1095", PolarSet((), ()))


@pytest.mark.slow
@pytest.mark.xfoil
@pytest.mark.parametrize(
    "name", [name for name, recipe in RECIPES.items() if recipe.polars == "trip5"]
)
def test_xfoil_reproduces_the_polars(name: str, real_xfoil: None) -> None:
    """Attached flow only: near stall the angles that converge depend on the time a sweep is given."""
    for shipped in read_polars(asset_path(f"airfoils/{name}_trip5.polars.csv")).polars:
        alpha = np.arange(-4.0, 8.25, 0.5)
        found = run_polar(
            load_contour(name), XfoilCase(shipped.mach, shipped.reynolds or 0.0, 9.0, TRIP), alpha
        )
        both, mine, theirs = np.intersect1d(found.alpha_deg, shipped.alpha_deg, return_indices=True)
        assert both.size >= alpha.size - 2
        assert_allclose(found.cl[mine], shipped.cl[theirs], atol=0.01)
        assert_allclose(found.cd[mine], shipped.cd[theirs], rtol=0.03)
        assert_allclose(found.cm[mine], shipped.cm[theirs], atol=0.003)
