"""The Studies tab: results of studies in charts; a click takes a point."""
