"""The Probe tab: one blade element at (r, ψ), drawn, in numbers and in the scene."""
