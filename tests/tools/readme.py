"""Write the section of README.md that says how far to trust the program: `python -m tests.tools.readme`.

`make trust` runs it. The table has every measured rotor of the bands: how far its power is off, and how many measured
points lie within the band. A set of assets/trust.csv meets its target if every row does; the trust page has them all.
"""

import re
from pathlib import Path

from rotor.validation.trust import TrustRow, coverage, trust_rows

README = Path(__file__).parents[2] / "README.md"
ROTORS = {
    "UH-60A, hover": ("uh60a-hover",),
    "XV-15, hover": ("xv15-hover",),
    "XV-15, forward flight": ("xv15-forward-15deg", "xv15-forward-0deg"),
    "Knight and Hefner, hover": ("knight-hefner-4", "knight-hefner-3"),
    "Castles and Gray, hover": ("castles-gray-hover",),
    "SA349/2 Gazelle, forward flight": ("flown-power",),
    "Bo 105, forward flight": (),
    "PCA-2, forward flight": ("pca2",),
}
"""The sets of each measured rotor, by what it is called among the bands; Bo 105's power has no target."""


def judged() -> dict[str, bool]:
    """Measured sets that have a target, and whether each row meets it."""
    rows = [row for row in trust_rows() if row.target and row.kind == "validation"]
    return {
        one.set: all(row.verdict == "met" for row in rows if row.set == one.set) for one in rows
    }


def verdicts(met: dict[str, bool], names: tuple[str, ...]) -> str:
    """The verdicts of some sets, each once, with a link to its set."""
    words = {met[name]: name for name in names if name in met}
    return ", ".join(
        f"[{'met' if one else 'missed'}](docs/validation/{name}.md)" for one, name in words.items()
    )


def cells(row: TrustRow) -> tuple[str, str]:
    """How far a rotor's power is off, and how many points its band holds."""
    off, inside = row.shown.partition(" (")[0].split(", ")
    return off.removesuffix(" on average"), inside.replace(" within", ",")


def section() -> str:
    """The heading, the sentences and the table of measured rotors."""
    met, bands = judged(), {row.what: row for row in trust_rows() if row.set == "doubt"}
    lines = [
        "| measured rotor | computed power, mean | in its band | target |",
        "| --- | --- | --- | --- |",
        *(
            f"| {what} | {' | '.join(cells(bands[what]))} | {verdicts(met, ROTORS[what]) or 'none'} |"
            for what in ROTORS
        ),
    ]
    return (
        "## How far to trust it\n\n"
        f"{100 * coverage():.0f} % of measured powers lie in the [band](docs/validation/doubt.md) of the computed one; "
        "each rotor's band is fitted to the others.\n"
        f"{sum(met.values())} of {len(met)} measured sets meet their target; only the wake's path is fitted. "
        "[All comparisons](docs/validation.md), [what is not modelled](docs/validation.md#not-modelled).\n\n"
        + "\n".join(lines)
        + "\n\n"
    )


def with_section(text: str) -> str:
    """The text with this section anew."""
    return re.sub(r"## How far to trust it\n.*?(?=## )", lambda _: section(), text, flags=re.DOTALL)


if __name__ == "__main__":
    README.write_text(with_section(README.read_text(encoding="utf-8")), encoding="utf-8")
