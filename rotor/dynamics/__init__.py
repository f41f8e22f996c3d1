"""The blade as a structure: flapping, laminates, thin-walled sections, torsion."""
