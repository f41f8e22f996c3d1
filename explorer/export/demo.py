"""`python -m explorer demo FILE`: the rotor as one HTML file without a server, in a computed sweep of twist and speed.

The file is viser's viewer with the trimmed rotor in it, and `explorer/web/demo.html` on top: sliders, play, power, two
charts. It requests nothing from any host, so it opens from a disk or any static host.
"""

import argparse
import base64
import io
import sys
from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from tqdm import tqdm

from explorer import web
from explorer.colours import PARTS
from explorer.export.provenance import PROGRAM, versions
from explorer.model.inputs import ViewState
from explorer.picture.blade_mesh import BladeShape, blade_shape, blade_vertices, edge_pairs
from explorer.picture.fields import FIELDS
from explorer.picture.picture import make_picture
from explorer.picture.poses import flown_twist, follows_azimuth
from explorer.scene.controller import SURFACES, TURN_RATES, motion_of
from explorer.scene.scene import ROTOR
from explorer.scene.still_scene import JIG_EDGES, still_page
from explorer.text.readout import part_titles
from rotor import Design, Solution, load_design, make_design, parse_twist, solve
from rotor.arrays import Array
from rotor.terminal import run_command
from rotor.trim.caveats import LOW_SPEED
from rotor.trim.low_speed import passes_over
from rotor.units import KNOT
from rotor.user_input import write_whole

TWISTS = tuple(float(rate) for rate in range(-20, 1))
"""Linear twist [degrees per radius]."""
SPEEDS = tuple(round(0.025 * k, 3) for k in range(15))
"""Advance ratios."""
OPENING = (-12.0, 0.2)
"""Twist and advance ratio that the file opens on."""
HARMONICS = 4
"""Of the elastic twist in the trim."""
UNTWISTED = parse_twist("linear:0")
PIXELS = 400
"""Along each edge of a picture of the disk."""


def demo_html(
    design: Design,
    twists: Sequence[float] = TWISTS,
    speeds: Sequence[float] = SPEEDS,
    view: ViewState | None = None,
    quiet: bool = True,
) -> str:
    """The file's text: the design with each linear twist [degrees per radius] at each advance ratio.

    Where forward flight does not pass over to hover, low speeds are left out.

    Raises ValueError when the design does not trim with the twist and speed in the middle, which the file opens on.
    """
    view = view or ViewState()
    joined = passes_over(design)
    speeds = [speed for speed in speeds if joined or not 0.0 < speed < LOW_SPEED]
    field = FIELDS[view.field]
    colour_range = field.low, field.high
    first = OPENING if OPENING[0] in twists and OPENING[1] in speeds else (twists[len(twists) // 2], speeds[-1])
    opening = solve(_variant(design, *first))
    if not opening.converged:
        raise ValueError(
            f"The design does not trim at µ {first[1]:g} with a linear twist of {first[0]:g}°: take another"
        )
    shape = blade_shape(design.rotor)
    points: list[list[Any]] = []
    with tqdm(total=len(twists) * len(speeds), disable=quiet, leave=False) as bar:
        for speed in speeds:
            row: list[Any] = []
            start: Solution | None = None
            for twist in twists:
                solution = solve(_variant(design, twist, speed), start)
                start = solution if solution.converged else start
                row.append(point_record(solution, shape, view, colour_range) if solution.converged else None)
                bar.update()
            points.append(row)
    edges = edge_pairs(shape)
    record = {
        "twists": list(twists),
        "speeds": speeds,
        "joined": joined,
        "knots": [speed * design.rotor.tip_speed / KNOT for speed in speeds],
        "opening": [list(twists).index(first[0]), list(speeds).index(first[1])],
        "points": points,
        **shape_record(shape),
        "jig": [_packed(shape.pitch(parse_twist(f"linear:{twist:g}"), view.exaggeration)) for twist in twists],
        "edges": _packed(edges),
        "ghost": JIG_EDGES,
        "parts": [[name, title, PARTS[name]] for name, title in part_titles(design).items()],
        "surfaces": SURFACES,
        "rate": TURN_RATES["normal"],
        "rotor": design.rotor.name,
        "label": "jig twist" if opening.elastic is not None else "twist",
        "note": f"{field.title} on the disk, {tick_range(colour_range)} {field.unit}. "
        f"{_drawn(opening, view)} "
        "Forward-flight power is indicative: a model, not a measurement. "
        f"{PROGRAM} {versions()[PROGRAM]}",
    }
    jig = blade_vertices(shape, opening.design.twist, view.exaggeration)
    page = still_page(
        opening, view, colour_range, covered=0.29, edges=jig[edges] if opening.elastic is not None else None
    )
    words = {
        "styles": web.styles("demo.css"),
        "title": escape(f"{design.rotor.name}: twist and speed"),
        "label": f"Linear {record['label']}",
        "data": web.json_block("demo-data", record),
        "scripts": web.scripts("scene.js", "still_rotor.js", "demo.js"),
    }
    front = web.fill("demo.html", words)
    body = page.rindex("</body>")
    return page[:body] + front + page[body:]


def tick_range(colour_range: tuple[float, float]) -> str:
    """The ends of a colour scale in words."""
    low, high = (f"{value:g}".replace("-", "−") for value in colour_range)
    return f"{low} to {high}"


def _variant(design: Design, twist: float, speed: float) -> Design:
    return design.with_twist(f"linear:{twist:g}").at(mu=speed)


def _drawn(opening: Solution, view: ViewState) -> str:
    """What the blades of the file show."""
    times = f"drawn {view.exaggeration:g} times as large"
    if opening.elastic is None:
        return f"Twist {times}."
    return (
        f"The sliders set jig twist. Blades as flown, with elastic twist; lines: jig shape of the red blade; {times}."
    )


def flown_pitch(solution: Solution, shape: BladeShape, exaggeration: float) -> Array:
    """Drawn pitch of each ring in harmonics of azimuth 1, cos ψ, sin ψ, cos 2ψ, … [rad], (harmonics, rings).

    The mean alone where the twist does not change around the disk.
    """
    waves = solution.design.pitch_waves
    highest = max(HARMONICS, *(one.per_rev for wave in waves for one in wave.harmonics)) if waves else HARMONICS
    count = max(24, 4 * highest) if follows_azimuth(solution) else 1
    psi = 2.0 * np.pi * np.arange(count) / count
    pitch = np.array([shape.pitch(flown_twist(solution, float(at)), exaggeration) for at in psi])
    basis = [np.ones_like(psi)]
    for n in range(1, highest + 1) if count > 1 else ():
        basis += [2.0 * np.cos(n * psi), 2.0 * np.sin(n * psi)]
    return np.array(basis) @ pitch / count


def shape_record(shape: BladeShape) -> dict[str, Any]:
    """What `still_rotor.js` shapes blades from."""
    return {
        "shape": _packed(blade_vertices(shape, UNTWISTED)),
        "rings": list(shape.rings.shape[:2]),
        "faces": _packed(np.asarray(shape.faces)),
    }


def point_record(
    solution: Solution, shape: BladeShape, view: ViewState, colour_range: tuple[float, float], root: str = ROTOR
) -> dict[str, Any]:
    """One trim: powers [kW], motion and pitch of the blades, poses, and the picture of the disk as WebP."""
    picture = make_picture(solution, view, colour_range, pixels=PIXELS)
    image = io.BytesIO()
    Image.open(io.BytesIO(picture.png)).convert("RGBA").save(image, "WEBP", quality=80)
    return {
        "power": [round(getattr(solution.power, name) / 1e3, 2) for name in part_titles(solution.design)],
        "motion": motion_of(solution, root),
        "poses": [
            [pose.wxyz.tolist(), pose.position.tolist()] for pose in (picture.rotor, picture.disk, picture.airframe)
        ],
        "flown": _packed(flown_pitch(solution, shape, view.exaggeration)),
        "disk": base64.b64encode(image.getvalue()).decode("ascii"),
        "stall": round(100.0 * solution.stalled_area, 1),
    }


def _packed(values: np.ndarray[Any, Any]) -> str:
    """Vertices [m] as 32-bit floats, faces as 32-bit integers, base64."""
    kind = np.float32 if values.dtype.kind == "f" else np.uint32
    return base64.b64encode(values.astype(kind).tobytes()).decode("ascii")


def main(arguments: Sequence[str] | None = None) -> int:
    """0 when the file is written, 2 for bad input."""
    return run_command("explorer demo", lambda: _run(_parser().parse_args(arguments)))


def _run(options: argparse.Namespace) -> int:
    design = load_design(options.design) if options.design else make_design()
    text = demo_html(design, view=ViewState(field=options.field), quiet=not sys.stderr.isatty())
    return write_page(options.out, "index.html", text, f"{len(TWISTS)} twists at {len(SPEEDS)} speeds")


def write_page(out: str, name: str, text: str, content: str) -> int:
    """Write one HTML file, in a folder as `name`, and print what it holds. 0, or ValueError where it cannot."""
    target = Path(out) / name if Path(out).is_dir() else Path(out)
    try:
        write_whole(target, text)
    except OSError as error:
        raise ValueError(f"cannot write {str(target)!r} ({error.strerror}): give a writable file") from None
    print(f"{target}: {content}, {target.stat().st_size / 1e6:.1f} MB")
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m explorer demo",
        description="One HTML file without a server: the rotor in 3D, in a computed sweep of twist and speed.",
    )
    parser.add_argument("out", metavar="FILE", help="where to write; in a folder, its index.html")
    parser.add_argument("--design", metavar="FILE", help="design file (JSON); default the UH-60A")
    parser.add_argument(
        "--field",
        default=ViewState.field,
        choices=tuple(FIELDS),
        metavar="NAME",
        help=f"on the disk: {', '.join(FIELDS)}",
    )
    return parser
