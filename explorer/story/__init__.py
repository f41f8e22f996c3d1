"""The lecture as values: its steps, the numbers they need, and both as records for the page."""
