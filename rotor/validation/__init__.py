"""Our number beside every measured point of rotors that were tested. Nothing is fitted to these points."""
