"""Computes the torsional coefficients of the potential of the third-order sheet element (N Eqs. 44-51, App. B) with 120
digits and prints 17 of them.

The coefficients are computed directly from the definitions, with L = GJ = 1 and EIw = 1/lambda^2. The bimoment is the
hyperbolic function of App. B, with its factor 1/lambda^4 restored. Every integrand is a sum of polynomials times
exp(k lambda x), which is integrated term by term. The results verify the form that follows from integration by parts.

usage: bimoment_coefficients.py > elements/test/bimoment_values.h
"""
from mpmath import exp, mp, mpf, nstr

mp.dps = 120
LAMBDAS = ("0.001", "0.03", "0.5", "2.385", "5.9", "6.1", "27.3", "1000", "10000")
TWIST = {"PX": (0, 6, -6), "WP": (1, -4, 3), "WQ": (0, -2, 3)}  # phi_x' of N Eq. 19
# f = M_x' and the end values m0 and m1 of M_x, for the stresses M~yp and M~yq and the angles zp and zq
LOADS = {
    "corrected": {
        "PP": ((4, -10, 6), -1, 0), "PQ": ((2, -8, 6), 0, 0), "QP": ((0, -4, 6), 0, 0),
        "QQ": ((0, -2, 6), 0, 1)
    },
    "printed": {
        "PP": ((6, -18, 12), -1, 0), "PQ": ((2, -12, 12), 0, 0), "QP": ((2, -12, 12), 0, 0),
        "QQ": ((0, -6, 12), 0, 1)
    },
}


class Sum:
    """A sum over k of p_k(x) exp(k lambda x). p_k contains coefficients in ascending powers of x."""

    def __init__(self, lam, parts):
        self.lam, self.parts = lam, {k: [mpf(c) for c in p] for k, p in parts.items()}

    def __add__(self, other):
        parts = {k: list(p) for k, p in self.parts.items()}
        for k, p in other.parts.items():
            mine = parts.setdefault(k, [])
            mine.extend([mpf(0)] * (len(p) - len(mine)))
            for i, c in enumerate(p):
                mine[i] += c
        return Sum(self.lam, parts)

    def scaled(self, factor):
        return Sum(self.lam, {k: [factor * c for c in p] for k, p in self.parts.items()})

    def __mul__(self, other):
        out = Sum(self.lam, {})
        for k, p in self.parts.items():
            for m, q in other.parts.items():
                product = [mpf(0)] * (len(p) + len(q) - 1)
                for i, a in enumerate(p):
                    for j, b in enumerate(q):
                        product[i + j] += a * b
                out += Sum(self.lam, {k + m: product})
        return out

    def derivative(self):
        parts = {}
        for k, p in self.parts.items():
            parts[k] = [
                k * self.lam * c + (i + 1) * p[i + 1] if i + 1 < len(p) else k * self.lam * c
                for i, c in enumerate(p)
            ]
        return Sum(self.lam, parts)

    def integral(self):
        total = mpf(0)
        for k, p in self.parts.items():
            rate = k * self.lam
            power = (exp(rate) - 1) / rate if k else mpf(1)
            for n, c in enumerate(p):
                if n:
                    power = (exp(rate) - n * power) / rate if k else mpf(1) / (n + 1)
                total += c * power
        return total


def polynomial(lam, coefficients):
    return Sum(lam, {0: coefficients})


def bimoments(lam, loads):
    sine, half = (exp(lam) - exp(-lam)) / 2, (exp(lam / 2) + exp(-lam / 2)) / 2
    c1 = Sum(lam, {1: [1 / (2 * sine)], -1: [1 / (2 * sine)]})
    c2 = Sum(lam, {-1: [exp(lam) / (2 * sine)], 1: [exp(-lam) / (2 * sine)]})
    B = {
        "M": Sum(lam,
                 {-1: [exp(lam / 2) / (2 * half * lam)], 1: [-exp(-lam / 2) / (2 * half * lam)]})
    }
    for name, ((f0, f1, f2), m0, m1) in loads.items():
        particular = polynomial(lam,
                                [(f0 + 2 * f2 / lam ** 2) / lam ** 2, f1 / lam ** 2, f2 / lam ** 2])
        B[name] = particular + c1.scaled((-m1 - (2 * f2 + f1) / lam ** 2) / lam) + c2.scaled(
            (f1 / lam ** 2 + m0) / lam)
    return B, {"WP": c2.scaled(-1 / lam), "WQ": c1.scaled(1 / lam)}


def coefficients(lam, loads):
    B, ends = bimoments(lam, loads)
    T = {}
    for name in B:
        Mx = [1] if name == "M" else None
        if Mx is None:
            (f0, f1, f2), m0, _ = loads[name]
            Mx = [m0, f0, mpf(f1) / 2, mpf(f2) / 3]
        T[name] = polynomial(lam, Mx) + B[name].derivative()
    twist = {name: polynomial(lam, p) for name, p in TWIST.items()}
    stress, values = list(B), []
    for i, a in enumerate(stress):
        for b in stress[:i + 1]:
            values.append((T[a] * T[b] + (B[a] * B[b]).scaled(lam ** 2)).integral())
    for a in stress:
        for name, rate in twist.items():
            value = T[a] * rate + B[a] * rate.derivative()
            if name in ends:
                value += (T[a] * ends[name].derivative() +
                          (B[a] * ends[name]).scaled(lam ** 2)).scaled(-1)
            values.append(value.integral())
    for a, b in (("WP", "WP"), ("WP", "WQ"), ("WQ", "WQ")):
        x, y = ends[a], ends[b]
        value = x.derivative() * twist[b] + y.derivative() * twist[a] + x * twist[b].derivative(
        ) + y * twist[a].derivative()
        value += (x.derivative() * y.derivative() + (x * y).scaled(lam ** 2)).scaled(-1)
        values.append(value.integral() / (2 if a == b else 1))
    return values


def main():
    print(
        "/* Written by reference/derive/bimoment_coefficients.py: torsional coefficients of the third-order potential for L = GJ = 1,"
    )
    print(
        " * EIw = 1/lambda^2.  Order: A of the unit torques M, PP, PQ, QP, QQ (lower triangle by rows), b of each of them with px, Wp, Wq,"
    )
    print(" * P0 of Wp^2, Wp Wq, Wq^2. */")
    print(
        "#ifndef BEAMWORK_TEST_BIMOMENT_VALUES_H\n#define BEAMWORK_TEST_BIMOMENT_VALUES_H\n\n/* clang-format off */\n"
    )
    print("enum { BIMOMENT_VALUES = 33 };\n")
    print(
        "static const struct {\n    int printed; /* sign of u_y in M_x */\n    double lambda, value[BIMOMENT_VALUES];\n} bimoment_values[] = {"
    )
    for printed, form in enumerate(LOADS):
        for lam in LAMBDAS:
            values = coefficients(mpf(lam), LOADS[form])
            text = [
                nstr(v, 17, min_fixed=0, max_fixed=0) if abs(v) > mpf(10) ** -60 else "0"
                for v in values
            ]
            lines = [", ".join(text[i:i + 5]) for i in range(0, len(text), 5)]
            print(f"    {{{printed},\n     {lam},\n     {{" + ",\n      ".join(lines) + "}},")
    print("};\n\n#endif")


if __name__ == "__main__":
    main()
