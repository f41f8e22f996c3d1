"""Write the section of README.md that says how far to trust the program: `python -m tests.tools.readme`.

`make trust` runs it. Every set of assets/trust.csv that has a target stands in it, with the row that decides: the first
that missed its target, else the first that met it. Target and error are in the words of the trust page.
"""

import re
from pathlib import Path

from rotor.validation.trust import TrustRow, trust_rows

README = Path(__file__).parents[2] / "README.md"
ROTORS = (
    {"xv15-hover": "XV-15 hover power"},
    {"xv15-forward-15deg": "XV-15 C_Q/σ, shaft 15° forward", "xv15-forward-0deg": "upright"},
    {"knight-hefner-3": "Knight–Hefner hover, three blades", "knight-hefner-4": "four"},
    {"pca2": "PCA-2 autogiro drag"},
    {"caradonna-tung-lift": "Caradonna–Tung section C_l"},
    {"hart2-airloads": "HART II airloads, correlation"},
    {"gazelle-airloads": "Gazelle airloads, correlation"},
    {"flown-power": "Gazelle power over speed, shape"},
)
"""The sets of measured rotors by line, and what each is called there."""
OTHERS = {
    "glasgow-loops": "pitching aerofoil C_m about 15°", "sc1095": "SC1095 drag", "theory": "identities", "grid": "grid",
}  # fmt: skip
"""Sets without a rotor, in the sentence below the table."""


def judged() -> dict[str, TrustRow]:
    """By set with a target the first row that missed it, or else that met it."""
    found: dict[str, TrustRow] = {}
    for row in trust_rows():
        if row.target and (row.set not in found or (found[row.set].verdict, row.verdict) == ("met", "missed")):
            found[row.set] = row
    return found


def linked(names: dict[str, str]) -> str:
    return ", ".join(f"[{words}](docs/validation/{name}.md)" for name, words in names.items())


def as_shown(words: str) -> str:
    """The trust page's words of a target or an error, with its minus signs."""
    words = re.sub(r" everywhere| at each", "", words).replace("for ct ", "for C_T ").replace("for mu ", "for µ ")
    return re.sub(r"(?<![\w.])-(?=\d)", "−", words.replace("…", " to "))


def section() -> str:
    """The heading, the table of measured rotors and the sentence on the other sets."""
    sets = judged()
    measured = [row for row in sets.values() if row.kind == "validation"]
    met = sum(row.verdict == "met" for row in measured)
    lines = [
        "| measured rotor | target | error | verdict |",
        "| --- | --- | --- | --- |",
        *(
            f"| {linked(names)} | {cell(sets, names, 'target')} | {cell(sets, names, 'shown')} | "
            f"{cell(sets, names, 'verdict')} |"
            for names in ROTORS
        ),
    ]
    others = "; ".join(
        f"{linked({name: words})} {as_shown(sets[name].shown)} ({bound(sets[name])}{sets[name].verdict})"
        for name, words in OTHERS.items()
    )
    return (
        "## How far to trust it\n\n"
        "No model was tuned to these data; the uncertainty in hover was sized with points known. "
        f"{met} of {len(measured)} measured\nsets meet their target. [All comparisons](docs/validation.md), "
        "[what is not modelled](docs/validation.md#not-modelled).\n\n"
        + "\n".join(lines)
        + f"\n\nSections, theory and grid: {others}.\n\n"
    )


def cell(sets: dict[str, TrustRow], names: dict[str, str], field: str) -> str:
    """One cell of a line; sets that say the same are said once."""
    return "; ".join(dict.fromkeys(as_shown(getattr(sets[name], field)) for name in names))


def bound(row: TrustRow) -> str:
    """The target before the verdict, where the error does not state it itself."""
    return "" if row.shown == row.target else f"target {as_shown(row.target)}, "


def with_section(text: str) -> str:
    """The text with this section anew."""
    return re.sub(r"## How far to trust it\n.*?(?=## )", lambda _: section(), text, flags=re.DOTALL)


if __name__ == "__main__":
    README.write_text(with_section(README.read_text(encoding="utf-8")), encoding="utf-8")
