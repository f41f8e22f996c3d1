"""Data types: twist laws, blade, rotor, aircraft, flight condition, and the `Design` that holds them. No arrays."""
