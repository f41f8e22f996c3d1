"""The design in the address and in files, and the view in the address."""
