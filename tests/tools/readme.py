"""Write the section of README.md that says how far to trust the program: `python -m tests.tools.readme`.

`make trust` runs it. The table has every measured rotor of the bands: how far its power is off, and how many measured
points lie within the band. A quantity of assets/trust.csv meets its target if every row of it does, one for each inflow
model; the trust page has them all.
"""

import re
from pathlib import Path

from rotor.validation.trust import TrustRow, coverage, quantities_met, trust_rows

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
    """How many quantities of a page miss their target, with a link to the page."""
    met = [each for (name, _), each in measured_quantities().items() if name == page]
    if not met:
        return "none"
    missed = met.count(False)
    words = "missed" if missed else "met"
    if missed and len(met) > 1:
        words = f"{missed} of {len(met)} missed"
    return f"[{words}](docs/validation/{page}.md)"


def cells(row: TrustRow) -> tuple[str, str]:
    """How far a rotor's power is off, and how many points its band holds."""
    off, inside = row.shown.partition(" (")[0].split(", ")
    return off.removesuffix(" on average"), inside.replace(" within", ",")


def section() -> str:
    """The heading, the sentences and the table of measured rotors."""
    met = measured_quantities()
    bands = {row.what: row for row in trust_rows() if row.set == "doubt"}
    lines = [
        "| measured rotor | computed power, mean | in its band | target |",
        "| --- | --- | --- | --- |",
        *(
            f"| {what} | {' | '.join(cells(bands[what]))} | {verdict(page)} |"
            for what, page in ROTORS.items()
        ),
    ]
    return (
        "## How far to trust it\n\n"
        f"{100 * coverage():.0f} % of measured powers lie in the [band](docs/validation/doubt.md) of the computed one; "
        "each rotor's band is fitted to the others.\n"
        f"The error of {sum(met.values())} of {len(met)} measured quantities is within its target, the scatter of the "
        "test alone. Only the wake's path is fitted. "
        "[All comparisons](docs/validation.md), [what is not modelled](docs/validation.md#not-modelled).\n\n"
        + "\n".join(lines)
        + "\n\n"
    )


def with_section(text: str) -> str:
    """The text with this section anew."""
    return re.sub(r"## How far to trust it\n.*?(?=## )", lambda _: section(), text, flags=re.DOTALL)


if __name__ == "__main__":
    README.write_text(with_section(README.read_text(encoding="utf-8")), encoding="utf-8")
