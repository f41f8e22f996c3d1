"""
Would 2/rev pay?
================

An actuator in the blade can twist it twice per revolution. At fast flight that can move load away from where it is
expensive. What does it save, and what is left once the actuator's mass and losses are carried?
"""

import math

import matplotlib.pyplot as plt
import numpy as np

import explorer
import rotor
from rotor.actuator import Host, default_placement, find_actuator, install, phase_sweep

design = rotor.make_design(mu=0.35)

# %%
# A macro fibre composite outside the skins of the blade as built, and in the skin of a new blade with half its
# stiffness.

hosts = {"retrofit": Host(), "new blade, half the stiffness": Host("new", 0.5)}
sweeps = {}
for title, host in hosts.items():
    installed = install(find_actuator("MFC_P1"), default_placement(), host, design.rotor)
    found = sweeps[title] = phase_sweep(design, installed, 2)
    net = "no trim" if found.net_saving is None else f"{found.net_saving / 1e3:+.1f} kW"
    print(
        f"{title}: torsion at {installed.frequency:.2f}/rev, tip ±{math.degrees(found.dynamic.amplitude):.2f}° at 2/rev"
    )
    print(f"  uses {100 * found.share:.0f} % of it, saves {found.gross_saving / 1e3:.1f} kW, net {net}")
    print(f"  carries {installed.masses.aircraft:.0f} kg, loses {found.drive_loss / 1e3:.1f} kW in the drive")

# %%
# What matters is the phase: the same amplitude costs or saves power.

for title, found in sweeps.items():
    plt.plot(np.degrees(found.phases), found.power / 1e3, "o-", label=title)
plt.axhline(0.0, color="grey", linewidth=0.8)
plt.xlabel("Phase [°]")
plt.ylabel("Change of power at full amplitude [kW]")
plt.legend()

# %%
# Power is half of the question: 2/rev is also tried for vibration and stall, which this model of steady power cannot
# judge.

best = max(sweeps.values(), key=lambda found: found.gross_saving)
before, after = 100 * best.still.stalled_area, 100 * best.best.stalled_area
print(f"stalled part of the disk: {before:.1f} % without, {after:.1f} % with 2/rev")

# %%
explorer.show(best.best.design, browser=False)
