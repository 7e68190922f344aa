"""Springs with unsymmetric stiffness and damping at bodies, at offset and released ends, and in constraints, must
give the results of matrices that are computed independently, in all analyses."""
import math

import numpy

from harness.tools.kit.program import ProgramTest

YOUNG, SHEAR = 2e9, 0.8e9
SCENE = """beamwork: 1
sections: {s: {constants: {A: 6e-4, Iy: 2e-8, Iz: 4.5e-8, It: 4e-8}, young: 2e9, shear_modulus: 0.8e9}}
nodes:
  a: {at: [0, 0, 0], hold: all}
  b: {at: [1, 0.2, 0.1], mass: 3, inertia: [0.02, 0.03, 0.04, 0, 0, 0]}
  p: {at: [1.1, 0.35, 0.05], part_of: b}
  c: {at: [2, 0, 0], hold: [uy, rx, ry, rz], mass: 0.7}
  e: {at: [1, 0.2, 0.1], mass: 0.4, inertia: [0.01, 0.02, 0.015, 0, 0, 0]}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0], offset: {from: [0, 0, 0], to: [0, -0.05, 0.02]}RELEASE}}
springs:
  p: {to: p, stiffness: SP, damping: DP}
  c: {to: c, stiffness: SC, damping: DC}
  r: {from: b, to: e, stiffness: SR, damping: DR}
constraints: {lever: {node: c, component: ux, ratio: -2, of: b}}
loads:
  f: {force: [3, 2, -4], on: bTIME}
  g: {moment: [0.3, -0.2, 0.1], on: bTIME}
  h: {force: [1, 2, 3], on: pTIME}
  i: {force: [2, 0, 5], on: cTIME}
analyses: ANALYSES
quantities:
QUANTITIES
omit: [shear, trapeze, wagner_torque, wagner_moments]
"""
RANDOM = numpy.random.default_rng(7)
COMPONENTS = ("ux", "uy", "uz", "rx", "ry", "rz")


def cross(scale, skewed):
    A, B = RANDOM.normal(size=(6, 6)), RANDOM.normal(size=(6, 6))
    units = numpy.diag([1, 1, 1, 0.1, 0.1, 0.1])
    return scale * units @ (A @ A.T + skewed * (B - B.T)) @ units


SPRINGS = {"SP": cross(100, 0.2), "DP": cross(4, 0.2), "SC": cross(80, 0.2), "DC": cross(3, 0.2),
           "SR": cross(60, 0.2), "DR": cross(2, 0.2)}


def shift(arm):
    """Returns the matrix [6 x 6] of the motion of a point at `arm` due to the motion of its body."""
    T = numpy.eye(6)
    T[:3, 3:] = -numpy.array([[0, -arm[2], arm[1]], [arm[2], 0, -arm[0]], [-arm[1], arm[0], 0]])
    return T


def beam_end(release):
    along = numpy.array([1, 0.15, 0.12])
    length = numpy.linalg.norm(along)
    x = along / length
    y = numpy.array([0, 1, 0]) - x[1] * x
    y /= numpy.linalg.norm(y)
    R = numpy.column_stack([x, y, numpy.cross(x, y)])
    EA, EIy, EIz, GJ = YOUNG * 6e-4, YOUNG * 2e-8, YOUNG * 4.5e-8, SHEAR * 4e-8
    K = numpy.diag([EA / length, 12 * EIz / length**3, 12 * EIy / length**3, GJ / length, 4 * EIy / length, 4 * EIz / length])
    K[1, 5] = K[5, 1] = -6 * EIz / length**2
    K[2, 4] = K[4, 2] = 6 * EIy / length**2
    if release:
        K = K - numpy.outer(K[:, 4], K[4]) / K[4, 4]
    turn = numpy.kron(numpy.eye(2), R)
    return turn @ K @ turn.T


def matrices(release):
    """Returns K, C and M [13 x 13] for the motions of b (six), of c along z (one) and of e (six). Also returns the
    matrices [6 x 13] that map these coordinates to the motions of b, p, c and e."""
    G = {"b": numpy.eye(13)[:6], "p": shift((0.1, 0.15, -0.05)) @ numpy.eye(13)[:6], "e": numpy.eye(13)[7:], "c": numpy.zeros((6, 13))}
    G["c"][0, 0], G["c"][2, 6] = -2, 1
    end, apart = shift((0, -0.05, 0.02)) @ G["b"], G["e"] - G["b"]
    K, C = end.T @ beam_end(release) @ end, 0
    for of, at in (("P", G["p"]), ("C", G["c"]), ("R", apart)):
        K, C = K + at.T @ SPRINGS["S" + of] @ at, C + at.T @ SPRINGS["D" + of] @ at
    M = G["b"].T @ numpy.diag([3, 3, 3, 0.02, 0.03, 0.04]) @ G["b"] + G["c"].T @ numpy.diag([0.7] * 3 + [0] * 3) @ G["c"]
    M = M + G["e"].T @ numpy.diag([0.4] * 3 + [0.01, 0.02, 0.015]) @ G["e"]
    return K, C, M, G


class CrossTerms(ProgramTest):

    def values(self, release, analyses, quantities, formulation="collocation", time=""):
        text = SCENE.replace("RELEASE", ", release: {to: [ry]}" if release else "").replace("ANALYSES", analyses).replace("QUANTITIES", quantities).replace("TIME", time)
        for name, matrix in SPRINGS.items():
            text = text.replace(name, str([float(x) for x in matrix.ravel()]))
        return self.values_of(text, "-f", formulation, "-n", 1)

    def near(self, found, wanted, size, words, within=1e-7):
        self.assertLess(abs(found - wanted), within * size, f"{words}: {found} instead of {wanted}")

    def test_linear(self):
        for release in (False, True):
            K, _, _, G = matrices(release)
            load = (G["b"].T @ [3, 2, -4, 0.3, -0.2, 0.1] + G["p"].T @ [1, 2, 3, 0, 0, 0] + G["c"].T @ [2, 0, 5, 0, 0, 0])
            u = numpy.linalg.solve(K, load)
            wanted = {f"{n}_{c}": (G[n] @ u)[k] for n in "bpce" for k, c in enumerate(COMPONENTS) if n != "c" or c in ("ux", "uz")}
            text = "".join(f"  {name}: {{displacement: {{analysis: L, node: {name[0]}, component: {name[2:]}}}}}\n" for name in wanted)
            for n in "bp":
                C = G[n] @ numpy.linalg.solve(K, G[n].T)
                for i, row in enumerate(COMPONENTS):
                    for j, column in enumerate(COMPONENTS):
                        wanted[f"{n}{row}{column}"] = C[i, j]
                        text += f"  {n}{row}{column}: {{compliance: {{analysis: C{n}, row: {row}, column: {column}}}}}\n"
            for formulation in ("collocation", "beamw_consistent", "sheet_second"):
                found = self.values(release, "{L: {linear: {}}, Cb: {compliance: {node: b}}, Cp: {compliance: {node: p}}}", text, formulation)
                for name, value in wanted.items():
                    self.near(found[name], value, abs(value), f"{formulation}, release {release}: {name}")

    def test_rounding(self):
        bar = """beamwork: 1
sections: {s: {constants: {A: 6e-4, Iy: 2e-8, Iz: 4.5e-8, It: 4e-8}, young: 2e9, shear_modulus: 0.8e9}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0], mass: 3, hold: [rx, ry, rz]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
springs: {k: {to: b, stiffness: STIFFNESS, damping: DAMPING}}
analyses: {h: {harmonic: {frequencies: [3]}}}
quantities:
  re: {response: {analysis: h, node: b, component: uy, force: b, along: uz, part: real}}
  im: {response: {analysis: h, node: b, component: uy, force: b, along: uz, part: imaginary}}
omit: [shear, trapeze, wagner_torque, wagner_moments]
"""
        w = 6 * math.pi
        bending = numpy.diag([12 * YOUNG * 4.5e-8, 12 * YOUNG * 2e-8])
        for stiffness, damping in ((0, 0), (1e-7, 0), (0, 1e-7), (3e-7, 5e-7), (1e-4, 0), (0, 1e-4)):
            given = []
            for size, part in ((1e3, stiffness), (20, damping)):
                A = size * numpy.eye(6)
                A[1, 2] = part * size
                given.append(A)
            text = bar.replace("STIFFNESS", str(given[0].ravel().tolist())).replace("DAMPING", str(given[1].ravel().tolist()))
            record = self.record("solve", "--scene", "/dev/stdin", "-f", "collocation", "-n", 1, input=text)
            found = {q["quantity"]: q["value"] for q in record["quantities"]}
            used = [(A + A.T) / 2 if part <= 1e-6 else A for A, part in zip(given, (stiffness, damping))]
            exact = numpy.linalg.inv(bending + used[0][1:3, 1:3] + 1j * w * used[1][1:3, 1:3] - 3 * w * w * numpy.eye(2))[0, 1]
            self.near(complex(found["re"], found["im"]), exact, abs(exact) + 1e-15, (stiffness, damping))
            said = " ".join(str(record).split())
            for what, part in (("stiffness", stiffness), ("damping", damping)):
                note = f"the asymmetry of the {what} of spring k, {part:.1e} of its diagonal: the mean is used"
                self.assertEqual(note in said, 0 < part <= 1e-6, (what, part, said))

    def test_vibration(self):
        for release in (False, True):
            K, C, M, G = matrices(release)
            A = numpy.block([[numpy.zeros((13, 13)), numpy.eye(13)], [-numpy.linalg.solve(M, K), -numpy.linalg.solve(M, C)]])
            roots = sorted((r for r in numpy.linalg.eigvals(A) if r.imag > 1e-9), key=abs)
            text = "".join(f"  f{i}: {{frequency: {{analysis: D, which: {i}}}}}\n  d{i}: {{damping_ratio: {{analysis: D, which: {i}}}}}\n" for i in range(8))
            sees = [("b", "uy", "b", "uz"), ("p", "uz", "b", "ux"), ("e", "rx", "p", "uy"), ("c", "uz", "b", "uy"), ("b", "rx", "c", "uz")]
            for k, (n, c, m, d) in enumerate(sees):
                text += "".join(f"  {part}{k}: {{response: {{analysis: H, node: {n}, component: {c}, force: {m}, along: {d}, part: {part}}}}}\n" for part in ("real", "imaginary"))
            found = self.values(release, "{D: {modal: {damped: yes}}, H: {harmonic: {frequencies: [1.3]}}}", text)
            pairs = [(2 * math.pi * found[f"f{i}"], found[f"d{i}"]) for i in range(8) if found[f"f{i}"] > 0]
            self.assertGreater(len(pairs), 3)
            for (frequency, ratio), root in zip(pairs, roots):
                self.near(frequency, root.imag, abs(root), f"frequency, release {release}")
                self.near(ratio, -root.real / abs(root), 1, f"ratio, release {release}")
            w = 2 * math.pi * 1.3
            inverse = numpy.linalg.inv(K + 1j * w * C - w * w * M)
            for k, (n, c, m, d) in enumerate(sees):
                H = G[n][COMPONENTS.index(c)] @ inverse @ G[m][COMPONENTS.index(d)]
                self.near(complex(found[f"real{k}"], found[f"imaginary{k}"]), H, abs(H), f"response {sees[k]}, release {release}")

    def test_motion(self):
        for release, how in ((False, "radau, step: 2e-4"), (True, "alpha, step: 2e-5")):
            K, C, M, G = matrices(release)
            until = 0.05
            load = 1e-6 * (G["b"].T @ [3, 2, -4, 0.3, -0.2, 0.1] + G["p"].T @ [1, 2, 3, 0, 0, 0] + G["c"].T @ [2, 0, 5, 0, 0, 0])
            A = numpy.block([[numpy.zeros((13, 13)), numpy.eye(13)], [-numpy.linalg.solve(M, K), -numpy.linalg.solve(M, C)]])
            values, vectors = numpy.linalg.eig(A)
            rest = numpy.linalg.solve(K, load)
            start = numpy.concatenate([-rest, numpy.zeros(13)])
            u = rest + (vectors @ (numpy.exp(values * until) * numpy.linalg.solve(vectors, start))).real[:13]
            names = [(n, c) for n in "bpe" for c in COMPONENTS] + [("c", "uz"), ("c", "ux")]
            text = "".join(f"  {n}{c}: {{displacement: {{analysis: T, node: {n}, component: {c}}}}}\n" for n, c in names)
            found = self.values(release, f"{{T: {{motion: {{stations: [{until}], integrator: {how}, mass: lumped}}}}}}", text, time=", time: 1e-6")
            for n, c in names:
                wanted = (G[n] @ u)[COMPONENTS.index(c)]
                self.near(found[n + c], wanted, numpy.linalg.norm(G[n] @ u), f"{how}: {n} {c}", 1e-5)
