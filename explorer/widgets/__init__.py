"""The parts of the page a user operates, one folder or file each."""
