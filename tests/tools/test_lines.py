"""Random command lines end as they should: few and short ones here, more every night."""

import pytest

from tests.tools.lines import COMMANDS, SHORT, run


@pytest.mark.parametrize(
    ("count", "commands"), [(20, SHORT), pytest.param(1000, COMMANDS, marks=[pytest.mark.slow, pytest.mark.nightly])]
)
def test_no_command_line_ends_badly(count: int, commands: tuple[str, ...]):
    codes, wrong = run(count, 1, commands)
    assert wrong == []
    assert codes[0]
    assert codes[2]
