"""
What twist for this mission?
============================

A mission is a list of flight conditions with hours. The twist of least fuel has the least mean power over
these hours. It need not be the best twist of any single condition.
"""

import matplotlib.pyplot as plt
import numpy as np

import explorer
import rotor

design = rotor.make_design(mu=0.2)

# %%
# The mission: advance ratio and hours.

hours = {0.0: 0.5, 0.2: 1.5, 0.3: 1.0}
mission = rotor.optimise(design, "linear", conditions=list(hours.items()), starts=2)
print(mission)

# %%
# Compare the best linear twist of each condition alone.

alone = {mu: rotor.optimise(design.at(mu=mu), "linear", starts=2) for mu in hours}
for mu, best in alone.items():
    print(f"µ {mu:.1f}: {best.twist.spec():20s} {best.best.power / 1e3:7.1f} kW")
print(f"mission: {mission.twist.spec()}, mean {mission.best.power / 1e3:.1f} kW")
lost = sum(
    time * (rotor.solve(mission.design.at(mu=mu)).power.total - alone[mu].best.power)
    for mu, time in hours.items()
) / sum(hours.values())
print(f"a blade that had the best twist in every condition would save another {lost / 1e3:.1f} kW")

# %%
# The optimum is flat. Print the range of twist within 0.1 % of the least power.

(band,) = mission.band
print(f"{np.degrees(band.low):.1f}° to {np.degrees(band.high):.1f}° cost less than 0.1 % more")

rates = np.arange(-22.0, -3.9, 2.0)
for mu in hours:
    power = np.array(
        [rotor.solve(design.at(mu=mu).with_twist(f"linear:{rate:g}")).power.total for rate in rates]
    )
    plt.plot(rates, 100.0 * (power / power.min() - 1.0), label=f"µ {mu:.1f}, {hours[mu]:.1f} h")
plt.axvspan(np.degrees(band.low), np.degrees(band.high), alpha=0.2, label="mission, within 0.1 %")
plt.xlabel("Linear twist [°]")
plt.ylabel("Power above the least [%]")
plt.legend()

# %%
# Show it on the page.

explorer.show(mission.design, browser=False)
