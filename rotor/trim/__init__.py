"""Trim in hover and forward flight: equations, Newton's method, adjoint gradient, power, and the `Solution`."""
