"""The designs of a session as one HTML file that opens without a server."""
