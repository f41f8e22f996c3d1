"""The twist of least power of a design, in one call."""

from collections.abc import Sequence

from rotor.design.design import Design, require_design
from rotor.design.flight import number
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.objective import Quantity, at_condition
from rotor.optimisation.results import Optimum
from rotor.optimisation.search import STARTS, Limits, Search, run_search


def optimise(
    design: Design,
    concept: str = "two-segment",
    *,
    division: float | Sequence[float] | None = None,
    quantity: Quantity = "total",
    limits: Limits | None = None,
    starts: int = STARTS,
    seed: int = 0,
) -> Optimum:
    """The twist of a concept with the least power at the design's own flight condition.

    concept: `linear`, `quadratic`, `two-segment`, `three-segment`, `free-form` or another name in `CONCEPTS`.
    division: r/R where the segments meet, for the concepts that hold it fixed.
    quantity: the power to make small, `total` or `induced`.
    limits: bounds on twist rates, on the change of twist and on the stalled area; by default the concept's own bounds.
    starts, seed: number of descents, and the seed of their starting points.

    The design's own twist is the baseline of `saving_percent`. A search always returns; its `status` and `message` say
    how it ended. Raises TypeError or ValueError with one sentence for an argument that cannot be used.
    """
    for name, value in (("starts", starts), ("seed", seed)):
        if not isinstance(value, int):  # pyright: ignore[reportUnnecessaryIsInstance] - notebooks pass anything
            raise TypeError(f"{name} is {value!r}: give a whole number")
    divisions = (division,) if isinstance(division, int | float) else division
    if divisions is not None:
        divisions = [number("division", item, "0.5") for item in divisions]
    search = Search(
        design=require_design(design),
        concept=find_concept(concept, divisions),
        objective=at_condition(design, quantity),
        limits=limits or Limits(),
        starts=starts,
        seed=seed,
    )
    return run_search(search)
