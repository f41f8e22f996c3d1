"""Names of what a step of the lecture compares, A and B, from the designs on the page."""

from explorer.model.inputs import Inputs
from explorer.story.numbers import ControlStop
from explorer.story.steps import StepText, angle_words
from explorer.text.design_words import listed, twist_name, wave_names


def side_names(
    text: StepText, stop: ControlStop | None, a: Inputs | None, b: Inputs
) -> tuple[str, str]:
    """Names of A and B by what differs between them; both empty where there is no A.

    `stop`: the place of the control, None while it is computed. Only its own designs have the names of `text`, such as
    the best twist.
    """
    if a is None:
        return "", ""
    if a.reverse_flow != b.reverse_flow:
        return _reverse_flow_name(a), _reverse_flow_name(b)
    if a.twist_per_rev != b.twist_per_rev:
        return _active_twist_name(a), _active_twist_name(b)
    name_of_a = text.a if stop is not None and a == stop.against else ""
    name_of_b = text.b if stop is not None and b == stop.inputs else ""
    return _twist_name(a, name_of_a), _twist_name(b, name_of_b)


def _reverse_flow_name(inputs: Inputs) -> str:
    """Whether a side is computed with reverse flow."""
    if inputs.reverse_flow:
        return "computed with reverse flow"
    return "computed without reverse flow"


def _active_twist_name(inputs: Inputs) -> str:
    """The harmonics of active twist, as `2/rev twist 0.93° and 3/rev twist 1°`."""
    if not inputs.twist_per_rev:
        return "no active twist"
    return listed(wave_names(inputs.design()))


def _twist_name(inputs: Inputs, name: str) -> str:
    """The built-in twist, after its name if it has one, as `best linear twist, −10.9°/R`."""
    match inputs.law:
        case "linear" if not inputs.linear and not name:
            return "no twist"
        case "linear":
            twist = angle_words(inputs.linear)
        case "two":
            inner = angle_words(inputs.two_inner)
            twist = f"{inner} inboard, {angle_words(inputs.two_outer)} outboard"
        case _:
            return twist_name(inputs.design())
    if name:
        return f"{name}, {twist}"
    return f"twist {twist}"
