"""Long work in warm worker processes."""
