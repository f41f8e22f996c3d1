"""The Export folder: picture, report, tables, design file and the shape of the blade."""

import io
import json
import logging
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from viser.transforms import SO3

from explorer.charts.plots import PowerCurves
from explorer.export.blade import blade_stl
from explorer.export.contents import DesignReport, ReportEntry
from explorer.export.live import live_html
from explorer.export.provenance import file_name, tables_zip
from explorer.export.report import report_html
from explorer.export.view_picture import CARDS, HEIGHT, SHAPES, view_png
from explorer.model.inputs import baseline_title
from explorer.model.session_state import SessionState
from explorer.model.units import units_of
from explorer.picture.camera_views import FIELD_OF_VIEW, Camera, camera_axes, seen_at
from explorer.picture.fields import FIELDS
from explorer.scene.controller import SceneController
from explorer.scene.still_scene import make_stage
from explorer.text.glossary import hint
from explorer.views.actuated import actuated_blade
from explorer.views.line import line_text, works
from explorer.views.page_state import PageState
from explorer.widgets.actuator.actuator_panel import ActuatorPanel
from explorer.widgets.context import TabContext
from explorer.widgets.history_panel import HistoryPanel
from explorer.workers.call import at_once
from rotor.support.markup import tag

_log = logging.getLogger(__name__)
_PATIENCE = 90.0
"""[s] for the page to draw; browsers that draw in software take some."""
_PICTURES = tuple(f"{shape}{ground}" for shape in SHAPES for ground in ("", ", transparent"))


class ExportPanel:
    """The exports of a session. Each file is made on a thread of its own, one at a time; what fails is a sentence."""

    def __init__(
        self,
        context: TabContext,
        scene: SceneController,
        history: HistoryPanel,
        actuator: ActuatorPanel,
        now: Callable[[], PageState],
    ) -> None:
        """`now`: all that is known."""
        self._context, self._scene, self._history, self._actuator = (
            context,
            scene,
            history,
            actuator,
        )
        self._now = now
        self._busy = threading.Lock()
        self._curves = PowerCurves()
        with context.gui.add_folder("Export"):
            for name, ending, make in (
                ("Picture", ".png", self._picture),
                ("Report", "-report.html", self._report),
                ("Page that travels", "-page.html", _live),
                ("Tables", "-tables.zip", self._tables),
                ("Design file", ".json", _design_file),
                ("As-built STL", "-as-built.stl", lambda state: blade_stl(state.solution.design)),
            ):
                button = context.gui.add_button(name, color="gray", hint=hint("export"))
                button.on_click(lambda _, asked=(name, ending, make): self._save(*asked))
            self._shape = context.gui.add_dropdown(
                "Shape of picture", _PICTURES, hint=hint("picture_shape")
            )
            self._state = context.gui.add_html("")
        self._say("idle", "Exports the design on the sliders.")
        context.keyboard.bind("export", lambda: context.layout.open_drawer("share"))

    def _whole(self) -> PageState:
        """All that is known, and how sure power and its change are, worked out where that is not known."""
        now = self._now()
        tasks = (task for task in works(now) if task.key not in now.answers)
        return replace(
            now,
            answers={
                **now.answers,
                **{task.key: at_once(task.run(lambda: None)) for task in tasks},
            },
        )

    def _tables(self, state: SessionState) -> bytes:
        design, reference = state.solution.design, state.reference.design
        at_once(self._curves.sweep(design, reference))
        return tables_zip(
            state.solution, reference, self._curves.known(design, reference), state.view.azimuth_deg
        )

    def _picture(self, state: SessionState) -> bytes:
        """The scene framed anew for the picture's shape, the same from a window of any size."""
        shape, _, ground = self._shape.value.partition(", ")
        scene, camera = self._render(SHAPES[shape])
        words = self._actuator.blade.labels
        places = (
            seen_at(camera, np.array([at for _, at in words]), SHAPES[shape] / HEIGHT)
            if words
            else ()
        )
        labels = [
            (text, float(x), float(y)) for (text, _), (x, y) in zip(words, places, strict=True)
        ]
        line = line_text(self._whole())
        return view_png(
            scene, state.solution, self._scene.scale, line, state.view.dark, labels, bool(ground)
        )

    def _render(self, width: int) -> tuple[NDArray[np.uint8], Camera]:
        """The scene, (HEIGHT, width, 4), as a camera sees it that is aimed for this alone."""
        if not self._scene.drawn:
            raise ValueError(
                "This browser draws no 3D: export the report, or use a browser with WebGL."
            )
        camera = self._scene.camera.composed(width / HEIGHT, CARDS)
        turn = SO3.from_matrix(np.stack(camera_axes(camera), axis=1)).wxyz
        seen = {"wxyz": turn, "position": camera.position, "fov": FIELD_OF_VIEW}
        try:
            pixels = self._context.client.get_render(
                HEIGHT, width, **seen, transport_format="png", timeout=_PATIENCE
            )
            if pixels.shape[:2] != (HEIGHT, width):
                raise RuntimeError("The picture has another size.")
        except RuntimeError as error:  # The browser has left, or cannot draw.
            raise ValueError(f"The page sent no picture ({error}): press again.") from None
        return pixels, camera

    def _report(self, state: SessionState) -> bytes:
        """The present and the kept designs compared with A or the baseline, and the actuator chosen, as HTML."""
        solution, pinned, view = state.solution, state.pinned, replace(state.view, difference=False)
        now = self._whole()
        if state.pin is None:
            reference = ReportEntry(
                baseline_title(solution.design, state.baseline.design), state.baseline
            )
        else:
            # A may not converge in the present flight condition; then its own solution is used.
            flies = pinned is not None and pinned.converged
            reference = ReportEntry(
                "A, pinned", pinned if pinned is not None and flies else state.pin.solution
            )
        known = (solution.design, reference.solution.design)
        others = [item for item in self._history.kept if item.solution.design not in known]
        entries = [ReportEntry("Now", solution)]
        entries += [ReportEntry(f"Kept {k + 1}", item.solution) for k, item in enumerate(others)]
        field = FIELDS[view.field]
        report = DesignReport(
            reference,
            entries,
            state.view,
            {view.field: self._scene.held_range(field)},
            own_section=state.pin is not None,
            actuator=self._actuator.outcome(),
            driven=actuated_blade(now) if now.hand.on_board else None,
            line=line_text(now),
        )
        stage = make_stage(
            [entry.solution for entry in report.shown], view, report.colour_range(field)
        )
        rotor = io.BytesIO()
        # A browser that cannot draw, or has left, still gets its report.
        with suppress(ValueError):
            Image.fromarray(self._render(SHAPES["16:9"])[0]).resize((1200, 675)).save(
                rotor, "WEBP", quality=85
            )
        return report_html(report, stage, self._curves, rotor.getvalue() or None).encode()

    def _save(self, what: str, ending: str, make: Callable[[SessionState], bytes]) -> None:
        """Make a file and send it, unless another is under way."""
        state = self._context.state()
        if state is None:
            self._say("problem", "There is no solution yet: wait for the first.")
        elif not self._busy.acquire(blocking=False):
            self._say("busy", f"Busy: press {what} again when it is done.")
        else:
            self._say("busy", f"{what}: in progress …")
            threading.Thread(
                target=self._make, args=(what, ending, make, state), name="export", daemon=True
            ).start()

    def _make(
        self, what: str, ending: str, make: Callable[[SessionState], bytes], state: SessionState
    ) -> None:
        begin = time.perf_counter()
        try:
            name, content = file_name(state.solution.design, ending), make(state)
            self._context.download(name, content)
            old = " It holds the last converged solution: the design on the sliders has no trim."
            stale = old if self._now().problem else ""
            size = f"{max(len(content) / 1e3, 1.0):,.0f} kB".replace(",", "\u2009")
            self._say("done", f"{name}, {size} ({time.perf_counter() - begin:.1f} s).{stale}")
        except (ValueError, TimeoutError) as error:
            _log.warning("export of %s: %s", what, error)
            self._say("problem", str(error))
        except Exception as error:  # No file ends the session.
            _log.exception("export of %s failed", what)
            self._say("problem", f"{what} failed ({error}): try again.")
        finally:
            self._busy.release()

    def _say(self, kind: str, sentence: str) -> None:
        marks = {"data_explorer": "export", "data_kind": kind}
        self._state.content = tag("div.rx.rx-small.rx-export", sentence, **marks)


def _live(state: SessionState) -> bytes:
    """The present design, its twist on sliders that need no server."""
    return live_html(
        state.solution, units_of(state.view.units, state.solution.design.aircraft)
    ).encode()


def _design_file(state: SessionState) -> bytes:
    """As `--case` and `--design` read it: with every number of a twist that has but a name on the page."""
    return (
        json.dumps(state.solution.design.to_dict(), indent=2, ensure_ascii=False) + "\n"
    ).encode()
