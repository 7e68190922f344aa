"""Loads along a member with one element and linear theory, for every formulation: as exact as forces
and moments at the nodes are. Closed forms are those of Timoshenko's beam (J.S. Przemieniecki, Theory
of Matrix Structural Analysis, 1968, sec. 5 and 10)."""
import json
import unittest

from harness.tools.kit.program import ProgramTest, run

L, q, m = 0.7, 3.0, 2.0
E, G, A, Iy, Iz, It = 70e3, 27e3, 0.04, 3e-4, 2e-4, 4e-4
HELD = {"clamped": ("all", "all"), "cantilever": ("all", "[]"), "propped": ("all", "[ux, uy, uz, rx]"),
        "hinged": ("[ux, uy, uz, rx]", "[ux, uy, uz]"), "guided": ("all", "[ux, rx, ry, rz]")}
#: Rigid in shear along y, in one theory or in both directions.
RIGID = {"beamw_vlasov": "yz", "sheet_second": "y", "sheet_third": "y", "sheet_third_printed": "y"}


def flexibility(formulation, along):
    """1/(k G A) [1/N] of the formulation: its section is rigid where it is."""
    return 0 if along in RIGID.get(formulation, "") else 12 / (G * A)


def scene(formulation, support, loads):
    shear = " ".join(["F: [%g, 0, 0, 0, %g, 0, 0, 0, 0]" % tuple(
        flexibility(formulation, a) * G for a in "yz")])
    p, held = HELD[support]
    return f"""beamwork: 1
sections: {{s: {{constants: {{A: {A}, Iy: {Iy}, Iz: {Iz}, It: {It}, {shear}}}, young: {E},
               shear_modulus: {G}}}}}
nodes: {{a: {{at: [0, 0, 0], hold: {p}}}, b: {{at: [{L}, 0, 0], hold: {held}}}}}
members: {{beam: {{from: a, to: b, section: s, y: [0, 1, 0]}}}}
loads: {{{loads}}}
analyses: {{li: {{linear: {{}}}}}}
quantities:
""" + "".join(
        f"  {kind}{end}: {{internal: {{analysis: li, member: beam, where: {where}, resultant: {kind}}}}}\n"
        for kind in ("N", "Qy", "Qz", "Mx", "My", "Mz") for end, where in (("0", 0), ("h", 0.5), ("1", 1))
    ) + "".join(
        f"  {c}: {{displacement: {{analysis: li, node: b, component: {c}}}, unit: \"{unit}\"}}\n"
        for c, unit in (("ux", "m"), ("uy", "m"), ("uz", "m"), ("rx", "rad"), ("ry", "rad"),
                        ("rz", "rad")) if support not in ("clamped",))


def forces(formulation, support):
    """Exact values under forces q along y, z and x and moments m about x."""
    exact = {}
    for along, turn, moment, inertia, sign in (("y", "rz", "Mz", Iz, 1), ("z", "ry", "My", Iy, -1)):
        EI, soft = E * inertia, flexibility(formulation, along)
        tip = q * L**4 / (8 * EI) + soft * q * L**2 / 2
        if support == "cantilever":
            exact.update({f"u{along}": tip, turn: sign * q * L**3 / (6 * EI),
                          f"{moment}0": sign * q * L**2 / 2, f"{moment}h": sign * q * L**2 / 8,
                          f"Q{along}0": q * L, f"Q{along}1": 0})
        elif support == "propped":
            prop = tip / (L**3 / (3 * EI) + soft * L)
            exact.update({f"Q{along}0": q * L - prop, f"Q{along}1": -prop,
                          f"{moment}0": sign * (q * L**2 / 2 - prop * L), f"{moment}1": 0})
        elif support == "hinged":
            exact.update({f"{moment}h": -sign * q * L**2 / 8, turn: -sign * q * L**3 / (24 * EI),
                          f"{moment}0": 0})
        elif support == "guided":
            exact.update({f"u{along}": q * L**4 / (24 * EI) + soft * q * L**2 / 2,
                          f"{moment}0": sign * q * L**2 / 3, f"{moment}1": -sign * q * L**2 / 6})
        else:
            exact.update({f"{moment}0": sign * q * L**2 / 12, f"{moment}1": sign * q * L**2 / 12,
                          f"{moment}h": -sign * q * L**2 / 24, f"Q{along}0": q * L / 2})
    free = support == "cantilever"
    exact.update({"N0": q * L if free else q * L / 2, "N1": 0 if free else -q * L / 2})
    if support in ("cantilever", "hinged"):
        exact["Mx0"] = m * L
        exact["rx"] = m * L**2 / (2 * G * It)
    else:
        exact["Mx0"] = m * L / 2
    if free:
        exact["ux"] = q * L**2 / (2 * E * A)
    return exact


def moments(formulation, support):
    """Under moments m about y and z."""
    exact = {}
    for along, turn, moment, inertia, sign in (("y", "rz", "Mz", Iz, 1), ("z", "ry", "My", Iy, -1)):
        EI, soft = E * inertia, flexibility(formulation, along)
        if support == "cantilever":
            exact.update({f"u{along}": sign * m * L**3 / (3 * EI), turn: m * L**2 / (2 * EI),
                          f"{moment}0": m * L, f"Q{along}0": 0})
        elif support == "clamped":
            Phi = 12 * EI * soft / L**2
            exact.update({f"Q{along}0": -sign * m / (1 + Phi),
                          f"{moment}0": m * L * Phi / (2 * (1 + Phi)), f"{moment}h": 0})
    return exact


LOADS = {"forces": ("f: {distributed: [%g, %g, %g], on: beam}, t: {distributed_moment: [%g, 0, 0], "
                    "on: beam}" % (q, q, q, m), forces),
         "moments": ("t: {distributed_moment: [0, %g, %g], on: beam}" % (m, m), moments)}


def formulations():
    return [f["formulation"] for f in json.loads(run("list", "--format", "json").stdout)["formulations"]]


class AlongMembers(ProgramTest):
    def check(self, formulation, support, kind):
        loads, closed = LOADS[kind]
        path = self.folder / "beam.yaml"
        path.write_text(scene(formulation, support, loads), encoding="utf-8")
        done = run("solve", "--scene", path, "-f", formulation, "-n", "1", "--format", "json")
        self.assertEqual(done.returncode, 0, f"{formulation}, {support}: {done.stderr}")
        found = {v["quantity"]: v["value"] for v in json.loads(done.stdout)["quantities"]}
        size = q * L + m
        for name, value in closed(formulation, support).items():
            scale = max(abs(value), size * 1e-3 if name[0] in "NQM" else 0) or 1
            self.assertLess(abs(found[name] - value), 1e-9 * scale,
                            f"{formulation}, {support}, {kind}: {name} {found[name]} for {value}")

    def test_every_formulation(self):
        for formulation in formulations():
            for support in HELD:
                for kind in LOADS:
                    with self.subTest(f"{formulation}, {support}, {kind}"):
                        self.check(formulation, support, kind)


if __name__ == "__main__":
    unittest.main()
