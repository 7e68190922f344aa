"""The channel cantilever modelled as a solid, with a dead force at an end of the web (J section 5.2, Figs. 11-12).

The mesh of C3D20R has one element through each wall. The root is fixed, and the tip is free. The force acts on the
node on the mid-line of the web at half the outer height above (D) or below (E) the axis. The deflection of this node
is prescribed in steps. The outer dimensions are 30 x 10 cm (`sizes=overall`).
"""
import tempfile

import numpy as np

from reference.derive import defaults
from reference.derive.solids import deck
from reference.derive.solids.deck import Grid

LENGTH = float(defaults.values("c_cantilever")["length"])
HEIGHT, WIDTH, FLANGE, WEB, YOUNG, SHEAR = 0.3, 0.1, 0.016, 0.01, 210e9, 80.77e9
MESHES = (14, 2, 3), (
    20,
    2,
    4,
)  # numbers of elements along the beam, of a flange next to the web, and of the web between the flanges
STATIONS = {
    "D": np.concatenate([np.arange(1, 10) * 0.02, 0.2 + 0.06 * np.arange(41)]),
    "E": np.concatenate([np.arange(1, 10) * 0.02, 0.2 + 0.042 * np.arange(24), [1.2]]),
}
POINTS = {"D": (0.1, 0.2, 0.5, 1.04, 2.6), "E": (0.1, 0.2, 0.494, 1.04, 1.2)}
WAGNER = (
    [],
    ["wagner_moments=*"],
)  # the values apply to the defaults of the case and to any `wagner_moments`, an option of beams that has no effect on a solid


def channel(along, flange, web):
    ys = np.concatenate([np.linspace(-WIDTH, -WEB, flange + 1), [0]])
    zs = np.concatenate(
        [
            [-HEIGHT / 2],
            np.linspace(-HEIGHT / 2 + FLANGE, HEIGHT / 2 - FLANGE, web + 1),
            [HEIGHT / 2],
        ]
    )
    return Grid(
        np.linspace(0, LENGTH, along + 1), ys, zs, lambda i, j, k: j == flange or k in (0, web + 1)
    )


def path(point, stations, mesh):
    """Returns [(load [N], lateral displacement of the loaded point [m])] at the deflections `stations` of this point
    [m]."""
    grid = channel(*mesh)
    where = np.array([LENGTH, -WEB / 2, HEIGHT / 2 if point == "D" else -HEIGHT / 2])
    loaded = int(np.argmin(np.linalg.norm(grid.nodes - where, axis=1)))
    assert np.allclose(grid.nodes[loaded], where)
    text = (
        deck.mesh(grid, "C3D20R", deck.elastic(YOUNG, YOUNG / (2 * SHEAR) - 1))
        + deck.node_set("ROOT", grid.at(0, 0))
        + deck.node_set("LOADED", [loaded])
    )
    text += "*BOUNDARY\nROOT,1,3\n"
    for w in stations:
        text += f"*STEP,NLGEOM,INC=200\n*STATIC,SOLVER=SPOOLES\n1.,1.,1e-4,1.\n{deck.CONTROLS}"
        text += f"*BOUNDARY\n{loaded + 1},3,3,{-w:.12e}\n"
        text += "*NODE PRINT,NSET=LOADED,FREQUENCY=1000\nU,RF\n*END STEP\n"
    with tempfile.TemporaryDirectory() as folder:
        done = deck.run(folder, "channel", text)
        u, f = deck.printed(done, "displacements"), deck.printed(done, "forces")
    return [(-force[loaded][2], moved[loaded][1]) for moved, force in zip(u, f)]


def rows(everything=True):
    """Yields (case, parameters, quantity, value, unit, relative uncertainty, convention, at).

    The rows are those of curves and of points with other parameters. The uncertainty is the change due to the last
    refinement plus 1e-4 of the value. If `everything` is False, only the first 0.2 m of the curve of D is computed.
    """
    for point in "DE" if everything else "D":
        stations = STATIONS[point] if everything else STATIONS[point][:10]
        coarse, fine = [path(point, stations, mesh) for mesh in MESHES]
        for w, before, after in zip(stations, coarse, fine):
            relative = [abs(b / a - 1) + 1e-4 for a, b in zip(after, before)]
            for text, names, at in places(point, w):
                for name, unit, value, error in zip(names, ("N", "m"), after, relative):
                    yield "c_cantilever", text, name, value, unit, error, "", at


def places(point, w):
    common = ["load_height=edge"] + ["load_point=E"] * (point == "E")
    alone = np.min(np.abs(np.array(POINTS[point]) - w)) < 1e-9
    for more in WAGNER:
        yield ";".join(common + [f"w={STATIONS[point][-1]:g}"] + more), (
            "curve",
            "lateral_curve",
        ), f"{w:g}"
        if alone:
            yield ";".join(common + [f"w={w:g}"] * (abs(w - 0.5) > 1e-9) + more), (
                "load_at_w",
                "lateral",
            ), ""
