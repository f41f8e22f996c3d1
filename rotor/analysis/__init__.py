"""Results from many solutions: sweeps, the power waterfall, the ideal bound."""
