"""The steady stretch of the rod of spin_up at 6 rad/s: EA x'' = -rho A Omega^2 x, x(0) = 0, x'(L) = 1, so that x = sin(k
X)/(k cos(k L)), k = Omega sqrt(rho A/EA), and the stretch is tan(k L)/k - L (6.2e-5 more than the first-order value
rho A Omega^2 L^3/(3 EA)).
"""
from mpmath import mp, mpf, sqrt, tan

mp.dps = 30


def stretch(omega, length, mass, EA):
    k = mpf(omega) * sqrt(mpf(mass) / mpf(EA))
    return tan(k * length) / k - length


def rows():
    yield ("spin_up", "time=*;integrator=*;step=*;tolerance=*", "steady_stretch",
           stretch(6, mpf(10), "1.2", "2.8e7"), "m")
