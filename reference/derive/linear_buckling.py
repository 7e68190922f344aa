"""Lateral-torsional buckling of narrow beams, the shear-flexible column, and the right-angle frame, with linear
prestress.

Lateral buckling: Pi = 1/2 int EI w''^2 + GJ phi'^2 + EIw phi''^2 + int M phi w'' gives EI w'' = -M phi. With x in
units of L and K = L^2 GJ/EIw, phi''''/K - phi'' - (gamma m(x))^2 phi = 0, where M = gamma m sqrt(EI GJ)/L. Loads act
at the shear centre. Frame: each leg has the spatial moment (m_x, m_y + f x, M), so GJ t_x' = m_x - M t_y, EI t_y' =
m_y + f x + M t_x and w' = -t_y.
"""
from mpmath import cos, det, findroot, matrix, mp, mpf, pi, sin, sqrt, zeros

from reference.derive import defaults

mp.dps = 40
TERMS = 160
LEG_TERMS = 64  # truncation error 7^64/64! = 1e-35

# coefficients of m(x) in powers of x, measured from the end without moment, and x at the other end of the beam or
# half beam
LOADS = {
    "tip": ([0, 1], 1), "distributed": ([0, 0, mpf(1) / 2], 1),
    "mid": ([0, mpf(1) / 2], mpf(1) / 2), "mid_distributed": ([0, mpf(1) / 2,
                                                               -mpf(1) / 2], mpf(1) / 2)
}
GUESS = {"tip": "4.0", "distributed": "12.9", "mid": "16.9", "mid_distributed": "28.3"}


def _square(m):
    out = [mpf(0)] * (2 * len(m) - 1)
    for i, a in enumerate(m):
        for j, b in enumerate(m):
            out[i + j] += a * b
    return out


def _series(start, K, gamma, m2, terms):
    """Returns the power series about x = 0 of the solution with given phi, phi', (phi'', phi''')."""
    c = [mpf(v) / f for v, f in zip(start, (1, 1, 2, 6))]
    while len(c) < terms:
        n = len(c) - (4 if K else 2)
        load = gamma ** 2 * sum(a * c[n - i] for i, a in enumerate(m2) if 0 <= n - i)
        if K:
            c.append(
                K * ((n + 2) * (n + 1) * c[n + 2] + load) / ((n + 4) * (n + 3) * (n + 2) * (n + 1)))
        else:
            c.append(-load / ((n + 2) * (n + 1)))
    return c


def _value(c, x, order):
    total = mpf(0)
    for n in range(order, len(c)):
        factor = mpf(1)
        for k in range(order):
            factor *= n - k
        total += factor * c[n] * x ** (n - order)
    return total


def _condition(load, K, gamma, terms):
    """Returns the determinant of the conditions at x = end for the solutions that satisfy those at x = 0."""
    m, end = LOADS[load]
    m2, end = _square(m), mpf(end)
    cantilever = load in ("tip", "distributed")
    if not K:  # x = 0 is the free tip, where phi' = 0, or the fork, where phi = 0
        c = _series((1, 0) if cantilever else (0, 1), K, gamma, m2, terms)
        return _value(c, end, 0 if cantilever else 1)
    # tip: phi'' = 0 and phi''' = K phi'; fork: phi = phi'' = 0; root: phi = phi' = 0; middle: phi' = phi''' = 0
    starts = ((1, 0, 0, 0), (0, 1, 0, K)) if cantilever else ((0, 1, 0, 0), (0, 0, 0, 1))
    orders = (0, 1) if cantilever else (1, 3)
    a, b = (_series(s, K, gamma, m2, terms) for s in starts)
    return _value(a, end, orders[0]) * _value(b, end, orders[1]) - _value(
        a, end, orders[1]) * _value(b, end, orders[0])


def lateral_load(load, K, guess, terms=TERMS):
    """Returns the root gamma near `guess`. `terms` must be several times exp(1) sqrt K. The determinant, which grows
    with exp(sqrt K), is divided by its size near the root."""
    K, guess = mpf(K), mpf(guess)
    unit = abs(_condition(load, K, guess * mpf("1.01"), terms))
    return findroot(lambda g: _condition(load, K, g, terms) / unit, guess, tol=mpf(10) ** -30)


def lateral_rows():
    for load in LOADS:
        yield "lateral_buckling", defaults.differing("lateral_buckling",
                                                     load=load), "load_factor", lateral_load(
                                                         load, 0, GUESS[load]), "1"
    for K, guess in ((1, "15.7"), (4, "9.75"), (16, "6.81")):
        yield "lateral_buckling", f"K={K}", "load_factor", lateral_load("tip", K, guess), "1"
    for load, K, guess in (("distributed", 4, "39.7"), ("distributed", 40, "20.7"),
                           ("mid", 4, "31.7"), ("mid", 40, "19.2"), ("mid_distributed", 4, "52.7"),
                           ("mid_distributed", 40, "31.7")):
        yield "lateral_buckling", f"load={load};K={K}", "load_factor", lateral_load(load, K,
                                                                                    guess), "1"


def column_load(given):
    """Returns the critical load of shear_column. Engesser: 1/P = 1/P_E + 1/GA_s. Haringx: GA_s (sqrt(1 + 4 P_E/GA_s) -
    1)/2. P_E = pi^2 EI/l^2 and GA_s = 5/6 G A."""
    at = defaults.decimals("shear_column", given)
    euler = pi ** 2 * at["young"] * at["side"] ** 4 / 12 / at["length"] ** 2
    shear = at["shear_modulus"] * at["side"] ** 2 * 5 / 6
    if at["shear_stability"] == "engesser":
        return euler / (1 + euler / shear)
    return shear * (sqrt(1 + 4 * euler / shear) - 1) / 2


def column_row(given):
    return "shear_column", defaults.differing("shear_column",
                                              **given), "buckling_load", column_load(given), "N"


COLUMNS = [{"length": length, "shear_modulus": G} for length in ("1", "0.1")
           for G in (27 * 10 ** 9, 27 * 10 ** 8, 7 * 10 ** 7)]
COLUMNS += [{"length": "0.7", "side": "0.09", "young": 12 * 10 ** 9, "shear_modulus": 5 * 10 ** 8}]


def column_rows():
    for given in COLUMNS:
        yield column_row(given)
        yield column_row({**given, "shear_stability": "haringx"})


def _leg(x, M, EI, GJ):
    """Returns (w, t_x, t_y) at x as linear functions of their values at the corner and of (m_x, m_y, f) [3, 6], from
    power series."""
    out = zeros(3, 6)
    for column in range(6):
        unit = [mpf(1) if column == k else mpf(0) for k in range(6)]
        w, tx, ty = [unit[0]], [unit[1]], [unit[2]]
        mx, my, f = unit[3:]
        for n in range(LEG_TERMS):
            w.append(-ty[n] / (n + 1))
            tx.append(((mx if n == 0 else 0) - M * ty[n]) / GJ / (n + 1))
            ty.append(((my if n == 0 else f if n == 1 else 0) + M * tx[n]) / EI / (n + 1))
        for i, series in enumerate((w, tx, ty)):
            out[i, column] = sum(c * x ** n for n, c in enumerate(series))
    return out


def frame_determinant(M, EI, GJ, length, angle):
    """The ends of the legs remain in the plane and rotate only about the normal of the plane.

    The axes of the first leg are (x, y, z); those of the second leg are rotated about z. The load of the second leg
    is opposite to that of the first.
    """
    first, second = _leg(length, M, EI, GJ), _leg(length, -M, EI, GJ)
    c, s = cos(angle), sin(angle)
    turn = matrix([[1, 0, 0, 0, 0, 0], [0, c, s, 0, 0, 0], [0, -s, c, 0, 0, 0],
                   [0, 0, 0, -c, -s, 0], [0, 0, 0, s, -c, 0], [0, 0, 0, 0, 0, -1]])
    both = zeros(6, 6)
    second = second * turn
    for i in range(3):
        for j in range(6):
            both[i, j], both[3 + i, j] = first[i, j], second[i, j]
    return det(both)


FRAMES = ({}, {"angle": "1"}, {"angle": "2.5"}, {"leg": "0.6", "poisson": "0"}, {
    "leg": "0.1", "thickness": "0.002", "angle": "2"
}, {"young": "210000000000", "depth": "0.05", "poisson": "0.45"})


def frame_rows():
    """Yields the rows of frames of thin strips with GJ = G b t^3/3. The factor of the second critical moment is between
    1.4 pi and 2 pi for every angle."""
    for given in FRAMES:
        value = defaults.decimals("right_angle_frame", given)
        E, nu, b, t, length, angle = (value[k] for k in ("young", "poisson", "depth", "thickness",
                                                         "leg", "angle"))
        EI, GJ = E * b * t ** 3 / 12, E / (2 * (1 + nu)) * b * t ** 3 / 3
        # with lengths relative to a leg and forces relative to sqrt(EI GJ)/leg^2, the result depends only on EI/GJ
        root = sqrt(EI / GJ)
        at = ";".join(f"{k}={v}" for k, v in given.items())
        for name, bracket in (("critical_moment", ("3.0", "3.3")), ("critical_moment_2", ("4.4",
                                                                                          "6.25"))):
            factor = findroot(lambda g: frame_determinant(g, root, 1 / root, mpf(1), angle),
                              [mpf(x) for x in bracket],
                              tol=mpf(10) ** -25,
                              solver="anderson")
            yield "right_angle_frame", at, name, factor * sqrt(EI * GJ) / length, "N m"


def rows():
    yield from lateral_rows()
    yield from column_rows()
    yield from frame_rows()
