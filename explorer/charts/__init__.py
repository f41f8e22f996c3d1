"""Charts: their data, the panel of live ones, and drawings as SVG."""
