"""The Actuator tab: the blade cut open, its section, the electrodes, the verdicts."""
