"""The trust tab's text: every row of the trust file, none of it echoed raw."""

import re

from explorer.text.status import trust_page
from rotor.validation.trust import KINDS, trust_rows


def test_every_row_and_kind_is_on_the_page():
    html = trust_page()
    assert html.count('class="rx-trust-row"') == len(trust_rows())
    assert html.count("<h4>") == len(KINDS)
    assert "rotor/trim/test_power.py::test_energy_identity" in html
    shown = re.sub(r'title="[^"]*"', "", html)
    assert not re.search(r"[> ]-\d|\b(nan|inf)\b", shown, re.IGNORECASE)
