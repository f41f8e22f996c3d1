"""A rotor as columns, measures and equations of the engine: trims, blade, inflow, hover."""
