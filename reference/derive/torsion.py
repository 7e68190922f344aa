"""Non-uniform torsion: twist_ratio = phi GJ/(T L) of a cantilever whose root cannot warp."""
from mpmath import mp, mpf, tanh

mp.dps = 40


def rows():
    for kl in ("0.001", "0.5", "1", "2", "5", "10", "20"):
        x = mpf(kl)
        at = [] if kl == "1" else [f"kL={kl}"]
        yield "warping_torsion", ";".join(at), "twist_ratio", 1 - tanh(x) / x, "1"
        yield "warping_torsion", ";".join(at + ["ends=fixed"]), "twist_ratio", 1 - tanh(x / 2) / (x / 2), "1"
