"""Whether a recomputed row of the trust page is the shipped one."""

from rotor.validation.trust import TrustRow, trust_rows

SHIPPED = {(row.set, row.what, row.against): row for row in trust_rows()}


def still_true(made: TrustRow) -> None:
    """Bounds must hold, numbers agree within their tolerance, verdicts be the same."""
    key = (made.set, made.what, made.against)
    assert key in SHIPPED, f"{key} is not in assets/trust.csv: make trust"
    shipped = SHIPPED[key]
    assert (made.target, made.verdict) == (shipped.target, shipped.verdict), key
    assert made.error is not None
    assert shipped.error is not None
    if shipped.bound:
        assert (made.error < shipped.allowed) == (shipped.verdict != "missed"), key
    else:
        assert abs(made.error - shipped.error) <= shipped.allowed, (
            f"{key}: {shipped.error} → {made.error}"
        )
