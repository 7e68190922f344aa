"""Results of scipy with the matrices written by `solve --matrices` must agree with those of the program."""
import csv
import os
import resource
import shutil
import signal
import subprocess
import time
import unittest

import numpy
import scipy.io
import scipy.linalg

from harness.tools.kit.program import PROGRAM, ProgramTest, run

FORMULATIONS = ("beamw_first", "beamw", "beamw_vlasov", "beamw_consistent", "sheet_second",
                "sheet_second_consistent", "sheet_third", "sheet_third_printed",
                "geometrically_exact", "geometrically_exact:nodes=3", "collocation")

BAR = """beamwork: 1
sections:
  bar: {constants: {A: 1e-4, Iy: 5e-7, Iz: 8e-7, It: 9e-7}, young: 1e9, shear_modulus: 4e8,
        density: 1000}
nodes:
  root: {at: [0, 0, 0], hold: all}
  tip: {at: [0.9, 0.3, 0.2], mass: 0.03, centre: [0.05, 0.02, -0.03],
        inertia: [2e-4, 3e-4, 4e-4, 1e-5, 2e-5, -1e-5]}
members:
  bar: {from: root, to: tip, section: bar, y: [0, 1, 0]}
loads:
  across: {force: [-30, 20, 40], on: tip}
"""
LOADED = BAR + """  beside: {force: [10, 0, 5], on: tip, at: [0.1, 0, 0.05]}
analyses:
  solution: {linear: {}}
  rest: {modal: {wanted: 6}}
  path: {static: {stations: [0.5, 1]}}
  bent: {modal: {wanted: 6, about: path}}
  stressed: {modal: {wanted: 6, about: solution}}
quantities:
  uz: {displacement: {analysis: solution, node: tip, component: uz}, unit: m}
  rest_$n: {for: {n: 0..5}, frequency: {analysis: rest, which: n}, unit: Hz}
  bent_$n: {for: {n: 0..5}, frequency: {analysis: bent, which: n}, unit: Hz}
  stressed_$n: {for: {n: 0..5}, frequency: {analysis: stressed, which: n}, unit: Hz}
omit: [shear, trapeze, wagner_moments, wagner_torque]
"""
TURNING = BAR + """analyses:
  turning: {rotation: {omega: [3, 4, 12], centre: [0.1, 0, 0], stations: [0.5, 1], wanted: 6}}
quantities:
  turning_$n: {for: {n: 0..5}, frequency: {analysis: turning, which: n}, unit: Hz}
omit: [shear, trapeze, wagner_moments, wagner_torque]
"""
FOLLOWER = BAR.replace("on: tip}", "on: tip, follower: true}") + """analyses:
  path: {static: {stations: [1]}}
"""
PORTAL = """beamwork: 1
sections:
  post: {i: {depth: 0.1, flange: 0.06, web_thickness: 0.004, flange_thickness: 0.006},
         young: 2e11, shear_modulus: 8e10, density: 7800}
nodes:
  left: {at: [0, 0, 0], hold: all}
  corner: {at: [0, 2, 0]}
  right: {at: [3, 2, 0], hold: [ux, uy, uz], rotation: {sequence: [{axis: z, angle: free}]}}
members:
  post: {from: left, to: corner, section: post, y: [1, 0, 0], warping: [fixed, free]}
  beam: {from: corner, to: right, section: post, y: [0, 1, 0], release: {from: [rz]},
         warping: [free, fixed]}
"""


def scaled(K, *others):
    d = 1 / numpy.sqrt(numpy.diag(K))
    return [A * d[:, None] * d for A in (K, *others)]


def frequencies(K, M, inside=None):
    """Returns the frequencies [Hz] of K x = omega^2 M x in ascending order. M may be singular. If `inside` is given, each mode satisfies x.K x = omega^2 x.M x + omega^4 x.inside x."""
    K, M, inside = scaled(K, M, 0*K if inside is None else inside)
    mu, x = scipy.linalg.eigh(M, K)
    mu, x = mu[mu > 1e-14 * mu[-1]], x[:, mu > 1e-14 * mu[-1]]
    inner = numpy.einsum("ik,ij,jk->k", x, inside, x)
    return numpy.sort(numpy.sqrt(2 / (mu + numpy.sqrt(mu**2 + 4*inner))) / (2 * numpy.pi))


def turning_frequencies(K, M, G):
    """Returns the frequencies [Hz] of (K + i omega G - omega^2 M) x = 0. With K = L L^T and M = R^T R, this is a
    Hermitian eigenproblem for 1/omega."""
    K, M, G = scaled(K, M, G)
    L = scipy.linalg.cholesky(K, lower=True)
    size, vectors = scipy.linalg.eigh(M)
    R = numpy.sqrt(numpy.maximum(size, 0))[:, None] * vectors.T
    half = scipy.linalg.solve_triangular(L, R.T, lower=True)
    turned = scipy.linalg.solve_triangular(L,
                                           scipy.linalg.solve_triangular(L, G, lower=True).T,
                                           lower=True).T
    whole = numpy.block([[-1j * turned, half], [half.T, numpy.zeros_like(K)]])
    inverse = scipy.linalg.eigvalsh(whole)[::-1]
    return 1 / inverse[inverse > 1e-7 * inverse[0]] / (2 * numpy.pi)


class Matrices(ProgramTest):

    def solve(self, scene, formulation, *more, n=2):
        file, folder = self.folder / "scene.yaml", self.folder / formulation.replace(":", "_")
        file.write_text(scene, encoding="utf-8")
        work = ("solve", "--scene", file, "-f", formulation, "-n", n, "--matrices", folder, *more)
        done = run(*work)
        if done.returncode == 2 and "does not support" in done.stderr:
            self.assertFalse(folder.exists())
            return None
        self.assertEqual(done.returncode, 0, done.stderr)
        return folder

    def solved(self, scene, formulation, *more, n=2):
        folder = self.solve(scene, formulation, *more, n=n)
        if folder is None:
            return None, None
        values = self.record("solve", "--scene", self.folder / "scene.yaml", "-f", formulation,
                             "-n", n, *more)
        return folder, {q["quantity"]: q["value"] for q in values["quantities"]}

    @staticmethod
    def read(folder, state, letter):
        return scipy.io.mmread(folder / state / f"{letter}.mtx").toarray()

    @staticmethod
    def rows(folder, name="dofs.csv"):
        with open(folder / name, encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def agree(self, values, stem, found, what, within=2e-12):
        for i in range(6):
            value = values[f"{stem}_{i}"]
            self.assertLess(abs(found[i] / value - 1), within, (what, stem, i, found[i], value))


class Frequencies(Matrices):

    def test_loaded(self):
        checked = with_inside = 0
        for formulation in FORMULATIONS:
            folder, values = self.solved(LOADED, formulation)
            if folder is None:
                continue
            checked += 1
            for state, stem in (("rest", "rest"), ("bent", "bent"), ("stressed", "stressed")):
                inside = folder / state / "M_inside.mtx"
                self.assertTrue(state == "rest" or not inside.exists())
                found = frequencies(self.read(folder, state, "K"), self.read(folder, state, "M"),
                                    self.read(folder, state, "M_inside") if inside.exists() else None)
                self.agree(values, stem, found, formulation)
                with_inside += inside.exists()
            self.assertEqual((folder / "bent/K.mtx").read_text().splitlines()[2:],
                             (folder / "path_station_1/K.mtx").read_text().splitlines()[2:])
            self.assertEqual((folder / "rest/K.mtx").read_text().splitlines()[2:],
                             (folder / "undeformed/K.mtx").read_text().splitlines()[2:])
            self.assertFalse((folder / "undeformed/G.mtx").exists())
            self.inputs(folder, values["uz"])
        self.assertEqual(checked, len(FORMULATIONS))
        self.assertGreater(with_inside, len(FORMULATIONS)//2)
        folder, values = self.solved(LOADED + "mass: lumped\n", "collocation:stages=3")
        for state in ("rest", "bent", "stressed"):
            found = frequencies(self.read(folder, state, "K"), self.read(folder, state, "M"))
            self.agree(values, state, found, "lumped")

    def inputs(self, folder, value):
        K, B = self.read(folder, "undeformed", "K"), self.read(folder, "undeformed", "B")
        x = numpy.linalg.solve(K, B.sum(axis=1))
        rows = self.rows(folder)
        self.assertEqual([int(r["row"]) for r in rows], list(range(1, len(K) + 1)))
        tip = [x[i] for i, r in enumerate(rows) if (r["node"], r["component"]) == ("tip", "uz")]
        self.assertEqual(len(tip), 1)
        self.assertLess(abs(tip[0] / value - 1), 1e-11)
        loads = self.rows(folder, "loads.csv")
        self.assertEqual([(r["column"], r["node"], float(r["z"])) for r in loads],
                         [("1", "tip", 40), ("2", "tip", 5)])

    def test_loads_on_members(self):
        loads = """  part: {distributed: [0, 6, 0], on: bar, from: 0.25, to: 0.75, to_value: [0, 0, 3]}
  point: {force: [1, 2, 3], on: bar, where: 0.5}
  halves: {distributed: [0, 0, 4], on: bar, lumped: yes}
"""
        folder, values = self.solved(LOADED.replace("analyses:", loads + "analyses:", 1), "beamw")
        self.assertEqual(
            [[r[k] for k in ("kind", "node", "member", "from", "to", "x_to", "y_to", "z_to", "lumped")]
             for r in self.rows(folder, "loads.csv")],
            [["force", "tip", *[""] * 7], ["force", "tip", *[""] * 7],
             ["distributed", "", "bar", "0.25", "0.75", "0", "0", "3", "0"],
             ["force", "", "bar", "0.5", "0.5", "1", "2", "3", "0"],
             ["distributed", "", "bar", "0", "1", "0", "0", "4", "1"]])
        K, B = self.read(folder, "undeformed", "K"), self.read(folder, "undeformed", "B")
        x = numpy.linalg.solve(K, B.sum(axis=1))
        tip = [x[i] for i, r in enumerate(self.rows(folder))
               if (r["node"], r["component"]) == ("tip", "uz")]
        self.assertLess(abs(tip[0] / values["uz"] - 1), 1e-11)

    def test_turning(self):
        checked = 0
        for formulation in FORMULATIONS:
            folder, values = self.solved(TURNING, formulation)
            if folder is None:
                continue
            checked += 1
            K, M, G = (self.read(folder, "turning_station_1", letter) for letter in "KMG")
            self.assertEqual(numpy.abs(G + G.T).max(), 0)
            self.assertGreater(numpy.abs(G).max(), 1e-3)
            self.agree(values, "turning", turning_frequencies(K, M, G), formulation)
            half = self.read(folder, "turning_station_0", "G")
            self.assertLess(numpy.abs(2 * half - G).max(), 0.5 * numpy.abs(G).max())
        self.assertEqual(checked, len(FORMULATIONS))

    def test_newton(self):
        scene = BAR + "analyses:\n  path: {static: {stations: [1]}}\n"
        K = self.read(self.solve(scene, "collocation"), "path_station_0", "K")
        for newton in ("displacement", "dense"):
            other = self.solve(scene, f"collocation:newton={newton}")
            change = numpy.abs(self.read(other, "path_station_0", "K") - K).max()
            self.assertLess(change, 1e-9 * numpy.abs(K).max(), newton)


BENT = """beamwork: 1
sections:
  s: {constants: {A: 2e-4, Iy: 1.5e-9, Iz: 4e-9, It: 4e-9}, young: 7e10, shear_modulus: 2.6e10, density: %s}
nodes:
  root: {at: [0, 0, 0], %s}
  mid: {at: [0.3, 0.1, 0]%s}
  tip: {at: [0.7, 0.2, 0.1], mass: 0.05}
members:
  a: {from: root, to: mid, section: s, y: [0, 1, 0], damping: 1e-5}
  b: {from: mid, to: tip, section: s, y: [0, 1, 0]}
springs:
  foot: {to: tip, stiffness: [100, 200, 50, 1, 2, 3], damping: [2, 3, 1, 0, 0, 0.1]}
motions:
  shake: {unit: m, path: [0, 1], value: [0, 0]}
%sanalyses:
%s  steady: {harmonic: {frequencies: [3, 11, 60, 250]%s}}
  modes: {modal: {damped: yes%s}}
quantities:
%s  f_$n: {for: {n: 0..3}, frequency: {analysis: modes, which: n}}
  d_$n: {for: {n: 0..3}, damping_ratio: {analysis: modes, which: n, of: decay}}
mass: lumped
omit: [shear, trapeze, wagner_moments, wagner_torque]
"""
SHAKEN = "hold: [ux, uz, rx, ry, rz], drive: {uy: shake}"
FOLLOWING = "loads:\n  p: {force: [-5, 5, 8], on: tip, follower: true}\n"


def responses(*choices):
    """Returns the entries of the quantities for the real and imaginary parts of responses, given as texts (output,
    input)."""
    return "".join(f"  {part}_{i}: {{response: {{analysis: steady, {choice}, part: {part}, take: curve}}}}\n"
                   for i, choice in enumerate(choices) for part in ("real", "imaginary"))


ALL = responses(*(f"node: tip, component: uy, of: {of}, {by}" for of in ("displacement", "velocity", "acceleration")
                  for by in ("force: mid, along: uz", "force: mid, along: ry", "drive: shake, from: root")),
                *(f"node: root, component: uy, of: reaction, {by}" for by in ("force: tip, along: uy", "drive: shake")))


class StateSpace(Matrices):
    def transfer(self, folder, state, hertz, of_motions=True):
        """Returns the transfer matrix [outputs x inputs]. The inputs at the base are motions if `of_motions`, otherwise
        their accelerations."""
        A, B, C, D = (self.read(folder, f"{state}/state_space", letter)
                      if (folder/state/"state_space"/f"{letter}.mtx").exists() else 0 for letter in "ABCD")
        s = 2j*numpy.pi*hertz
        moved = [s*s if c["kind"] == "acceleration" and of_motions else 1 for c in self.rows(folder, "inputs.csv")]
        return (C @ numpy.linalg.solve(s*numpy.eye(len(A)) - A, B) + D)*moved

    def second(self, folder, hertz):
        K, C, M, B, *L = (self.read(folder, "steady/second_order", letter)
                          if (folder/"steady/second_order"/f"{letter}.mtx").exists() else 0
                          for letter in ("K", "C", "M", "B", "L", "L_rate", "L_acceleration", "D"))
        s = 2j*numpy.pi*hertz
        moved = [s*s if c["kind"] == "acceleration" else 1 for c in self.rows(folder, "inputs.csv")]
        return ((L[0] + s*L[1] + s*s*L[2]) @ numpy.linalg.solve(K + s*C + s*s*M, B) + L[3])*moved

    def compare(self, scene, formulation, n=2, within=1e-8):
        shutil.rmtree(self.folder/formulation.replace(":", "_"), ignore_errors=True)
        folder = self.solve(scene, formulation, "--state-space", n=n)
        if folder is None:
            return None, None
        record = self.record("solve", "--scene", self.folder/"scene.yaml", "-f", formulation, "-n", n)
        inputs, outputs = self.rows(folder, "inputs.csv"), self.rows(folder, "outputs.csv")
        curves = {c["quantity"]: c for c in record["curves"]}
        self.assertGreater(len(curves), 1)
        for name in curves:
            if not name.startswith("real"):
                continue
            text = next(line for line in scene.splitlines() if line.startswith(f"  {name}:"))
            key = dict(word.split(": ") for word in text.split("{")[2].rstrip("}").split(", "))
            row = [i for i, o in enumerate(outputs) if (o["node"], o["component"], o["of"], o["from"]) == (
                key["node"], key["component"], key.get("of", "displacement"), key.get("from", ""))]
            column = [i for i, c in enumerate(inputs) if (c["motion"] == key["drive"] if "drive" in key else
                                                          (c["node"], c["component"]) == (key["force"], key["along"]))]
            self.assertEqual((len(row), len(column)), (1, 1), name)
            found = [complex(*z) for z in zip(curves[name]["curve_value"],
                                              curves[name.replace("real", "imaginary")]["curve_value"])]
            for hertz, value in zip(curves[name]["curve_x"], found):
                for H in (self.transfer(folder, "steady", hertz), self.second(folder, hertz)):
                    self.assertLess(abs(H[row[0], column[0]] - value), within*max(map(abs, found)),
                                    (formulation, name, hertz))
        return folder, {q["quantity"]: q["value"] for q in record["quantities"]}

    def test_responses(self):
        bent = "  path: {static: {stations: [1]}}\n"
        checked = 0
        for formulation in FORMULATIONS:
            for loads, path, damping in (("", "", ", damping: {ratio: 0.02}"),
                                         (FOLLOWING, bent, ", damping: {mass: 3, stiffness: 1e-5}")):
                about = ", about: path" if path else ""
                of_modes = about if "ratio" in damping else about + damping
                scene = BENT % (2700, SHAKEN, ", mass: 0.02", loads, path, about + damping, of_modes, ALL)
                folder, values = self.compare(scene, formulation)
                if folder is None:
                    continue
                checked += 1
                if "ratio" in damping:
                    continue
                poles = numpy.linalg.eigvals(self.read(folder, "steady/state_space", "A"))
                for i in range(4):
                    pole = complex(-values[f"d_{i}"], 2*numpy.pi*values[f"f_{i}"])
                    self.assertLess(min(abs(poles - pole)), 1e-8*abs(pole), (formulation, i))
        self.assertGreater(checked, len(FORMULATIONS))

    def test_free(self):
        scene = BENT.replace("stiffness: [100, 200, 50, 1, 2, 3], ", "").replace("  modes: {modal: {damped: yes%s}}\n", "%.0s") % (
            2700, "mass: 0.3, inertia: [1e-4, 1e-4, 1e-4, 0, 0, 0]", "", "", "", "",
            "", responses("node: tip, component: uy, force: mid, along: uz"))
        for left in ("  f_$n", "motions:"):
            scene = scene.replace(scene[scene.index(left):scene.index("mass: lumped" if "f_" in left else "analyses:")], "")
        folder, _ = self.compare(scene, "collocation")
        poles = numpy.linalg.eigvals(self.read(folder, "steady/state_space", "A"))
        self.assertLess(max(poles.real), 1e-3)

    def test_without_mass(self):
        scene = BENT.replace("  modes: {modal: {damped: yes%s}}\n", "%.0s")
        scene = scene[:scene.index("  f_$n")] + scene[scene.index("mass: lumped"):]
        holds = (0, SHAKEN, "", "", "", "", "")
        light = responses("node: mid, component: uz, force: mid, along: uz", "node: tip, component: uy, of: velocity, drive: shake",
                          "node: mid, component: uz, force: tip, along: uy")
        folder, _ = self.compare(scene % (*holds, light), "beamw")
        A = self.read(folder, "steady/state_space", "A")
        self.assertLess(len(A), 2*len(self.rows(folder)))
        text = (folder/"steady/state_space/A.mtx").read_text(encoding="utf-8")
        self.assertIn("without mass and damping eliminated: ", text)
        (self.folder/"scene.yaml").write_text(scene % (*holds, responses(
            "node: mid, component: uz, of: velocity, force: mid, along: uz")), encoding="utf-8")
        self.refused(1, ["quantity real_0", "no mass separates the quantity from an input"], "solve", "--scene", self.folder/"scene.yaml",
                     "-f", "beamw", "-n", 2, "--matrices", self.folder/"none", "--state-space", silent=False)

    def test_turning(self):
        folder, values = self.solved(TURNING, "collocation", n=2)
        folder = self.folder/"with"
        self.answered("solve", "--scene", self.folder/"scene.yaml", "-f", "collocation", "-n", 2, "--matrices", folder,
                      "--state-space")
        poles = numpy.linalg.eigvals(self.read(folder, "turning_station_1/state_space", "A"))
        found = numpy.sort(poles.imag[poles.imag > 0])/(2*numpy.pi)
        self.agree(values, "turning", found, "poles", 1e-10)

    def test_reduced(self):
        choices = ("node: tip, component: uy, force: tip, along: uy", "node: tip, component: rx, of: velocity, drive: shake",
                   "node: root, component: uy, of: reaction, force: tip, along: uz",
                   "node: root, component: uy, of: reaction, drive: shake")
        scene = (BENT % (2700, SHAKEN, ", mass: 0.02", "", "", ", damping: {mass: 3, stiffness: 1e-5}", "",
                         responses(*choices))).replace("[3, 11, 60, 250]", "[3, 11, 60]")
        for formulation, nodes in (("collocation", ("tip",)), ("beamw", ("mid", "tip")), ("sheet_third", ())):
            shutil.rmtree(self.folder/formulation, ignore_errors=True)
            folder = self.solve(scene, formulation, "--state-space", "--reduce", "6" + ":"*bool(nodes) + ",".join(nodes), n=4)
            K, C, M, B = (self.read(folder, "steady/second_order", letter) for letter in "KCMB")
            n = len(self.rows(folder))
            edge = [i for i, r in enumerate(self.rows(folder)) if r["node"] in nodes and not r["member"]]
            inner = [i for i in range(n) if i not in edge]
            mu, modes = scipy.linalg.eigh(M[numpy.ix_(inner, inner)], K[numpy.ix_(inner, inner)])
            V = numpy.zeros((len(K), len(edge) + 6 + 1))
            V[edge, range(len(edge))] = 1
            V[inner, :len(edge)] = -numpy.linalg.solve(K[numpy.ix_(inner, inner)], K[numpy.ix_(inner, edge)])
            V[inner, len(edge):len(edge) + 6] = modes[:, :-7:-1]
            V[inner, -1] = -numpy.linalg.solve(K[numpy.ix_(inner, inner)], K[inner, n])
            V[n, -1] = 1
            if not nodes:
                V = numpy.hstack((V[:, :-1], numpy.vstack((numpy.linalg.solve(K[:n, :n], B[:n, [0, 2]]), [[0, 0]])), V[:, -1:]))
            T = self.read(folder, "steady/reduced", "T")
            self.assertEqual(T.shape, V.shape)
            self.assertLess(max(scipy.linalg.subspace_angles(T/numpy.linalg.norm(T, axis=0), V/numpy.linalg.norm(V, axis=0))), 1e-5)
            small = {letter: self.read(folder, "steady/reduced", letter) for letter in "KM"}
            r = len(small["K"]) - 1
            for letter, whole in (("K", K), ("M", M)):
                off = T[:n, :r].T @ whole[:n, :n] @ T[:n, :r] - small[letter][:r, :r]
                self.assertLess(abs(off).max(), 1e-9*abs(small[letter]).max())
            errors = self.rows(folder, "steady/reduced/errors.csv")
            found = frequencies(small["K"][:r, :r], small["M"][:r, :r])[:6]
            exact = frequencies(K[:n, :n], M[:n, :n])[:6]
            for error, one, other in zip(errors, exact, found):
                self.assertLess(abs(float(error["whole"]) - one) + abs(float(error["reduced"]) - other), 1e-8*one)
                self.assertGreater(other/one, 1 - 1e-10)
            self.assertLess(max(found/exact), 1.01 if nodes else 1 + 1e-10)
            H, h = (numpy.array([self.transfer(folder, state, hertz, False) for hertz in (3, 11, 60)])
                    for state in ("steady", "steady/reduced"))
            apart = abs(H - h).max(axis=0)/abs(H).max(axis=0)
            for error in errors[6:]:
                one = apart[int(error["output"]) - 1, int(error["input"]) - 1]
                self.assertLess(abs(float(error["error"]) - one), 0.01*one + 1e-8)
            self.assertEqual(len(errors), 6 + apart.size)
            self.assertTrue(1e-9 < apart.max() < 0.15, apart)

    def test_reduced_refused(self):
        scene = BENT % (2700, SHAKEN, "", "", "", "", "", ALL)
        (self.folder/"scene.yaml").write_text(scene, encoding="utf-8")
        work = ("solve", "--scene", self.folder/"scene.yaml", "-f", "beamw", "-n", 2, "--matrices", self.folder/"new")
        self.refused(2, "add --state-space", *work, "--reduce", "4")
        for text, words in (("4:nix", "no node nix; name nodes"), ("few", "write the number of modes"), ("4;tip", "write the number"),
                            ("4:", "of an interface node is missing; name the node"), ("4:tip,,mid", "of an interface node is missing; name the node"),
                            ("4:tip,mid,tip", "node tip is named twice; name it only once"),
                            ("5000", "give at most"), ("9"*30, "give at most"),
                            ("100:tip", "while the interface is fixed; give at most")):
            self.refused(1, words, *work, "--state-space", "--reduce", text, silent=False)
            self.assertFalse((self.folder/"new").exists())

    def test_modes_without_mass(self):
        (self.folder/"scene.yaml").write_text("""beamwork: 1
sections: {bar: {constants: {A: 1e-4, Iy: 5e-7, Iz: 8e-7, It: 9e-7}, young: 1e9, shear_modulus: 4e8}}
nodes: {root: {at: [0, 0, 0], hold: all}, mid: {at: [1, 0, 0]}, tip: {at: [2, 0, 0], mass: 2, centre: [0.1, 0.2, 0.3]}}
members: {bar: {from: root, to: mid, section: bar, y: [0, 1, 0]}, two: {from: mid, to: tip, section: bar, y: [0, 1, 0]}}
analyses: {ha: {harmonic: {frequencies: [1, 2], damping: {stiffness: 1e-3}}}}
quantities: {r: {response: {analysis: ha, node: mid, component: uy, force: tip, along: ux}}}
""", encoding="utf-8")
        for nodes, words in (("", "the number of modes with mass is 3; give at most 3"),
                             (":mid", "the number of modes with mass is 3 while the interface is fixed; give at most 3")):
            for modes in (3, 4, 5000):
                work = ("solve", "--scene", self.folder/"scene.yaml", "-f", "collocation", "-n", 1, "--matrices",
                        self.folder/f"m{nodes[1:]}{modes}", "--state-space", "--reduce", f"{modes}{nodes}")
                if modes == 3:
                    self.assertIn("natural frequencies: 3 compared", self.answered(*work).stderr)
                else:
                    self.refused(1, [f"--reduce {modes}{nodes}: {words}"], *work, silent=False)

    def test_feedback(self):
        scene = BAR + """  motor: {force: [1, 0, 0], on: tip, feedback: {node: tip, component: uz, proportional: 3}}
analyses: {run: {motion: {stations: 0..1e-3, step: 1e-3}}}
quantities: {uz: {displacement: {analysis: run, node: tip, component: uz}, unit: m}}
omit: [shear, trapeze, wagner_moments, wagner_torque]
"""
        for loop, text in ((0, scene.replace(", feedback: {node: tip, component: uz, proportional: 3}", "")), (1, scene)):
            (self.folder/"scene.yaml").write_text(text, encoding="utf-8")
            folder = self.folder/f"loop_{loop}"
            said = self.answered("solve", "--scene", self.folder/"scene.yaml", "-f", "collocation", "-n", 1, "--matrices", folder,
                                 "--state-space").stderr
            self.assertEqual("the feedback loop of load motor is open, so the load is an input" in said, loop == 1, said)
            for name in ("K.mtx", "state_space/A.mtx"):
                held = (folder/"undeformed"/name).read_text(encoding="utf-8")
                self.assertEqual("feedback loops open" in held, loop == 1, name)

    def test_inside(self):
        scene = (BENT % (2700, SHAKEN, "", "", "", "", "", ALL)).replace("mass: lumped\n", "")
        (self.folder/"scene.yaml").write_text(scene, encoding="utf-8")
        said = run("solve", "--scene", self.folder/"scene.yaml", "-f", "collocation", "-n", 4, "--matrices",
                   self.folder/"own", "--state-space").stderr
        apart = float(said.split("at most ")[1].split()[0])
        self.compare(scene, "collocation", 4, 1.01*apart*2**0.5)
        self.assertTrue(1e-6 < apart < 0.1, said)
        self.refused(2, "add, for example, --matrices folder", "solve", "--scene", self.folder/"scene.yaml", "--state-space")


class Contents(Matrices):

    def test_states(self):
        folder = self.solve(LOADED, "beamw")
        states = self.rows(folder, "states.csv")
        self.assertEqual([(s["folder"], s["analysis"], s["kind"], s["station"], float(s["path"]))
                          for s in states],
                         [("undeformed", "", "", "", 0), ("rest", "rest", "modal", "", 0),
                          ("path_station_0", "path", "static", "0", 0.5),
                          ("path_station_1", "path", "static", "1", 1),
                          ("bent", "bent", "modal", "", 1),
                          ("stressed", "stressed", "modal", "", 0)])
        self.assertEqual(
            sorted(os.listdir(folder)),
            sorted([s["folder"] for s in states] + ["dofs.csv", "loads.csv", "states.csv"]))

    def test_follower(self):
        folder = self.solve(FOLLOWER, "collocation")
        head = (folder / "path_station_0/K.mtx").read_text().splitlines()[0]
        self.assertEqual(head, "%%MatrixMarket matrix coordinate real general")
        K = self.read(folder, "path_station_0", "K")
        self.assertGreater(numpy.abs(K - K.T).max(), 1e-6 * numpy.abs(K).max())

    def test_rows(self):
        folder = self.solve(PORTAL, "beamw_consistent")
        rows = self.rows(folder)
        count = {}
        for r in rows:
            key = (r["node"], r["member"], r["along"], r["unit"])
            count.setdefault(key, []).append(r["component"])
        plain, turns = ["ux", "uy", "uz"], ["rx", "ry", "rz"]
        self.assertEqual(
            count, {("corner", "", "", "m"): plain, ("corner", "", "", "rad"): turns,
                    ("right", "", "", "rad"): ["angle 1"], ("", "post", "0.5", "m"): plain,
                    ("", "post", "0.5", "rad"): turns, ("", "beam", "0.5", "m"): plain,
                    ("", "beam", "0.5", "rad"): turns, ("", "beam", "0", "rad"): ["turn 1"],
                    ("", "post", "0.5", "rad/m"): ["warping"],
                    ("corner", "post", "1", "rad/m"): ["warping"],
                    ("", "beam", "0", "rad/m"): ["warping"],
                    ("", "beam", "0.5", "rad/m"): ["warping"]})
        middle = [r for r in rows if r["member"] == "beam" and r["along"] == "0.5"]
        self.assertEqual([float(middle[0][k]) for k in "xyz"], [1.5, 2, 0])


class Places(Matrices):
    WORK = ("solve", "warping_torsion", "-f", "beamw", "-n", "20", "--matrices")

    def test_refused(self):
        there = self.folder / "there"
        there.mkdir()
        (there / "mine").write_text("mine", encoding="utf-8")
        self.refused(2, "not empty", *self.WORK, there)
        self.refused(2, "is not a folder", *self.WORK, there / "mine")
        self.refused(2, "the name of an output folder is empty", *self.WORK, "")
        self.refused(4, "cannot be written", *self.WORK, self.folder / "none" / "new")
        self.refused(4, "cannot be written", *self.WORK, self.folder / ("x" * 300))
        self.refused(2, "the same file", *self.WORK, self.folder / "a", "-o", self.folder / "a")
        self.assertEqual(os.listdir(self.folder), ["there"])
        self.assertEqual(os.listdir(there), ["mine"])

    def test_empty_folder(self):
        there, link = self.folder / "there", self.folder / "link"
        there.mkdir()
        link.symlink_to("there")
        self.answered(*self.WORK, f"{link}/")
        self.assertTrue(link.is_symlink())
        self.assertTrue((there / "undeformed/M.mtx").exists())
        self.assertEqual(sorted(os.listdir(self.folder)), ["link", "there"])

    def test_signals(self):
        for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGINT):
            ended = 0
            for _ in range(20):
                words = [*self.WORK[:4], "-n", "1500", "--matrices", "new"]
                with subprocess.Popen([PROGRAM, *words], cwd=self.folder, stdout=subprocess.DEVNULL,
                                      stderr=subprocess.DEVNULL) as process:
                    while process.poll() is None and not list(self.folder.glob("new.part-*/dofs.csv")):
                        time.sleep(0.0005)
                    process.send_signal(number)
                if process.returncode == -number:
                    ended += 1
                    self.assertEqual(os.listdir(self.folder), [])
                    break
                shutil.rmtree(self.folder / "new")
            self.assertEqual(ended, 1)

    def test_full_disk(self):
        def small():
            resource.setrlimit(resource.RLIMIT_FSIZE, (600, 600))

        self.refused(4, ["cannot be written", "no file was left"],
                     *self.WORK,
                     self.folder / "new",
                     preexec_fn=small,
                     silent=False)
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    unittest.main()
