"""Elements with more than three nodes, equally spaced or not, compared with closed forms in every kind of analysis."""
import math
import unittest

import h5py
import numpy
import scipy.integrate
import scipy.optimize

from harness.cli.test.plugin import EXAMPLES, PluginTest, compile_shared
from harness.tools.kit.program import ROOT

L, E, G, A, I, RHO, ALPHA = 1.0, 200e9, 80e9, 2e-4, 2e-9, 7800.0, 12e-6
EI, GA = E * I, G * A / 1.2
HEAD = f"""beamwork: 1
sections:
  s: {{constants: {{A: {A}, Iy: {I}, Iz: {I}, It: {2 * I}, F: [{1.2 / A}, 0, 0, 0, {1.2 / A}, 0, 0, 0, 0], Iw: 0}}, young: {E},
      shear_modulus: {G}, density: {RHO}, expansion: {ALPHA}}}
"""
CANTILEVER = HEAD + """nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}}
members: {m: {from: a, to: b, section: s, y: [0, 1, 0]}}
"""
SLENDER = "omit: [shear, rotary_inertia]\n"
TIP = "{displacement: {analysis: run, node: b, component: %s}}"

OWN_MASS = """
static status inertia(const element_data *d, const node_state x[], const element_rotating_frame *frame,
                      inertia_output *out)
{
    const int n = EACH * (d->order + 1);
    double place[MOST + 1], options[] = {d->order};
    (void)x;
    if (frame != NULL)
        return STATUS_REFUSED;
    memset(out->M, 0, (size_t)(n * n) * sizeof *out->M);
    places(options, place);
    for (int g = 0; g <= d->order; g++) {
        double weight, N[MOST + 1];
        const double here = gauss(d->order + 1, g, &weight);
        for (int k = 0; k <= d->order; k++) {
            N[k] = 1;
            for (int j = 0; j <= d->order; j++)
                N[k] *= j == k ? 1 : (here - place[j]) / (place[k] - place[j]);
        }
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                if (i % EACH == j % EACH && i % EACH < 3)
                    out->M[i * n + j] += weight * d->length * MASS * N[i / EACH] * N[j / EACH];
    }
    for (int i = 0; i < n; i++)
        if (i % EACH >= 3 && i % EACH < 6)
            out->M[i * n + i] += 1e-9 * MASS * d->length * d->length * d->length;
    return STATUS_OK;
}

static int nodes("""

PROCESS = """
import numpy as np
from beamwork_element import serve

PLACES = [0, 0.5 - 0.05**0.5, 0.5 + 0.05**0.5, 1]  # Gauss-Lobatto points
GAUSS, WEIGHTS = np.polynomial.legendre.leggauss(3)
POLYNOMIALS = [np.poly1d(np.poly([p for p in PLACES if p != at])) for at in PLACES]
POLYNOMIALS = [p / p(at) for p, at in zip(POLYNOMIALS, PLACES)]
N = np.array([[p((1 + x) / 2) for p in POLYNOMIALS] for x in GAUSS])
D = np.array([[p.deriv()((1 + x) / 2) for p in POLYNOMIALS] for x in GAUSS])

def prepare(kind):
    s, l = kind.section, kind.length
    one = np.array([s.young * s.A, s.shear_modulus * s.D[0], s.shear_modulus * s.D[4],
                    s.shear_modulus * s.It / l**2, s.young * s.Iy / l**2, s.young * s.Iz / l**2]) / l
    return np.diag(np.concatenate([w / 2 * one for w in WEIGHTS]))

def quaternion(T):
    w = np.sqrt(1 + T[..., 0, 0] + T[..., 1, 1] + T[..., 2, 2]) / 2
    v = np.stack([T[..., 2, 1] - T[..., 1, 2], T[..., 0, 2] - T[..., 2, 0], T[..., 1, 0] - T[..., 0, 1]], -1)
    return np.concatenate([w[..., None], v / (4 * w[..., None])], -1)

def strain(kind, r, u, R, a):
    l, back = kind.length, np.swapaxes(R[:, 0], -1, -2)
    q, e = quaternion(back[:, None] @ R), []
    for n, d in zip(N, D):
        c, dc = np.einsum("k,ekj->ej", n, q), np.einsum("k,ekj->ej", d / l, q)
        g = (back @ np.einsum("k,ekj->ej", d / l, r)[..., None])[..., 0]
        w, v, size = c[:, :1], c[:, 1:], (c * c).sum(-1, keepdims=True)
        turned = (w * w - (v * v).sum(-1, keepdims=True)) * g + 2 * v * (v * g).sum(-1, keepdims=True) - 2 * w * np.cross(v, g)
        bent = 2 * (w * dc[:, 1:] - dc[:, :1] * v - np.cross(v, dc[:, 1:]))
        e += [l * (turned / size - [1, 0, 0]), l * l * bent / size]
    return np.concatenate(e, -1)

serve(prepare, strain, name="cubic_py", summary="four nodes", source="quaternions", family="example", strains=18, nodes=4,
      places=PLACES, offers=["shear", "geometric", "large rotations", "mass", "rotary inertia"],
      limits=["doubly symmetric", "order dependent", "half turn"], shear_theories=["haringx"])
"""


class Many(PluginTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.objects = {name: compile_shared(EXAMPLES / f"{name}.c", cls.class_folder() / f"{name}.so")
                       for name in ("legendre", "cubic")}

    def solved(self, text, name="legendre", n=1, made=None):
        return self.values_of(text, "--element", made or self.objects[name.split(":")[0]], "-f", name, "-n", n)

    def near(self, found, exact, share):
        self.assertAlmostEqual(found / exact, 1, delta=share)

    def test_loads_along(self):
        def tip(loads, key=""):
            return CANTILEVER + f"{key}loads: {{{loads}}}\nanalyses: {{run: {{linear: {{}}}}}}\nquantities: {{u: {TIP % 'uy'}}}\n"
        uniform = L**4 / (8 * EI) + L**2 / (2 * GA)
        cases = (
            ("q: {distributed: [0, 3, 0], on: m}", 3 * uniform),
            ("q: {distributed: [0, 3, 0], on: m, lumped: yes}", 3 * uniform),
            ("q: {gravity: [0, -9.81, 0], on: m}", -9.81 * RHO * A * uniform),
            ("q: {distributed: [0, 0, 0], to_value: [0, 3, 0], on: m}", 3 * (11 * L**4 / (120 * EI) + L**2 / (3 * GA))),
            ("q: {distributed_moment: [0, 0, 3], on: m}", 3 * L**3 / (3 * EI)),
            ("q: {distributed: [0, 3, 0], on: m, from: 0.2, to: 0.7}",
             3 * scipy.integrate.quad(lambda x: x**2 * (3 * L - x) / (6 * EI) + x / GA, 0.2, 0.7)[0]),
            ("q: {force: [0, 3, 0], on: m, where: 0.3}", 3 * (0.3**2 * (3 * L - 0.3) / (6 * EI) + 0.3 / GA)))
        for loads, exact in cases:
            with self.subTest(loads=loads):
                self.near(self.solved(tip(loads))["u"], exact, 1e-9)
        for loads, exact in (cases[0], cases[2], *cases[4:]):
            with self.subTest(loads=loads, formulation="cubic"):
                self.near(self.solved(tip(loads), "cubic")["u"], exact, 1e-9)
        self.near(self.solved(tip(cases[1][0]), "cubic", 8)["u"], cases[1][1], 1e-5)
        self.near(self.solved(tip(cases[0][0]), n=40)["u"], cases[0][1], 1e-8)

    def test_inside(self):
        text = CANTILEVER + """loads: {q: {distributed: [0, 3, 0], on: m}}
analyses: {run: {%s}}
quantities:
  M: {internal: {analysis: run, member: m, where: 0.37, resultant: Mz}}
  Q: {internal: {analysis: run, member: m, where: 0.37, resultant: Qy}}
  w: {deflection: {analysis: run, member: m, where: 0.37, component: uy}}
"""
        x = 0.37
        for name in self.objects:
            for analysis, share in (("linear: {}", 1e-9), ("static: {stations: [1]}", 1e-4)):
                found = self.solved(text % analysis, name, 2)
                self.near(found["M"], 3 * (L - x)**2 / 2, share)
                self.near(found["Q"], 3 * (L - x), share)
                self.near(found["w"], 3 * (x**2 * (6 * L**2 - 4 * L * x + x**2) / (24 * EI) + (L * x - x * x / 2) / GA), share)

    def half_circle(self, name, n):
        moment = math.pi * EI / L
        text = CANTILEVER + f"""loads: {{M: {{moment: [0, 0, {moment!r}], on: b}}}}
analyses: {{run: {{static: {{stations: [1]}}}}}}
quantities: {{x: {TIP % 'ux'}, y: {TIP % 'uy'}}}
"""
        return self.solved(text, name, n)

    def test_half_circle(self):
        for name, n, share in (("legendre", 2, 1e-4), ("legendre:order=6", 2, 1e-7), ("cubic", 4, 1e-4)):
            found = self.half_circle(name, n)
            with self.subTest(name=name):
                self.near(found["x"], -L, share)
                self.near(found["y"], 2 * L / math.pi, share)

    def test_drawing(self):
        for name, n in (("legendre", 1), ("cubic", 2)):
            file = self.folder / f"{name}.h5"
            self.half_circle(name, n)
            self.answered("solve", "--scene", self.folder / "scene.yaml", "--element", self.objects[name], "-f", name, "-n", n,
                          "--shapes", "-o", file)
            with h5py.File(file) as results:
                shapes = []
                results.visit(lambda at, all_of=shapes: all_of.append(at) if at.endswith("/position") else None)
                drawn = results[shapes[0]][()][-1]
            radius = numpy.hypot(drawn[:, 0], drawn[:, 1] - L / math.pi)
            self.assertGreater(len(drawn), 8)
            self.assertLess(numpy.abs(radius * math.pi / L - 1).max(), 0.02)

    def test_frequencies(self):
        text = CANTILEVER + SLENDER + "analyses: {run: {modal: {}}}\nquantities: {f: {frequency: {analysis: run, which: %d}}}\n"
        made = self.altered("legendre.c", ("\nstatic int nodes(", OWN_MASS.replace("MASS", f"{RHO * A!r}")),
                            (".order = order,", ".order = order,\n    .inertia = inertia,"))
        roots = [scipy.optimize.brentq(lambda z: math.cos(z) * math.cosh(z) + 1, *span) for span in ((1, 3), (4, 5))]
        for which, z in zip((0, 2), roots):
            exact = z * z / (2 * math.pi) * math.sqrt(EI / (RHO * A)) / L**2
            self.near(self.solved(text % which, n=4)["f"], exact, 1e-6)
            self.near(self.solved(text % which, n=4, made=made)["f"], exact, 1e-6)
            self.near(self.solved(text % which, "cubic", 8)["f"], exact, 1e-4)

    def test_buckling_and_tension(self):
        column = CANTILEVER + """loads: {P: {force: [-1, 0, 0], on: b}}
analyses: {run: {buckling: {}}}
quantities: {P: {critical_factor: {analysis: run}}}
"""
        euler = math.pi**2 * EI / (4 * L**2)
        haringx = GA * (math.sqrt(1 + 4 * euler / GA) - 1) / 2
        for name in self.objects:
            self.near(self.solved(column, name, 2)["P"], haringx, 1e-5)
        for keys, stiffness, about in ((", pretension: 900", 900 * (math.pi / L)**2, "about: st"),
                                       (", foundation: {translation: [0, 2e4, 0]}", 2e4, "")):
            beam = HEAD + SLENDER + f"""plane: xy
nodes: {{a: {{at: [0, 0, 0], hold: [ux, uy]}}, b: {{at: [1, 0, 0], hold: [ux, uy]}}}}
members: {{m: {{from: a, to: b, section: s, y: [0, 1, 0]{keys}}}}}
analyses: {{st: {{static: {{stations: [1]}}}}, run: {{modal: {{{about}}}}}}}
quantities: {{f: {{frequency: {{analysis: run}}}}}}
"""
            exact = math.sqrt((EI * (math.pi / L)**4 + stiffness) / (RHO * A)) / (2 * math.pi)
            with self.subTest(keys=keys):
                self.near(self.solved(beam, n=2)["f"], exact, 1e-5)
                self.near(self.solved(beam, "cubic", 6)["f"], exact, 1e-4)

    def test_arc(self):
        text = HEAD + f"""nodes: {{a: {{at: [0, 0, 0], hold: all}}, b: {{at: [1, 1, 0]}}}}
members: {{m: {{from: a, to: b, section: s, y: [0, 1, 0], curvature: [0, 0, 1]}}}}
loads: {{F: {{force: [0, -3, 0], on: b}}}}
analyses: {{run: {{linear: {{}}}}}}
quantities: {{u: {TIP % 'uy'}}}
"""
        exact = scipy.integrate.quad(lambda t: (1 - math.sin(t))**2 / EI + math.sin(t)**2 / (E * A) + math.cos(t)**2 / GA,
                                     0, math.pi / 2)[0]
        self.near(self.solved(text, n=1)["u"], -3 * exact, 1e-4)
        self.near(self.solved(text, n=4)["u"], -3 * exact, 1e-8)

    def test_arc_on_a_foundation(self):
        k, sections = (5.0, 20.0), HEAD.replace(f"young: {E}", "young: 1e16").replace(f"shear_modulus: {G}", "shear_modulus: 1e16")
        text = sections + f"""plane: xy
nodes: {{a: {{at: [0, 0, 0]}}, b: {{at: [1, 1, 0]}}}}
members: {{m: {{from: a, to: b, section: s, y: [0, 1, 0], curvature: [0, 0, 1], foundation: {{translation: [{k[0]}, {k[1]}, 0]}}}}}}
loads: {{F: {{force: [0, -3, 0], on: b}}}}
analyses: {{run: {{linear: {{}}}}}}
quantities: {{x: {TIP % 'ux'}, y: {TIP % 'uy'}}}
"""

        def part(t, i, j):
            moved = numpy.array([[1, 0, math.cos(t) - 1], [0, 1, math.sin(t)]])
            axes = numpy.array([[math.cos(t), math.sin(t)], [-math.sin(t), math.cos(t)]]) @ moved
            return float(axes[:, i] * k @ axes[:, j])

        K = [[scipy.integrate.quad(part, 0, math.pi / 2, (i, j))[0] for j in range(3)] for i in range(3)]
        u = numpy.linalg.solve(K, [0, -3, -3])
        found = self.solved(text)
        self.near(found["x"], u[0] - u[2], 1e-4)
        self.near(found["y"], u[1] + u[2], 1e-4)

    def test_motion(self):
        roots = [scipy.optimize.brentq(lambda z: math.cos(z) + 1 / math.cosh(z), (k - 1) * math.pi + 1e-3, k * math.pi)
                 for k in range(1, 9)]
        omega = [z * z * math.sqrt(EI / (RHO * A)) / L**2 for z in roots]
        time = 1.3 / omega[0]
        exact = sum(4e-3 / (RHO * A * L * w * w) * (1 - math.cos(w * time)) for w in omega)
        text = CANTILEVER + SLENDER + f"""loads: {{F: {{force: [0, 1e-3, 0], on: b}}}}
analyses: {{run: {{motion: {{stations: [{time!r}], step: {time / 200!r}, integrator: %s}}}}}}
quantities: {{u: {TIP % 'uy'}}}
"""
        for integrator, share in (("radau", 2e-3), ("alpha", 2e-3), ("conserving", 2e-3)):
            with self.subTest(integrator=integrator):
                self.near(self.solved(text % integrator, n=2)["u"], exact, share)

    def test_temperature(self):
        text = CANTILEVER + f"""loads: {{t: {{temperature: 30, gradient: [20, 0], on: m}}}}
analyses: {{run: {{%s}}}}
quantities: {{x: {TIP % 'ux'}, y: {TIP % 'uy'}}}
"""
        for name in self.objects:
            for analysis, length in (("linear: {}", L), ("static: {stations: [1]}", L * (1 + 30 * ALPHA))):
                found = self.solved(text % analysis, name, 2)
                self.near(found["x"], ALPHA * 30 * L, 1e-4)
                self.near(-found["y"], ALPHA * 20 * L * length / 2, 1e-7)

    def test_rotation(self):
        text = CANTILEVER + f"""analyses: {{run: {{rotation: {{omega: [0, 0, 3], centre: [0, 0, 0], stations: [1]}}}}}}
quantities: {{x: {TIP % 'ux'}, N: {{internal: {{analysis: run, member: m, where: 0.25, resultant: N}}}}}}
"""
        for name in self.objects:
            found = self.solved(text, name, 2)
            self.near(found["x"], RHO * 9 * L**3 / (3 * E), 1e-6)
            self.near(found["N"], RHO * A * 9 * (L**2 - 0.25**2) / 2, 1e-6)

    def test_ends(self):
        text = HEAD + """plane: xy
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0]}, c: {at: [2, 0, 0], hold: [uy]}}
members:
  m: {from: a, to: b, section: s, y: [0, 1, 0]}
  h: {from: b, to: c, section: s, y: [0, 1, 0], release: {from: [rz]}}
springs: {k: {to: b, stiffness: [0, 500, 0, 0, 0, 0]}}
loads: {F: {force: [0, 3, 0], on: h, where: 0.5}}
analyses: {run: {linear: {}}}
quantities: {u: {displacement: {analysis: run, node: b, component: uy}}}
"""
        for name in self.objects:
            self.near(self.solved(text, name)["u"], 1.5 / (500 + 1 / (L**3 / (3 * EI) + L / GA)), 1e-8)

    def test_process(self):
        (self.folder / "cubic.py").write_text(PROCESS, encoding="utf-8")
        command = f"exec:env PYTHONPATH={ROOT / 'elements' / 'examples'} /usr/bin/python3 {self.folder / 'cubic.py'}"
        text = CANTILEVER + f"""loads: {{F: {{distributed: [0, 3, 0], on: m, lumped: yes}}}}
analyses: {{run: {{linear: {{}}}}, modes: {{modal: {{}}}}, far: {{static: {{stations: [1]}}}}}}
quantities: {{u: {TIP % 'uy'}, f: {{frequency: {{analysis: modes, which: 4}}}}, big: {TIP.replace('run', 'far') % 'uy'}}}
"""
        own, same = self.solved(text, "cubic_py", 3, command), self.solved(text, "legendre:order=3", 3)
        self.near(own["u"], same["u"], 1e-8)
        self.near(own["f"], same["f"], 1e-8)
        self.near(own["big"], same["big"], 1e-4)

    def test_places_refused(self):
        for change, words in ((("place[k] = (1 + x) / 2;", "place[k] = (1 + x) / 2 + 0.1;"), "increase from 0"),
                              (("place[k] = (1 + x) / 2;", "place[k] = pow((1 + x) / 2, 4);"), "Gauss-Lobatto")):
            self.refused(2, words, "solve", "elastica", "-n", 1, "--element", self.altered("legendre.c", change), "-f", "legendre")


if __name__ == "__main__":
    unittest.main()
