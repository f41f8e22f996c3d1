"""
The three questions, answered
=============================

The program began with a thesis, M. Lonoce, *Helicopter Blade Twist Optimization in Forward Flight*, 2016, and its
three questions. There are two presets. ``flight``, the default, uses the best models available: section data over
angle of attack and Mach number, hinge offset, blades elastic in torsion, propulsive trim with cyclic, and a lifting
line. ``thesis`` uses the models of the thesis. Check its figures with ``python -m rotor reproduce OUT``.

**How should twist change with speed?** The best linear twist is −16.5° per radius in hover, −12.1° at µ 0.2 and −11.6°
at 0.35 (−9.6 to −12.3° over the inflow models, −7.1° without fuselage drag). Twist that follows speed saves 0.2 % over
the best fixed twist, 0.1 to 0.3 % over the inflow models. That is 3 ± 2 kW (likely), mostly up to µ 0.1
(``schedule``, eight speeds from hover to µ 0.35; from µ 0.1 up 1.8 kW). Its sign held for every input and model that
was varied alone, its size did not.

**Which twist law is best?** No clear winner: two or three segments, or a quadratic twist, save 0.2 %
more than one linear twist that follows speed. One good fixed twist saves 0.3 to 0.4 % against −16°.

**Which actuator pays?** None that changes steady twist: none of 24 combinations of actuator and twist law saves
power, and none keeps all its limits. Added to the blade as built, over a mission of hover, climb, cruise and fast
flight whose hours are assumed, MFC P1 costs 14 ± 3 kW and the best, AFC, 7.3 ± 1.1 kW. Against the best fixed twist
the best costs 22 ± 6 kW: 15 kW for the twist of the blade as built, 8 kW for its mass.
All are likely, from estimated data. Unlimited twist would gain 3 kW.

For the uncertainty of each number, see :doc:`uncertainty </guide/doubt>`. A difference between two twists is known
better than power itself, although inflow models disagree about it.
"""

import matplotlib.pyplot as plt

import explorer
import rotor
from rotor.validation.thesis import ladder, readings

# %%
# From the thesis to today
# ------------------------
#
# The assumptions of the thesis, in the reading with which most of its statements hold, give −16.5, −8.5 and −3.7° in
# hover, at µ 0.2 and at 0.35. Change one after another to that of the preset ``flight``. Trim by cyclic with µ sin α
# has the largest effect at µ 0.35, −7.0 to −7.6°. At µ 0.2 its effect is −2.1 to −3.2°; drag rise and torsion have as
# much there.

names = tuple(ladder.RUNGS)
speeds = (0.0, 0.2, 0.35)
rungs = {
    "preset thesis": (),
    **{words: names[: k + 1] for k, words in enumerate(ladder.RUNGS.values())},
}
best = {
    words: [ladder.linear_optimum(on, mu, None) for mu in speeds] for words, on in rungs.items()
}
print("best linear twist [°/R]                           hover   µ 0.2  µ 0.35")
for words, row in best.items():
    print(f"{words:46s}" + "".join(f"{least.rate_deg:8.1f}" for least in row))

places = range(len(best))
for k, mu in enumerate(speeds):
    column = [row[k] for row in best.values()]
    plt.plot(
        [least.rate_deg for least in column], places, "o-", label=f"µ {mu:g}" if mu else "hover"
    )
    plt.fill_betweenx(places, *zip(*(least.band_deg for least in column), strict=True), alpha=0.15)
plt.yticks(places, list(best))
plt.gca().invert_yaxis()
plt.xlabel("Best linear twist, shaded within 0.1 % of the power [°/R]")
plt.legend()
plt.gcf().set_size_inches(9.0, 4.5)
plt.tight_layout()

# %%
# The effect of an assumption depends on those changed before it. So also change the trim alone in ``thesis``, and
# change it back alone in ``flight``.

without = tuple(name for name in names if name not in ladder.TRIM)
for mu in speeds[1:]:
    pairs = (
        (names[: names.index(ladder.TRIM[-1]) + 1], names[: names.index(ladder.TRIM[0])]),
        (ladder.TRIM, ()),
        (names, without),
    )
    ways = [
        ladder.linear_optimum(on, mu, None).rate_deg - ladder.linear_optimum(off, mu, None).rate_deg
        for on, off in pairs
    ]
    print(f"trim at µ {mu:g}: " + ", ".join(f"{way:+.1f}°" for way in ways))

# %%
# Compare the inflow models at µ 0.35. Then compute what twist that follows speed saves over the best fixed twist, with
# equal time at each speed.

for model in ("uniform", "local-momentum", "lifting-line"):
    print(f"{model:16s}{ladder.linear_optimum(names, 0.35, model).rate_deg:8.1f}°")
moving = ladder.moving_twist(names, speeds, None)
print(f"best fixed {moving.fixed_deg:.1f}°; moving saves {100 * moving.gain:.2f} %")

# %%
# Measured on another rotor, −17.3° needs 5 % more power than −11.5° at 330 km/h and 2.4 % less in hover. Computed at
# speed: −0.1 % with the drag of the UH-60A, +3.3 % (3.3 to 5.9 over models) with the usual propulsive force of a tunnel
# test. Computed in hover: −0.5 %.

for kmh in (0.0, ladder.FAST_KMH):
    print(f"{kmh:3.0f} km/h: {100 * ladder.strong_over_weak(names, kmh):+.1f} %")

# %%
# How the thesis can be read
# --------------------------
#
# The thesis does not state transition, Mach number and range of angle of its section data, nor the unit of twist. It
# has Prandtl's factor F on the inflow in hover (3.3), and power from torque (3.10), but also "the code calculates the
# main rotor induced power, main rotor profile power and fuselage parasitic power" (p. 25). Five statements of its
# section 3.3 judge each reading. A twist that it calls best may need 0.1 % more than the minimum.

found = readings.judged_readings()
print(
    f"{len(found)} readings; statements that hold, whatever F is on, the unit of twist and the count of power"
)
for section in readings.SECTIONS:
    counts = [sum(one.holds) for one in found if one.reading.section == section]
    print(
        f"{readings.described(section):34s}{min(counts)} to {max(counts)} of {len(readings.STATEMENTS)}"
    )

# %%
# The reading with which most statements hold follows, with the power by which it misses each; for −16° in hover, the
# power above the minimum.

first = found[0]
chosen = first.reading
print(
    f"{readings.described(chosen.section)}; F on {chosen.loss_on}; twist {chosen.unit}; power as {chosen.counted}"
)
for words, excess, holds in zip(readings.STATEMENTS, first.excess, first.holds, strict=True):
    print(f"  {'yes' if holds else 'no ':3s} {words:40s}{100 * excess:6.2f} %")

# %%
# The preset ``thesis`` uses section data, F and power of this reading; twist stays per radius. The thesis has F on the
# inflow in (3.3) and the sum of parts on p. 25. The section data were chosen among ten for their results, which proves
# nothing: the ripple of a polynomial of order 12 is as large as the differences between the twists.

explorer.show(rotor.make_design(preset="thesis", mu=0.2), browser=False)
