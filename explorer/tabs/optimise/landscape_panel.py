"""The map of power as a landscape in the stage: surface, flooded valley, and the starts of the search rolling down.

Heights are the map's trims; paths are what the search recorded: the best design of each start so far, round by round.
The page moves balls and blade (`explorer/web/landscape.js`).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
import trimesh
import viser
from trimesh.visual.color import ColorVisuals

from explorer.colours import START_COLOURS, colour_map, css, scene_theme
from explorer.model.inputs import with_optimum
from explorer.model.session_state import SessionState
from explorer.model.units import Units, number
from explorer.picture.blade_mesh import Mesh, blade_shape, blade_vertices
from explorer.picture.landscape import BASE, POINTS, SIZE, Landscape, refined
from explorer.tabs.actuator.lifted_blade import segments_of
from explorer.tabs.context import TabContext
from explorer.tabs.optimise.map_panel import Map, MapPanel, place_on
from explorer.tabs.optimise.search_run import SearchRun
from explorer.tabs.views import SceneViews
from rotor import Design
from rotor.arrays import Array
from rotor.chart import bar_ticks, tick_text
from rotor.design import TwistLaw
from rotor.optimisation import Parameter
from rotor.optimisation.descent import BAND

ROOT = "/landscape"
_BALL, _LIFT = 0.2, 0.19
"""Radius of a ball, and how far its middle is above the surface [m]."""
_TIMES = 4.0
"""Exaggeration of the blade's twist, as on the rest of the page."""
_BLADE_SCALE = 1.4
_WATER, _NOW, _PINNED = (38, 110, 235), (214, 40, 24), (104, 64, 220)
_COLOURS_END = 0.08
"""Power above the least, as part of it, at which the colours end."""
_COLOUR_TICKS = (0.0, 0.005, 0.01, 0.02, 0.04, 0.08)
_FLAT = 2.0
"""Half a valley this wide [°/R] is called flat."""


def half_widths(drawn: Map, land: Landscape) -> list[tuple[Parameter, float]]:
    """Half of the reach of the band along each parameter of the map, as shown."""
    return [
        (parameter, 0.5 * (high - low) * (parameter.shown(parameter.high) - parameter.shown(parameter.low)))
        for parameter, (low, high) in zip(drawn.parameters, land.valley(), strict=True)
    ]


def valley_words(drawn: Map, land: Landscape, units: Units, verdict: bool = True) -> str:
    """How flat the optimum is: `±4°/R for 1 kW: a flat optimum`, of the parameter that may move most.

    Without the verdict it ends before the colon.
    """
    halves = half_widths(drawn, land)
    angular = [half for half in halves if half[0].angular] or halves
    parameter, half = max(angular, key=lambda half: half[1])
    digits = 0 if parameter.angular and half >= 1.5 else 1 if parameter.angular else 2
    unit = parameter.shown_unit if parameter.shown_unit.startswith("°") else f" {parameter.shown_unit}"
    flat = ": a flat optimum" if verdict and parameter.angular and half >= _FLAT else ""
    return f"±{number(half, digits)}{unit} for {units.watts(BAND * land.least, 1)}{flat}"


def design_at(drawn: Map, place: Sequence[float]) -> Design:
    """The design of a place on the map, 0…1 along both of its parameters."""
    task, values = drawn.task, list(drawn.task.values)
    for axis, p, share in zip(task.axes, drawn.parameters, place, strict=True):
        values[axis] = p.low + share * (p.high - p.low)
    return replace(task.design, twist=task.concept.twist(values))


@dataclass(frozen=True, eq=False)
class Path:
    """Path of one start: places on the map, 0…1, power and design, each the best so far."""

    start: int
    x: tuple[float, ...]
    y: tuple[float, ...]
    powers: tuple[float, ...]
    parameters: tuple[tuple[float, ...], ...]


def paths_on(drawn: Map, run: SearchRun | None) -> tuple[Path, ...]:
    """The starts of a search of the same design, concept and objective; none of any other."""
    task = drawn.task
    if run is None or run.under_way or not run.matches(task.design) or run.concept != task.concept:
        return ()
    if run.search.objective is not None and run.search.objective != task.objective:
        return ()
    paths: list[Path] = []
    for start, steps in enumerate(run.paths):
        places = [
            tuple(
                (values[axis] - p.low) / (p.high - p.low) for axis, p in zip(task.axes, drawn.parameters, strict=True)
            )
            for values, _ in steps
        ]
        if places:
            x, y = zip(*places, strict=True)
            paths.append(Path(start, x, y, tuple(power for _, power in steps), tuple(v for v, _ in steps)))
    return tuple(paths)


class LandscapePanel:
    """One session's."""

    def __init__(self, context: TabContext, map_panel: MapPanel, views: SceneViews) -> None:
        self._context, self._map, self._views = context, map_panel, views
        self._api = context.client.scene
        self._handles: list[viser.SceneNodeHandle] = []
        self._drawn: tuple[object, ...] | None = None
        self._refused: object = None
        """The map whose landscape was left by a press of a view."""
        self._land: Landscape | None = None
        self._shown = False
        context.bridge.on("landscape", lambda on: self._ask(bool(on)))
        context.bridge.on("land_at", self._take)
        views.leave_landscape = lambda: self._ask(False)

    def show(self, state: SessionState, section: str, design: Design | None) -> None:
        """Follow: shown while Optimise shows a map. `design`: on the sliders."""
        drawn = self._map.map
        wanted = self._context.layout.mode == "optimise" and section == "Map" and drawn is not None
        if not wanted:
            self._refused = None
        if drawn is None or not wanted or self._refused is drawn.task:
            self._leave()
            return
        run = self._map.search.run
        pinned = None if state.pinned is None else state.pinned.design.twist
        units, dark = self._context.units, state.view.dark
        paths = paths_on(drawn, run)
        key = drawn, None if design is None else design.twist, pinned, units, dark, run if paths else None
        if key != self._drawn:
            self._build(drawn, paths, design, pinned, units, dark, run)
            self._drawn = key
        if not self._shown:
            self._shown = True
            land = self._land
            assert land is not None
            self._views.give_way(partial(land.camera, _BLADE_SCALE * drawn.task.design.rotor.radius))

    def _ask(self, on: bool) -> None:
        self._refused = None if on or self._map.map is None else self._map.map.task
        self._context.wake()

    def _take(self, place: list[float]) -> None:
        """The surface was clicked at (x, y), 0…1: its design goes onto the sliders."""
        drawn = self._map.map
        if drawn is not None and self._shown and not self._context.held:
            self._context.set_inputs(with_optimum(self._context.inputs(), design_at(drawn, place)))

    def _leave(self) -> None:
        if not self._shown:
            return
        self._shown, self._drawn = False, None
        self._clear()
        self._context.bridge.set(landscape=None, landscape_labels=[])
        self._views.come_back()

    def _clear(self) -> None:
        for handle in self._handles:
            handle.remove()
        self._handles = []

    def _build(
        self,
        drawn: Map,
        paths: tuple[Path, ...],
        design: Design | None,
        pinned: TwistLaw | None,
        units: Units,
        dark: bool,
        run: SearchRun | None,
    ) -> None:
        land = self._land = Landscape(refined(drawn.powers, POINTS, POINTS), BAND)
        theme = scene_theme(dark)
        with self._context.client.atomic():
            self._clear()
            self._solids(land, theme.body, dark)
            balls = [self._ball(land, path) for path in paths]
            labels = [*_axis_labels(drawn, land), _water_label(drawn, land, units)]
            labels += self._marks(drawn, land, design, pinned, units)
            blade = self._blade(drawn, land, paths, theme.reference_blade)
        labels.append(blade.pop("label"))
        self._context.bridge.set(
            landscape={
                "balls": balls,
                "blade": blade,
                "colours": [css(rgb) for rgb in colour_map("sequential", 12)],
                "ticks": [(math.sqrt(1e4 * part / _COLOURS_END), tick_text(100.0 * part)) for part in _COLOUR_TICKS],
                "water": f"within {100 * BAND:g} % ({units.watts(BAND * land.least, 1)})",
                "least": f"{units.watts(land.least, 1)}",
                "words": valley_words(drawn, land, units),
                "each": "; ".join(
                    f"{p.title.lower()} ±{number(half, 1 if p.angular else 2)} {p.shown_unit}"
                    for p, half in half_widths(drawn, land)
                ),
                "note": f"{_note(drawn, paths, run)} A click on the surface takes its design.",
            },
            landscape_labels=labels,
        )
        self._context.client.flush()

    def _solids(self, land: Landscape, wall: tuple[int, int, int], dark: bool) -> None:
        api = self._api
        surface, colours = land.surface(), land.colours(_COLOURS_END)
        mesh = trimesh.Trimesh(surface.vertices, surface.faces, process=False)
        # Colours of vertices are linear in the file, those of the map are sRGB.
        linear = np.round(255.0 * (colours / 255.0) ** 2.2).astype(np.uint8)
        opaque = np.full((len(colours), 1), 255, dtype=np.uint8)
        mesh.visual = ColorVisuals(mesh, vertex_colors=np.hstack((linear, opaque)))
        _ = mesh.vertex_normals  # Computed, they go into the file, and the surface is lit smoothly.
        self._handles.append(api.add_mesh_trimesh(f"{ROOT}/surface", mesh, cast_shadow=False, receive_shadow=False))
        self._mesh("walls", land.walls(), wall, 0.55)
        self._mesh("water", land.water(), _WATER, 0.9)
        self._lines("shore", land.shore(), (255, 255, 255), 2.6)
        steps = np.linspace(0.0, 1.0, 13)
        fine = np.linspace(0.0, 1.0, 49)
        lines = [np.array([land.place(u, at, lift=0.012) for u in fine]) for at in steps]
        lines += [np.array([land.place(at, u, lift=0.012) for u in fine]) for at in steps]
        self._lines("grid", segments_of(lines), (12, 16, 26) if not dark else (226, 232, 242), 0.7)

    def _ball(self, land: Landscape, path: Path) -> dict[str, Any]:
        """A ball at its start, its path as a line, and where it rolls."""
        rgb, name = START_COLOURS[path.start], f"{ROOT}/ball_{path.start}"
        places = [land.place(x, y, power, _LIFT) for x, y, power in zip(path.x, path.y, path.powers, strict=True)]
        between = [
            np.array(
                [land.place(a + t * (c - a), b + t * (d - b), p + t * (q - p), 0.05) for t in np.linspace(0, 1, 9)]
            )
            for a, b, c, d, p, q in zip(
                path.x, path.y, path.x[1:], path.y[1:], path.powers, path.powers[1:], strict=False
            )
        ]
        if between:
            self._lines(f"path_{path.start}", segments_of(between), rgb, 3.2)
        self._sphere(f"ball_{path.start}", rgb, places[-1], _BALL)
        return {
            "node": name,
            "start": path.start,
            "points": [[round(v, 3) for v in place] for place in places],
            "powers": [round(power, 1) for power in path.powers],
        }

    def _marks(
        self, drawn: Map, land: Landscape, design: Design | None, pinned: TwistLaw | None, units: Units
    ) -> list[dict[str, Any]]:
        """The design on the sliders, and A, as balls with their power against the least."""
        labels: list[dict[str, Any]] = []
        wanted = [
            ("now", "on the sliders", None if design is None else design.twist, _NOW),
            ("a", "A", pinned, _PINNED),
        ]
        for name, title, twist, rgb in wanted:
            if twist is None:
                continue
            (x, y), exact = place_on(drawn, twist)
            power = land.at(x, y)
            if not (0.0 <= x <= 1.0 and 0.0 <= y <= 1.0 and math.isfinite(power)):
                continue
            at = land.place(x, y, lift=_LIFT)
            self._sphere(f"mark_{name}", rgb, at, 1.25 * _BALL)
            more = units.watts(power - land.least, 1, sign=True)
            nearest = "" if exact else ", nearest on the map"
            labels.append(
                {"text": f"{title}{nearest} · {units.watts(power)}, {more}", "node": f"{ROOT}/mark_{name}",
                 "at": [0.0, 0.0, 0.75], "title": "Of the map, against its least power."}
            )  # fmt: skip
        return labels

    def _blade(self, drawn: Map, land: Landscape, paths: tuple[Path, ...], rgb: tuple[int, int, int]) -> dict[str, Any]:
        """The blade of the best start, pointing at the viewer, and its twist at each round."""
        task, name = drawn.task, f"{ROOT}/blade"
        shape, scale = blade_shape(task.design.rotor), _BLADE_SCALE
        best = min(paths, key=lambda path: path.powers[-1], default=None)
        steps = () if best is None else best.parameters
        laws = [task.concept.twist(values) for values in steps] or [task.design.twist]
        root, turn = land.blade_place(scale * task.design.rotor.radius)
        mesh = Mesh(scale * blade_vertices(shape, laws[-1], _TIMES), shape.faces)
        handle = self._mesh("blade", mesh, rgb, None)
        handle.position = root
        handle.wxyz = np.array([math.cos(0.5 * turn), 0.0, 0.0, math.sin(0.5 * turn)])
        title = f"blade of start {best.start + 1}" if best is not None else "blade on the sliders"
        tip = scale * float(shape.outward[-1])
        return {
            "node": name,
            "points": shape.rings.shape[1],
            "outward": [round(scale * float(x), 4) for x in shape.outward],
            "rings": np.round(scale * shape.rings, 4).tolist(),
            "angles": [np.round(shape.pitch(law, _TIMES), 4).tolist() for law in laws],
            "label": {"text": f"{title} · twist × {_TIMES:g}", "node": name, "at": [tip, 0.0, 0.9], "title": ""},
        }

    def _sphere(self, name: str, rgb: tuple[int, int, int], at: list[float], radius: float) -> None:
        red, green, blue = (round(0.72 * channel) for channel in rgb)  # The scene's lights bleach.
        handle = self._api.add_icosphere(
            f"{ROOT}/{name}", radius, (red, green, blue), subdivisions=3, position=np.array(at), cast_shadow=False
        )
        self._handles.append(handle)

    def _mesh(self, name: str, mesh: Mesh, rgb: tuple[int, int, int], opacity: float | None) -> viser.MeshHandle:
        handle = self._api.add_mesh_simple(
            f"{ROOT}/{name}",
            mesh.vertices.astype(np.float32),
            mesh.faces,
            color=rgb,
            opacity=opacity,
            side="double",
            cast_shadow=False,
            receive_shadow=False,
        )
        self._handles.append(handle)
        return handle

    def _lines(self, name: str, segments: Array, rgb: tuple[int, int, int], width: float) -> None:
        if len(segments):
            colours = np.tile(np.array(rgb, dtype=np.uint8), (len(segments), 2, 1))
            points = segments.astype(np.float32)
            handle = self._api.add_line_segments(
                f"{ROOT}/{name}", points, colours, thickness=width, thickness_units="screen"
            )
            self._handles.append(handle)


def _axis_labels(drawn: Map, land: Landscape) -> list[dict[str, Any]]:
    """Ticks and titles of both parameters along the edges that face the camera, and of power up a corner."""
    labels: list[dict[str, Any]] = []
    near_x, near_y = land.near
    for k, p in enumerate(drawn.parameters):
        beyond = 0.5 * SIZE + 0.55

        def at(part: float, further: float, along: int = k, far: float = beyond) -> list[float]:
            across = (near_x if along else near_y) * (far + further)
            place = SIZE * (part - 0.5)
            return [across, place, BASE] if along else [place, across, BASE]

        for percent, word in bar_ticks(p.shown(p.low), p.shown(p.high)):
            if 2.0 < percent < 98.0:
                labels.append({"text": word, "node": ROOT, "at": at(0.01 * percent, 0.0), "kind": "tick"})
        words = f"{p.title} [{p.shown_unit}]"
        labels.append({"text": words, "node": ROOT, "at": at(0.5, 1.25), "kind": "axis"})
    return labels


def _water_label(drawn: Map, land: Landscape, units: Units) -> dict[str, Any]:
    (x0, x1), (y0, y1) = land.valley()
    near_x, near_y = land.near
    centre = np.array([SIZE * (0.5 * (x0 + x1) - 0.5), SIZE * (0.5 * (y0 + y1) - 0.5), 0.0])
    # Before the valley, where it covers neither the balls nor their words.
    at = (centre + 2.2 * np.array([near_x, near_y, 0.0])).tolist()
    title = f"Blue: within {100 * BAND:g} % of the least power of the map."
    words = valley_words(drawn, land, units, verdict=False)  # The card has it.
    return {"text": words, "node": ROOT, "at": at, "kind": "water", "title": title}


def _note(drawn: Map, paths: tuple[Path, ...], run: SearchRun | None) -> str:
    if not paths and run is not None:
        return "The search is under way." if run.under_way else "The last search was of another design or concept."
    if not paths:
        return "A search with the same concept shows its starts roll here."
    others = [p.title.lower() for k, p in enumerate(drawn.task.concept.parameters) if k not in drawn.task.axes]
    if not others:
        return "Balls stand at the best design of each start so far."
    return f"Balls: best of each start so far; {', '.join(others)} moves too, so they may stand above the surface."
