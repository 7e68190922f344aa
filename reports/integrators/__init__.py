"""The page of integrators: error of time against cost, stability, iterations."""
