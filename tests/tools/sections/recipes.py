"""How each bundled section is made: coordinates and raw XFOIL polars to the shipped C81 deck, and the check of it.

Polars (trip at 5 % chord, Reynolds number of the section's own chord) at Mach 0.1 to 0.4; then `rotor.airfoil.decks`.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from rotor.airfoil.c81 import C81Deck
from rotor.airfoil.contour import load_contour
from rotor.airfoil.decks import BLEND_END_DEG, SectionTraits, assemble_deck
from rotor.airfoil.polars import PolarSet
from rotor.support.arrays import Array
from rotor.support.user_input import did_you_mean
from tests.tools.sections.tunnel import MeasuredSlope, TunnelTraits
from tests.tools.sections.xfoil import XfoilCase, XfoilError, run_polar

TRIP = 0.05  # Transition at 5 % chord, both sides: free transition gives 16-35 % too little drag.
NATIVE_MACHS = (0.1, 0.2, 0.3, 0.4)
POLAR_ALPHA_DEG = np.arange(-36, 37, dtype=np.float64) * 0.5
THESIS_CASE = XfoilCase(mach=0.3, reynolds=3.68e6, n_crit=9.0, trip=None)
THESIS_ALPHA_DEG = np.arange(-60, 81, dtype=np.float64) * 0.25  # -15..20 deg


@dataclass(frozen=True)
class Recipe:
    """How a bundled section is made: title of its deck, Reynolds number per Mach at sea level, and its traits."""

    title: str
    reynolds_per_mach: float
    traits: SectionTraits | TunnelTraits | MeasuredSlope
    machs: tuple[float, ...] = NATIVE_MACHS
    """Mach numbers of its polars."""
    polars: Literal["trip5", "measured"] = "trip5"
    """Computed by XFOIL with a trip at 5 % chord, or measured; part of the name of the file."""
    lowest_alpha_deg: float = float(POLAR_ALPHA_DEG[0])
    """Angle at which the computed polars begin [deg]."""
    lowest_reason: str = ""
    """Why they begin later than the others, for the head of the file."""


def _textbook(thickness: float) -> SectionTraits:
    """Cap and Korn's factor read off the public NACA 0012 C81 table (CITATION.md); the factor is also the textbook's
    for six-series sections (Mason 1990)."""
    return SectionTraits(thickness=thickness, cap_ratio=0.90, korn=0.87)


def _naca23012(reynolds_per_mach: float) -> TunnelTraits:
    """Least squares on the section table of the HART II test, −4 to 12 deg, Mach 0.2 to 0.8, at the model's Reynolds
    number; largest lift 1.39, 1.25 at Mach 0.4, 0.5 and moment at no lift (−0.0075, XFOIL −0.003) of the same table."""
    return TunnelTraits(
        onset=0.856, centre_deg=-0.82, zero_lift_shift_deg=-0.24, cap_ratio=1.09, negative_cap=1.2,
        reynolds_per_mach=reynolds_per_mach, drag_level=0.876, moment_shift=-0.0045,
    )  # fmt: skip


RECIPES = {
    # Onset and centre: as in `tunnel`. Zero lift −0.65 deg: midway between XFOIL (−0.72) and the polar of NASA TM-86719
    # (−0.58). Negative cap: XFOIL's own, 0.9 at Mach 0.3.
    "sc1095": Recipe(
        "SC1095 XFOIL TUNNEL LEVEL WRAP",
        12.27e6,
        TunnelTraits(
            onset=0.849,
            centre_deg=-0.23,
            zero_lift_shift_deg=0.07,
            cap_ratio=1.0,
            negative_cap=0.9,
            reynolds_per_mach=12.27e6,
        ),
    ),
    # The R8 deck of the same flight simulation is the only public table. Onset and centre: its drag divergence at 0, 2
    # and 4 deg. Zero lift −1.48 deg: midway between XFOIL (−1.60) and the deck (−1.37, mean to Mach 0.5). Cap: the
    # deck's largest lift over that of SC1095, 1.50/1.25 at Mach 0.3, 1.32/1.17 at Mach 0.4, not all of it. Negative
    # cap: the deck.
    "sc1094r8": Recipe(
        "SC1094R8 XFOIL TUNNEL LEVEL",
        12.27e6,
        TunnelTraits(
            onset=0.809,
            centre_deg=0.4,
            zero_lift_shift_deg=0.12,
            cap_ratio=1.10,
            negative_cap=0.62,
            reynolds_per_mach=12.27e6,
        ),
    ),
    # The S-61's chord, 0.464 m.
    "naca0012": Recipe(
        "NACA0012 XFOIL TUNNEL SLOPE", 10.80e6, MeasuredSlope(_textbook(0.12), 10.80e6)
    ),
    # The R22's chord, 0.189 m. No public table with Mach was found.
    "naca63a015": Recipe(
        "NACA63A015 XFOIL TUNNEL SLOPE", 4.40e6, MeasuredSlope(_textbook(0.15), 4.40e6)
    ),
    # The XV-15's chord, 0.356 m, root to tip; no table was read off.
    "naca64208": Recipe("NACA64-208 XFOIL TRIP5 WRAP", 8.28e6, _textbook(0.08)),
    "naca64118": Recipe("NACA64-118 XFOIL TRIP5 WRAP", 8.28e6, _textbook(0.18)),
    "naca64528": Recipe("NACA64-528 XFOIL TRIP5 WRAP", 8.28e6, _textbook(0.28)),
    "naca64935": Recipe(
        "NACA64-935 XFOIL TRIP5 WRAP",
        8.28e6,
        _textbook(0.35),
        lowest_alpha_deg=-4.0,
        lowest_reason="the lower side separates and lift rises again",
    ),
    # The PCA-2's outer chord, 0.559 m; its tip stays below Mach 0.5.
    "goe429": Recipe("GOETTINGEN 429 XFOIL TRIP5", 13.0e6, _textbook(0.114)),
    # The SA349/2's chord, 0.35 m. Level, onset, centre and zero lift: least squares on the table of NASA TM-88370, -2
    # to 10 deg, Mach 0.3 to 0.85. Largest lift of the same table: 1.28, 1.20, 1.11 at Mach 0.3, 0.4, 0.5. It has no
    # moment.
    "oa209": Recipe(
        "OA209 XFOIL TM88370 LEVEL",
        8.15e6,
        TunnelTraits(
            onset=0.889,
            centre_deg=0.10,
            zero_lift_shift_deg=1.09,
            cap_ratio=0.95,
            negative_cap=1.15,
            reynolds_per_mach=8.15e6,
            drag_level=0.903,
        ),
    ),
    # The chords of the Bo 105, 0.27 m, and of its model, 0.121 m.
    "naca23012tab": Recipe("NACA23012 TAB HART2 TABLE", 6.29e6, _naca23012(6.29e6)),
    "naca23012tab-model": Recipe("NACA23012 TAB MODEL HART2", 2.82e6, _naca23012(2.82e6)),
    # Knight and Hefner's model rotor, whose polar they measured at the Reynolds number of its tip.
    "naca0015re242k": Recipe(
        "NACA0015 RE 242000 MEASURED", 1.21e6, _textbook(0.15), (0.2,), "measured"
    ),
}


@dataclass(frozen=True)
class DeckDifference:
    """Largest differences between two decks over |alpha| <= 26 deg: cl [-], cd relative [-], and where."""

    cl: float
    cl_at: str
    cd: float
    cd_at: str


def recipe_of(name: str) -> Recipe:
    """ValueError unless `name` is a section this project can build."""
    if name not in RECIPES:
        hint = did_you_mean(name, RECIPES) or ":"
        raise ValueError(f"no section named {name!r}{hint} choose one of {', '.join(RECIPES)}")
    return RECIPES[name]


def run_trip_polars(name: str, report: Callable[[str], None]) -> PolarSet:
    """Run XFOIL for the deck of `name` at every angle of its recipe; takes up to minutes."""
    recipe = recipe_of(name)
    if recipe.polars == "measured":
        raise XfoilError(f"the polar of {name} was measured: add --from-polars")
    contour = load_contour(name)
    per_mach, lowest = recipe.reynolds_per_mach, recipe.lowest_alpha_deg
    below = (
        f", and those below {lowest:g} deg, where {recipe.lowest_reason}"
        if recipe.lowest_reason
        else ""
    )
    header = (
        f"{name}: polars computed with XFOIL 6.99 by this project from the coordinates in {name}.contour",
        f"transition fixed at {TRIP:g} chord on both sides, Ncrit 9, Re = {per_mach:.4g} * Mach",
        f"angles where no paneling converged are left out{below}",
    )
    angles = POLAR_ALPHA_DEG[lowest <= POLAR_ALPHA_DEG]
    cases = (XfoilCase(mach, per_mach * mach, 9.0, TRIP) for mach in NATIVE_MACHS)
    return PolarSet(header, tuple(run_polar(contour, case, angles, report) for case in cases))


def run_thesis_polar(report: Callable[[str], None]) -> PolarSet:
    """Run XFOIL for the SC1095 polar of the `thesis` preset: free transition, one Mach, steps of 0.25 deg."""
    header = (
        "sc1095: polar computed with XFOIL 6.99 by this project from the coordinates in sc1095.contour",
        "free transition, Ncrit 9, Re 3.68e6, Mach 0.3: assumed, the document states none of them",
        "angles where no paneling converged are left out",
    )
    return PolarSet(
        header, (run_polar(load_contour("sc1095"), THESIS_CASE, THESIS_ALPHA_DEG, report),)
    )


def make_deck(name: str, polars: PolarSet) -> C81Deck:
    """The deck of `name` from its raw polars, rounded as the C81 text rounds it."""
    recipe = recipe_of(name)
    by_mach = {round(p.mach, 3): p for p in polars.polars}
    missing = [m for m in recipe.machs if m not in by_mach]
    if missing:
        raise ValueError(
            f"the polars of {name} lack Mach {missing[0]:g}: run `python -m tests.tools.sections build {name}`"
        )
    return assemble_deck(recipe.title, [by_mach[m] for m in recipe.machs], recipe.traits.correct)


def compare_decks(new: C81Deck, old: C81Deck) -> DeckDifference:
    """Largest differences of `new` from `old`; raises ValueError when their knots differ."""
    for a, b in ((new.cl, old.cl), (new.cd, old.cd)):
        if (
            a.values.shape != b.values.shape
            or np.any(a.alpha_deg != b.alpha_deg)
            or np.any(a.mach != b.mach)
        ):
            raise ValueError("the decks have different angles or Machs: rebuild the shipped one")
    near = np.flatnonzero(np.abs(old.cl.alpha_deg) <= BLEND_END_DEG)
    lift = np.abs(new.cl.values - old.cl.values)[near]
    drag = np.abs(new.cd.values / old.cd.values - 1.0)[near]

    def where(difference: Array) -> str:
        i, j = np.unravel_index(int(np.argmax(difference)), difference.shape)
        return f"{old.cl.alpha_deg[near[i]]:g} deg, Mach {old.cl.mach[j]:g}"

    return DeckDifference(float(lift.max()), where(lift), float(drag.max()), where(drag))
