"""What leaves the page: shapes, tables, pictures, text that runs elsewhere."""
