"""The design in the address and in files."""
