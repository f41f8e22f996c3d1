"""The lecture as values: its steps, the numbers they need, and all of it as one file without a server."""
