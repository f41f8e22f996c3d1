"""Design files, rotor files, section files, shipped rotors, and where a result came from."""
