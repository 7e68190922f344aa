"""`element-test`: every formulation must satisfy the interface requirements, and injected faults must be reported."""
import json
import os
import subprocess

from harness.tools.kit.program import ROOT, ProgramTest, broken, environment, run

EXAMPLES = ROOT / "elements" / "examples"
CRASHES = environment(ASAN_OPTIONS="handle_segv=0:handle_abort=0")
ENTRY = "    if (out->e == NULL)"

# faults: a text in the example, its replacement, and words of the sentence that must report the fault
FAULTS = {
    "energy": (
        ("e[i] * e[i] / 2;", "e[i] * e[i];"),
        "stress: sigma 1 is", "the derivative of the energy with respect to strain 1"),
    "stiffness": (
        ("= d->stiffness[i];\n", "= 2 * d->stiffness[i];\n"),
        "C: the derivative of sigma", "differences of the stress give"),
    "symmetry": (
        ("    if (out->energy != NULL)\n",
         "    if (out->C != NULL)\n        out->C[1] = d->stiffness[0];\n"
         "    if (out->energy != NULL)\n"),
        "C: entry 2, 1 is 0, but entry 1, 2", "symmetric"),
    "objectivity": (
        ("transposed(x[0].R, chord, p);", "memcpy(p, chord, sizeof p);"),
        "strain: if the element is rotated by", "axes that rotate with the element"),
    "length": (
        ("    out->e[0] -= d->length;\n", ""),
        "strain: strain 1 of the undeformed element is 0.2385 m; define it as zero in that state"),
    "no strains": (
        ("        out->e[i] = (p[i] + q[i]) / (2 * c) + k * along * psi[i];\n"
         "        out->e[3 + i] = d->length * psi[i];\n    }\n    out->e[0] -= d->length;\n",
         "        out->e[i] = out->e[3 + i] = 0;\n    }\n"),
        "the deformed element has an energy of zero; correct strain or stress"),
    "nodes swapped": (
        ("chord[i] = x[1].r[i] - x[0].r[i]", "chord[i] = x[0].r[i] - x[1].r[i]"),
        "strain: strain 1 of the undeformed element"),
    "first node's axes": (
        ("out->e[i] = (p[i] + q[i]) / (2 * c) + k * along * psi[i];", "out->e[i] = p[i];"),
        "if its nodes are exchanged", "LIMIT_ORDER_DEPENDENT"),
    "stale cache": (
        ("out->e[0] -= d->length;",
         "static double kept;\n    kept = kept > 0 ? kept : d->length;\n    out->e[0] -= kept;"),
        " differs after ", "compared with a new process"),
    "counter": (
        ("out->e[0] -= d->length;",
         "static int calls;\n    out->e[0] -= d->length + 1e-9 * calls++;"),
        "strain: e differs in a second, equal call"),
    "beyond sigma": (
        ("    if (out->energy != NULL)\n",
         "    if (out->sigma != NULL)\n        out->sigma[STRAINS] = 0;\n"
         "    if (out->energy != NULL)\n"),
        "stress: sigma: entry 7 is written, but the output has 6 entries"),
    "beyond strains": (
        ("out->e[0] -= d->length;", "out->e[0] -= d->length;\n    out->e[STRAINS + 1] = 0;"),
        "strain: e: entry 8 is written, but the output has 6 entries"),
    "beyond data": (
        ("return sizeof(element_data);", "return sizeof(element_data) - sizeof(double);"),
        "prepare: its data: entry 7 is written, but the output has 6 entries"),
    "not filled": (
        ("        out->e[3 + i] = d->length * psi[i];", "        if (i < 2)\n"
         "            out->e[3 + i] = d->length * psi[i];"),
        "strain: e: entry 6 of 6 is never written"),
    "inputs": (
        (ENTRY, "    ((node_state *)x)[1].a = 1;\n" + ENTRY),
        "changes the states of the nodes, which are inputs"),
    "swallowed": (
        ("        out->e[3 + i] = d->length * psi[i];",
         "        out->e[3 + i] = isnan(psi[i]) ? 0 : d->length * psi[i];\n"
         "        out->e[i] = isnan(out->e[i]) ? 0 : out->e[i];"),
        "that is nan gives finite strains and stresses"),
    "depends": (
        ("        if (out->sigma != NULL)\n            out->sigma[i] = d",
         "        if (out->sigma != NULL)\n            "
         "out->sigma[i] = out->energy == NULL ? 0 : d"),
        "stress: sigma differs if it is requested alone"),
    "energy at rest": (
        ("double energy = 0;", "double energy = 1;"),
        "stress: the undeformed element has an energy of 1 J"),
    "units": (
        ("const double l = request->length;",
         "const double l = request->length * (request->length > 1 ? 1.1 : 1);"),
        "in units of 0.001 m", "check that no length is compared with a dimensionless number"),
    "ignored shear": (
        ("request->features & FEATURE_SHEAR ? ", "request->features & 0 ? "),
        "declares shear, but strains, energy, stresses and C are the same without this feature", "do not declare it"),
    "theory": (
        ("    .shear_theories = SHEAR_HARINGX,\n", ""),
        "shear_theories: the type supports shear but declares no theory"),
    "rotary": (
        ("FEATURE_MASS | FEATURE_ROTARY_INERTIA", "FEATURE_ROTARY_INERTIA"),
        "offers: FEATURE_ROTARY_INERTIA requires FEATURE_MASS"),
    "refused": (
        ("    (void)f;\n",
         "    if (request->features & FEATURE_SHEAR)\n"
         "        return (void)(f && strcpy(f->text, \"no shear today\")), STATUS_REFUSED;\n"),
        "offers: with all features the element fails (rejected: no shear today)", "do not declare it"),
    "options": (
        ("    .leaves = LEAVES_J,",
         "    .leaves = LEAVES_J,\n    .options = {(const parameter_type[])"
         "{{\"form\", \"\", 2, 0, 0, \"one|two\", \"which\"}, {0}}},"),
        "options: the default of 'form' is outside its range"),
    "crash": (
        (ENTRY, "    if (isnan(x[0].r[0]))\n        *(volatile int *)0 = 1;\n" + ENTRY),
        "crashed with signal 11: strain and stress of a state that is nan"),
    "loop": (
        (ENTRY, "    while (isinf(x[0].r[0]) && x[0].R[0] > 0)\n        (void)(volatile int){1};\n"
         + ENTRY),
        "time limit: there was no result within 2 s: strain and stress of a state that is inf; if the element is slow, "
        "set a longer --time-limit"),
    "bending stiffness": (
        ("c->young * c->Iz / l3}", "1.01 * c->young * c->Iz / l3}"),
        "order: the errors of ", "do not decrease (0.0099, 0.0099, 0.0099", "the limit is wrong"),
    "order": (
        ("    .leaves = LEAVES_J,", "    .leaves = LEAVES_J,\n    .order = fourth,"),
        "order: the declared order in buckling is at least 4", "is 2.0 (errors", "declare the observed order"),
    "kind of mass": (
        ("const element_type beamwork_element = {", """static status lumped(const element_data *d, const node_state x[],
                     const element_rotating_frame *frame, inertia_output *out)
{
    (void)d, (void)x, (void)frame;
    for (int i = 0; i < 196 && out->M != NULL; i++)
        out->M[i] = i % 15 == 0 ? 0.5 : 0;
    return STATUS_OK;
}
static int of_field(const double options[])
{
    return options != NULL || 1;
}
const element_type beamwork_element = {.inertia = lumped, .mass_of_field = of_field,"""),
        "mass_of_field: entry", "the field that is exact without loads", "or return 0"),
    "status": (
        ("    return STATUS_OK;\n}\n\nstatic int strains",
         "    return energy > 1 ? STATUS_SINGULAR : STATUS_OK;\n}\n\nstatic int strains"),
        "stress: strains of a few hundredths of the length give the status 'singular'"),
}

FORCE_FAULTS = {
    "sign": (
        ("F[i] = n * r[i];", "F[i] = -n * r[i];"),
        "force: F in coordinate 1 (displacement along x of node 1) is", "the derivative of the energy"),
    "energy": (
        ("energy = n * n / d->axial / 2;", "energy = n * n / d->axial;"),
        "force: F in coordinate", "the derivative of the energy"),
    "geometric stiffness": (
        ("        add(3, N, 3, 0, B, W, K + b * N);", "        (void)W;"),
        "K: the derivative of the force in coordinate", "differences of F give"),
    "material stiffness": (
        ("    add(N, N, 6, 1, D, kD, K); /* material stiffness */\n", ""),
        "K: the derivative of the force in coordinate", "differences of F give"),
    "objectivity": (
        ("add(3, 3, 3, 0, E, x[k].R, S[k]);", "memcpy(S[k], x[k].R, sizeof S[k]);"),
        "force: a rigid rotation by", "axes that rotate with the element"),
    "beyond K": (
        ("memset(out->K, 0, NODES * NODES * sizeof *K);",
         "memset(out->K, 0, (NODES * NODES + 1) * sizeof *K);"),
        "force: K: entry 197 is written, but the output has 196 entries"),
    "prestress": (
        ("F[i] = n * r[i];", "F[i] = (n + 1) * r[i];"),
        "of the undeformed element is", "define it as zero in that state"),
}

CLASSIC = {
    "swapped bending": (
        ("c->young * c->Iy, c->young * c->Iz}", "c->young * c->Iz, c->young * c->Iy}"),
        "pure bending about y:", "(probably E Iy)"),
    "swapped shear": (
        ("c->F[i == 1 ? 4 : 0]", "c->F[i == 1 ? 0 : 4]"),
        "constant shear along y, short beam:", "(probably G A times the shear factor, or E Iz)"),
    "coupling about y": (
        ("? -1 : (2 - phi)", "? -1 : (i == 1 ? -1 : 1) * (2 - phi)"),
        "tip force along z: the result is exact with one element, but", "correct the coupling of the nodes, its sign"),
    "coupling about z": (
        ("? -1 : (2 - phi)", "? -1 : (i == 2 ? -1 : 1) * (2 - phi)"),
        "tip force along y: the result is exact with one element, but", "correct the coupling of the nodes, its sign"),
    "torsion": (
        ("GI = c->shear_modulus", "GI = 1.01 * c->shear_modulus"),
        "pure torsion: the error is 0.99 % with one element and 0.99 % with four", "(probably G It)"),
    "no shear": (
        ("? 12 : 0;", "? 0 : 0;"),
        "constant shear along y, short beam:", "(probably G A times the shear factor, or E Iz)"),
    "length": (
        ("c->young * c->A / l;", "c->young * c->A * l;"),
        "stretch: the result is exact with one element, but", "a power of the length"),
}

FOURTH = """static element_order fourth(element_analysis a, const double options[])
{
    (void)a, (void)options;
    return (element_order){4, 4};
}
const element_type beamwork_element"""


class Tested(ProgramTest):

    def compiled(self, name, *changes):
        text = (EXAMPLES / name).read_text(encoding="utf-8")
        text = text.replace("const element_type beamwork_element", FOURTH)
        for before, after in changes:
            self.assertIn(before, text)
            text = text.replace(before, after, 1)
        source, made = self.folder / name, self.folder / "mine.so"
        source.write_text(text, encoding="utf-8")
        subprocess.run([os.environ.get("CC", "cc"), "-O0", "-shared", "-fPIC", "-w", "-I", ROOT,
                        source, "-o", made],
                       check=True)
        return made

    def certificate(self, made, code, limit=120):
        done = run("element-test", "--element", made, "--format", "json", "--time-limit", limit,
                   env=CRASHES)
        self.assertEqual(done.returncode, code, done.stderr)
        one = json.loads(done.stdout)
        self.assertEqual([f["kept"] for f in one["formulations"]], [code == 0])
        return one

    def broken(self, made, limit):
        return broken(self.certificate(made, 1, limit))

    def told(self, name, faults):
        for fault, (change, *words) in faults.items():
            with self.subTest(fault=fault):
                said = self.broken(self.compiled(name, change), 2 if fault == "loop" else 120)
                self.assertTrue(any(all(w in s for w in words) for s in said), said)


class Planted(Tested):

    def test_each_is_told(self):
        self.assertGreaterEqual(len(FAULTS), 20)
        with_sanitizers = "fsanitize" in run("--version").stdout
        self.told("timoshenko.c", {name: fault for name, fault in FAULTS.items()
                                   if not (with_sanitizers and name == "beyond data")})

    def test_each_of_a_force_is_told(self):
        self.told("corotational.c", FORCE_FAULTS)

    def test_each_that_structures_show_is_told(self):
        self.told("corotational.c", CLASSIC)
        out = " ".join(self.answered("element-test", "-q", "--element", self.folder / "mine.so", code=1).stdout.split())
        self.assertIn("VIOLATED", out)
        self.assertIn("measured: 1 state with a wrong limit", out)
        self.assertIn("stretch: the result is exact with one element", out)


    def test_linear(self):
        first = ("        out->e[i] = (p[i] + q[i]) / (2 * c) + k * along * psi[i];\n",
                 "        out->e[i] = p[i] + (i == 1 ? -d->length * psi[2] / 2 : i == 2 ? d->length * psi[1] / 2 : 0);\n")
        small = ("FEATURE_GEOMETRIC | FEATURE_LARGE | ", "")
        unused = ("    const double square", "    (void)q;\n    const double square")
        one = self.certificate(self.compiled("timoshenko.c", first, small, unused), 0)
        self.assertNotIn("broken", [c["outcome"] for c in one["claims"]])
        said = self.broken(self.compiled("timoshenko.c", (first[0], first[1].replace("-d->length * psi[2] / 2", "0")), small,
                                         unused), 120)
        self.assertTrue(any("if its nodes are exchanged" in s for s in said), said)

    def test_endless(self):
        made = self.compiled("timoshenko.c", (ENTRY, "    for (volatile int i = 1; i;)\n"
                                              "        ;\n" + ENTRY))
        out = self.answered("element-test", "--element", made, "--time-limit", "1", "-j", "1", code=1).stdout
        self.assertEqual(out.count("time limit: there was no result within 1 s"), 1)
        self.assertIn("not checked, because 'features' exceeded the time limit", out)


class Measured(Tested):

    def measured(self, *changes, code=0):
        one = self.certificate(self.compiled("timoshenko.c", *changes), code)
        errors = {}
        for point in one["measured_points"]:
            errors.setdefault(point["name"], []).append(point["error"])
        return {m["name"]: {**m, "error": errors.get(m["name"], [])} for m in one["measured"]}

    def test_without_a_fault(self):
        found = self.measured()
        for name in ("stretch", "pure torsion", "tip force along y",
                     "constant shear along z, short beam"):
            self.assertLess(max(map(abs, found[name]["error"])), 1e-9, name)
        self.assertEqual([name for name, m in found.items() if m["locks"]], [])
        self.assertAlmostEqual(found["vibration: first bending mode"]["order"], 7.2, delta=0.2)
        self.assertIn("not supported: warping", found["torsion, warping held"]["words"])

    def test_torsion_constant(self):
        found = self.measured(("c->shear_modulus * c->It / l3", "c->shear_modulus * c->Ip / l3"), code=1)
        wrong = [name for name, m in found.items() if m["error"] if abs(m["error"][0]) > 0.2
                 and m["name"].startswith("pure")]
        self.assertEqual(wrong, ["pure torsion"])
        self.assertEqual([name for name, m in found.items() if m["wrong_limit"]], wrong)
        self.assertIn("correct the stiffness of the section (probably G It)", found[wrong[0]]["words"])
        out = self.answered("element-test", "--element", self.folder / "mine.so", code=1).stdout
        self.assertIn("measured: 1 state with a wrong limit", out)
        self.assertRegex(out, r"\n  violated: \d+ in 'states'")
        self.assertRegex(out, r"\n  states .*  violated\n")
        self.assertIn("correct the stiffness of the section (probably G It)", " ".join(out.split()))

    def test_units(self):
        made = self.compiled("timoshenko.c", ("out->stiffness, one, sizeof one);",
                              "out->stiffness, one, sizeof one);\n    for (int i = 0; i < STRAINS; "
                              "i++)\n        out->stiffness[i] *= 1e-3;"))
        self.assertIn("the element is 1e+03 times too soft in every state; check the units",
                      run("element-test", "--element", made).stdout)

    def test_shear_locking(self):
        found = self.measured(("c->young * c->Iz / l3}",
                               "c->young * c->Iz / l3 + c->shear_modulus * c->A / (12 * l)}"),
                              code=1)
        one = found["cantilever with shear, force"]
        self.assertTrue(one["locks"])
        self.assertIn("its error increases from", one["words"])
        self.assertLess(one["error"][-1], -0.99)

    def test_constant_shear(self):
        found = self.measured(("shear * c->F[0]", "shear / 2 * c->F[0]"), code=1)
        self.assertLess(found["constant shear along y, short beam"]["error"][0], -0.05)
        self.assertLess(abs(found["constant shear along z, short beam"]["error"][0]), 1e-9)

    def test_one_element(self):
        found = self.measured((" + l * l * l / (12 * c->young * c->Iz)",
                               " + 1e-3 * l * l * l / (12 * c->young * c->Iz)"))
        self.assertAlmostEqual(found["tip force along y"]["error"][0], -0.25, delta=1e-3)
