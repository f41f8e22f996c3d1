"""Words and numbers as text: glossary, units, status, comparison."""
