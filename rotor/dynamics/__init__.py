"""The blade as a structure: flapping, thin-walled sections, torsion."""
