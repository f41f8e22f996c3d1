"""The folder of electrodes on the Actuator tab: field and free strain of the chosen sheet, and where it is now."""

import viser

from explorer.tabs.actuator import electrodes_picture as picture
from explorer.tabs.chart_panel import Chart, line, points
from explorer.theme.colours import BASELINE, IDEAL, NOW, THIS
from rotor.actuator.catalogue import Actuator, PiezoPly


class ElectrodesPanel:
    """Written only when actuator or voltage change: a dragged twist costs nothing here."""

    def __init__(self, gui: viser.GuiApi) -> None:
        self._shown: tuple[Actuator, tuple[float, ...]] | None = None
        self._folder = gui.add_folder("Electrodes", expand_by_default=False)
        with self._folder:
            self._chart = Chart(
                gui,
                "Strain [µε] over V",
                (("this sheet", THIS), ("α·V", IDEAL), ("other kind", BASELINE)),
                "voltage [V]",
                (
                    line("other electrodes, along", BASELINE, 2.0),
                    line("across the fibres", THIS, 1.0),
                    line("along the fibres", THIS, 2.5),
                    line("along, by α = d/ΔES", IDEAL, 1.5, (5, 4)),
                    points("now", NOW, 8),
                ),
                picture.blank(),
                (-1.0, 1.0),
                height=118,
            )
            self._field = gui.add_html("")
            self._ranges = gui.add_html("")

    def show(self, actuator: Actuator, volts: tuple[float, ...]) -> None:
        """Follow the chosen actuator; `volts` of each segment. What has no electrodes has no folder."""
        if self._shown == (actuator, volts):
            return
        before, self._shown = self._shown, (actuator, volts)
        if before is None or before[0] != actuator:
            self._folder.visible = isinstance(actuator, PiezoPly)
            if isinstance(actuator, PiezoPly):
                self._field.content = picture.field_panel(actuator)
        if not isinstance(actuator, PiezoPly):
            return
        self._ranges.content = picture.ranges_panel(actuator, volts)
        self._chart.show(picture.strain_plot(actuator, volts, self._chart.y_range))
