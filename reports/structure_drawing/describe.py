"""Describes the contents of a drawing: supports, motions, loads, springs and sections."""
import numpy as np

from reports.structure_drawing import geometry, joints, loads
from reports.structure_drawing.canvas import length, number, vector
from reports.structure_drawing.members import ends_that_warp, held_of, spring_words

CONSTANTS = (("A", "m²"), ("Iy", "m⁴"), ("Iz", "m⁴"), ("It", "m⁴"), ("Iw", "m⁶"))
MOST = 12  # largest number of lines of one kind


def place(position):
    return f"({', '.join(map(number, position))})"


def support(scene, node):
    held = held_of(scene, node)
    words = ["all held"] if len(held) == 6 else [f"{', '.join(held)} held"] if held else []
    if node.fork is not None:
        words.append("on a fork support (no rotation about the section's own axis)")
    words += [f"{motion} drives {component}" for component, motion in node.driven.items()
              if component not in held]
    words += [f"rotation about {place(t.axis)} {'free' if t.angle == 'free' else 'by ' + t.angle}"
              for t in node.turns if t.angle != "held"]
    words += [f"rotation vector ({', '.join(node.vector)})"] if node.vector else []
    return f"{node.name} {place(node.position)}: {'; '.join(words)}" if words else ""


def motion(name, reach):
    if not reach:
        return f"{name}: unknown" if reach is None else f"{name}: a function of time"
    return f"{name}: from {number(reach[0])} to {number(reach[1])}"


def load(one):
    kind = one.kind.replace("_", " ")
    said = f"{kind} {loads.size(one)} {axis(one)}on {one.on}"
    said += extent(one.within)
    said += f", offset by {place(one.at)} m" if one.at.any() else ""
    said += ", in the member's axes" if one.member_axes else ""
    said += ", rotates with it" if one.follower else ""
    said += ", lumped at its nodes" if one.lumped else ""
    return said + ("" if one.grows else ", constant")


def extent(within):
    """Describes the range or the position of a load along a member, in percent of its length. Returns an empty string
    for the whole length and for a load at a node."""
    if within in (None, (0, 1)):
        return ""
    begin, end = (f"{number(100 * part)} %" for part in within)
    return f" at {begin} of it" if begin == end else f" from {begin} to {end} of it"


def axis(one):
    """Describes the axis along or about which the load acts. Returns an empty string if the load varies or acts in more
    than one direction."""
    along = np.flatnonzero(np.abs(one.vector) + np.abs(one.last))
    if one.varies():
        return ""
    sign = "-" if len(along) and one.vector[along[0]] < 0 else "+"
    way = "about" if "moment" in one.kind else "along"
    return f"{way} {sign}{'xyz'[along[0]]} " if len(along) == 1 else ""


def spring(one):
    return f"{one.name}, {one.ends[0] or 'ground'} to {one.ends[1]}: {', '.join(spring_words(one))}"


def shape(section):
    if "rectangle" in section:
        r = section["rectangle"]
        return f"rectangle, {length(float(r['width']))} (z) by {length(float(r['thickness']))} (y)"
    if "tube" in section:
        return f"tube, {length(float(section['tube']['diameter']))} outside"
    if "walls" in section:
        return f"{len(section['walls'])} walls"
    if "constants" in section:
        return ", ".join(f"{name} = {number(float(section['constants'][name]))} {unit}"
                         for name, unit in CONSTANTS if name in section["constants"])
    return "stiffness as a 6 x 6 matrix"


def section(name, said):
    material = [f"E = {number(float(said['young']))} Pa"] if "young" in said else []
    if "shear_modulus" in said:
        material.append(f"G = {number(float(said['shear_modulus']))} Pa")
    if float(said.get("density", 0)):
        material.append(f"density {number(float(said['density']))} kg/m³")
    return f"{name}: {'; '.join([shape(said)] + material)}"


def offsets(member):
    return [f"{member.name} at {node}: {place(offset)} m from it"
            for node, offset in zip(member.ends, member.offset) if offset.any()]


def constraint(one):
    return joints.words_of(one) + (f" ({', '.join(one.nodes)})" if one.kind != "ratio" else "")


def mass(node):
    return f"{node.name}: {number(node.mass)} kg, {place(node.centre)} m from it"


def warping(scene):
    at = {}
    for member, end, word in ends_that_warp(scene):
        at.setdefault(member.ends[end], []).append((word, member.name))
    symbol = {"fixed": "held (filled bar)", "shared": "shared", "free": "free (open bar)"}
    out = []
    for word, told in symbol.items():
        places = []
        for node, ends in at.items():
            own = [name for state, name in ends if state == word]
            places += [node] if len(own) == len(ends) else [f"{name} at {node}" for name in own]
        if places:
            few = places[:MOST] + [f"{len(places) - MOST} more"] * (len(places) > MOST)
            out.append(f"{told}: {', '.join(few)}")
    return out


def shortened(lines):
    found = [line for line in lines if line]
    return found[:MOST] + [f"and {len(found) - MOST} more"] if len(found) > MOST else found


def describe(scene):
    """Returns [(heading, lines)], the description of the contents of a scene."""
    spin = scene.spin
    turning = [] if spin is None else [f"{place(spin.omega)} rad/s about {place(spin.centre)}"]
    kinds = (("Supports", [support(scene, n) for n in scene.nodes.values()]),
             ("Warping at ends of members", warping(scene)),
             ("Motions", [motion(*m) for m in scene.motions.items()]),
             ("Axes turn with", turning),
             ("Loads", [load(one) for one in scene.loads]),
             ("Springs", [spring(one) for one in scene.springs]),
             ("Offset ends", [line for m in scene.members.values() for line in offsets(m)]),
             ("Constraints", [constraint(one) for one in scene.constraints]),
             ("Masses", [mass(n) for n in scene.nodes.values() if n.mass]),
             ("Sections", [section(*s) for s in scene.sections.items()]))
    return [(heading, shortened(lines)) for heading, lines in kinds if any(lines)]


def counts(scene):
    bodies = {n.part_of for n in scene.nodes.values() if n.part_of}
    several = ((len(scene.members), "member"), (len(bodies), "rigid body"))
    words = [f"{n} {what if n == 1 else {'rigid body': 'rigid bodies'}.get(what, what + 's')}"
             for n, what in several if n]
    curved = any(m.curvature.any() for m in scene.members.values())
    solid = any(geometry.outline(s) for s in scene.sections.values())
    return ", ".join(words) + (", curved" if curved else "") + \
        ("" if solid else "; the section is known by its constants only")
