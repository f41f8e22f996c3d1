"""Design files, rotor files, section files, shipped rotors, and the provenance of a result."""
