"""Could an actuator make the change of twist, and would it pay? (chapter 5 of the document)

Materials and laminate, blade section, rotating blade in torsion, placement, limits, verdict: one file each. Angles of
fibres are from the span axis towards the direction in which the wall runs around the section; section axes are y aft
and z up from the leading edge of the chord line [m]; twist is nose-up positive. The document's chapter 5 is known by
its contents only, so nothing here is compared with its numbers.
"""
