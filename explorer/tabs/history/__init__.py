"""Undo and redo, and the designs that are kept."""
