"""Solutions that several figures share, kept while the command runs."""

from dataclasses import replace
from functools import lru_cache

from rotor.design import Design
from rotor.presets import make_design
from rotor.solution import Solution
from rotor.solve import solve

FIVE_RATES = (0, -4, -8, -12, -16)
"""The document's linear twists [degrees per radius] (thesis §3.3)."""

THESIS_WAKE = "thesis-wake"
"""The `thesis` preset with the dynamic wake for its linear inflow: the least change that lets twist act on induced "
"power."""
FLIGHT_LINEAR = "flight-linear"
"""The `flight` preset with linear (Pitt–Peters) inflow."""

THESIS_TRIMMED = "thesis-trimmed"
"""The `thesis` preset's blade and section with the dynamic wake and the `flight` preset's trim: cyclic, and µ sin α "
"in U_P."""

VARIANTS = ("thesis", THESIS_WAKE, "flight", FLIGHT_LINEAR)
VARIANT_TITLES = {
    "thesis": "thesis preset (linear inflow as printed)",
    THESIS_WAKE: "thesis preset with the dynamic wake",
    "flight": "flight preset (dynamic wake)",
    FLIGHT_LINEAR: "flight preset with linear inflow",
}


def variant(name: str, *, twist: str | None = None, mu: float = 0.2, mass: float | None = None) -> Design:
    """A preset, or a preset with its inflow exchanged."""
    preset = name.partition("-")[0]
    design = make_design(preset, twist=twist, advance_ratio=mu, mass=mass)
    if name == THESIS_WAKE:
        design = replace(design, models=replace(design.models, inflow="dynamic-wake"))
    if name == THESIS_TRIMMED:
        models = replace(design.models, inflow="dynamic-wake", trim="propulsive", disk_axial_flow=True)
        design = replace(design, models=models)
    if name == FLIGHT_LINEAR:
        design = replace(design, models=replace(design.models, inflow="pitt-peters"))
    return design


@lru_cache(maxsize=4096)
def solved(name: str, twist: str, mu: float, mass: float | None = None) -> Solution:
    """The solution of a variant; converged or not."""
    return solve(variant(name, twist=twist, mu=mu, mass=mass))


def main_rotor_kw(name: str, rate: float, mu: float, mass: float | None = None) -> float:
    """Main-rotor power of a linear twist [kW]; RuntimeError with the sentence where it does not trim."""
    return solved(name, f"linear:{rate:g}", mu, mass).require().power.main_rotor / 1e3
