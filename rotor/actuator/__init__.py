"""Actuators for in-flight twist change: attainable twist, limits, mass, and net power saving (thesis chapter 5).

Fibre angles are measured from the span axis towards the direction in which the wall runs around the section. Section
axes are y aft and z up from the leading edge of the chord line [m]; twist is nose-up positive. Only the table of
contents of chapter 5 is known, so its numbers are not compared.
"""
