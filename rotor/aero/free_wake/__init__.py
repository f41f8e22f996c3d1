"""Free wake of a hovering rotor: vortex filaments that follow the flow they induce, with the loads of the blades."""
