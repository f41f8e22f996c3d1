"""The long work that worker processes do for the page. Values that pickle; no viser."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from rotor.design import Design
from rotor.objective import at_condition, measure
from rotor.optimise import Optimum, Search, optimise


@dataclass(frozen=True)
class Reference:
    """Power of the baseline by the objective of a search [W]; None when it does not trim."""

    power: float | None


@dataclass(frozen=True)
class Beginning:
    """Power of the design a search starts from [W]."""

    power: float | None


@dataclass(frozen=True)
class SearchTask:
    """A search for the twist of least power."""

    search: Search
    baseline: Design
    """What the saving is also measured against."""

    def run(self, tell: Callable[[Any], None], stop: Callable[[], bool]) -> Optimum:
        """Tells `Beginning`, `Reference`, then every `Progress`."""
        search = self.search
        objective = search.objective or at_condition(search.design)
        begin = measure(objective, search.design, gradient=False)
        tell(Beginning(begin.power))
        if self.baseline == search.design:
            tell(Reference(begin.power))
        elif not stop():
            tell(Reference(measure(objective, self.baseline, gradient=False).power))
        return optimise(search, tell, stop)
