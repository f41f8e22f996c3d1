"""Write the table of README.md that says how far to trust the program: `python -m tests.tools.readme`.

`make trust` runs it. The rule leaves no choice: every set of assets/trust.csv that has a target is in the table, as
missed if any row of it missed, with the worst point, else the error, of the first row that decides, and its target in
brackets. What is not modelled is what `docs/validation.md` says.
"""

import re
from pathlib import Path

from rotor.validation.page import NOT_MODELLED
from rotor.validation.trust import TrustRow, trust_rows

README = Path(__file__).parents[2] / "README.md"
SHORT = {
    "xv15-hover": "XV-15 hover power",
    "xv15-forward-15deg": "XV-15 torque, tilted",
    "xv15-forward-0deg": "XV-15 torque, upright, C_Q/σ",
    "pca2": "PCA-2 autogiro",
    "knight-hefner-3": "Knight–Hefner, three blades",
    "knight-hefner-4": "four",
    "caradonna-tung-lift": "Caradonna–Tung, section C_l",
    "hart2-airloads": "HART II airloads, correlation",
    "gazelle-airloads": "Gazelle airloads, correlation",
    "flown-power": "Gazelle power, shape",
    "glasgow-loops": "pitching aerofoil, C_m",
    "sc1095": "SC1095 drag",
    "theory": "theory",
    "grid": "grid, linear inflow",
}
"""What a set is called where words are few; else its name."""


def judged() -> dict[str, TrustRow]:
    """By set with a target the first row that missed it, or else that met it."""
    found: dict[str, TrustRow] = {}
    for row in trust_rows():
        if row.target and (row.set not in found or (found[row.set].verdict, row.verdict) == ("met", "missed")):
            found[row.set] = row
    return found


def beside_target(row: TrustRow) -> str:
    """The worst point, else the error, and the target in the same unit; a bound says it in one."""
    shown, target = row.shown.rpartition("worst ")[2], re.split(r" for | everywhere| at each", row.target)[0]
    return shown if shown == target else f"{shown} ({target})"


def table() -> str:
    """The rows below the head of the table."""
    sets = judged()
    cells = {
        f"**{verdict}: {sum(row.verdict == verdict for row in sets.values())} of {len(sets)} sets**": ", ".join(
            f"[{SHORT.get(name, name)}](docs/validation/{name}.md) {beside_target(row)}"
            for name, row in sets.items()
            if row.verdict == verdict
        )
        for verdict in ("met", "missed")
    }
    cells["**not modelled, or not proven**"] = "; ".join(re.split(r"[,:;.] ", one)[0] for one in NOT_MODELLED)
    return "".join(f"| {head} | {cell} |\n" for head, cell in cells.items())


def with_table(text: str) -> str:
    """The text with its table anew."""
    return re.sub(r"(?<=\| --- \| --- \|\n)(\| \*\*.*\n)+", lambda _: table(), text)


if __name__ == "__main__":
    README.write_text(with_table(README.read_text(encoding="utf-8")), encoding="utf-8")
