#include "harness/records/records_impl.h"

#include <math.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/feature.h"

static void get_moments(const subject *s, field_value *out)
{
    schema_set_text(out, scene_convention(&s->point->scene, fields_keys_quantity(s)));
}

static double error_of(const subject *s, double value, const truth *against)
{
    return against != NULL ? verdict_error(fields_keys_quantity(s), value, against->value) : NAN;
}

static void get_error(const subject *s, field_value *out)
{
    schema_set_number(out, error_of(s, ((const quantity_result *)s->record)->value, s->truth));
}

static void get_model_error(const subject *s, field_value *out)
{
    schema_set_number(out,
                      error_of(s, ((const quantity_result *)s->record)->value, s->model_truth));
}

static void get_not_modelled(const subject *s, field_value *out)
{
    schema_set_text(out, s->series->without.other ? s->series->without.words : "");
}

static double predicted(const subject *s)
{
    return fields_keys_quantity(s)->prediction.source != NULL
               ? fields_keys_quantity(s)->prediction.value
               : NAN;
}

static void get_prediction(const subject *s, field_value *out)
{
    schema_set_number(out, predicted(s));
}

static void get_prediction_error(const subject *s, field_value *out)
{
    schema_set_number(out, isfinite(predicted(s)) ? error_of(s, predicted(s), s->truth) : NAN);
}

#define VALUE(member) AT(quantity_result, member)
static const schema_field fields_of_quantity[] = {
    {"moments", "", FIELD_TEXT, "convention for moments while their node rotates",
     .get = get_moments},
    {"status", "", FIELD_ENUM, "ok if there is a value; otherwise the kind of failure",
     VALUE(status), .word = fields_keys_word_of_status, .words = STATUSES},
    {"reason", "", FIELD_TEXT, "reason for a missing value", VALUE(reason)},
    {"value", OWN_UNIT, FIELD_DOUBLE, "the value", VALUE(value)},
    {"meaning", "", FIELD_TEXT,
     "envelope: governing combination; frequency: damped or not; critical load of loads without a "
     "potential: kind of instability; curve of a continued motion: its start",
     VALUE(meaning)},
    {"not_modelled", "", FIELD_TEXT,
     "physics that the formulation omits and that affects the value", .get = get_not_modelled},
    {"truth", OWN_UNIT, FIELD_DOUBLE, "reference value for the same continuum model",
     OF(TRUTH, truth, value)},
    {"error", "1", FIELD_DOUBLE,
     "(value - reference value)/|reference value|; near_zero is the divisor if it is larger",
     .get = get_error},
    {"model_error", "1", FIELD_DOUBLE,
     "relative difference from the reference value for another model", .get = get_model_error},
    {"x", "x_unit", FIELD_DOUBLE, "abscissa of a maximum or minimum", VALUE(x)},
    {"x_name", "", FIELD_TEXT, "name of the abscissa of a curve",
     OF(QUANTITY, scene_quantity, x.name)},
    {"x_unit", "", FIELD_TEXT, "unit of the abscissa", OF(QUANTITY, scene_quantity, x.unit)},
    {"rounding", "1", FIELD_DOUBLE,
     "estimated relative error due to round-off, due to interpolation between steps of a motion, "
     "or due to omitted modes (bound); for a curve, relative to the largest value; 0: no estimate",
     VALUE(rounding)},
    {"change", "1", FIELD_DOUBLE,
     "if solve chose the mesh: relative change from the previous mesh; for a curve, relative to "
     "the largest value",
     VALUE(change)},
    {"near_zero", OWN_UNIT, FIELD_DOUBLE,
     "errors are relative to this value if the reference value is smaller",
     OF(QUANTITY, scene_quantity, near_zero)},
    {"prediction", OWN_UNIT, FIELD_DOUBLE, "value of an analytic estimate, which has no verdict",
     .get = get_prediction},
    {"prediction_error", "1", FIELD_DOUBLE, "relative error of the analytic estimate",
     .get = get_prediction_error},
    {"predicted_by", "", FIELD_TEXT, "source of the analytic estimate",
     TEXT_OF(QUANTITY, scene_quantity, prediction.source)},
    {0}};
const record_type record_quantity = {
    "quantity",
    "quantities",
    "a requested value of a formulation on one mesh",
    {keys_of_point, keys_of_series, key_of_mesh, names_of_quantity, fields_of_quantity}};

static const schema_field fields_of_truth[] = {
    {"truth", OWN_UNIT, FIELD_DOUBLE, "reference value", OF(TRUTH, truth, value)},
    {"truth_uncertainty", OWN_UNIT, FIELD_DOUBLE, "uncertainty of the reference value",
     OF(TRUTH, truth, uncertainty)},
    {"truth_kind", "", FIELD_TEXT, "exact, independent, ...", TEXT_OF(TRUTH, truth, kind)},
    {"model", "", FIELD_TEXT, "same: continuum of the case; other: a different model",
     TEXT_OF(TRUTH, truth, model)},
    {"source", "", FIELD_TEXT, "source of the reference value", TEXT_OF(TRUTH, truth, source)},
    {"error", "1", FIELD_DOUBLE, "relative error of the value", .get = get_error},
    {0}};
const record_type record_truth = {
    "truth", "truths", "reference value of a quantity", {fields_of_truth}};

static const schema_field fields_of_curve[] = {
    {"x_name", "", FIELD_TEXT, "name of the abscissa", OF(QUANTITY, scene_quantity, x.name)},
    {"x_unit", "", FIELD_TEXT, "unit of the abscissa", OF(QUANTITY, scene_quantity, x.unit)},
    {"first", "1", FIELD_INT,
     "index of the first point of the curve in the arrays curve_x and curve_value",
     OF(SUBJECT, subject, group)},
    {"points", "1", FIELD_INT, "number of points", VALUE(curve.points)},
    {0}};
const record_type record_curve = {
    "curve",
    "curves",
    "a curve of a quantity; its points are in the arrays curve_x and curve_value",
    {keys_of_point, keys_of_series, key_of_mesh, names_of_quantity, fields_of_curve}};

static void get_analysis(const subject *s, int analysis, field_value *out)
{
    schema_set_text(out, scene_own_name(&s->point->scene, SCENE_ANALYSES, analysis));
}

static void get_analysis_of_step(const subject *s, field_value *out)
{
    get_analysis(s, ((const step_record *)s->record)->analysis, out);
}

#define STEP(member) AT(step_record, member)
static void get_stability(const subject *s, field_value *out)
{
    const step_record *step = s->record;
    if (step->stability == STEP_UNSTABLE)
        snprintf(out->room, sizeof out->room, "unstable (%d)",
                 step->by_eigenvalues ? step->passed : step->negative_pivots);
    else
        snprintf(out->room, sizeof out->room, "%s", result_stability_name(step->stability));
    out->text = out->room;
}

static const schema_field fields_of_step[] = {
    {"step", "1", FIELD_INT, "number of the step, from 0", OF(SUBJECT, subject, index)},
    {"path", "1", FIELD_DOUBLE, "path parameter at the end of the step", STEP(path)},
    {"increment", "1", FIELD_DOUBLE, "increment of the path parameter", STEP(increment)},
    {"iterations", "1", FIELD_INT, "iterations to convergence", STEP(iterations)},
    {"rejected", "1", FIELD_INT, "number of longer steps rejected before this step",
     STEP(rejected)},
    {"analysis", "1", FIELD_INT, "index of the analysis in the scene", STEP(analysis)},
    {"analysis_name", "", FIELD_TEXT, "name of the analysis in the scene",
     .get = get_analysis_of_step},
    {"negative_pivots", "1", FIELD_INT,
     "number of negative pivots of the tangent; -1 if the tangent is not symmetric",
     STEP(negative_pivots)},
    {"stability", "", FIELD_TEXT,
     "stability of the last state. Symmetric tangent: stable or unstable, by the negative pivots; "
     "unsymmetric tangent: unstable, by the eigenvalues that have passed zero, no divergence "
     "(without mass) or undecided; rotating axes: stable, unstable: grows, stable without damping "
     "or undecided",
     .get = get_stability},
    {"residual", "1", FIELD_DOUBLE,
     "residual before the last iteration of the step, relative to the residual before the first "
     "iteration",
     STEP(residual)},
    {"correction", "1", FIELD_DOUBLE,
     "largest correction in the last iteration of the step: translations relative to the size of "
     "the scene, rotations in rad",
     STEP(correction)},
    {"remaining", "1", FIELD_DOUBLE, "predicted largest correction in a further iteration",
     STEP(remaining)},
    {"incompatibility", "1", FIELD_DOUBLE,
     "largest |D(x) - e|/l before the last iteration: strains D(x) of the nodes, element strains "
     "e, length l",
     STEP(incompatibility)},
    {"energy", "J", FIELD_DOUBLE,
     "r . K^-1 r in the first iteration, with the residual r and the tangent K", STEP(energy)},
    {0}};
const record_type record_step = {"step",
                                 "steps",
                                 "an accepted load step",
                                 {keys_of_point, keys_of_series, key_of_mesh, fields_of_step}};

#define ITERATION(member) AT(iteration_record, member)
static const schema_field fields_of_iteration[] = {
    {"step", "1", FIELD_INT, "step of the iteration", OF(SUBJECT, subject, group)},
    {"iteration", "1", FIELD_INT, "number of the iteration in the step, from 0",
     OF(SUBJECT, subject, index)},
    {"residual", "1", FIELD_DOUBLE,
     "sqrt(r . K^-1 r) before the iteration, relative to the value before the first iteration",
     ITERATION(residual)},
    {"correction", "1", FIELD_DOUBLE,
     "largest correction in the iteration: translations relative to the size of the scene, "
     "rotations in rad",
     ITERATION(correction)},
    {"incompatibility", "1", FIELD_DOUBLE,
     "largest |D(x) - e|/l before the iteration: strains D(x) of the nodes, element strains e, "
     "length l",
     ITERATION(incompatibility)},
    {0}};
const record_type record_iteration = {
    "iteration",
    "iterations",
    "an iteration of a load step",
    {keys_of_point, keys_of_series, key_of_mesh, fields_of_iteration}};

static const char *word_of_event(int kind)
{
    return result_event_name((event_kind)kind);
}

#define EVENT(member) AT(path_event, member)
static void get_analysis_of_event(const subject *s, field_value *out)
{
    get_analysis(s, ((const path_event *)s->record)->analysis, out);
}

static void get_analysis_of_motion(const subject *s, field_value *out)
{
    get_analysis(s, ((const motion_record *)s->record)->analysis, out);
}

static void get_node(const subject *s, field_value *out)
{
    const int node = ((const nodal_matrices *)s->record)->node;
    schema_set_text(out, scene_own_name(&s->point->scene, SCENE_NODES, node));
}

static const schema_field fields_of_event[] = {
    {"event", "", FIELD_ENUM, "kind of event", EVENT(kind), .word = word_of_event,
     .words = EVENT_KINDS},
    {"analysis", "1", FIELD_INT, "index of the analysis in the scene", EVENT(analysis)},
    {"analysis_name", "", FIELD_TEXT, "name of the analysis in the scene",
     .get = get_analysis_of_event},
    {"negative_before", "1", FIELD_INT,
     "number of negative pivots before the event; -1 if the tangent is not symmetric",
     EVENT(negative_before)},
    {"negative_after", "1", FIELD_INT,
     "number of negative pivots after the event; -1 if the tangent is not symmetric",
     EVENT(negative_after)},
    {"factor", "1", FIELD_DOUBLE, "load factor", EVENT(factor)},
    {"control", "m", FIELD_DOUBLE, "value of the controlling coordinate", EVENT(control)},
    {"other_factor", "1", FIELD_DOUBLE, "for a jump: load factor on the other branch",
     EVENT(other_factor)},
    {"measure", "1", FIELD_DOUBLE,
     "work of the loads on the null vector; for a jump: distance between the branches",
     EVENT(measure)},
    {0}};
const record_type record_event = {"event",
                                  "events",
                                  "an event of a continuation",
                                  {keys_of_point, keys_of_series, key_of_mesh, fields_of_event}};

#define MOTION(member) AT(motion_record, at.member)
#define BALANCE(of)    AT(motion_record, at.balance[of])
static const schema_field fields_of_motion[] = {
    {"analysis", "1", FIELD_INT, "index of the analysis in the scene", AT(motion_record, analysis)},
    {"analysis_name", "", FIELD_TEXT, "name of the analysis in the scene",
     .get = get_analysis_of_motion},
    {"time", "s", FIELD_DOUBLE,
     "time at the end of the step; in the first record, start of the motion", MOTION(time)},
    {"step", "s", FIELD_DOUBLE, "length of the step; 0 in the first record", MOTION(step)},
    {"iterations", "1", FIELD_INT, "number of Newton iterations", MOTION(iterations)},
    {"rejected", "1", FIELD_INT, "number of longer steps rejected before this step",
     MOTION(rejected)},
    {"error", "1", FIELD_DOUBLE,
     "estimated error of positions in the step, relative to the size of the structure; 0: no "
     "estimate",
     MOTION(error)},
    {"kinetic", "J", FIELD_DOUBLE, "kinetic energy", BALANCE(SCENE_KINETIC)},
    {"strain", "J", FIELD_DOUBLE, "energy stored in members and springs", BALANCE(SCENE_STRAIN)},
    {"work", "J", FIELD_DOUBLE, "work of loads and of prescribed coordinates since the start",
     BALANCE(SCENE_WORK)},
    {"dissipated", "J", FIELD_DOUBLE, "energy dissipated by damping since the start",
     BALANCE(SCENE_DISSIPATED)},
    {"drift", "J", FIELD_DOUBLE,
     "energy-balance error: energy plus dissipated energy, minus initial energy and work",
     BALANCE(SCENE_DRIFT)},
    {"px", "kg m/s", FIELD_DOUBLE, "momentum along x", BALANCE(SCENE_PX)},
    {"py", "kg m/s", FIELD_DOUBLE, "momentum along y", BALANCE(SCENE_PY)},
    {"pz", "kg m/s", FIELD_DOUBLE, "momentum along z", BALANCE(SCENE_PZ)},
    {"lx", "kg m^2/s", FIELD_DOUBLE, "angular momentum about the x axis through the origin",
     BALANCE(SCENE_LX)},
    {"ly", "kg m^2/s", FIELD_DOUBLE, "angular momentum about the y axis through the origin",
     BALANCE(SCENE_LY)},
    {"lz", "kg m^2/s", FIELD_DOUBLE, "angular momentum about the z axis through the origin",
     BALANCE(SCENE_LZ)},
    {0}};
const record_type record_motion = {
    "motion",
    "motion",
    "energies and momenta at the start of a motion and after each step",
    {keys_of_point, keys_of_series, key_of_mesh, fields_of_motion}};

static void get_path(const subject *s, field_value *out)
{
    out->numbers = ((const nodal_matrices *)s->record)->path + s->index;
}

static void get_compliance(const subject *s, field_value *out)
{
    out->numbers = ((const nodal_matrices *)s->record)->compliance + 36 * (size_t)s->index;
}

static void get_stiffness(const subject *s, field_value *out)
{
    out->numbers = ((const nodal_matrices *)s->record)->stiffness + 36 * (size_t)s->index;
}

static const schema_field fields_of_matrix[] = {
    {"node", "1", FIELD_INT, "index of the node in the scene", AT(nodal_matrices, node)},
    {"node_name", "", FIELD_TEXT, "name of the node in the scene", .get = get_node},
    {"moments", "", FIELD_ENUM, "convention for moments while their node rotates",
     AT(nodal_matrices, moments), .word = fields_keys_word_of_moments,
     .words = SCENE_MOMENTS_SYMMETRISED + 1},
    {"path", "1", FIELD_DOUBLE, "path parameter of the state", .get = get_path},
    {"compliance", "SI", FIELD_DOUBLE,
     "compliance: ux uy uz thx thy thz for unit Fx Fy Fz Mx My Mz", .get = get_compliance,
     .count = 36},
    {"stiffness", "SI", FIELD_DOUBLE, "stiffness, the inverse of the compliance",
     .get = get_stiffness, .count = 36},
    {0}};
const record_type record_matrix = {"matrix",
                                   "matrices",
                                   "compliance and stiffness at a node, at a station of a path",
                                   {keys_of_point, keys_of_series, key_of_mesh, fields_of_matrix}};

static const element_type *type_of(const subject *s)
{
    return s->series->formulation.type;
}

static void get_offers(const subject *s, field_value *out)
{
    const unsigned theories = FEATURE_ENGESSER | FEATURE_HARINGX;
    feature_words(type_of(s)->offers & ~theories, out->room, sizeof out->room);
    out->text = out->room;
}

static void get_limits(const subject *s, field_value *out)
{
    static const struct {
        unsigned bit;
        const char *words;
    } limit[] = {
        {LIMIT_DOUBLY_SYMMETRIC,
         "the shear centre must be at the centroid, and shear must not be coupled"},
        {LIMIT_ORDER_DEPENDENT, "exchanging the ends of an element changes the result by an error "
                                "that vanishes with more elements"},
        {LIMIT_QUARTER_TURN,
         "the relative rotation of the ends of an element must stay below a quarter turn"},
        {LIMIT_HALF_TURN,
         "the relative rotation of the ends of an element must stay below half a turn"},
        {LIMIT_TENSION, "an element must not be so long that its axial force makes its transverse "
                        "stiffness indefinite"},
        {LIMIT_EIGHTH_TWIST, "the twist of an element must stay below an eighth of a turn"},
        {LIMIT_NOT_OBJECTIVE,
         "rigid rotations of a deformed element change its strains, by an error "
         "that may remain on fine meshes"},
        {LIMIT_PATH_DEPENDENT, "the strains depend on the path that led to a state, with an error "
                               "that may remain on fine meshes"},
        {LIMIT_WARPING_RIGID, "shear deformation due to warping is omitted"},
        {LIMIT_FLAT_ARC,
         "the arc of a curved element must rise by less than 2 radii of gyration of "
         "its section (of a leaf: 0.58 thicknesses)"},
    };
    size_t used = 0;
    out->room[0] = '\0';
    for (size_t i = 0; i < sizeof limit / sizeof limit[0]; i++)
        if (type_of(s)->limits & limit[i].bit)
            used += (size_t)snprintf(out->room + used, sizeof out->room - used, "%s%s",
                                     used > 0 ? "; " : "", limit[i].words);
    out->text = out->room;
}

static void get_lacks(const subject *s, field_value *out)
{
    out->room[0] = '\0';
    if (type_of(s)->lacks & LACKS_SHEAR_Y)
        snprintf(out->room, sizeof out->room, "shear flexibility along y (%s)",
                 type_of(s)->lacks_by);
    out->text = out->room;
}

static void get_theory(const subject *s, field_value *out)
{
    const unsigned theories = type_of(s)->shear_theories;
    const char *words = "none: rigid in shear";
    if (theories == (SHEAR_ENGESSER | SHEAR_HARINGX))
        words = "engesser or haringx";
    else if (theories == SHEAR_ENGESSER)
        words = "engesser";
    else if (theories == SHEAR_HARINGX)
        words = "haringx";
    else if (theories != 0)
        words = type_of(s)->own_theory;
    schema_set_text(out, words);
}

/* Gives an order of convergence of analysis offset/2. Even offset: lowest order; odd: highest
 * order. */
static void get_order(const subject *s, field_value *out)
{
    const size_t i = out->of->offset;
    const element_order order =
        element_order_in(type_of(s), (element_analysis)(i / 2), s->series->formulation.option);
    out->whole = i % 2 == 0 ? order.least : order.highest;
}

/* Gives the order for motions. Offset 0: lowest order; 1: highest order. */
static void get_motion(const subject *s, field_value *out)
{
    const element_order order = element_order_of_motion();
    (void)s;
    out->whole = out->of->offset == 0 ? order.least : order.highest;
}

static void get_nodes(const subject *s, field_value *out)
{
    out->whole = element_nodes(type_of(s), s->series->formulation.option);
}

static void get_strains(const subject *s, field_value *out)
{
    out->whole = element_strains(type_of(s), s->series->formulation.option);
}

static void get_inner(const subject *s, field_value *out)
{
    out->whole = element_inner(type_of(s), s->series->formulation.option);
}

static void get_options(const subject *s, field_value *out)
{
    const assignment_list list = formulation_options(type_of(s));
    const parameter_type *p;
    size_t used = 0;
    out->room[0] = '\0';
    for (int i = 0; (p = parameter_at(list.part, i)) != NULL && used < sizeof out->room; i++) {
        char value[ASSIGNMENT_VALUE], range[2 * ASSIGNMENT_VALUE];
        assignment_value_text(p, p->value, value, sizeof value);
        snprintf(range, sizeof range, "%g..%g", p->min, p->max);
        used += (size_t)snprintf(out->room + used, sizeof out->room - used, "%s%s\t%s\t%s\t%s",
                                 i > 0 ? "\n" : "", p->name,
                                 p->choices != NULL ? p->choices : range, value, p->summary);
    }
    out->text = out->room;
}

static void get_differences(const subject *s, field_value *out)
{
    schema_set_text(out, adapters_words(type_of(s)));
}

static void get_process(const subject *s, field_value *out)
{
    out->whole = process_serves(type_of(s));
}

static void get_is_new(const subject *s, field_value *out)
{
    out->whole = s->sweep != NULL ? s->series->imported == NULL && !sweep_gates(s->sweep, s->series)
                                  : formulations_is_new(type_of(s));
}

static const schema_field fields[] = {
    {"formulation", "", FIELD_TEXT,
     "name of the formulation, with options that differ from their defaults",
     OF(SERIES, series, formulation.key), .key = KEY},
    {"type", "", FIELD_TEXT, "name without options", TEXT_OF(FORMULATION, element_type, name)},
    {"summary", "", FIELD_TEXT, "description", TEXT_OF(FORMULATION, element_type, summary)},
    {"source", "", FIELD_TEXT, "publication", TEXT_OF(FORMULATION, element_type, source)},
    {"family", "", FIELD_TEXT, "family; formulations of one family share code or theory",
     TEXT_OF(FORMULATION, element_type, family)},
    {"offers", "", FIELD_TEXT, "supported physics, separated by commas", .get = get_offers},
    {"limits", "", FIELD_TEXT, "restrictions", .get = get_limits},
    {"lacks", "", FIELD_TEXT, "features supported in only one direction", .get = get_lacks},
    {"differences", "", FIELD_TEXT,
     "functions computed by finite differences; if there are any, the times are not ranked",
     .get = get_differences},
    {"misprint", "", FIELD_TEXT,
     "misprint that is implemented as printed; if there is one, the formulation is not ranked",
     TEXT_OF(FORMULATION, element_type, misprint)},
    {"process", "", FIELD_FLAG,
     "1 if the formulation is computed in another process; its times are then not ranked",
     .get = get_process},
    {"is_new", "", FIELD_FLAG,
     "1 if the formulation is not accepted yet; its verdicts then affect the exit status only if "
     "-f names it or --element loads it",
     .get = get_is_new},
    {"shear_theory", "", FIELD_TEXT, "shear theory in stability", .get = get_theory},
    {"statics_least", "1", FIELD_INT, "order of convergence in statics", .get = get_order},
    {"statics_highest", "1", FIELD_INT,
     "highest order of convergence, if leading error terms vanish", .offset = 1, .get = get_order},
    {"vibration_least", "1", FIELD_INT, "order in vibration", .offset = 2, .get = get_order},
    {"vibration_highest", "1", FIELD_INT,
     "highest order of convergence, if leading error terms vanish", .offset = 3, .get = get_order},
    {"motion_least", "1", FIELD_INT, "order of convergence in transient analyses",
     .get = get_motion},
    {"motion_highest", "1", FIELD_INT,
     "highest order of convergence, if leading error terms vanish", .offset = 1, .get = get_motion},
    {"buckling_least", "1", FIELD_INT, "order of convergence in linear buckling", .offset = 4,
     .get = get_order},
    {"buckling_highest", "1", FIELD_INT,
     "highest order of convergence, if leading error terms vanish", .offset = 5, .get = get_order},
    {"nodes", "1", FIELD_INT, "number of nodes of an element", .get = get_nodes},
    {"strains", "1", FIELD_INT, "number of generalized strains of an element", .get = get_strains},
    {"inner", "1", FIELD_INT, "number of internal unknowns of an element", .get = get_inner},
    {"options", "", FIELD_TEXT,
     "one line per option: name, choices, default and summary, separated by tabs",
     .get = get_options},
    {0}};

const record_type record_declaration = {
    "declaration", "declarations", "declarations of a formulation", {fields}};
