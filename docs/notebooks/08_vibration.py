"""
What twist does to vibration
============================

Twist is chosen for power, but it also changes vibration: the loads of four blades add up at the hub to forces and
moments at 4/rev. This notebook shows what static and active twist do to both.

The index weighs the amplitudes of the forces aft, to the side and up by 0.5, 0.67 and 1, adds the moments over the
radius, and is given in per cent of the weight. Use it to compare designs of one rotor. Do not trust its level: another
wake model changes it by half or more.
"""

import math

import matplotlib.pyplot as plt

import rotor

# %%
# Plot the index over static twist at three speeds. Strong twist saves power in hover and costs power at speed.
#
# The shaded band covers the same design with other inflow models, from uniform inflow to the lifting line. From µ 0.3
# on, the models agree that more twist means more vibration, though not by how much. The exception is the lifting line
# at µ 0.3, with its minimum near −4°. At µ 0.2 its minimum is near −12°, like that of power; linear inflow has none. At
# lower speed the wake model decides, and no index is given.

rates = [0, -4, -8, -12, -16, -20]
for mu in (0.2, 0.3, 0.35):
    designs = [rotor.make_design(mu=mu, twist=f"linear:{rate}", bending=True) for rate in rates]
    found = [rotor.hub_loads(rotor.solve(design)) for design in designs]
    plt.plot(rates, [loads.index for loads in found], "o-", label=f"µ {mu:g}")
    plt.fill_between(rates, *zip(*(loads.band for loads in found), strict=True), alpha=0.15)
    print(
        f"µ {mu:g}: "
        + ", ".join(f"{rate}° {one.index:.2f} %" for rate, one in zip(rates, found, strict=True))
    )
plt.xlabel("Linear twist [°]")
plt.ylabel("Index [% of the weight]")
plt.legend()

# %%
# Print the hub loads of the blade as built.

design = rotor.make_design(mu=0.3, bending=True)
loads = rotor.hub_loads(rotor.solve(design))
print(
    f"µ 0.3: index {loads.index:.1f} %, over inflow models {loads.band[0]:.1f} to {loads.band[1]:.1f} %"
)
for name, size in loads.amplitudes.items():
    print(f"  {name} {size:.0f} {'N' if name[0] == 'f' else 'N m'}")

# %%
# Now twist the blade by one degree at 2, 3, 4 or 5 per revolution. The response is nearly linear, so one matrix gives
# every amplitude and phase.

matrix = rotor.t_matrix(design)
still = matrix.response("")
phases = list(range(0, 361, 15))
figure, (power, index) = plt.subplots(1, 2, figsize=(10.0, 3.5), layout="constrained")
for n in matrix.harmonics:
    found = [matrix.response([(n, 1.0, phase)]) for phase in phases]
    power.plot(phases, [100 * (one.power / still.power - 1) for one in found], label=f"{n}/rev")
    index.plot(phases, [100 * (one.index / still.index - 1) for one in found], label=f"{n}/rev")
    best = min(range(len(phases)), key=lambda k: found[k].index)
    change = 100 * (found[best].power / still.power - 1)
    print(
        f"{n}/rev: index {100 * (found[best].index / still.index - 1):+.0f} % at {phases[best]}°, power {change:+.1f} %"
    )
power.set_ylabel("Change of power [%]")
index.set_ylabel("Change of index [%]")
for ax in (power, index):
    ax.axhline(0.0, color="grey", linewidth=0.8)
    ax.set_xlabel("Phase [°]")
index.legend()

# %%
# The phase that saves power is not the phase that reduces vibration. Compute the trade-off curve with 2/rev and 3/rev
# together, at most one degree each. Every point is trimmed again; none has both less power and less vibration than
# another. Brackets give the change of the index with other wakes: where signs differ, do not trust it.

front = rotor.vibration_front(design)
for point, (more, less) in zip(front.points, front.changes, strict=True):
    twist = ", ".join(
        f"{wave.per_rev}/rev {math.degrees(wave.amplitude):.2f}° at {math.degrees(wave.phase):.0f}°"
        for wave in point.design.active_twist.harmonics
    )
    low, high = point.over_inflows
    print(f"power {more:+.2f} %, index {less:+.0f} % ({low:+.0f} to {high:+.0f} %): {twist}")
print("largest error of the matrix: power {:.2f} %, index {:.1f} %".format(*front.preview_error))

# %%
# A static twist of two segments has a trade-off curve too. At this speed the blade as built is worse in both: its
# strong twist suits hover.

fixed = rotor.vibration_front(design, "two-segment", points=4)
figure, ax = plt.subplots()
for found, label in (
    (front, "2/rev and 3/rev on the blade as built"),
    (fixed, "static twist, two segments"),
):
    ax.plot(*zip(*found.changes, strict=True), "o-", label=label)
ax.plot(0.0, 0.0, "ks", label="as built")
ax.set_xlabel("Change of power [%]")
ax.set_ylabel("Change of index [%]")
ax.legend()
