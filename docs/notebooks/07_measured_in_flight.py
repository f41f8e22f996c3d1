"""
What did the blade itself measure?
==================================

Power is one number; pressure taps and cameras measure every azimuth. Does the program follow them? The data come from
a model rotor in a wind tunnel, with and without 3/rev root pitch (HART II), and from a helicopter in flight (SA349/2
Gazelle). Nothing is fitted.
"""

import matplotlib.pyplot as plt
import numpy as np

import explorer
import rotor
from rotor.validation import CASES, agreement, computed_curve, measured_curves

curves = {(one.case.name, one.quantity, one.r): one for one in measured_curves()}
solutions = {case.name: rotor.solve(case.design()) for case in CASES}


def show(axes, name, quantity, r, mean=True):
    """Plot measured points and the computed line, with or without means; return their agreement."""
    measured = curves[name, quantity, r]
    psi, computed = computed_curve(measured, solutions[name])
    theirs = measured.values if mean else measured.values - measured.values.mean()
    axes.plot(np.degrees(measured.psi), theirs, "k.", markersize=3)
    axes.plot(np.degrees(psi), computed if mean else computed - computed.mean())
    found = agreement(measured, solutions[name])
    axes.set_title(f"{name}, {r:g} R: correlation {found.correlation:.2f}")
    return found


# %%
# HART II: plot normal force over the azimuth, without (BL) and with (MN) 0.8° of 3/rev pitch. The effect of 3/rev
# agrees well. The baseline is harder: its blades meet the vortices of a wake that stays near the disk.

figure, axes = plt.subplots(1, 2, figsize=(10.0, 3.5), sharey=True, layout="constrained")
for ax, name in zip(axes, ("BL", "MN"), strict=True):
    show(ax, name, "cn_m2", 0.87, mean=False)
    ax.set_xlabel("Azimuth [°]")
axes[0].set_ylabel("$C_n M^2$ without its mean")

# %%
# These loads twist the tip elastically. With 0.8° of 3/rev at the root, it exceeds 0.8° at the tip.

figure, axes = plt.subplots(1, 2, figsize=(10.0, 3.5), sharey=True, layout="constrained")
for ax, name in zip(axes, ("BL", "MN"), strict=True):
    found = show(ax, name, "tip_twist_deg", 1.0)
    ax.set_xlabel("Azimuth [°]")
    for n in (1, 2, 3):
        sizes = (
            f"measured {found.amplitude(n, measured=True):.2f}°, computed {found.amplitude(n):.2f}°"
        )
        print(f"{name} {n}/rev: {sizes}, difference as vectors {100 * found.miss(n):.0f} %")
axes[0].set_ylabel("Elastic twist of the tip [°]")

# %%
# The Gazelle at µ 0.36: plot the section lift coefficient at three radii. It is large where the blade is slow. Lift
# itself, which includes the dynamic pressure, correlates less.

figure, axes = plt.subplots(1, 3, figsize=(12.0, 3.5), sharey=True, layout="constrained")
for ax, r in zip(axes, (0.75, 0.88, 0.97), strict=True):
    show(ax, "FC2", "cl", r)
    ax.set_xlabel("Azimuth [°]")
    lift = agreement(curves["FC2", "cl_u2", r], solutions["FC2"])
    print(f"{r:g} R: correlation of lift {lift.correlation:.2f}")
axes[0].set_ylabel("$c_l$")

# %%
# For harmonics, power, controls and causes that were tried, see *How far to trust the numbers*.

explorer.show(solutions["FC2"].design, browser=False)
