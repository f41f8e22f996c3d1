"""One residual and one linearisation of a rotor in periodic flight; knows no rotor, no trim and no wake."""
