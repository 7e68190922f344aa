"""Compliance of the sheet flexure modelled as a plate of solid elements. One face is fixed, and the other face moves in
the same way as the edge of a shell.

The mesh of C3D20R is graded towards all edges. The fixed face has no displacement normal to the face and along its
width. Along the thickness, only the middle of the face is fixed. The motion of the tip is a translation and one
rotation vector. Its free components are determined by zero force, or by zero work of the moment. Moments are spatial,
that is, dead about fixed axes (reference/README.md).
"""
import tempfile

import numpy as np

from reference.derive import defaults
from reference.derive.compliance import entry_of, unit_of
from reference.derive.solids import deck
from reference.derive.solids.deck import Grid, Tip, graded, spin, turned

SIZES = ("length", "width", "thickness", "young", "poisson")  # of both cases
LENGTH, WIDTH, THICKNESS, YOUNG, POISSON = (
    float(defaults.values("sheet_cantilever")[name]) for name in SIZES
)
MESHES = (8, 2), (8, 1), (12, 2)  # elements along each edge, layers: coarse, thin, fine
DEFLECTIONS, TWISTS = (0.001, 0.005, 0.01, 0.015), (0.05, 0.1, 0.15)
# A plate has none of these choices of beam physics. Its tip cannot warp, so tip_warping is 0.
ANY = "warping=*;shear=*;trapeze=*;wagner=*;shear_factor=*"
BENT = (
    ("C_ux_Fx", "C_xx", "C_uy_Fy", "C_uy_Mz", "C_thz_Fy")
    + ("C_uz_Fz", "C_zz", "C_thx_Mx", "C_thy_My", "C_thz_Mz")
)
TWISTED = "C_ux_My", "C_thy_Fx", "C_ux_Fx", "C_uz_Fz", "C_thx_Mx", "C_thy_My"


class Sheet:
    def __init__(self, elements, layers, folder):
        """Makes the mesh. `elements` is the number of elements along the length and along the width, and `layers` is
        the number of elements through the thickness."""
        ys = THICKNESS * (np.arange(layers + 1) / layers - 0.5)
        self.grid, self.folder = (
            Grid(LENGTH * graded(elements), ys, WIDTH * (graded(elements) - 0.5)),
            folder,
        )
        face, root = self.grid.at(0, LENGTH), self.grid.at(0, 0)
        middle = set(self.grid.at(1, 0))
        self.tip = Tip(self.grid, face, middle & set(face), (LENGTH, 0, 0))
        self.head = (
            deck.mesh(self.grid, "C3D20R", deck.elastic(YOUNG, POISSON))
            + deck.node_set("TIP", face)
            + deck.node_set("ROOT", root)
        )
        self.head += deck.node_set("ROOTMIDDLE", sorted(middle & set(root)))

    def state(self, motion):
        """Returns (force, spatial moment, stiffness [6, 6]) at a motion [6] of the tip.

        The motion is a translation [m] and a rotation vector [rad].
        """
        R = turned(motion[3:])
        directions, moved = self.tip.boundary(motion[:3], R)
        root = "ROOT,1,1\nROOT,3,3\nROOTMIDDLE,2,2\n"
        text = (
            self.head
            + directions
            + "*BOUNDARY\n"
            + root
            + "*STEP,NLGEOM,INC=200\n*STATIC,SOLVER=SPOOLES\n0.25,1.,1e-4,0.5\n"
            + deck.CONTROLS
            + moved
        )
        text += "*NODE PRINT,NSET=TIP,GLOBAL=YES,FREQUENCY=1000\nU,RF\n*END STEP\n"
        text += (
            "*STEP,PERTURBATION\n*FREQUENCY,SOLVER=MATRIXSTORAGE\n1\n*BOUNDARY,OP=NEW\n"
            + root
            + "*END STEP\n"
        )
        path = deck.run(self.folder, "sheet", text)
        u, f = deck.printed(path, "displacements")[-1], deck.printed(path, "forces")[-1]
        force, moment = self.tip.resultant(u, f, motion[:3], R)
        return force, moment, self.tip.stiffness(deck.tangent(path), u, f, motion[:3], R)


def solve(sheet, motion, free, steps=8):
    """Returns (motion, force, moment, compliance [6, 6]) of the state in which the loads do no work on changes of the
    `free` components of the motion. `motion` [6] is the initial guess.
    """
    motion = np.array(motion, dtype=float)
    for _ in range(steps):
        force, moment, K = sheet.state(motion)
        T = np.eye(6)
        T[3:, 3:] = spin(motion[3:])
        change = np.linalg.solve(
            (T.T @ K @ T)[np.ix_(free, free)], -(T.T @ np.concatenate([force, moment]))[free]
        )
        if np.max(np.abs(change)) < 1e-8 * LENGTH:
            return motion, force, moment, np.linalg.inv(K)
        motion[free] += change
    raise deck.Failed(f"sheet: its free end is not found in {steps} steps")


def compared(run):
    """Returns {name: (value, relative uncertainty)} from the results of run(elements, layers) on all meshes. The
    uncertainty is the sum of the changes due to both refinements.
    """
    coarse, thin, fine = [run(*mesh) for mesh in MESHES]
    return {
        name: (value, (abs(value - coarse[name]) + abs(thin[name] - coarse[name])) / abs(value))
        for name, value in fine.items()
    }


def bent(deflection, mesh):
    with tempfile.TemporaryDirectory() as folder:
        motion, force, _, C = solve(
            Sheet(*mesh, folder), [-0.6 * deflection**2 / LENGTH, deflection, 0, 0, 0, 0], [0]
        )
    values = {name: C[entry_of(name)] for name in BENT}
    return {**values, "u_x": motion[0], "F_y": force[1]}


def twisted(angle, mesh):
    """Returns {name: compliance} for a twist of the tip [rad]. The initial guess is near the
    solution of the beam."""
    start = [
        -1.29e-3 - 4.7e-3 * angle**2,
        0.015,
        0.0125 * angle**2,
        angle,
        0.0875 * angle,
        0.15,
    ]
    with tempfile.TemporaryDirectory() as folder:
        C = solve(Sheet(*mesh, folder), start, [0, 2, 4])[3]
    return {name: C[entry_of(name)] for name in TWISTED}


def unit(name):
    return {"u_x": "m", "F_y": "N"}.get(name) or unit_of(*entry_of(name))


def rows(everything=True):
    """Yields (case, parameters, quantity, value, unit, relative uncertainty, convention).

    If `everything` is False, only the defaults of both cases are computed.
    """
    for deflection in DEFLECTIONS if everything else DEFLECTIONS[-1:]:
        at = ";".join([f"tip_deflection={deflection:g}"] * (deflection != 0.015) + [ANY])
        for name, (value, relative) in compared(lambda *mesh, w=deflection: bent(w, mesh)).items():
            convention = "spatial" if name.startswith("C_") else ""
            yield "sheet_cantilever", at, name, value, unit(name), relative, convention
    for angle in TWISTS if everything else TWISTS[-1:]:
        at = ";".join([f"tip_phi_x={angle:g}"] * (angle != 0.15) + [ANY])
        for name, (value, relative) in compared(
            lambda *mesh, phi=angle: twisted(phi, mesh)
        ).items():
            yield "sheet_wagner", at, name, value, unit(name), relative, "spatial vector"


def anticlastic(mesh=MESHES[0]):
    """Returns the differences between plate and beam in the stiffnesses F_y/u_y, F_y/phi_z and M_z/phi_z of the
    undeformed state (N 4.1), relative to the plate.
    """
    with tempfile.TemporaryDirectory() as folder:
        plate = Sheet(*mesh, folder).state(np.zeros(6))[2][np.ix_((1, 5), (1, 5))]
    inertia, area = (
        WIDTH * THICKNESS**3 / 12,
        10 * (1 + POISSON) / (12 + 11 * POISSON) * WIDTH * THICKNESS,
    )
    shear = LENGTH / (YOUNG / (2 * (1 + POISSON)) * area)
    bending = (
        LENGTH / (YOUNG * inertia) * np.array([[LENGTH**2 / 3, LENGTH / 2], [LENGTH / 2, 1]])
    )
    beam = np.linalg.inv(bending + np.diag([shear, 0]))
    return [1 - beam[i, j] / plate[i, j] for i, j in ((0, 0), (0, 1), (1, 1))]
