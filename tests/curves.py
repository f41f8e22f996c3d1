"""The lines and points of a chart, for tests that read their values."""

from rotor.support.chart import Band, Chart, Line, Points


def curves(chart: Chart) -> list[Line | Points]:
    """Its series but the bands, in order."""
    return [one for one in chart.series if not isinstance(one, Band)]
