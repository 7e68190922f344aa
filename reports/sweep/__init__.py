"""Pages of sweeps: the ranges of the parameters over which formulations are within a tolerance."""
