"""Pages of motions in time: energies, momenta, steps and quantities over time."""
