"""Write the section of README.md that says how far to trust the program: `python -m tests.tools.readme`.

`make trust` runs it. The table has every measured rotor of the bands: how far its power is off, and how many measured
points lie within the band. Verdicts are of the sets of assets/trust.csv that have a target: missed, if one row is.
"""

import re
from pathlib import Path

from rotor.validation.trust import TrustRow, coverage, trust_rows

README = Path(__file__).parents[2] / "README.md"
ROTORS = {
    "UH-60A, hover": ("uh60a-hover",),
    "XV-15, hover": ("xv15-hover",),
    "XV-15, forward flight": ("xv15-forward-15deg", "xv15-forward-0deg"),
    "Knight and Hefner, hover": ("knight-hefner-3", "knight-hefner-4"),
    "Castles and Gray, hover": ("castles-gray-hover",),
    "SA349/2 Gazelle, forward flight": ("flown-power",),
    "Bo 105, forward flight": (),
    "PCA-2, forward flight": ("pca2",),
}
"""The sets of each measured rotor, by what it is called among the bands."""
OTHERS = {
    "caradonna-tung-lift": "Caradonna–Tung section C_l", "hart2-airloads": "HART II airloads",
    "gazelle-airloads": "Gazelle airloads", "glasgow-loops": "pitching aerofoil C_m", "sc1095": "SC1095 drag",
    "theory": "identities", "grid": "grid",
}  # fmt: skip
"""Sets of other quantities, in the sentence below the table."""


def judged() -> dict[str, TrustRow]:
    """By set with a target the first row that missed it, or else that met it."""
    found: dict[str, TrustRow] = {}
    for row in trust_rows():
        if row.target and (row.set not in found or (found[row.set].verdict, row.verdict) == ("met", "missed")):
            found[row.set] = row
    return found


def verdicts(sets: dict[str, TrustRow], names: tuple[str, ...]) -> str:
    """The verdicts of some sets, those that say the same once, each with a link to its set."""
    links = {sets[name].verdict: f"[{sets[name].verdict}](docs/validation/{name}.md)" for name in names if name in sets}
    return ", ".join(links.values()) or "no target"


def cells(row: TrustRow) -> tuple[str, str]:
    """How far a rotor's power is off, and how many points its band holds."""
    off, inside = row.shown.partition(" (")[0].split(", ")
    return off.removesuffix(" in the mean"), inside.replace(" within", ",")


def section() -> str:
    """The heading, the table of measured rotors and the sentence on the other sets."""
    sets, bands = judged(), {row.what: row for row in trust_rows() if row.set == "doubt"}
    measured = [row for row in sets.values() if row.kind == "validation"]
    met = sum(row.verdict == "met" for row in measured)
    lines = [
        "| measured rotor | computed power, mean | in its band | target |",
        "| --- | --- | --- | --- |",
        *(f"| {what} | {' | '.join(cells(bands[what]))} | {verdicts(sets, ROTORS[what])} |" for what in ROTORS),
    ]
    others = "; ".join(f"{words} {verdicts(sets, (name,))}" for name, words in OTHERS.items())
    return (
        "## How far to trust it\n\n"
        f"{100 * coverage():.0f} % of measured powers lie in the [band](docs/validation/doubt.md) of the computed one, "
        f"sized without the rotor judged.\n{met} of {len(measured)} sets meet their target; only the wake path is "
        "fitted. [All comparisons](docs/validation.md), [what is not modelled](docs/validation.md#not-modelled).\n\n"
        + "\n".join(lines)
        + f"\n\nOther targets: {others}.\n\n"
    )


def with_section(text: str) -> str:
    """The text with this section anew."""
    return re.sub(r"## How far to trust it\n.*?(?=## )", lambda _: section(), text, flags=re.DOTALL)


if __name__ == "__main__":
    README.write_text(with_section(README.read_text(encoding="utf-8")), encoding="utf-8")
