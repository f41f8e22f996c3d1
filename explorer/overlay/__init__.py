"""The frame of the page around viser's canvas and panels: bars, cards and charts as HTML, with a bridge to Python."""
