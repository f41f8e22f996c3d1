"""What every folder of `rotor` stands on and no rotor needs: types, units, tables, charts, processes."""
