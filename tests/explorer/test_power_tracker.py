"""The change of power since a slider or the blade was taken hold of."""

from dataclasses import replace

from explorer.model.inputs import Inputs
from explorer.model.undo import PAUSE, PowerTracker

START = Inputs(law="linear", linear=-8.0)
DRAG = 0.05
"""[s] between two movements of a drag."""


def at(rate: float, **others: float) -> Inputs:
    return replace(START, linear=rate, **others)


def test_the_first_solution_is_what_counting_begins_from():
    tracker = PowerTracker()
    assert tracker.solved(START, 850e3, 0.0) is None
    assert tracker.change is None


def test_a_drag_counts_from_the_power_before_it():
    tracker = PowerTracker()
    tracker.solved(START, 850e3, 0.0)
    assert tracker.solved(at(-8.5), 849e3, 60.0) == -1e3
    assert tracker.solved(at(-9.0), 847e3, DRAG) == -3e3
    assert tracker.reference == 850e3


def test_a_solution_of_the_same_inputs_keeps_the_count():
    tracker = PowerTracker()
    tracker.solved(START, 850e3, 0.0)
    tracker.solved(at(-9.0), 847e3, 60.0)
    assert tracker.solved(at(-9.0), 847e3, 0.0) == -3e3


def test_after_a_pause_the_next_movement_counts_anew():
    tracker = PowerTracker()
    tracker.solved(START, 850e3, 0.0)
    tracker.solved(at(-9.0), 847e3, 60.0)
    assert tracker.solved(at(-10.0), 845e3, PAUSE) == -2e3


def test_another_slider_counts_anew_without_a_pause():
    tracker = PowerTracker()
    tracker.solved(START, 850e3, 0.0)
    tracker.solved(at(-9.0), 847e3, 60.0)
    assert tracker.solved(at(-9.0, mass_t=9.0), 950e3, DRAG) == 103e3


def test_while_the_pointer_is_down_neither_a_pause_nor_a_second_input_ends_the_grab():
    tracker = PowerTracker()
    tracker.solved(START, 850e3, 0.0)
    tracker.grab()
    tracker.solved(at(-9.0), 847e3, 60.0)
    assert tracker.solved(at(-9.5, two_division=0.6), 846e3, 10.0) == -4e3
    tracker.release()
    assert tracker.change == -4e3
    assert tracker.solved(at(-10.0, two_division=0.6), 845e3, 10.0) == -1e3


def test_a_second_grab_of_the_same_slider_counts_from_where_it_stands():
    tracker = PowerTracker()
    tracker.solved(START, 850e3, 0.0)
    tracker.solved(at(-9.0), 847e3, 60.0)
    tracker.grab()
    assert tracker.solved(at(-9.5), 846e3, DRAG) == -1e3


def test_a_step_without_trim_has_no_change_and_does_not_spoil_the_next():
    tracker = PowerTracker()
    tracker.solved(START, 850e3, 0.0)
    tracker.solved(at(-9.0), 847e3, 60.0)
    assert tracker.solved(at(-30.0), None, DRAG) is None
    assert tracker.solved(at(-9.5), 846e3, DRAG) == -4e3


def test_reset_drops_what_was_kept():
    tracker = PowerTracker()
    tracker.solved(START, 850e3, 0.0)
    tracker.solved(at(-9.0), 847e3, 60.0)
    tracker.reset()
    assert tracker.change is None
    assert tracker.solved(at(-12.0), 840e3, 0.0) is None


def test_another_rotor_is_no_change_of_power():
    tracker = PowerTracker()
    tracker.solved(START, 850e3, 0.0)
    tracker.solved(at(-9.0), 847e3, 60.0)
    assert tracker.solved(replace(at(-9.0), rotor="r22", mass_t=0.6), 74e3, 60.0) is None
    assert tracker.solved(replace(at(-9.5), rotor="r22", mass_t=0.6), 73e3, 60.0) == -1e3


def test_a_grab_before_the_new_design_has_a_power_counts_from_its_first():
    """Reset, then a handle taken at once: the change is counted, not lost for as long as it is held."""
    tracker = PowerTracker()
    tracker.solved(START, 850e3, 0.0)
    tracker.reset()
    tracker.grab()
    assert tracker.solved(START, 850e3, 0.0) == 0.0
    assert tracker.solved(at(-9.0), 847e3, DRAG) == -3e3
    tracker.release()
    assert tracker.change == -3e3


def test_what_no_hand_has_moved_does_not_count():
    """A lecture sets another design while the answer to the last drag is still on its way."""
    tracker = PowerTracker()
    tracker.solved(START, 850e3, 0.0)
    tracker.solved(at(-9.0), 847e3, 60.0)
    tracker.reset()
    assert tracker.solved(at(-9.5), 846e3, DRAG) is None
    assert tracker.solved(at(-16.0, mass_t=10.0), 1349e3, 60.0) is None
    assert tracker.reference is None
    tracker.touch()
    assert tracker.solved(at(-16.5, mass_t=10.0), 1347e3, DRAG) == -2e3


def test_a_slider_that_is_let_go_before_its_last_answers_counts_from_the_press():
    """The release comes at once, the answers to the last movements of the drag later."""
    tracker = PowerTracker()
    tracker.solved(START, 1047e3, 0.0)
    tracker.grab()
    tracker.solved(at(-9.0), 1000e3, 60.0)
    tracker.solved(at(-10.0), 901e3, 3.0)  # It was held still in between.
    tracker.release()
    assert tracker.solved(at(-10.5), 915e3, DRAG) == -132e3
    assert tracker.solved(at(-10.6), 929e3, DRAG) == -118e3
