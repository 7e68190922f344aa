/* Keys of a load, in the format of keys_member.h. The first six keys select the kind of the load
 * (entry_of_load). */
ROW("force", ENTRY_VECTOR, .needed = 1, .group = 1, .count = 3, .unit = "N",
    .summary = "force at a node, or at the position 'where' of a member")
ROW("moment", ENTRY_VECTOR, .needed = 1, .group = 1, .count = 3, .unit = "N m",
    .summary = "moment at a node, or at the position 'where' of a member")
ROW("distributed", ENTRY_VECTOR, .needed = 1, .group = 1, .count = 3, .unit = "N/m",
    .summary = "force per length of a member")
ROW("distributed_moment", ENTRY_VECTOR, .needed = 1, .group = 1, .count = 3, .unit = "N",
    .summary = "moment per length of a member")
ROW("gravity", ENTRY_VECTOR, .needed = 1, .group = 1, .count = 3, .unit = "m/s^2",
    .summary = "acceleration that acts on a member whose section has a density, on a node with a "
               "mass, or on all of these")
/* of a SCENE_TEMPERATURE load, whose vector is zero */
KEY(double, temperature, , "temperature", ENTRY_NUMBER, .needed = 1, .group = 1, .unit = "K",
    .summary = "temperature change of a member at the centroids of its sections")
/* of a SCENE_FORCE load with a zero vector: force that pulls the nodes `where` and `towards`
 * together */
KEY(double, tension, , "tension", ENTRY_NUMBER, .needed = 1, .group = 1, .unit = "N",
    .summary =
        "force that pulls the nodes 'on' and 'towards' together, along the line between them")
KEY(int, towards, , "towards", ENTRY_NAME, .summary = "second node of a tension",
    .left_out = "none; required with tension", .of = SCENE_NODES)
/* elongation over the whole range, instead of a temperature */
KEY(double, elongation, , "elongation", ENTRY_NUMBER, .needed = 1, .group = 1, .unit = "m",
    .summary = "stress-free elongation of a member, such as that of an actuator or a turnbuckle")
KEY(double, gradient, [2], "gradient", ENTRY_VECTOR, .count = 2, .unit = "K/m",
    .summary = "gradient of the temperature change along y and z of the section", .usual = "[0, 0]",
    .mirrors = "-+")
ROW("on", ENTRY_NAME, .needed = 1,
    .summary = "node or member on which the load acts; for gravity also 'all'")
ROW("where", ENTRY_NUMBER,
    .summary = "position of a force or moment within a member, from 0 at the start to 1 at the end "
               "of the member",
    .left_out = "at a node")
ROW("from", ENTRY_NUMBER,
    .summary = "start of a distributed load or temperature, as a fraction of the length",
    .usual = "0")
ROW("to", ENTRY_NUMBER,
    .summary = "end of a distributed load or temperature, as a fraction of the length",
    .usual = "1")
ROW("to_value", ENTRY_VECTOR, .count = 3,
    .summary = "distributed load at 'to', varying linearly from its value at 'from'",
    .left_out = "constant")
/* 0 if the load does work on the displacement field inside the elements */
KEY(int, lumped, , "lumped", ENTRY_FLAG, .words = "no|yes|false|true",
    .summary = "distributed load or gravity: applies half of the load of an element at each of its "
               "nodes; second-order accurate",
    .usual = "no")
/* offset in `axes`, which rotates with the node or the sections */
KEY(double, at, [3], "at", ENTRY_VECTOR, .count = 3, .unit = "m",
    .summary = "offset of a force from the node or the centroids", .usual = "[0, 0, 0]")
KEY(scene_load_axes, axes, , "axes", ENTRY_WORD, .words = "fixed|member",
    .summary = "axes of the load vector and of 'at': fixed, or those of the undeformed member",
    .usual = "fixed")
/* 0 for a constant direction (dead load) */
KEY(int, follower, , "follower", ENTRY_FLAG, .words = "false|true|no|yes",
    .summary = "true: the direction of the load rotates with the node or the sections",
    .usual = "false")
ROW("path", ENTRY_NUMBERS, .summary = "path parameter, ascending",
    .left_out = "none; required with factor")
ROW("factor", ENTRY_NUMBERS, .summary = "factors at these values of the path parameter",
    .left_out = "the path parameter itself")
ROW("time", ENTRY_TEXT, .group = 2,
    .summary = "factor as a function of time: expression of the time t [s]",
    .left_out = "factor at the end of the path that the motion follows, or 1")
ROW("pieces", ENTRY_LIST, .group = 2, .below = piece,
    .summary = "factor as a function of time, given by successive expressions; the factor may jump "
               "between expressions",
    .left_out = "as for time")
ROW("table", ENTRY_MAP, .group = 2, .below = table,
    .summary = "factor as a function of time, given by a table with linear interpolation",
    .left_out = "as for time")
ROW("feedback", ENTRY_MAP, .below = feedback,
    .summary = "in motions, the factor follows from a measured component; time, pieces or table "
               "then give the reference value of that component [m, rad]",
    .left_out = "none")
/* SCENE_NONE if the scene has no load cases */
KEY(int, load_case, , "case", ENTRY_NAME,
    .summary = "name of the load case to which the load belongs; give a case for all loads or for "
               "none",
    .left_out = "none", .of = SCENE_CASES)
#undef KEY
#undef ROW
