"""The twist of least power: concepts, objective, limits, search, schedule."""
