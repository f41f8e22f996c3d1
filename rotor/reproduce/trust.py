"""How far to trust the numbers: rows of text and one error each, for the page and for docs/validation.md.

The rows are made by runs (`python -m rotor reproduce OUT --trust`) and shipped as assets/trust.csv and
assets/sensitivity.csv; a test recomputes and compares them, so they stay current.
"""

from dataclasses import dataclass, fields
from functools import cache
from pathlib import Path
from typing import Literal, get_args

from rotor.assets import asset_path, csv_rows

Kind = Literal["verification", "public code", "validation", "indicative", "document"]
KINDS: dict[Kind, str] = {
    "verification": "Verification: against theory, identities and limits, and between our own theories",
    "public code": "Verification: against independent public codes, same controls and section data",
    "validation": "Validation: against measurement",
    "indicative": "Indicative: against another model, or data of unclear origin",
    "document": "Statements of the thesis (python -m rotor reproduce)",
}
"""Titles of the kinds of rows."""


@dataclass(frozen=True)
class TrustRow:
    """One comparison."""

    kind: Kind
    what: str
    against: str
    shown: str
    """The error or verdict as people read it."""
    error: float | None
    """As a number; fractions, degrees or kilowatts in the unit of `shown`. None for a verdict."""
    allowed: float
    """How far `error` may move before the row is out of date; for an identity, the bound that `error` stays below."""
    test: str
    """The test that verifies it: file::function below tests/."""
    note: str = ""

    @property
    def bound(self) -> bool:
        """Whether `allowed` is a bound on the error (rounding, identities) rather than a tolerance about it."""
        return self.shown.startswith("below")


@dataclass(frozen=True)
class SensitivityRow:
    """Change of the best linear twist and its saving with one choice."""

    change: str
    mu: float
    optimum_deg: float
    low_deg: float
    high_deg: float
    """The band within 0.1 % of the least power [° per radius]."""
    total_kw: float
    saving_percent: float
    """Of total power, against linear −16° under the same choice."""


@cache
def trust_rows() -> tuple[TrustRow, ...]:
    """The shipped rows, in order of kind."""
    return read_trust(asset_path("trust.csv"))


@cache
def sensitivity_rows() -> tuple[SensitivityRow, ...]:
    """The shipped sensitivities; rows of one change together."""
    return tuple(
        SensitivityRow(row["change"], *(float(row[field.name]) for field in fields(SensitivityRow)[1:]))
        for row in csv_rows(asset_path("sensitivity.csv"))
    )


def read_trust(path: Path) -> tuple[TrustRow, ...]:
    """Rows of a trust file; ValueError for a kind that is not known."""
    rows: list[TrustRow] = []
    for row in csv_rows(path):
        kind = next((kind for kind in get_args(Kind) if kind == row["kind"]), None)
        if kind is None:
            raise ValueError(f"{path.name} has a row of kind {row['kind']!r}: use one of {', '.join(KINDS)}")
        error = float(row["error"]) if row["error"] else None
        rows.append(
            TrustRow(
                kind, row["what"], row["against"], row["shown"], error, float(row["allowed"]), row["test"], row["note"]
            )
        )
    return tuple(rows)
