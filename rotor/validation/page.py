"""The trust page: a summary with one row a set, and a page with charts and numbers for each.

A further set is its words in `assets/trust_sets.toml` (`SetDescription`), and one function that returns a `TrustSet`,
listed in `SETS` under its name. Its rows give the numbers and verdicts, its charts are drawn from the same numbers:
`Points` for what was measured, `Line` for what is computed. The function runs when the page is made, and may be slow.
Each row names the test that recomputes it. `python -m rotor validate NAME --page DIR` shows it alone; `make trust`
makes all of it anew.
"""

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import astuple, fields
from functools import partial
from pathlib import Path

from rotor.support.chart_svg import small_svg, svg
from rotor.support.markup import tag
from rotor.support.user_input import csv_text, write_whole
from rotor.validation import flown, hart2, stall_loops, uh60a, verification
from rotor.validation.airloads import PITCH_LINK
from rotor.validation.compare import PAGES as MEASURED
from rotor.validation.compare import measured_set
from rotor.validation.doubt import NAME as DOUBT_SET
from rotor.validation.doubt import doubt_set
from rotor.validation.inflow import SET as INFLOW_SET
from rotor.validation.inflow import inflow_set
from rotor.validation.trust import KINDS, VERDICTS, TrustRow, TrustSet, quantities_met

SETS: dict[str, Callable[[], TrustSet]] = {
    **{name: partial(measured_set, name) for name in MEASURED},
    INFLOW_SET: inflow_set,
    hart2.SET: hart2.hart2_set,
    flown.AIRLOADS: flown.gazelle_set,
    PITCH_LINK: uh60a.pitch_link_set,
    flown.POWERS: flown.flown_set,
    DOUBT_SET: doubt_set,
    stall_loops.SET: stall_loops.loops_set,
    "sc1095": uh60a.section_set,
    "uh60a-constants": uh60a.constants_set,
    "uh60a-forward": uh60a.forward_set,
    "theory": verification.theory_set,
    "dynbem": verification.dynbem_set,
    "ccblade": verification.ccblade_set,
}
"""Maker of each set by its name. Statements of the thesis come from its figures
(`rotor.validation.thesis.catalogue`)."""
LONGEST = 64
"""Letters of a cell that fit into two lines; a test holds it, so that a long run is not lost for a word."""
FOLDER = "validation"
"""Folder of the sets' pages, beside the summary."""
_HEADING = (
    "# Made by: make trust. Read by rotor/validation/trust.py; docs/validation.md shows it.\n"
)
_AGAINST = {
    "validation": "measurement",
    "indicative": "indicative",
    "verification": "theory",
    "public code": "public code",
    "document": "thesis",
}
_ASKS = {
    "validation": "Are these the right equations? No measured forward-flight power of the UH-60A and no measured "
    "benefit of active twist were available; published figures of both are computed. No usable measurement shows what "
    "built-in twist saves.",
    "indicative": "These sets compare with another model, or with data whose origin or test is unclear. They prove "
    "nothing.",
    "verification": "Are the equations solved correctly?",
    "public code": "Do independent codes give the same results?",
    "document": "These are statements of the thesis beside our results.",
}
_RAISED = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
NOT_MODELLED = (
    "a tiltrotor's second rotor, download on its wing and axial cruise",
    "blade bending, unless switched on; torsion, if the rotor file has no blade structure",
    "lift and stall in yawed flow: radial flow changes only section drag",
    "change of lift slope due to the swept tip",
    "the trailing-edge tab of the UH-60A, at 0.73 to 0.86 R: 0.01 of C_m there would twist the tip by about 0.3°",
    "roll-up and contraction of the wake, which decide the value of twist up to µ 0.15 ([theory](theory.md), §9)",
    "the airframe except its drag and download: no upwash, no lift, no interference with the tail",
    "measured section data: XFOIL computes them, with levels and shocks from public tunnel-derived data; see "
    "[assets/airfoils/CITATION.md](../assets/airfoils/CITATION.md)",
    "drag of a rough surface, unless the rotor file states it (surface_drag)",
    "inflow below µ 0.05 (0.075 with linear inflow), where no model is proven: wakes that respond to the load are "
    "interpolated to the hover model",
    "the vortex ring state; climb and descent are verified against theory, not measurement",
)


def write_trust(sets: Iterable[TrustSet], folder: Path) -> Path:
    """Write the CSV file, the summary and every page below a folder; the path of the summary."""
    order = list(KINDS)
    sets = sorted(sets, key=lambda data: order.index(data.rows[0].kind))
    write_whole(folder / "trust.csv", trust_csv(row for data in sets for row in data.rows))
    for data in sets:
        write_set(data, folder)
    path = folder / "validation.md"
    write_whole(path, summary(sets))
    return path


def trust_csv(rows: Iterable[TrustRow]) -> str:
    """assets/trust.csv."""
    cells = ([_plain(cell) for cell in astuple(row)] for row in rows)
    return csv_text([[field.name for field in fields(TrustRow)], *cells], _HEADING)


def write_set(data: TrustSet, folder: Path) -> Path:
    """Write the page of a set, its pictures and its tables into `folder`/validation; the path of the page."""
    folder = folder / FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    for k, chart in enumerate(data.charts):
        write_whole(folder / _picture(data, k), svg(chart))
    write_whole(folder / f"{data.name}-small.svg", small_svg(data.charts[0]))
    for file, _, rows in _tables(data):
        write_whole(
            folder / file,
            csv_text(rows, f"# {data.title}. {_source(data)}\n# Made by: make trust\n"),
        )
    path = folder / f"{data.name}.md"
    write_whole(path, set_page(data))
    return path


def summary(sets: Sequence[TrustSet]) -> str:
    """docs/validation.md."""
    parts: list[str] = []
    for kind, against in _AGAINST.items():
        rows = [
            (
                f"![]({FOLDER}/{data.name}-small.svg)", f"[{data.title}]({FOLDER}/{data.name}.md)",
                _capital(data.compared), data.error, _verdict_of_page(data),
            )
            for data in sets if data.rows[0].kind == kind
        ]  # fmt: skip
        table = _table(("", "Set", "Compared", "Error", "Verdict"), rows)
        parts += [f"## {_capital(against)}", _ASKS[kind], table] if rows else []
    words = "; ".join(f"**{word}**: {meaning}" for word, meaning in VERDICTS.items())
    return _page(
        "---\nhide-toc: true\n---",
        "# How far to trust the numbers",
        "Two things are fitted to these points: the wake path, to the tip vortices of HART II, and the sizes of the "
        f"model errors in [bands](validation/doubt.md), to powers. {words}. A page is missed if one of its quantities "
        "is; the tables count those that meet their target. A quantity is missed if one of the inflow models shown "
        "misses it. For the uncertainty of a power and of the best twist, see [uncertainty](guide/doubt.md).",
        *parts,
        "## Not modelled",
        "\n".join(f"- {item}" for item in NOT_MODELLED),
        "```{toctree}\n:hidden:\n" + "".join(f"{FOLDER}/{data.name}\n" for data in sets) + "```",
    )


def set_page(data: TrustSet) -> str:
    """docs/validation/NAME.md."""
    kind = data.rows[0].kind
    labels = data.labels or [row.what.removeprefix(f"{data.title}: ") for row in data.rows]
    judged = kind == "document" or any(row.target for row in data.rows)
    remarks = [row.note for row in data.rows]
    short = all(0 < len(note) <= LONGEST for note in remarks) and 1 < len({*remarks}) == len(
        remarks
    )
    in_table = short and data.verdict != "missed"
    columns = {
        "": labels,
        "Against": [row.against for row in data.rows],
        "Error": [row.shown for row in data.rows],
        "Target": [row.target for row in data.rows],
        "Verdict": [
            "" if row.verdict == "no target" else _verdict(row.verdict) for row in data.rows
        ],
        "Remark": remarks,
    }
    if data.labels or len({*columns["Against"]}) == 1:
        del columns["Against"]  # The source is named above.
    if not judged:
        del columns["Target"], columns["Verdict"]
    notes: dict[str, list[str]] = {}
    if not in_table:
        del columns["Remark"]
        for label, note in zip(labels, remarks, strict=True):
            notes.setdefault(note, []).append(label)
        notes.pop("", None)
    words = [_table(tuple(columns), zip(*columns.values(), strict=True)), *data.text]
    if kind == "document":  # Whole sentences, for which a table has no room.
        words = [
            *data.text,
            *(
                f"**{row.what}: {row.shown}.** {row.against} *Here:* {row.note}"
                for row in data.rows
            ),
        ]
    elif notes:
        words.append("## Why it is missed" if data.verdict == "missed" else "## Remarks")
        heads = (
            "; ".join(of) if len(of) < 3 else f"{of[0]} and {len(of) - 1} more"
            for of in notes.values()
        )
        words += [
            note if len(notes) == 1 and not data.labels else f"- {head}: {note}"
            for head, note in zip(heads, notes, strict=True)
        ]
    pictures = [
        f"![{chart.title if chart.title != data.title else ''}]({_picture(data, k)})"
        for k, chart in enumerate(data.charts)
    ]
    # Of several sets the table comes first: it is what compares them.
    body = [*words, *pictures] if data.labels else [*pictures, *words]
    return _page(
        f"# {data.title}",
        f"{_AGAINST[kind].capitalize()}: {data.compared}. {_source(data)}{'' if judged else ' No target is set.'}",
        *body,
        " ".join(
            (
                *(f"[{words}]({file})." for file, words, _ in _tables(data)),
                f"Tests: {_tests(data)}.",
                "[All sets](../validation.md).",
            )
        ),
    )


def _tables(data: TrustSet) -> Iterator[tuple[str, str, Sequence[Sequence[str]]]]:
    """The CSV files beside the page of a set: name, what it holds, rows."""
    if data.points:
        yield f"{data.name}.csv", "Every point", data.points
    if data.tried:
        yield f"{data.name}-tried.csv", "Every cause that was tried", data.tried


def _tests(data: TrustSet) -> str:
    """The tests of the rows; of more than three their files."""
    tests = dict.fromkeys(row.test for row in data.rows)
    if len(tests) > 3:
        tests = dict.fromkeys(test.partition("::")[0] for test in tests)
    return ", ".join(f"`{test}`" for test in tests)


def _source(data: TrustSet) -> str:
    return f"Source: {data.source.rstrip('.')}."


def _page(*parts: str) -> str:
    """Markdown with minus signs, powers of ten, and the indices of C_T and the like set low."""
    text = re.sub(r"(?<![\w.\-/`])-(?=\d)", "−", "\n\n".join(parts))
    text = re.sub(
        r"\b(\d\.\d)e-0*(\d+)\b",
        lambda number: f"{number[1]} · 10⁻{number[2].translate(_RAISED)}",
        text,
    )
    text = re.sub(
        r"\b1e-0*(\d+)\b", lambda number: "10⁻" + number[1].translate(_RAISED), text
    ).replace(" %", "\u00a0%")
    return (
        re.sub(r"\b([CUc])_(\w)\b", lambda index: index[1] + str(tag("sub", index[2])), text) + "\n"
    )


def _table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    head, *cells = (
        f"| {' | '.join(line)} |"
        for line in (heads, *([cell.replace("|", "\\|") for cell in row] for row in rows))
    )
    return "\n".join((head, f"|{'---|' * len(heads)}", *cells))


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]


def _verdict(word: str) -> str:
    return f"**{word}**" if word == "missed" else word


def _verdict_of_page(data: TrustSet) -> str:
    """The verdict; where quantities of several miss their target, also how many meet it."""
    met = quantities_met(data.rows).values()
    word = _verdict(data.verdict)
    if data.verdict != "missed" or len(met) == 1:
        return word
    return f"{word}: {sum(met)} of {len(met)} meet it"


def _picture(data: TrustSet, k: int) -> str:
    return f"{data.name}{f'-{k + 1}' if k else ''}.svg"


def _plain(cell: str | float | None) -> str:
    return cell if isinstance(cell, str) else "" if cell is None else f"{cell:.6g}"
