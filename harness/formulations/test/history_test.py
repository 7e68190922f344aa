"""Elements with a history. In every analysis, the history must be committed at accepted steps and never at rejected
steps."""
import json
import shutil
import subprocess
import sys

from harness.cli.test.plugin import EXAMPLES, compile_shared
from harness.tools.kit.program import ROOT, ProgramTest, broken

BAR = """beamwork: 1
sections: {s: {rectangle: {width: 0.02, thickness: 0.01}, young: 2e11, shear_modulus: 8e10, density: 8000}}
nodes: {a: {at: [0, 0, 0], hold: all}, b: {at: [1, 0, 0], hold: [uy, uz, ry, rz]%s}}
members: {ab: {from: a, to: b, section: s, y: [0, 1, 0]}}
omit: [warping, trapeze, wagner_torque]
"""
DRIVEN, FREE = BAR % ", drive: {rx: turn}", BAR % ""
BESIDE = BAR.replace(", b: {", ", c: {at: [0, 1, 0], hold: all}, d: {at: [1, 1, 0]}, b: {").replace(
    "members: {", "members: {cd: {from: c, to: d, section: s, y: [0, 1, 0]}, ") % ", drive: {rx: turn}"
TORQUE = "torque: {reaction: {analysis: run, node: b, component: rx, take: curve}, unit: N m}"
TURN = "turn: {displacement: {analysis: run, node: b, component: rx, take: curve}, unit: rad}"
OCTAVE = (("function e = strain(kind, r, u, R, a)", "function e = linear(kind, r, u, R, a)"),
          ("function A = turned_back(R)", """function e = strain(kind, r, u, R, a, h)
e = linear(kind, r, u, R, a);
t = e(4, :) / kind.length;
m = (t + h(1, :)) / 2;
e(4, :) = kind.length * (h(2, :) + (t - h(1, :)) .* (1 + 10 * m .^ 2));
end

function h = commit(kind, r, u, R, a, h)
of_strain = strain(kind, r, u, R, a, h)(4, :);
h = [linear(kind, r, u, R, a)(4, :); of_strain] / kind.length;
end

function A = turned_back(R)"""),
          ("'strain', @strain, 'strains', 6,", "'strain', @strain, 'strains', 6, 'history', 2, 'commit', @commit,"),
          ("{'doubly symmetric'}", "{'doubly symmetric', 'path dependent'}"))
FORTRAN = (("this%stress = c_funloc(stress)", """this%stress = c_funloc(stress)
    this%history = c_funloc(history)
    this%commit = c_funloc(commit)"""),
           ("ior(limit_doubly_symmetric, ", "ior(limit_doubly_symmetric + limit_path_dependent, "),
           ("    e(1) = e(1) - data%length\n  end subroutine", """    e(1) = e(1) - data%length
    if (.not. c_associated(out%history)) return
    call c_f_pointer(out%history, h, [2])
    k = e(4) / data%length
    e(4) = data%length * (h(2) + (k - h(1)) * (1 + 10 * ((k + h(1)) / 2)**2))
  end subroutine

  function history(options) bind(c, name="") result(count)
    type(c_ptr), value :: options
    integer(c_int) :: count
    count = 2
  end function

  subroutine commit(data, x, h) bind(c, name="")
    type(element_data), intent(in) :: data
    type(node_state), intent(in) :: x(2)
    real(c_double), intent(inout), target :: h(2)
    real(c_double), target :: e(m), plain(m)
    call strain(data, x, strain_output(c_loc(e), c_null_ptr, c_null_ptr, c_null_ptr, c_loc(h)))
    call strain(data, x, strain_output(c_loc(plain), c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr))
    h = [plain(4), e(4)] / data%length
  end subroutine"""),
           ("real(c_double), pointer :: e(:)\n    real(c_double) :: chord", """real(c_double), pointer :: e(:), h(:)
    real(c_double) :: chord"""))
RIGIDITY = 292.712582272 / 0.8  # torsional rigidity of timoshenko.c [N m^2]


class Path:
    def __init__(self, n=1):
        self.n, self.twist, self.strain = n, 0, 0

    def at(self, twist):
        step, m = twist / self.n - self.twist, (twist / self.n + self.twist) / 2
        return self.strain + step * (1 + 10 * m * m), 1 + 10 * m * m + 10 * step * m, 20 * m + 5 * step

    def torque(self, twist):
        e, J, _ = self.at(twist)
        return RIGIDITY * self.n * e * J

    def stiffness(self, twist):
        e, J, H = self.at(twist)
        return RIGIDITY * (J * J + e * H)

    def accept(self, twist):
        self.strain, self.twist = self.at(twist)[0], twist / self.n

    def under(self, torque):
        low, high = self.n * self.twist, 2
        for _ in range(100):
            middle = (low + high) / 2
            low, high = (middle, high) if self.torque(middle) < torque else (low, middle)
        return low


class History(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.shared = compile_shared(ROOT / "harness/formulations/test/midpoint.c", cls.class_folder() / "midpoint.so")

    def scene(self, text):
        path = self.folder / "scene.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    def solved(self, text, *words, n=1):
        done = self.answered("solve", self.scene(text), "--element", self.shared, "-n", n,
                             *(words if "-f" in words else ("-f", "midpoint", *words)), "--format", "json")
        record = json.loads(done.stdout)
        return {c["quantity"]: dict(zip(c["curve_x"], c["curve_value"])) for c in record["curves"]}, record

    def follows(self, torque, steps, twist_of, n=1, close=2e-6):
        path, compared = Path(n), 0
        for at in steps:
            if at in torque:
                compared += 1
                self.assertAlmostEqual(torque[at] / path.torque(twist_of(at)), 1, delta=close)
            path.accept(twist_of(at))
        self.assertEqual(compared, len([at for at in torque if at > 0]))

    def test_rejected_steps(self):
        text = BESIDE + ("motions: {turn: {unit: rad, path: [0, 1], value: [0, 0.8]}}\n"
                         "loads: {pull: {force: [-30000, 20000, 8000], on: d}}\n"
                         "analyses: {run: {static: {stations: 0..1/2}}}\n"
                         f"quantities: {{{TORQUE}}}\n")
        for n, words in ((4, ()), (4, ("--steps", 3)), (4, ("-f", "midpoint:newton=displacement")),
                         (2, ("-f", "midpoint:newton=dense")), (4, ("--threads", 2))):
            curves, record = self.solved(text, *words, n=n)
            self.assertGreater(sum(s["rejected"] for s in record["steps"]), 0, words)
            self.follows(curves["torque"], [s["path"] for s in record["steps"]], lambda at: 0.8 * at, n)

    def test_loads_and_stiffness(self):
        static = FREE + ("loads: {pull: {moment: [1000, 0, 0], on: b}}\n"
                         "analyses: {run: {static: {stations: 0..1/4}}, at: {compliance: {node: b, about: run}}}\n"
                         f"quantities: {{{TURN}, stiffness: "
                         "{stiffness: {analysis: at, component: rx, take: curve}, unit: N m/rad}}\n")
        continued = FREE + ("loads: {pull: {moment: [1000, 0, 0], on: b}, more: {force: [40000, 0, 0], on: b}}\n"
                            "analyses: {run: {continuation: {control: {node: b, component: ux}, step: 0.25e-3,\n"
                            "  to: [0.25e-3, 0.5e-3, 0.75e-3, 1e-3], constant: yes}}}\n"
                            f"quantities: {{{TURN}}}\n")
        curves, _ = self.solved(static)
        beside, _ = self.solved(continued)
        path = Path()
        for part in (0.25, 0.5, 0.75, 1):
            twist = path.under(1000 * part)
            self.assertAlmostEqual(curves["turn"][part], twist, delta=1e-6)
            self.assertAlmostEqual(beside["turn"][part * 1e-3], twist, delta=1e-6)
            self.assertAlmostEqual(curves["stiffness"][part] / path.stiffness(twist), 1, delta=2e-5)
            path.accept(twist)

    def test_modes(self):
        text = FREE + ("loads: {pull: {moment: [200, 0, 0], on: b}}\n"
                       "analyses: {half: {static: {stations: [0.5]}}, run: {static: {stations: 0..1/2}},\n"
                       "  near: {modal: {about: half}}, far: {modal: {about: run}}}\n"
                       "quantities: {f: {frequency: {analysis: near, which: 0}}, g: {frequency: {analysis: far, "
                       "which: 0}}}\n")
        _, record = self.solved(text)
        f, g = (q["value"] for q in record["quantities"])
        self.assertEqual([s["path"] for s in record["steps"]], [0.5, 0.5, 1])
        path = Path()
        near = path.stiffness(path.under(100))
        path.accept(path.under(100))
        self.assertAlmostEqual((g / f)**2 / (path.stiffness(path.under(200)) / near), 1, delta=2e-5)

    def test_many(self):
        text = DRIVEN + ("motions: {turn: {unit: rad, path: [0, 1], value: [0, 0.8]}}\n"
                         "analyses: {run: {static: {stations: 0..1/4}}}\n"
                         f"quantities: {{{TORQUE}}}\n")
        wanted, _ = self.solved(text, n=7)
        for lanes in (0, 4):
            source = self.folder / "many.c"
            source.write_text((ROOT / "harness/formulations/test/midpoint.c").read_text(encoding="utf-8").replace(
                "const element_type beamwork_element", """static void many(int count, const element_data *const data[],
                 const node_state x[], strain_output out[])
{
    for (int i = 0; i < count; i++)
        midpoint_strain(data[i], x + 2 * i, &out[i]);
}

static void many_stresses(int count, const element_data *const data[], const double *const e[],
                          const double *const inner[], stress_output out[], status outcome[])
{
    for (int i = 0; i < count; i++)
        outcome[i] = stress(data[i], e[i], inner[i], &out[i]);
}

const element_type beamwork_element""").replace(".stress = stress,", f""".stress = stress,
    .strain_many = many,
    .stress_many = many_stresses,
    .lanes = {lanes},"""), encoding="utf-8")
            made = compile_shared(source, self.folder / f"many{lanes}.so")
            done = self.answered("solve", self.scene(text), "--element", made, "-f", "midpoint", "-n", 7, "--format",
                                 "json")
            curve = json.loads(done.stdout)["curves"][0]
            self.assertEqual(dict(zip(curve["curve_x"], curve["curve_value"])), wanted["torque"])
        self.follows(wanted["torque"], [0.25, 0.5, 0.75, 1], lambda at: 0.8 * at, 7)

    def test_meshes(self):
        text = DRIVEN + ("motions: {turn: {unit: rad, path: [0, 1], value: [0, 0.8]}}\n"
                         "analyses: {run: {static: {stations: [0.5, 1]}}}\n"
                         f"quantities: {{{TORQUE.replace(', take: curve', '')}}}\n")
        for jobs in (1, 2):
            done = self.answered("converge", "--scene", self.scene(text), "--element", self.shared, "-f", "midpoint",
                                 "--elements", "1,2,4", "-j", jobs, "--format", "json")
            found = {m["elements"]: m["value"] for m in json.loads(done.stdout)["series"][0]["quantities"][0]["meshes"]}
            self.assertEqual(sorted(found), [1, 2, 4])
            for n, value in found.items():
                path = Path(n)
                path.accept(0.4)
                self.assertAlmostEqual(value / path.torque(0.8), 1, delta=2e-6)

    def test_motions(self):
        text = DRIVEN + ("motions: {turn: {unit: rad, time: 0.8*t^2}}\n"
                         "analyses:\n"
                         "  run: {motion: {stations: 0..1/4, integrator: INTEGRATOR, step: 0.25}}\n"
                         "  first: {motion: {stations: [0, 0.5], integrator: INTEGRATOR, step: 0.25}}\n"
                         "  second: {motion: {stations: [0.75, 1], integrator: INTEGRATOR, step: 0.25, about: first}}\n"
                         f"quantities: {{{TORQUE}, {TORQUE.replace('run', 'second').replace('torque', 'then')}}}\n")
        steps, twist_of = (0.25, 0.5, 0.75, 1), lambda time: 0.8 * time**2
        for integrator in ("radau", "alpha", "explicit"):
            curves, _ = self.solved(text.replace("INTEGRATOR", integrator))
            self.follows(curves["torque"], steps, twist_of, close=1e-5)
            for time in (0.75, 1):
                self.assertAlmostEqual(curves["then"][time] / curves["torque"][time], 1, delta=1e-5)
        curves, _ = self.solved(text.replace("INTEGRATOR", "radau").replace("0..1/4", "0..1/12"))
        path = Path()
        for k in range(1, 13):
            time = k / 12
            found = min(curves["torque"].items(), key=lambda one, time=time: abs(one[0] - time))[1]
            self.assertAlmostEqual(found / path.torque(twist_of(time)), 1, delta=1e-4)
            if k % 3 == 0:
                path.accept(twist_of(time))

    def test_as_without(self):
        text = (ROOT / "harness/formulations/test/midpoint.c").read_text(encoding="utf-8")
        source = self.folder / "plain.c"
        source.write_text(text.replace("1 + 10 * m * m", "1 + 0 * m"), encoding="utf-8")
        mine = compile_shared(source, self.folder / "plain.so")
        other = compile_shared(EXAMPLES / "timoshenko.c", self.folder / "timoshenko.so")
        for case, words in (("release", ("--set", "time=0.05")), ("c_cantilever", ()), ("elastica", ())):
            found = []
            for file, name in ((mine, "midpoint"), (other, "timoshenko")):
                done = self.answered("solve", case, "--element", file, "-f", name, "-n", 4, *words, "--format", "json")
                found.append({q["quantity"]: q["value"] for q in json.loads(done.stdout)["quantities"]})
            self.assertEqual(found[0].keys(), found[1].keys())
            for name, value in found[1].items():
                if value is not None:
                    self.assertAlmostEqual(found[0][name], value, delta=1e-7 * abs(value), msg=(case, name))

    def test_process(self):
        scene = self.scene(FREE.replace("hold: [uy, uz, ry, rz]", "") + (
            "loads: {pull: {force: [-20, 30, 60], on: b}, turn: {moment: [30, 0, 0], on: b}}\n"
            "analyses: {run: {static: {stations: 0..1/3}}, go: {motion: {stations: [0.05], integrator: alpha, "
            "step: 0.005}}}\n"
            "quantities: {y: {displacement: {analysis: run, node: b, component: uy}},\n"
            "  z: {displacement: {analysis: go, node: b, component: uz}}}\n").replace(", }", "}"))
        shared = compile_shared(EXAMPLES / "incremental.c", self.folder / "incremental.so")
        found = []
        for file, name in ((shared, "incremental"),
                           (f"exec:'{sys.executable}' '{EXAMPLES / 'incremental.py'}'", "incremental_py")):
            done = self.answered("solve", scene, "--element", file, "-f", name, "-n", 3, "--format", "json")
            record = json.loads(done.stdout)
            found.append([q["value"] for q in record["quantities"]])
            self.assertIn("path independence", json.dumps(record))
        for one, other in zip(*found):
            self.assertAlmostEqual(one / other, 1, delta=1e-6)

    def changed(self, name, changes):
        text = (EXAMPLES / name).read_text(encoding="utf-8")
        for before, after in changes:
            self.assertIn(before, text)
            text = text.replace(before, after, 1)
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def follows_in(self, element, name):
        scene = self.scene(DRIVEN + ("motions: {turn: {unit: rad, path: [0, 1], value: [0, 0.8]}}\n"
                                     "analyses: {run: {static: {stations: 0..1/4}}}\n"
                                     f"quantities: {{{TORQUE}}}\n"))
        done = self.answered("solve", scene, "--element", element, "-f", name, "-n", 2, "--format", "json")
        curve = json.loads(done.stdout)["curves"][0]
        self.follows(dict(zip(curve["curve_x"], curve["curve_value"])), curve["curve_x"][1:], lambda at: 0.8 * at, 2)

    def faults(self, *changes, file=ROOT / "harness/formulations/test/midpoint.c"):
        text = file.read_text(encoding="utf-8")
        for before, after in changes:
            self.assertIn(before, text)
            text = text.replace(before, after, 1)
        source = self.folder / "changed.c"
        source.write_text(text, encoding="utf-8")
        made = compile_shared(source, self.folder / "changed.so")
        done = self.answered("element-test", "--element", made, "--format", "json", code=1 if changes else 0)
        record = json.loads(done.stdout)
        points = {}
        for point in record["measured_points"]:
            points.setdefault(point["name"], []).append(point["error"])
        return " ".join(broken(record)), points

    def test_element_test(self):
        none, points = self.faults()
        self.assertEqual(none, "")
        one, ten, hundred = points["strains after closed cycles"]
        self.assertGreater(one, 1e-4)
        self.assertAlmostEqual(ten / one, 10, delta=1e-6)
        self.assertAlmostEqual(hundred / one, 100, delta=1e-5)
        self.assertLess(max(points["strains, turns superposed"]), 1e-12)
        self.assertIn("declare LIMIT_PATH_DEPENDENT", self.faults((" | LIMIT_PATH_DEPENDENT", ""))[0])
        self.assertIn("declare LIMIT_NOT_OBJECTIVE",
                      self.faults(("LIMIT_NOT_OBJECTIVE | ", ""), file=EXAMPLES / "incremental.c")[0])
        self.assertIn("changes from", self.faults(("history[0] = t;", "history[0] = t / 2;"))[0])
        self.assertIn("after a second commit", self.faults(("history[0] = t;", "history[0] += t;"))[0])

    def test_octave(self):
        if shutil.which("octave-cli") is None:
            self.skipTest("needs octave-cli")
        path = self.changed("timoshenko.m", OCTAVE)
        shutil.copy(EXAMPLES / "beamwork_element.m", self.folder)
        self.follows_in(f"exec:octave-cli -qf '{path}'", "timoshenko_m")

    def test_fortran(self):
        if shutil.which("gfortran") is None:
            self.skipTest("needs gfortran")
        path, made = self.changed("timoshenko.f90", FORTRAN), self.folder / "mine.so"
        subprocess.run(["gfortran", "-O1", "-shared", "-fPIC", path, "-o", made], check=True, cwd=self.folder)
        self.follows_in(made, "timoshenko_f90")
        done = self.answered("element-test", "--element", made, "--format", "json")
        self.assertEqual(broken(json.loads(done.stdout)), [])

    def test_refused(self):
        conserving = DRIVEN + ("motions: {turn: {unit: rad, time: t^2}}\n"
                               "analyses: {run: {motion: {stations: [1], integrator: conserving, step: 0.1}}}\n"
                               f"quantities: {{{TORQUE}}}\n")
        warm = FREE.replace("density: 8000", "density: 8000, expansion: 1e-5") + (
            "loads: {warm: {temperature: 30, on: ab}}\nanalyses: {run: {static: {stations: [1]}}}\n"
            "quantities: {x: {displacement: {analysis: run, node: b, component: ux}}}\n")
        for text, why in ((conserving, "use the integrator alpha or radau"), (warm, "use another formulation")):
            done = self.answered("solve", self.scene(text), "--element", self.shared, "-f", "midpoint", code=2)
            self.assertIn(why, done.stderr + done.stdout)
            self.assertIn("has a history", done.stderr + done.stdout)
