"""The twist of least power: objective, search, band, schedule, mission."""
