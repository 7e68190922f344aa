"""Names of the entries of the compliance matrix of a tip: displacements (ux .. thz) due to loads (Fx .. Mz)."""
MOTIONS, LOADS = ("ux", "uy", "uz", "thx", "thy", "thz"), ("Fx", "Fy", "Fz", "Mx", "My", "Mz")


def name_of(i, j):
    return f"C_{MOTIONS[i]}_{LOADS[j]}"


def entry_of(name):
    """Returns (row, column) of the entry named C_MOTION_LOAD, C_xx or C_zz."""
    if name in ("C_xx", "C_zz"):
        return (i := "xyz".index(name[-1])), i
    motion, load = name.split("_")[1:]
    return MOTIONS.index(motion), LOADS.index(load)


def unit_of(i, j):
    return ("m/N" if j < 3 else "1/N") if i < 3 else ("rad/N" if j < 3 else "rad/(N m)")
