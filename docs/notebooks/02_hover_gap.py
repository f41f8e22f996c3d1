"""
How much of the hover gap is drag?
==================================

Computed hover power is below most of the few public measured points. Either profile power is missing, because real
sections have more drag than smooth ones, or induced power is missing. The two grow differently with thrust, so the
points can separate drag at low thrust from the rest. They cannot separate induced power from drag that grows with lift.
"""

import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import nnls

import explorer
import rotor
from rotor.validation import load_set

measured = load_set("uh60a-hover")
print(measured.report)

# %%
# Trim at each measured thrust: adjust the mass until the thrust coefficient agrees.

design = rotor.make_design(hover=True)
sigma = design.rotor.solidity
thrust = np.array([point["ct"] for point in measured.points])
power = np.array([point["cp"] for point in measured.points])


def trimmed(ct: float) -> rotor.Solution:
    """Hover at a thrust coefficient: weight is nearly proportional to it, so two steps suffice."""
    mass = design.condition.mass * ct / rotor.solve(design).ct
    for _ in range(2):
        solution = rotor.solve(design.at(mass_kg=mass)).require()
        mass *= ct / solution.ct
    return solution


solutions = [trimmed(ct) for ct in thrust]
unit = design.power_unit
induced = np.array([one.power.induced for one in solutions]) / unit
profile = np.array([one.power.profile for one in solutions]) / unit
gap = power - np.array([one.cp for one in solutions])

# %%
# If the gap were drag alone, profile power would need the same factor at every thrust. If it were induced power alone,
# induced power would.

print("  CT/σ    gap [%]   profile ×   induced ×")
for ct, lack, whole, drag, wake in zip(thrust, gap, power, profile, induced, strict=True):
    print(
        f"{ct / sigma:6.3f} {100 * lack / whole:9.1f} {1 + lack / drag:11.3f} {1 + lack / wake:11.3f}"
    )

# %%
# Fit both at once: gap = a · profile + b · induced, with a and b not negative. Leave out each point in turn to see how
# far the answer depends on it.

parts = np.stack((profile, induced), axis=1)
(a, b), _ = nnls(parts, gap)
kept = [np.delete(np.arange(len(gap)), k) for k in range(len(gap))]
others = [nnls(parts[rows], gap[rows])[0] for rows in kept]
print(f"profile power × {1 + a:.3f}, induced power × {1 + b:.3f}")
for name, k, best in (("profile", 0, a), ("induced", 1, b)):
    low, high = min(fit[k] for fit in others), max(fit[k] for fit in others)
    print(
        f"{name}: missing {100 * best:.1f} %, {100 * low:.1f} % to {100 * high:.1f} % with one point left out"
    )
drag = a * profile.sum() / (a * profile.sum() + b * induced.sum())
left = np.abs(gap - parts @ (a, b)) / power
print(
    f"drag is {100 * drag:.0f} % of the gap as fitted, which leaves up to {100 * left.max():.1f} % of the power"
)

# %%
# Ten digitised points of unclear origin only show where to look. Contracting wakes, free or prescribed, hardly give
# more induced power than annuli, so contraction does not explain the gap.

plt.plot(thrust / sigma, 100 * gap / power, "o", label="measured − computed")
plt.plot(thrust / sigma, 100 * a * profile / power, label="drag")
plt.plot(thrust / sigma, 100 * (a * profile + b * induced) / power, label="drag and induced power")
plt.xlabel("Blade loading CT/σ")
plt.ylabel("Part of the measured power [%]")
plt.legend()

# %%
explorer.show(solutions[-1].design, browser=False)
