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
    """How many quantities of a page miss their target, and the rms error of the worst with its target, as a link."""
    rows = [row for row in trust_rows() if row.set == page and row.target]
    if not rows:
        return "none"
    met = [each for (name, _), each in measured_quantities().items() if name == page]
    missed = met.count(False)
    words = "missed" if missed else "met"
    if missed and len(met) > 1:
        words = f"{missed} of {len(met)} missed, worst"
    worst = max(rows, key=lambda row: rms_percent(row) / target_percent(row))
    sizes = f"{rms_percent(worst):.1f} %, target {target_percent(worst):.1f} %"
    return f"[{words}: {sizes}](docs/validation/{page}.md)"


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


def section() -> str:
    """The heading, the sentences and the table of measured rotors."""
    met = measured_quantities()
    bands = {row.what: row for row in trust_rows() if row.set == "doubt"}
    lines = [
        "| measured rotor | computed over measured power | in its band | target |",
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
