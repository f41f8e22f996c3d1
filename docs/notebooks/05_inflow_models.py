"""
Which inflow model would mislead me?
====================================

All inflow models agree on thrust. They distribute the inflow differently over the disk, so their best twists differ
by a few degrees. Which of them would mislead a designer?
"""

import matplotlib.pyplot as plt
import numpy as np

import explorer
import rotor

design = rotor.make_design(twist="linear:-10", mu=0.2)
reference = "lifting-line"
names = [
    "uniform",
    "coleman",
    "drees",
    "white-blake",
    "pitt-peters",
    "pitt-peters-15pi/23",
    "local-momentum",
    "lifting-line",
]

# %%
# First compare the induced power of one design.

solutions = {
    name: rotor.solve(rotor.make_design(twist="linear:-10", mu=0.2, inflow=name)) for name in names
}
for name, solution in solutions.items():
    print(
        f"{name:28s} κ {solution.induced_power_factor:.3f}   total {solution.power.total / 1e3:7.1f} kW"
    )

# %%
# Plot power over twist with each model. Most simple models keep the shape of the inflow whatever the blade does.

rates = np.arange(-20.0, -1.9, 3.0)
curves = {
    name: np.array(
        [rotor.solve(one.design.with_twist(f"linear:{rate:g}")).power.total for rate in rates]
    )
    for name, one in solutions.items()
}
for name, power in curves.items():
    plt.plot(
        rates,
        100 * (power / power.min() - 1.0),
        label=name,
        linewidth=2.5 if name == reference else 1.2,
    )
plt.xlabel("Linear twist [°]")
plt.ylabel("Power above its least [%]")
plt.legend()

# %%
# Solve each model's best twist with the lifting line, the reference here. The extra power measures how far the model
# misled.

fine = np.linspace(rates[0], rates[-1], 200)
wrong = {}
cost = np.poly1d(np.polyfit(rates, curves[reference], 4))
least = cost(fine).min()
for name, power in curves.items():
    best = fine[np.argmin(np.poly1d(np.polyfit(rates, power, 4))(fine))]
    wrong[name] = 100 * (cost(best) / least - 1)
    print(
        f"{name:28s} best twist {best:6.1f}°, solved with the lifting line {wrong[name]:.2f} % above the least"
    )
misled = max(wrong, key=lambda name: wrong[name])
off = {
    name: 100 * (one.power.total / solutions[reference].power.total - 1)
    for name, one in solutions.items()
}
print(f"misleads most about twist: {misled}, by {wrong[misled]:.2f} % of the power")
lowest = min(off, key=lambda name: off[name])
print(f"misleads most about power itself: {lowest}, by {off[lowest]:+.1f} %")

# %%
# Compare the inflow itself.

_, axes = plt.subplots(1, 2, subplot_kw={"projection": "polar"}, figsize=(10, 4.5))
for ax, name in zip(axes, (names[0], reference), strict=True):
    rotor.plot_field(solutions[name], "induced", ax=ax)
    ax.set_title(name)

# %%
explorer.show(solutions[reference].design, browser=False)
