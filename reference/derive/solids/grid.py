"""Structured meshes of bricks with 20 nodes, from boxes of a common lattice."""
import numpy as np

# Corners, then middles of the edges of the lower face, of the upper face and between them, in half
# steps of the lattice.
BRICK = (
    (0, 0, 0),
    (2, 0, 0),
    (2, 2, 0),
    (0, 2, 0),
    (0, 0, 2),
    (2, 0, 2),
    (2, 2, 2),
    (0, 2, 2),
    (1, 0, 0),
    (2, 1, 0),
    (1, 2, 0),
    (0, 1, 0),
    (1, 0, 2),
    (2, 1, 2),
    (1, 2, 2),
    (0, 1, 2),
    (0, 0, 1),
    (2, 0, 1),
    (2, 2, 1),
    (0, 2, 1),
)


def graded(elements):
    """Stations from 0 to 1 [elements + 1], dense at both ends."""
    return (1 - np.cos(np.pi * np.arange(elements + 1) / elements)) / 2


def halved(stations):
    """Stations with the middles between them."""
    return np.sort(np.concatenate([stations, (stations[1:] + stations[:-1]) / 2]))


class Grid:
    """nodes [count, 3] m, elements [count, 20]; both are counted from zero."""

    def __init__(self, xs, ys, zs, wanted=lambda i, j, k: True):
        """Stations of corners along each axis [m]; wanted: which cells are filled."""
        axes, number, nodes = [halved(np.asarray(a, dtype=float)) for a in (xs, ys, zs)], {}, []

        def node(place):
            if place not in number:
                number[place] = len(nodes)
                nodes.append([axis[i] for axis, i in zip(axes, place)])
            return number[place]

        cells = [c for c in np.ndindex(len(xs) - 1, len(ys) - 1, len(zs) - 1) if wanted(*c)]
        self.elements = np.array(
            [[node(tuple(2 * i + d for i, d in zip(c, offset))) for offset in BRICK] for c in cells]
        )
        self.nodes = np.array(nodes)

    def at(self, axis, value):
        """Indices of the nodes in a plane."""
        return np.flatnonzero(np.abs(self.nodes[:, axis] - value) < 1e-9)
