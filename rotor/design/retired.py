"""Models that were retired: old design files, links, study files and commands still name them.

Whoever reads the name of a model from outside passes it through `current_model`.
"""

import warnings
from collections.abc import Callable
from dataclasses import dataclass

from rotor.user_input import Notice

Tell = Callable[[str], object]
"""Takes a sentence for the user."""


@dataclass(frozen=True)
class RetiredModel:
    """What stands in for a model that is gone."""

    option: str
    """The field of `Models` that named it."""
    replacement: str
    sentence: str


RETIRED = {
    "free-wake": RetiredModel(
        "hover_inflow", "annulus", "The free wake in hover was retired; hover is solved by the annulus balance."
    ),
    "dynamic-wake": RetiredModel(
        "inflow", "lifting-line", "The dynamic wake was retired; the lifting line stands in for it."
    ),
    "dynamic-wake-quick": RetiredModel(
        "inflow", "lifting-line", "The dynamic wake of few states was retired; the lifting line stands in for it."
    ),
    "dynamic-wake-infinite-blades": RetiredModel(
        "inflow",
        "lifting-line",
        "The dynamic wake of infinitely many blades was retired; the lifting line of the rotor's own blades stands in "
        "for it.",
    ),
    "vortex-wake": RetiredModel(
        "inflow", "lifting-line", "The vortex wake of rigid helices was retired; the lifting line stands in for it."
    ),
}


def warn(sentence: str) -> None:
    """The sentence as a warning: one line on stderr in the command lines, a warning in a notebook."""
    warnings.warn(sentence, Notice, stacklevel=1)


def current_model(option: str, name: str, tell: Tell = warn) -> str:
    """The name itself, or that of the model in place of a retired one of this option, after telling the user."""
    retired = RETIRED.get(name)
    if retired is None or retired.option != option:
        return name
    tell(retired.sentence)
    return retired.replacement
