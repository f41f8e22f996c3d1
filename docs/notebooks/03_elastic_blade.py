"""
What does the blade's own elasticity do to the optimum?
=======================================================

In flight a blade twists under aerodynamic, inertial and centrifugal moments. Its twist in flight is the built-in twist
plus this elastic twist, so the best built-in twist changes.
"""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

import explorer
import rotor

elastic = rotor.make_design(twist="linear:-12", mu=0.3)
rigid = replace(elastic, models=replace(elastic.models, elastic_twist=False))

# %%
# Solve the same built-in twist with a rigid and an elastic blade.

solutions = {"rigid": rotor.solve(rigid).require(), "elastic": rotor.solve(elastic).require()}
for name, one in solutions.items():
    print(
        f"{name:8s} {one.power.total / 1e3:7.1f} kW, collective {np.degrees(one.controls.collective):.2f}°"
    )
twist = solutions["elastic"].disk.elastic_twist
tip = np.degrees(twist[-1])
print(
    f"elastic twist at the tip: mean {tip.mean():.2f}°, from {tip.min():.2f}° to {tip.max():.2f}° in one revolution"
)

# %%
# Elastic twist over the disk varies with azimuth, as the moments on the blade do.

rotor.plot_field(solutions["elastic"], "elastic_twist")

# %%
# Plot power over built-in twist; find the best of each blade.

rates = np.arange(-20.0, -3.9, 2.0)
best = {}
for name, design in (("rigid", rigid), ("elastic", elastic)):
    power = np.array(
        [rotor.solve(design.with_twist(f"linear:{rate:g}")).require().power.total for rate in rates]
    )
    fit = np.poly1d(np.polyfit(rates, power, 4))
    fine = np.linspace(rates[0], rates[-1], 500)
    best[name] = fine[np.argmin(fit(fine))]
    print(
        f"{name:8s} least power {fit(best[name]) / 1e3:.1f} kW at a built-in twist of {best[name]:.1f}°"
    )
    plt.plot(rates, power / 1e3, "o-", label=name)
plt.xlabel("Linear built-in twist [°]")
plt.ylabel("Total power [kW]")
plt.legend()

# %%
# For the cost of neglecting elasticity, solve the elastic blade with the optimum of the rigid one.

flown = {name: elastic.with_twist(f"linear:{rate:.3f}") for name, rate in best.items()}
powers = {name: rotor.solve(design).require().power.total for name, design in flown.items()}
lost = powers["rigid"] - powers["elastic"]
print(
    f"the optimum moves by {best['elastic'] - best['rigid']:+.1f}°; neglecting this costs {lost / 1e3:.2f} kW"
)

# %%
explorer.show(flown["elastic"], browser=False)
