"""Write the sections of README.md that have computed numbers: `python -m tests.tools.readme`.

The answers to the three questions are those of docs/answers.json, which `tests.tools.answers` writes; `make trust` runs
both. The table of how far to trust the program has every measured rotor of the bands: how far its power is off, and how
many measured points lie within the band. A quantity of assets/trust.csv meets its target if every row of it does, one
for each inflow model; the trust page has them all.
"""

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from rotor.trim.doubt import pair_text, sure_words, sureness
from rotor.validation.trust import TrustRow, coverage, quantities_met, trust_rows
from tests.tools.answers import stored

README = Path(__file__).parents[2] / "README.md"
ROTORS = {
    "UH-60A, hover": "uh60a-hover",
    "XV-15, hover": "xv15-hover",
    "XV-15, forward flight": "xv15-forward",
    "Knight and Hefner, hover": "knight-hefner",
    "Castles and Gray, hover": "castles-gray",
    "SA349/2 Gazelle, forward flight": "flown-power",
    "Bo 105, forward flight": "",
    "PCA-2, forward flight": "pca2",
}
"""The page of each measured rotor, by what it is called among the bands; the Bo 105 shares that of the Gazelle."""


def measured_quantities() -> dict[tuple[str, str], bool]:
    """Whether each measured quantity with a target meets it, by page and name."""
    return quantities_met(row for row in trust_rows() if row.kind == "validation")


def verdict(page: str) -> str:
    """How many quantities of a page miss their target, and as a link the rms errors, with their targets, of the worst
    and of one that meets its own."""
    rows = [row for row in trust_rows() if row.set == page and row.target]
    if not rows:
        return "none"
    met = [each for (name, _), each in measured_quantities().items() if name == page]
    missed = met.count(False)
    words = "missed" if missed else "met"
    if missed and len(met) > 1:
        words = f"{missed} of {len(met)} missed, worst"
    worst = max(rows, key=lambda row: rms_percent(row) / target_percent(row))
    text = f"{words}: {sizes(worst)}"
    good = [row for row in rows if measured_quantities()[page, row.quantity]]
    if missed and good:
        text += f"; met: {sizes(good[0])}"
    return f"[{text}](docs/validation/{page}.md)"


def sizes(row: TrustRow) -> str:
    """The rms error of a measured quantity and its target."""
    return f"{rms_percent(row):.1f} %, target {target_percent(row):.1f} %"


def rms_percent(row: TrustRow) -> float:
    """The rms error of a measured quantity [%]."""
    assert row.error is not None
    return 100.0 * row.error


def target_percent(row: TrustRow) -> float:
    """The largest rms error that meets its target [%], from its words: `rms 2.0 % for ct 0.004…0.01`."""
    return float(row.target.removeprefix("rms ").partition(" %")[0])


def cells(row: TrustRow) -> tuple[str, str]:
    """How far a rotor's power is off, and how many points its band holds."""
    off, inside = row.shown.partition(" (")[0].split(", ")
    return off.removesuffix(" on average").replace("-", "−"), inside.replace(" within", ",")


def answers_section(found: Mapping[str, Any]) -> str:
    """The heading of the three questions and an answer to each, from the record of `tests.tools.answers`."""
    hover, fast = found["best_twist"]["hover"], found["best_twist"]["fast"]
    moving = found["twist_follows_speed"]
    most = found["other_laws"]["most_percent"]
    lines = [
        "## Three questions, answered",
        "",
        "UH-60A at 8322 kg; ranges are due to uncertain inputs and inflow models.",
        "[More](docs/notebooks/09_three_questions.py), [how sure](docs/guide/doubt.md).",
        "",
        "- **How should twist change with speed?** The best linear twist is "
        f"{twist_text(hover, 'per radius in hover')} and {twist_text(fast, 'at µ 0.35')}.",
        f"  Twist that follows speed saves {gain_text(moving)} over the best fixed twist.",
        f"- **Which twist law is best?** No clear winner: more segments or a curve save {most:.1f} % more.",
        "- **Which actuator pays?** " + "\n  ".join(actuator_sentences(found)),
    ]
    return "\n".join(lines) + "\n\n"


def twist_text(twist: Mapping[str, float], where: str) -> str:
    """A best twist with its range, as `−16.5° per radius in hover (−17.9 to −15.0)`."""
    rate, low, high = (
        f"{twist[name]:.1f}".replace("-", "−") for name in ("rate_deg", "low_deg", "high_deg")
    )
    return f"{rate}° {where} ({low} to {high})"


def gain_text(moving: Mapping[str, float]) -> str:
    """What twist that follows speed saves, as `2.8 ± 2.4 kW (likely)`."""
    saving, band = moving["saving_w"] / 1e3, moving["band_w"] / 1e3
    return f"{pair_text(saving, band, 'kW')} ({sureness(saving, band)})"


def actuator_sentences(found: Mapping[str, Any]) -> list[str]:
    """Whether an actuator pays on the same blade, as the page asks, and what the best costs against the best fixed."""
    rows = found["same_blade"]
    kept = [row for row in rows if not row["exceeded"]]
    assert not any(row["net_saving_w"] > 0 for row in kept), "Write the sentence of one that pays."
    limits = "none keeps all its limits" if not kept else f"{len(kept)} keep all their limits"
    first, best, fixed = page_default(rows), rows[0], found["best_fixed"][0]
    (word,) = {cost_word(row) for row in (first, best, fixed)}
    return [
        f"None of {len(rows)} combinations of actuator and twist law; {limits}.",
        f"Over a mission of hover, climb, cruise and fast flight (hours assumed), {short_name(first)}, with "
        f"which the page begins, costs this blade "
        f"{cost_text(first)}, and the best, {short_name(best)}, {cost_text(best)}.",
        f"Against the best fixed twist the best costs {cost_text(fixed)}, "
        f"{-fixed['parts_w']['blade'] / 1e3:.0f} kW of it for this blade's own twist. All are {word}.",
    ]


def page_default(rows: Sequence[Mapping[str, Any]]) -> Mapping[str, Any]:
    """The row of the actuator and twist law with which Actuate begins."""
    (row,) = (row for row in rows if (row["actuator"], row["concept"]) == ("MFC_P1", "linear"))
    return row


def cost_text(row: Mapping[str, Any]) -> str:
    """A net cost with its band, as `8.9 ± 1.8 kW`."""
    return pair_text(-row["net_saving_w"] / 1e3, row["band_w"] / 1e3, "kW")


def cost_word(row: Mapping[str, Any]) -> str:
    """Whether the sign of a net cost is known, and why no more than that."""
    return sure_words(row["net_saving_w"], row["band_w"], sourced=row["sourced"])


def short_name(row: Mapping[str, Any]) -> str:
    """The identifier of an actuator without underscores, as `MFC P1`."""
    return row["actuator"].replace("_", " ")


def trust_section() -> str:
    """The heading, the sentences and the table of measured rotors."""
    met = measured_quantities()
    bands = {row.what: row for row in trust_rows() if row.set == "doubt"}
    lines = [
        "| measured rotor | computed over measured power, minus 1 | in its band | rms error |",
        "| --- | --- | --- | --- |",
        *(
            f"| {what} | {' | '.join(cells(bands[what]))} | {verdict(page)} |"
            for what, page in ROTORS.items()
        ),
    ]
    return (
        "## How far to trust it\n\n"
        f"{100 * coverage():.0f} % of measured powers, in the mean over rotors, lie in the "
        "[band](docs/validation/doubt.md) of the computed one; each rotor's band is fitted to the others.\n"
        f"The error of {sum(met.values())} of {len(met)} measured quantities is within its target, the scatter of the "
        "test alone. The wake's path and the sizes of model errors in the bands are fitted. "
        "[All comparisons](docs/validation.md), [what is not modelled](docs/validation.md#not-modelled).\n\n"
        + "\n".join(lines)
        + "\n\n"
    )


def with_section(text: str) -> str:
    """The text with both sections anew."""
    answers = answers_section(stored())
    text = re.sub(r"## Three questions, .*?(?=## )", lambda _: answers, text, flags=re.DOTALL)
    trust = trust_section()
    return re.sub(r"## How far to trust it\n.*?(?=## )", lambda _: trust, text, flags=re.DOTALL)


if __name__ == "__main__":
    README.write_text(with_section(README.read_text(encoding="utf-8")), encoding="utf-8")
