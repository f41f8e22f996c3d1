"""The command line, one command a file. Degrees, knots, kW and tonnes are used only here and in the explorer."""
