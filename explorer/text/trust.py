"""The trust page as HTML: what the numbers were set against, how far they are off, and which test holds it."""

from collections.abc import Iterable
from html import escape
from itertools import groupby

from explorer.text.units import number
from rotor.reproduce.report import typographic
from rotor.reproduce.trust import KINDS, SensitivityRow, TrustRow, sensitivity_rows, trust_rows


def trust_page() -> str:
    """Comparisons by kind, then how optimum and saving move with the models."""
    parts = [
        '<div class="rx rx-small rx-trust" data-explorer="trust">',
        '<div class="rx-dim">Point at a row for the test that holds it. Made by runs: '
        "<i>python -m rotor reproduce OUT --trust</i>; in full in docs/validation.md.</div>",
    ]
    for kind, title in KINDS.items():
        rows = "".join(_row(row) for row in trust_rows() if row.kind == kind)
        parts.append(f"<h4>{escape(title)}</h4>{rows}")
    parts.append("<h4>Best linear twist and what it saves against −16°, choice by choice</h4>")
    speeds = dict.fromkeys(row.mu for row in sensitivity_rows())
    parts.append(_cells("hover" if mu == 0.0 else f"µ {mu:g}" for mu in speeds))
    parts.extend(_change(change, list(rows)) for change, rows in groupby(sensitivity_rows(), lambda row: row.change))
    return "".join([*parts, "</div>"])


def _row(row: TrustRow) -> str:
    hint = escape(". ".join(part.rstrip(".") for part in (row.note, row.test) if part), quote=True)
    return (
        f'<div class="rx-trust-row" title="{hint}"><span>{escape(row.what)} '
        f'<span class="rx-dim">{escape(typographic(row.against))}</span></span>'
        f"<b>{escape(typographic(row.shown))}</b></div>"
    )


def _change(change: str, rows: list[SensitivityRow]) -> str:
    found = _cells(f"{number(row.optimum_deg, 1)}°, {number(row.saving_percent, 1)} %" for row in rows)
    return f'<div class="rx-trust-change">{escape(change)}{found}</div>'


def _cells(texts: Iterable[str]) -> str:
    """Side by side, one a speed."""
    return f'<div class="rx-dim rx-trust-speeds">{"".join(f"<span>{text}</span>" for text in texts)}</div>'
