/* Keys of a member of the structure. KEY(type, name, dimensions, row) defines a member of the
 * struct scene_member (scene.h) and a row of entry_member (entries_structure.c). ROW defines keys
 * that special functions read and write. */
KEY(int, p, , "from", ENTRY_NAME, .needed = 1, .summary = "start node", .of = SCENE_NODES)
KEY(int, q, , "to", ENTRY_NAME, .needed = 1, .summary = "end node", .of = SCENE_NODES)
ROW("section", ENTRY_FORMS, .needed = 1,
    .summary =
        "NAME, or [at from, at to]: the dimensions vary linearly, and each element is prismatic")
/* only its component normal to the member is used */
KEY(double, y_axis, [3], "y", ENTRY_DIRECTION, .needed = 1, .count = 3,
    .summary = "direction of the section's y axis", .mirrors = "---")
ROW("warping", ENTRY_FORMS,
    .summary =
        "warping at the ends: free, fixed or {shared: NAME}; [at from, at to] if they differ",
    .left_out =
        "fixed if all six components of the node are fixed or driven, if the node belongs to a "
        "rigid body, or if a member has an offset at the node; shared if two members with the same "
        "section continue in one line; free otherwise, and if a rotation is released")
/* twist, and curvatures about local y and z; interior nodes are on the arc */
KEY(double, curvature, [3], "curvature", ENTRY_VECTOR, .count = 3, .unit = "1/m",
    .summary = "initial twist and curvatures", .usual = "[0, 0, 0]", .mirrors = "++-")
/* stress-free strains, for example due to temperature or misfit */
KEY(double, strain, [3], "strain", ENTRY_VECTOR, .group = 1, .count = 3, .unit = "1",
    .summary = "elongation and shears of the unstressed member", .usual = "[0, 0, 0]")
KEY(double, pretension, , "pretension", ENTRY_NUMBER, .group = 1, .unit = "N",
    .summary =
        "axial force while the nodes are at their given positions, before equilibrium is computed",
    .left_out = "none")
/* 0 for the distance between the ends */
KEY(double, unstressed_length, , "unstressed_length", ENTRY_NUMBER, .group = 1, .unit = "m",
    .summary = "length of the member before it is mounted between its nodes",
    .left_out = "length between the given positions of its ends", .most = INFINITY)
KEY(double, free_curvature, [2], "free_curvature", ENTRY_VECTOR, .count = 2, .unit = "1/m",
    .summary = "curvatures about y and z of the unstressed member, in addition to 'curvature'",
    .usual = "[0, 0]", .mirrors = "+-")
ROW("offset", ENTRY_MAP, .below = offset,
    .summary = "positions of the member's ends relative to the nodes, with rigid connections",
    .left_out = "at the nodes")
ROW("imperfection", ENTRY_MAP, .below = imperfection,
    .summary = "stress-free initial deviation from the line of the member", .left_out = "none")
ROW("foundation", ENTRY_MAP, .below = foundation,
    .summary = "springs to the ground along the member, with directions fixed in space",
    .left_out = "none")
ROW("release", ENTRY_MAP, .below = release, .summary = "end releases: hinges, slides",
    .left_out = "none")
KEY(double, damping, , "damping", ENTRY_NUMBER, .unit = "s",
    .summary = "stiffness-proportional damping: the value times the undeformed stiffness times the "
               "strain rates is added to the stresses",
    .usual = "0", .most = INFINITY)
/* 0 for the number set by the mesh */
KEY(int, divisions, , "divisions", ENTRY_WHOLE,
    .summary = "number of elements, independent of the mesh; it applies to each piece if loads "
               "start, end or act within the member",
    .left_out = "as given by the mesh", .most = 10000000)
#undef KEY
#undef ROW
