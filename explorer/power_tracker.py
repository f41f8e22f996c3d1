"""The change of power since the user took hold of something: a slider, the blade, the twist curve."""

from explorer.state import Inputs
from explorer.undo import PAUSE, differing


class PowerTracker:
    """Keeps the power that a change is counted from.

    A grab begins with a pointer that goes down (`grab`), or, by key, with the first movement after a pause of `PAUSE`
    or of another input than before. It counts from the last power known before it, and lasts until the next one begins.
    """

    def __init__(self) -> None:
        self._by_hand = True
        self._clear()

    def reset(self) -> None:
        """Forget everything: another design comes by no hand, but by undo, link, file, optimum, lecture or tour.

        Nothing counts until a hand moves something: an answer on its way may still be that of the design before.
        """
        self._by_hand = False
        self._clear()

    def touch(self) -> None:
        """A hand moves something."""
        self._by_hand = True

    def _clear(self) -> None:
        self._inputs: Inputs | None = None
        self._power: float | None = None
        self._reference: float | None = None
        self._moving: frozenset[str] = frozenset()
        self._held = False

    @property
    def reference(self) -> float | None:
        """Total power before the grab [W]; None when nothing has been moved yet."""
        return self._reference

    @property
    def change(self) -> float | None:
        """Total power now less that before the grab [W]; None when nothing has been moved yet."""
        if self._reference is None or self._power is None:
            return None
        return self._power - self._reference

    def grab(self) -> None:
        """A pointer went down: what follows is one grab until `release`, however long it rests."""
        self._reference, self._moving, self._held, self._by_hand = self._power, frozenset(), True, True

    def release(self) -> None:
        """The pointer went up; the change stays until the next grab."""
        self._held = False

    def solved(self, inputs: Inputs, power: float | None, pause: float) -> float | None:
        """Take a solution's inputs and total power [W], None without trim; `change` afterwards.

        `pause`: the longest rest of the inputs [s] since the last call, as `explorer.undo.Pauses` measures it.
        """
        if self._inputs is not None and inputs.aircraft != self._inputs.aircraft:
            self._clear()  # Another rotor: its power is no change of this one's.
        if self._inputs is None:
            self._inputs, self._power = inputs, power
            if self._held:  # Grabbed before the new design had a power: it counts from the first one known.
                self._reference = power
            return self.change
        if not self._by_hand:
            self._inputs, self._power = inputs, self._power if power is None else power
            return None
        moved = differing(self._inputs, inputs)
        if moved and not self._held and (pause >= PAUSE or not moved <= self._moving):
            self._reference, self._moving = self._power, moved
        elif moved:
            self._moving |= moved
        self._inputs = inputs
        # A step without trim has no power; the last known one stays, so that the drag can come back to it.
        self._power = self._power if power is None else power
        return self.change if power is not None else None
