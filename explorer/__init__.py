"""The page in the browser: sliders → `Design` → `solve` → `Solution` → 3D picture, charts and numbers.

`session.py` holds the path of a slider step; each other part of the page has a folder. Modules that make arrays, text
and decisions do not import viser; `tests/test_layers.py` lists the folders that may, and the order in which folders
import each other. Searches and schedules run in worker processes (`workers/`), and `tabs/` shows their progress.

`show` opens the page from Python, in a notebook or a script.

World axes: x aft (ψ = 0), y to starboard (ψ = 90°, the advancing side), z up, in metres, origin at the rotor centre.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from explorer.notebook import RunningPage
    from rotor import Design

__all__ = ("show",)


def show(
    design: "Design", *, port: int = 0, browser: bool | None = None, hub: str | None = None
) -> "RunningPage":
    """Start the page on a design in the background of this process, on this machine only.

    port: where it listens; 0 takes a free one.
    browser: whether to open a browser; by default yes, but not in Jupyter, where the value returned shows the page.
    hub: name of a JupyterHub with jupyter-server-proxy, "hub.example": the page is shown by its path there.

    The page ends with the process or with `.stop()` of the value returned; its address is `.address`.
    Raises TypeError for anything but a design, and ValueError for one that the page cannot show.
    """
    from explorer.notebook import start_page

    return start_page(design, port, browser, hub)
