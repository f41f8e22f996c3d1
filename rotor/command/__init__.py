"""The command line, one command a file. Degrees, knots, kW and tonnes exist only here and in the explorer."""
