"""The steady stretch of the rod of spin_up at 6 rad/s. EA x'' = -rho A Omega^2 x, x(0) = 0 and x'(L) = 1 give x = sin(k
X)/(k cos(k L)) with k = Omega sqrt(rho A/EA). The stretch is tan(k L)/k - L, which is 6.2e-5 more than the first-order
value rho A Omega^2 L^3/(3 EA).
"""
from mpmath import mp, mpf, sqrt, tan

mp.dps = 30


def stretch(omega, length, mass, EA):
    k = mpf(omega) * sqrt(mpf(mass) / mpf(EA))
    return tan(k * length) / k - length


def rows():
    yield ("spin_up", "time=*;integrator=*;step=*;tolerance=*", "steady_stretch",
           stretch(6, mpf(10), "1.2", "2.8e7"), "m")
