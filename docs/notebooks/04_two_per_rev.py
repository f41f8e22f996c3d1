"""
Would 2/rev pay?
================

An actuator can twist the blade twice per revolution. In fast flight this can move load away from where it is expensive.
How much does it save, and what remains after carrying the actuator's mass?
"""

import math

import matplotlib.pyplot as plt

import explorer
import rotor
from rotor.actuator import (
    HostBlade,
    default_placement,
    effect,
    find_actuator,
    install,
    tip_amplitude,
    with_actuator_mass,
)

design = rotor.make_design(mu=0.35)
phases = range(0, 360, 30)

# %%
# Put a macro fibre composite outside the skins of the existing blade, and in the skin of a new blade of half its
# stiffness. Drive each with half of its voltage range at twelve phases. Compare power with that of the same
# blade with the actuator at rest, and finally with that of the blade without an actuator.

hosts = {"retrofit": HostBlade(), "new blade, half the stiffness": HostBlade("new", 0.5)}
changes, best = {}, {}
for title, host in hosts.items():
    installed = install(find_actuator("MFC_P1"), default_placement(), host, design.rotor)
    degrees = math.degrees(tip_amplitude(installed))
    driven = [
        installed.on(rotor.make_design(mu=0.35, twist_per_rev=[(2, degrees, phase)]))
        for phase in phases
    ]
    changes[title] = [effect(one, installed.on(design)).power[0] / 1e3 for one in driven]
    least = min(changes[title])
    best[title] = driven[changes[title].index(least)]
    net = effect(with_actuator_mass(best[title], installed), design).power[0] / 1e3
    print(
        f"{title}: torsion at {installed.frequency:.2f}/rev, tip of the blade at rest ±{degrees:.2f}°"
    )
    print(f"  its twist moves power by {least:+.1f} kW")
    print(
        f"  with its {installed.masses.aircraft:.0f} kg and its stiffness, without its drive: {net:+.1f} kW"
    )

# %%
# Phase decides whether the same amplitude costs or saves power.

for title, powers in changes.items():
    plt.plot(phases, powers, "o-", label=title)
plt.axhline(0.0, color="grey", linewidth=0.8)
plt.xlabel("Phase [°]")
plt.ylabel("Change of power at full amplitude [kW]")
plt.legend()

# %%
# Power is half of the question: 2/rev also serves against vibration and stall. Check the separated area.

chosen = best["retrofit"]
before, after = (100 * rotor.solve(one).stalled_area for one in (design, chosen))
print(f"separated part of the disk: {before:.1f} % without, {after:.1f} % with 2/rev")

# %%
explorer.show(chosen, browser=False)
