"""Sweeps: the range of the parameters over which a formulation is within a tolerance."""
