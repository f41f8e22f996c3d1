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
from rotor.actuator import Host, default_placement, effect, find_actuator, install, tip_amplitude, with_actuator_mass
from rotor.actuator.installation import harmonic_loss
from rotor.design import Harmonic
from rotor.optimisation.vibration import with_harmonics
from rotor.trim import at_rest

design = rotor.make_design(mu=0.35)
phases = np.arange(0.0, 360.0, 30.0)

# %%
# A macro fibre composite outside the skins of the blade as built, and in the skin of a new blade with half its
# stiffness. Each is driven with half of its voltage range at twelve phases, and compared with the same blade at rest in
# the same flow. What is left counts from the blade without an actuator.

hosts = {"retrofit": Host(), "new blade, half the stiffness": Host("new", 0.5)}
saved, best = {}, {}
for title, host in hosts.items():
    installed = install(find_actuator("MFC_P1"), default_placement(), host, design.rotor)
    amplitude = tip_amplitude(installed)
    waves = [(Harmonic(2, amplitude, math.radians(phase)),) for phase in phases]
    driven = [with_harmonics(installed.on(design), wave) for wave in waves]
    still = rotor.solve(at_rest(driven[0])).power.total
    saved[title] = [rotor.solve(one).power.total - still for one in driven]
    best[title] = driven[int(np.argmin(saved[title]))]
    loss = installed.masses.blades * harmonic_loss(installed, 2, 1.0, installed.beam.angular_speed)
    net = effect(with_actuator_mass(best[title], installed), design).power[0] + loss
    print(
        f"{title}: torsion at {installed.frequency:.2f}/rev, tip ±{math.degrees(amplitude):.2f}° of the blade at rest"
    )
    print(f"  moves power by {min(saved[title]) / 1e3:+.1f} kW, by {net / 1e3:+.1f} kW with all counted")
    print(f"  carries {installed.masses.aircraft:.0f} kg, loses {loss / 1e3:.1f} kW in the drive")

# %%
# What matters is the phase: the same amplitude costs or saves power.

for title, changes in saved.items():
    plt.plot(phases, np.array(changes) / 1e3, "o-", label=title)
plt.axhline(0.0, color="grey", linewidth=0.8)
plt.xlabel("Phase [°]")
plt.ylabel("Change of power at full amplitude [kW]")
plt.legend()

# %%
# Power is half of the question: 2/rev is also tried for vibration and stall, which this model of steady power cannot
# judge.

least = min(best, key=lambda title: min(saved[title]))
before, after = (100 * rotor.solve(one).stalled_area for one in (design, best[least]))
print(f"stalled part of the disk: {before:.1f} % without, {after:.1f} % with 2/rev")

# %%
explorer.show(best[least], browser=False)
