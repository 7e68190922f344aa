#include "cases/format/format_impl.h"

#include <math.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/section/section.h"

static int builder_has_function(const fields *f);

static int share(const fields *f, const document_node *name)
{
    builder *b = f->b;
    if (name->kind != DOCUMENT_TEXT) {
        document_mistake(b->mistakes, name, 0, "shared: a name is expected");
        return SCENE_WARP_FREE;
    }
    char full[200];
    const int length = snprintf(full, sizeof full, "%.90s.%.90s",
                                f->placed != NULL ? f->placed->name : "", name->text);
    for (int i = 0; i < b->shares; i++)
        if (strcmp(b->shared[i], full) == 0)
            return i;
    b->shared = arena_grow(b->arena, b->shared, b->shares, sizeof *b->shared);
    const char *kept = arena_copy(b->arena, full, (size_t)length);
    if (b->shared == NULL || kept == NULL) {
        b->shares = 0;
        return SCENE_WARP_FREE;
    }
    b->shared[b->shares] = kept;
    return b->shares++;
}

static int warping_of(const fields *f, const document_node *n)
{
    const document_node *shared = document_find(n, "shared");
    if (shared != NULL && n->count == 1)
        return share(f, shared);
    return fields_word_of(f, n, "warping", "free|fixed", 0) == 0 ? SCENE_WARP_FREE
                                                                 : SCENE_WARP_FIXED;
}

static void read_warping(const fields *f, scene_member *m)
{
    const document_node *n = document_find(f->map, "warping");
    if (n == NULL) {
        m->warp_p = m->warp_q = f->b->default_warping;
        return;
    }
    if (n->kind == DOCUMENT_LIST && n->count != 2) {
        document_mistake(f->b->mistakes, n, 0,
                         "warping: the list must have two values; give one value, or [at from, "
                         "at to]");
        return;
    }
    m->warp_p = warping_of(f, n->kind == DOCUMENT_LIST ? n->item[0] : n);
    m->warp_q = warping_of(f, n->kind == DOCUMENT_LIST ? n->item[1] : n);
}

static void check_taper(const fields *f, const document_node *n, const int profile[2])
{
    const scene *s = f->b->scene;
    section c[2];
    const section *const ends[2] = {&c[0], &c[1]};
    fault why = {""};
    for (int k = 0; k < 2; k++)
        if (profile[k] < 0 || profile[k] >= s->sections ||
            scene_constants(s, profile[k], &c[k], NULL) != STATUS_OK)
            return;
    if (profile[0] != profile[1] &&
        section_taper_check(&s->section[profile[0]], &s->section[profile[1]], ends, &why) !=
            STATUS_OK)
        document_mistake(f->b->mistakes, n, 0, "%s", why.text);
}

static void read_sections(const fields *f, scene_member *m)
{
    const document_node *n = document_find(f->map, "section");
    if (n->kind != DOCUMENT_LIST) {
        m->section = m->section_q = fields_entry_of(f, n, SCENE_SECTIONS);
        return;
    }
    if (n->count != 2) {
        document_mistake(f->b->mistakes, n, 0,
                         "section: the list must have two names; give one name, or [at from, at "
                         "to]");
        return;
    }
    m->section = fields_entry_of(f, n->item[0], SCENE_SECTIONS);
    m->section_q = fields_entry_of(f, n->item[1], SCENE_SECTIONS);
    check_taper(f, n, (const int[]){m->section, m->section_q});
}

/* Reads the released components of an end of a member: one word or a list of words, whose order is
 * that of the releases. */
static void read_released(const fields *f, const char *key, int member, int end)
{
    const document_node *n = document_find(f->map, key);
    unsigned seen_components = 0;
    if (n == NULL)
        return;
    const int count = n->kind == DOCUMENT_LIST ? n->count : 1;
    for (int i = 0; i < count; i++) {
        const document_node *word = n->kind == DOCUMENT_LIST ? n->item[i] : n;
        const int c = fields_word_of(f, word, "release", fields_components, -1);
        if (c >= 0 && seen_components >> c & 1u)
            document_mistake(f->b->mistakes, word, 0,
                             "release: '%s' is given twice at this end; remove one", word->text);
        else if (c >= 0)
            scene_release_end(f->b->scene, member, end, c);
        seen_components |= c >= 0 ? 1u << c : 0;
    }
}

void builder_members(builder *b)
{
    for (int i = 0; i < b->list[SCENE_MEMBERS].count; i++) {
        const fields f = fields_of(b, &b->list[SCENE_MEMBERS].entry[i]);
        const fields release = fields_below(&f, "release");
        const int index = scene_add_member(b->scene, SCENE_NONE, SCENE_NONE, SCENE_NONE,
                                           (const double[3]){0, 0, 0});
        scene_member *m = scene_member_at(b->scene, index);
        builder_call(b, SCENE_MEMBERS, index, i);
        fields_read(&f, entry_member, m);
        if (fields_have(&f, "unstressed_length") && m->unstressed_length == 0)
            document_mistake(b->mistakes, document_find(f.map, "unstressed_length"), 0,
                             "unstressed_length = 0; give a positive length, or remove the key");
        read_sections(&f, m);
        read_warping(&f, m);
        read_released(&release, "from", index, 0);
        read_released(&release, "to", index, 1);
    }
}

static void check_unit(const fields *f, int motion)
{
    const document_node *given = document_find(f->map, "unit");
    const unit_system *units = &f->b->units;
    const int own = units->given && strcmp(given->text, units->name_of_length) == 0;
    const int angle = own ? 0 : fields_word(f, "unit", "m|rad", -1);
    if (angle == 0 && units->given && !own)
        document_mistake(
            f->b->mistakes, given, 0,
            "unit 'm': lengths of this scene are in %s; write 'unit: %s', or remove 'unit'",
            units->name_of_length, units->name_of_length);
    const scene *s = f->b->scene;
    int angles = 0, lengths = 0;
    for (int i = 0; i < s->nodes; i++)
        for (int k = 0; k < 3; k++) {
            lengths += s->node[i].translation[k] == motion;
            angles += s->node[i].angle[k] == motion;
        }
    if ((angle == 1 && lengths > 0) || (angle == 0 && angles > 0))
        document_mistake(f->b->mistakes, document_find(f->map, "unit"), 0,
                         "motion '%.40s' prescribes %s; write 'unit: %s', or prescribe another "
                         "component",
                         f->b->list[SCENE_DRIVERS].entry[motion].name,
                         angle == 1 ? "a translation" : "a rotation",
                         angle == 0     ? "rad"
                         : units->given ? units->name_of_length
                                        : "m");
}

static void check_given(const fields *f)
{
    const int known = fields_have(f, "value") || builder_has_function(f),
              unknown = fields_have(f, "such_that");
    if (known == unknown)
        document_mistake(f->b->mistakes, f->place, 0,
                         known ? "the motion has values and also 'such_that'; remove one of them"
                               : "the motion has no value; give 'path' and 'value', one of 'time', "
                                 "'pieces' and 'table', or 'such_that'");
}

void builder_motions(builder *b)
{
    for (int i = 0; i < b->list[SCENE_DRIVERS].count; i++) {
        const unrolled *entry = &b->list[SCENE_DRIVERS].entry[i];
        const fields f = fields_of(b, entry), condition = fields_below(&f, "such_that");
        double *path, *value;
        if (fields_have(&f, "unit"))
            check_unit(&f, i);
        if (condition.map == NULL) {
            const int stations = builder_stations(&f, "value", &path, &value);
            const int driver = fields_have(&f, "value")
                                   ? scene_add_driver(b->scene, entry->name, stations, path, value)
                                   : scene_add_moving_driver(b->scene, entry->name);
            builder_function(&f, driver, scene_drive_piece, 1);
            if (driver >= 0)
                b->scene->driver[driver].load_case = fields_entry(&f, "case", SCENE_CASES);
            check_given(&f);
            continue;
        }
        check_given(&f);
        const int driver =
            scene_add_unknown_driver(b->scene, entry->name, SCENE_NONE, SCENE_UX, SCENE_NONE);
        if (driver >= 0)
            fields_read(&f, entry_driver, &b->scene->driver[driver]);
    }
}

static void complete(const fields *f, int index, scene_analysis *a)
{
    const fields control = fields_below(f, "continuation"), motion = fields_below(f, "motion"),
                 what = fields_below(f, scene_analysis_name(a->kind));
    if (a->kind == SCENE_CONTINUATION) {
        scene_control *how = &a->of.continuation.control;
        how->step_max = fields_number(&control, "step_max", how->step);
    }
    if (a->kind == SCENE_MOTION)
        builder_in_time(&motion, &a->of.motion);
    if (a->follows >= index) {
        document_mistake(f->b->mistakes, document_find(what.map, "about"), 0,
                         "'%s' is defined after this entry; move it before this entry",
                         fields_text(&what, "about", ""));
        a->follows = SCENE_NONE;
    }
}

void builder_analyses(builder *b)
{
    for (int i = 0; i < b->list[SCENE_ANALYSES].count; i++) {
        const fields f = fields_of(b, &b->list[SCENE_ANALYSES].entry[i]);
        const int index = scene_add_linear(b->scene);
        if (index < 0)
            return;
        builder_call(b, SCENE_ANALYSES, index, i);
        fields_read(&f, entry_analysis, &b->scene->analysis[index]);
        complete(&f, index, &b->scene->analysis[index]);
    }
}

/* Returns what to request instead from a harmonic analysis; "": there is nothing. */
static const char *harmonic_remedy(scene_quantity_kind kind)
{
    switch (kind) {
    case SCENE_DEFLECTION:
        return "; or divide the member at this position by a node, and request its response";
    case SCENE_REACTION:
        return "; or request 'response' with 'of: reaction'";
    case SCENE_INTERNAL:
        return "; or divide the member at two nodes in the same position, join them by a stiff "
               "spring, and multiply its stiffness by the response of one node relative to the "
               "other (key 'from')";
    default:
        return "";
    }
}

void builder_no_quantity(const fields *what, const char *key, const scene_quantity *q)
{
    const scene_analysis *a = &what->b->scene->analysis[q->analysis];
    char names[128] = "";
    for (int k = SCENE_LINEAR; k <= SCENE_HARMONIC; k++)
        if (scene_gives((scene_analysis_kind)k, q)) {
            const size_t used = strlen(names);
            snprintf(names + used, sizeof names - used, "%s%s", used > 0 ? ", " : "",
                     scene_analysis_name((scene_analysis_kind)k));
        }
    document_mistake(
        what->b->mistakes, document_find(what->map, "analysis"), 0,
        "analysis '%s' (%s) has no quantity '%s'; name an analysis of a kind that has it: %s%s",
        a->name, scene_analysis_name(a->kind), key, names,
        a->kind == SCENE_HARMONIC ? harmonic_remedy(q->what.kind) : "");
}

/* Maximum number of characters of an expression of t after names have been replaced by values. */

enum { MOST_TEXT = 4000 };

typedef struct written_out {
    char text[MOST_TEXT];
    int place[MOST_TEXT];
    size_t used;
} written_out;

/* Appends text. Returns 0 if the text does not fit. */
static int put(written_out *to, const char *text, size_t length, int place)
{
    if (to->used + length >= MOST_TEXT)
        return 0;
    memcpy(to->text + to->used, text, length);
    for (size_t i = 0; i <= length; i++)
        to->place[to->used + i] = place;
    to->used += length;
    to->text[to->used] = '\0';
    return 1;
}

/* Copies a name that functions of time define, such as t or sin, or the value of any other name.
 * Returns 0 after an error. */
static int put_name(const fields *f, const document_node *n, int *at, written_out *to)
{
    const int from = *at, length = (int)expression_name_length(n->text + from);
    const char *name = n->text + from;
    const name_context context = {f->names, 1};
    expression_mistake why;
    char number[40];
    double value;
    if (name[length] != '.' &&
        ((length == 1 && *name == 't') || expression_is_word(name, (size_t)length))) {
        const scope *known = scope_find(f->names, name, (size_t)length);
        if (known != NULL)
            document_mistake(f->b->mistakes, n, from,
                             "'%.*s' is reserved in functions of time, but is also a name "
                             "in this file; rename it",
                             length, name);
        *at += length;
        return known == NULL && put(to, name, (size_t)length, from);
    }
    if (!names_number(&context, n->text, at, &value, &why)) {
        if (why.what[0] != '\0')
            document_mistake(f->b->mistakes, n, why.at, "%s", why.what);
        return 0;
    }
    snprintf(number, sizeof number, value < 0 ? "(%.17g)" : "%.17g", value);
    return put(to, number, strlen(number), from);
}

/* Writes the expression with values in place of names. Returns 0 after an error. */
static int write_out(const fields *f, const document_node *n, written_out *to)
{
    int at = 0;
    to->used = 0;
    put(to, "", 0, 0);
    while (n->text[at] != '\0') {
        const int length = (int)expression_name_length(n->text + at);
        const char before = at > 0 ? n->text[at - 1] : ' ';
        const int named = length > 0 && before != '.' && !(before >= '0' && before <= '9');
        const int taken = length > 0 ? length : 1, errors = f->b->mistakes->count;
        int behind = at;
        if (named ? put_name(f, n, &behind, to) : put(to, n->text + at, (size_t)taken, at)) {
            at = named ? behind : at + taken;
            continue;
        }
        if (f->b->mistakes->count == errors && to->used + 60 >= MOST_TEXT)
            document_mistake(f->b->mistakes, n, at,
                             "the function is longer than %d characters; split it into pieces",
                             MOST_TEXT - 1);
        return 0;
    }
    put(to, "", 0, at);
    return 1;
}

static void add_piece(const fields *f, const document_node *n, double until, int index,
                      builder_piece *add)
{
    written_out one;
    formula *read = NULL;
    expression_mistake why;
    if (n == NULL || !write_out(f, n, &one))
        return;
    if (formula_parse(one.text, &read, &why) != STATUS_OK)
        document_mistake(f->b->mistakes, n, one.place[why.at], "function of time: %s", why.what);
    else
        add(f->b->scene, index, until, one.text);
    formula_free(read);
}

static void add_pieces(const fields *f, const document_node *list, int index, builder_piece *add)
{
    double before = -INFINITY;
    if (list->count == 0)
        document_mistake(f->b->mistakes, list, 0,
                         "the list of pieces is empty; give [{until: TIME, is: ...}, {is: ...}]");
    for (int i = 0; i < list->count; i++) {
        fields piece = *f;
        piece.map = list->item[i];
        const int last = i == list->count - 1, ends = fields_have(&piece, "until");
        const double until = fields_number(&piece, "until", 0);
        if (!last && !ends)
            document_mistake(f->b->mistakes, piece.map, 0,
                             "only the last piece has no end; give 'until', the end of this piece");
        if (!last && ends && !(until > before))
            document_mistake(f->b->mistakes, piece.map, 0,
                             "until = %g, but the previous piece ends at %g; give a later time",
                             until, before);
        if (last && ends)
            document_mistake(f->b->mistakes, document_find(piece.map, "until"), 0,
                             "the last piece must have no end; remove 'until', or add another "
                             "piece");
        before = until;
        add_piece(&piece, document_find(piece.map, "is"), until, index, add);
    }
}

/* Computes the slopes m of the cubic spline that starts and ends at rest and has a continuous
 * second derivative. With the intervals h, g and the rises before and after station k, m[k-1]/h + 2
 * m[k] (1/h + 1/g) + m[k+1]/g = 3 (rise/h^2 + next rise/g^2). */
static void spline_slopes(int count, const double at[], const double value[], double m[],
                          double room[])
{
    m[0] = room[0] = 0;
    for (int k = 1; k < count - 1; k++) {
        const double h = at[k] - at[k - 1], g = at[k + 1] - at[k];
        const double right =
            3 * ((value[k] - value[k - 1]) / (h * h) + (value[k + 1] - value[k]) / (g * g));
        const double pivot = 2 / h + 2 / g - room[k - 1] / h;
        room[k] = 1 / (g * pivot);
        m[k] = (right - m[k - 1] / h) / pivot;
    }
    m[count - 1] = 0;
    for (int k = count - 2; k > 0; k--)
        m[k] -= room[k] * m[k + 1];
}

static void add_cubic(scene *s, int index, builder_piece *add, const double at[2],
                      const double value[2], const double slope[2])
{
    char text[400];
    const double h = at[1] - at[0], mean = (value[1] - value[0]) / h;
    const double second = (3 * mean - 2 * slope[0] - slope[1]) / h,
                 third = (slope[0] + slope[1] - 2 * mean) / (h * h);
    snprintf(text, sizeof text,
             "%.17g + (t - (%.17g))*((%.17g) + (t - (%.17g))*((%.17g) + (t - (%.17g))*(%.17g)))",
             value[0], at[0], slope[0], at[0], second, at[0], third);
    add(s, index, at[1], text);
}

static void add_line(scene *s, int index, builder_piece *add, const double at[2],
                     const double value[2])
{
    char text[120];
    snprintf(text, sizeof text, "%.17g + (t - (%.17g))*(%.17g)", value[0], at[0],
             (value[1] - value[0]) / (at[1] - at[0]));
    add(s, index, at[1], text);
}

static void add_level(scene *s, int index, builder_piece *add, double until, double value)
{
    char text[40];
    snprintf(text, sizeof text, "%.17g", value);
    add(s, index, until, text);
}

static void add_table(const fields *f, int index, builder_piece *add, int spline)
{
    double *at, *value;
    const int count = fields_values(f, "at", &at), values = fields_values(f, "value", &value);
    int ascends = 1;
    for (int k = 1; k < count; k++)
        ascends &= at[k] > at[k - 1];
    if (count != values || count < 2 || !ascends) {
        if (!ascends)
            document_mistake(f->b->mistakes, document_find(f->map, "at"), 0,
                             "the times in 'at' do not ascend; sort the rows of the table, and "
                             "remove repeated times");
        else
            document_mistake(f->b->mistakes, document_find(f->map, "at"), 0,
                             "the lengths of 'at' and 'value' are %d and %d; give the same number "
                             "of times and values, at least two",
                             count, values);
        return;
    }
    double *m = arena_take(f->b->arena, 2 * (size_t)count * sizeof *m);
    if (m == NULL)
        return;
    if (spline)
        spline_slopes(count, at, value, m, m + count);
    if (at[0] > 0)
        add_level(f->b->scene, index, add, at[0], value[0]);
    for (int k = 0; k < count - 1 && spline; k++)
        add_cubic(f->b->scene, index, add, at + k, value + k, m + k);
    for (int k = 0; k < count - 1 && !spline; k++)
        add_line(f->b->scene, index, add, at + k, value + k);
    add_level(f->b->scene, index, add, 0, value[count - 1]);
}

void builder_function(const fields *f, int index, builder_piece *add, int spline)
{
    const document_node *one = document_find(f->map, "time"),
                        *list = document_find(f->map, "pieces");
    const fields table = fields_below(f, "table");
    if (one != NULL)
        add_piece(f, one, 0, index, add);
    if (list != NULL)
        add_pieces(f, list, index, add);
    if (table.map != NULL)
        add_table(&table, index, add, spline);
}

static int builder_has_function(const fields *f)
{
    return fields_have(f, "time") || fields_have(f, "pieces") || fields_have(f, "table");
}

int builder_stations(const fields *f, const char *values, double **path, double **value)
{
    const int stations = fields_values(f, "path", path), count = fields_values(f, values, value);
    if (stations == count)
        return count;
    document_mistake(
        f->b->mistakes, document_find(f->map, fields_have(f, values) ? values : "path"), 0,
        "the lengths of 'path' and '%s' are %d and %d; give both the same number of values", values,
        stations, count);
    return 0;
}
