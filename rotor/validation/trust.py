"""How far to trust the numbers: sets of rows with one error each, for the page and for docs/validation.

The rows are made by runs (`python -m rotor reproduce OUT --trust`) and shipped as assets/trust.csv; a test recomputes
and compares them, so they stay current.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from rotor.support.assets import asset_path, csv_rows, toml_asset
from rotor.support.chart import Chart

Kind = Literal["validation", "indicative", "verification", "public code", "document"]
KINDS: dict[Kind, str] = {
    "validation": "Validation: against measurement",
    "indicative": "Indicative: against another model, or data of unclear origin",
    "verification": "Verification: against theory, identities and limits, and between our own theories",
    "public code": "Verification: against independent public codes, same controls and section data",
    "document": "Statements of the thesis (python -m rotor reproduce)",
}
"""Titles of the kinds of rows."""
LEFT_OUT = "Mean over rotors, each left out of the fit"
"""What the row states that tells how often the band of a power holds, in `rotor.validation.doubt`."""
Verdict = Literal["met", "missed", "fitted", "no target"]
VERDICTS: dict[Verdict, str] = {
    "met": "every point trims, and the rms error is within the target, which follows from the scatter of the measured "
    "points alone: a model without error would meet it in 19 of 20 tests; an identity holds within its bound",
    "missed": "a point does not trim, or the error is larger; the set's page states the reason if it is known",
    "fitted": "a constant of the model was chosen by these points, so they confirm nothing",
    "no target": "no scatter is known, so the error is shown and not judged",
}
"""What the verdicts mean."""


@dataclass(frozen=True)
class TrustRow:
    """One comparison of a computed with a reference value: a row of the trust page."""

    set: str
    """Name of its page in docs/validation."""
    kind: Kind
    what: str
    against: str
    shown: str
    """The error or verdict as people read it."""
    error: float | None
    """The error as a number; fractions, degrees or kilowatts in the unit of `shown`. None for a verdict."""
    allowed: float
    """How far `error` may move before the row is out of date; for an identity, the bound that `error` stays below."""
    test: str
    """The test that verifies it: file::function below tests/."""
    note: str = ""
    target: str = ""
    """In words; empty where none was set."""
    verdict: Verdict = "no target"

    @property
    def quantity(self) -> str:
        """What is compared, by whichever inflow model: `what` without the model."""
        return self.what.partition(", inflow ")[0]

    @property
    def bound(self) -> bool:
        """Whether `allowed` is a bound on the error (rounding, identities) rather than a tolerance about it."""
        return self.target.startswith("below")

    @property
    def remark(self) -> str:
        """Target, verdict and note in words."""
        judged = f"Target {self.target}: {self.verdict}." if self.target else ""
        return f"{judged} {self.note}".strip()


@dataclass(frozen=True)
class TrustSet:
    """What is compared with one source: rows, charts and the words around them. Each has a page."""

    name: str
    title: str
    compared: str
    """What is compared, in a few words."""
    error: str
    """For the summary."""
    source: str
    rows: tuple[TrustRow, ...]
    charts: tuple[Chart, ...]
    """The first is also the small picture of the summary."""
    text: tuple[str, ...] = ()
    """Paragraphs that hold for all rows."""
    points: tuple[tuple[str, ...], ...] = ()
    """Every compared number as a table; the first row is its heading."""
    tried: tuple[tuple[str, ...], ...] = ()
    """Causes that were tried, with what each gives, as a table; the first row is its heading."""
    labels: tuple[str, ...] = ()
    """Name of each row in the table of the page, whose source is then that of all rows; empty: `what` without the
    title."""

    @property
    def verdict(self) -> Verdict:
        """Missed if one row is, no target if none has one."""
        verdicts = {row.verdict for row in self.rows}
        return "missed" if "missed" in verdicts else "met" if "met" in verdicts else "no target"


def quantities_met(rows: Iterable[TrustRow]) -> dict[tuple[str, str], bool]:
    """Whether each quantity with a target meets it with every inflow model compared, by page and name."""
    met: dict[tuple[str, str], bool] = {}
    for row in rows:
        if row.target:
            key = (row.set, row.quantity)
            met[key] = met.get(key, True) and row.verdict == "met"
    return met


def rms(values: ArrayLike) -> float:
    """Root mean square, in the unit of the values."""
    return float(np.sqrt(np.mean(np.square(values))))


@dataclass(frozen=True)
class SetDescription:
    """What one set compares, in words; its rows and charts are computed."""

    name: str
    title: str
    compared: str
    source: str
    test: str
    """`file::function` below tests/ of the rows that name no other."""
    kind: Kind = "validation"
    against: str = ""
    """What the rows are compared with; empty: the source."""
    text: tuple[str, ...] = ()
    notes: Mapping[str, str] = field(default_factory=dict[str, str])
    """Remarks on rows, by a word for the row."""
    tried: tuple[tuple[str, ...], ...] = ()
    """Causes that were tried, as of `TrustSet`."""

    def row(
        self, what: str, shown: str, error: float, allowed: float, *, test: str = "", note: str = "", target: str = "",
        met: bool | None = None, against: str = "",
    ) -> TrustRow:  # fmt: skip
        """A row of this set.

        test: function in the file of `self.test`, or with a file of its own. note: a word of `notes`, or the remark.
        met: whether the target is; None without one.
        """
        return TrustRow(
            self.name, self.kind, what, against or self.against or self.source, shown, error, allowed,
            test if "::" in test else f"{self.test.partition('::')[0]}::{test}" if test else self.test,
            self.notes.get(note, note), target, "no target" if met is None else "met" if met else "missed",
        )  # fmt: skip

    def share(
        self,
        what: str,
        error: float,
        allowed: float,
        *,
        unit: str = "%",
        digits: int = 1,
        **more: Any,
    ) -> TrustRow:
        """A row whose error is a part of something, shown in per cent or points of per cent."""
        return self.row(what, f"{100 * error:+.{digits}f} {unit}", error, allowed, **more)

    def bound(
        self, what: str, against: str, error: float, below: float, test: str, note: str = ""
    ) -> TrustRow:
        """A row whose error is rounding or discretisation: its size matters, not its digits."""
        met, target = abs(error) <= below, f"below {below:.0e}"
        shown = target if met else f"{abs(error):.1e}"
        return self.row(
            what,
            shown,
            abs(error),
            below,
            test=test,
            note=note,
            target=target,
            met=met,
            against=against,
        )

    def page(
        self, error: str, rows: Iterable[TrustRow], charts: Iterable[Chart], *, compared: str = "",
        text: Iterable[str] | None = None, points: Iterable[Sequence[str]] = (), labels: Iterable[str] = (),
    ) -> TrustSet:  # fmt: skip
        """The set with what was computed; `compared` and `text` where numbers stand in them."""
        return TrustSet(
            self.name, self.title, compared or self.compared, error, self.source, tuple(rows), tuple(charts),
            self.text if text is None else tuple(text), tuple(map(tuple, points)), self.tried,
            tuple(labels),
        )  # fmt: skip


def description(name: str) -> SetDescription:
    """The words of a set of the trust page."""
    record: dict[str, Any] = dict(toml_asset("trust_sets.toml")[name])
    record["text"] = tuple(record.get("text", ()))
    record["tried"] = tuple(tuple[str, ...](row) for row in record.get("tried", ()))
    return SetDescription(name, **record)


def coverage() -> float:
    """Part of measured powers within the band that is called 68 %, for rotors that had no part in its fit."""
    share = next(row.error for row in trust_rows() if row.what == LEFT_OUT)
    assert share is not None
    return share


@cache
def trust_rows() -> tuple[TrustRow, ...]:
    """The shipped rows, in the order of their pages; ValueError for a kind or a verdict that is not known."""
    rows: list[TrustRow] = []
    for cells in csv_rows(asset_path("trust.csv")):
        for name, known in (("kind", KINDS), ("verdict", VERDICTS)):
            if cells[name] not in known:
                raise ValueError(
                    f"trust.csv has a row of {name} {cells[name]!r}: use one of {', '.join(known)}"
                )
        row: dict[str, Any] = {**cells, "allowed": float(cells["allowed"])}
        row["error"] = float(cells["error"]) if cells["error"] else None
        rows.append(TrustRow(**row))
    return tuple(rows)
