"""What stands around the pages: who is let in, who waits, whose turn it is, and the page that is served."""
