"""Non-uniform torsion: twist_ratio = phi GJ/(T L) of a cantilever whose root cannot warp."""
from mpmath import mp, mpf, tanh

from reference.derive import defaults

mp.dps = 40


def twist_ratio(kl, ends):
    """1 - tanh(x)/x; x: kL of a cantilever; between two ends that cannot warp each half is one."""
    x = mpf(kl) / (2 if ends == "fixed" else 1)
    return 1 - tanh(x) / x


def rows():
    for kl in ("0.001", "0.5", "1", "2", "5", "10", "20"):
        for ends in ("cantilever", "fixed"):
            yield "warping_torsion", defaults.differing("warping_torsion", kL=kl, ends=ends), "twist_ratio", twist_ratio(kl, ends), "1"
