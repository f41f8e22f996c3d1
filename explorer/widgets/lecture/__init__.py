"""The lecture, flights and cases to begin from, presenting and following."""
