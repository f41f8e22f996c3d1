"""The rotor disk: fields on a polar grid, as a picture, with its lines and its colour bar."""
