"""The lecture, and flights and cases to begin from."""
