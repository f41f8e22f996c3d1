"""The menu of rotors and the files of one's own."""
