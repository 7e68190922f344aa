"""Compares rolled sections given by name with tables of manufacturers (EN 10365 sections catalogue, ArcelorMittal 2021;
EN 10210-2:2019 tables for hollow sections)."""
import math
import re

from cases.format.test.scene_case import SceneCase, values

# Name: A [cm^2], Iy, Iz [cm^4], It [cm^4], Iw [10^3 cm^6], as printed.
PRINTED = {
    "IPE80": ("7.64", "80.1", "8.49", "0.70", "0.12"),
    "IPE100": ("10.3", "171", "15.9", "1.20", "0.35"),
    "IPE120": ("13.2", "318", "27.7", "1.74", "0.89"),
    "IPE140": ("16.4", "541", "44.9", "2.45", "1.98"),
    "IPE160": ("20.1", "869", "68.3", "3.60", "3.96"),
    "IPE180": ("23.9", "1317", "101", "4.79", "7.43"),
    "IPE200": ("28.5", "1943", "142", "6.98", "13.0"),
    "IPE220": ("33.4", "2772", "205", "9.07", "22.7"),
    "IPE240": ("39.1", "3892", "284", "12.9", "37.4"),
    "IPE270": ("45.9", "5790", "420", "15.9", "70.6"),
    "IPE300": ("53.8", "8356", "604", "20.1", "126"),
    "IPE330": ("62.6", "11770", "788", "28.1", "199"),
    "IPE360": ("72.7", "16270", "1043", "37.3", "314"),
    "IPE400": ("84.5", "23130", "1318", "51.1", "490"),
    "IPE450": ("98.8", "33740", "1676", "66.9", "791"),
    "IPE500": ("116", "48200", "2142", "89.3", "1249"),
    "IPE550": ("134", "67120", "2668", "123", "1884"),
    "IPE600": ("156", "92080", "3387", "165", "2846"),
    "HEA100": ("21.2", "349", "134", "5.24", "2.58"),
    "HEA120": ("25.3", "606", "231", "5.99", "6.47"),
    "HEA140": ("31.4", "1033", "389", "8.13", "15.1"),
    "HEA160": ("38.8", "1673", "616", "12.2", "31.4"),
    "HEA180": ("45.3", "2510", "925", "14.8", "60.2"),
    "HEA200": ("53.8", "3692", "1336", "21.0", "108"),
    "HEA220": ("64.3", "5410", "1955", "28.5", "193"),
    "HEA240": ("76.8", "7763", "2769", "41.6", "328"),
    "HEA260": ("86.8", "10450", "3668", "52.4", "516"),
    "HEA280": ("97.3", "13670", "4763", "62.1", "785"),
    "HEA300": ("112.5", "18260", "6310", "85.2", "1200"),
    "HEA320": ("124.4", "22930", "6985", "108", "1512"),
    "HEA340": ("133.5", "27690", "7436", "127", "1824"),
    "HEA360": ("142.8", "33090", "7887", "149", "2177"),
    "HEA400": ("159", "45070", "8564", "189", "2942"),
    "HEA450": ("178", "63720", "9465", "244", "4148"),
    "HEA500": ("197.5", "86970", "10370", "309", "5643"),
    "HEA550": ("211.8", "111900", "10820", "352", "7189"),
    "HEA600": ("226.5", "141200", "11270", "398", "8978"),
    "HEB100": ("26.0", "450", "167", "9.25", "3.38"),
    "HEB120": ("34.0", "864", "318", "13.8", "9.41"),
    "HEB140": ("43.0", "1509", "550", "20.1", "22.5"),
    "HEB160": ("54.3", "2492", "889", "31.2", "47.9"),
    "HEB180": ("65.3", "3831", "1363", "42.2", "93.7"),
    "HEB200": ("78.1", "5696", "2003", "59.3", "171"),
    "HEB220": ("91.0", "8091", "2843", "76.6", "295"),
    "HEB240": ("106", "11260", "3923", "103", "487"),
    "HEB260": ("118.4", "14920", "5135", "124", "754"),
    "HEB280": ("131.4", "19270", "6595", "144", "1130"),
    "HEB300": ("149.1", "25170", "8563", "185", "1688"),
    "HEB320": ("161.3", "30820", "9239", "225", "2069"),
    "HEB340": ("170.9", "36660", "9690", "257", "2454"),
    "HEB360": ("180.6", "43190", "10140", "292", "2883"),
    "HEB400": ("197.8", "57680", "10820", "356", "3817"),
    "HEB450": ("218", "79890", "11720", "440", "5258"),
    "HEB500": ("238.6", "107200", "12620", "538", "7018"),
    "HEB550": ("254.1", "136700", "13080", "600", "8856"),
    "HEB600": ("270", "171000", "13530", "667", "10965"),
    "HEA650": ("241.6", "175200", "11720", None, "11027"),
    "HEA700": ("260.5", "215300", "12180", None, "13352"),
    "HEA800": ("285.8", "303400", "12640", None, "18290"),
    "HEA900": ("320.5", "422100", "13550", None, "24962"),
    "HEA1000": ("346.8", "553800", "14000", None, "32074"),
    "HEB650": ("286.3", "210600", "13980", None, "13363"),
    "HEB700": ("306.4", "256900", "14440", None, "16064"),
    "HEB800": ("334.2", "359100", "14900", None, "21840"),
    "HEB900": ("371.3", "494100", "15820", None, "29461"),
    "HEB1000": ("400", "644700", "16280", None, "37637"),
    "HEM100": ("53.2", "1143", "399", None, "9.93"),
    "HEM120": ("66.4", "2018", "703", None, "24.8"),
    "HEM140": ("80.6", "3291", "1144", None, "54.3"),
    "HEM160": ("97.1", "5098", "1759", None, "108"),
    "HEM180": ("113.3", "7483", "2580", None, "199"),
    "HEM200": ("131.3", "10640", "3651", None, "346"),
    "HEM220": ("149.4", "14600", "5012", None, "573"),
    "HEM240": ("199.6", "24290", "8153", None, "1152"),
    "HEM260": ("219.6", "31310", "10450", None, "1728"),
    "HEM280": ("240.2", "39550", "13160", None, "2520"),
    "HEM300": ("303.1", "59200", "19400", None, "4386"),
    "HEM320": ("312", "68130", "19710", None, "5004"),
    "HEM340": ("315.8", "76370", "19710", None, "5584"),
    "HEM360": ("318.8", "84870", "19520", None, "6137"),
    "HEM400": ("325.8", "104100", "19340", None, "7410"),
    "HEM450": ("335.4", "131500", "19340", None, "9251"),
    "HEM500": ("344.3", "161900", "19150", None, "11187"),
    "HEM550": ("354.4", "198000", "19160", None, "13516"),
    "HEM600": ("363.7", "237400", "18980", None, "15908"),
    "HEM650": ("373.7", "281700", "18980", None, "18650"),
    "HEM700": ("383", "329300", "18800", None, "21398"),
    "HEM800": ("404.3", "442600", "18630", None, "27775"),
    "HEM900": ("423.6", "570400", "18450", None, "34746"),
    "HEM1000": ("444.2", "722300", "18460", None, "43015"),
    "SHS100x5": ("18.7", "279", "279", "439", None),
    "RHS150x100x5": ("23.7", "739", "392", "807", None),
    "CHS114.3x5": ("17.2", "257", "257", "514", None),
}
SCALE = (1e-4, 1e-8, 1e-8, 1e-8, 1e-9)
# Angles (EN 10056-1:2017; sections catalogue, ArcelorMittal 2021): A [cm^2], larger and smaller principal moment
# [cm^4].
ANGLES = {
    "L30x3": ("1.74", "2.22", "0.585"),
    "L50x5": ("4.80", "17.4", "4.55"),
    "L60x6": ("6.91", "36.1", "9.44"),
    "L80x8": ("12.3", "115", "29.9"),
    "L100x10": ("19.2", "280", "73.0"),
    "L200x20": ("76.3", "4530", "1170"),
    "L100x75x8": ("13.5", "162", "34.6"),
    "L120x80x8": ("15.5", "260", "46.6"),
    "L200x100x10": ("29.2", "1290", "135"),
}
UPN = ("UPN80", "UPN100", "UPN120", "UPN140", "UPN160", "UPN180", "UPN200", "UPN220", "UPN240",
       "UPN260", "UPN280", "UPN300")
SCENE = """beamwork: 1
sections:
{sections}
nodes:
  a: {{at: [0, 0, 0], hold: all}}
  b: {{at: [1, 0, 0]}}
members:
  m: {{from: a, to: b, section: {first}, y: [0, 1, 0]}}
loads:
{loads}
analyses: {{run: {{linear: {{}}}}}}
quantities:
  uz: {{displacement: {{analysis: run, node: b, component: uz}}}}
  s: {{stress: {{analysis: run, member: m, measure: normal_max, where: 0}}}}
"""
CONSTANTS = ("A", "Iy", "Iz", "It", "Iw", "ys")


def half_unit(printed):
    """Returns half a unit of the last significant digit of a printed number. Integers with five or more digits are
    printed with four significant digits."""
    digits = len(printed.replace(".", "").lstrip("0"))
    if "." in printed:
        return 0.5 * 10**-len(printed.split(".")[1])
    return 0.5 * 10**max(0, digits - 4)


def scene(sections, material="young: 210e9, shear_modulus: 81e9, density: 7850", loads=None):
    loads = loads or {
        f"{name}_{k}": f"[{name}.{k}*1e12, 0, 0]" for name in sections for k in CONSTANTS
    }
    return SCENE.format(
        sections="\n".join(f"  {name}: {{{text}, {material}}}" for name, text in sections.items()),
        first=next(iter(sections)),
        loads="\n".join(f"  {name}: {{force: {v}, on: b}}" for name, v in loads.items()))


class ProfilesTest(SceneCase):

    def constants(self, sections):
        written = self.answered("scene", "--scene", self.scene(scene(sections))).stdout
        found = re.findall(r"^  (\w+)_([A-Z]\w?|ys): \{force: \[([^,]*),", written, re.M)
        out = {}
        for name, key, value in found:
            out.setdefault(name, {})[key] = float(value) * 1e-12
        return out

    def test_printed(self):
        names = {f"s{i}": name for i, name in enumerate(PRINTED)}
        sections = {key: f"profile: {name}" for key, name in names.items()}
        for first in range(0, len(names), 20):
            some = dict(list(sections.items())[first:first + 20])
            for key, got in self.constants(some).items():
                name = names[key]
                for constant, printed, scale in zip(CONSTANTS, PRINTED[name], SCALE):
                    if printed is not None:
                        self.assertLessEqual(
                            abs(got[constant] / scale - float(printed)),
                            half_unit(printed) * 1.001, f"{constant} of {name}: {got[constant]}")

    def test_channels(self):
        sections = {name: f"profile: {name}" for name in UPN}
        got = self.constants(sections)
        written = self.answered("scene", "--scene", self.scene(scene(sections))).stdout
        bare = {
            name: re.search(rf"^  {name}: \{{(points.*?), given", written, re.M).group(1)
            for name in UPN
        }
        walls = self.constants(bare)
        bounds = {"A": 0.05, "Iy": 0.06, "Iz": 0.15, "It": 0.25, "Iw": 0.20, "ys": 0.2}
        for name in UPN:
            for constant, bound in bounds.items():
                self.assertAlmostEqual(walls[name][constant] / got[name][constant], 1, delta=bound,
                                       msg=f"{constant} of {name}")

    def test_sizes_without_fillets(self):
        got = self.constants({
            "t": "t: {depth: 0.1, flange: 0.1, flange_thickness: 0.01, web_thickness: 0.01}",
            "l": "profile: L100x77x8",
            "given": "profile: IPE200, given: {It: 7e-8}",
        })
        self.assertAlmostEqual(got["t"]["A"], 2e-3, delta=1e-12)
        self.assertAlmostEqual(got["t"]["Iy"], 1e-3 * 0.1**2 / 12 + 2e-3 * 0.025**2, delta=1e-15)
        self.assertAlmostEqual(got["t"]["Iz"], 0.01 * 0.1**3 / 12, delta=1e-15)
        self.assertAlmostEqual(got["l"]["A"], 8e-3 * (0.1 + 0.077 - 8e-3), delta=1e-12)
        self.assertEqual(got["given"]["It"], 7e-8)
        self.assertAlmostEqual(got["given"]["A"], 28.48e-4, delta=5e-7)

    def test_angles(self):
        sections = {f"s{i}": f"profile: {name}" for i, name in enumerate(ANGLES)}
        got = self.constants(sections)
        for key, printed in zip(sections, ANGLES.values()):
            c = got[key]
            found = (c["A"] / 1e-4, max(c["Iy"], c["Iz"]) / 1e-8, min(c["Iy"], c["Iz"]) / 1e-8)
            for value, text in zip(found, printed):
                self.assertEqual(float(f"{value:.3g}"), float(text), f"{sections[key]}: {found}")
        text = scene({"l": "profile: L120x80x8", "m": "profile: L80x120x8", "e": "profile: L100x10"},
                     loads={"lb": "[l.beta*1e9, l.yc, l.ey]", "mb": "[m.beta*1e9, m.zc, m.ez]",
                            "eb": "[e.beta*1e9, e.ey, e.ez]"})
        written = self.answered("scene", "--scene", self.scene(text)).stdout
        l, m, e = ([float(v) for v in re.search(rf"{k}b: \{{force: \[(.*?)\]", written).group(1).split(",")]
                   for k in "lme")
        self.assertAlmostEqual(math.tan(abs(l[0]) * 1e-9), 0.4366, delta=1e-4)
        self.assertAlmostEqual(l[0] + m[0], 0, delta=1e-3)
        self.assertAlmostEqual(l[2], m[2], delta=1e-12)
        self.assertAlmostEqual(e[0], -math.pi / 4 * 1e9, delta=1e-3)
        self.assertAlmostEqual(e[1], -23.22e-3, delta=1e-5)  # 28.22 mm from the heel to the centroid, minus 5 mm
        self.assertAlmostEqual(e[2], -23.22e-3, delta=1e-5)

    def test_angle_bends_askew(self):
        """A force F along z must deflect a cantilever L100x75x8 by (uy, uz) = F L^3/3E (-Iyz, Iz)/(Iy Iz - Iyz^2),
        with second moments about axes parallel to the legs."""
        text = scene({"l": "profile: L100x75x8"}, loads={"p": "[0, 0, 10]", "t": "[0, 0, 0]"})
        text = text.replace("  t: {force: [0, 0, 0], on: b}", "  t: {moment: [10*l.ey, 0, 0], on: b}")
        text = text.replace("  uz:", "  uy: {displacement: {analysis: run, node: b, component: uy}}\n  uz:")
        text += "omit: {shear: yes}\n"
        Iy, Iz, Iyz = 133.0487e-8, 64.0846e-8, -53.9e-8
        got = values(self.record("solve", "--scene", self.scene(text), "-n", 4, "-f", "collocation"))
        flexibility = 10 / (3 * 210e9) / (Iy * Iz - Iyz**2)
        self.assertAlmostEqual(got["uz"] / (flexibility * Iz), 1, delta=2e-3)
        self.assertAlmostEqual(got["uy"] / (-flexibility * Iyz), 1, delta=4e-3)

    def test_stresses_of_an_angle(self):
        """A moment M about z must cause the stress -M (Iy y - Iyz z)/(Iy Iz - Iyz^2), with axes parallel to the
        legs."""
        def spandrel(sign, y, z, sy, sz, r, n=4000):
            strips = [(r / n * h, (i + 0.5) * r / n, h) for i in range(n)
                      for h in [r - math.sqrt(r * r - (r - (i + 0.5) * r / n)**2)]]
            return [(sign * a, y + sy * x, z + sz * h / 2, sign * a * h * h / 12) for a, x, h in strips]

        for name, h, b, t, root in (("L100x10", 0.1, 0.1, 0.01, 0.012), ("L100x75x8", 0.1, 0.075, 0.008, 0.01)):
            parts = spandrel(1, t, t, 1, 1, root) + spandrel(-1, b, t, -1, -1, root / 2) + spandrel(
                -1, t, h, -1, -1, root / 2)
            A = b * t + (h - t) * t + sum(p[0] for p in parts)
            y, z = (((b - t) * t * (b + t) / 2 + h * t * t / 2 + sum(p[0] * p[1] for p in parts)) / A,
                    ((h - t) * t * (h + t) / 2 + b * t * t / 2 + sum(p[0] * p[2] for p in parts)) / A)
            Iy = (b * t**3 + t * (h**3 - t**3)) / 3 + sum(p[0] * p[2]**2 + p[3] for p in parts) - A * z * z
            Iz = (t * b**3 + (h - t) * t**3) / 3 + sum(p[0] * p[1]**2 for p in parts) - A * y * y
            Iyz = (b * b * t * t + t * t * (h * h - t * t)) / 4 + sum(p[0] * p[1] * p[2] for p in parts) - A * y * z
            points = ((0, 0), (b, 0), (b, t), (0, h), (t, h))
            stress = [-100 * (Iy * (p - y) - Iyz * (q - z)) / (Iy * Iz - Iyz**2) for p, q in points]
            got = {}
            for sign in (1, -1):
                text = scene({"l": f"profile: {name}"}, loads={"p": "[0, 0, 0]"}).replace(
                    "{force: [0, 0, 0], on: b}", f"{{moment: [0, 0, {100 * sign}], on: b}}")
                text = re.sub(r"measure: \w+", "measure: normal_max", text)
                got[sign] = values(self.record("solve", "--scene", self.scene(text), "-n", 1, "-f", "collocation"))["s"]
            for sign in got:
                self.assertAlmostEqual(got[sign] / max(sign * s for s in stress), 1, delta=1e-5, msg=(name, sign))
            self.assertEqual(max(stress), stress[0])

    def test_stresses_of_mid_lines(self):
        h, b, t = 0.2, 0.1, 0.01
        Iy, Iz = t * h**3 / 6 + b * t * h**2 / 2, t * b**3 / 6 + h * t * b**2 / 2
        box = f"box: {{depth: {h}, flange: {b}, flange_thickness: {t}, web_thickness: {t}}}"
        for My, Mz in ((1000, 0), (0, 1000), (1000, 500)):
            text = scene({"c": box}, loads={"p": "[0, 0, 0]"}).replace("{force: [0, 0, 0], on: b}",
                                                                       f"{{moment: [0, {My}, {Mz}], on: b}}")
            got = values(self.record("solve", "--scene", self.scene(text), "-n", 1, "-f", "collocation"))["s"]
            self.assertAlmostEqual(got / (My * (h + t) / 2 / Iy + Mz * (b + t) / 2 / Iz), 1, delta=1e-9, msg=(My, Mz))

    def test_beam(self):
        text = scene({"beam": "profile: ipe 200"}, loads={"p": "[0, 0, 1000]"})
        text += "omit: {shear: yes}\n"
        for formulation in ("beamw_consistent", "geometrically_exact", "collocation"):
            got = values(self.record("solve", "--scene", self.scene(text), "-n", 4, "-f",
                                     formulation))
            self.assertAlmostEqual(got["uz"] / (1000 / (3 * 210e9 * 1943e-8)), 1, delta=3e-4)
            self.assertAlmostEqual(got["s"] / (1000 / 194.3e-6), 1, delta=1e-3)

    def test_other_units(self):
        text = scene({"beam": "profile: IPE200"}, loads={"p": "[0, 0, 1]"})
        ours = values(self.record("solve", "--scene", self.scene(text), "-n", 2))["uz"]
        text = text.replace("beamwork: 1", "beamwork: 1\nunits: mm, N, MPa").replace(
            "210e9, shear_modulus: 81e9, density: 7850", "210e3, shear_modulus: 81e3").replace(
                "at: [1, 0, 0]", "at: [1000, 0, 0]")
        other = values(self.record("solve", "--scene", self.scene(text), "-n", 2))["uz"]
        self.assertAlmostEqual(other / ours, 1000, delta=1e-6)

    def test_refused(self):
        for text, part in (
                ("profile: IPE210", "unknown profile 'IPE210'; the sizes of IPE are 80, 100, 120"),
                ("profile: UPN70", "sizes of UPN are 80, 100"),
                ("profile: W8x15", "unknown profile 'W8x15'; write IPE200"),
                ("profile: SHS100x60", "unknown profile 'SHS100x60'"),
                ("profile: SHS100x5x7", "unknown profile"),
                ("profile: RHS100x5", "unknown profile"),
                ("profile: CHS20x11", "unknown profile"),
                ("profile: SHS1e400x5", "unknown profile"),
                ("profile: L100x-5", "unknown profile"),
                ("profile: IPE200x2", "unknown profile"),
                ("profile: IPE200, tube: {diameter: 1, thickness: 0.1}", "profile"),
                ("rectangle: {width: 0.1, thickness: 0.01}, given: {A: 1e-3}", "given: {A}"),
        ):
            with self.subTest(text):
                self.refused(2, part, "scene", "--scene",
                             self.scene(scene({"beam": text}, loads={"p": "[0, 0, 1]"})))

    def test_taper_is_refused(self):
        text = scene({"a": "profile: IPE200", "b": "profile: IPE300"}, loads={"p": "[0, 0, 1]"})
        self.refused(2, "rolled profile", "scene", "--scene",
                     self.scene(text.replace("section: a", "section: [a, b]")))
