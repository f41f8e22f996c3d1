"""The widgets of Actuate, from top to bottom."""

import threading
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import viser

from explorer.model.actuator_inputs import BLADES, CONCEPTS, ActuatorInputs, as_it_comes
from explorer.views.actuator import DRIVES, FormLook, actuator_titles
from explorer.views.dial import validation_words
from explorer.widgets.form import WidgetForm
from rotor.actuator.verdict import Against
from rotor.design.quantity import Slider
from rotor.optimisation import find_concept
from rotor.support.markup import tag


class ActuatorControls:
    """Widgets, and the charts and texts between them."""

    def __init__(
        self,
        gui: viser.GuiApi,
        hours: tuple[float, ...],
        against: Against,
        moved: Callable[[], None],
        driven: Callable[[], None],
    ) -> None:
        """`hours`: of the mission, at first; `against`: what changes count from, at first. `moved`: something changed.
        `driven`: a hand moved a voltage."""
        self._moved, self._driven = moved, driven
        self._placing = threading.RLock()
        """Held while widgets are read or moved together: nobody reads half of a change, which undo would take apart."""
        self._folders: list[viser.GuiFolderHandle] = []
        texts: dict[str, viser.GuiHtmlHandle] = {}

        def text(name: str) -> None:
            texts[name] = gui.add_html("")

        def folder(title: str) -> viser.GuiFolderHandle:
            self._folders.append(gui.add_folder(title, expand_by_default=False))
            return self._folders[-1]

        start = ActuatorInputs()
        self._against: Against = against
        self._hours = hours
        self._offered = tuple(actuator_titles())
        """Kinds in the menu."""
        form = self.form = WidgetForm(gui, self._heard)
        text("verdict")
        form.menu("actuator", "Actuator", actuator_titles())
        text("weak")
        text("kinds")
        form.slider("plies", Slider("Plies per side", 1, 8, 1), start.plies)
        form.span("span", "Span [R]", (0.14, 1.0), start.span, 0.05)
        for name in DRIVES:
            form.slider(name, Slider("Voltage [%]", -100.0, 100.0, 1.0), 0.0, entry="voltage")
        text("bar")
        text("now")
        with folder("Twist at n/rev"):
            gui.add_html(tag("div.rxd", data_dial=True, data_explorer="dial"))
            text("per_rev")
            gui.add_html(
                tag("div.rx.rx-dim.rx-small", validation_words(), data_explorer="unmeasured")
            )
        with folder("Placement and blade"):
            form.span("chord", "Chord [c]", (0.0, 0.95), start.chord, 0.05, "chord_range")
            form.menu("blade", "Blade type", BLADES, entry="blade_type")
            form.slider("stiffness", Slider("New blade GJ ×", 0.2, 1.5, 0.05), start.stiffness)
            form.box("crossed", "Fibres at −45°", start.crossed)
            titles = {name: find_concept(name).title for name in CONCEPTS}
            form.menu("concept", "Concept", titles, entry="actuator_concept")
        with folder("Reach and limits"):
            text("numbers")
            text("limits")
        shows = {
            f"actuator.{name}": partial(setattr, place, "content") for name, place in texts.items()
        }
        self.texts: Mapping[str, Callable[[Any], None]]
        """What shows each text of the rail, and how the widgets look."""
        self.texts = {**shows, "actuator.form": self._arrange}

    def inputs(self) -> ActuatorInputs:
        """What the widgets mean now."""
        with self._placing:
            values = self.form.values()
        drives = tuple(float(values.pop(name)) for name in DRIVES)
        return ActuatorInputs(**values, drives=drives, against=self._against, hours=self._hours)

    def place(self, changes: Mapping[str, Any]) -> None:
        """Move widgets: these fields of `ActuatorInputs`."""
        with self._placing:
            if changes.get("actuator", self._offered[0]) not in self._offered:
                self._offer((*self._offered, changes["actuator"]))
            if {"actuator", "drives"} & changes.keys():
                least = ActuatorInputs(changes.get("actuator", self.form["actuator"])).least_drive
                for each in DRIVES:
                    self.form.bound(each, least)
            for name, value in changes.items():
                if name == "drives":
                    for each, drive in zip(DRIVES, value, strict=True):
                        self.form.place(each, round(drive))
                elif name == "against":
                    self._against = value
                elif name == "hours":
                    self._hours = value
                else:
                    self.form.place(name, value)
        self._moved()

    def _arrange(self, look: FormLook) -> None:
        self.form.show(look.seen)
        for name, label in look.labels.items():
            self.form.call(name, label)
        for folder in self._folders:
            folder.visible = look.carried
        with self._placing:
            if look.kinds and look.kinds != self._offered and self.form["actuator"] in look.kinds:
                self._offer(look.kinds)

    def _offer(self, kinds: tuple[str, ...]) -> None:
        """Offer these kinds in the menu; the chosen one is among them."""
        titles = actuator_titles()
        chosen = self.form["actuator"]
        self._offered = kinds
        self.form.offer("actuator", {id: titles[id] for id in kinds}, chosen)

    def _heard(self, name: str, by_hand: bool) -> None:
        if by_hand and name in DRIVES:
            self._driven()
        if by_hand and name == "actuator":
            self.place(as_it_comes(self.form["actuator"]))
            return
        self._moved()
