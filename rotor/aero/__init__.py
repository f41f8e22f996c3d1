"""The air: disk grid, blade-element loads and their derivatives, losses, momentum theory, inflow models."""
