#include "harness/import_export/import_export_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/choice.h"
#include "harness/formulations/formulations.h"

/* Sorts the values by number of elements, then by quantity, then by abscissa. */
static void import_cells_order(imported *found);

static const scene *scene_of(const import_block *b)
{
    return b->point >= 0 ? &b->set->sweep.point[b->point].scene : NULL;
}

static int line_of(const import_block *b, const imported_row *row)
{
    return b->at > 0 ? b->at : row->line;
}

void import_block_free_set(import_set *set)
{
    sweep_free(&set->sweep);
    for (int i = 0; i < set->scenes; i++) {
        scene_file_free(set->scene[i]);
        free(set->scene_path[i]);
    }
    set->scenes = 0;
}

static const case_type *scene_case(import_block *b, const char *name, int line)
{
    char path[IMPORT_TEXT + 4096];
    const char *slash = name[0] == '/' ? NULL : strrchr(b->path, '/');
    snprintf(path, sizeof path, "%.*s%s", slash != NULL ? (int)(slash - b->path) + 1 : 0, b->path,
             name);
    import_set *set = b->set;
    for (int i = 0; i < set->scenes; i++)
        if (strcmp(set->scene_path[i], path) == 0)
            return scene_file_case(set->scene[i]);
    char *copy = set->scenes < IMPORT_SCENES ? strdup(path) : NULL;
    if (copy == NULL) {
        mistakes_add(
            b->m, line, 1,
            "more than %d scene files are named; import them in several runs of 'beamwork import'",
            IMPORT_SCENES);
        return NULL;
    }
    fault f = {""};
    mistakes of_scene = {.file = copy};
    if (scene_file_read(copy, &set->scene[set->scenes], &of_scene, &f) != STATUS_OK) {
        mistakes_add(b->m, line, 1, "case: %.400s", f.text);
        free(copy);
        return NULL;
    }
    set->scene_path[set->scenes] = copy;
    return scene_file_case(set->scene[set->scenes++]);
}

static int ends_in(const char *name, const char *ending)
{
    const size_t length = strlen(name), size = strlen(ending);
    return length > size && strcmp(name + length - size, ending) == 0;
}

/* Finds the point of the sweep with these parameters, or creates it. Returns its index; -1: an
 * error. */
static int point_of(import_block *b, const case_type *type, const double value[], int line)
{
    sweep *s = &b->set->sweep;
    fault f = {""};
    for (int i = 0; i < s->points; i++)
        if (s->point[i].type == type && memcmp(s->point[i].parameter, value,
                                               (size_t)parameters_count(type) * sizeof *value) == 0)
            return i;
    if (plan_add(s, type, value, NULL, NULL, 0, &f) != STATUS_OK) {
        b->m->out_of_memory = 1;
        return -1;
    }
    if (s->point[s->points - 1].status == STATUS_OK)
        return s->points - 1;
    mistakes_add(b->m, line, 1, "case: %.400s", s->point[s->points - 1].reason);
    return -1;
}

/* Finds or creates the point given by "case; NAME=VALUE; NAME=VALUE". Returns its index; -1: an
 * error. */
static int find_point(import_block *b, const char *of, int line)
{
    char name[IMPORT_TEXT], parameters[IMPORT_TEXT];
    double value[CASE_MAX_PARAMETERS] = {0};
    fault f = {""};
    size_t used = 0;
    snprintf(name, sizeof name, "%.*s", (int)strcspn(of, ";"), of);
    for (size_t end = strlen(name); end > 0 && name[end - 1] == ' ';)
        name[--end] = '\0';
    for (const char *at = of + strcspn(of, ";"); *at != '\0'; at++)
        if (*at != ' ' && !(used == 0 && *at == ';'))
            parameters[used++] = *at;
    parameters[used] = '\0';
    const int is_scene = ends_in(name, ".yaml") || ends_in(name, ".yml");
    const case_type *type = is_scene ? scene_case(b, name, line) : case_find(name, &f);
    if (type == NULL) {
        if (!is_scene)
            mistakes_add(b->m, line, 1, "%.400s", f.text);
        return -1;
    }
    parameters_default(type, value);
    if (parameters_parse(type, parameters, value, NULL, &f) == STATUS_OK)
        return point_of(b, type, value, line);
    mistakes_add(b->m, line, 1, "%.400s", f.text);
    return -1;
}

/* Returns the convention for moments of the compliances of a scene; -1: there is none. */
static int moments_of(const scene *s)
{
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_COMPLIANCE)
            return (int)scene_compliance_of(&s->analysis[i])->moments;
    return -1;
}

static void check_convention(const import_block *b, const import_header *h)
{
    const int moments = scene_of(b) != NULL ? moments_of(scene_of(b)) : -1;
    if (h->convention[0] == '\0' || moments < 0)
        return;
    const char *own_axis = scene_moments_name((scene_moments)moments);
    if (strcmp(own_axis, h->convention) != 0)
        mistakes_add(b->m, h->convention_line, 1,
                     "convention '%.40s': the moments of the case are %s; set the parameter of the "
                     "case that selects the convention, or convert the values",
                     h->convention, own_axis);
}

static void name_series(import_block *b, const import_header *h, int line)
{
    imported *to = b->found;
    if (h->program[0] == '\0')
        mistakes_add(b->m, line, 1,
                     "the program is not named; add a line such as '# program: CalculiX, C3D20R' "
                     "before the values");
    else if (strlen(h->program) >= FORMULATION_KEY || strchr(h->program, '/') != NULL)
        mistakes_add(b->m, h->program_line, 1,
                     "the name of the program contains '/' or more than %d characters; give a "
                     "shorter name without '/', such as CalculiX",
                     FORMULATION_KEY - 1);
    else if (formulation_find(h->program) != NULL)
        mistakes_add(b->m, h->program_line, 1,
                     "program '%.60s' has the name of a formulation of beamwork; use another name, "
                     "such as the name of the program that computed the values",
                     h->program);
    if (strlen(h->model) >= IMPORTED_WORD || strlen(h->convention) >= IMPORTED_WORD)
        mistakes_add(b->m, h->model_line > 0 ? h->model_line : h->convention_line, 1,
                     "the words after 'model' and 'convention' have more than %d characters; give "
                     "shorter words, such as '# model: solid'",
                     IMPORTED_WORD - 1);
    if (strlen(h->version) >= IMPORTED_WORD)
        mistakes_add(b->m, h->version_line, 1,
                     "the version has more than %d characters; give a shorter one, such as '# "
                     "version: 2.20'",
                     IMPORTED_WORD - 1);
    snprintf(to->version, sizeof to->version, "%.*s", IMPORTED_WORD - 1, h->version);
    snprintf(to->program, sizeof to->program, "%.*s", FORMULATION_KEY - 1, h->program);
    snprintf(to->file, sizeof to->file, "%s", b->path);
    snprintf(to->model, sizeof to->model, "%.*s", IMPORTED_WORD - 1,
             h->model[0] != '\0' ? h->model : "beam");
    snprintf(to->convention, sizeof to->convention, "%.*s", IMPORTED_WORD - 1, h->convention);
}

import_block import_block_open(import_set *set, const import_header *h, const char *path,
                               mistakes *m)
{
    import_block b = {.set = set, .path = path, .m = m, .axes = h->axes, .point = -1};
    const int line = h->of_line > 0 ? h->of_line : 1;
    b.found = calloc(1, sizeof *b.found);
    if (b.found == NULL) {
        m->out_of_memory = 1;
        return b;
    }
    name_series(&b, h, line);
    if (h->of[0] == '\0')
        mistakes_add(m, line, 2,
                     "the case is not named; add a line such as '# case: elastica; load=2' or '# "
                     "case: leaf.yaml' before the values");
    else
        b.point = find_point(&b, h->of, line);
    check_convention(&b, h);
    return b;
}

static const char *quantity_name(const void *context, int i)
{
    const scene *s = context;
    return i < s->quantities ? s->quantity[i].name : NULL;
}

static const scene_quantity *find_quantity(const import_block *b, const imported_row *row)
{
    const scene *s = scene_of(b);
    for (int i = 0; i < s->quantities; i++)
        if (strcmp(s->quantity[i].name, row->quantity) == 0)
            return &s->quantity[i];
    const char *near = choice_nearest(row->quantity, quantity_name, s);
    const case_type *type = b->set->sweep.point[b->point].type;
    char shown[ASSIGNMENT_SHOWN];
    parameters_shown(type, shown);
    mistakes_add(b->m, line_of(b, row), 1,
                 "%.40s has no quantity '%.60s'%s%s%s'beamwork list %.170s' shows the quantities",
                 type->name, row->quantity, near != NULL ? "; did you mean '" : "",
                 near != NULL ? near : "", near != NULL ? "'? " : "; ", shown);
    return NULL;
}

static int has_moments(const scene_quantity *q)
{
    return (q->what.kind == SCENE_COMPLIANCE_ENTRY || q->what.kind == SCENE_STIFFNESS_ENTRY) &&
           (scene_entry_of(q)->row >= SCENE_RX || scene_entry_of(q)->column >= SCENE_RX);
}

static void check_row(const import_block *b, const imported_row *row, const scene_quantity *q)
{
    const int is_curve = q->reduction == SCENE_CURVE;
    if (is_curve && !isfinite(row->x))
        mistakes_add(
            b->m, line_of(b, row), 2,
            "'%s' is a curve, so each value requires its position x; give the %s [%s] in column x",
            q->name, q->x.name, q->x.unit);
    if (!is_curve && !isnan(row->x))
        mistakes_add(b->m, line_of(b, row), 2,
                     "'%s' is a single value, not a curve; leave column x empty", q->name);
    if (has_moments(q) && b->found->convention[0] == '\0')
        mistakes_add(b->m, line_of(b, row), 3,
                     "'%s' depends on the convention for moments on rotating nodes; add '# "
                     "convention: spatial', or semitangential or symmetrised instead of spatial",
                     q->name);
}

static int convert(const import_block *b, const scene_quantity *q, imported_row *row)
{
    int sign = 1;
    fault f = {""};
    const scene_quantity *own_axis = axes_quantity(&b->axes, scene_of(b), q, &sign);
    if (own_axis == NULL) {
        mistakes_add(b->m, line_of(b, row), 1,
                     "the case has no quantity '%s' in these axes; correct the line '# axes', "
                     "which is x=x y=y z=z for equal axes",
                     q->name);
        return 0;
    }
    if (conversion_factor(row->unit, own_axis->unit, &row->factor, &f) != STATUS_OK) {
        mistakes_add(b->m, line_of(b, row), 4, "%s: %.300s", q->name, f.text);
        return 0;
    }
    row->factor *= sign;
    row->value *= row->factor;
    row->uncertainty *= fabs(row->factor);
    snprintf(row->quantity, sizeof row->quantity, "%s", own_axis->name);
    return 1;
}

static void check_again(const import_block *b)
{
    const imported *all = b->found;
    import_cells_order(b->found);
    for (int i = 1; i < all->rows; i++) {
        const imported_row *one = &all->row[i - 1], *next = &all->row[i];
        if (one->elements == next->elements && strcmp(one->quantity, next->quantity) == 0 &&
            (one->x == next->x || (isnan(one->x) && isnan(next->x))))
            mistakes_add(
                b->m, line_of(b, next), 5,
                "'%s' with %d elements is given again in line %d; remove one of the two lines",
                next->quantity, next->elements, one->line);
    }
}

static int make_room(import_block *b)
{
    imported *to = b->found;
    if ((to->rows & (to->rows - 1)) != 0)
        return 1;
    const size_t room = to->rows == 0 ? 1 : 2 * (size_t)to->rows;
    imported_row *more = realloc(to->row, room * sizeof *more);
    if (more == NULL) {
        b->m->out_of_memory = 1;
        return 0;
    }
    to->row = more;
    return 1;
}

void import_block_add(import_block *b, const imported_row *row)
{
    imported_row one = *row;
    if (b->found == NULL || b->point < 0)
        return;
    const scene_quantity *q = find_quantity(b, &one);
    if (q == NULL)
        return;
    check_row(b, &one, q);
    if (!convert(b, q, &one))
        return;
    if (make_room(b))
        b->found->row[b->found->rows++] = one;
}

status import_block_close(import_block *b, fault *f)
{
    status outcome = STATUS_OK;
    if (b->found != NULL)
        check_again(b);
    if (b->found != NULL && b->m->count == 0 && !b->m->out_of_memory && b->found->rows > 0)
        outcome = import_cells_add(&b->set->sweep, b->point, b->found, f);
    else
        imported_free(b->found);
    b->found = NULL;
    return outcome;
}

/* Returns the wide range of orders 1 to 8, because the order of another program is unknown. */
static element_order any_order(element_analysis analysis, const double options[])
{
    (void)analysis;
    (void)options;
    return (element_order){1, 8};
}

static int by_place(const void *a, const void *b)
{
    const imported_row *p = a, *q = b;
    if (p->elements != q->elements)
        return (p->elements > q->elements) - (p->elements < q->elements);
    const int order = strcmp(p->quantity, q->quantity);
    if (order != 0)
        return order;
    return p->x != q->x ? (p->x > q->x) - (p->x < q->x) : p->line - q->line;
}

static void import_cells_order(imported *found)
{
    if (found->rows > 1)
        qsort(found->row, (size_t)found->rows, sizeof *found->row, by_place);
}

static status find_meshes(series *one, const imported *found, fault *f)
{
    for (int i = 0; i < found->rows; i++) {
        if (one->meshes > 0 && one->mesh[one->meshes - 1] == found->row[i].elements)
            continue;
        if (one->meshes == SERIES_MAX_MESHES)
            return fault_set(f, STATUS_REFUSED,
                             "%.60s: more than %d numbers of elements are given at one parameter "
                             "point; remove some of them",
                             found->program, SERIES_MAX_MESHES);
        one->mesh[one->meshes++] = found->row[i].elements;
    }
    return STATUS_OK;
}

static int add_to_curve(curve *c, const imported_row *row)
{
    double *x = realloc(c->x, (size_t)(c->points + 1) * sizeof *x);
    if (x == NULL)
        return 0;
    c->x = x;
    double *value = realloc(c->value, (size_t)(c->points + 1) * sizeof *value);
    if (value == NULL)
        return 0;
    c->value = value;
    c->x[c->points] = row->x;
    c->value[c->points++] = row->value;
    return 1;
}

static int quantity_index(const scene *s, const char *name)
{
    for (int i = 0; i < s->quantities; i++)
        if (strcmp(s->quantity[i].name, name) == 0)
            return i;
    return -1;
}

static int take_row(const scene *s, series *one, const imported_row *row)
{
    int mesh = 0;
    while (one->mesh[mesh] != row->elements)
        mesh++;
    cell_result *cell = &one->cell[mesh];
    const int index = quantity_index(s, row->quantity);
    if (index < 0)
        return 1;
    quantity_result *q = &cell->solve.quantity[index];
    if (row->unknowns > 0)
        cell->size.free = row->unknowns;
    if (isfinite(row->seconds))
        cell->solve.seconds_solve = row->seconds;
    q->status = STATUS_OK;
    q->reason[0] = '\0';
    if (s->quantity[index].reduction == SCENE_CURVE)
        return add_to_curve(&q->curve, row);
    q->value = row->value;
    one->noise[index] = NAN;
    if (isfinite(row->uncertainty)) {
        const double size = fmax(fabs(row->value), s->quantity[index].near_zero);
        one->noise[index] = size > 0 ? row->uncertainty / size : NAN;
    }
    return 1;
}

static int make_cells(const scene *s, series *one)
{
    one->cell = calloc((size_t)one->meshes + 1, sizeof *one->cell);
    one->noise = malloc(((size_t)s->quantities + 1) * sizeof *one->noise);
    if (one->cell == NULL || one->noise == NULL)
        return 0;
    for (int q = 0; q < s->quantities; q++)
        one->noise[q] = NAN;
    for (int k = 0; k < one->meshes; k++) {
        solve_result *r = &one->cell[k].solve;
        r->seconds_solve = NAN;
        r->quantity = calloc((size_t)s->quantities + 1, sizeof *r->quantity);
        if (r->quantity == NULL)
            return 0;
        r->quantities = s->quantities;
        for (int q = 0; q < s->quantities; q++) {
            r->quantity[q].value = r->quantity[q].x = r->quantity[q].change = NAN;
            r->quantity[q].status = STATUS_NO_VALUE;
            strcpy(r->quantity[q].reason, "not in the file");
        }
    }
    return 1;
}

static status fill(const scene *s, series *one, fault *f)
{
    TRY(find_meshes(one, one->imported, f));
    if (!make_cells(s, one))
        return fault_memory(f, "imported values");
    for (int i = 0; i < one->imported->rows; i++)
        if (!take_row(s, one, &one->imported->row[i]))
            return fault_memory(f, "imported values");
    return STATUS_OK;
}

static int series_end(const sweep *s, int point_index)
{
    int place = s->seriess;
    while (place > 0 && s->series[place - 1].point > point_index)
        place--;
    return place;
}

status import_cells_add(sweep *s, int point_index, imported *found, fault *f)
{
    series *more = realloc(s->series, (size_t)(s->seriess + 1) * sizeof *more);
    if (more == NULL) {
        imported_free(found);
        return fault_memory(f, "series");
    }
    s->series = more;
    const int place = series_end(s, point_index);
    memmove(&more[place + 1], &more[place], (size_t)(s->seriess - place) * sizeof *more);
    s->seriess++;
    series *one = &more[place];
    memset(one, 0, sizeof *one);
    found->type = (element_type){.name = found->program,
                                 .summary = "another program, whose values were imported",
                                 .source = found->file,
                                 .abi = ELEMENT_ABI,
                                 .order = any_order};
    import_cells_order(found);
    one->point = point_index;
    one->imported = found;
    one->formulation.type = &found->type;
    memcpy(one->formulation.key, found->program, sizeof one->formulation.key);
    return fill(&s->point[point_index].scene, one, f);
}
