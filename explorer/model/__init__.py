"""What the page holds as values: inputs, test stands, A and B, undo, drags, power sensitivities. None knows viser."""
