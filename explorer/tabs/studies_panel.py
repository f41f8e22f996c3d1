"""Open the result of a study, look at it in charts, and take a point of it onto the sliders."""

import json
import logging
import os
import threading
from collections.abc import Callable
from contextlib import suppress
from functools import lru_cache, partial
from html import escape
from pathlib import Path

import viser

from explorer.model.inputs import inputs_of
from explorer.model.units import number
from explorer.sharing import share
from explorer.tabs import study_charts
from explorer.tabs.context import Tab, TabContext
from explorer.tabs.layout import by_hand
from explorer.tabs.study_charts import FIELD, axis_names, title, value_text
from explorer.text.glossary import hint
from rotor.assets import asset_path
from rotor.study.chunks import ABOUT
from rotor.study.results import (
    Results,
    best_row,
    cruise_speeds,
    design_of_row,
    hover_cruise_pairs,
    read_bounded,
    read_results,
)
from rotor.user_input import brief, is_file

_DEPTH = 3
_MOST_FOLDERS = 3000
"""Looked into: a home folder must not hold the page up."""


def find_studies(root: Path) -> dict[Path, str]:
    """Folders that hold a study and its title, at most so deep beneath `root`, which itself may be one; by name."""
    studies: dict[Path, str] = {}
    looked, level = 0, [root]
    for _ in range(_DEPTH + 1):
        below: list[Path] = []
        for folder in level:
            looked += 1
            if looked > _MOST_FOLDERS:
                break
            if is_file(folder / ABOUT):
                studies[folder] = _title(folder)
                continue  # A study has nothing beneath it.
            with suppress(OSError):
                below += [one for one in sorted(folder.iterdir()) if one.is_dir() and one.name[0] not in "._"]
        level = below
    return dict(sorted(studies.items()))


def open_study(path: Path) -> Results:
    """The results in a folder, as far as they are there; read once for all pages. ValueError with one sentence."""
    chunks = [one.stat().st_mtime_ns for one in path.glob("chunk-*.parquet")]
    return _read(path, len(chunks), max(chunks, default=0))


@lru_cache(maxsize=3)
def _read(path: Path, chunks: int, newest: int) -> Results:
    del chunks, newest  # They only tell a study that has gone on from what was read of it before.
    return read_results(path, texts=False)


def _title(folder: Path) -> str:
    try:
        return str(json.loads((folder / ABOUT).read_text(encoding="utf-8"))["title"])
    except (OSError, ValueError, KeyError, TypeError):
        return ""


def summary(results: Results) -> str:
    """What was opened: title, points, failures, how many are drawn."""
    failed = results.rows - int(results.good.sum())
    words = [f"{number(results.rows)} of {number(results.points)} points"]
    if failed:
        words.append(f"{number(failed)} failed")
    if results.rows - failed > study_charts.MOST_POINTS:
        words.append(f"{number(study_charts.MOST_POINTS)} drawn")
    return f"{results.about.get('title', '')}: {', '.join(words)}."


def numbers(results: Results) -> str:
    """The numbers of the available points."""
    points = results.columns["point"]
    gaps = ", some not computed yet" if points[-1] - points[0] >= results.rows else ""
    return f"{points[0]:.0f}…{points[-1]:.0f}{gaps}"


def point_line(results: Results, row: int | None, heading: str) -> str:
    """A small table of a point: power, and the value of every axis."""
    if row is None:
        return ""
    cells = "".join(
        f"<tr><td>{escape(title(results, name))}</td>"
        f'<td class="rx-num">{escape(value_text(results, name, row))}</td></tr>'
        for name in axis_names(results, "power_total_w", "hover_power_w")
    )
    head = f"<b>{escape(heading)}: point {results.columns['point'][row]:.0f}</b>"
    return f'<div class="rx rx-small" data-explorer="study-point">{head}<table>{cells}</table></div>'


_log = logging.getLogger(__name__)

SCATTER, FRONT = "Scatter", "Hover against cruise"
_NONE = "Choose …"
_EMPTY = (
    "No results in the folder that the page reads (python -m explorer --studies DIR). To make one there: "
    "python -m rotor study hover_cruise.toml"
)
_HINT = (
    "Results of <code>python -m rotor study FILE.toml</code>. Click a point to put its blade and flight condition on "
    "the sliders."
)


class StudiesPanel(Tab):
    def __init__(self, context: TabContext, root: Path) -> None:
        """`root`: results beneath it are offered."""
        self._context, self._root = context, root
        self._results: Results | None = None
        self._now: int | None = None
        self._asked = 0
        """Counts what was asked to be opened: what comes late is passed over."""
        self._studies: dict[str, Path] = {}
        self._lock = threading.RLock()
        gui = context.gui
        gui.add_html(f'<div class="rx rx-dim rx-small">{_HINT}</div>')
        self._menu = _menu(gui, "Result", "study", visible=True)
        with gui.add_folder("Not in the list?", expand_by_default=False):
            look = gui.add_button(
                "Look for new results", icon=viser.Icon.REFRESH, color="gray", hint=hint("study_look")
            )
            file = gui.add_upload_button(
                "Open a Parquet file", icon=viser.Icon.UPLOAD, color="gray", mime_type=".parquet",
                hint=hint("study_file"),
            )  # fmt: skip
        self._state = gui.add_html("")
        self._kind = _menu(gui, "Chart", "study_chart")
        self._x = _menu(gui, "Horizontal", "study_axis")
        self._y = _menu(gui, "Vertical", "study_axis")
        self._colour = _menu(gui, "Colour", "study_colour")
        self._cruise = _menu(gui, "Cruise at", "study_cruise")
        self._chart = gui.add_html("")
        self._point = gui.add_text(FIELD, "", visible=False, hint=hint("study_point"))
        self._point_row = gui.add_html("")
        by_hand(self._menu, self._chosen)
        look.on_click(lambda _: self.look())
        file.on_upload(lambda event: self._uploaded(event.target.value))
        for menu in (self._kind, self._x, self._y, self._colour, self._cruise):
            by_hand(menu, lambda _: self._draw())
        by_hand(self._point, self._apply)
        threading.Thread(target=self.look, name="studies", daemon=True).start()

    def look(self) -> None:
        shipped = find_studies(asset_path("studies"))
        known = {folder.resolve() for folder in shipped}
        own = [folder for folder in find_studies(self._root) if folder.resolve() not in known]
        studies = {os.path.relpath(folder, self._root): folder for folder in own}
        studies |= {f"Shipped: {title}": folder for folder, title in shipped.items()}
        self._studies = studies
        kept = self._menu.value if self._menu.value in studies else _NONE
        self._menu.options = (_NONE, *studies)
        self._menu.value = kept
        if not studies:
            self._say(_EMPTY)

    def open(self, read: Callable[[], Results], name: str) -> None:
        """Read a result in the background and show it; what was asked for later wins."""
        self._asked += 1
        asked = self._asked
        self._say(f"Reading {name} …")

        def work() -> None:
            try:
                results = read()
                if not results.good.any():
                    raise ValueError(f"{name} has no converged point: {results.rows} rows, all failed.")
                with self._lock:
                    if asked == self._asked:
                        self._show(results)
            except ValueError as error:
                if asked == self._asked:
                    self._say(brief(error), "problem")
            except Exception as error:  # A file in a state that nobody foresaw must leave the tab alive.
                _log.exception("a study could not be shown")
                if asked == self._asked:
                    self._say(brief(f"{name} cannot be shown ({error}): choose another result."), "problem")

        threading.Thread(target=work, name="studies", daemon=True).start()

    def stop(self) -> None:
        """What is being read is no longer wanted."""
        self._asked += 1

    def _chosen(self, label: str) -> None:
        folder = self._studies.get(label)
        if folder is not None:
            self.open(lambda: open_study(folder), folder.name)

    def _uploaded(self, file: viser.UploadedFile) -> None:
        self.open(lambda: read_bounded(file.content, file.name), file.name)

    def _show(self, results: Results) -> None:
        """A new result: offer what can be drawn of it, and draw."""
        self._results, self._now = results, None
        names = study_charts.choices(results)
        titles = [title(results, name) for name in names]
        self._names = dict(zip(titles, names, strict=True))
        power = title(results, "power_total_w")
        first = [one for one in titles if one != power] or titles
        for menu, value in (
            (self._x, first[0]),
            (self._y, power if power in titles else titles[-1]),
            (self._colour, first[min(1, len(first) - 1)]),
        ):
            menu.options = tuple(titles)
            menu.value = value
        speeds = cruise_speeds(results)
        self._speeds = {f"µ {speed:g}": speed for speed in speeds}
        self._cruise.options = tuple(self._speeds) or ("",)
        self._cruise.value = list(self._speeds)[-1] if self._speeds else ""
        self._kind.options = (SCATTER, FRONT) if speeds else (SCATTER,)
        self._kind.value = FRONT if speeds else SCATTER
        self._kind.visible = self._point.visible = True
        self._say(summary(results), "done")
        self._point.value = ""
        self._point_row.content = point_line(results, best_row(results, "power_total_w"), "Least power")
        self._draw()

    def _draw(self) -> None:
        with self._lock:
            results = self._results
            if results is None:
                return
            kind = self._kind.value
            self._x.visible = self._y.visible = kind == SCATTER
            self._colour.visible = kind != FRONT
            self._cruise.visible = kind == FRONT
            if kind == FRONT:
                speed = self._speeds[self._cruise.value]
                pairs = hover_cruise_pairs(results, speed)
                self._chart.content = study_charts.front(results, pairs, speed, self._now)
            else:
                x, y, colour = (self._names[menu.value] for menu in (self._x, self._y, self._colour))
                self._chart.content = study_charts.scatter(results, x, y, colour, self._now)

    def _apply(self, text: str) -> None:
        """Put the point in the field onto the sliders."""
        results, text = self._results, text.strip()
        if results is None or not text:
            return
        try:
            row = results.row_of(int(text)) if text.isdecimal() else None
            if row is None:
                raise ValueError(f"{text!r} is not a point: type a number in {numbers(results)}.")
            if not results.good[row]:
                raise ValueError(f"Point {text} did not converge: choose another one.")
            tell = partial(self._context.notify, share.RETIRED_TITLE)
            inputs = share.within(inputs_of(design_of_row(results, row, tell)))
        except ValueError as error:
            sentence = escape(str(error))
            self._point_row.content = f'<div class="rx rx-small rx-broken" data-explorer="study-point">{sentence}</div>'
            return
        self._now = row
        self._point_row.content = point_line(results, row, "Applied")
        self._context.set_inputs(inputs)
        self._draw()

    def _say(self, sentence: str, kind: str = "idle") -> None:
        tone = " rx-broken" if kind == "problem" else ""
        self._state.content = (
            f'<div class="rx rx-small{tone}" data-explorer="study-state" data-kind="{kind}">{escape(sentence)}</div>'
        )


def _menu(gui: viser.GuiApi, label: str, entry: str, *, visible: bool = False) -> viser.GuiDropdownHandle[str]:
    """A menu without choices yet; `entry`: its sentence in the glossary."""
    nothing: list[str] = [_NONE]
    return gui.add_dropdown(label, tuple(nothing), visible=visible, hint=hint(entry))
