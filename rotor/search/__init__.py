"""The machinery behind `rotor.optimise`: what is searched, evaluated, descended, and how flat the optimum is."""
