"""The trust tab's text: every row of the trust file, none of it echoed raw."""

import re

from explorer.text.status import trust_page
from rotor.validation.trust import KINDS, sensitivity_rows, trust_rows


def test_every_row_and_kind_is_on_the_page():
    html = trust_page()
    assert html.count('class="rx-trust-row"') == len(trust_rows())
    assert html.count('class="rx-trust-change"') == len({row.change for row in sensitivity_rows()})
    assert html.count("<h4>") == len(KINDS) + 1
    assert "rotor/trim/test_power.py::test_energy_identity" in html
    assert "Indicative: against another model" in html


def test_sensitivities_stand_in_columns_of_speed():
    html = trust_page()
    heading = "<span>hover</span><span>µ 0.15</span><span>µ 0.3</span>"
    assert html.count(heading) == 1
    columns = [line.count("<span>") for line in re.findall(r'rx-trust-speeds">(.*?)</div>', html)]
    assert set(columns) == {3}


def test_no_number_is_missing():
    assert not re.search(r"\b(nan|inf)\b", trust_page(), re.IGNORECASE)


def test_minus_signs_are_minus_signs():
    shown = re.sub(r'title="[^"]*"', "", trust_page())
    assert "−0.02 %" in shown
    assert not re.search(r"[> ]-\d", shown)
