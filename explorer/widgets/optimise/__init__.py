"""Optimise, Map, Schedule and *Where to twist*: what is asked of the optimiser, and what it answers."""
