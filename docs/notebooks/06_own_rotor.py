"""
My own rotor from a TOML file
=============================

Write a rotor file, read it, find its best twist, and save the design.
"""

import tempfile
from pathlib import Path

import explorer
import rotor

ROTOR = """
name = "My rotor"
[main_rotor]
blades = 3
radius_m = 5.345
speed_rpm = 394.0
root_cutout_r = 0.2
chord_m = 0.35
section = "naca0012"
linear_twist_deg = -12.0
flap_hinge_m = 0.2
blade_mass_kg = 34.0
[airframe]
drag_area_m2 = 1.3
mass_kg = 1950.0
"""
folder = Path(tempfile.mkdtemp())
(folder / "mine.toml").write_text(ROTOR, encoding="utf-8")
mine = rotor.load_rotor(folder / "mine.toml")
print(mine)
for remark in mine.remarks:
    print("-", remark)

# %%
# Plot power over speed, by parts.

design = rotor.make_design(rotor=mine, mu=0.25)
table = rotor.sweep(design, [0.08, 0.12, 0.16, 0.2, 0.24, 0.28, 0.32])
rotor.plot_power(table)
columns = table.to_dict()
for mu, total in zip(columns["mu"], columns["power_total_w"], strict=True):
    print(f"µ {mu:.2f}: " + ("no trim" if total is None else f"{total / 1e3:.1f} kW"))

# %%
# Find the best two-segment twist at µ = 0.25, and its saving.

best = rotor.optimise(design, "two-segment", starts=2)
print(best)

# %%
# Plot the angle of attack over the disk with this twist.

solution = rotor.solve(best.design).require()
rotor.plot_field(solution, "alpha")
print(f"separated: {100 * solution.stalled_area:.1f} % of the disk")
for caveat in solution.caveats:
    print("-", caveat.sentence)

# %%
# A saved design contains the rotor file, so you can send it to others.

rotor.save_solution(solution, folder / "best.json")
again = rotor.solve(rotor.load_design(folder / "best.json"))
print(f"{solution.power.total / 1e3:.3f} kW, read back {again.power.total / 1e3:.3f} kW")
explorer.show(solution.design, browser=False)
