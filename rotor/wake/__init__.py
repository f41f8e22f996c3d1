"""Inflow that answers to where on the disk the lift is: dynamic wake, sector momentum, vortex lattice, ideal bound.

Everything here is a linear map from a load field d(r, ψ) to an induced inflow λ_i(r, ψ), given the wake's direction:
d = dC_T/dr of the whole rotor as if smeared over the azimuth, so that C_T = ⟨∫ d dr⟩ with ⟨⟩ the mean over ψ and
C_Pi = ⟨∫ λ_i d dr⟩. λ_i and all velocities are over ΩR, positive down; fields are (elements, azimuths).
"""
