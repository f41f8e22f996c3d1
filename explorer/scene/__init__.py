"""The 3D picture: shapes and poses as arrays, and the handles of one client that show them."""
