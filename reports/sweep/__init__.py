"""Sweeps: over which range of its parameters a formulation is within a tolerance."""
