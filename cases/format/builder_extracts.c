/* What the quantities of a scene are values of. */
#include "cases/format/builder.h"

static int order_of(const fields *f)
{
    return fields_whole(f, "which", 0, 0, BUILDER_MOST_ORDER);
}

static scene_extract displacement(const fields *f)
{
    return scene_coordinate(fields_entry(f, "node", SCENE_NODES),
                            fields_word(f, "component", fields_components, 0));
}

/* Component of a reaction; turn_1: the moment about the first axis of a sequence, which is fixed in
 * space. */
static int reaction_component(const fields *f, int node)
{
    enum { TURN_1 = SCENE_RZ + 1 };
    const int component = fields_word(f, "component", "ux|uy|uz|rx|ry|rz|turn_1", 0);
    if (component != TURN_1 || node < 0 || node >= f->b->scene->nodes)
        return component < TURN_1 ? component : SCENE_RX;
    const scene_node *n = &f->b->scene->node[node];
    if (n->rotation == SCENE_ROTATION_SEQUENCE)
        for (int i = 0; i < 3; i++)
            if (n->axis[0][i] != 0 && n->axis[0][(i + 1) % 3] == 0 &&
                n->axis[0][(i + 2) % 3] == 0 && n->axis[0][i] > 0)
                return SCENE_RX + i;
    document_mistake(f->b->mistakes, document_find(f->map, "component"), 0,
                     "turn_1 is of a node with a sequence whose first axis is x, y or z; take rx, "
                     "ry or rz");
    return SCENE_RX;
}

static scene_extract reaction(const fields *f)
{
    const int node = fields_entry(f, "node", SCENE_NODES);
    return scene_reaction(node, reaction_component(f, node));
}

static scene_extract compliance(const fields *f)
{
    return scene_compliance_entry(fields_word(f, "row", fields_components, 0),
                                  fields_word(f, "column", fields_components, 0));
}

static scene_extract stiffness(const fields *f)
{
    return scene_stiffness_entry(fields_word(f, "component", fields_components, 0));
}

static scene_extract critical_factor(const fields *f)
{
    return scene_critical_factor(fields_word(f, "sign", "positive|negative", 0) == 0 ? 1 : -1,
                                 order_of(f));
}

static scene_extract frequency(const fields *f)
{
    static const char families[] = "any|not_axial|axial|bending_y|bending_z|torsion";
    const int order = order_of(f);
    const scene_family family = (scene_family)fields_word(f, "family", families, 0);
    return scene_frequency_of(order, family,
                              fields_whole(f, "half_waves", 0, 0, BUILDER_MOST_ORDER));
}

static scene_extract growth(const fields *f)
{
    (void)f;
    return scene_growth();
}

static scene_extract factor_at(const fields *f)
{
    (void)f;
    return scene_factor_at();
}

static scene_extract critical_point(const fields *f)
{
    return scene_critical_point((scene_critical)fields_word(f, "kind", "limit|bifurcation", 0),
                                order_of(f),
                                (scene_ordinate)fields_word(f, "value", "factor|coordinate", 0));
}

static scene_extract motion(const fields *f)
{
    return scene_driver_value(fields_entry(f, "motion", SCENE_DRIVERS));
}

/* Of a member's length. */
static double place_of(const fields *f)
{
    const double place = fields_number(f, "where", 0);
    if (place >= 0 && place <= 1)
        return place;
    document_mistake(f->b->mistakes, document_find(f->map, "where"), 0,
                     "where = %g; give a part of the member's length, from 0 to 1", place);
    return 0;
}

/* On which side of what jumps at a place. */
static scene_extract beside(const fields *f, scene_extract what)
{
    if (fields_have(f, "side") && !fields_have(f, "where"))
        document_mistake(f->b->mistakes, document_find(f->map, "side"), 0,
                         "side: of a place of the member, at which a load acts; say which, with "
                         "'where', or take it away");
    return scene_beside(what, fields_word(f, "side", "from|to", 1) == 0);
}

static scene_extract internal(const fields *f)
{
    const int member = fields_entry(f, "member", SCENE_MEMBERS);
    const scene_resultant what =
        (scene_resultant)fields_word(f, "resultant", SCENE_RESULTANT_CHOICES, 0);
    if (fields_have(f, "along"))
        return beside(
            f, scene_internal_along(
                   member,
                   (scene_along)(SCENE_ALONG_MAX + fields_word(f, "along", "max|min|largest", 0)),
                   what));
    return beside(
        f, scene_internal_at(
               member, fields_have(f, "where") ? place_of(f) : fields_word(f, "end", "from|to", 0),
               what));
}

/* Given constants have no points. */
static void check_points(const fields *f, int member)
{
    const scene *s = f->b->scene;
    if (member < 0 || member >= s->members || s->member[member].section < 0 ||
        s->member[member].section >= s->sections ||
        (s->section[s->member[member].section].kind != SECTION_CONSTANTS &&
         s->section[s->member[member].section].kind != SECTION_MATRICES))
        return;
    document_mistake(f->b->mistakes, document_find(f->map, "member"), 0,
                     "its section is given by numbers and has no points; describe it by sizes "
                     "or walls, or ask for 'internal'");
}

static scene_extract stress(const fields *f)
{
    const int member = fields_entry(f, "member", SCENE_MEMBERS);
    const scene_stress_measure what =
        (scene_stress_measure)fields_word(f, "measure", SCENE_STRESS_CHOICES, 0);
    check_points(f, member);
    return beside(f, fields_have(f, "where") ? scene_stress_at(member, place_of(f), what)
                                             : scene_stress_along(member, what));
}

static int axis_word(const fields *f, const char *key)
{
    return fields_word(f, key, "x|y|z", 0);
}

static scene_extract rate(const fields *f)
{
    return scene_rate(fields_entry(f, "node", SCENE_NODES),
                      fields_word(f, "component", fields_components, 0));
}

static scene_extract orientation(const fields *f)
{
    return scene_orientation_entry(fields_entry(f, "node", SCENE_NODES), axis_word(f, "row"),
                                   axis_word(f, "column"));
}

static scene_extract relative(const fields *f)
{
    return scene_relative_to(fields_entry(f, "node", SCENE_NODES),
                             fields_word(f, "component", fields_components, 0),
                             fields_entry(f, "from", SCENE_NODES));
}

static scene_extract energy(const fields *f)
{
    return scene_balance_of(
        (scene_balance)fields_word(f, "of", "kinetic|strain|energy|work|dissipated|drift", 0));
}

static scene_extract momentum(const fields *f)
{
    return scene_balance_of(
        (scene_balance)(SCENE_PX + fields_word(f, "component", "px|py|pz|lx|ly|lz", 0)));
}

static const builder_extract kinds[] = {{"displacement", displacement},
                                        {"reaction", reaction},
                                        {"compliance", compliance},
                                        {"stiffness", stiffness},
                                        {"critical_factor", critical_factor},
                                        {"frequency", frequency},
                                        {"growth", growth},
                                        {"factor_at", factor_at},
                                        {"critical_point", critical_point},
                                        {"motion", motion},
                                        {"internal", internal},
                                        {"stress", stress},
                                        {"rate", rate},
                                        {"orientation", orientation},
                                        {"relative", relative},
                                        {"energy", energy},
                                        {"momentum", momentum}};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

const builder_extract *builder_extract_of(const fields *quantity)
{
    int k = 0;
    while (k < KINDS - 1 && !fields_have(quantity, kinds[k].key))
        k++;
    return &kinds[k];
}
